import numpy as np
import pytest

from cardan import InputError
from cardan.io import example
from cardan.questions.diagnosis.expected import expected_orders
from cardan.questions.diagnosis.signals.orders import tracked_orders
from cardan.questions.diagnosis.signals.turning import estimate_rotation
from cardan.questions.diagnosis.simulate import TestSchedule, simulate_fault

SHORT = TestSchedule(run_up=4.0, hold=2.0)


def test_a_seed_says_everything():
    drive = example("car-propshaft")
    first, same, other = (simulate_fault(drive, "bent", seed=k, runs=SHORT) for k in (1, 1, 2))
    for one, two, three in zip(first.channels, same.channels, other.channels, strict=True):
        assert np.array_equal(one.values, two.values)
        assert one.name in ("tacho", "torque") or not np.array_equal(one.values, three.values)


def test_a_clean_recording_holds_the_orders_expected():
    drive = example("truck-supports")
    signal = simulate_fault(drive, "unbalance", seed=3, snr=80.0, runs=SHORT)
    shaft = estimate_rotation(signal)
    found = tracked_orders(signal.channel("centre radial"), shaft, (1.0, 2.0, 4.0))
    lines = expected_orders(drive, "unbalance")
    top = lines.speed[1]
    one = [line for line in lines.orders if (line.order, line.kind, line.direction) == (1.0, "centre", "radial")]
    most = sum(abs(complex(lines.value(line, 0.8 * top, 0.0))) for line in one)
    held = np.abs(found.speed / (0.8 * top) - 1.0) < 0.01
    # Each line has a factor of its own by chance, exp(±3 · 0.25) at most, and the lines may partly cancel.
    assert 0.2 * most < np.median(found.amplitude[0, held]) < 2.2 * most
    assert estimate_rotation(signal).speeds[1] == pytest.approx(top, rel=0.02)


@pytest.mark.parametrize("snr", [0.0, 10.0])
def test_noise_is_as_strong_as_asked(snr):
    drive = example("car-propshaft")
    clean, noisy = (simulate_fault(drive, "unbalance", seed=3, snr=one, runs=SHORT) for one in (200.0, snr))
    for name in ("input radial", "output radial"):
        # The random numbers of both are the same, so that the difference is noise and what is not of the drive:
        # 1 + 0.4²/2 + 0.2²/2 of the power of the noise.
        pure, more = clean.channel(name).values, noisy.channel(name).values
        power = np.mean((more - pure) ** 2) / 1.1
        assert 10.0 * np.log10(np.mean(pure**2) / power) == pytest.approx(snr, abs=0.5)


def test_bad_options_come_all_at_once():
    with pytest.raises(InputError) as told:
        simulate_fault(example("car-propshaft"), snr=float("nan"), runs=TestSchedule(hold=0.0, rate=-1.0))
    assert [one.field for one in told.value.problems] == ["snr", "runs.hold", "runs.rate"]


def test_a_recording_that_is_stopped_lacks_sensors_and_one_beyond_the_memory_is_refused():
    shares = []

    def stopping(share):
        shares.append(share)
        return "stop" if share > 0.3 else None

    drive = example("car-propshaft")
    part = simulate_fault(drive, "bent", seed=1, runs=SHORT, progress=stopping)
    assert [one.name for one in part.channels] == ["tacho", "input radial", "output radial", "torque"]
    assert "lacks sensors" in part.cautions[0]
    assert shares == [0.2, 0.4]
    whole = simulate_fault(drive, "bent", seed=1, runs=SHORT)
    assert np.array_equal(part.channel("output radial").values, whole.channel("output radial").values)
    with pytest.raises(InputError, match=r"runs\.rate"):
        simulate_fault(drive, runs=TestSchedule(run_up=1e7))


def test_without_a_run_up_it_keeps_one_speed():
    drive = example("truck-supports")
    found = estimate_rotation(simulate_fault(drive, runs=TestSchedule(run_up=0.0, hold=2.0, held=0.5, rate=1024.0)))
    low, high = found.speeds
    # Pulses are timed to a part of a sample: 15 turns a second, 1024 values.
    assert (low, high) == pytest.approx((0.5 * 1800 * np.pi / 30,) * 2, rel=2e-3)
