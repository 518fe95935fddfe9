"""Floquet multipliers against differences of the flow, disturbed motion in time and Mathieu's boundaries."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.special import mathieu_a, mathieu_b

from cardan import example
from cardan.errors import InputError
from cardan.maths.compiled.method import Compiled
from cardan.questions.torsion.model.inputs import Asynchronous, Constant
from cardan.questions.torsion.model.torsional_balance import slopes
from cardan.questions.torsion.model.torsional_model import Torque, torsional_line
from cardan.questions.torsion.stability.floquet_map import floquet_map
from cardan.questions.torsion.stability.proved_speeds import proved_speeds
from cardan.questions.torsion.steady.run_stability import Kind, Verdict, floquet, nearest_zone
from cardan.questions.torsion.steady.steady import periodic_response, steady_orbits
from cardan.questions.torsion.steady.torsion_response import loaded_model
from cardan.units import rpm
from tests.builders.hill import hill_multipliers
from tests.builders.torsion_in_time import drive, flow


def begin(found, model):
    first = 0 if model.free else 1
    q, rate, _acceleration = found.orbit.at([0.0])
    if model.free:
        model = replace(model, torques=(*model.torques, Torque(station=0, law=Constant(value=found.orbit.force))))
    return np.concatenate([q[0, first:], rate[0, first:]]), model


def by_differences(model, speed, found, small):
    """Return the multipliers of the flow by central differences."""
    state, driven = begin(found, model)
    count = len(state)
    side = np.diag(np.where(np.arange(count) < count // 2, small, 100.0 * small))
    ends = flow(driven, speed, found.period / speed, np.concatenate([state + side, state - side]))
    matrix = (ends[:count] - ends[count:]) / (2.0 * np.diag(side)[:, None])
    return np.linalg.eigvals(matrix.T)


@pytest.mark.slow
@pytest.mark.parametrize(
    "how", [{}, {"order": 0.5}, {"free": True, "motor": True}], ids=["forced", "half order", "free"]
)
def test_multipliers_are_those_of_the_flow(how: dict) -> None:
    model = drive(48.0, **how)
    steady = periodic_response(model, speed=48.0)
    wanted = by_differences(model, 48.0, steady, 1e-5)
    if model.free:  # the shift in time
        wanted = np.delete(wanted, np.argmin(np.abs(wanted - 1.0)))
    # Differences of 1e-5 rad err by their square times the joint angle of the flow.
    np.testing.assert_allclose(floquet(steady).modulus, np.sort(np.abs(wanted))[::-1], atol=2e-6)


def test_hills_matrix_of_the_linearised_drive_has_the_same_multipliers() -> None:
    steady = periodic_response(drive(90.0, damping=0.3))

    def coefficients(share):
        found = slopes(steady.model, *steady.orbit.at(np.pi * share))
        return found.mass[None, :, 1:], found.damping[None, :, 1:, 1:], found.stiffness[None, :, 1:, 1:]

    wanted = hill_multipliers(coefficients, float(steady.orbit.time), harmonics=10)
    np.testing.assert_allclose(floquet(steady).modulus, np.abs(wanted), atol=1e-8)


@pytest.mark.slow
def test_with_open_backlash_jumps_at_contacts_count() -> None:
    model = torsional_line(
        [[1.0, 0.1], [0.4]], stiffness=[[4000.0], []], damping=[[4.0], []], backlash=[[0.01], []],
        joint_angle=[0.35], torques=[Torque(station=2, law=Constant(value=-20.0))], input_speed=50.0,
    )  # fmt: skip
    steady = periodic_response(model)
    assert len(steady.orbit.pieces[0].switches) == 4
    wanted = by_differences(model, 50.0, steady, 1e-5)
    # The integration steps 1e-10 s over every contact, and differences divide that by their step.
    np.testing.assert_allclose(floquet(steady).modulus, np.sort(np.abs(wanted))[::-1], atol=1e-4)


def test_a_disturbed_free_drive_returns_as_told() -> None:
    motor = Asynchronous(synchronous_speed=60.0, pullout_torque=150.0, pullout_slip=0.2)
    model = torsional_line(
        [[1.0, 0.1], [0.5]], stiffness=[[2000.0], []], damping=[[2.0], []], joint_angle=[0.4],
        torques=[Torque(station=0, law=motor), Torque(station=2, law=Constant(value=-40.0))],
    )  # fmt: skip
    steady = periodic_response(model, speed=50.0)
    found = floquet(steady)
    assert found.removed == 1
    assert found.stable
    state, driven = begin(steady, model)
    turns, period = np.asarray([0.0, 8.0, 16.0]), np.pi / 50.0
    moved = flow(driven, 50.0, 16.0 * period, state + np.asarray([0.0, 1e-4, 0.0, 0.01]), period * turns)
    apart = moved - state[:, None]
    apart[:2] -= np.pi * turns
    # A shift in time stays; without it the disturbance lies in what the other multipliers take away.
    tangent = np.concatenate([one[0] for one in steady.orbit.at([0.0])[1:]])
    values, vectors = np.linalg.eigh(np.eye(4) - np.outer(tangent, tangent) / (tangent @ tangent))
    plane = vectors[:, np.argsort(values)[1:]].real.T
    left = np.linalg.norm(plane @ apart, axis=0)
    slowest = float(found.spectral_radius) ** 8
    assert left[2] / left[1] == pytest.approx(slowest, rel=0.3)


@pytest.mark.slow
def test_the_growth_is_that_of_a_disturbance_in_time() -> None:
    model = torsional_line(
        [[1.0, 0.01], [0.4]],
        stiffness=[[1000.0], []],
        damping=[[0.2], []],
        joint_angle=[np.radians(25)],
        input_speed=49.386,
    )
    steady = periodic_response(model)
    found = floquet(steady)
    assert found.verdict == Verdict.UNSTABLE
    assert found.kind == Kind.DOUBLING
    assert found.order == pytest.approx(1.0)
    state, _model = begin(steady, model)
    period, alpha = np.pi / 49.386, math.radians(25)

    def rates(time: float, y: np.ndarray) -> list[float]:
        """(0.01 + 0.4 T'²) q̈ + 0.4 T' T'' q̇² = 1000 (Ωt - q) + 0.2 (Ω - q̇), on plain numbers."""
        q, rate = y.tolist()
        below = 1.0 - (math.sin(alpha) * math.cos(q)) ** 2
        first = math.cos(alpha) / below
        second = -first * math.sin(alpha) ** 2 * math.sin(2.0 * q) / below
        left = 1000.0 * (49.386 * time - q) + 0.2 * (49.386 - rate) - 0.4 * first * second * rate**2
        return [rate, left / (0.01 + 0.4 * first**2)]

    ends = [
        solve_ivp(
            rates, (0.0, 40.0 * period), begun, "DOP853", [0.0, 20.0 * period, 40.0 * period], rtol=1e-12, atol=1e-13
        ).y[0]
        for begun in (state, state + np.asarray([1e-7, 0.0]))
    ]
    far = np.abs(ends[1] - ends[0])
    # After twenty periods the other multiplier still holds 0.25 % of it.
    assert np.log(far[2] / far[1]) / (20 * period) == pytest.approx(float(found.growth_rate), rel=2e-3)


@pytest.mark.parametrize("joint_angle", [2.0, 4.0])
def test_at_small_bends_the_zone_is_mathieus(joint_angle: float) -> None:
    """c/J = a Ω² and q = 2τa, twice the book's; what is left over is of the order τ²."""
    alpha = np.radians(joint_angle)
    tau = np.tan(alpha / 2.0) ** 2
    model = torsional_line([[1.0, 0.0], [0.4]], stiffness=[[1000.0], []], joint_angle=[alpha], input_speed=1.0)
    natural = np.sqrt(1000.0 / 0.4)
    found = proved_speeds(model, 0.97 * natural, 1.03 * natural)
    edges = np.sort((natural / np.asarray([found.lowest[0], found.highest[0]])) ** 2)
    wanted = [brentq(lambda a, f=f: f(1, 2.0 * tau * a) - a, 0.8, 1.2) for f in (mathieu_b, mathieu_a)]
    np.testing.assert_allclose(edges, wanted, atol=2.1 * tau**2 + 1e-8)
    assert np.max(np.abs(edges - wanted)) < 1e-5


@pytest.mark.slow
def test_combinations_of_modes_are_found_where_they_are_expected() -> None:
    model = torsional_line(
        [[1.0, 0.02], [0.02, 0.3, 0.2]], stiffness=[[1500.0], [2500.0, 1200.0]], damping=[[0.02], [0.02, 0.02]],
        joint_angle=[np.radians(30)], input_speed=1.0,
    )  # fmt: skip
    found = proved_speeds(model, 60.0, 120.0)
    assert [found.zone.name((k,)) for k in range(len(found.worst))] == [
        "sum of modes 1 and 2",
        "sum of modes 1 and 3, zone 2",
        "principal zone of mode 2",
    ]
    assert found.kind.tolist() == [Kind.COMBINATION, Kind.COMBINATION, Kind.DOUBLING]
    assert np.all(np.abs(found.worst / found.zone.speed - 1.0) < 0.02)
    one = floquet(periodic_response(model, speed=float(found.worst[0])))
    assert abs(one.multipliers[0].imag) > 0.01
    assert found.margin(float(found.lowest[0]) - 2.0) == pytest.approx(2.0)
    assert found.margin(float(found.worst[0])) < 0.0


def test_without_damping_nothing_is_called_stable() -> None:
    model = drive(damping=0.0)
    model = replace(model, torques=model.torques[:1])
    found = floquet(periodic_response(model))
    assert found.verdict == Verdict.NEUTRAL
    assert not found.stable
    np.testing.assert_allclose(found.modulus, 1.0, atol=1e-8)


def test_free_drives_lose_the_multipliers_that_say_nothing() -> None:
    undamped = drive(free=True, damping=0.0)
    any_speed = replace(undamped, torques=undamped.torques[:1])
    held = drive(free=True, motor=True)
    one, two = floquet(periodic_response(any_speed, speed=48.0)), floquet(periodic_response(held, speed=48.0))
    assert (int(one.removed), int(two.removed)) == (2, 1)
    assert two.stable


def test_a_drift_of_the_speed_is_left_out_where_nothing_changes_with_it() -> None:
    """A drag of almost nothing makes it one multiplier of many: the others are the same."""
    model = drive(free=True)
    loose = replace(model, torques=model.torques[:1])
    dragged = replace(loose, ground_damping=loose.ground_damping + 1e-12)
    two, one = (floquet(periodic_response(each, speed=48.0)) for each in (loose, dragged))
    assert (int(two.removed), int(one.removed)) == (2, 1)
    kept, all_of_them = (each.multipliers[np.isfinite(each.multipliers)] for each in (two, one))
    drift = int(np.argmin(np.abs(all_of_them - 1.0)))
    assert abs(all_of_them[drift] - 1.0) > 1e-6  # what dampers take changes with the speed
    np.testing.assert_allclose(kept, np.delete(all_of_them, drift), rtol=1e-8, atol=1e-12)


@pytest.mark.slow
def test_amid_a_resonance_the_shift_in_time_alone_is_never_judged() -> None:
    """There vibration turns a free drive as a whole as well; a multiplier of 1 must not be left over."""
    stand = example("unstable-drive")
    speeds = np.linspace(600.0, 760.0, 33) * rpm
    found = floquet(steady_orbits(loaded_model(stand, stand.duty, speeds)[1], speed=speeds)[0])
    assert np.all(found.removed == 2)
    assert not np.any(found.verdict == Verdict.NEUTRAL)
    assert np.min(np.abs(np.nan_to_num(found.multipliers) - 1.0)) > 1e-4
    few = speeds[[0, 8, 25, 32]]
    mapped = floquet_map(loaded_model(stand, stand.duty, few)[1], speed=few, method=Compiled()).floquet
    np.testing.assert_allclose(mapped.spectral_radius, found.spectral_radius[[0, 8, 25, 32]], rtol=1e-5)


def test_where_nothing_can_be_disturbed_everything_is_stable() -> None:
    load = Torque(station=1, law=Constant(value=-20.0))
    rigid = torsional_line([[1.0], [0.5]], stiffness=[[], []], joint_angle=[0.3], torques=[load])
    found = floquet(periodic_response(rigid, speed=[40.0, -40.0]))
    assert found.stable.tolist() == [True, True]
    assert found.removed.tolist() == [2, 2]
    assert np.isnan(found.multipliers).all()
    dragged = floquet(periodic_response(replace(rigid, ground_damping=np.asarray([0.1, 0.0])), speed=40.0))
    assert dragged.spectral_radius == pytest.approx(np.exp(-0.1 / 1.5 * np.pi / 40.0), rel=0.01)  # inertia changes


@pytest.mark.parametrize(
    ("damped", "backlash", "count"),
    [
        ((0.0, 0.0), 0.0, 2),
        ((50.0, 0.0), 0.0, 3),
        ((0.0, 50.0), 0.0, 3),
        ((50.0, 0.0), 0.02, 3),
        ((0.0, 1.0), 0.02, 2),  # out of contact this damper holds nothing back
    ],
)
def test_what_has_neither_inertia_nor_damper_is_no_state(damped: tuple, backlash: float, count: int) -> None:
    model = torsional_line(
        [[1.0, 0.0], [0.0, 0.5]], stiffness=[[3000.0], [4000.0]], damping=[[damped[0]], [damped[1]]],
        backlash=[[0.0], [backlash]], joint_angle=[0.4], torques=[Torque(station=3, law=Constant(value=-30.0))],
        input_speed=40.0, ground_damping=[[0.0, 0.0], [0.0, 0.4]],
    )  # fmt: skip
    steady = periodic_response(model)
    assert len(steady.orbit.pieces) == (backlash > 0.0)
    found = floquet(steady)
    assert np.sum(np.isfinite(found.multipliers)) == count
    assert np.all(found.modulus[:count] > 1e-12)


def test_the_product_of_the_multipliers_is_what_the_damping_says() -> None:
    found = floquet(periodic_response(drive(damping=0.2)))
    assert abs(found.determinant_residual) < 1e-9


def test_where_no_motion_is_found_nothing_is_judged() -> None:
    found = periodic_response(drive(), speed=[40.0, 50.0])
    lost = replace(found.orbit, coefficient=np.where([[[False]], [[True]]], np.nan, found.orbit.coefficient))
    assert floquet(lost).verdict.tolist() == [Verdict.STABLE, Verdict.UNKNOWN]


def test_zones_are_those_of_the_frequencies() -> None:
    frequencies = np.asarray([[40.0, 100.0]] * 3)
    speed = np.asarray([41.0, 69.0, 31.0])
    kind = np.asarray([Kind.DOUBLING, Kind.COMBINATION, Kind.COMBINATION])
    zone = nearest_zone(frequencies, speed, kind)
    assert [zone.name((k,)) for k in range(3)] == [
        "principal zone of mode 1",
        "sum of modes 1 and 2",
        "difference of modes 2 and 1",
    ]
    np.testing.assert_allclose(zone.speed, [40.0, 70.0, 30.0])


def test_ranges_that_are_none_are_refused() -> None:
    with pytest.raises(InputError) as caught:
        proved_speeds(drive(), 0.0, -2.0)
    assert [problem.field for problem in caught.value.problems] == ["lowest", "highest"]
