"""Parts of the report under load: present where the file says enough, with the numbers of the analyses."""

import html
import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from cardan.answers.quantity import told
from cardan.answers.reader import USUAL, significant
from cardan.drive.accuracy import Error
from cardan.drive.cross import Cross
from cardan.drive.drive import Drive
from cardan.drive.movement import Hitch
from cardan.figures.axes import percent
from cardan.io import example, example_names
from cardan.maths.kernel import frames
from cardan.questions.accuracy.tolerance import Linear, WorstCase, tolerance
from cardan.questions.forces.assembly import assembly
from cardan.questions.forces.forces import forces
from cardan.questions.forces.moving_forces import moving_forces
from cardan.questions.losses.figure import power
from cardan.questions.losses.losses import losses
from cardan.report.answers import answered, subject
from cardan.report.content import content
from cardan.report.report import page
from cardan.units import arcmin
from tests.builders.reports import page_of

from .test_report import parsed

WITH = {
    "truck-supports": {"mobility", "forces", "losses", "bending", "line", "balance"},
    "two-piece-rubber-bearing": {"assembly", "mobility", "bending", "line", "balance"},
    "pto-spline-thrust": {"mobility", "forces", "losses"},
    "instrument-joint": {"mobility", "forces", "losses", "accuracy"},
    "overconstrained-pump": {"accuracy", "mobility", "forces", "losses", "assembly", "bending", "line"},
    "truck-power-unit": {"torsion", "balance"},
    "pto-flywheel": {"torsion", "run-up", "bending", "line", "balance"},
    "pto-flywheel-absorber": {"torsion", "run-up", "bending", "line", "balance"},
    "pto-baler": {"torsion", "bending", "line", "balance"},
    "front-halfshaft": {"losses"},
    "unstable-drive": {"torsion"},
    "cured-drive": {"torsion"},
    "car-propshaft": {"bending", "line", "rotor", "balance"},
    "composite-propshaft": {"bending", "line", "balance"},
    "pickup-two-piece": {"assembly", "mobility", "forces", "losses", "bending", "line", "balance"},
    "thompson-drive": {"mobility", "forces", "losses", "bending", "line", "balance"},
    "mill-spindle": {"bending", "line", "balance"},
    "pto-drive": {"bending", "line", "balance"},
    "truck-duty-cycle": {"forces", "mobility", "bending", "line", "balance"},
    "double-cardan-propshaft": {"bending", "line", "balance"},
    "propshaft-with-rzeppa": {"mobility", "forces", "bending", "line", "balance"},
}
"""Examples with parts of their own."""

PARTS = {
    "forces",
    "losses",
    "accuracy",
    "mobility",
    "assembly",
    "torsion",
    "run-up",
    "bending",
    "line",
    "rotor",
    "balance",
}


@cache
def paged(drive):
    """Return the report of a drive, made once for all tests."""
    return page(drive)


def words(drive):
    return "".join(parsed(paged(drive)).words)


@pytest.mark.slow
@pytest.mark.parametrize("name", example_names())
def test_each_part_stands_only_where_the_file_asks_for_it(name):
    assert PARTS & set(parsed(page_of(name)).ids) == WITH.get(name, set())


@pytest.mark.slow
@pytest.mark.parametrize("name", WITH)
def test_every_check_passes(name):
    text = page_of(name)
    tables = re.findall(r"<h3>Self-checks</h3>(.*?)</table>", text, flags=re.DOTALL)
    said = re.findall(r">([^<>]*[Cc]hecked: [^<>]*)<", text)
    unsolved = {"balance", "assembly"} if "no misalignment can load it" in text else {"balance"}
    assert len(tables) + len(said) >= len(WITH[name] - unsolved)  # each part that solves something has one
    assert not any(re.search("to 0|not at all|[Ff]ailed", one) for one in said)
    assert "Check failed" not in text
    for table in tables:
        verdicts = re.findall(r'<td class="([^"]*)"[^>]*>(?:(?!<td).)*</tr>', table, flags=re.DOTALL)
        assert len(verdicts) == table.count("<tr>") - 1 > 0  # but for that of the head
        assert {verdict.split()[-1] for verdict in verdicts} == {"good"}


def test_stopped_by_the_reader_no_part_is_added():
    text = page(example("truck-supports"), progress=lambda share: "stop")
    assert not PARTS & set(parsed(text).ids)


@pytest.mark.slow
def test_forces_says_what_the_worst_support_carries():
    drive = example("truck-supports")
    found = forces(drive)
    top = max(float(np.max(frames.norm(one.reaction))) for one in (found, found.reverse))
    text = words(drive)
    assert f"support 4 (pinion, front) carries most, up to {significant(top)} N." in text
    assert significant(top) in text.split("in all")[1]  # in the table too, radial and axial together
    assert significant(max(float(np.max(one.journals.size[1])) for one in (found, found.reverse))) in text


@pytest.mark.slow
def test_a_drive_held_too_much_still_tells_torques_and_says_why_no_reactions():
    drive = example("overconstrained-pump")
    rigid = tuple(replace(one, stiffness=None, axial_stiffness=None) for one in drive.supports)
    text = words(replace(drive, supports=rigid))
    assert "more than statics can tell" in text
    assert "Torque and secondary couple of every shaft" in text
    assert "What the supports carry" not in text


@pytest.mark.slow
def test_a_loose_shaft_is_named():
    drive = example("truck-supports")
    assert "supports" in words(replace(drive, supports=drive.supports[:-1]))


@pytest.mark.slow
def test_a_stiffness_that_bending_asks_for_does_not_ask_for_assembly():
    drive = example("truck-supports")
    centre = replace(drive.supports[2], stiffness=2.5e5)
    lone = replace(drive.supports[0], axial=False)
    text = page(replace(drive, supports=(centre, lone), duty=replace(drive.duty, torque=None)))
    assert "assembly" not in parsed(text).ids
    assert "not calculated" not in text


@pytest.mark.slow
def test_shared_forces_are_called_so():
    assert "share the forces by their stiffness" in words(example("overconstrained-pump"))
    assert "share the forces" not in words(example("truck-supports"))


@pytest.mark.slow
def test_the_structure_tells_redundant_constraints_and_a_remedy():
    said = words(example("overconstrained-pump"))
    assert "Mobility 1, 3 redundant constraints (overconstrained)" in said
    assert "support 4 (pump, far), float along its axis" in said
    pages = content(example("truck-supports"), full=True)
    assert "mobility" not in [page.name for page in pages.pages]  # nothing to say to most readers
    assert pages.appendix[0].name == "mobility"
    assert pages.appendix[0].answer.startswith("Mobility 1, no redundant constraints")


@pytest.mark.slow
def test_assembly_says_how_much_and_what_to_release():
    text = words(example("overconstrained-pump"))
    assert "Statically indeterminate, degree 3; misalignment loads support 1 (motor, far) with up to 2" in text
    assert "Statically determinate with support 2 omitted and support 4 free along its axis." in text


@pytest.mark.slow
def test_parts_that_fit_strain_nothing():
    drive = example("overconstrained-pump")
    fits = replace(
        drive,
        joints=(replace(drive.joints[0], error=None),),
        supports=tuple(replace(one, offset=(0.0, 0.0, 0.0)) for one in drive.supports),
    )
    text = words(fits)
    assert "all parts fit" in text
    assert "How misalignment loads" not in text


@pytest.mark.slow
def test_stiffness_left_out_is_asked_for_by_name():
    drive = example("overconstrained-pump")
    rigid = tuple(replace(one, stiffness=None, axial_stiffness=None) for one in drive.supports)
    assert "supports[0].stiffness: missing" in words(replace(drive, supports=rigid))


@pytest.mark.slow
def test_losses_tell_power_efficiency_and_what_is_left_out():
    drive = example("truck-supports")
    found = losses(drive)
    text = words(drive)
    assert f"of {power(found.input_power).told(USUAL)}, {power(found.heat).told(USUAL)} are lost" in text
    assert f"Efficiency {percent(found.efficiency, 4)}" in text
    assert "they slide while the drive moves" in text


def test_a_drive_that_locks_is_called_so():
    drive = example("truck-supports")
    joint = replace(drive.joints[2], friction=40.0)
    text = words(replace(drive, joints=(*drive.joints[:2], joint)))
    assert "Friction locks joint 3." in text


@pytest.mark.slow
def test_without_speed_nothing_is_said_of_losses():
    drive = example("truck-supports")
    assert "are lost" not in words(replace(drive, duty=replace(drive.duty, speed=None)))


def test_accuracy_tells_both_bounds_and_what_matters():
    drive = example("instrument-joint")
    most, worst = (tolerance(drive, method=way).output.largest / arcmin for way in (Linear(), WorstCase()))
    text = words(drive)
    assert f"±{significant(most, 3)}′ (root of squares), ±{significant(worst, 3)}′ in the worst case" in text
    assert "yoke phase of joint 1 makes 75 % of the variance" in text
    assert "Shift of the output shaft" in text


@pytest.mark.slow
def test_a_held_output_does_not_shift():
    drive = example("instrument-joint")
    held = tuple(replace(one, axial=True) if k == 3 else one for k, one in enumerate(drive.supports))
    text = words(replace(drive, supports=held))
    assert "Shift of the output shaft" not in text
    assert "variance of the shift" not in text


@pytest.mark.parametrize(
    ("error", "says"),
    [(Error(alpha2=0.5 * arcmin), "known errors make an angle error"), (Error(a2=1e-5), "Shift of the output shaft")],
)
def test_known_errors_alone_have_a_part(error, says):
    single = Drive.from_angles([0.4])
    drive = replace(single, joints=(replace(single.joints[0], error=error),))
    seen = parsed(page(drive))
    assert "accuracy" in seen.ids
    assert says in "".join(seen.words).replace("Known", "known")


def test_errors_that_cannot_be_assembled_are_called_so():
    single = Drive.from_angles([0.4])
    drive = replace(single, joints=(replace(single.joints[0], error=Error(alpha2=1.3)),))
    assert "cannot be assembled" in words(drive)


def plain(text):
    return " ".join(text.split())


def front(drive):
    """Return the words before the second part, blanks made single."""
    before = paged(drive).partition('id="summary"')[2].partition("<section")[0]
    text = re.sub(r"<svg.*?</svg>|<[^>]*>", " ", before, flags=re.DOTALL)
    return " ".join(html.unescape(text).split())


def test_the_first_page_has_the_key_figures_of_forces_and_losses():
    drive = example("truck-supports")
    text = front(drive)
    found = forces(drive)
    top = max(float(np.max(frames.norm(one.reaction))) for one in (found, found.reverse))
    assert f"largest force on a support, 4 (pinion, front) {plain(significant(top))} N" in text
    assert f"efficiency {percent(losses(drive).efficiency, 4)}" in text
    assert "some power loss not counted" in text
    assert "largest load of a journal, joint 2" in text


@pytest.mark.slow
def test_the_first_page_has_the_key_figures_of_accuracy_and_assembly():
    instrument = example("instrument-joint")
    most = tolerance(instrument).output.largest / arcmin
    assert f"angle error of the output by the joints as made, root of squares {significant(most, 3)} ′" in front(
        instrument
    )
    pump = example("overconstrained-pump")
    text = front(pump)
    assert f"{plain(significant(assembly(pump).joint_peak[0].value))} N" in text
    assert "binds" in text
    assert "Misalignment strains the drive without any torque" in text


def test_what_does_not_turn_is_no_good_drive_on_the_first_page():
    drive = example("z-arrangement")
    joints = tuple(replace(one, friction=40.0, cross=Cross(span=0.1, journal=0.03)) for one in drive.joints)
    locked = replace(drive, joints=joints, duty=replace(drive.duty, torque=100.0, speed=100.0))
    whole = paged(locked)
    assert 'class="judgement failed"' in whole
    assert "friction in the journals of joints 1, 2 reaches the torque that turns them" in front(locked)
    slow = replace(drive, duty=replace(drive.duty, speed=10.0))  # its shafts swing too hard at full speed
    assert 'class="judgement good"' in page(slow)


@pytest.mark.slow
def test_what_could_not_be_calculated_is_told_on_the_first_page():
    drive = example("truck-supports")
    assert "Forces not calculated" not in front(drive)
    rigid = example("overconstrained-pump")
    supports = tuple(replace(one, stiffness=None, axial_stiffness=None) for one in rigid.supports)
    text = front(replace(rigid, supports=supports))
    assert "more than statics can tell" in text
    assert "Assembly not calculated: supports[0].stiffness" in text


@pytest.mark.slow
def test_a_moving_drive_tells_its_forces_over_the_movement():
    drive = example("pto-spline-thrust")
    swing = Hitch(moves=("joints[1]", "output"), pivot=(0.47, 0.0, -0.3), yaw=0.3, frequency=3.0)
    moved = replace(drive, movements=(swing,))
    found = moving_forces(moved)
    text = words(moved)
    assert "What the supports carry while the drive moves" in text
    assert f"{significant(float(np.max(found.reaction_size)))} N at" in text
    assert "largest force on a support, 3 (implement, near)" in text
    assert "s of the movement" in text


def test_the_last_digits_of_coordinates_are_no_reason_to_change_a_drive():
    text = front(example("pto-spline-thrust"))  # bends equal to 0.0001°
    assert "cannot be made uniform" not in text
    assert "instead of" not in text
    assert "Nothing needs to be changed for a uniform output" in text


@pytest.mark.slow
def test_what_holds_too_often_is_counted_once_on_the_first_page():
    on = subject(example("overconstrained-pump"))
    pages = [answered(name, on) for name in ("assembly", "mobility")]
    keys = [told(one.title, USUAL) for made in pages for one in made.keys]
    assert keys == ["force of misalignment without load, joint 1", "redundant constraints"]
