"""Maps by the kernel against array expressions, and what it leaves to them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan.errors import InputError
from cardan.maths.compiled.method import Compiled, Plain
from cardan.maths.periodic.harmonics import Status
from cardan.questions.torsion.model.inputs import Constant
from cardan.questions.torsion.model.torsional_model import Torque, torsional_line
from cardan.questions.torsion.stability.floquet_map import floquet_map
from cardan.questions.torsion.steady import steady
from cardan.questions.torsion.steady.run_stability import Verdict, floquet
from cardan.questions.torsion.steady.steady import periodic_response
from tests.builders.torsion_in_time import drive

SPEEDS = np.linspace(30.0, 110.0, 7)
JOINT_ANGLES = np.linspace(0.0, 0.45, 5)


def over(model):
    """Return the model with its joint angles over the first axis of a map."""
    return replace(
        model,
        joint_angle=JOINT_ANGLES[:, None, None] * np.asarray([1.0, 0.8]),
        input_speed=None if model.free else SPEEDS,
    )


@pytest.mark.parametrize(
    "how",
    [{}, {"order": 1.0}, {"free": True}, {"free": True, "motor": True, "order": 2.0}],
    ids=["forced", "engine order", "free", "motor"],
)
def test_the_kernel_finds_what_array_expressions_find(how: dict) -> None:
    model = over(drive(damping=0.3, **how))
    fast = floquet_map(model, speed=SPEEDS, method=Compiled())
    slow = floquet_map(model, speed=SPEEDS, method=Plain())
    assert fast.floquet.verdict.shape == (5, 7)
    # Motions are cut at harmonics of 1e-4 of theirs; that moves what dies out fast by more than what decides.
    np.testing.assert_allclose(fast.floquet.spectral_radius, slow.floquet.spectral_radius, rtol=1e-6)
    np.testing.assert_allclose(fast.floquet.modulus, slow.floquet.modulus, atol=1e-5, rtol=1e-6)
    assert np.array_equal(fast.floquet.verdict, slow.floquet.verdict)
    np.testing.assert_allclose(fast.orbit.force, slow.orbit.force, rtol=1e-5, atol=1e-9)
    kept = min(fast.orbit.coefficient.shape[-1], slow.orbit.coefficient.shape[-1])
    np.testing.assert_allclose(fast.orbit.coefficient[..., :kept], slow.orbit.coefficient[..., :kept], atol=1e-5)


@pytest.mark.slow
@pytest.mark.parametrize("how", [{"order": 1.0}, {"free": True, "motor": True, "order": 2.0}], ids=["forced", "motor"])
def test_the_kernel_knows_what_turns_backwards(how: dict) -> None:
    """Mirrored inside; array expressions follow the drive as it turns."""
    model = replace(over(drive(damping=0.3, **how)), input_speed=None if how.get("free") else -SPEEDS)
    fast = floquet_map(model, speed=-SPEEDS, method=Compiled())
    slow = floquet_map(model, speed=-SPEEDS, method=Plain())
    ahead = floquet_map(over(drive(damping=0.3, **how)), speed=SPEEDS, method=Plain())
    np.testing.assert_allclose(fast.floquet.modulus, slow.floquet.modulus, atol=1e-5, rtol=1e-6)
    np.testing.assert_allclose(fast.orbit.force, slow.orbit.force, rtol=1e-5, atol=1e-9)
    kept = min(fast.orbit.coefficient.shape[-1], slow.orbit.coefficient.shape[-1])
    np.testing.assert_allclose(fast.orbit.coefficient[..., :kept], slow.orbit.coefficient[..., :kept], atol=1e-5)
    assert not np.allclose(fast.orbit.coefficient[..., :kept], ahead.orbit.coefficient[..., :kept], atol=1e-4)


def test_the_map_equals_its_points() -> None:
    model = over(drive(damping=0.3))
    found = floquet_map(model, method=Compiled()).floquet
    for i, k in ((0, 0), (2, 3), (4, 6)):
        one = floquet(periodic_response(drive(SPEEDS[k], damping=0.3, joint_angle=JOINT_ANGLES[i])))
        assert found.modulus[i, k] == pytest.approx(one.modulus, abs=2e-6)
        assert found.zone.name((i, k)) == one.zone.name()


def test_one_thread_computes_the_same_bits() -> None:
    model = over(drive(damping=0.3))
    one, all_of_them = (floquet_map(model, method=Compiled(threads=threads)).floquet for threads in (1, None))
    assert np.array_equal(one.multipliers, all_of_them.multipliers)


def test_any_two_quantities_make_a_map() -> None:
    model = drive(60.0)
    loads = np.asarray([0.0, 50.0, 200.0])
    dampers = np.asarray([0.1, 1.0])[:, None, None] * np.ones(4)
    torques = (Torque(station=6, law=Constant(value=-loads)), *model.torques[1:])
    found = floquet_map(replace(model, damping=dampers, torques=torques), method=Compiled()).floquet
    assert found.growth_rate.shape == (2, 3)
    one = floquet(periodic_response(drive(60.0, load=200.0, damping=0.1)))
    assert found.growth_rate[0, 2] == pytest.approx(float(one.growth_rate), rel=1e-5)


def test_open_play_goes_the_plain_way_and_closed_play_the_fast_one() -> None:
    model, speeds = drive(backlash=0.004, load=40.0), np.asarray([36.0, 42.0, 90.0])
    found = floquet_map(model, speed=speeds, method=Compiled())
    one = floquet(periodic_response(model, speed=speeds))
    np.testing.assert_allclose(found.floquet.modulus, one.modulus, rtol=2e-6)
    opened = (periodic_response(model, speed=speeds).torque_lowest[:, 0] <= 0.0).tolist()
    assert opened == [False, False, True]
    # what the kernel finds has the multipliers of array expressions to rounding of its sums alone
    exact = np.all(np.abs(found.floquet.modulus / one.modulus - 1.0) < 1e-11, axis=-1)
    assert exact.tolist() == opened


def test_the_kernel_takes_coordinates_without_inertia() -> None:
    """With a damper to hold them back and without; what has neither cannot be disturbed by itself."""
    for damping in ([[0.4], [0.2], [0.3]], [[0.4], [0.0], [0.0]]):
        model = torsional_line(
            [[1.0, 0.0], [0.0, 0.0], [0.0, 0.5]], stiffness=[[3000.0], [5000.0], [4000.0]], damping=damping,
            joint_angle=[0.3, 0.25], phase=[0.0, 1.2], torques=[Torque(station=5, law=Constant(value=-40.0))],
            input_speed=1.0,
        )  # fmt: skip
        fast, slow = (floquet_map(model, speed=SPEEDS, method=how) for how in (Compiled(), Plain()))
        np.testing.assert_allclose(fast.floquet.modulus, slow.floquet.modulus, rtol=1e-6, atol=1e-6)
        assert np.array_equal(fast.floquet.verdict, slow.floquet.verdict)
        assert np.array_equal(np.isnan(fast.floquet.multipliers), np.isnan(slow.floquet.multipliers))


@pytest.mark.slow
def test_a_chunk_without_any_motion_keeps_what_others_found(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(steady, "pieces_of", lambda *_all, **_named: None)  # a search of minutes
    loads = np.concatenate([np.full(64, -1e9), np.linspace(0.0, 100.0, 70), np.full(64, -1e9)])
    model = replace(drive(60.0), torques=(Torque(station=6, law=Constant(value=loads)),))
    found = floquet_map(model, method=Plain()).floquet
    assert np.all(found.verdict[:64] == Verdict.UNKNOWN)
    assert np.all(found.verdict[64:134] == Verdict.STABLE)
    assert np.all(found.verdict[134:] == Verdict.UNKNOWN)
    assert found.multipliers.shape == (198, 8)


def test_what_was_stopped_is_unknown_and_the_rest_is_kept() -> None:
    told: list[float] = []

    def stop(share: float) -> str:
        told.append(share)
        return "stop"

    found = floquet_map(drive(), speed=np.linspace(40.0, 90.0, 130), method=Plain(), progress=stop)
    assert found.cancelled
    assert told == [pytest.approx(64 / 130)]
    assert np.all(found.floquet.verdict[:64] != Verdict.UNKNOWN)
    assert np.all(found.floquet.verdict[64:] == Verdict.UNKNOWN)
    assert np.all(found.status[64:] == Status.CANCELLED)
    assert 0.0 <= found.unstable_share <= 1.0


def test_a_map_with_open_play_stops_between_its_points() -> None:
    found = floquet_map(drive(backlash=0.004, load=20.0), speed=[85.0, 90.0, 95.0], progress=lambda _share: "stop")
    assert found.cancelled
    assert found.floquet.verdict.tolist() == [Verdict.STABLE, Verdict.UNKNOWN, Verdict.UNKNOWN]
    assert found.status.tolist() == [Status.CONVERGED, Status.CANCELLED, Status.CANCELLED]


def test_a_map_of_a_thousand_million_points_is_refused_with_an_estimate() -> None:
    model = replace(drive(), joint_angle=np.zeros((31_623, 1, 2)))
    with pytest.raises(InputError, match=r"1,000,\d{3},\d{3} points would take about .* h"):
        floquet_map(model, speed=np.broadcast_to(50.0, 31_623))
