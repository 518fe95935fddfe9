"""Play at the journals: against loops driven to closure by Newton's method, closed forms, and tolerances drawn."""

from dataclasses import replace

import numpy as np
import pytest

from cardan.answers.data import data
from cardan.answers.reader import USUAL
from cardan.drive.accuracy import Error, Tolerance
from cardan.drive.cross import Cross
from cardan.drive.drive import Drive
from cardan.drive.models.kinematics_model import chain
from cardan.drive.support import Support
from cardan.io import example
from cardan.questions.accuracy.accuracy import WAYS, one_turn, transmission_error
from cardan.questions.accuracy.answer import answer, ask
from cardan.questions.accuracy.cross_play import cross_play, cross_sensitivity, cross_slides
from cardan.questions.accuracy.tolerance import WorstCase
from cardan.units import deg, mm
from tests.builders.loop_newton import solved

RIGHT = 0.5 * np.pi


def drive():
    return Drive.from_angles([18 * deg, 25 * deg, 9 * deg], plane_twists=[0.7, -1.1], yoke_angles=[0.4, -0.9])


def errors(rng, scale=1.0):
    def one():
        lengths = dict(zip(WAYS, rng.uniform(-0.2 * mm, 0.2 * mm, 5) * scale, strict=True))
        turns = dict(zip(("alpha1", "alpha2", "alpha3", "alpha4", "phase"), rng.uniform(-0.01, 0.01, 5), strict=True))
        return Error(**lengths, **turns)

    return [one() for _ in range(3)]


@pytest.mark.slow
@pytest.mark.parametrize("located", [(), (2,)])
def test_loops_driven_to_closure_agree(located):
    rng = np.random.default_rng(3)
    given, nominal = errors(rng), chain(drive())
    for phi in (0.3, 2.0, 4.4):
        found = cross_slides(drive(), [phi], errors=given, located=located)[..., 0]
        theta, shift = phi + nominal.turn_before[0], 0.0
        for j, error in enumerate(given):
            alpha = nominal.joint_angle[j]
            theta += (nominal.turn_before[j] if j else 0.0) + error.phase
            lengths = np.asarray([error.a1, error.a2, error.a3, error.a4])
            skew = np.asarray([error.alpha1, error.alpha2, error.alpha3, error.alpha4])
            angles = np.asarray([RIGHT, RIGHT, RIGHT, alpha]) + skew
            turned = np.arctan2(np.sin(theta), np.cos(theta) * np.cos(alpha))
            start = [
                np.arctan2(np.cos(alpha), np.sin(alpha) * np.sin(theta)),
                np.arctan2(np.hypot(np.sin(theta), np.cos(theta) * np.cos(alpha)), np.sin(alpha) * np.cos(theta)),
                RIGHT - turned,
                *np.zeros(3),
            ]
            before = 0.0 if j + 1 in located else shift
            unknown, left = solved(angles, lengths, theta, before + error.s1, start)
            assert left < 1e-13
            assert found[j] == pytest.approx(unknown[3:5], abs=1e-14)  # rounding of three joints
            theta, shift = RIGHT - unknown[2], -unknown[5]


def test_one_joint_follows_the_closed_forms_of_its_influence():
    alpha, phi = 30 * deg, one_turn()
    size = np.sqrt(np.sin(phi) ** 2 + (np.cos(alpha) * np.cos(phi)) ** 2)
    forms = {
        "s1": (-np.sin(2 * alpha) * np.cos(phi) / (2 * size**2), np.sin(alpha) * np.sin(phi) / size),
        "a2": (-np.sin(alpha) * np.cos(phi) / size, 0.0 * phi),
        "a3": (-1.0 / size, 0.0 * phi),
        "a4": (-np.sin(phi) / size**2, -np.cos(alpha) * np.cos(phi) / size),
    }
    for key, wanted in forms.items():
        one = Drive.from_angles([alpha])
        found = cross_slides(one, errors=[Error(**{key: 0.1 * mm})])[0]
        assert found / (0.1 * mm) == pytest.approx(np.stack(wanted), abs=1e-12)
        ranged = replace(one, joints=(replace(one.joints[0], error=Error(**{key: 0.1 * mm})),))
        plays = cross_play(ranged, None)
        assert [each.play for each in plays] == pytest.approx(0.1 * mm * np.ptp(wanted, axis=-1), abs=1e-8 * mm)


def test_the_sensitivity_is_the_slope_of_the_exact_ways():
    phi = one_turn(24)
    table = cross_sensitivity(drive(), phi, located=(3,))
    for j in range(3):
        for k, key in enumerate(WAYS):
            given = [Error(**{key: 0.3 * mm}) if i == j else None for i in range(3)]
            exact = cross_slides(drive(), phi, errors=given, located=(3,)) / (0.3 * mm)
            assert table[..., j, k] == pytest.approx(exact, abs=1e-12)  # lengths act linearly, whatever their size


def test_drives_drawn_stay_within_the_worst_case_and_reach_it():
    spread = Tolerance(s1=0.05 * mm, a1=0.02 * mm, a2=0.03 * mm, a3=0.01 * mm, a4=0.04 * mm)
    made = drive()
    toleranced = replace(made, joints=tuple(replace(joint, tolerance=spread) for joint in made.joints))
    plays = cross_play(toleranced, ask(toleranced, method=WorstCase()).band)
    limits = np.asarray([getattr(spread, key) for key in WAYS])
    rng = np.random.default_rng(1)
    most = np.zeros(6)
    for _draw in range(40):
        signs = rng.choice((-1.0, 1.0), (3, 5))
        given = [Error(**dict(zip(WAYS, row * limits, strict=True))) for row in signs]
        ways = cross_slides(made, errors=given).reshape(6, -1)
        most = np.maximum(most, np.max(np.abs(ways), axis=-1))
        assert np.all(np.ptp(ways, axis=-1) <= [one.play * (1 + 1e-3) for one in plays])  # positions 3° apart
    reach = np.asarray([np.max(one.reach) for one in plays])
    assert np.all(most <= reach * (1 + 1e-12))
    table = cross_sensitivity(made, one_turn())
    last = np.argmax(plays[4].reach)
    given = [Error(**dict(zip(WAYS, np.sign(row) * limits, strict=True))) for row in table[2, 0, last]]
    assert cross_slides(made, errors=given)[2, 0, last] == pytest.approx(reach[4], rel=1e-12)


def test_the_shift_handed_on_is_that_of_the_transmission_error():
    """Joint 2 without errors of its own moves its cross by the shift that joint 1 hands on, s_2 = C_2 u."""
    given = [Error(s1=0.1 * mm), None, None]
    shift = transmission_error(drive(), errors=given).shift[0]
    table = cross_sensitivity(drive(), one_turn())
    found = cross_slides(drive(), errors=given)
    assert found[1] == pytest.approx(table[1, :, :, 1, 0] * shift, abs=1e-15)


def test_angles_alone_move_no_cross():
    made = drive()
    skewed = replace(made, joints=tuple(replace(joint, error=Error(alpha1=0.01)) for joint in made.joints))
    assert cross_play(skewed, None) == ()


def test_the_answer_tells_the_play_that_a_held_cross_needs():
    pump = example("overconstrained-pump")
    said = answer(pump, ask(pump))
    rows = data(said, USUAL)["cross"]
    plays = cross_play(pump, None)
    assert [row["yoke"] for row in rows] == ["driving", "driven"]
    assert [row["play_um"] for row in rows] == pytest.approx([one.play * 1e6 for one in plays])
    (key,) = [one for one in said.keys if one.name == "cross_play"]
    assert key.value.value == max(one.play for one in plays)
    texts = [remark.text.told(USUAL) for remark in said.remarks if hasattr(remark.text, "told")]
    assert any(text.startswith("The cross of joint 1 needs a play of 17.6 µm") for text in texts)
    free = replace(pump, joints=(replace(pump.joints[0], cross=Cross(span=60 * mm, journal=15 * mm, slides=True)),))
    said = answer(free, ask(free))
    assert not [one for one in said.keys if one.name == "cross_play"]


def test_a_bearing_along_the_axis_keeps_the_shift_from_the_next_cross():
    made = drive()
    joints = (replace(made.joints[0], error=Error(s1=0.1 * mm)), *made.joints[1:])
    for supports, still in (((), False), ((Support(shaft=2, position=0.1, axial=True),), True)):
        held = replace(made, joints=joints, supports=supports)
        ways = cross_slides(held)
        assert (np.max(np.abs(ways[1])) == 0.0) == still
