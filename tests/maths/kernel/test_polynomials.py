import numpy as np

from cardan.maths.kernel.polynomials import added, derivative, polynomial, product, roots


def test_batches_agree_with_numpy_one_by_one():
    rng = np.random.default_rng(0)
    one, other = rng.normal(size=(5, 4)), rng.normal(size=(5, 3))
    found = product(one, other), added(one, other), derivative(one), np.sort_complex(roots(one))
    for k in range(5):
        p, q = np.polynomial.Polynomial(one[k]), np.polynomial.Polynomial(other[k])
        wanted = (p * q).coef, (p + q).coef, p.deriv().coef, np.sort_complex(p.roots())
        for mine, theirs in zip(found, wanted, strict=True):
            np.testing.assert_allclose(mine[k], theirs, rtol=1e-9)


def test_coefficients_broadcast():
    assert polynomial(np.zeros((2, 1)), np.ones(3)).shape == (2, 3, 2)
    assert product(polynomial(1.0, 1.0), polynomial(np.zeros(3), 1.0)).tolist() == [[0.0, 1.0, 1.0]] * 3
