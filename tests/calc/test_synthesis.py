import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cardan import calc
from tests.builders.vector_model import VectorModel

JOINT_ANGLE = st.floats(1.0, 40.0)
TWIST = st.floats(-180.0, 180.0)


def left(joint_angles, twists, yokes):
    return VectorModel.from_angles(np.radians(joint_angles), np.radians(twists), np.radians(yokes)).speed_fluctuation()


@st.composite
def tables(draw, most=6):
    n = draw(st.integers(2, most))
    return [draw(JOINT_ANGLE) for _ in range(n)], [draw(TWIST) for _ in range(n - 1)]


@pytest.mark.slow
@settings(max_examples=40)
@given(tables())
def test_every_set_returned_leaves_what_it_says_by_plain_vectors(table):
    joint_angles, twists = table
    found = calc("synthesis_continuous", {"alpha_deg": joint_angles, "beta_deg": twists})
    for yokes in found["gamma_deg_sets"]:
        # The vector model samples and fits a parabola, good to 1e-9; at δ = 0 it is exact to rounding.
        assert left(joint_angles, twists, yokes) == pytest.approx(found["delta_min"], abs=1e-9)
    assert found["delta"] == pytest.approx(found["delta_min"], abs=1e-14)


@pytest.mark.slow
@settings(max_examples=25)
@given(tables(), st.data())
def test_no_random_yokes_do_better_or_worse_than_the_bounds(table, data):
    joint_angles, twists = table
    found = calc("synthesis_continuous", {"alpha_deg": joint_angles, "beta_deg": twists})
    for _ in range(5):
        yokes = [data.draw(TWIST) for _ in twists]
        delta = left(joint_angles, twists, yokes)
        assert found["delta_min"] - 1e-9 <= delta <= found["delta_max"] + 1e-9


@pytest.mark.slow
@settings(max_examples=25)
@given(tables(), TWIST)
def test_held_yokes_stay_and_the_rest_does_what_it_can(table, held):
    joint_angles, twists = table
    inputs = {"alpha_deg": joint_angles, "beta_deg": twists, "fixed_gamma_deg": {"2": held}}
    found = calc("synthesis_continuous", inputs)
    for yokes in found["gamma_deg_sets"]:
        assert np.remainder(yokes[0] - held + 90, 180) == pytest.approx(90, abs=1e-9)
        assert left(joint_angles, twists, yokes) == pytest.approx(found["delta_min"], abs=1e-9)
    free = calc("synthesis_continuous", {"alpha_deg": joint_angles, "beta_deg": twists})
    assert free["delta_min"] <= found["delta_min"] + 1e-14


@settings(max_examples=10)
@given(tables(most=4), st.lists(st.integers(1, 12), min_size=3, max_size=3), st.lists(TWIST, min_size=3, max_size=3))
def test_spline_teeth_are_all_looked_at(table, teeth, offsets):
    joint_angles, twists = table
    teeth, offsets = teeth[: len(twists)], offsets[: len(twists)]
    found = calc(
        "synthesis_spline",
        {"alpha_deg": joint_angles, "beta_deg": twists, "spline_teeth": teeth, "gamma_offset_deg": offsets},
    )
    grids = np.meshgrid(*([o + 360 / z * np.arange(z)] for o, z in zip(offsets, teeth, strict=True)), indexing="ij")
    rows = np.stack([grid.ravel() for grid in grids], axis=-1)
    from cardan import equivalent_joint
    from cardan.sweeps import Drives

    delta = equivalent_joint(
        Drives.from_angles(
            np.broadcast_to(np.radians(joint_angles), (len(rows), len(joint_angles))),
            plane_twist=np.radians(twists),
            yoke_angle=np.radians(rows),
        )
    ).speed_fluctuation
    assert found["delta_min"] == pytest.approx(delta.min(), abs=1e-13)
    assert left(joint_angles, twists, found["gamma_deg"]) == pytest.approx(found["delta_min"], abs=1e-9)
    steps = (np.asarray(found["gamma_deg"]) - offsets) / (360 / np.asarray(teeth))
    halves = (np.asarray(found["gamma_deg"]) + 180 - offsets) / (360 / np.asarray(teeth))
    off = np.minimum(np.abs(steps - np.round(steps)), np.abs(halves - np.round(halves)))
    assert np.all(off < 1e-9)


def test_the_truck_power_unit_with_one_yoke_held_has_both_known_solutions():
    """Printed angles, γ_2 = 90°: the two exact answers, to the fifth digit of the degree."""
    inputs = {
        "alpha_deg": [11.5, 15 + 20 / 60, 15, 16.5],
        "beta_deg": [1.9, -(22 + 56 / 60), 49 + 59 / 60],
        "fixed_gamma_deg": {"2": 90.0},
    }
    found = calc("synthesis_continuous", inputs)
    assert found["delta"] <= 1e-14
    known = [[90.0, -1.69992, 82.84475], [90.0, 46.20406, -2.81141]]
    for want in known:
        assert any(
            np.allclose(np.remainder(np.subtract(got, want) + 90, 180), 90, rtol=0, atol=1e-5)
            for got in found["gamma_deg_sets"]
        )
