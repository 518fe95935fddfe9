"""Design for calm running, against a search of every combination by the plain steady response."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from itertools import product

import numpy as np
import pytest

from cardan import Drive, InputError
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.drive.duty import Duty
from cardan.drive.fields.paths import with_values
from cardan.drive.shaft import Shaft, Spline
from cardan.drive.station import Station
from cardan.maths.curves.search import Evolution, evolve
from cardan.questions.torsion.optimise.answer import answer
from cardan.questions.torsion.optimise.designs import Free
from cardan.questions.torsion.optimise.optimise import Grid, OptimisedTorsion, optimise_torsion
from cardan.questions.torsion.steady.run_stability import Verdict, floquet
from cardan.questions.torsion.steady.steady import periodic_response
from cardan.questions.torsion.steady.torsion_response import loaded_model, torsion_response
from cardan.units import deg

DRIVE = replace(
    Drive.from_angles([14 * deg, 14 * deg], plane_twists=[25 * deg]),
    shafts=(Shaft(number=2, stiffness=5000.0, damping=2.0, inertia=0.02),),
    stations=(Station(shaft=3, name="pump", inertia=0.8),),
    duty=Duty(torque=60.0, speed_range=(30.0, 60.0)),
)
YOKE, SPRING = "shafts[1].yoke_angle_deg", "shafts[1].stiffness_Nm_per_rad"
FREE = {YOKE: (-90.0, 90.0), SPRING: (3000.0, 12000.0)}


def peak(drive: Drive, count: int = 61) -> float:
    """Return the largest swing over the band by the plain question, speed by speed."""
    speed = np.linspace(*drive.duty.speed_range, count)
    model = loaded_model(drive, drive.duty, speed)[1]
    return 0.5 * float(np.max(periodic_response(model, speed=speed).peak_to_peak))


@cache
def evolved() -> OptimisedTorsion:
    return optimise_torsion(DRIVE, free=FREE, method=Evolution(size=10, rounds=10, runs=1))


@pytest.mark.slow
def test_no_combination_of_a_table_is_calmer() -> None:
    found = evolved()
    table = {
        (yoke, spring): peak(with_values(DRIVE, {YOKE: yoke, SPRING: spring}), 31)
        for yoke, spring in product(np.linspace(-90.0, 90.0, 10), np.linspace(3000.0, 12000.0, 4))
    }
    best = min(table.values())
    assert found.peak_after.torque <= best
    assert best < 0.5 * found.peak_before.torque  # there is something to find
    again = peak(found.drive, 301)  # curves look close at peaks, evenly spread speeds miss their tops by little
    assert found.peak_after.torque == pytest.approx(again, rel=0.01)
    assert found.peak_after.torque >= again * (1.0 - 1e-6)
    assert found.peak_before.torque == pytest.approx(peak(DRIVE, 301), rel=0.02)
    assert found.values[YOKE] == pytest.approx(found.drive.shafts[1].yoke_angle / deg)
    assert not found.unstable_after.size
    assert found.rules_after[0].push < 0.1 * found.rules_before[0].push


@pytest.mark.slow
def test_a_table_and_a_search_find_the_same() -> None:
    """Every combination, refined, and evolution: two ways, one answer."""
    table = optimise_torsion(DRIVE, free=FREE, method=Grid(points=7))
    assert evolved().peak_after.torque == pytest.approx(table.peak_after.torque, rel=0.03)
    assert table.evaluations >= 49
    assert np.all(np.diff(table.history[0]) <= 0.0)
    assert np.isnan(table.agreement)


@pytest.mark.slow
def test_splines_allow_their_teeth_alone() -> None:
    splined = replace(DRIVE.shafts[1], yoke_angle=7 * deg, spline=Spline(teeth=16))
    drive = replace(DRIVE, shafts=(DRIVE.shafts[0], splined, DRIVE.shafts[2]))
    found = optimise_torsion(drive, method=Grid())
    (free,) = found.free
    assert (free.low, free.high, free.step, free.built) == (7.0 - 90.0, 7.0 + 90.0, 22.5, 7.0)
    every = {7.0 + 22.5 * k: peak(with_values(drive, {YOKE: 7.0 + 22.5 * k}), 61) for k in range(-4, 5)}
    assert found.values[YOKE] == pytest.approx(min(every, key=lambda one: every[one]))
    assert found.evaluations == 9
    with pytest.raises(InputError, match="no yoke of this drive may be turned"):
        optimise_torsion(replace(drive, shafts=(drive.shafts[0], replace(splined, yoke_fixed=True), drive.shafts[2])))


@pytest.mark.slow
def test_an_unstable_design_never_beats_a_stable_one() -> None:
    """Amid its principal zone a drive may swing little and yet not run there."""
    single = replace(
        Drive.from_angles([25 * deg]),
        shafts=(Shaft(number=1, stiffness=1000.0, damping=0.2),),
        stations=(Station(shaft=2, inertia=0.4),),
        duty=Duty(speed_range=(45.0, 55.0)),
    )
    path = "shafts[0].stiffness_Nm_per_rad"
    swing, stable = {}, {}
    for value in (800.0, 1000.0, 1200.0, 1400.0, 1600.0):
        drive = with_values(single, {path: value})
        speed = np.linspace(45.0, 55.0, 31)
        response = periodic_response(loaded_model(drive, drive.duty, speed)[1], speed=speed)
        swing[value] = float(np.max(response.peak_to_peak))
        stable[value] = not np.any(floquet(response).verdict == Verdict.UNSTABLE)
    assert [value for value in stable if stable[value]] == [1400.0, 1600.0]
    assert swing[800.0] < 0.5 * swing[1400.0]
    found = optimise_torsion(single, free={path: (800.0, 1600.0, 200.0)}, method=Grid())
    assert found.values[path] == 1400.0
    assert found.unstable_before.size
    assert not found.unstable_after.size


@pytest.mark.slow
def test_joints_and_inertias_may_move_and_what_makes_no_drive_is_left_out() -> None:
    line = Drive.from_points([(-0.3, 0, 0), (0, 0, 0), (1.0, 0, -0.2), (1.4, 0, -0.2)])
    tube = Shaft(number=2, outer=0.06, wall=0.002, loss_factor=0.03)
    line = replace(
        line,
        shafts=(line.shafts[0], tube, line.shafts[2]),
        stations=(Station(shaft=3, name="pump", inertia=0.8),),
        duty=Duty(torque=60.0, speed_range=(60.0, 140.0)),
    )
    free = {"joints[1].centre_mm[0]": (-200.0, 1300.0, 250.0), "stations[0].inertia_kg_m2": (0.4, 1.2, 0.4)}
    found = optimise_torsion(line, free=free, method=Grid())
    assert found.evaluations == 7 * 3
    assert 0 < found.infeasible < 21  # a joint behind the other one, or beyond the output point, is no drive
    assert found.peak_after.torque < found.peak_before.torque
    assert found.drive.joints[1].centre[0] * 1e3 == pytest.approx(found.values["joints[1].centre_mm[0]"])


@pytest.mark.slow
def test_a_drive_that_runs_calmest_as_it_is_stays() -> None:
    calmest = with_values(DRIVE, {YOKE: -25.0})
    kept = optimise_torsion(calmest, free={YOKE: (60.0, 90.0, 15.0)}, method=Grid())
    assert kept.values == {YOKE: -25.0}
    assert kept.drive == calmest
    assert kept.reduction == pytest.approx(1.0)


def test_all_that_is_wrong_is_told_at_once() -> None:
    wrong = {
        "shafts[1].colour": (0, 1),
        YOKE: (5, -5),
        SPRING: (1, 2, 3),
        "name": (0, 1),
        "joints[0].centre_mm": (0, 1),
    }
    with pytest.raises(InputError) as caught:
        optimise_torsion(DRIVE, free=wrong)
    assert [one.field for one in caught.value.problems] == list(wrong)
    with pytest.raises(InputError, match=r"duty\.speed_range: missing"):
        optimise_torsion(DRIVE, Duty(torque=1.0), free=FREE)
    with pytest.raises(InputError, match="empty; say what may change"):
        optimise_torsion(DRIVE, free={})
    with pytest.raises(InputError, match=r"251.001 designs; at most 200.000"):
        optimise_torsion(DRIVE, free=FREE, method=Grid(points=501))
    with pytest.raises(InputError, match="not all of these are there; the line has 1: shaft 2"):
        optimise_torsion(DRIVE, free=FREE, elements=[4])
    with pytest.raises(InputError, match="elements: empty"):
        optimise_torsion(DRIVE, free=FREE, elements=[])
    with pytest.raises(InputError) as caught:
        optimise_torsion(DRIVE, free=FREE | {"shafts[1].yoke_angle_rad": (0, 1), "duty.speed_range_rpm[1]": (300, 600)})
    assert [str(one).partition(";")[0] for one in caught.value.problems] == [
        f"shafts[1].yoke_angle_rad: is the same as {YOKE}",
        "duty.speed_range_rpm[1]: the speeds are given, and a design is sought for them",
    ]
    with pytest.raises(InputError, match=r"method\.runs"):
        optimise_torsion(DRIVE, free=FREE, method=Evolution(runs=0))


@pytest.mark.slow
def test_a_stop_keeps_the_best_so_far() -> None:
    told: list[float] = []

    def stop(share: float) -> str:
        told.append(share)
        return "stop" if len(told) > 3 else ""

    found = optimise_torsion(DRIVE, free=FREE, method=Evolution(size=8), progress=stop)
    assert found.cancelled
    assert not found.converged
    assert found.peak_after.torque <= found.peak_before.torque
    assert len(found.run_peaks) == 1
    assert all(0.0 <= share <= 1.0 for share in told)


@pytest.mark.slow
def test_independent_searches_agree_once_their_last_steps_are_done() -> None:
    """A search everywhere ends roughly; that its runs ended apart says nothing of where both lead."""
    found = optimise_torsion(DRIVE, free={YOKE: (-60.0, 20.0)}, method=Evolution(size=4, rounds=2, runs=2))
    rough = [one[-1] for one in found.history]
    assert abs(rough[0] - rough[1]) > 0.02 * min(rough)
    assert found.agreement < 0.005
    assert found.peak_after.torque == pytest.approx(np.min(found.run_peaks), rel=0.01)


def test_evolution_finds_what_it_is_to_find() -> None:
    """A valley that bends, with its end known; the same seed gives the same way."""

    def valley(x: np.ndarray, _beat: np.ndarray) -> np.ndarray:
        a, b = 4.0 * x[:, 0] - 2.0, 4.0 * x[:, 1] - 2.0
        return (1.0 - a) ** 2 + 100.0 * (b - a * a) ** 2

    how = Evolution(rounds=150, tolerance=1e-4)
    found = evolve(valley, 2, method=how)
    np.testing.assert_allclose(found.place, 0.75, atol=1e-3)
    assert found.cost == evolve(valley, 2, method=how).cost
    assert all(np.all(np.diff(one) <= 0.0) for one in found.history)


def test_steps_end_at_the_last_that_fits() -> None:
    free = Free(path="a", low=0.0, high=10.0, step=3.0, built=0.0)
    assert [free.value(x) for x in (0.0, 0.14, 0.16, 1.0)] == [0.0, 0.0, 3.0, 9.0]
    np.testing.assert_allclose(free.places(99), [0.0, 0.3, 0.6, 0.9])


def test_what_swings_in_no_way_has_no_calm_design() -> None:
    straight = replace(DRIVE, joints=tuple(replace(one, joint_angle=0.0) for one in DRIVE.joints))
    with pytest.raises(InputError, match="nothing oscillates in this band"):
        optimise_torsion(straight, free=FREE)


@pytest.mark.slow
def test_stations_that_meet_are_no_design() -> None:
    """Two discs on one shaft: where one reaches the other the line has a station less."""
    tube = replace(DRIVE.shafts[1], length=1.0)
    discs = (Station(shaft=2, position=0.3, inertia=0.1), Station(shaft=2, position=0.5, inertia=0.1))
    drive = replace(DRIVE, shafts=(DRIVE.shafts[0], tube, DRIVE.shafts[2]), stations=(*DRIVE.stations, *discs))
    found = optimise_torsion(drive, free={"stations[1].position_mm": (100.0, 900.0, 200.0)}, method=Grid())
    assert found.infeasible == 1
    assert found.peak_after.torque < found.peak_before.torque


# Tolerances: the worst within them counts, found apart by plain steady responses at very many places within.

DAMPER = "shafts[1].damping_Nms_per_rad"
OFF = {SPRING: "15%", DAMPER: "40%", YOKE: 4.0}
DAMPED = replace(DRIVE, shafts=(DRIVE.shafts[0], replace(DRIVE.shafts[1], damping=8.0), DRIVE.shafts[2]))
"""So much damping that nothing grows anywhere within the tolerances, and peaks are wide beside steps of the speed."""


def off_by(drive: Drive, sides: tuple[float, float, float]) -> Drive:
    """Return a drive off by parts of `OFF`, by hand."""
    spring, damper, yoke = sides
    shaft = drive.shafts[1]
    made = replace(
        shaft,
        stiffness=shaft.stiffness * (1.0 + 0.15 * spring),
        damping=shaft.damping * (1.0 + 0.4 * damper),
        yoke_angle=shaft.yoke_angle + 4.0 * deg * yoke,
    )
    return replace(drive, shafts=(drive.shafts[0], made, drive.shafts[2]))


def worst_by_hand(drive: Drive, count: int) -> float:
    """Return the largest swing at the corners of the tolerances and at places within them drawn by chance."""
    places = [*product((-1.0, 1.0), repeat=3), *np.random.default_rng(5).uniform(-1.0, 1.0, (count, 3))]
    return max(peak(off_by(drive, tuple(one)), 81) for one in places)


@pytest.mark.slow
def test_the_robust_design_is_calmest_at_its_worst() -> None:
    """Against every combination of a table by hand: none has a smaller worst within its tolerances."""
    free = {YOKE: (-60.0, 60.0), SPRING: (3000.0, 12000.0)}
    found = optimise_torsion(DAMPED, free=free, method=Grid(points=4), tolerances=OFF)
    assert found.worst_after is not None
    assert found.worst_before is not None
    # evenly spread speeds of the hand calculation miss the tops of resonances by little
    by_hand = worst_by_hand(found.drive, 40)
    assert found.worst_after.torque == pytest.approx(by_hand, rel=0.03)
    assert found.worst_after.torque >= by_hand * 0.98
    table = {
        (yoke, spring): max(
            peak(off_by(with_values(DAMPED, {YOKE: yoke, SPRING: spring}), one), 81)
            for one in product((-1.0, 1.0), repeat=3)
        )
        for yoke, spring in product(np.linspace(-60.0, 60.0, 4), np.linspace(3000.0, 12000.0, 4))
    }
    assert found.worst_after.torque <= min(table.values()) * 1.01
    plain = optimise_torsion(DAMPED, free=free, method=Grid(points=4))
    assert plain.peak_after.torque <= found.peak_after.torque * 1.001
    assert found.worst_after.torque <= worst_by_hand(plain.drive, 0) * 1.01
    assert found.worst_before.torque == pytest.approx(worst_by_hand(DAMPED, 0), rel=0.05)


@pytest.mark.slow
def test_a_resonance_within_the_tolerances_and_outside_of_their_corners_is_met() -> None:
    """A narrow band: both ends of the stiffness leave it calm, a value between brings order 2 into it."""
    single = replace(
        Drive.from_angles([12 * deg]),
        shafts=(Shaft(number=1, stiffness=1000.0, damping=0.4),),
        stations=(Station(shaft=2, inertia=0.4),),
        duty=Duty(torque=20.0, speed_range=(24.5, 25.5)),
    )
    path = "shafts[0].stiffness_Nm_per_rad"
    assert 0.5 * np.sqrt(1000.0 / 0.4) == pytest.approx(25.0)
    found = optimise_torsion(single, free={path: (980.0, 1020.0, 40.0)}, method=Grid(), tolerances={path: "20%"})
    assert found.worst_after is not None
    assert abs(found.worst_after.sides[0]) < 0.3
    assert found.worst_after.torque > 3.0 * peak(with_values(single, {path: 1.2 * 1020.0}), 31)


def test_tolerances_that_are_none_are_refused_with_their_keys() -> None:
    for path, size, said in (
        (SPRING, "0", "not a tolerance: 0"),
        (SPRING, "120%", "not a tolerance: 120%"),
        (SPRING, "much", "not a tolerance: much"),
        ("shafts[1].name", 1.0, "leads to no number"),
        ("shafts[7].stiffness_Nm_per_rad", 1.0, "shafts"),
    ):
        with pytest.raises(InputError, match=said):
            optimise_torsion(DRIVE, free=FREE, method=Grid(points=2), tolerances={path: size})
    many = (
        {f"stations[0].{name}": "5%" for name in ("inertia_kg_m2",)}
        | {f"shafts[1].{name}": "5%" for name in ("stiffness_Nm_per_rad", "damping_Nms_per_rad", "inertia_kg_m2")}
        | {f"joints[{k}].joint_angle_deg": 0.5 for k in (0, 1)}
        | {"duty.torque_Nm": "5%"}
    )
    with pytest.raises(InputError, match="7 tolerances; at most 6"):
        optimise_torsion(DRIVE, free=FREE, method=Grid(points=2), tolerances=many)


@pytest.mark.slow
def test_the_design_is_proved_to_be_stable_or_where_it_is_not() -> None:
    """A zone too narrow for an even look, found with its edges; Floquet judges on either side of them."""
    drive = replace(
        Drive.from_angles([0.12]),
        shafts=(Shaft(number=1, stiffness=1000.0, damping=0.004),),
        stations=(Station(shaft=2, inertia=0.4),),
        duty=Duty(torque=20.0, speed_range=(42.0, 63.0)),
    )
    found = optimise_torsion(drive, free={"stations[0].inertia_kg_m2": (0.39, 0.41, 0.01)}, method=Grid(points=3))
    assert found.proof is not None
    assert found.proof.proved
    (low,), (high,) = found.proof.lowest.tolist(), found.proof.highest.tolist()
    assert high - low < 0.02 * low
    at = np.asarray([low * 0.9995, low * 1.0005, high * 0.9995, high * 1.0005])
    judged = torsion_response(found.drive, speed=at).floquet
    assert judged.stable.tolist() == [True, False, False, True]
    said = answer(drive, found)
    assert said.tone == "warning"
    assert any("not stable everywhere" in told(one.text, USUAL) for one in said.remarks)
    calm = optimise_torsion(
        replace(drive, shafts=(replace(drive.shafts[0], damping=2.0),)),
        free={"stations[0].inertia_kg_m2": (0.39, 0.41, 0.01)},
        method=Grid(points=3),
    )
    assert calm.proof is not None
    assert calm.proof.stable
    assert any("throughout the band: proved" in told(one.text, USUAL) for one in answer(drive, calm).remarks)
