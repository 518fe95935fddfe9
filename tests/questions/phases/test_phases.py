"""Every setting that phases() returns is judged by plain vectors, not by the matrices that found it."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cardan import Drive, InputError, example, phases
from cardan.drive.fields.paths import pose_drives
from cardan.drive.joints import Hooke
from cardan.drive.shaft import Shaft
from cardan.questions.phases.setting import NEAREST, SYNCHRONOUS, LeastIntermediate
from cardan.units import deg
from tests.builders import closing
from tests.builders.drives import plans

TRUCK_JOINT_ANGLES = (11.5 * deg, (15 + 20 / 60) * deg, 15 * deg, 16.5 * deg)
TRUCK_TWISTS = (1.9 * deg, -(22 + 56 / 60) * deg, (49 + 59 / 60) * deg)
TRUCK = Drive.from_angles(TRUCK_JOINT_ANGLES, plane_twists=TRUCK_TWISTS)

# The vector model has the rounding of three sampled ratios of order one.
VECTORS = 2e-14


def left(drive, setting):
    joint_angles = np.asarray([joint.joint_angle for joint in drive.joints])
    twists = np.asarray([joint.plane_twist for joint in drive.joints[1:]])
    return float(closing.speed_fluctuation(joint_angles, twists, setting.yoke_angle))


def test_the_truth_agrees_with_sampled_extremes():
    from tests.builders.vector_model import VectorModel

    model = VectorModel.from_angles(TRUCK_JOINT_ANGLES, TRUCK_TWISTS, (0.3, -0.8, 1.1))
    exact = closing.speed_fluctuation(
        np.asarray(TRUCK_JOINT_ANGLES), np.asarray(TRUCK_TWISTS), np.asarray((0.3, -0.8, 1.1))
    )
    assert model.speed_fluctuation() == pytest.approx(float(exact), abs=1e-9)


def test_truck_by_its_printed_angles_becomes_synchronous():
    found = phases(TRUCK)
    assert found.feasible
    assert found.speed_fluctuation_max == pytest.approx(0.267279703673143, abs=2e-7)
    assert found.joint_angle_max / deg == pytest.approx(28.92537165792767, rel=1e-6)
    assert found.as_built.speed_fluctuation == pytest.approx(0.1251154, abs=1e-7)
    assert [s.label for s in found.settings] == ["A", "B", "C"]
    assert all(s.speed_fluctuation < 1e-14 and left(TRUCK, s) < VECTORS for s in found.settings)


def test_truck_with_one_yoke_held_has_the_two_known_solutions():
    found = phases(TRUCK, fixed={2: 90 * deg})
    a, b = found.settings
    assert found.free == (3, 4)
    assert found.fixed == (2,)
    # Known to five decimals of a degree.
    assert a.yoke_angle / deg == pytest.approx([90.0, -1.69992, 82.84475], abs=6e-6)
    assert b.yoke_angle / deg == pytest.approx([90.0, 46.20406, -2.81141], abs=6e-6)
    assert a.speed_fluctuation < 1e-14
    assert b.speed_fluctuation < 1e-14
    # Per degree of each yoke, known to two figures.
    assert a.sensitivity * deg == pytest.approx([0.0014, 0.0039, 0.0029], abs=6e-5)
    psi = np.rad2deg(a.initial_phase[1:] - np.pi * np.round(a.initial_phase[1:] / np.pi))
    assert psi == pytest.approx([-1.9, -(67 + 20.2 / 60), 69 + 8.2 / 60], abs=1e-3)


@pytest.mark.parametrize(
    ("joint_angles", "smallest", "largest", "limiting"),
    [
        ((10, 10, 25), 0.13562101623065323, 0.25870400373091657, 3),
        ((12, 20), 0.08023702197701524, 0.16879405450616744, 2),
        ((20,), np.sin(20 * deg) * np.tan(20 * deg), np.sin(20 * deg) * np.tan(20 * deg), 1),
    ],
)
def test_an_infeasible_drive_gets_its_bound_and_the_joint_to_blame(joint_angles, smallest, largest, limiting):
    drive = Drive.from_angles([b * deg for b in joint_angles], plane_twists=[0.3] * (len(joint_angles) - 1))
    found = phases(drive)
    assert not found.feasible
    assert found.speed_fluctuation_min == pytest.approx(smallest, rel=1e-7)
    assert found.speed_fluctuation_max == pytest.approx(largest, rel=1e-7)
    assert found.limiting_joint == limiting
    for setting in found.settings:
        assert left(drive, setting) == pytest.approx(found.speed_fluctuation_min, abs=VECTORS)


@pytest.mark.slow
@given(plans(least=2, most=6, joint_angle=35 * deg))
def test_what_is_returned_is_what_was_proved(plan):
    found = phases(plan.drive)
    for setting in found.settings:
        assert left(plan.drive, setting) == pytest.approx(found.speed_fluctuation_min, abs=VECTORS)
        assert ((setting.yoke_angle > -np.pi / 2) & (setting.yoke_angle <= np.pi / 2)).all()
    assert (
        found.speed_fluctuation_min - VECTORS
        <= found.as_built.speed_fluctuation
        <= found.speed_fluctuation_max + VECTORS
    )
    exact = np.log(np.cos(plan.joint_angles))
    assert found.feasible == (2 * exact.min() >= exact.sum() - 1e-14)


@pytest.mark.slow
@given(plans(least=3, most=6, joint_angle=35 * deg), st.data())
def test_with_yokes_held_no_other_choice_is_better(plan, data):
    held = data.draw(st.sets(st.integers(2, len(plan.joint_angles)), min_size=1))
    fixed = {k: data.draw(st.floats(-2.0, 2.0)) for k in sorted(held)}
    found = phases(plan.drive, fixed=fixed)
    for setting in found.settings:
        assert left(plan.drive, setting) == pytest.approx(found.speed_fluctuation_min, abs=VECTORS)
        for k, angle in fixed.items():
            assert np.sin(setting.yoke_angle[k - 2] - angle) == pytest.approx(0.0, abs=1e-14)
    others = np.random.default_rng(0).uniform(-np.pi, np.pi, (200, len(plan.joint_angles) - 1))
    for k, angle in fixed.items():
        others[:, k - 2] = angle
    uneven = closing.speed_fluctuation(np.asarray(plan.joint_angles), np.asarray(plan.plane_twists), others)
    assert uneven.min() >= found.speed_fluctuation_min - VECTORS
    assert uneven.max() <= found.speed_fluctuation_max + VECTORS


def test_yokes_held_by_the_drive_file_stay():
    drive = Drive(
        joints=tuple(
            Hooke(joint_angle=b, plane_twist=t) for b, t in zip(TRUCK_JOINT_ANGLES, (0.0, *TRUCK_TWISTS), strict=True)
        ),
        shafts=(Shaft(number=2, yoke_angle=90 * deg, yoke_fixed=True),),
    )
    found = phases(drive)
    assert found.fixed == (2,)
    assert found.settings[0].yoke_angle / deg == pytest.approx([90.0, -1.69992, 82.84475], abs=6e-6)


def test_the_mirror_of_three_joints_has_the_same_shafts():
    a, b = phases(Drive.from_angles([10 * deg, 15 * deg, 17 * deg], plane_twists=[0.4, -1.2])).settings
    np.testing.assert_allclose(a.shaft_speed_fluctuation, b.shaft_speed_fluctuation, atol=1e-15)
    assert np.abs(np.sin(a.yoke_angle - b.yoke_angle)).max() > 0.1
    # conjugate once the first corner lies on the real axis
    turned = [s.vertex / s.vertex[1] for s in (a, b)]
    np.testing.assert_allclose(turned[0], np.conj(turned[1]), atol=1e-14)


@pytest.mark.slow
@pytest.mark.parametrize("n", [4, 5])
def test_the_default_member_has_the_calmest_intermediate_shafts(n):
    random = np.random.default_rng(n)
    for _ in range(4):
        joint_angles, twists = random.uniform(5, 20, n) * deg, random.uniform(-3, 3, n - 1)
        found = phases(Drive.from_angles(joint_angles, plane_twists=twists))
        if not found.feasible:
            continue
        best = found.settings[0].shaft_speed_fluctuation[:-1].sum()
        assert best == pytest.approx(brute_least(joint_angles), rel=2e-3)
        assert best <= brute_least(joint_angles) + 1e-12


def brute_least(joint_angles):
    """Return the least Σ δ of intermediate shafts over a fine grid of the diagonals, by the triangle inequality."""
    lengths = -np.log(np.cos(joint_angles))
    grids = np.meshgrid(
        *[np.linspace(0.0, lengths.sum(), 1200 if len(joint_angles) == 5 else 40000)] * (len(joint_angles) - 3)
    )
    walk = [lengths[0] + 0 * grids[0], *grids, lengths[-1] + 0 * grids[0]]
    fits = np.ones_like(grids[0], dtype=bool)
    for k in range(1, len(walk)):
        side = lengths[k]
        fits &= (np.abs(walk[k] - walk[k - 1]) <= side) & (walk[k] + walk[k - 1] >= side)
    total = 2 * sum(np.sinh(w) for w in walk)
    return float(total[fits].min())


def test_weights_choose_which_shaft_is_calm():
    joint_angles = [12 * deg, 15 * deg, 14 * deg, 13 * deg, 16 * deg]
    drive = Drive.from_angles(joint_angles, plane_twists=[0.1, 0.2, 0.3, 0.4])
    third = phases(drive, goal=LeastIntermediate(weights=(0, 1, 0, 0))).settings[0].shaft_speed_fluctuation
    fourth = phases(drive, goal=LeastIntermediate(weights=(0, 0, 1, 0))).settings[0].shaft_speed_fluctuation
    assert third[1] < fourth[1]
    assert fourth[2] < third[2]
    weighted = Drive.from_angles(joint_angles, plane_twists=[0.1, 0.2, 0.3, 0.4])
    shafts = tuple(Shaft(number=s.number, weight=float(s.number == 3)) for s in weighted.shafts[1:-1])
    by_file = phases(Drive(joints=weighted.joints, shafts=shafts)).settings[0].shaft_speed_fluctuation
    np.testing.assert_allclose(by_file, third, atol=1e-12)


@pytest.mark.slow
def test_the_nearest_member_is_nearer_than_any_other():
    random = np.random.default_rng(7)
    joint_angles, twists, yokes = random.uniform(8, 18, 4) * deg, random.uniform(-3, 3, 3), random.uniform(-1, 1, 3)
    found = phases(Drive.from_angles(joint_angles, plane_twists=twists, yoke_angles=yokes), goal=NEAREST)
    best = (found.settings[0].change ** 2).sum()
    # Three yokes, two conditions: a line of solutions. Walk it by turning the first yoke and closing the rest exactly.
    least = np.inf
    for first in np.linspace(-np.pi / 2, np.pi / 2, 721):
        rest = phases(Drive.from_angles(joint_angles, plane_twists=twists, yoke_angles=yokes), fixed={2: float(first)})
        if rest.feasible:
            least = min(least, *((s.change**2).sum() for s in rest.settings))
    assert best <= least + 1e-9
    assert best == pytest.approx(least, abs=2e-3)
    assert found.settings[0].speed_fluctuation < 1e-14


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2])
def test_a_family_with_held_yokes_minimises_its_goal(seed):
    random = np.random.default_rng(seed)
    joint_angles, twists = random.uniform(8, 18, 5) * deg, random.uniform(-3, 3, 4)
    drive = Drive.from_angles(joint_angles, plane_twists=twists)
    found = phases(drive, fixed={3: 0.4}, goal=SYNCHRONOUS)
    assert found.feasible
    best = found.settings[0].shaft_speed_fluctuation[:-1].sum()
    others = []
    for first in np.linspace(-np.pi / 2, np.pi / 2, 361):
        rest = phases(drive, fixed={3: 0.4, 2: float(first)})
        if rest.feasible:
            others += [s.shaft_speed_fluctuation[:-1].sum() for s in rest.settings]
    assert best <= min(others) + 1e-9
    assert best == pytest.approx(min(others), abs=2e-3)


def test_one_degree_off_costs_more_than_the_slope_at_a_minimum_says():
    """Coordinates rounded to a micrometre leave a smooth minimum, slope 0: two joints of 20° still lose 0.43 %."""
    drive = example("pto-spline-thrust")
    best = phases(drive).settings[0]
    two = np.asarray([20 * deg, 20 * deg])
    off = [closing.speed_fluctuation(two, np.zeros(1), np.asarray([[one * deg]])) for one in (-1.0, 1.0)]
    assert best.one_off == pytest.approx([float(np.max(off))], abs=2e-6)
    assert best.one_off[0] == pytest.approx(0.0043, abs=5e-5)
    assert abs(best.sensitivity[0]) * deg < 1e-4 * best.one_off[0]


def test_one_degree_off_is_told_for_the_worst_pose():
    drive = example("rolling-mill-upper-spindle")
    posed = [phases(one).settings[0].one_off[0] for one in (replace(drive, poses=()), *pose_drives(drive))]
    assert phases(drive).settings[0].one_off[0] == pytest.approx(max(posed))
    assert max(posed) > 5 * posed[0]


@pytest.mark.slow
@given(plans(least=2, most=5, joint_angle=35 * deg, straight=False))
def test_sensitivity_is_the_slope_of_the_irregularity(plan):
    found = phases(plan.drive)
    h = 1e-6
    for setting in (found.as_built, *found.settings):
        steps = setting.yoke_angle + h * np.concatenate(
            (np.eye(len(plan.joint_angles) - 1), -np.eye(len(plan.joint_angles) - 1))
        )
        up, down = np.split(
            closing.speed_fluctuation(np.asarray(plan.joint_angles), np.asarray(plan.plane_twists), steps), 2
        )
        if setting.speed_fluctuation < 1e-13:
            np.testing.assert_allclose(up / h, setting.sensitivity, atol=1e-5)
            np.testing.assert_allclose(down / h, setting.sensitivity, atol=1e-5)
        elif setting.speed_fluctuation > 1e-3:
            # central difference: third derivative h² and rounding 1e-15/h; the corner at δ = 0 is 1e3 steps away
            np.testing.assert_allclose((up - down) / (2 * h), setting.sensitivity, atol=1e-6)


def test_a_straight_joint_changes_nothing_and_keeps_its_yokes():
    plain = phases(Drive.from_angles([0.2, 0.25, 0.3], plane_twists=[0.1, 0.2]))
    padded = phases(Drive.from_angles([0.2, 0.25, 0.3, 0.0], plane_twists=[0.1, 0.2, 0.0], yoke_angles=[0, 0, 0.7]))
    assert padded.feasible == plain.feasible
    assert padded.speed_fluctuation_max == pytest.approx(plain.speed_fluctuation_max, rel=1e-14)
    assert padded.settings[0].yoke_angle[-1] == pytest.approx(0.7)
    assert padded.settings[0].speed_fluctuation < 1e-14


def test_wrong_shafts_are_all_named():
    with pytest.raises(InputError) as caught:
        phases(TRUCK, fixed={1: 0.0, 5: 0.0, 3: float("nan")})
    assert [p.field for p in caught.value.problems] == ["fixed[1]", "fixed[5]", "fixed[3]"]


def test_a_goal_with_the_wrong_number_of_weights_is_refused():
    with pytest.raises(InputError) as caught:
        phases(TRUCK, goal=LeastIntermediate(weights=(1.0, 2.0)))
    assert caught.value.field == "goal.weights"


def test_with_every_yoke_held_there_is_one_setting():
    found = phases(TRUCK, fixed={2: 0.1, 3: 0.2, 4: 0.3})
    assert found.free == ()
    assert found.speed_fluctuation_min == found.speed_fluctuation_max
    assert left(TRUCK, found.settings[0]) == pytest.approx(found.speed_fluctuation_min, abs=VECTORS)
