import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from cardan.units import DIMENSIONS, KEY, Key, deg, factor, label, mm, nearest, plain, preferred, quantity, rpm

UNITS = [(dimension, unit) for dimension, units in DIMENSIONS.items() for unit in units]


@pytest.mark.slow
@pytest.mark.parametrize(("dimension", "unit"), UNITS)
@given(value=st.floats(-1e6, 1e6))
def test_there_and_back_again(dimension, unit, value):
    scale = factor(dimension, unit)
    assert scale > 0
    # One multiplication and one division: half a unit in the last place each.
    assert value * scale / scale == pytest.approx(value, rel=3e-16)


@pytest.mark.parametrize(
    ("dimension", "unit", "si"),
    [
        ("length", "in", 0.0254),
        ("length", "ft", 0.3048),
        ("length", "cm", 0.01),
        ("angle", "deg", math.pi / 180),
        ("angle", "arcmin", math.pi / 10800),
        ("angular_speed", "rpm", 2 * math.pi / 60),
        ("frequency", "Hz", 2 * math.pi),
        ("frequency", "per_min", 2 * math.pi / 60),
        ("time", "min", 60.0),
        ("share", "percent", 0.01),
    ],
)
def test_factors_are_the_defined_ones(dimension, unit, si):
    assert factor(dimension, unit) == pytest.approx(si, rel=1e-15)


def test_short_names_are_the_factors():
    assert (deg, mm, rpm) == (factor("angle", "deg"), factor("length", "mm"), factor("angular_speed", "rpm"))


@pytest.mark.parametrize("dimension", DIMENSIONS)
def test_every_dimension_has_a_unit_to_write_and_a_label(dimension):
    assert preferred(dimension) in DIMENSIONS[dimension]
    assert label(preferred(dimension))


def test_no_unit_of_a_dimension_hides_another():
    """A key's unit is found by its ending: `_mm_s` must not be read as `_s`."""
    for units in DIMENSIONS.values():
        for one in units:
            clash = [other for other in units if other != one and one.endswith(f"_{other}")]
            assert not clash or all(len(other) < len(one) for other in clash)


@pytest.mark.parametrize(
    ("limits", "good", "bad"),
    [
        ({"low": 0.0, "below": 1.0}, [0.0, 0.5], [-1e-300, 1.0, math.nan, math.inf]),
        ({"above": 0.0, "high": 1.0}, [1e-300, 1.0], [0.0, 1.0 + 1e-15, -math.inf]),
        ({}, [-1e300, 0.0], [math.nan, math.inf, -math.inf]),
    ],
)
def test_a_key_allows_its_range_and_nothing_infinite(limits, good, bad):
    key = Key("x", "length", **limits)
    assert all(key.allows(value) for value in good)
    assert not any(key.allows(value) for value in bad)


def test_fields_carry_their_key():
    assert quantity("length", 1.0, doc="wall", above=0.0).metadata[KEY] == Key("wall", "length", above=0.0)
    assert plain(doc="teeth", low=1).metadata[KEY] == Key("teeth", None, low=1)


@pytest.mark.parametrize(
    ("word", "found"), [("centre_mmm", "centre_mm"), ("joint_angle_dg", "joint_angle_deg"), ("colour", None)]
)
def test_the_nearest_word_is_near(word, found):
    assert nearest(word, ["centre_mm", "joint_angle_deg", "kind"]) == found
