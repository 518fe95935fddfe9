import numpy as np
import pytest

from cardan.book.dynamic_book import book_beta, book_half_trace, book_zone, truck_example, validity
from cardan.errors import InputError
from cardan.maths.periodic.mathieu import boundaries, damped_zone, exponents


@pytest.mark.parametrize(
    ("a", "q", "miss"), [(0.774, 0.0066, 1e-10), (0.774, 0.1, 1e-5), (2.0, 0.3, 5e-4), (1.0, 0.01, 1e-8)]
)
def test_half_trace_of_the_book_is_right_to_the_fourth_power_of_q(a, q, miss):
    off = abs(float(book_half_trace(a, q)) - float(exponents(a, q).half_trace))
    half = abs(float(book_half_trace(a, 0.5 * q)) - float(exponents(a, 0.5 * q).half_trace))
    assert off < miss
    assert half < off / 12 or off < 1e-10


def test_half_trace_of_the_book_has_no_pole():
    """At a = 1 its fraction is 0/0, at a = 0 and below its root is not a number; the limits are finite."""
    for a in (1.0, 0.0, 0.25):
        left, middle, right = book_half_trace(a + np.asarray([-1e-7, 0.0, 1e-7]), 0.2)
        assert middle == pytest.approx(0.5 * (left + right), abs=1e-9)
    assert book_half_trace(-0.5, 0.0) == pytest.approx(np.cosh(np.pi * np.sqrt(0.5)))


def test_exponent_of_the_book_is_defined_between_nought_and_one():
    assert float(book_beta(0.774, 0.0066)) == pytest.approx(float(exponents(0.774, 0.0066).beta), abs=2e-8)
    assert np.isnan(book_beta([-0.1, 0.0, 1.0, 1.5, 0.999], [0.1, 0.1, 0.1, 0.1, 0.5])).all()


def test_zone_of_the_book_is_a_first_order_one():
    """Without damping (221) is 1 ∓ q, of which -q²/8 is missing on both sides; there is none below q = 2n."""
    q = np.asarray([0.02, 0.1])
    a, b = boundaries(q, 1)
    for edge, exact in zip(book_zone(q, 0.0), (b[:, 0], a[:, 1]), strict=True):
        assert edge - exact == pytest.approx(q * q / 8, rel=0.05)
    assert np.isnan(book_zone(0.1, 0.051)).all()
    lower, upper = damped_zone(0.1, 0.03)
    assert float(lower) == pytest.approx(0.9187837844, abs=1e-9)
    assert float(upper) == pytest.approx(1.0787166485, abs=1e-9)
    assert np.asarray(book_zone(0.1, 0.03)) == pytest.approx([0.92, 1.08])


def test_distances_are_those_from_every_order_of_the_free_motion():
    found = validity(2.0, 0.5, [0.0, 2.0, 0.5, 6.8, 3.0])
    reached = np.concatenate([sign * found.beta + 2.0 * np.arange(-9, 10) for sign in (1, -1)])
    wanted = [np.min(np.abs(reached - nu)) for nu in found.order]
    assert found.distance == pytest.approx(wanted, abs=1e-12)


def test_the_rule_looks_at_orders_nought_one_and_two_too():
    assert validity(0.5, 0.05, [6.0]).rule
    assert not validity(0.5, 0.11, [6.0]).rule
    assert not validity(0.09, 0.0, [1.0]).rule
    assert not validity(0.5, 0.05, [6.75]).rule
    near_one = validity(0.85, 0.05, [0.0, 2.0])
    assert np.all(near_one.distance > 0.1)
    assert not near_one.rule
    assert validity(0.5, -0.05, [6.0]).rule


def test_in_a_zone_there_is_no_exponent():
    found = validity(1.0, 0.05, [0.0, 2.0])
    assert not found.stable
    assert np.isnan(found.beta)
    assert np.isnan(found.distance).all()
    assert not found.rule
    assert found.too_far


@pytest.mark.slow
def test_the_rule_promises_too_much():
    """Within (237) neglecting q should cost 1 to 2 %; it costs up to a tenth at order 2, half at engine orders."""
    worst = {"joint": 0.0, "engine": 0.0}
    for a in np.linspace(0.11, 30.0, 120):
        for kind, order in (("joint", 2.0), ("engine", 0.5), ("engine", 1.5), ("engine", 4.5)):
            found = validity(float(a), 0.1, [order])
            if found.rule:
                worst[kind] = max(worst[kind], float(found.error[0]))
                assert found.too_far == (found.error[0] > 0.05)
    assert worst["joint"] > 0.1
    assert worst["engine"] > 0.5


def test_without_a_wave_nothing_is_neglected():
    found = validity(0.774, 0.0, [0.0, 2.0, 6.8])
    assert found.error == pytest.approx([0.0, 0.0, 0.0], abs=1e-15)
    assert found.simple == pytest.approx(found.solved, rel=1e-14)
    assert not found.too_far


def test_a_resonance_is_told_and_refuses_nothing():
    """Undamped, order 2 at a = 4 has no bound; the other orders have."""
    found = validity(4.0, 0.0, [0.0, 2.0])
    assert not found.rule
    assert np.isinf(found.solved).tolist() == [False, True]
    assert found.too_far
    with pytest.raises(InputError) as caught:
        validity(4.1, 0.0, [0.0, -2.0, np.nan])
    assert [problem.field for problem in caught.value.problems] == ["order[1]", "order[2]"]


def test_the_truck_runs_above_its_resonances():
    found = truck_example()
    assert found.speed**2 == pytest.approx(8110.62, abs=0.005)
    assert found.natural_frequency == pytest.approx(79.231, abs=5e-4)
    assert found.resonance_speed * 30 / np.pi == pytest.approx(378, abs=0.5)
    assert found.principal_speed * 30 / np.pi == pytest.approx(757, abs=0.5)
    assert found.beta == pytest.approx(0.8798275, abs=5e-8)
    amplitude = dict(zip(found.solution.order.round(6), found.solution.amplitude, strict=True))
    assert found.solution.mean == pytest.approx(-0.012015, abs=5e-7)
    assert amplitude[2.0] == pytest.approx(0.012306, abs=5e-7)
    assert amplitude[6.8] == pytest.approx(2.375e-5, abs=5e-9)
    assert amplitude[4.0] == pytest.approx(5.33e-6, abs=5e-9)
    assert amplitude[2.0] / amplitude[6.8] == pytest.approx(518, abs=0.5)


def test_the_truck_refuses_what_is_no_drive():
    with pytest.raises(InputError) as caught:
        truck_example(speed=0.0, a=-1.0)
    assert [problem.field for problem in caught.value.problems] == ["speed", "a"]
