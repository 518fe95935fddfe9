"""Points of a sweep: each follows from its number, and designs are what they say."""

import numpy as np
import pytest
from scipy import stats

from cardan import InputError
from cardan.batch.points.axes import Points
from cardan.batch.points.distributions import METHODS, shuffled, uniforms
from cardan.sweeps import GridAxis, Normal, SampledAxis, TableAxis, Triangular, Truncated, Uniform


def test_a_grid_is_evenly_spaced_with_both_ends():
    grid = GridAxis(field="a", start=-1.0, stop=0.3, count=14)
    assert np.allclose(grid.values(np.arange(14))["a"], np.linspace(-1.0, 0.3, 14), rtol=0, atol=1e-15)
    assert grid.values(np.asarray([13]))["a"][0] == 0.3


def test_points_are_the_product_of_the_axes_the_first_one_slowest():
    axes = (
        GridAxis(field="a", start=0, stop=1, count=2),
        TableAxis(fields=("b", "c"), rows=((1, "x"), (2, "y"), (3, "z"))),
    )
    found = Points(axes=axes).values(0, 6)
    assert found["a"].tolist() == [0, 0, 0, 1, 1, 1]
    assert found["b"].tolist() == [1, 2, 3, 1, 2, 3]
    assert found["c"].tolist() == ["x", "y", "z"] * 2


def test_no_axes_are_one_point():
    assert Points(axes=()).size == 1
    assert Points(axes=()).values(0, 1) == {}


def test_a_hundred_million_points_are_not_made_before_they_are_asked_for():
    axes = tuple(GridAxis(field=f"f{k}", start=0, stop=1, count=100) for k in range(4))
    points = Points(axes=axes)
    assert points.size == 10**8
    assert points.values(10**8 - 1, 10**8) == {f"f{k}": 1.0 for k in range(4)}


@pytest.mark.parametrize("method", METHODS)
def test_any_part_of_a_design_is_made_alike_in_any_order(method):
    whole = uniforms(method, 3, 11, 0, 10_000, 10_000)
    for start, stop in ((9_000, 9_500), (4_095, 4_098), (0, 1), (5_000, 5_000)):
        assert np.array_equal(uniforms(method, 3, 11, start, stop, 10_000), whole[start:stop])
    assert np.all((whole > 0.0) & (whole < 1.0))


@pytest.mark.parametrize("method", METHODS)
def test_another_seed_draws_other_points_as_even(method):
    one, other = (uniforms(method, 2, seed, 0, 4096, 4096) for seed in (1, 2))
    assert not np.any(np.all(one == other, axis=1))
    for part in (one, other):  # 4096 independent draws are off by 0.021 once in a thousand; all others by far less
        assert stats.kstest(part[:, 0], "uniform").statistic < 0.031


def test_every_cell_of_a_latin_hypercube_holds_one_point():
    count = 1237
    found = uniforms("lhs", 2, 5, 0, count, count)
    for k in range(2):
        assert sorted(np.floor(found[:, k] * count).astype(int).tolist()) == list(range(count))
    assert abs(np.corrcoef(found.T)[0, 1]) < 0.1  # shuffled: three standard deviations of 1/√1237


@pytest.mark.parametrize("count", [1, 2, 3, 255, 256, 257])
def test_shuffling_is_one_to_one_whatever_the_size(count):
    assert sorted(shuffled(np.arange(count), count, 9).tolist()) == list(range(count))


@pytest.mark.parametrize(
    ("given", "same"),
    [
        (Uniform(low=-2, high=3), stats.uniform(-2, 5)),
        (Normal(mean=4, std=0.5), stats.norm(4, 0.5)),
        (Truncated(mean=1, std=2, low=0, high=5), stats.truncnorm(-0.5, 2.0, 1, 2)),
        (Triangular(low=-1, mode=0.5, high=2), stats.triang(0.5, -1, 3)),
    ],
    ids=lambda one: getattr(one, "kind", ""),
)
def test_distributions_are_those_of_scipy(given, same):
    share = np.linspace(0.001, 0.999, 501)
    assert np.allclose(given.at(share), same.ppf(share), rtol=1e-12, atol=1e-12)


def test_correlated_fields_are_correlated_and_keep_their_distributions():
    both = {"a": Normal(mean=0, std=1), "b": Normal(mean=5, std=2), "c": Uniform(low=0, high=1)}
    drawn = SampledAxis(distributions=both, count=2**13, method="sobol", correlations=(("a", "b", -0.7),))
    found = drawn.values(np.arange(2**13))
    assert abs(np.corrcoef(found["a"], found["b"])[0, 1] + 0.7) < 0.01
    assert abs(np.corrcoef(found["a"], found["c"])[0, 1]) < 0.01
    assert stats.kstest(found["b"], stats.norm(5, 2).cdf).statistic < 0.01


def test_correlated_points_are_the_same_bit_for_bit_one_by_one():
    three = {name: Normal(mean=0, std=1) for name in "abc"}
    drawn = SampledAxis(distributions=three, count=200, seed=7, correlations=(("a", "b", 0.5), ("b", "c", -0.3)))
    whole = drawn.values(np.arange(200))
    for k in range(200):
        assert all(whole[name][k] == one[0] for name, one in drawn.values(np.asarray([k])).items())


def test_a_design_across_another_axis_draws_each_point_once():
    drawn = SampledAxis(distributions={"a": Uniform(low=0, high=1)}, count=5, seed=3)
    found = Points(axes=(drawn, GridAxis(field="b", start=0, stop=2, count=3))).values(0, 15)
    assert np.array_equal(found["a"], np.repeat(drawn.values(np.arange(5))["a"], 3))


@pytest.mark.parametrize(
    ("make", "field"),
    [
        (lambda: GridAxis(field="a", start=0, stop=np.inf, count=3), "a: to"),
        (lambda: GridAxis(field="a", start=0, stop=1, count=0), "a: count"),
        (lambda: TableAxis(fields=("a",), rows=()), "a"),
        (lambda: TableAxis(fields=("a", "b"), rows=((1,),)), "a[0]"),
        (lambda: SampledAxis(distributions={}, count=3), "fields"),
        (lambda: Uniform(low=1, high=1), "high"),
        (lambda: Normal(mean=0, std=0), "std"),
        (lambda: Triangular(low=0, mode=2, high=1), "mode"),
        (lambda: Points(axes=(GridAxis(field="a", start=0, stop=1, count=2),) * 2), "a"),
    ],
)
def test_what_is_no_axis_is_refused(make, field):
    with pytest.raises(InputError) as error:
        make()
    assert error.value.field == field


def test_correlations_that_contradict_each_other_are_refused():
    three = {name: Normal(mean=0, std=1) for name in "abc"}
    odd = (("a", "b", 0.9), ("b", "c", 0.9), ("a", "c", -0.9))
    with pytest.raises(InputError, match="contradict"):
        SampledAxis(distributions=three, count=2, correlations=odd)
