"""Drives that say no damping have that of steel shafts, and the least that keeps them stable is told, by Mathieu."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from cardan import Drive
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.drive.duty import Duty
from cardan.drive.shaft import Shaft
from cardan.drive.station import Station
from cardan.drive.support import Support
from cardan.formulas.damping import LOSS
from cardan.questions.torsion.absorber import answer as absorber_answers
from cardan.questions.torsion.answer import answer as whole_answer
from cardan.questions.torsion.answer import ask
from cardan.questions.torsion.model.answer import answer as modes_answer
from cardan.questions.torsion.model.torsion import torsion_modes
from cardan.questions.torsion.model.torsional_train import torsional_train
from cardan.questions.torsion.optimise.answer import answer as optimise_answer
from cardan.questions.torsion.optimise.optimise import Grid, optimise_torsion
from cardan.questions.torsion.stability.answer import answer
from cardan.questions.torsion.stability.torsion_stability import stability
from cardan.questions.torsion.steady.answer import answer as response_answer
from cardan.questions.torsion.steady.torsion_response import torsion_response
from cardan.questions.torsion.transient.answer import answer as simulation_answer
from cardan.questions.torsion.transient.torsion_transient import transient
from cardan.units import deg

C, J = 1000.0, 0.4
OMEGA = float(np.sqrt(C / J))


def drive(joint_angle=5 * deg, speed=OMEGA, **shaft):
    """A spring before a joint that a machine turns evenly, a mass behind it: with small angles Mathieu's equation."""
    made = Drive.from_angles([joint_angle])
    spring = Shaft(number=1, stiffness=C, **shaft)
    return replace(made, shafts=(spring,), stations=(Station(shaft=2, inertia=J),), duty=Duty(speed=speed))


def grown(joint_angle, loss, speed):
    """Return the largest growth of a disturbance over a turn, by its exact equation integrated with SciPy.

    The yoke before the joint has no inertia: with φ1 the angle of the spring's far end and φ2 = f(φ1) that of the mass,
    c (Ω t - φ1) + b (Ω - φ1') is the torque before the joint and that over i = dφ2/dφ1 the one behind it.
    """
    cosine, viscous = np.cos(joint_angle), loss * C / speed

    def law(phi):
        low = 1.0 - np.sin(joint_angle) ** 2 * np.cos(phi) ** 2
        ratio = cosine / low
        return ratio, -cosine * np.sin(joint_angle) ** 2 * np.sin(2.0 * phi) / low**2

    def rate(t, y):
        # φ1 = Ω t + x; J d(i φ1')/dt = -(c x + b x')/i
        phi, x, v = speed * t + y[0], y[0], y[1]
        ratio, slope = law(phi)
        push = -(C * x + viscous * v) / ratio / J
        return [v, (push - slope * (speed + v) ** 2) / ratio]

    period = 2.0 * np.pi / speed
    keys = {"method": "DOP853", "rtol": 1e-11, "atol": 1e-14}

    # The steady motion: by Newton on its return map, with the variation by differences.
    def map_of(y):
        return solve_ivp(rate, (0.0, period), y, **keys).y[:, -1]

    y = np.zeros(2)
    for _step in range(6):
        size = 1e-6
        jacobian = np.stack([(map_of(y + size * e) - map_of(y - size * e)) / (2 * size) for e in np.eye(2)], axis=1)
        y = y - np.linalg.solve(jacobian - np.eye(2), map_of(y) - y)
    return float(np.max(np.abs(np.linalg.eigvals(jacobian))))


def test_a_drive_without_damping_has_that_of_steel_and_says_so():
    found = torsional_train(drive())
    assert found.usual_loss == LOSS["shaft"]
    assert found.model.loss_factor.tolist() == [LOSS["shaft"]]
    assert "shafts[0].loss_factor" in found.assumed
    said = [told(one.text, USUAL) for one in modes_answer(drive(), torsion_modes(drive())).remarks]
    assert any("shafts have η = 0.01" in one and "Corbo" in one for one in said)


@pytest.mark.parametrize(
    "made",
    [
        drive(damping=0.0),
        drive(loss_factor=0.0),
        drive(damping=0.3),
        replace(drive(), stations=(Station(shaft=2, inertia=J, ground_damping=0.1),)),
    ],
)
def test_any_damping_said_even_none_stands(made):
    assert torsional_train(made).usual_loss == 0.0


@pytest.mark.parametrize("off", [0.0, 0.001])
def test_the_least_damping_of_a_mode_is_mathieu_s(off):
    """At Ω = ω (1 + ε) the principal zone of Mathieu's equation closes from 2ζ = √(m² - 4ε²) on, m = α²/2."""
    joint_angle = 4 * deg
    found = torsion_modes(drive(joint_angle))
    m = 0.5 * joint_angle**2
    speed = OMEGA * (1.0 + off)
    want = np.sqrt(m**2 - 4.0 * off**2)
    assert found.least_loss((speed, speed))[0] == pytest.approx(want, rel=2e-2)
    assert stability(drive(joint_angle, speed)).least_loss == pytest.approx(want, rel=2e-2)
    assert found.least_loss((0.5 * OMEGA, 2.0 * OMEGA))[0] == pytest.approx(m, rel=1e-2)
    assert found.least_loss((1.1 * OMEGA, 2.0 * OMEGA))[0] == 0.0


@pytest.mark.slow
def test_the_least_damping_is_where_the_exact_equation_stops_growing():
    joint_angle = 12 * deg
    least = stability(drive(joint_angle)).least_loss
    assert grown(joint_angle, 0.97 * least, OMEGA) > 1.0 > grown(joint_angle, 1.03 * least, OMEGA)


@pytest.mark.parametrize(("joint_angle", "red"), [(5 * deg, False), (12 * deg, True)])
def test_red_only_where_more_is_needed_than_a_real_shaft_has(joint_angle, red):
    made = drive(joint_angle)
    found = stability(made)
    assert (found.least_loss > LOSS["shaft"]) == red
    assert bool(found.stable) == (not red)
    said = answer(made, found)
    assert (said.tone == "failed") == red
    assert any("Stable from a loss factor" in told(one.text, USUAL) for one in said.remarks)
    modes = modes_answer(made, torsion_modes(made))
    assert (modes.tone == "failed") == red
    both = whole_answer(made, ask(made))
    assert ("unstable" in told(both.sentence, USUAL)) == red
    undamped = drive(joint_angle, damping=0.0)
    assert modes_answer(undamped, torsion_modes(undamped)).tone == "failed"


@pytest.mark.slow
@pytest.mark.parametrize("off", np.linspace(-0.012, 0.012, 13).tolist())
def test_one_answer_never_says_both(off):
    """About the edge of a zone the formula of first order and the exact equations differ; the exact ones hold."""
    made = drive(12 * deg, OMEGA * (1.0 + off), loss_factor=0.001)
    said = told(whole_answer(made, ask(made)).sentence, USUAL)
    exact = bool(stability(made).stable)
    assert ("unstable in the operating range" in said) <= (not exact)
    assert ("; stable" in said) == exact


def test_a_drive_stable_with_its_own_dampers_needs_no_more():
    assert stability(drive(5 * deg, damping=3.0)).least_loss == 0.0


@pytest.mark.slow
def test_every_answer_on_torsion_says_which_friction_it_leaves_out() -> None:
    bent = replace(
        Drive.from_angles([14 * deg, 14 * deg], plane_twists=[25 * deg]),
        shafts=(Shaft(number=2, stiffness=5000.0, damping=2.0, inertia=0.02),),
        stations=(Station(shaft=3, name="pump", inertia=0.8),),
        duty=Duty(speed=30.0, torque=60.0, speed_range=(30.0, 60.0)),
    )
    journals = tuple(replace(one, friction=0.05) for one in bent.joints)
    rubbing = replace(bent, joints=journals, supports=(Support(shaft=3, position=0.1, bore=0.03, friction=0.02),))
    yoke = {"shafts[1].yoke_angle_deg": (-60.0, 20.0)}
    for made, there in ((bent, False), (rubbing, True)):
        ended = replace(made, duty=replace(made.duty, speed_range=None))
        absorbed = absorber_answers.ask(ended, progress=lambda _share: "stop")
        answers = (
            modes_answer(made, torsion_modes(made)),
            response_answer(made, torsion_response(made)),
            answer(made, stability(made)),
            absorber_answers.answer(ended, absorbed),
            optimise_answer(made, optimise_torsion(made, free=yoke, method=Grid(points=3))),
            simulation_answer(made, transient(made, span=0.05)),
        )
        for one in answers:
            said = [told(remark.text, USUAL) for remark in one.remarks]
            assert any("Friction of joints, supports is left out" in text for text in said) is there, one.name


@pytest.mark.slow
def test_friction_of_a_joint_damps_nothing_while_torques_keep_their_sign() -> None:
    """What the answers say of friction that they leave out: two masses, a joint of 20° whose journals rub, by SciPy."""
    bend, speed, load, spring, damper, first, mill = 20 * deg, 150.0, 300.0, 6000.0, 1.0, 0.05, 0.4

    def joint(a: float) -> tuple[float, float, float]:
        """Return ratio and slope of the driven shaft, and by how much both journals turn for the driving yoke."""
        below = 1.0 - np.sin(bend) ** 2 * np.cos(a) ** 2
        ratio = np.cos(bend) / below
        leans = np.tan(bend) * np.cos(a), np.tan(bend) * np.sin(a) / np.hypot(np.sin(a), np.cos(a) * np.cos(bend))
        ways = (
            np.tan(bend) * np.sin(a),
            np.tan(bend) * np.cos(a) * np.cos(bend) / np.hypot(np.sin(a), np.cos(a) * np.cos(bend)),
        )
        rubs = abs(ways[0]) / (1.0 + leans[0] ** 2) + abs(ways[1]) / (1.0 + leans[1] ** 2) * ratio
        return ratio, -np.cos(bend) * np.sin(bend) ** 2 * np.sin(2.0 * a) / below**2, rubs

    def twist(kappa: float, kick: float) -> np.ndarray:
        def slope(t: float, y: np.ndarray) -> list[float]:
            ratio, bending, rubs = joint(y[0])
            carried = spring * (speed * t - y[0]) + damper * (speed - y[1])
            pushed = carried - kappa * abs(carried) * rubs
            return [y[1], (pushed - ratio * load - mill * ratio * bending * y[1] ** 2) / (first + mill * ratio**2)]

        times = np.arange(72 * 80) * (2.0 * np.pi / speed / 80)  # whole turns
        start = [-load / spring, speed + kick]
        return solve_ivp(slope, (0.0, times[-1]), start, rtol=1e-9, atol=1e-11, t_eval=times).y[0]

    def decay(kappa: float) -> float:
        apart = (twist(kappa, 1e-2) - twist(kappa, 0.0)).reshape(72, 80)
        return float(0.5 * np.log(np.sum(apart[4:28] ** 2) / np.sum(apart[44:68] ** 2)))

    free = decay(0.0)
    assert free > 1.5  # from the damper alone
    for kappa in (0.0125, 0.05):
        # It takes a share of the torque, and so of what the damper does: by tight steps 0.8 and 5.5 %.
        assert 0.9 * free < decay(kappa) < 1.01 * free
