"""Absorbers, dampers, pendulums: full complex systems and numerical optima as independent truths."""

import array_api_strict
import numpy as np
import pytest
from scipy.optimize import minimize, minimize_scalar

from cardan import InputError
from cardan.book.straight_line import line_response
from cardan.formulas.absorbers import (
    absorber_response,
    absorber_stiffness,
    amplification,
    den_hartog,
    h_infinity,
    natural_frequencies,
    peak,
    viscous_optimum,
)
from cardan.formulas.pendulum import pendulum, tuned_length


def two_inertias(beta, alpha, f, xi):
    """Return both complex amplitudes by the full matrix of the system, J = c = M_0 = 1."""
    stiffness, drag = alpha * f**2, 2 * alpha * xi
    own = stiffness + 1j * beta * drag
    matrix = np.asarray([[1 + own - beta**2, -own], [-own, own - beta**2 * alpha]])
    return np.linalg.solve(matrix, [1.0, 0.0])


@pytest.mark.parametrize("f", [0.0, 0.7, 1.0, 1.4])
def test_the_response_is_that_of_two_coupled_inertias(f):
    rng = np.random.default_rng(1)
    beta = rng.uniform(0.05, 2.0, 40)
    for alpha, xi in rng.uniform(0.02, 0.5, (10, 2)):
        found = absorber_response(beta, alpha, f, xi)
        wanted = np.stack([two_inertias(b, alpha, f, xi) for b in beta], axis=-1)
        np.testing.assert_allclose(found.main, wanted[0], rtol=1e-12)
        np.testing.assert_allclose(found.absorber, wanted[1], rtol=1e-12)
        np.testing.assert_allclose(found.twist, wanted[1] - wanted[0], rtol=1e-11, atol=1e-13)
        np.testing.assert_allclose(found.amplification, abs(wanted[0]), rtol=1e-12)
        assert found.residual.max() < 1e-13


def test_batches_lead_and_frequencies_are_last():
    beta, alpha, f, xi = np.linspace(0.1, 2.0, 7), np.asarray([[0.1], [0.2]]), np.asarray([0.0, 0.9, 1.0]), 0.1
    found = absorber_response(beta, alpha, f, xi)
    assert found.amplification.shape == (2, 3, 7)
    assert found.natural.shape == (2, 3, 2)
    one = absorber_response(beta, 0.2, 0.9, xi)
    np.testing.assert_allclose(found.main[1, 1], one.main, rtol=1e-14)


def test_the_library_of_the_arrays_computes():
    xp = array_api_strict
    beta, tuned = np.linspace(0.0, 2.0, 9), np.asarray([0.0, 0.9])
    wanted = absorber_response(beta, 0.2, tuned, 0.1)
    found = absorber_response(
        xp.asarray(beta), xp.asarray(0.2, dtype=xp.float64), xp.asarray(tuned), xp.asarray(0.1, dtype=xp.float64)
    )
    np.testing.assert_allclose(np.asarray(found.amplification), wanted.amplification, rtol=1e-14)
    np.testing.assert_allclose(np.asarray(found.main), wanted.main, rtol=1e-14)


@pytest.mark.parametrize(("alpha", "f"), [(0.05, 1.0), (0.3, 0.6), (2.0, 1.5), (1e-9, 1.0), (1e-9, 1e-3)])
def test_natural_frequencies_are_those_of_the_matrix(alpha, f):
    lower, upper = natural_frequencies(alpha, f) ** 2
    total, held = 1 + (1 + alpha) * f**2, f**2
    # Vieta, and the smaller one by itself: it must not come from a difference.
    assert lower + upper == pytest.approx(total, rel=1e-14)
    assert lower * upper == pytest.approx(held, rel=1e-14)


def test_an_undamped_absorber_holds_the_system_still_at_its_own_frequency():
    found = absorber_response([0.8], 0.1, 0.8)
    assert found.amplification[0] == 0.0
    assert abs(found.absorber[0]) == pytest.approx(1 / (0.1 * 0.8**2), rel=1e-14)


def test_resonance_without_damping_is_infinite_and_a_loose_inertia_at_rest_is_not():
    found = absorber_response([0.0, 1.0], 0.5, 0.0)
    assert found.amplification.tolist() == [1.0, np.inf]
    assert found.bare.tolist() == [1.0, np.inf]
    assert found.residual.tolist() == [0.0, 0.0]
    assert absorber_response([0.0], 0.5, 0.9, 0.2).amplification.tolist() == [1.0]


@pytest.mark.parametrize("f", [0.0, 0.8, 1.0, 1.3])
@pytest.mark.parametrize("xi", [0.003, 0.1, 0.4, 3.0])
def test_the_peak_is_the_largest_of_a_fine_sweep(f, xi):
    alpha = np.asarray([1e-4, 0.05, 0.3, 1.0])
    beta, most = peak(alpha, f, xi)
    sweep = np.linspace(0.0, 3.0, 60_001)
    for k in range(4):
        places = sweep
        for _closer in range(4):
            curve = amplification(places, alpha[k], f, xi)
            at = int(np.argmax(curve))
            highest, step = places[at], places[1] - places[0]
            places = np.maximum(highest + step * np.linspace(-1.0, 1.0, 401), 0.0)
        # Where the curve is highest its slope is nought: half the digits tell the place, all the height.
        assert most[k] == pytest.approx(curve[at], rel=1e-9)
        assert beta[k] == pytest.approx(highest, abs=2e-7)


def test_without_damping_the_peak_is_infinite():
    beta, most = peak(0.1, [0.0, 1.0], 0.0)
    assert np.isinf(most).all()
    np.testing.assert_allclose(beta, [1.0, natural_frequencies(0.1, 1.0)[0]])


def test_fixed_points_do_not_feel_the_damping():
    alpha = np.asarray([0.02, 0.1, 0.5])
    found = den_hartog(alpha)
    for xi in (0.01, 0.2, 5.0):
        size = amplification(found.fixed_beta, alpha[:, None], found.frequency_ratio[:, None], xi)
        np.testing.assert_allclose(size, found.fixed_amplification[:, None] * np.ones(2), rtol=1e-12)
    assert (found.peak > found.fixed_amplification).all()


@pytest.mark.slow
@pytest.mark.parametrize("alpha", [0.05, 0.3])
def test_the_exact_optimum_is_that_of_a_numerical_search(alpha):
    """The largest of a sweep, refined about its highest places, made small by Nelder and Mead: no formula in common."""

    def worst(setting):
        f, xi = setting
        curve = np.abs([two_inertias(b, alpha, f, xi)[0] for b in sweep])
        top = 0.0
        for at in np.flatnonzero((curve[1:-1] >= curve[:-2]) & (curve[1:-1] >= curve[2:])) + 1:
            found = minimize_scalar(
                lambda b: -abs(two_inertias(b, alpha, f, xi)[0]),
                bounds=(sweep[at - 1], sweep[at + 1]),
                method="bounded",
                options={"xatol": 1e-9},
            )
            top = max(top, -found.fun)
        return top

    sweep = np.linspace(0.5, 1.3, 41)
    start = den_hartog(alpha)
    best = minimize(
        worst,
        [start.frequency_ratio * 1.01, start.damping * 0.95],
        method="Nelder-Mead",
        options={"xatol": 1e-7, "fatol": 1e-10, "maxiter": 400},
    )
    found = h_infinity(alpha)
    assert found.peak == pytest.approx(best.fun, rel=1e-6)
    assert found.frequency_ratio == pytest.approx(best.x[0], rel=1e-5)
    assert found.damping == pytest.approx(best.x[1], rel=1e-4)


def test_both_maxima_of_the_exact_optimum_are_equally_high_however_small_the_absorber():
    alpha = np.asarray([1e-4, 1e-2, 0.1, 1.0])
    found = h_infinity(alpha)
    _beta, most = peak(alpha, found.frequency_ratio, found.damping)
    np.testing.assert_allclose(most, found.peak, rtol=1e-9)
    for f, xi in ((1.0001, 1.0), (0.9999, 1.0), (1.0, 1.001), (1.0, 0.999)):
        assert (peak(alpha, found.frequency_ratio * f, found.damping * xi)[1] > found.peak).all()


def test_the_best_viscous_damper_peaks_at_its_fixed_point():
    alpha = np.asarray([0.05, 0.5, 2.0])
    found = viscous_optimum(alpha)
    beta, most = peak(alpha, 0.0, found.damping)
    np.testing.assert_allclose(most, found.peak, rtol=1e-9)
    np.testing.assert_allclose(beta, found.peak_beta, rtol=1e-5)
    for xi in (0.99, 1.01):
        assert (peak(alpha, 0.0, xi * found.damping)[1] > found.peak).all()


def test_sizes_come_back_as_the_ratios():
    found = den_hartog([0.05, 0.2])
    own, stiffness, damping = found.sized(0.4, 60.0)
    np.testing.assert_allclose(own / 0.4, found.inertia_ratio)
    np.testing.assert_allclose(np.sqrt(stiffness / own) / 60.0, found.frequency_ratio)
    np.testing.assert_allclose(damping / (2 * own * 60.0), found.damping)


def test_an_absorber_hung_on_a_line_calms_it_as_the_formula_says():
    """One station on a spring to the ground is the formula's system."""
    inertia, spring = 0.4, 1440.0
    own, stiffness, damping = h_infinity(0.1).sized(inertia, 60.0)
    omega = np.linspace(30.0, 90.0, 13)
    hung = absorber_stiffness(omega, own, stiffness, damping)
    found = line_response([inertia], [], omega, [1.0], ground=[spring], attached=hung[None])
    wanted = absorber_response(omega / 60.0, 0.1, h_infinity(0.1).frequency_ratio, h_infinity(0.1).damping)
    np.testing.assert_allclose(found.angle[0] * spring, wanted.main, rtol=1e-12)
    assert found.residual.max() < 1e-12


def test_an_absorber_that_swings_freely_holds_its_station():
    assert np.isinf(absorber_stiffness([20.0], 0.5, 200.0)[0].real)
    np.testing.assert_allclose(absorber_stiffness([10.0], 0.5, 0.0, 3.0), -50 * 30j / (30j - 50), rtol=1e-14)


@pytest.mark.parametrize("order", [0.5, 1.5, 2.0, 4.0])
def test_a_pendulum_weighs_what_two_degrees_of_freedom_say(order):
    m, r, arm, rotor, speed = 0.5, 0.12, 0.04, 0.1, 37.0
    w = order * speed
    mass = np.asarray([[rotor + m * (r + arm) ** 2, m * arm * (r + arm)], [m * arm * (r + arm), m * arm**2]])
    stiff = np.asarray([[0.0, 0.0], [0.0, m * r * arm * speed**2]])
    shaft, swing = np.linalg.solve(stiff - w**2 * mass, [1.0, 0.0])
    found = pendulum(m, r, arm, order)
    assert -1 / (w**2 * shaft) == pytest.approx(rotor + found.inertia, rel=1e-12)
    assert swing / shaft == pytest.approx(found.swing, rel=1e-12)
    assert pendulum(m, r, arm, order, count=3).inertia == pytest.approx(3 * found.inertia, rel=1e-14)


def test_at_its_own_order_a_pendulum_takes_all_the_torque():
    m, r, speed, torque = 0.5, 0.12, 37.0, 9.0
    arm = tuned_length(r, 2.0)
    found = pendulum(m, r, arm, [2.0, 2.1])
    assert found.tuned_order.tolist() == [2.0, 2.0]
    assert found.antiresonance.tolist() == [True, False]
    assert np.isnan(found.inertia).tolist() == [True, False]
    swing = found.answer[0] * torque / speed**2
    # The shaft stands, so the pendulum's reaction m l (R + l) ψ̈ is the torque.
    assert m * arm * (r + arm) * swing * (2 * speed) ** 2 == pytest.approx(torque, rel=1e-12)


@pytest.mark.parametrize(
    ("ask", "named"),
    [
        (lambda: den_hartog(0.0), ["inertia_ratio"]),
        (lambda: h_infinity([0.1, -0.1]), ["inertia_ratio"]),
        (lambda: viscous_optimum(np.nan), ["inertia_ratio"]),
        (lambda: absorber_response([-1.0], 0.0, -1.0, -0.1), ["beta", "inertia_ratio", "frequency_ratio", "damping"]),
        (lambda: pendulum(0.0, -1.0, 0.0, -2.0, count=0), ["mass", "radius", "length", "count", "order"]),
    ],
)
def test_what_makes_no_absorber_is_named_all_at_once(ask, named):
    with pytest.raises(InputError) as caught:
        ask()
    assert [problem.field for problem in caught.value.problems] == named
