import array_api_strict as strict
import numpy as np
import pytest

from cardan.maths.arrays import argument, complex_of, namespace, real, unit_complex


def test_the_callers_arrays_decide():
    assert namespace(1.0, [2.0], np.zeros(2), np.float64(3)) is np
    assert namespace(1.0, strict.zeros(2)) is strict
    assert namespace(np.zeros(2), strict.zeros(2)) is strict


@pytest.mark.parametrize("xp", [np, strict])
def test_real_makes_64_bit_floats_and_keeps_those_it_gets(xp):
    kept = xp.asarray([1.0, 2.0], dtype=xp.float64)
    assert real(kept, xp) is kept
    assert real([1, 2], xp).dtype == xp.float64
    assert real(xp.asarray([1.0], dtype=xp.float32), xp).dtype == xp.float64
    assert complex_of(kept, xp).dtype == xp.complex128


@pytest.mark.parametrize("xp", [np, strict])
def test_the_argument_of_a_unit_complex_number_is_its_angle(xp):
    angle = xp.asarray([-3.0, -1.0, 0.0, 0.5, 3.0], dtype=xp.float64)
    assert bool(xp.all(xp.abs(argument(unit_complex(angle)) - angle) < 1e-15))
