"""Runs of a cracked shaft: on its steady orbit, by impulse responses, and growth by half orders."""

import math

import numpy as np
import pytest

from cardan import InputError
from cardan.maths.periodic.oscillator import stepped
from cardan.questions.bending.cracked_rotor import Crack, cracked_rotor
from cardan.questions.bending.cracked_run import cracked_run

LIGHT = Crack(loss_xi=0.1, loss_eta=0.02)
DEEP = Crack(loss_xi=0.446, loss_eta=0.1)


def test_at_a_steady_speed_the_run_stays_on_its_orbit():
    given = {"crack": LIGHT, "damping_ratio": 0.02, "unbalance": 1e-3, "unbalance_phase": 0.5, "gravity": 1.0}
    found = cracked_run(1.0, 1.0, 0.5, 0.0, 40.0, time=np.linspace(0.0, 40.0, 161), **given)
    steady = cracked_rotor(1.0, 1.0, 0.5, orders=30, **given)
    np.testing.assert_allclose(found.deflection, steady.at(found.angle), atol=1e-9)
    speed, order, size = found.orders(turns=1)
    np.testing.assert_allclose(speed, 0.5)
    np.testing.assert_allclose(
        size[-1][order == 0], steady.amplitude[steady.order == 0], atol=1e-5
    )  # orders above 4 are left in the fit


def test_a_sound_shaft_answers_by_its_impulse_response():
    push, rise, zeta, end = 1e-3, 0.05, 0.03, 50.0
    found = cracked_run(1.0, 1.0, 0.0, rise, end, damping_ratio=zeta, unbalance=push, gravity=0.0)

    def force(time):
        turned = push * ((rise * time) ** 2 - 1j * rise) * np.exp(0.5j * rise * time**2)
        return turned.real

    *_rest, (_time, x, v) = stepped(force, end, 4000, 1.0, zeta)
    assert found.deflection[-1].real == pytest.approx(x[-1], abs=1e-11)
    assert found.velocity[-1].real == pytest.approx(v[-1], abs=1e-11)
    assert found.peak == pytest.approx(np.max(np.abs(found.deflection)))
    assert found.peak_speed > found.natural_frequency  # the peak comes late


def test_running_down_through_half_the_critical_speed_shows_order_two():
    given = {"damping_ratio": 0.02, "unbalance": 4e-6}
    cracked = cracked_run(0.617, 18875.0, 100.0, -25.0, 1.2, crack=LIGHT, **given)
    sound = cracked_run(0.617, 18875.0, 100.0, -25.0, 1.2, **given)
    speed, order, size = cracked.orders()
    twice = np.abs(size[:, order == 2][:, 0])
    peak, half = speed[np.argmax(twice)], 0.5 * cracked.natural_frequency
    assert 0.9 * half < peak < half  # late, so below it when running down
    assert twice.max() > 3.0 * np.abs(sound.orders()[2][:, order == 2]).max() + 5e-5
    steady = cracked_rotor(0.617, 18875.0, np.linspace(60, 105, 91), crack=LIGHT, **given)
    assert twice.max() < steady.order_amplitude(2).max()


def test_near_twice_the_critical_speed_half_orders_grow_as_the_multiplier_says():
    given = {"crack": DEEP, "damping_ratio": 0.002, "gravity": 1.0}
    steady = cracked_rotor(1.0, 1.0, 1.9, **given)
    assert steady.half_order
    turn = 2.0 * math.pi / 1.9
    found = cracked_run(1.0, 1.0, 1.9, 0.0, 60 * turn, time=turn * np.linspace(0, 60, 60 * 16 + 1), **given)
    # Strobed once a turn, what is not the steady motion changes its sign and grows by the multiplier.
    strobed = found.deflection[::16] - steady.at([0.0])
    np.testing.assert_allclose(strobed[-1] / strobed[-2], -steady.spectral_radius, rtol=1e-3)
    order, size = (part[-1] if k else part for k, part in enumerate(found.orders(turns=8, reach=2, parts=2)[1:]))
    assert abs(order[np.argmax(np.abs(size))]) == 0.5


def test_a_run_can_be_stopped():
    found = cracked_run(1.0, 1.0, 0.5, 0.0, 100.0, progress=lambda share: "stop" if share > 0.3 else None)
    assert found.cancelled
    assert 30.0 < found.time[-1] < 60.0


@pytest.mark.parametrize(
    ("ask", "named"),
    [
        (lambda: cracked_run(0.0, 0.0, -1.0, np.inf, 0.0), ["mass", "stiffness", "end", "start_speed", "acceleration"]),
        (lambda: cracked_run(1.0, 1.0, 1.0, -1.0, 2.0), ["end"]),
        (lambda: cracked_run(1.0, 1.0, 1.0, 0.0, 2.0, time=[3.0]), ["time"]),
        (lambda: cracked_run(1.0, 1.0, 1e3, 0.0, 1e5), ["end"]),
        (
            lambda: cracked_run(1.0, 1.0, 1.0, 0.0, 1.0, damping_ratio=-1.0, unbalance_phase=np.nan),
            ["damping_ratio", "unbalance_phase"],
        ),
    ],
)
def test_what_makes_no_run_is_named(ask, named):
    with pytest.raises(InputError) as caught:
        ask()
    assert [problem.field for problem in caught.value.problems] == named
