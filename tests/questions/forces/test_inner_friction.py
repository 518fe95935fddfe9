"""Friction within joints in the forces: against their inner mechanisms, the losses, and every balance."""

from __future__ import annotations

import numpy as np
import pytest

from cardan import InputError, example, forces, losses
from cardan.drive.models.dynamics_model import place_of, train
from cardan.drive.models.machine_held import machine_held
from cardan.io.drive_file import loads
from cardan.questions.forces.kinetostatics import couples, resisted, standing
from cardan.questions.losses.loss_parts import response
from cardan.questions.motion.joint_mechanism import joint_carried

FRICTION = 0.05

GROOVES = "driving_offset_mm = 4\ndriven_offset_mm = 4\ngroove_radius_mm = 30"

SIZES = {
    "tripod": "track_radius_mm = 20",
    "rzeppa": GROOVES,
    "weiss": GROOVES,
    "half_cardan": "face_radius_mm = 30",
    "double_cardan": "centring_ratio = 0.45\ncentre_distance_mm = 80\njournal_span_mm = 60\njournal_diameter_mm = 14",
    "tracta": "driving_distance_mm = 30\ndriven_distance_mm = 33\n"
    "swivel_diameter_mm = 50\nswivel_length_mm = 40\ntongue_length_mm = 50",
    "pin_coupling": "driving_distance_mm = 50\ndriven_distance_mm = 50",
    "clemens": "driving = {axial_mm = 50, radial_mm = 20, radius_mm = 60}\n"
    "hinge_diameter_mm = 10\nhinge_length_mm = 30\ntip_diameter_mm = 12",
}

LOOSE = ("pin_coupling", "clemens")

each = pytest.mark.parametrize("kind", SIZES)


def rubbing(kind: str, *, torque: float = 300.0, friction: float = FRICTION) -> str:
    """Return the file of a drive of one joint that rubs, without supports."""
    return f"""format = 1
[[joints]]
kind = "{kind}"
joint_angle_deg = 5
friction = {friction}
{SIZES[kind]}
[duty]
speed_rpm = 1200
torque_Nm = {torque}
"""


def held(kind: str, *, torque: float = 300.0, moves: bool = False, rub: float = 0.0) -> str:
    """Return the file of a drive of a joint that rubs and a Hooke joint, held just enough."""
    spline = "" if kind in ("tripod", "half_cardan", *LOOSE) else "[shafts.spline]\nfriction = 0.1\npitch_mm = 40\n"
    spline = spline.replace("pitch_mm", "mean_diameter_mm")
    more = f"[[supports]]\nshaft = 2\nposition_mm = 100\nfriction = {rub}\nbore_mm = 40\n" if kind in LOOSE else ""
    movement = """[[movements]]
kind = "harmonic"
moves = ["joints[1]", "output"]
amplitude_mm = [0, 0, 20]
frequency_Hz = 2
"""
    return f"""format = 1
[input]
point_mm = [-500, 0, 0]
[output]
point_mm = [1500, 40, -60]
[[joints]]
centre_mm = [0, 0, 0]
kind = "{kind}"
friction = {FRICTION}
{SIZES[kind]}
[[joints]]
centre_mm = [900, 40, -60]
friction = 0.05
cross = {{span_mm = 80, journal_mm = 20}}
[[shafts]]
number = 2
mass_kg = 4
inertia_kgm2 = 0.01
centre_of_mass_mm = 400
{spline}
[[supports]]
shaft = 1
position_mm = -100
[[supports]]
shaft = 1
position_mm = -300
axial = true
{more}
[[supports]]
shaft = 3
position_mm = 100
friction = {rub}
bore_mm = 40
[[supports]]
shaft = 3
position_mm = 400
axial = true
friction = {rub}
bore_mm = 40
{movement if moves else ""}
[duty]
speed_rpm = 1200
torque_Nm = {torque}
"""


@pytest.mark.slow
@each
@pytest.mark.parametrize("torque", [300.0, -300.0])
def test_couples_are_those_of_the_inner_mechanism(kind, torque):
    drive = loads(rubbing(kind, torque=torque))
    found = forces(drive)
    places = np.arange(0, 360, 5)  # where shares have been taken
    exact = joint_carried(drive.joints[0], np.radians(5.0), found.angle[places], friction=FRICTION, fed=torque > 0.0)
    one, two = found.axis[:, 0]
    normal = np.cross(one, two) / np.linalg.norm(np.cross(one, two))
    own = found.driven_couple[0, places] @ np.stack((one, np.cross(normal, one), normal), axis=-1) / torque
    assert own == pytest.approx(exact.wrench[:, :3], abs=1e-9)
    assert found.input_torque[places] / torque == pytest.approx(np.abs(exact.input_torque), rel=1e-9)
    assert np.max(found.power_left) < 1e-12


@pytest.mark.slow
@each
@pytest.mark.parametrize("torque", [300.0, -300.0])
def test_forces_and_losses_count_the_same_friction(kind, torque):
    drive = loads(rubbing(kind, torque=torque))
    carried, lost = forces(drive), losses(drive)
    assert carried.input_torque == pytest.approx(lost.input_torque, rel=1e-12)
    assert carried.loss[0] == pytest.approx(lost.joint_power[0], rel=1e-9, abs=1e-12 * abs(lost.input_power))
    assert np.max(lost.joint_power) > 0.0


@pytest.mark.slow
@each
def test_all_balances_of_a_drive_close(kind):
    found = forces(loads(held(kind)))
    for left in (found.power_left, found.force_left, found.moment_left):
        assert np.max(left) < 1e-11


@pytest.mark.slow
@each
def test_a_torque_that_drives_holds_the_load_that_needs_it(kind):
    drive = machine_held(loads(held(kind)))
    whole = train(drive, kinds=True)
    place = place_of(whole)
    stand = standing(whole.chain, place.axis, place.normal, np.linspace(0.0, 6.0, 25), speed=120.0)
    for torque in (300.0, -300.0):
        load = np.full(25, torque)
        assert resisted(whole, stand, couples(whole, stand, load).shaft_torque[..., 0]) == pytest.approx(
            load, rel=1e-11
        )


@each
def test_what_rubs_in_a_joint_loads_the_supports_that_rub(kind):
    """Losses take the forces on the supports per couple of each joint; at no friction in them they are the forces."""
    text = held(kind, torque=-200.0).replace("friction = 0.1", "friction = 0").replace("inertia_kgm2 = 0.01", "")
    drive = loads(text)
    found = forces(drive)
    whole = train(machine_held(drive), kinds=True)
    part = response(whole, np.asarray(whole.drag), found.angle[7::30])
    # about its own normal the couple of a cross counts, about their driving shafts that of all others
    about = np.stack([np.sum(found.driving_couple[0] * found.axis[0], axis=-1), found.joint_torque[1]])
    size = part.load(about[:, 7::30], np.asarray(1.0))
    assert size == pytest.approx(np.linalg.norm(found.reaction, axis=-1)[:, 7::30], rel=1e-9, abs=1e-9 * size.max())


def test_a_tripod_pushes_with_the_friction_of_its_rollers():
    """Each of three rollers carries T/(3R): the signs of their ways along the tracks add up to one, thrice a turn."""
    text = held("tripod").replace("[900, 40, -60]", "[900, 12, -9]").replace("[1500, 40, -60]", "[1500, 30, 0]")
    found = forces(loads(text.replace(f"friction = {FRICTION}", "friction = 0.001")))
    along = np.sum(found.joint_force[0] * found.axis[0], axis=-1)
    assert np.median(np.abs(along)) == pytest.approx(0.001 * 300.0 / (3.0 * 0.02), rel=0.01)
    orders = np.abs(np.fft.rfft(along[:-1]))
    assert np.argmax(orders) == 3


def test_the_thrust_of_a_tripod_reaches_the_bearing_that_holds_its_shaft():
    with_, without = (
        forces(loads(held("tripod").replace(f"friction = {FRICTION}", own, 1)))
        for own in (f"friction = {FRICTION}", "")
    )
    assert np.ptp(without.axial[1]) < 0.2 * np.ptp(with_.axial[1])
    along = np.sum(with_.joint_force[0] * with_.axis[0], axis=-1)
    assert with_.axial[1] - along == pytest.approx(without.axial[1], abs=1e-9 * np.abs(along).max())


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["tripod", "tracta", "clemens"])
def test_power_closes_while_the_drive_moves(kind):
    drive = loads(held(kind, moves=True))
    found = forces(drive, movement=drive.movements)
    assert np.max(found.power_left) < 1e-10
    assert np.min(found.loss) > 0.0
    still = forces(loads(held(kind)))
    assert np.mean(found.loss[0]) == pytest.approx(np.mean(still.loss[0]), rel=0.1)  # it moves little, and slowly


@pytest.mark.slow
def test_heat_is_a_mean_over_the_whole_turn():
    """Within a joint of one's own nothing repeats after half a turn."""
    drive = example("thompson-drive")
    lost = losses(drive)
    half = lost.joint_power[0, :-1].reshape(2, -1)
    assert np.mean(half[0]) != pytest.approx(np.mean(half[1]), rel=1e-3)
    assert lost.joints[0] == pytest.approx(np.trapezoid(lost.joint_power[0], lost.angle) / (2.0 * np.pi), rel=1e-4)


GROOVED = """format = 1
[[joints]]
kind = "{kind}"
joint_angle_deg = 12
friction = 0.05
groove_radius_mm = 30
driving_offset_mm = 4
driven_offset_mm = {offset}
[duty]
speed_rpm = 1200
torque_Nm = 300
"""


@pytest.mark.parametrize("kind", ["rzeppa", "weiss"])
@pytest.mark.parametrize("off", [0.01, 0.3])
def test_balls_that_do_not_fit_at_once_rub_as_those_that_do(kind, off):
    """Six rigid balls in grooves 0.01 mm unlike would press each other with any force, and lock; with play they rub.

    The offset changes what rubs by a part of its share of the radius, 0.3 mm of 30 mm by less than a few per cent.
    """
    alike, unlike = (losses(loads(GROOVED.format(kind=kind, offset=4 + more))) for more in (0.0, off))
    assert unlike.heat == pytest.approx(alike.heat, rel=0.003 if off < 0.1 else 0.04)
    assert unlike.residual < 1e-9


@pytest.mark.slow
def test_a_joint_that_locks_by_its_own_friction_says_where_and_from_which_friction_on():
    """No number comes of it; with less than the friction told the same joint turns, with more it does not."""
    text = """format = 1
[[joints]]
kind = "pin_coupling"
joint_angle_deg = 20
driving_slant_deg = 20
driven_slant_deg = 24
driving_distance_mm = 50
driven_distance_mm = 52
friction = {mu}
[duty]
speed_rpm = 500
torque_Nm = 10
"""
    for ask in (losses, forces):
        with pytest.raises(InputError, match=r"joints\[0\]\.friction: with a friction of 0\.6 it locks: where") as told:
            ask(loads(text.format(mu=0.6)))
    most = float(told.value.problems[0].message.split("below ")[1])
    assert losses(loads(text.format(mu=0.9 * most))).efficiency > 0.0
    with pytest.raises(InputError, match="it locks"):
        losses(loads(text.format(mu=1.05 * most)))
