"""Batches of linear systems, some of them singular."""

from __future__ import annotations

import array_api_strict as strict
import numpy as np

from cardan.maths.linear.systems import solve_regular


def test_solves_what_can_be_solved() -> None:
    random = np.random.default_rng(0)
    matrix, load = random.normal(size=(5, 6, 6)), random.normal(size=(5, 3, 6))
    matrix[2, 3] = matrix[2, 4]
    matrix[4] = 0.0
    found, regular = solve_regular(matrix, load)
    assert regular.tolist() == [True, True, False, True, False]
    for k in (0, 1, 3):
        np.testing.assert_allclose(found[k] @ matrix[k].T, load[k], atol=1e-12)
    assert np.isnan(found[[2, 4]]).all()


def test_takes_any_array_library() -> None:
    found, regular = solve_regular(strict.asarray([[2.0, 0.0], [0.0, 4.0]]), strict.asarray([[1.0, 1.0]]))
    assert bool(regular)
    np.testing.assert_allclose(np.asarray(found), [[0.5, 0.25]])
