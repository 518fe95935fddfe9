"""Steady running against integration in time, another method, mirror images and its own balances."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan.errors import InputError
from cardan.maths.periodic.harmonics import HarmonicBalance, Status
from cardan.maths.periodic.switching_orbit import Chain, Shooting
from cardan.questions.torsion.model.inputs import Constant, History, Swinging
from cardan.questions.torsion.model.torsional_balance import element_torques
from cardan.questions.torsion.model.torsional_model import Torque, torsional_line
from cardan.questions.torsion.stability.floquet_map import speed_sweep
from cardan.questions.torsion.steady.run_stability import floquet, monodromy_in_pieces
from cardan.questions.torsion.steady.steady import periodic_response, steady_orbits
from tests.builders.torsion_in_time import drive, flow

SMOOTH = {
    "forced": {},
    "half order": {"order": 0.5},
    "third order": {"order": 3.0},
    "free with motor": {"free": True, "motor": True},
    "free with table": {"free": True, "table": True, "order": 1.5},
}


def begin(found, model):
    """Return the state of the free coordinates at phase 0, and the model with the drive torque found."""
    first = 0 if model.free else 1
    q, rate, _acceleration = found.orbit.at([0.0])
    if model.free:
        model = replace(model, torques=(*model.torques, Torque(station=0, law=Constant(value=found.orbit.force))))
    return np.concatenate([q[0, first:], rate[0, first:]]), model


@pytest.mark.parametrize("how", SMOOTH.values(), ids=SMOOTH)
def test_torques_and_their_orders_are_those_integrated_in_time(how: dict) -> None:
    model = drive(**how)
    found = periodic_response(model, speed=48.0)
    state, driven = begin(found, model)
    samples = 256
    times = found.period / 48.0 * np.arange(samples + 1) / samples
    path = flow(driven, 48.0, times[-1], state, times)
    count = path.shape[0] // 2
    q, rate = path[:count].T, path[count:].T
    if not model.free:
        q = np.concatenate([48.0 * times[:, None], q], axis=-1)
        rate = np.concatenate([np.full((samples + 1, 1), 48.0), rate], axis=-1)
    turned = found.period * (np.arange(2 * count) < count)
    np.testing.assert_allclose(path[:, -1] - path[:, 0], turned, atol=1e-7)  # it closes
    torque = element_torques(driven, q[:-1], rate[:-1])
    wave = np.fft.rfft(torque, axis=0) / samples
    np.testing.assert_allclose(found.torque.mean, wave[0].real, rtol=1e-7)
    orders = found.order.size
    # Harmonics of the motion are cut at 1e-9 of the largest: 1e-6 N·m here.
    np.testing.assert_allclose(found.torque.amplitude, 2.0 * np.abs(wave[1 : orders + 1]).T, atol=2e-5)
    main = np.argmax(found.torque.amplitude, axis=-1)
    for e, k in enumerate(main):
        assert np.exp(1j * found.torque.phase[e, k]) == pytest.approx(wave[k + 1, e] / abs(wave[k + 1, e]), abs=1e-6)
    assert np.all(found.torque_highest >= torque.max(axis=0) - 1e-6)
    assert np.all(found.peak_to_peak <= np.ptp(torque, axis=0) * 1.01)


@pytest.mark.parametrize("how", SMOOTH.values(), ids=SMOOTH)
def test_equations_and_power_balance_hold(how: dict) -> None:
    found = periodic_response(drive(**how), speed=48.0)
    assert found.status == Status.CONVERGED
    assert found.residual < 1e-9
    assert found.power_residual < 1e-12


@pytest.mark.slow
@pytest.mark.parametrize("how", SMOOTH.values(), ids=SMOOTH)
def test_shooting_finds_the_same(how: dict) -> None:
    model = drive(**how)
    one = periodic_response(model, speed=48.0)
    other = periodic_response(model, speed=48.0, method=Shooting())
    assert len(other.orbit.pieces) == 1
    np.testing.assert_allclose(other.torque.amplitude, one.torque.amplitude, atol=1e-6)
    np.testing.assert_allclose(other.torque_highest, one.torque_highest, rtol=1e-7)
    np.testing.assert_allclose(other.station_speed.amplitude, one.station_speed.amplitude, atol=1e-8)
    np.testing.assert_allclose(other.drive_torque.mean, one.drive_torque.mean, rtol=1e-8)


def test_the_first_station_of_a_free_drive_starts_at_nought() -> None:
    found = periodic_response(drive(free=True), speed=48.0)
    assert found.at([0.0]).station_angle[0, 0] == pytest.approx(0.0, abs=1e-12)
    assert np.mean(found.at(np.linspace(0, np.pi, 64, endpoint=False)).station_speed[:, 0]) == pytest.approx(48.0)


def test_the_drive_torque_of_a_free_drive_balances_load_and_losses() -> None:
    model = drive(free=True)
    found = periodic_response(model, speed=48.0)
    # Without dampers between the stations it would be the load's mean alone.
    assert found.drive_torque.mean[0] > 50.0 + 0.1 * 48.0
    assert found.drive_torque.mean[0] == pytest.approx(found.torque.mean[0], rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("backlash", "load", "speed", "contacts"),
    [(0.004, 20.0, 35.0, 4), (0.05, 10.0, 90.0, None)],
)
def test_with_open_backlash_the_motion_closes(backlash: float, load: float, speed: float, contacts: int | None) -> None:
    model = drive(speed, backlash=backlash, load=load, joint_angle=0.4)
    found = periodic_response(model)
    assert found.status == Status.CONVERGED
    pieces = found.orbit.pieces[0]
    assert len(pieces.switches) == contacts or (contacts is None and len(pieces.switches) > 0)
    state, _model = begin(found, model)
    after = flow(model, speed, np.pi / speed, state)
    # Every contact is stepped over by 1e-10 s in the integration.
    np.testing.assert_allclose(after - state, np.pi * (np.arange(len(state)) < len(state) // 2), atol=1e-6)
    assert found.power_residual < 1e-12
    assert found.residual < 1e-6


def test_a_damping_of_disturbances_of_their_own_holds_with_open_backlash_too() -> None:
    """The same damping said apart gives the slopes of the search; another keeps Liouville's product of its own."""
    model = drive(35.0, backlash=0.004, load=20.0, joint_angle=0.4)
    orbit = periodic_response(model).orbit
    alike = replace(orbit, model=replace(model, disturbed_damping=model.damping))
    np.testing.assert_allclose(monodromy_in_pieces(alike, 0), orbit.pieces[0].monodromy, rtol=1e-6, atol=1e-7)
    more = replace(orbit, model=replace(model, disturbed_damping=1.5 * model.damping))
    lost, own = (np.linalg.slogdet(monodromy_in_pieces(one, 0))[1] for one in (more, alike))
    assert lost < own < 0.0


@pytest.mark.slow
def test_two_elements_with_backlash_rattle_in_turn() -> None:
    model = replace(drive(36.0, load=12.0, joint_angle=0.4), backlash=np.asarray([0.02, 0.0, 0.0, 0.015]))
    found = periodic_response(model)
    assert found.status == Status.CONVERGED
    sides = found.orbit.pieces[0].sides
    assert set(sides[:, 0]) == set(sides[:, 3]) == {-1, 0, 1}
    state, _model = begin(found, model)
    after = flow(model, 36.0, np.pi / 36.0, state)
    np.testing.assert_allclose(after - state, np.pi * (np.arange(len(state)) < len(state) // 2), atol=1e-6)


def test_backlash_that_stays_closed_only_shifts_angles() -> None:
    one, other = periodic_response(drive(load=400.0)), periodic_response(drive(load=400.0, backlash=0.01))
    assert not other.orbit.pieces
    assert other.torque_lowest[0] > 0.0
    # What shifts by half the play meets the joints at another phase.
    np.testing.assert_allclose(other.torque.mean, one.torque.mean, rtol=1e-3)
    np.testing.assert_allclose(other.torque.amplitude[:, 0], one.torque.amplitude[:, 0], rtol=0.05)


def test_turned_backwards_a_mirrored_drive_does_the_same() -> None:
    model = drive()
    torques = (Torque(station=6, law=Constant(value=50.0)), *model.torques[1:])  # drag is its own mirror image
    mirrored = replace(model, phase=-model.phase, torques=torques)
    ahead, back = periodic_response(model), periodic_response(mirrored, speed=-48.0)
    np.testing.assert_allclose(back.torque.mean, -ahead.torque.mean, rtol=1e-10)
    np.testing.assert_allclose(back.torque.amplitude, ahead.torque.amplitude, atol=1e-9)
    np.testing.assert_allclose(back.torque_highest, -ahead.torque_lowest, rtol=1e-9)
    assert floquet(back).modulus == pytest.approx(floquet(ahead).modulus, rel=1e-9)


def test_a_vanishing_inertia_leads_to_none() -> None:
    def yoke(inertia):
        return torsional_line(
            [[1.0, inertia], [inertia, 0.5]], stiffness=[[3000.0], [4000.0]], damping=[[0.0], [0.0]], joint_angle=[0.4],
            torques=[Torque(station=3, law=Constant(value=-50.0))], input_speed=40.0,
        )  # fmt: skip

    none, little = periodic_response(yoke(0.0)), periodic_response(yoke(1e-6))
    np.testing.assert_allclose(little.torque.amplitude[:, 0], none.torque.amplitude[:, 0], rtol=1e-5)


@pytest.mark.slow
def test_a_sweep_equals_its_speeds_one_by_one() -> None:
    speeds = np.asarray([20.0, 37.0, 55.0, 90.0])
    loads = np.asarray([50.0, 80.0])
    model = drive(order=1.0)
    torques = (Torque(station=6, law=Constant(value=-loads)), *model.torques[1:])
    many = speed_sweep(replace(model, torques=torques), speeds)
    assert many.torque.amplitude.shape == (2, 4, 4, 10)
    for i, load in enumerate(loads):
        for k, speed in enumerate(speeds):
            one = periodic_response(drive(speed, order=1.0, load=load))
            np.testing.assert_allclose(many.torque.amplitude[i, k], one.torque.amplitude, atol=1e-6)
            np.testing.assert_allclose(many.torque_highest[i, k], one.torque_highest, rtol=1e-7)


def test_what_was_stopped_is_kept_and_the_rest_told() -> None:
    found = speed_sweep(drive(), np.linspace(40.0, 60.0, 300), progress=lambda _share: "stop")
    assert np.sum(found.status == Status.CONVERGED) == 256
    assert np.sum(found.status == Status.CANCELLED) == 44
    assert np.isfinite(found.torque.mean[:256]).all()
    assert np.isnan(found.torque.mean[256:]).all()


def test_with_few_harmonics_shooting_steps_in() -> None:
    few = HarmonicBalance(harmonics=2, most=2)
    found = periodic_response(drive(joint_angle=0.6), method=few)
    assert found.status == Status.CONVERGED
    np.testing.assert_allclose(
        found.torque.amplitude, periodic_response(drive(joint_angle=0.6)).torque.amplitude, atol=1e-6
    )


@pytest.mark.parametrize(
    ("law", "field"),
    [
        (Swinging(amplitude=1.0, frequency=6.8), "torques[2].order"),
        (History(times=np.asarray([0.0, 1.0]), torques=np.asarray([0.0, 1.0])), "torques[2].kind"),
    ],
)
def test_what_does_not_repeat_is_refused(law, field: str) -> None:
    model = drive()
    with pytest.raises(InputError) as caught:
        periodic_response(replace(model, torques=(*model.torques, Torque(station=1, law=law))))
    assert [problem.field for problem in caught.value.problems] == [field]


@pytest.mark.parametrize("speed", [None, 0.0, np.nan])
def test_without_a_speed_nothing_runs(speed: float | None) -> None:
    with pytest.raises(InputError, match="speed"):
        periodic_response(drive(free=True), speed=speed)


@pytest.mark.slow
def test_where_no_motion_is_found_the_search_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    """A load far beyond what the joints carry, at joint angles that no sum of harmonics follows."""
    model = drive(joint_angle=1.4, damping=0.0, load=1e5)
    tried: list[int] = []
    before = Chain.__init__

    def counted(self, system, omega, plan, guess) -> None:
        tried.append(int(plan.counts.sum()) * len(system.heavy))
        before(self, system, omega, plan, guess)

    monkeypatch.setattr(Chain, "__init__", counted)
    little = Shooting(work=40_000)
    orbit, status = steady_orbits(model, speed=20.0, opened=little)
    assert status == Status.NO_CONVERGENCE
    assert np.isnan(orbit.coefficient[1:]).all()
    assert 0 < sum(tried) <= little.work + max(tried)
    tried.clear()
    found = periodic_response(model, speed=0.01)  # too many swings in a period
    assert found.status == Status.NO_CONVERGENCE
    assert np.isnan(found.torque.mean).all()
    assert not tried


@pytest.mark.slow
def test_play_that_opens_at_some_speeds_alone() -> None:
    """What keeps contact is a sum of harmonics, the rest is made of pieces; both as each speed alone."""
    model = drive(backlash=0.004, load=40.0)
    speeds = np.asarray([25.0, 36.0, 48.0, 90.0])
    found = periodic_response(model, speed=speeds)
    assert np.all(found.status == Status.CONVERGED)
    opened = found.torque_lowest[:, 0] <= 0.0
    assert set(found.orbit.pieces) == set(np.flatnonzero(opened).tolist())
    assert 0 < opened.sum() < 4
    for k, speed in enumerate(speeds):
        one = periodic_response(drive(float(speed), backlash=0.004, load=40.0))
        np.testing.assert_allclose(found.torque_highest[k], one.torque_highest, rtol=1e-8)
