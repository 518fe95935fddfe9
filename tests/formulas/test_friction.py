import array_api_strict as strict
import numpy as np
import pytest
from scipy.integrate import quad

from cardan import InputError
from cardan.formulas.friction import (
    Turning,
    branch_efficiency,
    joint_friction,
    reduced_friction,
    spline_efficiency,
    swings,
)
from cardan.units import deg
from tests.builders.friction_model import over_a_turn, torques
from tests.builders.vector_model import VectorModel

JOINT_ANGLES = [0.5, 5.0, 20.0, 45.0, 70.0]
TURN = over_a_turn()


@pytest.mark.parametrize("at", ["output", "input"])
@pytest.mark.parametrize("joint_angle", JOINT_ANGLES)
def test_the_work_of_a_turn_is_load_times_sliding(joint_angle, at):
    """A hair's breadth of friction does not act on itself: the plain model's losses over κ are then the first order."""
    tiny = 1e-9
    found = joint_friction(joint_angle * deg, 0.02, torque_at=at)
    plain = torques(VectorModel.from_angles([joint_angle * deg]), TURN, [tiny], at=at)
    for work, power in ((found.driving_pin_work, plain.lost_driving), (found.driven_pin_work, plain.lost_driven)):
        # The mean over 20,000 places misses kinks of |sin|, |cos| by 2 π²/(12·20,000²), steep joint angles count some
        # times.
        assert float(work) == pytest.approx(2 * np.pi * np.mean(power[0]) / tiny * 0.02, rel=3e-7)
    assert float(found.pin_work) == pytest.approx(float(found.driving_pin_work + found.driven_pin_work), rel=1e-15)


@pytest.mark.parametrize("at", ["output", "input"])
def test_bearings_take_load_times_turning(at):
    """Reactions of a secondary couple at two bearings of each shaft, Book (106), (107), times the turning there."""
    alpha, share = 30 * deg, 0.013

    def works(theta):
        w2 = 1 + (np.tan(alpha) * np.sin(theta)) ** 2
        two = 1.0 if at == "output" else np.cos(alpha) * w2
        one = np.tan(alpha) * abs(np.sin(theta)) * two / (np.cos(alpha) * w2)
        other = np.tan(alpha) * abs(np.cos(theta)) * two / np.sqrt(w2)
        return share * (one + other / (np.cos(alpha) * w2))

    # Each shaft has two bearings with half the reaction's moment each: μ d/2 · 2 R.
    want, _error = quad(works, 0, 2 * np.pi, points=np.pi * np.asarray([0.5, 1.0, 1.5]), epsabs=1e-14)
    assert float(joint_friction(alpha, 0.0, bearing_drag=share, torque_at=at).bearing_work) == pytest.approx(want)


@pytest.mark.parametrize("at", ["output", "input"])
@pytest.mark.parametrize("joint_angle", JOINT_ANGLES)
def test_mean_pin_load_is_the_mean_of_the_couple(joint_angle, at):
    def couple(theta):
        w = np.sqrt(1 + (np.tan(joint_angle * deg) * np.sin(theta)) ** 2)
        return 1 / (w * np.cos(joint_angle * deg)) if at == "output" else w

    want, _error = quad(couple, 0, np.pi / 2, epsabs=0, epsrel=1e-13)
    assert float(joint_friction(joint_angle * deg, 0.0, torque_at=at).mean_pin_load) == pytest.approx(
        2 / np.pi * want, rel=1e-13
    )


@pytest.mark.parametrize("at", ["output", "input"])
@pytest.mark.parametrize("joint_angle", JOINT_ANGLES)
def test_friction_acting_on_itself_agrees_with_couples_of_plain_vectors(joint_angle, at):
    drag = 0.08
    plain = torques(VectorModel.from_angles([joint_angle * deg]), TURN, [drag], at=at)
    into, out = (np.mean(plain.shaft[k] * plain.speed[k]) for k in (0, 1))
    lost = np.mean(plain.lost_driving[0] + plain.lost_driven[0])
    assert into - out == pytest.approx(lost, rel=1e-6)
    assert float(joint_friction(joint_angle * deg, drag, torque_at=at).exact) == pytest.approx(
        out / into, abs=2e-7 * lost
    )


def test_the_small_angle_rule_is_the_limit_and_low_by_the_known_factor():
    joint_angle = np.asarray([1e-4, 5 * deg, 10 * deg, 15 * deg, 20 * deg, 30 * deg, 40 * deg])
    found = joint_friction(joint_angle, 1e-3, torque_at="input")
    factor = (1 - found.first_order) / (1 - found.small_angle)
    # Losses of 1e-3 lose three digits to the one they are counted from; the printed factors have four decimals.
    assert np.allclose(factor, [1.0, 1.0019, 1.0077, 1.0176, 1.0318, 1.0759, 1.1474], rtol=0, atol=6e-5)


def test_self_action_counts_in_the_square_of_friction():
    found = [joint_friction(30 * deg, k) for k in (0.02, 0.01, 0.005)]
    gap = [float(one.first_order - one.exact) for one in found]
    assert gap[0] / gap[1] == pytest.approx(4.0, rel=0.03)
    assert gap[1] / gap[2] == pytest.approx(4.0, rel=0.02)
    assert float(found[0].exact) == pytest.approx(0.985754, abs=5e-7)
    assert float(found[0].first_order) == pytest.approx(0.985858, abs=5e-7)


def test_a_straight_joint_loses_nothing_and_a_stiff_one_locks_without_sinking_the_others():
    found = joint_friction(np.asarray([0.0, 80.0, 80.0]) * deg, np.asarray([0.5, 0.5, 0.1]))
    assert found.exact[0] == 1.0
    assert np.isnan(found.exact[1])
    assert 0 < found.exact[2] < 1
    assert list(found.status) == [Turning.FREE, Turning.LOCKED, Turning.FREE]


def test_locking_is_where_the_instant_reaches_zero():
    joint_angle = 50 * deg
    limit = 1 / np.tan(joint_angle)
    for pair, place in ((1, 0.0), (0, 0.5 * np.pi)):  # (1 - κ tan θ_2) of the power to the output, or θ_1 backwards
        swing = swings(np.sin(place), np.cos(place), np.asarray(joint_angle))[pair]
        assert 1.0 - limit * swing == pytest.approx(0.0, abs=1e-15)
    status = joint_friction(joint_angle, np.asarray([limit * (1 - 1e-12), limit * (1 + 1e-12)])).status
    assert list(status) == [Turning.FREE, Turning.LOCKED]


@pytest.mark.parametrize(("fit", "pressure"), [("new", lambda x: 1.0), ("run_in", np.cos)], ids=["even", "cosine"])
def test_reduced_friction_is_the_moment_of_the_pressure(fit, pressure):
    rubbed = quad(pressure, -np.pi / 2, np.pi / 2)[0]
    carried = quad(lambda x: pressure(x) * np.cos(x), -np.pi / 2, np.pi / 2)[0]
    assert float(reduced_friction(0.3, fit=fit)) == pytest.approx(0.3 * rubbed / carried, rel=1e-12)


def test_an_unknown_fit_is_named():
    with pytest.raises(InputError, match="worn") as caught:
        reduced_friction(0.1, fit="worn")
    assert caught.value.field == "fit"


def test_a_spline_takes_force_times_way():
    """Rub one second of strokes by hand: force 2μM/D over the way, against the work of the torque."""
    mu, stroke, strokes, wide, turns, torque = 0.12, 0.02, 3.0, 0.06, 15.0, 700.0
    lost = 2 * mu * torque / wide * stroke * strokes
    found = spline_efficiency(mu, stroke, strokes, wide, turns)
    assert float(found) == pytest.approx(1 - lost / (torque * 2 * np.pi * turns), rel=1e-14)


def test_branches_keep_the_balance_of_work():
    useful, eta = np.asarray([[1.0, 3.0], [2.0, 2.0]]), np.asarray([0.9, 0.6])
    found = branch_efficiency(useful, eta)
    assert np.allclose(found, useful.sum(-1) / (useful / eta).sum(-1), rtol=1e-15)
    assert np.allclose(branch_efficiency(useful / eta, eta, given="input"), found, rtol=1e-15)


def test_any_array_library_computes_them():
    joint_angle = strict.asarray([0.3, 0.5], dtype=strict.float64)
    drag = strict.asarray([0.01, 3.0], dtype=strict.float64)
    found = joint_friction(joint_angle, drag)
    plain = joint_friction(np.asarray([0.3, 0.5]), np.asarray([0.01, 3.0]))
    assert np.array_equal(np.asarray(found.exact), plain.exact, equal_nan=True)
    assert np.array_equal(np.asarray(found.first_order), plain.first_order)
