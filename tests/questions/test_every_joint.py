"""Every kind of joint × every question: as first and as second joint of a spatial drive that turns, carries and moves.

What is left is refused with a sentence of mechanics: of the joint itself, never of the whole drive because of it.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, InputError, articulation, check, example, forces, losses, moving_forces
from cardan.drive.joints import JOINTS
from cardan.io.drive_file import loads
from cardan.joints import Tripod
from cardan.questions.accuracy.tolerance import tolerance
from cardan.questions.forces.assembly import assembly
from cardan.questions.life.life import life
from cardan.questions.motion.joint_mechanism import joint_carried, rubbed_share
from cardan.questions.motion.motion import motion
from tests.fixtures.joint_keys import KEYS

SIZES = {
    "tripod": "track_radius_mm = 19",
    "tracta": "driving_distance_mm = 30\ndriven_distance_mm = 33",
    "double_cardan": "centring_ratio = 0.55",
    "rzeppa": "lever_b = 0.35\nlever_c = 0.55",
    "weiss": "driving_offset_mm = 4\ndriven_offset_mm = 4.4\ngroove_radius_mm = 30",
    "offset_cross": "offset_mm = 5\nreach_mm = 200",
    "elastic_half_cardan": "pairs = 3",
    "pin_coupling": "driving_distance_mm = 50\ndriven_distance_mm = 60",
    "clemens": "driving = {axial_mm = 50, radial_mm = 20, radius_mm = 60}\n"
    "driven = {axial_mm = 50, radial_mm = 21, radius_mm = 60}",
    "mechanism": KEYS["mechanism"],
}
"""Uneven where a kind can be."""

CROSS = """kind = "hooke"
friction = 0.05
cross = {span_mm = 80, journal_mm = 20}
needles = {capacity_kN = 20}
tolerance = {alpha1_deg = 0.05, alpha2_deg = 0.05}
error = {s1_mm = 0.1, a2_mm = 0.05}
"""

SLIDING = "[shafts.spline]\nfriction = 0.1\nmean_diameter_mm = 40\n"

BEHIND = """[[supports]]
shaft = 3
position_mm = 100
friction = 0.02
bore_mm = 40
stiffness_N_per_um = 20
[[supports]]
shaft = 3
position_mm = 400
axial = true
friction = 0.02
bore_mm = 40
stiffness_N_per_um = 20
axial_stiffness_N_per_um = 20
"""

BEARING = "[[supports]]\nshaft = 2\nposition_mm = {}\nstiffness_N_per_um = 20\n"


def drive_of(kind: str, first: bool) -> Drive:
    """Return a drive with a joint of a kind beside a cross joint, held just enough."""
    made = JOINTS[kind]
    own = CROSS if kind == "hooke" else f'kind = "{kind}"\n{SIZES.get(kind, "")}\n'
    balls = kind == "offset_cross"
    if balls and first:  # its ball is the next joint
        own = own.replace("reach_mm = 200", f"reach_mm = {np.hypot(900.0, np.hypot(40.0, 60.0))}")
    one, other = (own, CROSS) if first else (CROSS, own)
    loose = made.loose is True  # of a joint of one's own its file says it: this one is fixed
    alone = balls and not first  # its ball holds shaft 3
    spline = "" if made.slides is True or loose or alone else SLIDING
    bearing = BEARING.format(100 if first else 800) if loose or alone else ""
    behind = "" if alone else BEHIND
    return loads(f"""format = 1
[input]
point_mm = [-500, 0, 0]
[output]
point_mm = [1500, 40, -60]
[[joints]]
centre_mm = [0, 0, 0]
{one}
[[joints]]
centre_mm = [900, 40, -60]
{other}
[[shafts]]
number = 1
inertia_kgm2 = 0.02
[[shafts]]
number = 2
outer_mm = 60
wall_mm = 3
{spline}
[[supports]]
shaft = 1
position_mm = -100
stiffness_N_per_um = 20
[[supports]]
shaft = 1
position_mm = -300
axial = true
stiffness_N_per_um = 20
axial_stiffness_N_per_um = 20
{bearing}
{behind}[[movements]]
kind = "harmonic"
moves = ["joints[1]", "output"]
amplitude_mm = [0, 0, 40]
frequency_Hz = 2
[duty]
speed_rpm = 1200
torque_Nm = 300
""")


EACH = [(kind, first) for kind in JOINTS for first in (True, False)]

each = pytest.mark.parametrize(("kind", "first"), EACH, ids=[f"{k}-{'first' if f else 'second'}" for k, f in EACH])


@each
def test_losses_count_the_other_joints_and_balance(kind, first):
    drive = replace(drive_of(kind, first), movements=())
    found = losses(drive)
    cross = 1 if first else 0
    assert found.joints[cross] > 0.0
    assert found.residual < 1e-9
    assert 0.9 < found.efficiency < 1.0
    told = {one.number: one.message for one in found.uncounted if one.part == "joints"}
    assert kind == "hooke" or told[2 - cross]


@each
def test_tolerances_of_the_other_joints_are_bounded(kind, first):
    drive = drive_of(kind, first)
    found = tolerance(drive)
    cross = 1 if first else 0
    assert found.output.largest > 0.0
    assert {one.joint for one in found.output.contributions} >= {cross + 1}


@each
def test_life_is_that_of_the_other_joints(kind, first):
    drive = replace(drive_of(kind, first), movements=())
    found = life(drive)
    lives = np.asarray(found.joints)
    cross = 1 if first else 0
    assert np.isfinite(lives[cross])
    assert lives[cross] > 0.0
    assert kind == "hooke" or np.isnan(lives[1 - cross])
    assert np.isfinite(found.drive)


@each
def test_assembly_forces_follow(kind, first):
    found = assembly(drive_of(kind, first))
    assert found.residual < 1e-9
    assert np.all(np.isfinite(found.joint_force))


@each
def test_forces_balance(kind, first):
    drive = drive_of(kind, first)
    assert not drive.joints[0 if first else 1].refusal("forces")
    found = forces(replace(drive, movements=()))
    for left in (found.power_left, found.force_left, found.moment_left):
        assert np.max(left) < 1e-12


@pytest.mark.slow
@each
def test_forces_while_moving_balance(kind, first):
    drive = drive_of(kind, first)
    if drive.joints[0 if first else 1].ball is not None:
        with pytest.raises(InputError, match="no movement says where it goes"):
            moving_forces(drive)
        return
    found = moving_forces(drive).forces
    for left in (found.power_left, found.force_left, found.moment_left):
        assert np.max(left) < 1e-11


@pytest.mark.slow
@each
def test_a_movement_is_followed(kind, first):
    drive = drive_of(kind, first)
    found = articulation(drive, times=np.linspace(0.0, 0.5, 9))
    assert np.all(np.isfinite(found.shaft_speed))
    rest = float(np.ptp(motion(replace(drive, movements=())).ratio))
    assert found.speed_fluctuation[0] == pytest.approx(rest, abs=0.01 * max(rest, 1e-3))


def test_the_tables_of_a_torque_that_passes_a_joint_are_one():
    """Torques of losses, written for crosses with friction, against those of forces, joint by joint, without it."""
    for kind in JOINTS:
        drive = replace(drive_of(kind, True), movements=())
        if (
            drive.joints[0].ball is not None
        ):  # forces between its shafts turn them: tests/questions/forces/test_wobbling
            continue
        bare = replace(
            drive, supports=(), joints=(drive.joints[0], replace(drive.joints[1], friction=1e-12)), shafts=()
        )
        found, other = losses(bare), forces(bare, angle=losses(bare).angle)
        assert np.abs(found.input_torque - other.input_torque).max() < 1e-8 * 300.0


RUBBING = [kind for kind in JOINTS if JOINTS[kind].rubbing]


@pytest.mark.parametrize("kind", RUBBING)
@pytest.mark.parametrize("torque", [300.0, -300.0])
def test_what_rubs_in_a_joint_without_a_cross_is_counted(kind, torque):
    """Against the inner mechanism at single places, torque for torque; and the powers balance."""
    grooves = "driving_offset_mm = 4\ndriven_offset_mm = 4\ngroove_radius_mm = 30"
    pins = "driving_distance_mm = 50\ndriven_distance_mm = 50"
    journals = "journal_span_mm = 60\njournal_diameter_mm = 14"
    profile = "driving = {axial_mm = 50, radial_mm = 20, radius_mm = 60}\n"
    sizes = {
        "rzeppa": grooves,
        "weiss": grooves,
        "pin_coupling": pins,
        "double_cardan": f"{SIZES['double_cardan']}\ncentre_distance_mm = 80\n{journals}",
        "tracta": f"{SIZES['tracta']}\nswivel_diameter_mm = 50\nswivel_length_mm = 40\ntongue_length_mm = 50",
        "clemens": f"{profile}hinge_diameter_mm = 10\nhinge_length_mm = 30\ntip_diameter_mm = 12",
        "offset_cross": f"{SIZES['offset_cross']}\n{journals}",
        "half_cardan": "face_radius_mm = 30",
    }.get(kind, SIZES.get(kind, ""))
    text = f"""format = 1
[[joints]]
kind = "{kind}"
joint_angle_deg = 15
friction = 0.02
{sizes}
[duty]
speed_rpm = 1200
torque_Nm = {torque}
"""
    drive = loads(text)
    found = losses(drive)
    assert found.uncounted == () or all(one.part != "joints" for one in found.uncounted)
    assert found.residual < 1e-9
    assert 0.98 < found.efficiency < 1.0
    places = np.arange(0, 360, 45)
    exact = joint_carried(drive.joints[0], np.radians(15.0), found.angle[places], friction=0.02, fed=torque > 0.0)
    # the table is straight between its places; where it has been taken, every fifth degree, it is exact
    # the output torque of an offset cross is that about its shaft, which wobbles by a degree
    close = 3e-5 if kind == "offset_cross" else 1e-9
    assert found.input_torque[places] / torque == pytest.approx(np.abs(exact.input_torque), rel=close)


def test_a_moving_joint_rubs_by_its_joint_angle():
    joint = Tripod(track_radius=0.02, friction=0.02)
    angle = np.arange(0.0, 6.0, 0.3)
    near = rubbed_share(joint, 0.123, angle, many=True)[0]
    assert near == pytest.approx(rubbed_share(joint, 0.123, angle)[0], rel=1e-5)


@pytest.mark.slow
def test_a_half_shaft_of_a_car_answers():
    drive = example("front-halfshaft")
    lost, rubbing = losses(drive), forces(drive)
    assert rubbing.input_torque == pytest.approx(lost.input_torque)
    assert rubbing.loss == pytest.approx(lost.joint_power)
    found = forces(replace(drive, joints=tuple(replace(one, friction=None) for one in drive.joints)))
    assert found.input_torque == pytest.approx(600.0)
    bent = np.tan(0.5 * np.radians([6.0, 30.0])) * 600.0
    assert np.asarray(found.bending_couple)[[0, 2], 0] == pytest.approx(bent)


@pytest.mark.slow
def test_answers_about_the_half_shaft_agree():
    """Losses and forces count what rubs in its joints: no two answers contradict each other."""
    drive = example("front-halfshaft")
    assert losses(drive).heat > 1000.0
    assert all(one.state != "failed" for one in check(drive))
