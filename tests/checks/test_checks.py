import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from cardan import Drive, articulation, example, forces, load, motion
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.catalogue import completed
from cardan.checks import CHECKS, Verdict, check, design, utilisation
from cardan.checks.load_case import Case
from cardan.checks.torsion.line import NO_MODEL
from cardan.drive.accuracy import Inspection
from cardan.drive.cross import Cross
from cardan.drive.duty import Block, Duty, Limits, Upkeep, Vehicle
from cardan.drive.fields.keys import spelled
from cardan.drive.fields.paths import pose_drives, read, with_values
from cardan.drive.material import Material
from cardan.drive.models.geometry import geometry
from cardan.drive.models.kinematics_model import chain
from cardan.drive.movement import Body
from cardan.drive.shaft import Layup, Ply, Shaft, Spline, Unbalance
from cardan.errors import InputError
from cardan.io.examples import example_names, example_text
from cardan.questions.life.bearing_life import maker_life
from cardan.questions.motion.equivalence import largest_acceleration
from cardan.units import deg, hour, mm, rpm

SCALED = {"critical_speed": 3e-3, "half_critical": 3e-3, "bearing_life": 3e-3}
"""Checks whose exact answer is scaled by a closed formula where keys vary: a percent here moves it by so much less."""


def one(verdicts: tuple[Verdict, ...], name: str, title: str = "") -> Verdict:
    found = [v for v in verdicts if v.check == name and title in v.title]
    assert found, (name, title)
    return found[0]


def whole() -> Drive:
    """Three joints in space with everything that a check could ask for."""
    tube = Material(grade="C45")
    spline = Spline(
        teeth=16, outer=42 * mm, root=36 * mm, tooth_width=4 * mm, length=80 * mm, engaged=80 * mm, gap=40 * mm
    )
    drive = Drive.from_points([(-0.3, 0, 0), (0, 0, 0), (0.9, 0.02, -0.08), (2.1, 0.06, -0.3), (2.4, 0.06, -0.33)])
    joints = tuple(
        replace(joint, size="example-90", inspection=Inspection(coaxiality=0.03 * mm)) for joint in drive.joints
    )
    plane = Unbalance(position=0.1, amount=5e-5), Unbalance(position=0.8, amount=4e-5, angle=1.0)
    return completed(
        replace(
            drive,
            joints=joints,
            shafts=(
                Shaft(number=2, outer=80 * mm, wall=3 * mm, material=tube, yoke_angle=0.2, unbalance=plane),
                Shaft(
                    number=3,
                    outer=80 * mm,
                    wall=2.5 * mm,
                    material=tube,
                    spline=spline,
                    runout=0.2 * mm,
                    unbalance=plane[:1],
                ),
            ),
            duty=Duty(
                speed=2000 * rpm,
                speed_range=(500 * rpm, 2600 * rpm),
                torque=900.0,
                life=2000 * hour,
                shock_factor=1.3,
                balance_grade="G16",
                balance_class="truck_up_to_5t",
                vehicle=Vehicle(engine_torque=400.0, gear_ratio=3.0, wheelbase=3.8),
                upkeep=Upkeep(hours=100 * hour, distance=1e6, items=("needle_bearings", "spline_gaz66")),
                blocks=(
                    Block(torque=600.0, speed=1800 * rpm, share=0.7),
                    Block(torque=1100.0, speed=900 * rpm, share=0.3),
                ),
            ),
            limits=Limits(speed_fluctuation=0.02, output_error=1 * deg, spline_pressure=60e6, spline_overlap=50 * mm),
        )
    )


def vehicle(name):
    """Return an example whose duty has the limits of vehicles."""
    drive = example(name)
    return replace(drive, duty=replace(drive.duty, application="automotive"))


def test_every_file_of_a_check_is_listed():
    folder = Path(check.__code__.co_filename).parent
    files = {path.stem for path in folder.rglob("*.py") if "\nCHECK = " in path.read_text("utf-8")}
    assert files == set(CHECKS)


def test_a_full_drive_leaves_nothing_unjudged():
    lacking = {(v.check, v.missing) for v in check(whole()) if v.missing}
    torsion = {(name, NO_MODEL) for name in ("torsional_resonance", "parametric_stability", "torque_reversal")}
    line = {("whirl_amplitude", ("supports",))}  # two shafts hinged together, held at their far ends alone
    assert lacking == torsion | line | {("speed_angle", (f"joints[{i}].rating.speed_angle",)) for i in range(3)}


def test_every_verdict_has_what_a_reader_needs():
    for v in check(whole()):
        assert v.title
        if v.run:
            assert v.source
            assert math.isfinite(v.utilisation)
            assert v.state in ("passed", "unconfirmed", "close", "failed")


@pytest.mark.slow
def test_varying_a_key_is_the_same_as_a_drive_with_that_key():
    """Every design variable of every verdict: the batch against drives made one by one."""
    drive = whole()
    verdicts = check(drive)
    design_variables = {path for v in verdicts for path in v.design_variables}
    assert len(design_variables) > 60
    for design_variable in sorted(design_variables):
        moved = sorted({v.check for v in verdicts if design_variable in v.design_variables})
        path = spelled(design_variable)
        now = read(drive, path)
        values = [1.01 * now + 0.001, 0.99 * now] if isinstance(now, float) else [now + 1, now - 1]
        many = check(drive, only=moved, vary={path: values})
        for k, value in enumerate(values):
            try:
                single = check(with_values(drive, {path: value}), only=moved)
            except InputError:
                continue  # beyond the range of the field, on this side
            for a, b in zip(many, single, strict=True):
                assert a.title == b.title
                if a.run:
                    used = np.broadcast_to(a.utilisation, 2)[k]
                    assert used == pytest.approx(b.utilisation, rel=SCALED.get(a.check, 1e-9), abs=1e-12), (
                        path,
                        a.title,
                    )
            break
        else:
            pytest.fail(f"{path} cannot be changed")


@pytest.mark.slow
def test_the_levers_move_what_they_are_said_to_move():
    drive = whole()
    for design_variable in sorted({path for v in check(drive) for path in v.design_variables}):
        # The worst part of the duty, joint, shaft or plane decides: the others move nothing until they do.
        if any(
            word in design_variable for word in ("blocks", "torque", "speed", "centre", "point", "yoke_angle", "amount")
        ):
            continue
        path = spelled(design_variable)
        now = read(drive, path)
        values = [now, 1.05 * now + 1e-3 if isinstance(now, float) else now + 1]
        for v in check(drive, vary={path: values}):
            if design_variable in v.design_variables:
                used = np.broadcast_to(v.utilisation, 2)
                assert used[0] != used[1], (path, v.title)


@pytest.mark.parametrize("at", ["output", "input"])
def test_torques_and_couples_over_a_turn_are_those_of_statics(at):
    """Without masses, the balance of forces of the whole drive, position by position."""
    drive = Drive.from_angles([0.3, 0.5, 0.2], plane_twists=[0.4, 0.9], yoke_angles=[0.3, 1.0])
    span = 0.1
    drive = replace(
        drive,
        joints=tuple(replace(joint, cross=Cross(span=span)) for joint in drive.joints),
        shafts=tuple(Shaft(number=k, yoke_angle=a) for k, a in ((2, 0.3), (3, 1.0))),
    )
    case = Case(chain=chain(drive), torque=100.0, torque_at=at)
    angle = np.linspace(0, math.pi, 3601)
    found = forces(drive, Duty(speed=10.0, torque=100.0, torque_at=at), angle)
    load = np.max(found.journals.size, axis=(-2, -1))
    # 3600 positions on half a turn miss the peak by at most 1e-7 of it; 72 with a parabola by 1e-6.
    np.testing.assert_allclose(case.couple / span, load, rtol=3e-6)
    ratio = motion(drive, angle).shaft_ratio
    torque = 100.0 * (ratio[-1:] if at == "output" else ratio[:1]) / ratio
    np.testing.assert_allclose(case.torque_range[0], torque.min(-1), rtol=1e-6)
    np.testing.assert_allclose(case.torque_range[1], torque.max(-1), rtol=1e-6)


@pytest.mark.parametrize(("name", "rigid"), [("cured-drive", True), ("single-20deg", False)])
def test_the_acceleration_of_a_drive_that_vibrates_says_that_it_is_of_rigid_shafts(name, rigid):
    output, *inside = check(example(name), only=["acceleration"])
    assert ("of rigid shafts: torsional vibration is not in it" in told(output.note, USUAL)) is rigid
    assert not any("rigid" in told(one.note, USUAL) for one in inside)


def test_accelerations_are_the_largest_of_the_motion():
    drive = whole()
    turn = np.linspace(0, math.pi, 20001)
    there = motion(drive, turn, speed=2600 * rpm).shaft_acceleration
    verdicts = check(drive, only=["acceleration"])
    assert verdicts[0].value == pytest.approx(np.max(np.abs(there[-1])), rel=1e-6)
    assert verdicts[1].value == pytest.approx(np.max(np.abs(there[1:-1])), rel=1e-6)
    # With the output uniform: ω_i = ω s, s = r_i/r_out, and dt = r_out dφ_1/ω.
    found = motion(drive, turn)
    ratio, slope = found.shaft_ratio, found.shaft_slope
    swing = (slope[1:-1] * ratio[-1] - ratio[1:-1] * slope[-1]) / ratio[-1] ** 3
    assert verdicts[2].value == pytest.approx((2600 * rpm) ** 2 * np.max(np.abs(swing)), rel=1e-6)


def test_two_equal_joints_have_the_small_angle_values_of_the_norm():
    drive = replace(Drive.from_angles([3 * deg, 3 * deg]), duty=Duty(speed=2000 * rpm))
    output, in_drive, in_coast = check(drive, only=["acceleration"])
    small = (2000 * rpm) ** 2 * (3 * deg) ** 2
    assert output.value == pytest.approx(0.0, abs=1e-9)
    assert in_drive.value == pytest.approx(small, rel=2e-3)  # fourth order in the angle
    assert in_coast.value == pytest.approx(in_drive.value, rel=1e-12)
    assert (in_drive.limit, in_coast.limit) == (1000.0, 1000.0)


def test_a_joint_alone_bends_its_tube_as_the_book_has_it():
    tube = Shaft(number=2, outer=80 * mm, wall=3 * mm, material=Material(yield_strength=300e6))
    drive = replace(Drive.from_angles([20 * deg]), shafts=(tube,), duty=Duty(torque=1000.0))
    found = check(drive, only=["tube_strength"])[0]
    resisting = math.pi * (0.08**4 - 0.074**4) / 16 / 0.08
    couple = 1000.0 * math.tan(20 * deg)
    assert found.value == pytest.approx(math.hypot(2 * couple, math.sqrt(3) * 1000.0) / resisting, rel=1e-6)
    assert found.limit == pytest.approx(200e6)
    own = check(replace(drive, limits=Limits(shear_stress=50e6)), only=["tube_strength"])[0]
    assert own.value == pytest.approx(1000.0 / math.cos(20 * deg) / resisting, rel=1e-6)


@pytest.mark.parametrize("convention", ["Tc", "CR", "book"])
def test_the_rated_torque_is_that_which_lasts_the_life(convention):
    drive = whole()
    joint = drive.joints[0]
    rating = replace(joint.rating, convention=convention)
    duty = Duty(speed=1500 * rpm, torque=800.0, life=3000 * hour, shock_factor=1.2)
    found = check(
        replace(drive, joints=(replace(joint, rating=rating), *drive.joints[1:]), duty=duty), only=["rated_torque"]
    )[0]
    rated = rating.torque if convention != "book" else rating.torque / 2.6
    life = maker_life(
        rated, found.limit, speed=1500 * rpm, joint_angle=design(drive).joint_angle[0], convention=convention
    )
    assert float(life) == pytest.approx(3000 * hour, rel=1e-12)
    assert found.value == pytest.approx(1.2 * 800.0, rel=2e-2)  # the joints make the torque swing a little


def test_parts_of_a_duty_cycle_do_the_damage_of_their_time():
    drive = whole()
    steady = replace(drive.duty, torque=None, blocks=())
    halves = (Block(torque=700.0, speed=1000 * rpm, share=0.5), Block(torque=700.0, speed=1000 * rpm, share=0.5))
    alone = check(drive, replace(steady, torque=700.0, speed=1000 * rpm), only=["rated_torque"])
    parts = check(drive, replace(steady, speed=None, blocks=halves), only=["rated_torque"])
    idle = (
        replace(halves[0], share=0.25),
        replace(halves[1], share=0.25),
        Block(torque=0.0, speed=1000 * rpm, share=0.5),
    )
    rests = check(drive, replace(steady, speed=None, blocks=idle), only=["rated_torque"])
    assert [v.utilisation for v in parts] == pytest.approx([v.utilisation for v in alone])
    assert [v.utilisation for v in rests] == pytest.approx([v.utilisation * 0.5**0.3 for v in alone])


def test_the_worst_part_of_the_duty_decides_and_is_named():
    drive = whole()
    found = check(drive, only=["joint_torque"])[0]
    assert "part 2" in found.note
    steep = replace(drive.duty, blocks=(Block(torque=10.0, speed=100.0, share=1.0, joint_angle=31 * deg),))
    assert [v.state for v in check(drive, steep, only=["joint_angle"])] == ["failed"] * 3


def test_a_critical_speed_goes_with_the_square_of_the_length():
    tube = Shaft(number=2, outer=76 * mm, inner=72 * mm, length=1.5, material=Material(youngs=2.1e11))
    drive = replace(Drive.from_angles([0.05, 0.05]), shafts=(tube,), duty=Duty(speed=3000 * rpm))
    found = check(drive, only=["critical_speed"])[0]
    # Book (257) with E 210 GPa; the line as a whole knows of shear and rotary inertia.
    assert found.value * 3000 == pytest.approx(5670.335, rel=1e-2)
    unheld = replace(drive, joints=(*drive.joints, drive.joints[0]))
    assert check(unheld, only=["critical_speed"])[0].value * 3000 == pytest.approx(5670.335, rel=1e-6)
    long = check(drive, only=["critical_speed"], vary={"shafts[1].length_mm": [750.0, 1500.0]})[0]
    assert long.value[0] == pytest.approx(4 * long.value[1])


def test_running_at_half_the_critical_speed_fails_and_passing_it_is_advice():
    tube = Shaft(number=2, outer=76 * mm, inner=72 * mm, length=1.5, material=Material(youngs=2.1e11))
    drive = replace(Drive.from_angles([0.05, 0.05]), shafts=(tube,), duty=Duty(speed=2835 * rpm))
    assert check(drive, only=["half_critical"])[0].state == "failed"
    passing = replace(drive, duty=Duty(speed=2000 * rpm, speed_range=(600 * rpm, 3500 * rpm)))
    running, through = check(passing, only=["half_critical"])
    assert running.state == "passed"
    assert through.advice
    assert through.state == "failed"


def test_a_composite_tube_buckles_in_proportion():
    ply = Ply(along=135e9, across=10e9, shear=5e9)
    layup = Layup(angles=(0.2, -0.2, 1.0, -1.0), ply_thickness=0.5 * mm, ply=ply)
    shaft = Shaft(number=2, outer=92 * mm, length=1.8, layup=layup)
    drive = replace(Drive.from_angles([0.05, 0.05]), shafts=(shaft,), duty=Duty(speed=100.0, torque=500.0))
    many = check(drive, only=["tube_buckling"], vary={"shafts[1].layup.ply_thickness_mm": [0.5, 0.75]})[0]
    thick = replace(drive, shafts=(replace(shaft, layup=replace(layup, ply_thickness=0.75 * mm)),))
    assert many.limit[1] == pytest.approx(check(thick, only=["tube_buckling"])[0].limit, rel=1e-12)
    assert one(check(drive), "critical_speed").run


def test_lubrication_is_due_at_the_interval():
    drive = Drive.from_angles([0.1])
    due = check(drive, Duty(upkeep=Upkeep(hours=500 * hour)), only=["lubrication"])
    soon = check(drive, Duty(upkeep=Upkeep(hours=499 * hour)), only=["lubrication"])
    severe = check(drive, Duty(upkeep=Upkeep(hours=499 * hour, severe=True)), only=["lubrication"])
    assert [v[0].state for v in (due, soon, severe)] == ["failed", "close", "failed"]


def test_what_is_missing_is_named_with_its_path():
    lacking = {v.check: v.missing for v in check(Drive.from_angles([0.1, 0.1]))}
    assert lacking["tube_strength"] == ("shafts[1].outer", "shafts[1].material.yield_strength", "duty.torque")
    assert "joints[1].cross.span" in lacking["journal_strength"]
    assert lacking["acceleration"] == ("duty.speed",)
    assert "design_torque" not in lacking  # no vehicle stands behind this drive


def test_a_check_that_is_not_known_is_refused():
    with pytest.raises(InputError, match="the nearest is joint_angle"):
        check(Drive.from_angles([0.1]), only=["joint_angel"])


@pytest.mark.parametrize("sense", ["at_most", "at_least", "within", "outside"])
def test_utilisation_is_at_most_one_exactly_when_the_limit_is_kept(sense):
    value = np.linspace(0.5, 3.0, 251)
    limit = (1.0, 2.0) if sense in ("within", "outside") else 1.5
    kept = {
        "at_most": value <= 1.5,
        "at_least": value >= 1.5,
        "within": (value >= 1.0) & (value <= 2.0),
        "outside": (value <= 1.0) | (value >= 2.0),
    }[sense]
    assert np.array_equal(utilisation(value, limit, sense) <= 1.0, kept)
    assert utilisation(-1.0, 1.5, "at_least") == math.inf


def test_the_worst_pose_counts_and_is_named():
    drive = example("rolling-mill-upper-spindle")
    drive = replace(drive, limits=replace(drive.limits, joint_angle=4 * deg))
    found = check(drive, only=["joint_angle"])[0]
    steepest = max(float(geometry(one).joint_angle[0]) for one in pose_drives(drive))
    assert found.value == pytest.approx(steepest)
    assert "roll change" in found.note
    assert check(replace(drive, poses=()), only=["joint_angle"])[0].value < found.value


def test_what_a_movement_makes_of_bends_and_splines_counts():
    drive = example("pto-hitch")
    drive = replace(drive, limits=replace(drive.limits, joint_angle=10 * deg, speed_fluctuation=0.01))
    moved = {(one.what, one.number): one for one in articulation(drive).worst}
    joint_angle, uneven, spline = (
        check(drive, only=[name])[0] for name in ("joint_angle", "speed_fluctuation", "spline_overlap")
    )
    # Found on their own, to the same tops: flat there, so that they agree to rounding of the place squared.
    assert joint_angle.value == pytest.approx(moved["joint_angle", 1].value, rel=1e-9)
    assert joint_angle.value > geometry(drive).joint_angle[0]
    assert uneven.value == pytest.approx(moved["speed_fluctuation", 3].value, rel=1e-9)
    assert told(uneven.note, USUAL) == "while the drive moves, at 3.48 s"
    assert spline.value == pytest.approx(articulation(drive).splines[0].engaged_min)
    assert spline.limit == pytest.approx(0.150)


@pytest.mark.slow
def test_splines_of_a_pose_are_reckoned_from_the_drawn_length():
    """The file says engaged length and gap as drawn: a pose has used some of them before it moves."""
    drive = example("truck-rear-axle")
    drawn = geometry(drive).length[1]
    reach = [
        one
        for posed in (replace(drive, poses=()), *pose_drives(drive))
        for one in (articulation(posed).splines[0].length_min, articulation(posed).splines[0].length_max)
    ]
    engaged, gap = check(drive, only=["spline_overlap"])
    assert engaged.value == pytest.approx(0.110 - (max(reach) - drawn))
    assert gap.value == pytest.approx(0.060 - (drawn - min(reach)))
    moving = "while the drive moves; in the pose {}".format
    assert (told(engaged.note, USUAL), told(gap.note, USUAL)) == (moving("empty"), moving("full load"))
    still = check(replace(drive, movements=()), only=["spline_overlap"])
    lengths = [float(geometry(posed).length[1]) for posed in pose_drives(drive)]
    assert [one.value for one in still] == pytest.approx([0.110 - max(lengths) + drawn, 0.060 - drawn + min(lengths)])
    assert [one.note for one in still] == ["in the pose empty", "in the pose full load"]


@pytest.mark.slow
def test_advice_on_bends_is_judged_while_the_drive_moves():
    drive = vehicle("pto-hitch")
    joint_angles = articulation(drive, times=np.linspace(0.0, 10.0, 20_001)).joint_angle
    assert np.max(geometry(drive).joint_angle) == 0.0
    found = check(drive, only=["angle_rule", "joint_angle_at_speed", "angle_table"])
    largest, apart, table, at_speed = found
    notes = [told(v.note, USUAL) for v in found]
    assert notes == [f"while the drive moves, at {time} s" for time in ("2.56", "3.72", "2.56", "2.56")]
    assert largest.value == at_speed.value == table.value == pytest.approx(np.max(joint_angles), rel=1e-6)
    assert apart.value == pytest.approx(np.max(np.abs(joint_angles[:, 0] - joint_angles[:, 1])), rel=1e-6)
    speed = drive.duty.speed
    assert table.passed == (np.max(np.abs(joint_angles[:, 0] ** 2 - joint_angles[:, 1] ** 2)) * speed**2 <= 400.0)
    quick = check(replace(drive, duty=replace(drive.duty, speed=30.0 * speed)), only=["angle_table"])[0]
    assert quick.state == "failed"


@pytest.mark.slow
def test_the_table_of_angles_judges_a_moving_drive_alike_alone_and_among_others():
    """One joint keeps 10°, the other swings by 5° about less or more: whether the larger bend is the drawn one or not,
    √(largest² - largest difference² + a/ω²) is the limit, in a batch as alone."""
    drive, path = with_values(vehicle("pto-hitch"), {"duty.speed_rpm": 1000.0}), "output.point_mm[2]"
    swing = Body(moves=("output",), pivot=(1.0, 0.0, 0.0), pitch=5 * deg, frequency=1.0)
    start = (-0.4, 0.0, 0.4 * math.tan(10 * deg))
    drive = replace(drive, input=replace(drive.input, point=start), movements=(swing,))
    values = [-37.0, -12.0]  # 14° or 4.6° as drawn
    many = check(drive, only=["angle_table"], vary={path: values})[0]
    for k, value in enumerate(values):
        alone = with_values(drive, {path: value})
        single = check(alone, only=["angle_table"])[0]
        joint_angles = articulation(alone, times=np.linspace(0.0, 2.0 * np.pi, 20_001)).joint_angle
        high, apart = np.max(joint_angles), np.max(np.abs(joint_angles[:, 0] ** 2 - joint_angles[:, 1] ** 2))
        limit = math.sqrt(max(high**2 - apart, 0.0) + 400.0 / drive.duty.speed**2)
        assert (many.value[k], many.limit[k]) == pytest.approx((high, limit), rel=1e-6)
        assert single.utilisation == pytest.approx(many.utilisation[k], rel=1e-12)


def test_the_table_of_angles_has_a_limit_where_a_joint_comes_to_bend_90_degrees():
    drive = with_values(vehicle("pto-hitch"), {"joints[1].centre_mm[1]": -300.0})
    with np.errstate(all="raise"):
        found = check(drive, only=["angle_table"])[0]
    assert (found.value, found.state) == (math.inf, "failed")
    assert 0.0 < found.limit <= 45 * deg


def test_a_value_at_its_limit_but_for_rounding_keeps_it():
    drive = Drive.from_angles([6.000000000000001 * deg, 6 * deg])
    assert check(drive, only=["angle_rule"])[0].utilisation == 1.0
    assert utilisation(1.0 - 1e-12, 1.0, "at_least") == 1.0
    assert utilisation(1.0 + 1e-6, 1.0, "at_most") > 1.0


@pytest.mark.slow
@pytest.mark.parametrize("name", ["truck-rear-axle", "pto-hitch"])
def test_many_drives_that_move_and_have_poses_are_judged_as_one_by_one(name):
    drive = vehicle(name)
    drive = replace(
        drive, limits=replace(drive.limits, joint_angle=10 * deg, speed_fluctuation=0.01, output_error=0.1 * deg)
    )
    only = [
        "joint_angle",
        "speed_fluctuation",
        "output_error",
        "acceleration",
        "angle_rule",
        "angle_table",
        "joint_angle_at_speed",
    ]
    for path, values in {"joints[0].centre_mm[2]": [-9.0, 6.0], "joints[1].centre_mm[2]": [-300.0, 20.0]}.items():
        many = check(drive, only=only, vary={path: values})
        for k, value in enumerate(values):
            for a, b in zip(many, check(with_values(drive, {path: value}), only=only), strict=True):
                assert np.broadcast_to(a.utilisation, 2)[k] == pytest.approx(b.utilisation, rel=1e-12), (path, a.title)


@pytest.mark.parametrize("name", ["truck-rear-axle", "pto-hitch"])
def test_splines_of_many_drives_that_move_are_those_of_one_by_one(name):
    drive = example(name)
    for path, values in {"joints[1].centre_mm[1]": [-300.0, 20.0], "shafts[1].spline.gap_mm": [50.0, 90.0]}.items():
        many = check(drive, only=["spline_overlap"], vary={path: values})
        for k, value in enumerate(values):
            single = check(with_values(drive, {path: value}), only=["spline_overlap"])
            for a, b in zip(many, single, strict=True):
                assert np.broadcast_to(a.value, 2)[k] == pytest.approx(b.value, rel=1e-9), (path, a.title)


def test_splines_of_very_many_drives_are_nearly_those_of_one_by_one():
    """Looked at in fewer instants: a parabola through three of 40 steps misses a few 1e-4 of a stroke of 0.15 m."""
    drive, path = example("pto-hitch"), "joints[1].centre_mm[1]"
    places = np.linspace(-300.0, 300.0, 61)
    many = check(drive, only=["spline_overlap"], vary={path: places})
    for k in (0, 25, 60):
        for a, b in zip(many, check(with_values(drive, {path: places[k]}), only=["spline_overlap"]), strict=True):
            assert a.value[k] == pytest.approx(b.value, abs=5e-5)


@pytest.mark.parametrize(
    ("path", "why"),
    [
        ("movements[0].yaw_deg", "is not varied in a batch"),
        ("duty.reliability_percent", "is not varied in a batch"),
        ("shafts[0].yoke_angle_deg", "shaft 1 is an end shaft"),
        ("shafts[2].yoke_angle_deg", "shaft 3 is an end shaft"),
    ],
)
def test_what_a_batch_cannot_honour_is_refused(path, why):
    with pytest.raises(InputError, match=why) as refused:
        check(example("pto-hitch"), vary={path: [60.0, 70.0]})
    assert [one.field for one in refused.value.problems] == [path]


@pytest.mark.parametrize(
    ("path", "values"),
    [
        ("joints[0].plane_twist_deg", [40.0, 90.0]),
        ("joints[0].error.s1_mm", [1.0, 2.0]),
        ("duty.vehicle.wheelbase_mm", [3000.0, 5000.0]),
    ],
)
def test_what_bears_on_little_changes_a_batch_no_more_than_a_drive(path, values):
    """The first plane turns the whole drive and no joint against another."""
    drive = whole()
    if "plane_twist" in path:
        joint_angles = geometry(drive).joint_angle
        drive = replace(Drive.from_angles(list(joint_angles), plane_twists=[0.3, 0.4]), duty=drive.duty)
    only = ["speed_fluctuation", "output_error", "acceleration", "layout", "part_accuracy"]
    many = check(drive, only=only, vary={path: values})
    for k, value in enumerate(values):
        for a, b in zip(many, check(with_values(drive, {path: value}), only=only), strict=True):
            if a.run:
                used = np.broadcast_to(a.utilisation, 2)[k]
                assert used == pytest.approx(b.utilisation, rel=1e-9, abs=1e-12), a.title


def test_the_limit_of_the_bends_may_vary():
    drive = replace(Drive.from_angles([0.1]), limits=Limits(joint_angle=0.2))
    assert list(check(drive, only=["joint_angle"], vary={"limits.joint_angle_deg": [5.0, 6.0]})[0].limit / deg) == [
        5.0,
        6.0,
    ]


def test_a_joint_that_passes_a_right_angle_while_it_moves_is_seen():
    turn = replace(example("pto-hitch").movements[0], yaw=200 * deg)
    drive = replace(example("pto-hitch"), movements=(turn,))
    drive = replace(drive, limits=replace(drive.limits, joint_angle=45 * deg, speed_fluctuation=0.5))
    joint_angle, _other, uneven = check(drive, only=["joint_angle", "speed_fluctuation"])
    assert joint_angle.value > 90 * deg
    assert (uneven.value, uneven.state) == (math.inf, "failed")


def test_a_drive_of_a_makers_own_series_is_judged_as_it_was_loaded(tmp_path):
    rows = '[[joint_sizes]]\nid = "own"\nsource = "s"\ncross = { span_mm = 60, journal_mm = 20 }\n'
    (tmp_path / "own.toml").write_text(rows, "utf-8")
    text = 'format = 1\nsettings.catalogues = ["own.toml"]\n[[joints]]\njoint_angle_deg = 5\nsize = "own"\n'
    (tmp_path / "drive.toml").write_text(text, "utf-8")
    drive = load(tmp_path / "drive.toml")
    assert drive.joints[0].cross.span == 0.060
    assert check(drive, Duty(torque=100.0), only=["needle_static"])[0].missing == ("joints[0].needles.static_capacity",)


@pytest.mark.slow
@pytest.mark.parametrize("name", example_names())
def test_a_shipped_drive_that_fails_says_so_in_its_file(name):
    head = example_text(name).partition("\nformat")[0]
    failed = any(one.state == "failed" and not one.advice for one in check(example(name)))
    assert ("`cardan check" in head and "fails" in head) is failed


def test_inside_shafts_swing_hardest_where_the_movement_bends_most():
    drive = vehicle("pto-hitch")
    output, in_drive, _coast = check(drive, only=["acceleration"])
    joint_angle = max(one.value for one in articulation(drive).worst if (one.what, one.number) == ("joint_angle", 1))
    assert in_drive.value == pytest.approx(drive.duty.speed**2 * largest_acceleration(joint_angle), rel=1e-9)
    notes = [told(one.note, USUAL) for one in (in_drive, output)]
    assert notes == ["while the drive moves, at 2.44 s", "while the drive moves, at 3.48 s"]


def test_shocks_count_in_the_book_s_rule_for_needles_too():
    drive = whole()
    steady = replace(drive.duty, blocks=(), shock_factor=1.3)
    rest, rule = (
        one(check(drive, steady, only=["needle_static"]), "needle_static", title) for title in ("rest", "book")
    )
    assert rule.value == pytest.approx(rest.value, rel=1e-12)
