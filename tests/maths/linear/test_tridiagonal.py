"""Chains of masses: dense matrices, more digits, and limits as independent truths."""

import array_api_strict
import mpmath
import numpy as np
import pytest
import scipy.linalg

from cardan.maths.compiled.method import Compiled, Plain
from cardan.maths.linear.tridiagonal import modes, response

METHODS = [Plain(), Compiled(threads=1), Compiled(threads=2)]


def laplacian(coupling):
    """Return Dᵀ diag(k) D."""
    steps = np.diff(np.eye(len(coupling) + 1), axis=0)
    return steps.T @ np.diag(coupling) @ steps


def dense(mass, coupling, omega, load, drag, ground, ground_drag):
    """Return displacements (n, f) by solving the full matrix at every frequency."""
    found = []
    for w in omega:
        matrix = laplacian(coupling + 1j * w * drag) + np.diag(ground + 1j * w * ground_drag - w * w * mass)
        found.append(np.linalg.solve(matrix, load))
    return np.stack(found, axis=-1)


def chain(n, seed):
    rng = np.random.default_rng(seed)
    return {
        "mass": rng.uniform(0.1, 2.0, n),
        "coupling": rng.uniform(1e3, 1e4, n - 1) * (1 + 0.05j * rng.uniform(0, 1, n - 1)),
        "omega": rng.uniform(1.0, 300.0, 11),
        "load": rng.normal(size=n) + 1j * rng.normal(size=n),
        "drag": rng.uniform(0.1, 2.0, n - 1),
        "ground": rng.uniform(0.0, 500.0, n),
        "ground_drag": rng.uniform(0.0, 1.0, n),
    }


@pytest.mark.slow
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("n", [1, 2, 3, 8, 21])
def test_the_response_is_that_of_the_full_matrix(n, method):
    """Damped, so the full matrix is solved to some 1e-13 of its largest displacement."""
    given = chain(n, n)
    given["load"][1::3] = 0.0
    wanted = dense(**given)
    found = response(**given, method=method)
    assert np.abs(found.displacement - wanted).max() < 1e-12 * np.abs(wanted).max()
    carried = given["coupling"][:, None] + 1j * given["omega"] * given["drag"][:, None]
    flow = -carried * np.diff(wanted, axis=0)
    assert np.abs(found.flow - flow).max(initial=0.0) < 1e-11 * np.abs(carried * wanted[1:]).max(initial=1.0)
    assert not found.resonant.any()


@pytest.mark.parametrize("method", METHODS)
def test_batches_broadcast(method):
    given = chain(4, 1)
    many = given | {"mass": given["mass"] * np.asarray([[[1.0]], [[2.0]]]), "ground": given["ground"] * np.ones((3, 1))}
    found = response(**many, method=method)
    assert found.displacement.shape == (2, 3, 4, 11)
    assert found.flow.shape == (2, 3, 3, 11)
    one = response(**(given | {"mass": 2 * given["mass"]}), method=Plain())
    # Lanes divide by the square of the size, NumPy by scaling: some units in the last place.
    np.testing.assert_allclose(found.displacement[1, 2], one.displacement, rtol=1e-12)


def test_the_library_of_the_arrays_computes():
    given = chain(5, 2)
    strict = {name: array_api_strict.asarray(value) for name, value in given.items()}
    wanted, found = response(**given), response(**strict)
    np.testing.assert_allclose(np.asarray(found.displacement), wanted.displacement, rtol=1e-12)
    np.testing.assert_allclose(np.asarray(found.flow), wanted.flow, rtol=1e-10)


@mpmath.workdps(50)
def holzer(mass, coupling, omega, force, place):
    """Return displacements and flows in 50 digits: transfer from the left, its start such that the right end fits."""
    m, k, w = [mpmath.mpf(x) for x in mass], [mpmath.mpf(x) for x in coupling], mpmath.mpf(omega)

    def transfer(start, load):
        x, flow, moved, flows = mpmath.mpf(start), mpmath.mpf(0), [], []
        for j in range(len(m)):
            moved.append(x)
            flow += w * w * m[j] * x + (load if j == place else 0)
            flows.append(flow)
            if j < len(k):
                x -= flow / k[j]
        return moved, flows

    one, forced = transfer(1, 0), transfer(0, mpmath.mpf(force))
    start = -forced[1][-1] / one[1][-1]
    return tuple([start * a + b for a, b in zip(p, q, strict=True)] for p, q in zip(one, forced, strict=True))


@pytest.mark.parametrize("method", METHODS[:2])
def test_slow_swings_of_stiff_free_chains_keep_their_digits(method):
    """k/(ω²m) is 1e14 here: a matrix in 64 bits would have no digit left."""
    mass, coupling = [1.5, 0.02, 0.05, 0.3], [8e9, 9e3, 4e9]
    for omega in (1e-3, 1.0):
        found = response(mass, coupling, [omega], [0, 0, 2.0, 0], method=method)
        moved, flows = holzer(mass, coupling, omega, 2.0, 2)
        np.testing.assert_allclose(found.displacement[:, 0].real, [float(x) for x in moved], rtol=1e-14)
        np.testing.assert_allclose(found.flow[:, 0].real, [float(x) for x in flows[:-1]], rtol=1e-14)


@pytest.mark.parametrize("method", METHODS[:2])
def test_a_part_in_resonance_holds_the_next_place_still(method):
    """The first mass swings on its spring at exactly 10 rad/s: the second one stands, as if clamped."""
    found = response([1.0, 3.0, 1.0], [100.0, 200.0], [10.0], [0.0, 0.0, 1.0], method=method)
    np.testing.assert_allclose(found.displacement[:, 0], [-0.02, 0.0, 0.01], rtol=1e-14, atol=1e-90)
    np.testing.assert_allclose(found.flow[:, 0], [-2.0, -2.0], rtol=1e-14)


@pytest.mark.parametrize("method", METHODS[:2])
def test_nothing_is_steady_at_a_natural_frequency_without_damping(method):
    found = response([1.0, 1.0], [50.0], [10.0, 11.0, 0.0], [0.0, 1.0], method=method)
    assert found.resonant.tolist() == [True, False, True]
    assert np.isnan(found.displacement[:, 0].real).all()
    assert np.isfinite(found.displacement[:, 1]).all()


def test_what_hangs_on_a_place_counts_like_its_own():
    given = chain(4, 3)
    more = np.asarray([0.0, 0.7, 0.0, 0.0])
    hung = -(given["omega"] ** 2) * more[:, None]
    one = response(**given, attached=hung)
    other = response(**(given | {"mass": given["mass"] + more}))
    np.testing.assert_allclose(one.displacement, other.displacement, rtol=1e-12)


@pytest.mark.parametrize("held", [False, True])
@pytest.mark.parametrize("n", [1, 2, 6, 40])
def test_modes_solve_the_eigenproblem(n, held):
    rng = np.random.default_rng(n)
    mass, coupling = rng.uniform(0.1, 2.0, n), rng.uniform(1e3, 1e4, n - 1)
    ground = rng.uniform(10.0, 500.0, n) if held else np.zeros(n)
    omega, shape = modes(mass, coupling, ground)
    squares = scipy.linalg.eigvalsh(laplacian(coupling) + np.diag(ground), np.diag(mass))
    # eigvalsh errs by some 1e-15 of the largest square.
    np.testing.assert_allclose(omega**2, squares, atol=1e-13 * max(squares.max(), 1.0))
    np.testing.assert_allclose(shape * mass @ shape.T, np.eye(n), atol=1e-13)
    stiff = shape @ (laplacian(coupling) + np.diag(ground)) @ shape.T
    np.testing.assert_allclose(stiff, np.diag(omega**2), atol=1e-12 * max(squares.max(), 1.0))
    if not held:
        assert omega[0] == 0.0
        assert np.ptp(shape[0]) == 0.0


def test_slow_frequencies_beside_fast_ones_keep_their_digits():
    """Squares of the frequencies span 1e11; square roots of eigenvalues would keep five digits of the slowest."""
    mass, coupling = [2.0, 1e-4, 1e-4, 0.6], [900.0, 4e8, 5e8]
    omega = modes(mass, coupling)[0]
    with mpmath.workdps(40):
        root = [mpmath.sqrt(m) for m in mass]
        exact = mpmath.matrix(laplacian(coupling).tolist())
        for i in range(4):
            for j in range(4):
                exact[i, j] /= root[i] * root[j]
        squares = mpmath.eigsy(exact, eigvals_only=True)
        wanted = [float(mpmath.sqrt(squares[i])) for i in range(1, 4)]
    np.testing.assert_allclose(omega[1:], wanted, rtol=1e-13)


@pytest.mark.parametrize("bare", [[0], [2], [5], [0, 1], [1, 3, 5], [2, 3]])
@pytest.mark.parametrize("held", [0.0, 30.0])
def test_places_without_mass_are_the_limit_of_small_masses(bare, held):
    rng = np.random.default_rng(4)
    mass, coupling = rng.uniform(0.5, 2.0, 6), rng.uniform(100.0, 300.0, 5)
    mass[bare] = 0.0
    ground = held * np.asarray([0, 1, 1, 0, 2, 1.0])
    omega, shape = modes(mass, coupling, ground)
    small = np.where(mass == 0.0, 1e-13, mass)
    near, moved = modes(small, coupling, ground)
    left = 6 - len(bare)
    assert np.isinf(omega[left:]).all()
    assert np.isnan(shape[left:]).all()
    np.testing.assert_allclose(omega[:left], near[:left], rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(shape[:left], moved[:left], atol=1e-7)


def test_modes_of_batches_are_those_of_each():
    mass = np.asarray([[1.0, 0.0, 2.0], [1.0, 3.0, 2.0], [0.0, 3.0, 2.0], [1.0, 0.0, 1.0]])
    omega, shape = modes(mass, [100.0, 200.0], [0.0, 0.0, 5.0])
    for k, row in enumerate(mass):
        one = modes(row, [100.0, 200.0], [0.0, 0.0, 5.0])
        np.testing.assert_allclose(omega[k], one[0], rtol=1e-14)
        np.testing.assert_allclose(shape[k], one[1], rtol=1e-12)
