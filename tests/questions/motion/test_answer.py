"""What is said of the motion: the numbers of the analysis, for any reader, of drives with joints of any kinds."""

from dataclasses import replace

import pytest

from cardan.answers.data import data
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL, Reader
from cardan.book import answer as classical
from cardan.checks import check
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.joints.tripod import pivot_error
from cardan.drive.shaft import Shaft
from cardan.drive.support import Support
from cardan.errors import InputError
from cardan.io import example
from cardan.joints import PinCoupling, Rzeppa, Tripod
from cardan.questions.motion.answer import answer, ask
from cardan.questions.motion.equivalence import equivalent_joint
from cardan.questions.motion.turning import swing
from cardan.report.block import page
from cardan.texts import speaking
from cardan.units import deg, mm, rpm

RADIANS = Reader(units={"angle": "rad", "angular_speed": "rad_s"}, decimal=",")


def of(drive):
    return answer(drive, ask(drive))


def column(table, key):
    return next(one for one in table.columns if one.key == key)


def words(said, reader=USUAL):
    return " ".join([told(said.sentence, reader), *(told(one.text, reader) for one in said.remarks)])


@pytest.mark.parametrize(
    ("drive", "text"),
    [
        (Drive.from_angles([20 * deg]), "one joint at a joint angle of 20.00°, speed fluctuation δ = 12.45 %."),
        (Drive.from_angles([0.2, 0.2]), "2 joints; synchronous: the joints cancel each other"),
        (Drive.from_angles([0.0, 0.0]), "2 joints; every joint turns uniformly by itself"),
        (example("pto-spline-thrust"), "2 joints; synchronous but for the rounding of the figures"),
        (example("pto-hitch"), "and so does the output. This concerns the drive as drawn, standing still."),
        (example("truck-printed-angles"), "4 joints; equivalent joint angle 20.05°, speed fluctuation δ = 12.51 %."),
    ],
)
def test_the_sentence_says_how_uniformly_the_output_turns(drive, text):
    assert text in told(of(drive).sentence, USUAL)


def test_a_joint_with_a_law_of_its_own_is_answered_alike():
    drive = example("instrument-joint")
    plain = Drive.from_angles([20 * deg])

    own = Drive(
        joints=(
            PinCoupling(joint_angle=20 * deg, driving_slant=40 * deg, driving_distance=0.05, driven_distance=0.052),
        )
    )
    seen, found = swing(own), of(own)
    assert (
        [one.name for one in found.tables] == [one.name for one in of(plain).tables] == ["joints", "shafts", "orders"]
    )
    assert data(found, USUAL)["speed_fluctuation_percent"] == pytest.approx(100.0 * float(seen.speed_fluctuation[-1]))
    assert "as of one cross joint at" in told(found.sentence, USUAL)
    assert [figure.name for figure in found.figures()] == ["motion"]
    assert of(drive).keys


def test_tables_and_keys_are_those_of_the_analysis():
    drive = example("truck-printed-angles")
    said, whole = of(drive), equivalent_joint(drive)
    keys = {one.name: one.value.value for one in said.keys}
    assert keys["speed_fluctuation"] == float(whole.speed_fluctuation)
    assert keys["equivalent_joint_angle"] == pytest.approx(float(whole.joint_angle))
    assert keys["angle_error"] == pytest.approx(float(whole.max_angle_error))
    shafts = next(one for one in said.tables if one.name == "shafts")
    assert list(column(shafts, "speed_fluctuation").values) == pytest.approx(list(whole.shaft_speed_fluctuation))


def test_readers_are_told_in_their_units_and_language():
    drive = example("truck-printed-angles")
    said = of(drive)
    assert "Output angle error ±0,03125 rad, 2nd order; at 89,54 rad/s" in words(said, RADIANS)
    assert data(said, RADIANS)["angle_error_rad"] == pytest.approx(0.03125, abs=1e-5)
    made = page(said, USUAL)
    assert made.answer.startswith("4 joints; equivalent")
    with speaking("ru"):
        assert "4 шарнира" in told(of(drive).sentence, USUAL)


def test_ratios_of_a_nearly_uniform_shaft_are_not_alike():
    shafts = next(one for one in of(example("pto-spline-thrust")).tables if one.name == "shafts")
    low, high = (column(shafts, f"ratio_{end}").values[-1].told(USUAL) for end in ("min", "max"))
    assert (low, high) == ("0.99999968", "1.00000032")


def test_the_classical_approximations_are_told_where_they_differ():
    truck = example("truck-printed-angles")
    seen = classical.ask(truck)
    assert classical.differ(seen)
    (table,) = classical.answer(truck, seen).tables
    # Book (80) as in the worked example: 12.335 % with mean phases.
    assert column(table, "speed_fluctuation").values[2] == pytest.approx(0.12335, abs=5e-6)
    even = Drive.from_angles([0.0, 0.0])
    assert classical.ask(even) is None
    assert "nothing to approximate" in classical.otherwise(even)
    assert classical.ask(example("front-halfshaft")) is None
    assert "laws of their own" in classical.otherwise(example("front-halfshaft"))


def test_a_tripod_whose_shaft_pivots_beyond_errs_as_with_the_joint_there():
    """R_B/L tan(α/2) to first order; the joint of constant velocity beyond, in the file, makes the same motion."""
    joint = Tripod(joint_angle=20 * deg, track_radius=20 * mm, pivot=300 * mm)
    alone = Drive(joints=(joint,), duty=Duty(speed=1000 * rpm))
    shaft = Shaft(number=2, length=300 * mm)
    beyond = Drive(joints=(replace(joint, pivot=None), Rzeppa(joint_angle=0.0)), shafts=(shaft,), duty=alone.duty)
    one, other = (ask(drive).each for drive in (alone, beyond))
    assert one.max_angle_error[-1] / deg == pytest.approx(0.02162, abs=1e-5)
    for name in ("max_angle_error", "speed_fluctuation", "ratio_max", "max_acceleration"):
        assert getattr(one, name)[-1] == pytest.approx(getattr(other, name)[-1], rel=1e-9)
    assert "and so does the output" not in told(of(alone).sentence, USUAL)
    verdict = next(row for row in check(alone) if row.check == "acceleration")
    assert verdict.value == pytest.approx(9 * pivot_error(20 * deg, 20 * mm, 300 * mm) * (1000 * rpm) ** 2, rel=2e-2)
    straight = replace(alone, joints=(replace(joint, joint_angle=0.0),))
    assert "every joint turns uniformly by itself" in told(of(straight).sentence, USUAL)
    held = replace(alone, joints=(replace(joint, pivot=None),))
    assert "and so does the output" in told(of(held).sentence, USUAL)


@pytest.mark.parametrize(
    ("support", "binds"),
    [
        (Support(shaft=2, position=100 * mm), True),
        (Support(shaft=2, position=299.7 * mm), False),
        (Support(shaft=2, position=300 * mm, tilt=True), True),
        (Support(shaft=2, position=100 * mm, radial=False, axial=True), False),
    ],
)
def test_supports_that_keep_a_shaft_from_wobbling_are_told(support, binds):
    """Behind a joint in the file the motion warns; where the file says that the shaft pivots, it is refused."""
    joint = Tripod(joint_angle=20 * deg, track_radius=20 * mm)
    inner = Drive(
        joints=(joint, Rzeppa(joint_angle=0.1)), shafts=(Shaft(number=2, length=300 * mm),), supports=(support,)
    )
    assert any(one.code == "binding" for one in of(inner).remarks) == binds
    last = Drive(joints=(joint,), supports=(support,))
    pivoting = (replace(joint, pivot=300 * mm),)
    if binds:
        with pytest.raises(InputError, match=r"supports\[0\].position: shaft 2 pivots 300 mm behind joint 1"):
            replace(last, joints=pivoting)
    else:
        replace(last, joints=pivoting)
