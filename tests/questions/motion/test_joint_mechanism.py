"""The inner mechanisms of joints against their closed forms, and what they rub away against the balance of powers."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan import InputError
from cardan.drive.cross import Cross
from cardan.drive.drive import Drive
from cardan.drive.joints import JOINTS, Hooke
from cardan.drive.joints.tripod import roller_reach, track_travel
from cardan.drive.models.geometry import geometry
from cardan.drive.models.kinematics_model import turning_chain
from cardan.joints import (
    Clemens,
    ClemensProfile,
    ConstantVelocity,
    DoubleCardan,
    ElasticHalfCardan,
    HalfCardan,
    OffsetCross,
    PinCoupling,
    Rzeppa,
    Tracta,
    Tripod,
    Weiss,
)
from cardan.mechanism.kinetostatics import influence
from cardan.questions.forces.kinetostatics import kind_arms
from cardan.questions.losses.chain_friction import chain_friction
from cardan.questions.losses.loss_model import torque_flow
from cardan.questions.motion.joint_mechanism import joint_carried, rubbed_share, stance_of
from cardan.questions.motion.motion import motion
from cardan.units import deg

BEND = 0.35

ANGLE = np.linspace(0.0, 2.0 * np.pi, 25)[:-1] + 0.013

LAWFUL = [
    Hooke(),
    ConstantVelocity(),
    DoubleCardan(),
    DoubleCardan(centre_distance=0.08),
    DoubleCardan(centring_ratio=0.55),
    DoubleCardan(centring_ratio=0.45, ball_on="driven"),
    Tracta(driving_distance=0.03, driven_distance=0.03),
    Tracta(driving_distance=0.03, driven_distance=0.036),
    Tripod(track_radius=0.02),
    Rzeppa(driving_offset=0.004, driven_offset=0.004, groove_radius=0.03, balls=3),
    Weiss(driving_offset=0.004, driven_offset=0.004, groove_radius=0.03),
    Weiss(driving_offset=0.004, driven_offset=0.005, groove_radius=0.03, balls=1),
    HalfCardan(),
    ElasticHalfCardan(),
    PinCoupling(driving_distance=0.05, driven_distance=0.05),
    PinCoupling(driving_distance=0.05, driven_distance=0.06),
    Clemens(
        driving=ClemensProfile(axial=0.05, radial=0.02, radius=0.06),
        driven=ClemensProfile(axial=0.05, radial=0.021, radius=0.06),
    ),
]

NAMES = [f"{joint.kind}-{k}" for k, joint in enumerate(LAWFUL)]

HELD = [joint for joint in LAWFUL if joint.fixed and not isinstance(joint, Tracta | Weiss)]


@pytest.mark.parametrize("joint", LAWFUL, ids=NAMES)
def test_mechanisms_turn_by_the_closed_forms(joint):
    found = joint_carried(joint, BEND, ANGLE)
    ratio = joint.deviation(ANGLE, np.asarray(BEND))[1]
    assert np.max(found.found.open) < 1e-12
    assert np.max(found.found.unbalanced) < 1e-12
    assert np.abs(found.ratio - ratio).max() < 1e-12
    assert np.abs(found.input_torque - ratio).max() < 1e-12


def test_every_kind_is_there():
    assert {joint.kind for joint in LAWFUL} | {"offset_cross", "mechanism"} == set(JOINTS)


@pytest.mark.parametrize("joint", [one for one in LAWFUL if one.has_map], ids=lambda one: one.kind)
def test_couples_point_where_the_law_says(joint):
    """The couple works on nothing that the law allows; the wrench of the mechanism comes from the pairs alone."""
    drive = Drive(joints=(replace(joint, joint_angle=BEND),))
    place, chain = geometry(drive), turning_chain(drive)
    found = joint_carried(joint, BEND, ANGLE).wrench[:, :3]
    if chain.laws is None:
        return
    way = kind_arms(chain, place.axis, place.normal, motion(drive, ANGLE))[2][:, 0]
    basis = np.stack((place.axis[0], np.cross(place.normal[0], place.axis[0]), place.normal[0]))
    along = found @ basis
    assert np.abs(np.cross(along, way)).max() < 1e-9 * np.abs(along).max()


@pytest.mark.parametrize("joint", HELD, ids=lambda one: one.kind)
def test_a_joint_that_holds_its_centre_passes_on_no_force(joint):
    assert np.abs(joint_carried(joint, BEND, ANGLE).wrench[:, 3:]).max() < 1e-9


@pytest.mark.parametrize("joint", [one for one in LAWFUL if one.push(ANGLE, np.asarray(BEND)) is not None])
def test_contacts_push_as_the_closed_form_says(joint):
    found = joint_carried(joint, BEND, ANGLE).wrench[:, 3:]
    assert np.abs(found - joint.push(ANGLE, np.asarray(BEND))).max() < 1e-9 * np.abs(found).max()


@pytest.mark.parametrize("joint", [*LAWFUL, OffsetCross(offset=0.02, reach=0.2)], ids=lambda one: one.kind)
@pytest.mark.parametrize("fed", [True, False])
def test_power_in_is_power_out_and_friction(joint, fed):
    found = joint_carried(joint, BEND, ANGLE, friction=0.1, fed=fed)
    lost = np.sum(found.found.loss, axis=-1)
    sense = 1.0 if fed else -1.0
    assert np.abs(found.input_torque - found.ratio * sense - sense * lost).max() < 1e-10
    assert np.all(lost >= 0.0)


@pytest.mark.parametrize("friction", [0.001, 0.1])
def test_friction_of_a_cross_is_that_of_the_closed_form(friction):
    """κ = μ d_c/d acting on itself, `torque_flow`, which lets the normal couple T alone load the journals.

    Here the friction κT of one pair loads the other too: √(1 + κ²), of the third order in κ.
    """
    joint, kappa = Hooke(joint_angle=BEND, cross=Cross(span=0.08, journal=0.02)), friction * 0.02 / 0.08
    moved = motion(Drive(joints=(joint,)), ANGLE)
    for sense in (1.0, -1.0):
        flow = torque_flow(moved, np.asarray([kappa]), sense * np.ones_like(ANGLE))
        found = joint_carried(joint, BEND, ANGLE, friction=friction, fed=sense > 0.0)
        assert np.abs(found.input_torque - sense * np.asarray(flow.entering)[0]).max() < 0.5 * kappa**3 + 1e-13


def test_rollers_of_a_tripod_rub_along_tracks_and_arms():
    """To first order in friction: three equal forces, each times the speeds of its roller; closed forms of its ways."""
    track, step = 0.02, 1e-6
    joint = Tripod(track_radius=track)
    found = joint_carried(joint, BEND, ANGLE)
    force = np.linalg.norm(found.found.reaction[:, :6, 3:], axis=-1)[:, ::2]
    assert np.ptp(force, axis=-1).max() > 0.0
    expected = 0.0
    for k in range(3):
        phi = ANGLE + k * 2.0 * np.pi / 3.0
        ways = [
            (way(phi + step, BEND, track) - way(phi - step, BEND, track)) / (2 * step)
            for way in (roller_reach, track_travel)
        ]
        expected = expected + force[:, k] * (np.abs(ways[0]) + np.abs(ways[1]))
    small = joint_carried(joint, BEND, ANGLE, friction=1e-6)
    assert np.sum(small.found.loss, axis=-1) == pytest.approx(1e-6 * expected, rel=1e-4)


def test_errors_of_sizes_turn_the_output_by_the_reactions():
    """A driven fork off along its shaft is another distance: the derivative of the closed form by it."""
    first, last, step = 0.03, 0.036, 1e-7
    joint = Tracta(driving_distance=first, driven_distance=last)
    found = joint_carried(joint, BEND, ANGLE)
    k = [pair.name.startswith("driven swivel") for pair in found.pairs].index(True)
    own = influence(found.placed, found.found, 1.0)[:, k]
    after = np.asarray([np.cos(BEND), np.sin(BEND), 0.0])
    ends = [
        Tracta(driving_distance=first, driven_distance=last + one).deviation(ANGLE, np.asarray(BEND))[0]
        for one in (step, -step)
    ]
    slope = (ends[0] - ends[1]) / (2.0 * step)
    # the second half of that pair is the driven fork: shifted by -after it stands where a longer one would
    assert np.abs(np.abs(own[:, 3:] @ after) - np.abs(slope)).max() < 1e-6 * np.abs(slope).max()


def test_a_joint_that_does_not_turn_is_refused():
    with pytest.raises(InputError, match="does not turn"):
        joint_carried(PinCoupling(driving_slant=0.2, driving_distance=0.05, driven_distance=0.06), 0.6, ANGLE)


def test_balls_that_press_at_an_angle_rub_harder():
    """Each groove presses with F/sin δ on a ball that passes on F; to first order the heat grows as much."""
    plain = Rzeppa(driving_offset=0.004, driven_offset=0.004, groove_radius=0.03)
    steep = replace(plain, pressure_angle=np.radians(40.0))
    one, other = (joint_carried(joint, BEND, ANGLE, friction=1e-6).loss for joint in (plain, steep))
    assert other == pytest.approx(one / np.sin(np.radians(40.0)), rel=1e-5)


def test_the_exact_device_of_a_double_cardan_holds_its_middle_piece():
    """Both crosses put the couple 2 T sin(α/2) at most on the middle piece; the ball holds it at half its length."""
    joint = DoubleCardan(centre_distance=0.08, journal_span=0.06, journal_diameter=0.014)
    found = joint_carried(joint, BEND, np.linspace(0.0, np.pi, 181))
    names = [one.name for one in found.pairs[: found.inner]]
    for part in ("driving bore", "driven bore"):
        (own,) = (k for k, name in enumerate(names) if name.startswith(part))
        force = np.linalg.norm(found.found.reaction[:, own, 3:], axis=-1)
        assert np.max(force) == pytest.approx(2.0 * np.sin(0.5 * BEND) / 0.08, rel=1e-9)
    crosses = chain_friction(Drive.from_angles([0.5 * BEND] * 2), [1e-4 * 14.0 / 60.0] * 2)
    rubs = joint_carried(joint, BEND, ANGLE, friction=1e-4)
    assert np.mean(rubs.loss) > 1.0 - float(crosses.efficiency)  # the force of the ball goes through the pins, too


RZEPPA = {
    "driving_offset": 0.005,
    "driven_offset": 0.005,
    "groove_radius": 0.032,
    "pressure_angle": 42 * deg,
    "friction": 0.05,
}


@pytest.mark.slow
@pytest.mark.parametrize("joint_angle", [6 * deg, 30 * deg])
def test_the_cage_of_a_rzeppa_joint_rubs(joint_angle):
    """In bell and inner race with its force at their radii, 2 sin(α/4) fast; in its windows as the balls go."""
    turn = np.arange(72) * 5 * deg
    windows, caged = Rzeppa(**RZEPPA), Rzeppa(**RZEPPA, cage_outer_diameter=0.062, cage_inner_diameter=0.052)
    carried = joint_carried(caged, joint_angle, turn, loads=True)
    force = np.linalg.norm(carried.found.reaction[..., 3:], axis=-1)
    names = [pair.name for pair in carried.pairs]
    rubbed = force[:, names.index("cage in the bell")] * 0.031 + force[:, names.index("cage on the inner race")] * 0.026
    rubbed = 0.05 * rubbed * 2.0 * np.sin(0.25 * joint_angle)

    def power(joint):
        return 1.0 / (1.0 - rubbed_share(joint, joint_angle, turn)[0]) - 1.0  # over that of the driven shaft

    assert power(caged) - power(windows) == pytest.approx(rubbed, rel=1e-9)
    step = 1e-5

    def balls(angle):
        return np.stack(
            [one.point for one in windows.loaded(stance_of(windows, joint_angle, angle)) if "window" in one.name]
        )

    middle = stance_of(windows, joint_angle, turn).middle
    fast = (balls(turn + step) - balls(turn - step)) / (2.0 * step) - np.cross(middle, balls(turn))
    pressed = force[:, [k for k, name in enumerate(names) if "window" in name]].T
    slid = 0.05 * np.sum(pressed * np.linalg.norm(fast, axis=-1), axis=0)
    grooves = joint_carried(windows, joint_angle, turn, friction=0.05)
    assert power(windows) == pytest.approx(np.sum(grooves.found.loss, axis=-1) + slid, rel=1e-6)
