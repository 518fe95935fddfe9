"""A drive at the speed at which its centre bearing bounces: told on every surface, by elements written apart."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import eigh

from cardan import Drive
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.batch.answering.questions import questions
from cardan.checks.checks import check
from cardan.drive.cross import Cross
from cardan.drive.duty import Block, Duty
from cardan.drive.material import Material
from cardan.drive.shaft import Shaft
from cardan.drive.support import Support
from cardan.formulas.damping import LOSS
from cardan.formulas.run_up import passing_time, run_up
from cardan.questions.bending.answer import answer
from cardan.questions.bending.bending import Running, bending_speeds, length_powers

E, RHO = 2.1e11, 7850.0
LENGTHS, OUTER, INNER, STIFFNESS, BEARING, CROSS = (1.1, 1.3), 0.07, 0.066, 1e5, 1.0, 2.0


def drive(**duty):
    tube = {"outer": OUTER, "inner": INNER, "material": Material(youngs=E, density=RHO)}
    line = Drive.from_points([(-0.3, 0, 0), (0, 0, 0), (LENGTHS[0], 0, 0), (sum(LENGTHS), 0, 0), (2.7, 0, 0)])
    joints = (line.joints[0], replace(line.joints[1], cross=Cross(mass=CROSS)), line.joints[2])
    return replace(
        line,
        joints=joints,
        shafts=(Shaft(number=2, **tube), Shaft(number=3, **tube)),
        supports=(Support(shaft=2, position=BEARING, stiffness=STIFFNESS, name="centre bearing"),),
        duty=Duty(**duty),
    )


def by_elements(cells=24, front=(), rear=()):
    """Return the natural frequencies of the line of Euler and Bernoulli, two tubes hinged to each other [rad/s]."""
    bending, mass = E * np.pi / 64 * (OUTER**4 - INNER**4), RHO * np.pi / 4 * (OUTER**2 - INNER**2)
    places = np.unique(np.concatenate([np.linspace(0, LENGTHS[0], cells + 1), [BEARING]]))
    tubes = [np.diff(places), np.full(cells, LENGTHS[1] / cells)]
    # Degrees of freedom: deflection and slope of every node of both tubes, the deflection of the joint in common.
    first = 2 * (len(tubes[0]) + 1)
    size = first + 2 * cells + 1
    stiff, inert = np.zeros((size, size)), np.zeros((size, size))
    for shaft, tube in enumerate(tubes):
        for k, h in enumerate(tube):
            at = 2 * k + np.arange(4) if shaft == 0 else first - 1 + 2 * k + np.arange(4)
            if shaft == 1:
                at = np.where(at == first - 1, first - 2, at)
                at[1] = first + 2 * k
            own = np.array(
                [[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h],
                 [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h * h, -6 * h, 4 * h * h]]
            )  # fmt: skip
            heavy = np.array(
                [[156, 22 * h, 54, -13 * h], [22 * h, 4 * h * h, 13 * h, -3 * h * h],
                 [54, 13 * h, 156, -22 * h], [-13 * h, -3 * h * h, -22 * h, 4 * h * h]]
            )  # fmt: skip
            stiff[np.ix_(at, at)] += bending / h**3 * own
            inert[np.ix_(at, at)] += mass * h / 420 * heavy
    bearing = 2 * int(np.argmin(np.abs(places - BEARING)))
    stiff[bearing, bearing] += STIFFNESS
    inert[first - 2, first - 2] += CROSS
    for place, heavy in front:  # from joint 1, at the nearest node
        at = 2 * int(np.argmin(np.abs(places - place)))
        inert[at, at] += heavy
    for place, heavy in rear:  # from joint 2
        at = first + 2 * round(place / LENGTHS[1] * cells) - 1
        inert[at, at] += heavy
    free = [k for k in range(size) if k not in (0, size - 2)]
    return np.sqrt(eigh(stiff[np.ix_(free, free)], inert[np.ix_(free, free)], eigvals_only=True))


BOUNCE = float(by_elements()[0])


def test_the_yokes_of_a_joint_that_says_its_mass_lower_the_bounce():
    """Two yokes of 3 kg beside the middle joint, half a span from it, as points of the elements written apart."""
    made = drive()
    heavy = replace(made.joints[1], mass=CROSS + 6.0, cross=Cross(mass=CROSS, span=0.1))
    found = bending_speeds(replace(made, joints=(made.joints[0], heavy, made.joints[2])))
    want = by_elements(240, front=((LENGTHS[0] - 0.05, 3.0),), rear=((0.05, 3.0),))[0]
    assert found.speed[0] == pytest.approx(want, rel=3e-3)
    assert found.speed[0] < 0.75 * BOUNCE
    assert "joints 1, 2 and 3 count as massless" in remarks(made, bending_speeds(made))
    assert "joints 1 and 3 count as massless" in remarks(
        replace(made, joints=(made.joints[0], heavy, made.joints[2])), found
    )


def remarks(made, found):
    return " ".join(told(one.text, USUAL) for one in answer(made, found).remarks)


def named(verdicts, title):
    (found,) = [one for one in verdicts if one.title.startswith(title)]
    return found


def test_the_bounce_is_that_of_elements_written_apart():
    found = bending_speeds(drive())
    # Shear and rotary inertia, which those lack, take a hundredth at most of the first three.
    np.testing.assert_allclose(found.speed, by_elements()[:3], rtol=1e-2)
    assert found.speed[0] == pytest.approx(BOUNCE, rel=2e-3)
    assert found.part[0].kind == "support"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("share", "near", "half"),
    [(0.997, True, False), (0.79, False, False), (0.81, True, False), (1.19, True, False), (1.21, False, False),
     (0.5, False, True), (0.39, False, False), (0.41, False, True), (0.59, False, True), (0.61, False, False)],
)  # fmt: skip
def test_a_speed_held_at_a_bounce_or_half_of_it_fails_everywhere(share, near, half):
    made = drive(speed=share * BOUNCE)
    found = bending_speeds(made)
    assert (found.near.tolist(), found.half_near.tolist()) == ([near, False, False], [half, False, False])
    assert (found.status == Running.NEAR) == (near or half)
    said = answer(made, found)
    assert said.code == int(near or half)
    assert ("too near" in told(said.sentence, USUAL)) == (near or half)
    assert any(key.tone == "failed" for key in said.keys) == (near or half)
    verdicts = check(made)
    assert (named(verdicts, "clearance from the critical speed, bounce").state == "failed") == near
    assert (named(verdicts, "clearance from half critical speed, bounce").state == "failed") == half
    (question,) = [one for one in questions().values() if one.name == "critical_speed"]
    assert (question.of_one(made)[-1] < 0.2) == (near or half)


def test_every_part_of_a_duty_cycle_is_a_speed_held():
    parts = tuple(Block(torque=10.0, speed=speed, share=0.5) for speed in (0.7 * BOUNCE, 1.1 * BOUNCE))
    made = drive(blocks=parts)
    assert bending_speeds(made).near.tolist() == [True, False, False]
    assert named(check(made), "clearance from the critical speed, bounce").value == pytest.approx(1.1 * BOUNCE)


def test_a_bounce_below_the_speeds_is_passed_with_a_word_on_how_fast():
    made = drive(speed=2.0 * BOUNCE)
    found = bending_speeds(made)
    assert found.crossed.tolist() == [True, False, False]
    (passed,) = [one for one in answer(made, found).remarks if one.tone == "warning"]
    half, full = found.passing(0)
    assert f"in {half:.2g} s half of the resonance builds up, in {full:.2g} s all" in told(passed.text, USUAL)
    verdict = named(check(made), "passing the critical speed, bounce")
    assert verdict.advice
    assert verdict.state == "failed"
    assert f"{half:.2g} s" in told(verdict.note, USUAL)


def test_verdicts_on_a_bounce_vary_as_the_line_does():
    made = drive(speed=1.5 * BOUNCE)
    stiffness = np.asarray([0.97, 1.0, 1.03]) * STIFFNESS
    many = named(check(made, vary={"supports[0].stiffness_N_per_mm": stiffness / 1e3}), "clearance from the critical")
    for k, value in enumerate(stiffness):
        one = replace(made, supports=(replace(made.supports[0], stiffness=float(value)),))
        alone = named(check(one), "clearance from the critical")
        assert many.limit[1][k] == pytest.approx(alone.limit[1], rel=3e-3)


@pytest.mark.parametrize(("reached", "share"), [("half", 0.5), ("full", 0.95)])
@pytest.mark.parametrize("zeta", [0.05, 0.005])
def test_passing_in_the_time_told_builds_up_that_share(reached, share, zeta):
    """A run-up of an oscillator in complex error functions, from so far below that it begins at rest."""
    omega = 100.0
    rate = 0.4 * omega / passing_time(omega, zeta, 0.4, reached)
    found = run_up(omega, zeta, rate, 3.0 * omega / rate)
    # The amplitude of the formula is that of slow change; a fast run-up differs by its quick parts.
    assert found.peak / found.steady_peak == pytest.approx(share, rel=0.06 if zeta == 0.05 else 0.01)


def test_an_undamped_run_up_is_lewis_s():
    peak = run_up(100.0, 1e-6, 10.0, 20.0).peak
    assert peak == pytest.approx(1.466 * 100.0 / np.sqrt(10.0), rel=0.01)
    assert 0.0 < LOSS["shaft"] < LOSS["support"] < 0.2


def test_check_and_bending_speak_of_the_same_shaft_where_many_supports_give_way_below_it():
    """More modes of soft supports than joints lie below the one in which a shaft bows: it decides in both."""
    line = Drive.from_points([(-0.3, 0, 0), (0, 0, 0), (0.6, 0, 0), (1.2, 0, 0), (1.5, 0, 0)])
    tube = {"outer": 0.06, "inner": 0.03, "material": Material(youngs=E, density=RHO)}
    soft = tuple(Support(shaft=k, position=x, stiffness=2e5) for k, x in ((1, -0.05), (2, 0.3), (3, 0.3), (4, 0.05)))
    ends = (Support(shaft=1, position=-0.25, stiffness=2e5), Support(shaft=4, position=0.25, stiffness=2e5))
    shafts = (Shaft(number=1, **tube), Shaft(number=2, **tube), Shaft(number=3, **tube))
    whole = replace(line, shafts=(*shafts, Shaft(number=4, **tube)), supports=(*soft, *ends))
    whole = replace(whole, duty=Duty(speed=150.0))
    found = bending_speeds(whole)
    assert found.deciding is not None
    assert found.deciding >= len(whole.joints)
    margins = [float(one.value) for one in check(whole, only=["critical_speed"]) if one.run and one.sense == "at_least"]
    assert min(margins) == pytest.approx(found.margin.ratio, rel=1e-6)


def beside(share, **duty):
    """Return the drive with a bearing that is stiffer or softer sideways, by a share of its stiffness up and down."""
    plain = drive(**duty)
    return replace(plain, supports=(replace(plain.supports[0], side_stiffness=share * STIFFNESS),))


@pytest.mark.slow
@pytest.mark.parametrize("share", [0.6, 1.6])
def test_a_support_that_is_stiffer_sideways_bounces_at_two_speeds(share):
    """The critical speeds are those of both drives whose support is alike all round."""
    line = beside(share)
    alike = replace(line, supports=(replace(line.supports[0], stiffness=share * STIFFNESS, side_stiffness=None),))
    found, down, aside = bending_speeds(line), bending_speeds(drive()), bending_speeds(alike)
    assert np.all(np.diff(found.speed) > 0.0)
    bouncing = {one.sideways: k for k, one in enumerate(found.part) if one.kind == "support"}
    assert sorted(bouncing) == [False, True]
    assert found.speed[bouncing[True]] == aside.speed[0]
    assert found.speed[bouncing[False]] == down.speed[0]
    kept = [k for k, one in enumerate(found.part) if not one.sideways]
    np.testing.assert_array_equal(found.speed[kept], down.speed)
    assert (found.part[found.deciding], found.bowing) == (down.part[down.deciding], down.bowing)
    np.testing.assert_allclose(np.max(np.abs(found.deflection), axis=-1), 1.0, rtol=1e-3)  # between nodes of the other
    # what is on a shaft moves along with its length
    for j in range(len(found.part)):
        ends = [bending_speeds(_longer(line, factor)).speed[j] for factor in (0.98, 1.02)]
        power = np.diff(np.log(ends))[0] / np.log(1.02 / 0.98)
        assert length_powers(line, len(found.part))[0, j] == pytest.approx(power, abs=0.1)


def _longer(line, factor):
    """Return the line with a longer first tube, and its bearing as far along it."""
    more = (factor - 1.0) * LENGTHS[0]
    first, *joints = line.joints
    behind = (replace(one, centre=(one.centre[0] + more, *one.centre[1:])) for one in joints)
    return replace(
        line,
        joints=(first, *behind),
        supports=(replace(line.supports[0], position=factor * BEARING),),
        output=replace(line.output, point=(2.7 + more, 0.0, 0.0)),
    )


def test_no_speed_is_held_at_the_bounce_sideways():
    line = beside(1.6)
    k = next(k for k, one in enumerate(bending_speeds(line).part) if one.sideways)
    speed = float(bending_speeds(line).speed[k])
    held = replace(line, duty=Duty(speed=speed))
    found = bending_speeds(held)
    assert (found.status, found.failed) == (Running.NEAR, True)
    assert "bounce mode on support 1 (centre bearing), sideways: too near" in told(answer(held, found).sentence, USUAL)
    failed = [one for one in check(held, only=["critical_speed"]) if one.state == "failed" and not one.advice]
    (one,) = [one for one in failed if "sideways" in one.title]
    assert one.title == "clearance from the critical speed, bounce mode on support 1 (centre bearing), sideways"
    assert "supports[0].side_stiffness" in one.design_variables
    # many drives: by the power of the stiffness sideways, of which alone that speed depends
    many = check(held, only=["critical_speed"], vary={"supports[0].side_stiffness_N_per_m": [1.5e5, 1.7e5]})
    (limits,) = [one.limit for one in many if "sideways" in one.title and not one.advice]
    for j, stiffness in enumerate((1.5e5, 1.7e5)):
        alike = bending_speeds(
            replace(line, supports=(replace(line.supports[0], stiffness=stiffness, side_stiffness=None),))
        )
        alone = next(float(v) for v, part in zip(alike.speed, alike.part, strict=True) if part.kind == "support")
        assert limits[0][j] == pytest.approx(0.8 * alone, rel=2e-3)
