"""Steady torsional vibration and stability of whole drives, against the model's own solvers and closed forms."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from cardan import Drive, InputError
from cardan.book.straight_line import line_response
from cardan.drive.duty import Duty
from cardan.drive.machine import ConstantTorque, Engine, EngineHarmonic, HarmonicTorque, LinearTorque, TorqueHistory
from cardan.drive.shaft import Shaft
from cardan.drive.station import Pendulum, Station
from cardan.questions.torsion.model.inputs import Constant, Swinging
from cardan.questions.torsion.model.torsional_model import Torque, torsional_line
from cardan.questions.torsion.model.torsional_modes import straight_waves
from cardan.questions.torsion.stability import torsion_stability
from cardan.questions.torsion.stability.torsion_stability import stability
from cardan.questions.torsion.steady.run_stability import Verdict, floquet
from cardan.questions.torsion.steady.steady import periodic_response
from cardan.questions.torsion.steady.torsion_response import peak_refined, torsion_response
from cardan.questions.torsion.steady.two_frequencies import grouped
from cardan.units import deg, rpm

LINE = replace(
    Drive.from_angles([20 * deg]),
    shafts=(Shaft(number=1, stiffness=4000.0, damping=1.0), Shaft(number=2, stiffness=6000.0, damping=1.0)),
    stations=(
        Station(shaft=1, end="end", inertia=0.02),
        Station(shaft=2, end="start", inertia=0.02),
        Station(shaft=2, end="end", name="load", inertia=0.4),
    ),
    duty=Duty(speed=30.0, torque=60.0),
)


def test_a_drive_file_gives_what_its_model_gives() -> None:
    """The first case of the reference computations, by the keys of a drive file."""
    found = torsion_response(LINE)
    load = Torque(station=3, law=Constant(value=-60.0))
    model = torsional_line(
        [[0.0, 0.02], [0.02, 0.4]],
        stiffness=[[4000.0], [6000.0]],
        damping=[[1.0], [1.0]],
        joint_angle=[20 * deg],
        torques=[load],
        input_speed=30.0,
    )
    wanted = periodic_response(model)
    np.testing.assert_allclose(found.steady.torque.amplitude, wanted.torque.amplitude, rtol=1e-12, atol=1e-9)
    assert found.steady.torque.amplitude[:, 0] == pytest.approx([122.89011706, 116.74258043])
    np.testing.assert_allclose(found.floquet.multipliers, floquet(wanted).multipliers, rtol=1e-9)
    assert found.torque_highest == pytest.approx(wanted.torque_highest)


def test_a_list_of_speeds_is_each_alone() -> None:
    speeds = np.asarray([25.0, 34.0, 90.0])
    swept = torsion_response(LINE, speed=speeds)
    for k, speed in enumerate(speeds):
        alone = torsion_response(LINE, speed=float(speed))
        np.testing.assert_allclose(swept.swing[k], alone.swing, rtol=1e-8)


def test_structural_damping_counts_at_order_two_of_every_speed() -> None:
    lossy = replace(LINE, shafts=tuple(replace(one, damping=None, loss_factor=0.05) for one in LINE.shafts))
    for speed in (25.0, 40.0):
        viscous = [replace(one, loss_factor=None, damping=0.05 * one.stiffness / (2 * speed)) for one in lossy.shafts]
        wanted = torsion_response(replace(lossy, shafts=tuple(viscous)), speed=speed).swing
        np.testing.assert_allclose(torsion_response(lossy, speed=[speed, 90.0]).swing[0], wanted, rtol=1e-9)


def test_what_changes_with_the_speed_is_taken_at_every_speed() -> None:
    engine = Engine(cylinders=4, bore=0.08, stroke=0.09, mean_pressure=8e5, piston_mass=0.7)
    hung = replace(LINE.stations[2], pendulum=Pendulum(mass=0.2, radius=0.2, length=0.06))
    first = Station(shaft=1, end="start", inertia=0.5)
    drive = replace(LINE, stations=(first, *LINE.stations[:2], hung), duty=Duty(speed=30.0, torque=60.0, engine=engine))
    swept = torsion_response(drive, speed=[80.0, 160.0])
    alone = torsion_response(drive, replace(drive.duty, speed=160.0))
    np.testing.assert_allclose(swept.swing[1], alone.swing, rtol=1e-7)


def test_an_order_that_no_turns_hold_is_that_of_the_straight_line_where_joints_are_straight() -> None:
    swinging = HarmonicTorque(amplitude=9.0, order=6.8, phase=0.4, station="load")
    duty = replace(LINE.duty, torques=(swinging,))
    straight = replace(LINE, joints=(replace(LINE.joints[0], joint_angle=1e-3),))
    found, plain = torsion_response(straight, duty), torsion_response(straight)
    (apart,) = found.apart
    assert apart.exact
    chain = line_response(
        [1e12, 0.04, 0.4], [4000.0, 6000.0], [6.8 * 30.0], [0.0, 0.0, 9.0], damping=[1.0, 1.0]
    )  # an input that turns evenly is a very heavy one
    np.testing.assert_allclose(np.abs(apart.torque), np.abs(chain.torque[:, 0]), rtol=1e-4)  # it follows the swing
    np.testing.assert_allclose(found.torque_highest, plain.torque_highest + np.abs(apart.torque), rtol=1e-3)
    nearly = torsion_response(
        replace(LINE, joints=(replace(LINE.joints[0], joint_angle=1e-4),)),
        replace(duty, torques=(replace(swinging, order=7.0),)),
    )
    waves = straight_waves(nearly.steady.model, 3, 9.0, 7.0 * 30.0)
    assert nearly.steady.torque.amplitude[:, 6] == pytest.approx(np.abs(waves.torque), rel=2e-5)  # it follows the swing


THREE = (14 * deg, 21 * deg, 11 * deg)
SPRINGS, MASSES, DAMPER = (9000.0, 12000.0, 11000.0, 15000.0), (0.02, 0.03, 0.02, 0.19), 2.0


def three_joints(order: float = 3.315) -> Drive:
    """Return a drive whose first mode the side band of order 1.315 meets at 900 rpm."""
    return replace(
        Drive.from_angles(THREE),
        shafts=tuple(Shaft(number=k, stiffness=c, damping=DAMPER) for k, c in enumerate(SPRINGS, 1)),
        stations=(
            *(Station(shaft=k, end="start", inertia=j) for k, j in zip((2, 3, 4), MASSES, strict=False)),
            Station(shaft=4, end="end", name="load", inertia=MASSES[3]),
        ),
        duty=Duty(
            speed=900 * rpm,
            torque=140.0,
            torques=(HarmonicTorque(amplitude=300.0, order=order, phase=0.3, station="load"),),
        ),
    )


def in_time(joint_angles: np.ndarray, phases: np.ndarray, order: float, begin: float, end: float) -> np.ndarray:
    """Return the torques of the elements (t, 4) between two times, by scipy and equations written here."""
    tau, c, s2 = np.tan(joint_angles / 2) ** 2, np.cos(joint_angles), np.sin(joint_angles) ** 2
    omega, springs, masses = 900 * rpm, np.asarray(SPRINGS), np.asarray(MASSES)

    def turned(q: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        def angle(t: np.ndarray) -> np.ndarray:
            return t + np.arctan2(tau * np.sin(2 * t), 1 - tau * np.cos(2 * t))

        below = 1 - s2 * np.cos(q + phases) ** 2
        return angle(q + phases) - angle(phases), c / below, -c * s2 * np.sin(2 * (q + phases)) / below**2

    def torques(t: float, q: np.ndarray, v: np.ndarray) -> np.ndarray:
        out, by, _second = turned(q[:3])
        ahead, speed = np.append(omega * t, out), np.append(omega, by * v[:3])
        return springs * (ahead - q) + DAMPER * (speed - v)

    def rates(t: float, y: np.ndarray) -> np.ndarray:
        q, v = y[:4], y[4:]
        carried = torques(t, q, v)
        _out, by, second = turned(q[:3])
        inner = (carried[:3] - by * carried[1:] - masses[:3] * by * second * v[:3] ** 2) / (masses[:3] * by**2)
        last = (carried[3] - 140.0 + 300.0 * np.sin(order * q[3] + 0.3)) / masses[3]
        return np.concatenate([v, inner, [last]])

    state = np.append(np.zeros(4), np.full(4, omega))
    settled = solve_ivp(rates, (0.0, begin), state, "DOP853", rtol=1e-8, atol=1e-9).y[:, -1]
    times = np.linspace(begin, end, round(8000 * (end - begin)))
    found = solve_ivp(rates, (begin, end), settled, "DOP853", times, rtol=1e-9, atol=1e-10)
    return np.asarray([torques(t, y[:4], y[4:]) for t, y in zip(found.t, found.y.T, strict=True)])


@pytest.mark.slow
def test_joints_and_an_order_that_does_not_repeat_make_side_bands() -> None:
    """Extremes of a motion that never repeats, reached sooner or later: those of four seconds lie within."""
    found = torsion_response(three_joints())
    model = found.train.model
    wanted = in_time(model.joint_angle, model.phase, 3.315, 6.0, 10.0)
    # four seconds pass the extreme within a thousandth of the swing
    np.testing.assert_allclose(found.torque_highest, wanted.max(axis=0), atol=2e-3 * np.max(found.swing))
    np.testing.assert_allclose(found.torque_lowest, wanted.min(axis=0), atol=2e-3 * np.max(found.swing))
    sides = dict(found.side_orders(0.02))
    assert sorted(round(order, 6) for order in sides)[:2] == [1.315, 5.315]
    straight = np.abs(straight_waves(model, 7, 300.0, 3.315 * 900 * rpm).torque)
    plain = torsion_response(replace(three_joints(), duty=replace(three_joints().duty, torques=())))
    assert np.max(np.abs(plain.torque_highest + straight - wanted.max(axis=0))) > 5.0  # what side bands add


@pytest.mark.slow
def test_many_speeds_and_free_drives_have_them_too() -> None:
    speeds = np.linspace(700.0, 1100.0, 5) * rpm
    swept = torsion_response(three_joints(), speed=speeds)
    for k in (0, 3):
        alone = torsion_response(three_joints(), speed=float(speeds[k]))
        np.testing.assert_allclose(swept.torque_highest[k], alone.torque_highest, rtol=1e-4)
    heavy = replace(three_joints(), stations=(Station(shaft=1, inertia=1e5), *three_joints().stations))
    free = torsion_response(heavy, replace(heavy.duty, input="free"))
    np.testing.assert_allclose(free.swing, torsion_response(three_joints()).swing, rtol=1e-3)


@pytest.mark.slow
def test_where_a_resonance_leans_over_the_motion_is_followed() -> None:
    """The side band of order 1.315 meets mode 1 below 550 rpm and bends: Newton's steps from the joints alone fail."""
    found = torsion_response(three_joints(), speed=np.asarray([536.0, 542.0, 546.0, 550.0]) * rpm)
    assert found.bands[0].found.all()
    assert np.all(np.diff(np.max(found.swing, axis=-1)) < 0.0)


def test_orders_of_one_engine_have_one_phase() -> None:
    orders = (3.315, 1.6575, 2.2, 6.63)
    torques = tuple(Torque(station=0, law=Swinging(amplitude=1.0, frequency=order)) for order in orders)
    groups = [(base, [one.law.frequency for one in group]) for base, group in grouped(torques)]
    assert groups == [(pytest.approx(1.6575), [3.315, 1.6575, 6.63]), (2.2, [2.2])]


@pytest.mark.slow
def test_where_backlash_opens_the_straight_line_answers() -> None:
    first, *rest = three_joints().joints
    loose = replace(three_joints(), joints=(replace(first, backlash=0.002), *rest))
    loose = replace(loose, duty=replace(loose.duty, torque=1.0))
    found = torsion_response(loose)
    assert not found.apart[0].exact
    straight = np.abs(straight_waves(found.train.model, 7, 300.0, 3.315 * 900 * rpm).torque)
    np.testing.assert_allclose(np.abs(found.apart[0].torque), straight, rtol=1e-9)


def test_a_free_drive_needs_the_torque_that_its_losses_and_load_take() -> None:
    first = Station(shaft=1, end="start", inertia=1.5)
    duty = Duty(
        speed=70.0, input="free", load=LinearTorque(standstill=40.0, slope=0.2), motor=ConstantTorque(torque=50.0)
    )
    found = torsion_response(replace(LINE, stations=(first, *LINE.stations)), duty)
    assert float(found.steady.drive_torque.mean[0]) + 50.0 == pytest.approx(54.1, abs=0.2)  # near the mean of the load
    assert float(found.steady.power_residual) < 1e-9


def test_a_torque_in_time_is_sent_to_the_simulation() -> None:
    history = TorqueHistory(file="a.csv", times=(0.0, 1.0), torques=(0.0, 1.0))
    with pytest.raises(InputError, match=r"duty\.load\.kind: runs in time") as caught:
        torsion_response(LINE, Duty(speed=1.0, load=history))
    assert len(caught.value.problems) == 1


@pytest.mark.parametrize(
    ("speed", "field"), [(0.0, "duty.speed"), ([10.0, 0.0], "speed"), ([[1.0]], "speed"), ([], "speed")]
)
def test_standing_still_is_no_running(speed: float | list[float], field: str) -> None:
    with pytest.raises(InputError) as caught:
        torsion_response(LINE, speed=speed)
    assert [problem.field for problem in caught.value.problems] == [field]


@pytest.mark.slow
def test_a_stop_keeps_what_is_done() -> None:
    found = torsion_response(LINE, speed=np.linspace(20.0, 90.0, 300), progress=lambda _share: "stop")
    assert np.all(np.isfinite(found.swing[:256]))
    assert np.all(found.floquet.verdict[256:] == Verdict.UNKNOWN)


LOOSE = replace(
    Drive.from_angles([25 * deg]),
    shafts=(Shaft(number=1, stiffness=1000.0, damping=0.2),),
    stations=(Station(shaft=2, inertia=0.4),),
    duty=Duty(speed=50.0),
)


def test_the_principal_zone_grows_unless_damped() -> None:
    """One joint of 25° with a spring before it, run at its natural frequency: |ρ| 1.144, growing 2.12 1/s."""
    yoke = replace(LOOSE, stations=(*LOOSE.stations, Station(shaft=1, end="end", inertia=0.01)))
    at = replace(LOOSE.duty, speed=math.sqrt(1000.0 / 0.41))
    found = stability(yoke, at)
    assert float(found.spectral_radius) == pytest.approx(1.144, abs=2e-3)
    assert float(found.growth_rate) == pytest.approx(2.12, abs=0.02)
    assert (found.verdict, found.zone.name()) == (Verdict.UNSTABLE, "principal zone of mode 1")
    damped = stability(replace(yoke, shafts=(replace(LOOSE.shafts[0], damping=6.0),)), at)
    assert float(damped.spectral_radius) == pytest.approx(0.721, abs=2e-3)
    assert damped.stable


@pytest.mark.slow
def test_a_drift_of_the_speed_is_no_vibration() -> None:
    """Above the resonance of order 2 vibration takes less the faster it turns: constant torques would run away."""
    first = Station(shaft=1, end="start", inertia=1.2)
    duty = Duty(speed=52.0, torque=60.0, input="free")
    drive = replace(LINE, stations=(first, *LINE.stations))
    dragged = replace(first, ground_damping=1e-9)  # something changes with the speed: the drift is told
    drifting = torsion_response(replace(drive, stations=(dragged, *LINE.stations)), duty).floquet
    assert 1.0 < drifting.multipliers[0].real < 1.02
    assert not drifting.stable
    found = torsion_response(drive, duty)
    assert found.floquet.stable
    assert float(found.floquet.removed) == 2
    assert float(found.floquet.growth_rate) < -0.8
    braked = torsion_response(drive, replace(duty, torque=None, load=LinearTorque(standstill=60.0, slope=0.05)))
    assert float(braked.floquet.removed) == 1  # here the load holds the speed
    assert stability(drive, duty).growth_rate == pytest.approx(float(found.floquet.growth_rate), rel=1e-6)
    np.testing.assert_allclose(found.floquet.multipliers[:3], drifting.multipliers[1:4], rtol=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("turned", [False, True])
def test_a_map_is_each_point_alone(turned: bool) -> None:
    speeds, joint_angles = [400.0, 477.0, 560.0], [10.0, 25.0]
    axes = [("duty.speed_rpm", speeds), ("joints[0].joint_angle_deg", joint_angles)]
    found = stability(LOOSE, over=dict(axes[::-1] if turned else axes))
    for i, speed in enumerate(speeds):
        for j, joint_angle in enumerate(joint_angles):
            drive = replace(LOOSE, joints=(replace(LOOSE.joints[0], joint_angle=joint_angle * deg),))
            alone = stability(drive, Duty(speed=speed * rpm))
            index = (j, i) if turned else (i, j)
            assert found.spectral_radius[index] == pytest.approx(float(alone.spectral_radius), rel=1e-9)
            assert found.zone.name(index) == alone.zone.name()
    assert 0.0 < found.unstable_share < 1.0


def test_a_map_over_two_parts_of_the_drive() -> None:
    path = "shafts[0].damping_Nms_per_rad", "shafts[0].stiffness_Nm_per_rad"
    found = stability(LOOSE, over={path[0]: [0.2, 6.0], path[1]: [900.0, 1000.0, 1100.0]})
    assert found.stable.shape == (2, 3)
    assert found.stable[1].all()
    assert found.stable[0].tolist() == [True, False, True] or not found.stable[0, 1]


@pytest.mark.parametrize(
    ("over", "field"),
    [
        ({"joints[3].joint_angle_deg": [1.0]}, "joints[3].joint_angle_deg"),
        ({"duty.speed_rpm": [0.0, 10.0]}, "duty.speed_rpm"),
        ({"duty.speed_rpm": []}, "duty.speed_rpm"),
        ({"duty.speed_rpm": np.arange(1.0, 4e4), "joints[0].joint_angle_deg": np.linspace(1, 2, 40000)}, "over"),
        ({"duty.speed_rpm": [1.0], "joints[0].joint_angle_deg": [1.0], "duty.torque_Nm": [1.0]}, "over"),
        ({"joints[0].joint_angle_deg": [100.0]}, "joints[0].joint_angle_deg"),
    ],
)
def test_what_makes_no_map_is_named(over: dict[str, list[float]], field: str) -> None:
    with pytest.raises(InputError) as caught:
        stability(LOOSE, over=over)
    assert field in [problem.field for problem in caught.value.problems]


def test_a_map_that_is_stopped_keeps_what_is_done(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(torsion_stability, "CHUNK", 16)
    found = stability(LOOSE, over={"duty.speed_rpm": np.linspace(300.0, 600.0, 40)}, progress=lambda _share: "stop")
    assert found.cancelled
    assert np.all(found.verdict[:16] != Verdict.UNKNOWN)
    assert np.all(found.verdict[16:] == Verdict.UNKNOWN)


@pytest.mark.slow
def test_a_peak_between_the_speeds_is_found():
    """The peak as seventeen speeds about it have it; at an end of the speeds nothing is added."""
    coarse = torsion_response(LINE, speed=np.linspace(20.0, 180.0, 9))
    found = peak_refined(LINE, coarse)
    most = np.max(np.nan_to_num(found.swing), axis=-1)
    k = int(np.argmax(most))
    assert 0 < k < len(most) - 1
    assert np.all(np.diff(found.speed) > 0.0)
    assert set(coarse.speed) < set(found.speed)
    assert most[k] > 1.02 * np.nanmax(coarse.swing)
    dense = torsion_response(LINE, speed=np.linspace(found.speed[k - 1], found.speed[k + 1], 17))
    assert most[k] == pytest.approx(np.nanmax(dense.swing), rel=2e-3)
    rising = torsion_response(LINE, speed=[20.0, 30.0])
    assert peak_refined(LINE, rising) is rising


def test_high_multiples_of_an_engine_s_own_order_count() -> None:
    """Orders 1.052 and 1.315 of an engine behind a gear are the 4th and 5th of one that is no order of the engine."""
    motor, mill, spring, damper, speed = 1.0, 0.4, 2000.0, 2.0, 73.0
    line = replace(
        Drive.from_angles([0.0]),
        shafts=(Shaft(number=1, stiffness=spring, damping=damper),),
        stations=(Station(shaft=1, end="start", inertia=motor), Station(shaft=2, inertia=mill)),
    )
    pushes = ((2.0, 30.0), (2.5, 20.0))
    engine = Engine(
        mean_torque=80.0,
        speed_ratio=0.526,
        harmonics=tuple(EngineHarmonic(order=order, torque=torque) for order, torque in pushes),
    )
    found = torsion_response(line, Duty(speed=speed, torque=80.0, engine=engine))
    assert [one.order for one in found.apart] == pytest.approx([1.052, 1.315])
    sizes = []
    for (order, torque), one in zip(pushes, found.apart, strict=True):
        omega, both = 0.526 * order * speed, 1.0 / motor + 1.0 / mill
        carried = spring + 1j * omega * damper
        sizes.append(abs(carried * torque / motor / (carried * both - omega**2)))
        assert abs(one.torque[0]) == pytest.approx(sizes[-1], rel=5e-4)  # the torque follows the swinging crank
        assert one.exact
    assert found.torque_highest[0] == pytest.approx(80.0 + sum(sizes), rel=0.02)  # together within ten turns
