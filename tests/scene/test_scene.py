"""Scenes: sound and light for every example, exact where they show angles, forces, limits and mode shapes."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest

from cardan import bending_speeds, check, example, forces, torsion_modes
from cardan import joints as kinds
from cardan.answers import palette
from cardan.answers.reader import Reader, reading
from cardan.drive.drive import Drive
from cardan.drive.joints import JOINTS
from cardan.drive.models.geometry import geometry
from cardan.drive.movement import Harmonic
from cardan.drive.settings import Pose
from cardan.errors import InputError
from cardan.io import example_names
from cardan.scene.scene import scene, use_colour
from cardan.units import deg
from tests.fixtures.joint_keys import OWN

SPATIAL = Drive.from_angles(
    [0.3, 0.5, 0.2, 0.25], plane_twists=[0.7, -2.0, 0.4], yoke_angles=[0.4, -1.1, 0.9], start_phase=0.3
)


def turned(q, point):
    """Return a point turned by a quaternion x y z w."""
    x, w = np.asarray(q[:3]), q[3]
    return point + 2.0 * w * np.cross(x, point) + 2.0 * np.cross(x, np.cross(x, point))


@pytest.mark.slow
@pytest.mark.parametrize("name", example_names())
def test_every_example_has_a_sound_and_light_scene(name):
    shown = scene(example(name), frames=24).described()
    text = json.dumps(shown, allow_nan=False)
    assert len(text) < 1_100_000
    for body in shown["bodies"]:
        assert min(body["indices"]) >= 0
        assert 3 * max(body["indices"]) + 2 < len(body["positions"])
        assert len(body["indices"]) % 3 == 0
        assert body["colour"].startswith("#")
        assert 0 <= body["track"] < len(shown["tracks"])
    for track in shown["tracks"]:
        assert len(track["origin"]) in (3, 72)
        assert len(track["turn"]) == 96
    assert len({body["name"] for body in shown["bodies"]}) == len(shown["bodies"])
    groups = {group["name"] for group in shown["groups"]}
    assert {one["group"] for key in ("lines", "areas", "labels") for one in shown[key]} <= groups
    triangles = sum(len(body["indices"]) for body in shown["bodies"]) // 3
    drive = example(name)
    # A joint with its shaft takes some 3500 triangles, a support in rubber 1600.
    assert triangles <= 5000 * len(drive.joints) + 1700 * (len(drive.supports) + len(drive.stations)) + 1500
    assert shown["size"] > 0.0


@pytest.mark.parametrize("kind", JOINTS.values())
def test_joints_of_every_kind_can_be_described(kind):
    sizes = {kinds.OffsetCross: {"offset": 0.02, "reach": 0.4}}.get(kind, OWN.get(kind.kind, {}))
    joint = kind(joint_angle=min(0.3, 0.9 * kind.steepest), **sizes)
    drive = Drive(joints=(kinds.Hooke(joint_angle=0.1), joint, kinds.Hooke(joint_angle=0.1)))
    json.dumps(scene(drive, frames=12, with_forces=True, with_modes=True).described(), allow_nan=False)


def test_a_turn_is_closed_and_even_in_the_input_angle():
    shown = scene(SPATIAL, frames=48)
    np.testing.assert_allclose(np.diff(shown.angle), 2.0 * np.pi / 48.0, rtol=1e-12)
    for track in shown.tracks:
        # From the last frame to the first as from any one to the next, but for the sign of a quaternion.
        steps = np.abs(np.sum(track.turn * np.roll(track.turn, -1, axis=0), axis=-1))
        assert steps[-1] > 0.98


def test_the_yoke_angle_that_is_drawn_is_that_of_the_file():
    shown, place = scene(SPATIAL, frames=8), geometry(SPATIAL)
    for k in (2, 3, 4):
        axis, gamma = place.axis[k - 1], SPATIAL.shafts[k - 1].yoke_angle
        (driven,) = (body for body in shown.bodies if body.part == "driven yoke" and body.number == k)
        (driving,) = (body for body in shown.bodies if body.part == "driving yoke" and body.number == k)
        ears = [turned(shown.tracks[body.track].turn[0], np.asarray([0.0, 1.0, 0.0])) for body in (driving, driven)]
        angle = math.atan2(float(axis @ np.cross(*ears)), float(np.dot(*ears)))
        assert math.sin(angle - gamma) == pytest.approx(0.0, abs=1e-12)
        number = "₂₃₄"[k - 2]
        half = 90.0 - (90.0 - gamma / deg) % 180.0
        (label,) = (one for one in shown.labels if one.text.startswith(f"γ{number}"))
        assert label.text == f"γ{number} = {half:.1f}°".replace("-", "−")
        (fan,) = (one for one in shown.areas if one.text == label.text)
        spokes = [turned(shown.tracks[fan.track].turn[0], fan.positions[k] - fan.positions[0]) for k in (1, -1)]
        drawn = math.atan2(float(axis @ np.cross(*spokes)), float(np.dot(*spokes)))
        assert drawn == pytest.approx(half * deg, abs=1e-12)
        # The sector begins at the driving yoke and ends at the driven one.
        assert np.linalg.norm(np.cross(spokes[0], ears[0])) == pytest.approx(0.0, abs=1e-12)
        assert np.linalg.norm(np.cross(spokes[1], ears[1])) == pytest.approx(0.0, abs=1e-12)


def test_bends_phases_and_twists_are_told_with_their_values():
    words = {label.text for label in scene(SPATIAL, frames=8).labels}
    assert {"17.2°", "28.6°", "11.5°", "14.3°"} <= words
    assert {"β₂ = 40.1°", "β₃ = −114.6°", "β₄ = 22.9°", "ψ₁ = 17.2°"} <= words


def test_lengths_are_those_between_the_joint_centres():
    drive = example("truck-supports")
    words = {label.text for label in scene(drive, frames=8).labels if label.group == "dimensions"}
    between = [math.dist(one.centre, two.centre) for one, two in zip(drive.joints, drive.joints[1:], strict=False)]
    assert {f"{1e3 * length:,.0f} mm".replace(",", "\u202f") for length in between} <= words
    assert "Δz −340 mm" in words
    with reading(Reader(units={"length": "in", "force": "lbf"}, decimal=",")):
        inches = scene(drive, frames=8)
    assert "Δz −13,4 in" in {label.text for label in inches.labels}
    assert any("3,937 × 0,1575 in" in body.text for body in inches.bodies)


def test_bodies_take_the_colour_of_the_worst_of_their_checks():
    drive = example("truck-duty-cycle")
    names = ["bearing_life", "needle_static", "rated_torque", "yoke_strength", "spline_strength", "tube_buckling"]
    verdicts = check(drive, only=names)
    shown = scene(drive, verdicts=verdicts, frames=8)
    joint = [v for v in verdicts if v.subject == "joints[2]" and v.run and not v.advice]
    bearing = max(v.utilisation for v in joint if v.check not in ("journal_strength", "yoke_strength"))
    caps = [body for body in shown.bodies if body.part == "bearing cap" and body.path == "joints[2]"]
    assert caps
    assert all(body.utilisation == pytest.approx(bearing) for body in caps)
    assert all(body.utilisation_colour == palette.ROLES["failed"] and "%" in body.text for body in caps)
    spline = next(body for body in shown.bodies if body.part == "spline shaft")
    worst = max(v.utilisation for v in verdicts if v.check.startswith("spline") and v.run and not v.advice)
    assert spline.utilisation == pytest.approx(worst)
    support = next(body for body in shown.bodies if body.part in ("support", "flange"))
    assert support.utilisation is None
    assert [value for value, _colour, _text in shown.scale] == [0.0, 0.5, 0.9, 1.0]
    assert scene(drive, frames=8).scale == ()


def test_colours_of_utilisation_grow_darker_up_to_the_limit():
    def light(colour):
        return sum(w * int(colour[k : k + 2], 16) for w, k in ((0.2126, 1), (0.7152, 3), (0.0722, 5)))

    shades = [light(use_colour(share)) for share in (0.0, 0.3, 0.6, 0.89)]
    assert shades == sorted(shades, reverse=True)
    assert light(use_colour(0.0)) > 180.0


def test_arrows_are_the_forces_of_the_drive_to_one_scale():
    drive = example("truck-supports")
    shown = scene(drive, with_forces=True, frames=24)
    found = forces(drive, angle=shown.angle)
    arrows = [one for one in shown.arrows if one.group == "forces"]
    sizes = [*np.asarray(found.reaction), *np.asarray(found.joint_force)]
    longest = max(float(np.max(np.linalg.norm(force, axis=-1))) for force in sizes)
    for arrow, force in zip(arrows, sizes, strict=True):
        np.testing.assert_allclose(arrow.vector, 0.16 * shown.size / longest * force, atol=1e-12)
    assert arrows[2].text.startswith("centre bearing: 1.0")
    assert arrows[2].text.endswith("kN")
    assert any(one.group == "couples" and one.curl for one in shown.arrows)
    legend = {group.name: group.text for group in shown.groups}
    assert legend["forces"].startswith("The longest arrow is 7.5")


def test_an_arrow_says_in_the_reader_s_unit_what_a_metre_of_it_stands_for():
    drive = example("truck-supports")
    with reading(Reader(units={"force": "lbf"}, decimal=",")):
        shown = scene(drive, with_forces=True, frames=24)
    found = np.asarray(forces(drive, angle=shown.angle).reaction)
    arrow = next(one for one in shown.arrows if one.group == "forces")
    np.testing.assert_allclose(arrow.scale * arrow.vector, found[0] / 4.4482216152605, rtol=1e-9)
    assert (arrow.unit, arrow.decimal) == ("lbf", ",")


def test_parts_tell_their_joint_angle_torque_and_force():
    drive = example("truck-supports")
    shown = scene(drive, with_forces=True, frames=24)
    found = forces(drive, angle=shown.angle)
    texts = {body.path: body.text for body in shown.bodies}
    angle = math.degrees(float(geometry(drive).joint_angle[1]))
    assert f"joint angle {angle:.2f}°" in texts["joints[1]"]
    sizes = np.linalg.norm(np.asarray(found.joint_force)[1], axis=-1)
    assert f"to {np.max(sizes) / 1000.0:.2f} kN" in texts["joints[1]"]
    assert f"to {float(np.max(found.shaft_torque[0])) / 1000.0:.3g} kN·m" in texts["shafts[0]"]
    assert "force " in texts["supports[0]"]
    assert "torque" not in {body.path: body.text for body in scene(drive, frames=8).bodies}["shafts[0]"]


def test_what_cannot_be_shown_names_the_key_that_would_allow_it():
    missing = scene(SPATIAL, with_forces=True, with_modes=True, frames=8).missing
    assert missing["forces"].startswith("duty.torque: missing")
    assert missing["whirl"].startswith("shafts[1].outer")
    assert missing["torsion"].startswith("stations")
    assert missing["modes"].startswith(missing["whirl"])
    assert missing["couples"] == missing["forces"]
    held = scene(example("pto-drive"), with_forces=True, frames=8)
    assert held.missing["forces"].startswith("supports: missing")
    assert {one.group for one in held.arrows} == {"couples"}


def test_whirling_shafts_run_round_their_axes_in_the_shape_of_their_mode():
    drive = example("two-piece-rubber-bearing")
    shown, found = scene(drive, with_modes=True, frames=8), bending_speeds(drive)
    place = geometry(drive)
    whirls = [mode for mode in shown.modes if mode.kind == "whirl"]
    assert next(mode.name for mode in whirls).startswith("critical speed 1: 1")
    assert len(whirls) == len(found.speed)
    for number, mode in enumerate(whirls):
        for k, curve in zip((2, 3), mode.curves, strict=True):
            axis = place.axis[k - 1]
            off = curve.points - place.points[k - 1]
            off = off - (off @ axis)[..., None] * axis
            size = np.linalg.norm(off, axis=-1)
            # Every point keeps its distance while it runs round.
            np.testing.assert_allclose(size, np.broadcast_to(size[0], size.shape), atol=1e-12)
            along = np.linspace(*found.shaft_span[k - 1], size.shape[-1])
            expected = np.abs(np.interp(along, found.place, found.deflection[number]))
            np.testing.assert_allclose(size[0] / (0.045 * shown.size), expected, atol=1e-9)


def test_torsional_modes_turn_yokes_and_masses_as_far_as_their_shape_says():
    drive = example("truck-power-unit")
    shown, found = scene(drive, with_modes=True, frames=8), torsion_modes(drive)
    modes = [mode for mode in shown.modes if mode.kind == "torsion"]
    assert modes[0].name == "torsional mode 1: 12.6 Hz"
    place = geometry(drive)
    engine = next(body for body in shown.bodies if body.part == "station")
    for mode, shape in zip(modes, found.shape, strict=False):
        turn = mode.turns[engine.track][12]
        angle = 2.0 * math.atan2(float(turn[:3] @ place.axis[0]), float(turn[3]))
        assert angle == pytest.approx(math.radians(28.0) * shape[0], abs=1e-12)
        np.testing.assert_allclose(mode.turns[engine.track][0], (0.0, 0.0, 0.0, 1.0), atol=1e-15)


def test_poses_and_movements_move_the_drive_and_leave_its_parts_as_long_as_they_are():
    drive = replace(
        example("truck-supports"),
        poses=(Pose(name="laden", set=(("joints[2].centre_mm", (2310.0, 0.0, -290.0)),)),),
        movements=(Harmonic(moves=("joints[2]", "output"), amplitude=(0.0, 0.0, 0.04), frequency=2.0),),
    )
    drawn, laden = scene(drive, frames=8), scene(drive, pose=0, frames=8)
    high = scene(drive, time=0.25 * math.pi, frames=8)

    def axle(shown):
        body = next(one for one in shown.bodies if one.part == "cross" and one.number == 3)
        return shown.tracks[body.track].origin

    np.testing.assert_allclose(axle(laden), (2.31, 0.0, -0.29), atol=1e-12)
    np.testing.assert_allclose(axle(high) - axle(drawn), (0.0, 0.0, 0.04), atol=1e-12)
    for part in ("spline sleeve", "spline shaft"):
        one, two = (next(body for body in shown.bodies if body.part == part) for shown in (drawn, laden))
        np.testing.assert_allclose(one.positions, two.positions, atol=1e-12)
    assert "forces" in scene(drive, time=0.125, with_forces=True, frames=8).missing
    assert {one.group for one in scene(drive, pose=0, with_forces=True, frames=8).arrows} == {"forces", "couples"}
    with pytest.raises(InputError, match="there is no pose 4"):
        scene(drive, pose=4)


def test_joints_that_do_not_turn_are_said_so():
    stuck = Drive(joints=(kinds.PinCoupling(joint_angle=1.2, driving_slant=0.2),))
    shown = scene(stuck, frames=8)
    assert shown.missing["motion"].startswith("joint 1 does not turn")
    json.dumps(shown.described(), allow_nan=False)
