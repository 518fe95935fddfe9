"""What small functions of reading return."""

import math

from cardan.reading.given import without_unit
from cardan.reading.ranges import range_code
from cardan.reading.scalar import as_given, scalar, unknown_key
from cardan.units import Key


def test_without_unit():
    assert (
        without_unit("alpha_deg", "angle"),
        without_unit("delta_min", None),
        without_unit("tol_mm_a1", "length"),
    ) == ("alpha", "delta_min", "tol_a1")


def test_range_code():
    assert (range_code(Key("", "length", above=0.0), 0.0), range_code(Key("", "torque", low=0.0), -1.0)) == (
        "not_positive",
        "negative",
    )
    assert (range_code(Key("", "angle", low=0.0, below=1.57), -0.1), range_code(Key(""), math.nan)) == (
        "out_of_range",
        "not_finite",
    )


def test_as_given():
    assert (as_given("x"), as_given(True), as_given({})) == ("'x'", "true", "a table")


def test_unknown_key():
    assert unknown_key("speeed_rpm", ["speed_rpm", "torque_Nm"]) == "unknown key; the nearest known one is speed_rpm"


def test_scalar():
    length = Key("", "length", above=0.0)
    assert (
        repr((scalar(float, 20, length, 1e-3), scalar(float, "x", length)))
        == "(0.02, Wrong(message=\"must be a number, not 'x'\", code=''))"
    )
