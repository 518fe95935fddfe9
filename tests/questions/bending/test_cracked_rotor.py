"""Cracked shafts at a steady speed: another integrator, Hill's matrix, closed limits, the marks of the literature."""

import cmath
import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from cardan import InputError
from cardan.questions.bending.cracked_rotor import Crack, cracked_rotor
from tests.builders.hill import hill_multipliers

MASS, STIFFNESS = 0.617, 18875.154225936596
OMEGA = math.sqrt(STIFFNESS / MASS)
ARTICLE = {"damping_ratio": 0.02, "unbalance": 4e-6}
LIGHT = Crack(loss_xi=0.1, loss_eta=0.02)
DEEP = Crack(loss_xi=0.446, loss_eta=0.1)


def turned_matrix(angle, crack):
    """Return K/k_0 from the plain product of matrices."""
    share = math.cos(0.5 * angle) ** (2 * crack.breathing)
    turn = np.asarray([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    return turn @ np.diag([1.0 - share * crack.loss_xi, 1.0 - share * crack.loss_eta]) @ turn.T


@pytest.mark.parametrize(
    ("ratio", "crack", "phase"), [(0.5, LIGHT, 0.0), (1.3, Crack(loss_xi=0.4, loss_eta=0.15, breathing=5), 1.0)]
)
def test_another_integrator_stays_on_the_orbit(ratio, crack, phase):
    speed = ratio * OMEGA
    found = cracked_rotor(MASS, STIFFNESS, speed, crack=crack, unbalance_phase=phase, orders=40, **ARTICLE)

    def rate(time, state):
        angle = speed * time
        force = -STIFFNESS * turned_matrix(angle, crack) @ state[:2]
        force += 4e-6 * speed**2 * np.asarray([math.cos(angle + phase), math.sin(angle + phase)])
        force -= 2.0 * 0.02 * math.sqrt(STIFFNESS * MASS) * state[2:]
        return np.concatenate((state[2:], force / MASS + [9.81, 0.0]))

    place = complex(found.at([0.0])[0])
    velocity = complex(np.sum(1j * found.order * speed * found.amplitude))
    start = [place.real, place.imag, velocity.real, velocity.imag]
    turns = np.linspace(0.0, 4.0 * math.pi, 25)
    run = solve_ivp(rate, (0.0, turns[-1] / speed), start, "LSODA", turns / speed, rtol=1e-10, atol=1e-13)
    # The tolerance of LSODA, gathered over two turns.
    np.testing.assert_allclose(run.y[0] + 1j * run.y[1], found.at(turns), atol=2e-8 * abs(place))
    assert found.residual < 1e-11
    assert found.left_out < 1e-15


@pytest.mark.parametrize("ratio", [0.9, 1.9])
def test_the_multipliers_are_those_of_hills_matrix(ratio):
    found = cracked_rotor(1.0, 1.0, ratio, crack=DEEP, damping_ratio=0.002)

    def coefficients(share):
        one = np.ones((1, share.size, 2))
        spring = np.asarray([turned_matrix(2.0 * math.pi * part, DEEP) for part in share])[None]
        return one, 0.004 * one[..., None] * np.eye(2), spring

    wanted = hill_multipliers(coefficients, 2.0 * math.pi / ratio, harmonics=9)
    np.testing.assert_allclose(
        np.sort_complex(np.round(found.multiplier, 9)), np.sort_complex(np.round(wanted, 9)), atol=1e-8
    )


def test_without_a_crack_only_the_weight_and_the_unbalance_are_left():
    ratio = np.asarray([0.3, 0.999, 2.5])
    found = cracked_rotor(MASS, STIFFNESS, ratio * OMEGA, unbalance_phase=0.7, **ARTICLE)
    np.testing.assert_allclose(found.amplitude[:, found.order == 0][:, 0], 9.81 / OMEGA**2, rtol=1e-14)
    turning = 4e-6 / MASS * ratio**2 * cmath.exp(0.7j) / (1.0 - ratio**2 + 0.04j * ratio)
    np.testing.assert_allclose(found.amplitude[:, found.order == 1][:, 0], turning, rtol=1e-11)
    rest = found.amplitude[:, (found.order != 0) & (found.order != 1)]
    np.testing.assert_array_equal(rest, 0.0)
    np.testing.assert_allclose(found.spectral_radius, np.exp(-2.0 * math.pi * 0.02 / ratio), rtol=1e-9)
    np.testing.assert_array_equal(found.torque(np.linspace(0.0, 6.0, 5)), 0.0)


def test_an_always_open_crack_is_a_shaft_of_two_stiffnesses():
    open_ = Crack(loss_xi=0.3, loss_eta=0.1, breathing=0)
    found = cracked_rotor(1.0, 1.0, 0.45, crack=open_, damping_ratio=0.03, gravity=1.0)
    # Weight stands in the fixed frame and turns backward in that of the shaft: orders 0 and 2 alone, two equations.
    mean, half, twice = 0.8, 0.1, 1.0 - 0.9**2 + 2j * 0.03 * 0.9 - 0.2
    still = 1.0 / (mean - half**2 / np.conj(twice))
    assert found.amplitude[found.order == 0][0] == pytest.approx(still, rel=1e-12)
    assert found.amplitude[found.order == 2][0] == pytest.approx(half * np.conj(still) / twice, rel=1e-12)
    assert found.order_amplitude(1) == found.order_amplitude(-1) == 0.0


def test_a_shaft_of_two_stiffnesses_is_unstable_between_its_critical_speeds():
    low, high = math.sqrt(0.7), math.sqrt(0.9)
    ratio = np.asarray([low - 1e-3, low + 1e-3, 0.9, high - 1e-3, high + 1e-3])
    found = cracked_rotor(1.0, 1.0, ratio, crack=Crack(loss_xi=0.3, loss_eta=0.1, breathing=0))
    np.testing.assert_array_equal(found.stable, [True, False, False, False, True])
    assert not found.half_order.any()


def test_half_orders_grow_near_twice_the_critical_speed():
    ratio = np.asarray([0.9, 1.75, 1.80, 1.85, 1.90])
    found = cracked_rotor(1.0, 1.0, ratio, crack=DEEP, damping_ratio=0.002)
    np.testing.assert_array_equal(found.stable, [False, True, False, False, False])
    np.testing.assert_array_equal(found.half_order, [False, False, True, True, True])
    assert found.spectral_radius[[0, 4]] == pytest.approx([1.31, 1.15], abs=0.01)


def test_the_orders_swell_at_whole_parts_of_the_critical_speed():
    ratio = np.linspace(0.25, 0.6, 141)
    found = cracked_rotor(MASS, STIFFNESS, ratio * OMEGA, crack=LIGHT, **ARTICLE)
    open_ = math.sqrt(1.0 - 0.25 * 0.12)  # the crack takes a quarter of the sum of its losses on the mean
    assert ratio[np.argmax(found.order_amplitude(2))] == pytest.approx(open_ / 2, abs=0.005)
    assert ratio[np.argmax(found.order_amplitude(3))] == pytest.approx(open_ / 3, abs=0.005)
    # The unbalance has no part in them.
    bare = cracked_rotor(MASS, STIFFNESS, ratio * OMEGA, crack=LIGHT, damping_ratio=0.02)
    np.testing.assert_allclose(bare.order_amplitude(0), found.order_amplitude(0), rtol=1e-2)
    assert np.max(np.abs(bare.order_amplitude(2) / found.order_amplitude(2) - 1.0)) < 0.1


def test_the_mean_torque_is_what_damping_takes():
    found = cracked_rotor(MASS, STIFFNESS, 0.5 * OMEGA, crack=DEEP, damping_ratio=0.02, orders=40)
    mean = float(np.mean(found.torque(2.0 * np.pi * np.arange(256) / 256)))
    lost = 0.04 * math.sqrt(STIFFNESS * MASS) * found.speed * np.sum((found.order * np.abs(found.amplitude)) ** 2)
    assert mean == pytest.approx(float(lost), rel=1e-11)


def test_slow_and_fast_shafts_and_sharp_cracks_are_as_exact():
    sharp = Crack(loss_xi=0.3, loss_eta=0.1, breathing=30)
    found = cracked_rotor(1.0, 1.0, [0.02, 0.7, 30.0], crack=sharp, damping_ratio=0.05, unbalance=0.1)
    assert np.max(found.residual) < 1e-9
    # Slow enough, the shaft follows its stiffness.
    slow = cracked_rotor(1.0, 1.0, 2e-3, crack=LIGHT, damping_ratio=0.5, gravity=1.0, orders=30)
    bent = [np.linalg.solve(turned_matrix(angle, LIGHT), [1.0, 0.0]) for angle in (0.0, 1.0, 2.5)]
    np.testing.assert_allclose(slow.at([0.0, 1.0, 2.5]), [one[0] + 1j * one[1] for one in bent], atol=1e-3)


def test_how_far_the_weight_rules_the_crack_is_told():
    found = cracked_rotor(MASS, STIFFNESS, [60.0, 170.0], crack=LIGHT, **ARTICLE)
    assert found.vibration_share[0] < 0.5 < 1.0 < found.vibration_share[1]
    sound = cracked_rotor(1.0, 1.0, 0.6, unbalance=0.3, gravity=2.0)
    assert sound.vibration_share == pytest.approx(0.3 * 0.36 / 0.64 / 2.0, rel=1e-12)
    assert np.isnan(cracked_rotor(1.0, 1.0, 0.6, unbalance=0.3, gravity=0.0).vibration_share)


def test_where_nothing_damps_a_resonance_there_is_no_steady_motion():
    found = cracked_rotor(1.0, 1.0, [1.0, 0.7], unbalance=1.0)
    np.testing.assert_array_equal(found.resonant, [True, False])
    assert np.isnan(found.residual[0])


def test_a_sweep_can_be_stopped():
    told = []

    def progress(share):
        told.append(share)
        return "stop"

    found = cracked_rotor(1.0, 1.0, np.linspace(0.5, 2.0, 60), damping_ratio=0.1, progress=progress)
    assert found.cancelled
    assert len(told) == 1
    assert np.isnan(found.spectral_radius[-1])
    assert not found.resonant.any()
    assert not found.stable[-1]


def test_what_makes_no_shaft_is_named():
    with pytest.raises(InputError) as caught:
        cracked_rotor(
            0.0, -1.0, 0.0, damping_ratio=-1.0, unbalance=-1.0, gravity=-1.0, unbalance_phase=np.inf, orders=1
        )
    assert [problem.field for problem in caught.value.problems] == [
        "mass",
        "stiffness",
        "speed",
        "damping_ratio",
        "unbalance",
        "gravity",
        "unbalance_phase",
        "orders",
    ]
    with pytest.raises(InputError, match="thousandth"):
        cracked_rotor(1.0, 1.0, [0.5, 1e-4])
