import array_api_strict
import numpy as np
import pytest

from cardan.maths.linear.systems import broadcast_shapes, least_energy, surplus


def random_system(rng, m, u):
    root = rng.normal(size=(u, u))
    return rng.normal(size=(m, u)), rng.normal(size=m), root @ root.T / u, rng.normal(size=u)


@pytest.mark.parametrize(("m", "u", "rank"), [(5, 8, 5), (5, 8, 3), (6, 6, 6), (7, 4, 4), (7, 4, 2)])
def test_counts_what_is_too_many(m, u, rank):
    rng = np.random.default_rng(m * u + rank)
    matrix = rng.normal(size=(m, rank)) @ rng.normal(size=(rank, u))
    assert [int(count) for count in surplus(matrix)] == [u - rank, m - rank]


def test_least_energy_is_that_of_all_states_in_balance():
    rng = np.random.default_rng(3)
    a, b, c, d = random_system(rng, 4, 9)
    x, y = least_energy(a, b, c, d)
    # Another way: all states in balance are a particular one and a null space, in which the energy is a plain bowl.
    null = np.linalg.svd(a)[2][4:].T
    start = np.linalg.pinv(a) @ b
    other = start + null @ np.linalg.solve(null.T @ c @ null, null.T @ (d - c @ start))
    np.testing.assert_allclose(x, other, rtol=1e-11)
    np.testing.assert_allclose(c @ x + a.T @ y, d, atol=1e-12)


def test_compliances_of_any_size_are_well_scaled():
    a, b, c, d = random_system(np.random.default_rng(4), 4, 9)
    small = 1e-9
    np.testing.assert_allclose(least_energy(a, b, small * c, small * d)[0], least_energy(a, b, c, d)[0], rtol=1e-11)
    np.testing.assert_allclose(
        least_energy(a, b, small * c, small * d)[1], small * least_energy(a, b, c, d)[1], rtol=1e-11
    )


def test_what_is_determinate_does_not_care_for_stiffness():
    rng = np.random.default_rng(5)
    a, b = rng.normal(size=(6, 6)), rng.normal(size=6)
    np.testing.assert_allclose(least_energy(a, b, np.zeros((6, 6)), rng.normal(size=6))[0], np.linalg.solve(a, b))


def test_a_batch_with_one_matrix_equals_single_systems():
    rng = np.random.default_rng(6)
    a, b, c, _gap = random_system(rng, 4, 9)
    gaps = rng.normal(size=(2, 5, 9))
    shared = least_energy(a[None, None], b, c[None, None], gaps)
    apart = least_energy(np.broadcast_to(a, (2, 5, 4, 9)), b, c, gaps)
    for one, other in zip(shared, apart, strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-11)
    np.testing.assert_allclose(shared[0][1, 3], least_energy(a, b, c, gaps[1, 3])[0], rtol=1e-11)


def test_any_array_library_computes():
    xp = array_api_strict
    a, b, c, d = random_system(np.random.default_rng(7), 4, 9)
    x, _y = least_energy(*(xp.asarray(one) for one in (a, b, c, d)))
    np.testing.assert_allclose(np.asarray(x), least_energy(a, b, c, d)[0], rtol=1e-12)
    assert int(surplus(xp.asarray(a))[0]) == 5


@pytest.mark.parametrize("shapes", [((),), ((3, 1), (2,)), ((1,), (4, 1), (2, 4, 7)), ((0,), (1,))])
def test_shapes_join_as_in_numpy(shapes):
    assert broadcast_shapes(*shapes) == np.broadcast_shapes(*shapes)
