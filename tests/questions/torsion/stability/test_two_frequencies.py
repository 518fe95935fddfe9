"""Orders that do not repeat with the joints leave the growth of a disturbance as it is, to first order."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from cardan.questions.torsion.model.inputs import Swinging
from cardan.questions.torsion.model.torsional_model import Torque, torsional_line
from cardan.questions.torsion.steady.run_stability import floquet
from cardan.questions.torsion.steady.steady import periodic_response
from cardan.questions.torsion.steady.two_frequencies import side_bands
from cardan.units import deg

JOINT, YOKE, LAST, SPRING, DAMPER, ORDER = 25 * deg, 0.01, 0.4, 1000.0, 3.0, 3.315
SPEED = 49.386  # amid the principal zone of its only mode, just damped enough


def grown(amplitude: float) -> float:
    """Return the growth rate [1/s] of the distance of two motions, by scipy and an equation written here.

    The input turns evenly; the spring leads to the driving yoke, angle q; behind the joint the last mass, on which a
    torque swings with its own angle.
    """
    cosine, square, tau = np.cos(JOINT), np.sin(JOINT) ** 2, np.tan(JOINT / 2) ** 2

    def rates(t: float, state: np.ndarray) -> list[float]:
        q, v = state
        below = 1.0 - square * np.cos(q) ** 2
        first, second = cosine / below, -cosine * square * np.sin(2.0 * q) / below**2
        turned = q + np.arctan2(tau * np.sin(2.0 * q), 1.0 - tau * np.cos(2.0 * q))
        torque = SPRING * (SPEED * t - q) + DAMPER * (SPEED - v) + first * amplitude * np.sin(ORDER * turned)
        return [v, (torque - LAST * first * second * v**2) / (YOKE + LAST * first**2)]

    period = np.pi / SPEED
    settled = solve_ivp(rates, (0.0, 90 * period), [0.0, SPEED], "DOP853", rtol=1e-11, atol=1e-12).y[:, -1]
    ends = period * (90 + np.arange(41))
    way = {"method": "DOP853", "t_eval": ends, "rtol": 1e-12, "atol": 1e-13}
    one, other = (
        solve_ivp(rates, (ends[0], ends[-1]), settled + np.asarray([0.0, off]), **way).y for off in (0.0, 1e-3)
    )
    apart = np.log(np.hypot(SPEED * (other[0] - one[0]), other[1] - one[1]))
    return float((apart[-1] - apart[12]) / (ends[-1] - ends[12]))


@pytest.mark.slow
def test_the_growth_of_a_disturbance_is_that_without_the_order() -> None:
    """Amid the zone, at -1.3 1/s; what the order changes is of second order in its amplitude."""
    model = torsional_line(
        [[1.0, YOKE], [LAST]],
        stiffness=[[SPRING], []],
        damping=[[DAMPER], []],
        joint_angle=[JOINT],
        input_speed=SPEED,
    )
    steady = periodic_response(model)
    rate = float(floquet(steady).growth_rate)
    assert -2.0 < rate < -0.5
    swinging = Torque(station=2, law=Swinging(amplitude=60.0, frequency=ORDER))
    band = side_bands(steady.orbit, ORDER, (swinging,))
    assert band.highest[0, 0] - float(steady.torque_highest[0]) > 2.0  # the forced part is there
    alone = grown(0.0)
    assert alone == pytest.approx(rate, rel=0.01)
    changed = [abs(grown(amplitude) - alone) for amplitude in (60.0, 120.0)]
    assert changed[0] < 0.02 * abs(rate)
    assert changed[1] < 0.08 * abs(rate)
