"""Questions at many points: the fast way, the drive made anew, and JAX tell the same."""

import math
from dataclasses import replace

import numpy as np
import pytest

from cardan import (
    Drive,
    InputError,
    assembly,
    balance,
    equivalent_joint,
    example,
    life,
    losses,
    mobility,
    rotor_response,
    torsion_response,
)
from cardan.batch.answering.asking import evaluator
from cardan.batch.answering.many import many
from cardan.batch.answering.questions import questions
from cardan.batch.work import Status
from cardan.checks import check
from cardan.drive.duty import Duty
from cardan.drive.fields.paths import with_values
from cardan.io import loads
from cardan.questions.motion.answer import COLUMNS as MOTION
from cardan.questions.motion.turning import each_shaft
from cardan.questions.torsion.transient.answer import largest
from cardan.questions.torsion.transient.run_up_answer import follow
from cardan.register import QUESTIONS
from cardan.units import deg, rpm

TURN = np.linspace(0.0, 2.0 * np.pi, 7201)
RUNNING = Duty(speed=2000 * rpm)
ANGLES = replace(Drive.from_angles([0.3, 0.2, 0.25, 0.1], yoke_angles=[0.1, 0.2, 0.3]), duty=RUNNING)
POINTS = replace(
    Drive.from_points(
        [(0, 0, 0), (0.3, 0, 0), (1, 0.1, 0), (1.5, 0.1, 0.2), (2, 0, 0), (2.5, 0, 0)], yoke_angles=[0.1, 0.2, 0.3]
    ),
    duty=RUNNING,
)
SLOPES = loads(
    "format = 1\n[[joints]]\n[[joints]]\n[[shafts]]\nnumber = 1\nside_slope_deg = 0\n[[shafts]]\nnumber = 2\n"
    "side_slope_deg = 8\nplan_slope_deg = 3\n[[shafts]]\nnumber = 3\nside_slope_deg = 2\n[duty]\nspeed_rpm = 2000\n"
)
MIXED = loads(
    "format = 1\n[[joints]]\njoint_angle_deg = 12\n"
    '[[joints]]\nkind = "constant_velocity"\njoint_angle_deg = 20\n[[joints]]\n'
    "joint_angle_deg = 9\n[duty]\nspeed_rpm = 2000\n"
)
PAIR = replace(Drive.from_points([(0, 0, 0), (0.3, 0, 0), (1, 0.1, 0.1), (1.5, 0, 0)], yoke_angles=[0.3]), duty=RUNNING)
NAMES = [one.name for one in MOTION if one.name != "length"]
CASES = {
    "angles": (
        ANGLES,
        {"joints[1].joint_angle_deg": (-5, 95), "shafts[1].yoke_angle_deg": (-90, 90), "duty.speed_rpm": (1, 9)},
    ),
    "planes": (ANGLES, {"joints[2].plane_twist_deg": (-90, 90), "shafts[2].yoke_lead_deg": (0, 90)}),
    "points": (
        POINTS,
        {"joints[1].centre_mm[2]": (-400, 400), "output.point_m[0]": (1.9, 3.0), "input.start_phase_deg": (0, 180)},
    ),
    "pair": (PAIR, {"joints[1].centre_mm[2]": (-500, 900), "shafts[1].yoke_angle_deg": (0, 90)}),
    "slopes": (SLOPES, {"shafts[1].side_slope_deg": (-60, 60), "shafts[2].plan_slope_deg": (-80, 80)}),
    "mixed": (
        MIXED,
        {
            "joints[0].joint_angle_deg": (0, 91),
            "joints[1].joint_angle_deg": (0, 30),
            "shafts[1].yoke_angle_deg": (0, 90),
        },
    ),
}


def drawn(case, count=60):
    drive, ranges = CASES[case]
    rng = np.random.default_rng(3)
    points = np.stack([rng.uniform(*ends, count) for ends in ranges.values()], axis=-1)
    return drive, list(ranges), points


@pytest.mark.slow
@pytest.mark.parametrize("case", CASES)
def test_all_points_at_once_are_what_each_drive_made_anew_tells(case):
    drive, paths, points = drawn(case)
    names = NAMES + (["length"] if case == "points" else [])
    ask = evaluator(drive, paths, names)
    assert ask.fast
    found = ask(points)
    answered = found["status"] == 0
    assert 0 < answered.sum() < len(points) or case not in ("angles", "points")
    for k in range(len(points)):
        answers, status, _problems = ask.at(dict(zip(paths, points[k], strict=True)))
        assert found["status"][k] == status
        for name, value in answers.items():  # the same formulas; only the shapes of the arrays differ
            assert found[name][k] == pytest.approx(value, rel=1e-12, abs=1e-12)
    for column in ask.answers:
        assert np.array_equal(np.isnan(found[column.name]), ~answered)


@pytest.mark.slow
@pytest.mark.parametrize(("case", "names"), [("pair", NAMES), ("mixed", ["speed_fluctuation"])])
def test_jax_tells_what_numpy_tells(case, names):
    pytest.importorskip("jax")
    drive, paths, points = drawn(case, 33)
    here, there = (evaluator(drive, paths, names, device=device)(points) for device in ("cpu", "gpu"))
    assert np.array_equal(here["status"], there["status"])
    for name, values in here.items():  # other libraries round sines differently; α_eq is a root, hence 1e-8 near 0
        assert np.allclose(there[name], values, rtol=1e-9, atol=1e-8, equal_nan=True)


@pytest.mark.slow
def test_the_kernel_tells_what_plain_arrays_tell():
    drive, paths, points = drawn("points", 200)
    plain, compiled = (evaluator(drive, paths, NAMES, size=size)(points) for size in (0, 10**6))
    for name, values in plain.items():
        assert np.allclose(compiled[name], values, rtol=1e-9, atol=1e-8, equal_nan=True)


def test_answers_stand_in_the_unit_of_their_column():
    found = evaluator(ANGLES, ["joints[0].joint_angle_deg"], ["alpha_eq", "acceleration", "ratio"])(
        np.asarray([[10.0]])
    )
    joint = equivalent_joint(with_values(ANGLES, {"joints[0].joint_angle_deg": 10.0}))
    assert found["alpha_eq_deg"][0] == pytest.approx(joint.joint_angle / deg)
    assert found["output_acceleration_rad_s2"][0] == pytest.approx(joint.max_acceleration * (2000 * rpm) ** 2)
    assert found["ratio_max"][0] == pytest.approx(joint.ratio_max)


def test_other_fields_remake_the_drive():
    drive = example("truck-duty-cycle")
    ask = evaluator(drive, ["joints[2].size", "duty.shock_factor"], ["life", "speed_fluctuation"])
    assert not ask.fast
    given = {"joints[2].size": np.asarray(["example-150", "example-180"]), "duty.shock_factor": np.asarray([1.2, 1.2])}
    found = ask.rows(given, 2)
    assert found["life_h"][0] == pytest.approx(life(drive).drive / 3600.0)
    assert found["life_h"][1] > found["life_h"][0]
    assert found["speed_fluctuation_percent"][0] == found["speed_fluctuation_percent"][1]


def test_losses_over_friction():
    drive = example("pto-drive")
    path = "joints[0].friction"
    found = evaluator(drive, [path], ["losses"])(np.asarray([[0.01], [0.05]]))
    again = losses(with_values(drive, {path: 0.05}))
    assert found["heat_W"][1] == pytest.approx(again.heat)
    assert found["efficiency_percent"][1] == pytest.approx(100.0 * again.efficiency)


def test_a_point_that_makes_no_drive_says_so_and_why():
    ask = evaluator(ANGLES, ["joints[0].cross.span_mm"], ["speed_fluctuation"])
    assert ask(np.asarray([[60.0], [-1.0]]))["status"].tolist() == [Status.ANSWERED, Status.NO_DRIVE]
    problems = ask.at({"joints[0].cross.span_mm": -1.0})[2]
    assert problems[0].field == "joints[0].cross.span_mm"


def test_a_question_without_an_answer_leaves_the_others_theirs():
    ask = evaluator(ANGLES, ["duty.torque_Nm"], ["life", "speed_fluctuation"])
    found = ask(np.asarray([[100.0]]))
    assert found["status"][0] == Status.NO_ANSWER
    assert np.isnan(found["life_h"][0])
    share = float(equivalent_joint(ANGLES).speed_fluctuation)
    assert found["speed_fluctuation_percent"][0] == pytest.approx(100.0 * share)


def test_joints_with_laws_of_their_own_are_seen_over_a_turn():
    text = 'format = 1\n[[joints]]\nkind = "tracta"\njoint_angle_deg = 10\n'
    drive = loads(text.replace("tracta", "pin_coupling") + "driving_distance_mm = 50\ndriven_distance_mm = 52\n")
    ask = evaluator(drive, ["joints[0].joint_angle_deg"], ["speed_fluctuation", "alpha_eq", "joint_angle"])
    assert not ask.fast
    found = ask(np.asarray([[0.0], [10.0], [20.0]]))
    assert np.all(found["status"] == 0)
    assert (
        0.0
        <= found["speed_fluctuation_percent"][0]
        < found["speed_fluctuation_percent"][1]
        < found["speed_fluctuation_percent"][2]
    )
    assert np.allclose(found["joint_angle_deg[0]"], [0.0, 10.0, 20.0])


@pytest.mark.parametrize("joints", [1, 2])
def test_one_row_tells_of_a_wobble_what_motion_and_verdicts_tell(joints):
    tripod = '[[joints]]\nkind = "tripod"\njoint_angle_deg = 20\ntrack_radius_mm = 20\n'
    cross = "[[joints]]\njoint_angle_deg = 15\n[[shafts]]\nnumber = 2\nlength_mm = 300\n"
    drive = loads(f"format = 1\nduty.speed_rpm = 1000\n{tripod}{'pivot_mm = 300' if joints == 1 else cross}")
    ask = evaluator(drive, ["joints[0].joint_angle_deg"], ["speed_fluctuation", "phasing", "acceleration"])
    found = ask(np.asarray([[10.0], [20.0]]))
    assert np.all(found["status"] == 0)
    uneven, least = found["speed_fluctuation_percent"], found["least_speed_fluctuation_percent"]
    assert np.all(least <= uneven * (1.0 + 1e-9))
    assert np.all(uneven <= found["largest_speed_fluctuation_percent"] * (1.0 + 1e-9))
    if joints == 1:
        assert least == pytest.approx(uneven, rel=1e-9)
    told = [f"{name}_acceleration_rad_s2" for name in ("output", "drive", "coast")[: 1 if joints == 1 else 3]]
    for k, angle in enumerate((10.0, 20.0)):
        here = with_values(drive, {"joints[0].joint_angle_deg": angle})
        assert uneven[k] == pytest.approx(100.0 * each_shaft(here).speed_fluctuation[-1], rel=1e-9)
        judged = [float(row.value) for row in check(here) if row.check == "acceleration"]
        assert sorted(judged) == pytest.approx(sorted(found[name][k] for name in told), rel=1e-9)


def test_every_question_tells_columns_of_its_own():
    names = [told.name for one in questions().values() for told in one.columns(POINTS)]
    assert len(names) == len(set(names))
    for one in questions().values():
        assert (one.of_many is None) != (one.of_one is None)
        assert one.doc


DRIVES = {
    "critical_speed": "truck-duty-cycle",
    "natural_frequency": "unstable-drive",
    "stability": "unstable-drive",
    "tolerance": "instrument-joint",
    "forces": "truck-supports",
    "movement": "truck-rear-axle",
    "strength": "truck-duty-cycle",
    "check": "truck-duty-cycle",
    "mass": "truck-duty-cycle",
}


SAME = {
    "alternating_torque": ("pto-flywheel", lambda d: [np.max(torsion_response(d).swing)]),
    "balance": (
        "car-propshaft",
        lambda d: [
            min(one.limit for one in balance(d).shafts) / 1e-6,
            max(one.force for one in balance(d).shafts),
            max(100.0 * one.worst.unbalance / one.worst.allowed for one in balance(d).shafts if one.worst is not None),
        ],
    ),
    "whirl": ("car-propshaft", lambda d: [max(rotor_response(d).peak(k)[1] for k in (-1, 1, 2, 3)) / 1e-6]),
    "mobility": ("overconstrained-pump", lambda d: [mobility(d).mobility, 3]),
    "assembly": (
        "overconstrained-pump",
        lambda d: [max(np.max(one.radial), np.max(np.abs(one.axial))) for one in [assembly(d, angle=TURN)]] + [0, 3],
    ),
    "phasing": ("single-20deg", lambda d: 2 * [100.0 * math.sin(20 * deg) * math.tan(20 * deg)]),
    "run-up": ("pto-flywheel-absorber", lambda d: [abs(largest(follow(d, d.duty.run_up).motion)[1])]),
}
"""Question of a sweep -> example, and what it comes to as asked by itself."""


@pytest.mark.slow
@pytest.mark.parametrize("name", SAME)
def test_a_sweep_tells_what_the_question_tells_by_itself(name):
    example_name, alone = SAME[name]
    drive = example(example_name)
    answers, status, problems = evaluator(drive, [], [name]).at({})
    assert (status, problems) == (0, ())
    for value, same in zip(answers.values(), alone(drive), strict=False):
        if same:
            assert value == pytest.approx(same, rel=1e-6)  # peaks over a turn, against a fine grid


def test_every_question_that_has_a_number_has_a_column():
    without = {name for name, question in QUESTIONS.items() if not question.columns}
    others = "errors of formulas, designs, layouts, catalogue rows"
    assert without == {"classical", "absorber", "optimise", "layouts", "selection"}, others


@pytest.mark.slow
@pytest.mark.parametrize("name", DRIVES)
def test_questions_about_the_whole_drive_are_answered(name):
    drive = example(DRIVES[name])
    answers, status, problems = evaluator(drive, [], [name]).at({})
    assert (status, problems) == (0, ())
    assert all(np.isfinite(value) for value in list(answers.values())[:1])


@pytest.mark.parametrize(
    ("paths", "names", "expected"),
    [
        (["joints[0].joint_angle"], ["speed_fluctuation"], "needs a unit"),
        (["joints[9].joint_angle_deg"], ["speed_fluctuation"], "no index 9"),
        (["joints[0].joint_angle_deg", "joints[0].joint_angle_rad"], ["speed_fluctuation"], "varies twice"),
        (["joints[0].joint_angle_deg"], ["speed_fluctation"], "nearest is speed_fluctuation"),
        (["joints[0].joint_angle_deg"], [], "nothing is asked"),
        (["joints[0].joint_angle_deg"], ["length"], "joint centres"),
    ],
)
def test_what_cannot_be_asked_is_refused(paths, names, expected):
    with pytest.raises(InputError, match=expected):
        evaluator(Drive.from_angles([0.1, 0.1]), paths, names)


def test_an_acceleration_needs_a_speed_or_varies_it():
    bare = Drive.from_angles([0.1, 0.1])
    with pytest.raises(InputError, match=r"duty\.speed"):
        evaluator(bare, ["joints[0].joint_angle_deg"], ["acceleration"])
    assert evaluator(bare, ["duty.speed_rpm"], ["acceleration"])(np.asarray([[100.0]]))["status"].tolist() == [0]


def test_the_gpu_answers_motion_alone():
    with pytest.raises(InputError, match="GPU"):
        evaluator(example("truck-duty-cycle"), ["duty.torque_Nm"], ["life"], device="gpu")


@pytest.mark.parametrize("case", ["angles", "pair", "slopes", "mixed"])
def test_the_formulas_keep_to_the_array_standard(case):
    """Whatever library holds the arrays: nothing but the standard is asked of it."""
    import array_api_strict as xp

    drive, paths, points = drawn(case, 20)
    ask = evaluator(drive, paths, NAMES)
    si = {spot.bare: spot.si(points[:, k]) for k, spot in enumerate(ask.spots)}
    here, real = many(drive, si, 20)
    there, same = many(drive, si, 20, xp=xp)
    assert np.array_equal(np.asarray(same), real)
    for question in MOTION:
        if question.name != "length":
            for one, other in zip(question.of_many(here), question.of_many(there), strict=True):
                assert np.allclose(np.asarray(other), one, rtol=1e-9, atol=1e-8)
