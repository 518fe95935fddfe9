import numpy as np
import pytest

from cardan import InputError
from cardan.questions.diagnosis.signals.signal import Channel, Signal
from cardan.questions.diagnosis.signals.turning import estimate_rotation
from tests.builders.recordings import angle_of, recorded

TIME = np.arange(12000) / 2000


def alone(quantity, values, *, per_turn=1.0, rate=2000.0, **given):
    channel = Channel(name="tacho", quantity=quantity, values=values, rate=rate)
    return estimate_rotation(Signal(channels=(channel,), tacho=0, pulses_per_turn=per_turn), **given)


@pytest.mark.parametrize("per_turn", [1, 2, 60])
def test_pulses_give_the_angle_of_a_run_up(per_turn):
    time = np.arange(60000) / 20000
    found = alone("pulses", np.sin(per_turn * angle_of(time, 8.0, 2.0)), per_turn=per_turn, rate=20000.0)
    inside = time[3000:-3000:100]
    off = found.angle_at(inside) - angle_of(inside, 8.0, 2.0)
    # From another first pulse on; between pulses a cubic spline follows an even run-up to 1e-4 rad.
    assert np.ptp(off) < 1e-4
    assert np.round(off[0] * per_turn / (2 * np.pi), 2) % 1 == 0.0
    assert found.speed_at(1.5) == pytest.approx(2 * np.pi * 11.0, rel=1e-3)
    assert found.time_at(found.angle_at(inside)) == pytest.approx(inside, abs=1e-5)


@pytest.mark.parametrize("sign", [1, -1])
def test_speed_and_angle_of_a_sensor_do_as_well(sign):
    angle = angle_of(TIME, 8.0, 2.0)
    speed = np.gradient(angle, TIME)
    for found in (alone("angular_speed", sign * speed), alone("angle", sign * (angle % (2 * np.pi)))):
        assert np.allclose(found.angle_at(TIME) - found.angle[0], angle, rtol=0, atol=1e-2)
        assert found.confidence == 1.0
    assert not alone("angular_speed", speed).phased
    assert alone("angular_speed", 3 * speed, per_turn=3).mean_speed == pytest.approx(2 * np.pi * 14, rel=1e-3)


def test_what_stands_is_left_out():
    speed = np.where(TIME < 2.0, 0.0, 50.0)
    found = alone("angular_speed", speed)
    assert found.time[0] == pytest.approx(2.0, abs=0.01)
    assert found.confidence < 1.0
    assert "stands or turns back for 33 %" in found.cautions[0]
    with pytest.raises(InputError, match="the shaft stands"):
        alone("angular_speed", np.zeros(100))


def test_too_few_turns_are_refused():
    with pytest.raises(InputError, match="turns of the shaft; at least 3 are needed"):
        alone("angular_speed", np.full(1000, 10.0))


def test_what_cannot_be_is_doubted():
    angle = angle_of(TIME, 8.0, 2.0)
    sound = alone("pulses", np.sin(angle))
    assert (sound.confidence, sound.cautions) == (1.0, ())
    assert sound.speeds == pytest.approx((2 * np.pi * 8.2, 2 * np.pi * 19.9), rel=0.05)
    fast = alone("pulses", np.sin(60 * angle), per_turn=60)
    assert any("sampled too slowly" in one for one in fast.cautions)
    assert fast.confidence < 0.5
    other = alone("pulses", np.sin(angle), speed_range=(400.0, 500.0))
    assert "outside of the speeds of the drive" in other.cautions[0]
    assert other.confidence < 0.5


def test_a_wrong_sampling_rate_shows_in_lengths_that_differ():
    found = recorded({1: (1.0, 0.0)})
    front = found.channels[1]
    wrong = Channel(name="front", values=front.values, rate=2 * front.rate)
    doubted = estimate_rotation(Signal(channels=(found.channels[0], wrong), tacho=0))
    assert "wrong sampling rate" in doubted.cautions[0]
    assert doubted.confidence < 0.5


def test_pulses_at_random_are_not_believed():
    values = np.random.default_rng(5).random(12000) > 0.99
    assert alone("pulses", values).confidence < 0.3


def test_a_speed_in_the_wrong_unit_is_refused():
    with pytest.raises(InputError, match="no shaft turns so fast"):
        alone("angular_speed", np.full(1000, 2e5))
    with pytest.raises(InputError, match="are not a recording"):
        alone("angular_speed", np.full(1000, 1e5), rate=1e-3)
