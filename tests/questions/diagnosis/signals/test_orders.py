import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.signal import chirp

from cardan import InputError
from cardan.questions.diagnosis.signals.orders import order_map, order_spectrum, tracked_orders, turned
from cardan.questions.diagnosis.signals.rotation import Rotation
from cardan.questions.diagnosis.signals.signal import Channel
from cardan.questions.diagnosis.signals.turning import estimate_rotation
from tests.builders.recordings import angle_of, recorded

ORDERS = {1: (1.0, 0.4), 2: (0.5, -1.0), 3: (0.1, 2.0)}


def exact(time, first, gain, step=50):
    """Return the rotation as it is, without a tacho to find it from."""
    return Rotation(time=time[::step], angle=angle_of(time, first, gain)[::step])


@settings(max_examples=20, deadline=None)
@given(
    st.floats(0.3, 10.0), st.floats(-3.0, 3.0), st.floats(5.0, 40.0), st.floats(0.0, 8.0), st.sampled_from([1e3, 4e3])
)
def test_a_pure_order_keeps_its_amplitude_at_even_angles(order, phase, first, gain, rate):
    time = np.arange(int(4 * rate)) / rate
    angle = angle_of(time, first, gain)
    if order * (first + 4 * gain) > 0.4 * rate:  # the channel itself must hold it
        order = 0.4 * rate / (first + 4 * gain)
    shaft = exact(time, first, gain, 10)
    read = turned(Channel(name="front", values=np.cos(order * angle + phase), rate=rate), shaft)
    count = read.values.size // 8
    inside = slice(count, -count)
    # 1e-4 is what read_slowly states; half as much again for the angle between knots of the rotation.
    assert np.allclose(read.values[inside], np.cos(order * read.angle + phase)[inside], rtol=0, atol=3e-4)


def test_amplitudes_and_phases_of_a_run_up_are_those_put_in():
    signal = recorded(ORDERS)
    found = order_spectrum(signal.channel("front"), estimate_rotation(signal))
    for order, (amplitude, phase) in ORDERS.items():
        assert found.at(order) == pytest.approx(amplitude, rel=2e-3)
        line = found.coherent[found.order == order][0]
        assert np.abs(line) == pytest.approx(amplitude, rel=2e-3)
        assert np.angle(line) == pytest.approx(phase, abs=2e-3)
    assert [round(order, 2) for order, _size in found.peaks()] == [1.0, 2.0, 3.0]
    assert found.resolution == pytest.approx(1.5 / 16)


def test_in_noise_the_orders_still_stand_out():
    signal = recorded(ORDERS, noise=0.5)
    found = order_spectrum(signal.channel("front"), estimate_rotation(signal))
    assert found.at(2.0) == pytest.approx(0.5, abs=0.05)
    assert {round(order) for order, _size in found.peaks(count=2)} == {1, 2}
    assert np.median(found.amplitude / found.floor) == pytest.approx(1.0, abs=0.1)


def test_a_flat_top_reads_orders_between_the_lines():
    signal = recorded({1.53: (1.0, 0.0)})
    shaft = estimate_rotation(signal)
    flat = order_spectrum(signal.channel("front"), shaft, window="flattop").at(1.53)
    hann = order_spectrum(signal.channel("front"), shaft, window="hann").at(1.53)
    assert flat == pytest.approx(1.0, abs=3e-3)
    assert hann < 0.98


def test_what_does_not_follow_the_shaft_is_no_echo():
    """A tone at 0.45 of the rate lies at order 120 and above of the slow shaft: none of it may fold onto orders."""
    time = np.arange(24000) / 4000
    tone = Channel(name="front", values=np.cos(2 * np.pi * 1800.0 * time), rate=4000.0)
    found = order_spectrum(tone, exact(time, 5.0, 2.0))
    assert np.max(found.amplitude) < 2e-4


def test_it_agrees_with_the_chirp_of_scipy():
    time = np.arange(24000) / 4000
    values = chirp(time, f0=20.0, t1=6.0, f1=50.0, phi=-90)  # a sine, at twice the speed of the shaft
    found = order_spectrum(Channel(name="front", values=values, rate=4000.0), exact(time, 10.0, 2.5))
    line = found.coherent[found.order == 2.0][0]
    assert np.abs(line) == pytest.approx(1.0, abs=1e-3)
    assert np.angle(line) == pytest.approx(-np.pi / 2, abs=1e-3)


def test_a_map_shows_an_amplitude_that_grows_with_the_speed():
    time = np.arange(40000) / 4000
    angle = angle_of(time, 10.0, 4.0)
    speed = 10.0 + 4.0 * time
    front = Channel(
        name="front", values=(speed / 50) ** 2 * np.cos(2 * angle) + np.cos(2 * np.pi * 90 * time), rate=4e3
    )
    found = order_map(front, exact(time, 10.0, 4.0), turns=8)
    line = found.amplitude[:, found.order == 2.0][:, 0]
    at = found.speed / (2 * np.pi)
    away = np.abs(90.0 / at - 2.0) > 0.5  # where the steady tone does not cross the order
    assert line[away] == pytest.approx((at[away] / 50) ** 2, rel=0.05, abs=0.01)
    cross = found.amplitude[np.argmin(np.abs(at - 30.0))]
    assert found.order[np.argmax(cross * (found.order > 2.5))] == pytest.approx(3.0, abs=0.13)


def test_tracked_orders_follow_a_resonance():
    """Amplitude and phase of an order passing a resonance slowly are those of the steady response."""
    time = np.arange(80000) / 2000
    angle = angle_of(time, 10.0, 0.5)
    ratio = (10.0 + 0.5 * time) / 20.0
    steady = ratio**2 / (1 - ratio**2 + 2j * 0.05 * ratio)
    front = Channel(name="front", values=np.real(steady * np.exp(1j * angle)) + 0.3 * np.cos(2 * angle), rate=2000.0)
    found = tracked_orders(front, exact(time, 10.0, 0.5), [1.0, 2.0], turns=8)
    at = found.speed / (2 * np.pi * 20.0)
    want = at**2 / (1 - at**2 + 2j * 0.05 * at)
    # In 8 turns the speed rises by 1 to 2 % of that of the resonance, whose width is 10 %.
    assert found.value[0] == pytest.approx(want, abs=0.05 * np.max(np.abs(want)))
    assert found.amplitude[1] == pytest.approx(0.3, abs=0.01)
    assert np.max(found.residual) < 0.05 * np.max(found.amplitude)


def test_orders_near_each_other_are_told_apart():
    signal = recorded({1: (1.0, 0.0), 1.2: (0.5, 1.0)})
    shaft = estimate_rotation(signal)
    found = tracked_orders(signal.channel("front"), shaft, [1.0, 1.2])
    assert np.median(found.amplitude, axis=1) == pytest.approx([1.0, 0.5], abs=5e-3)
    with pytest.raises(InputError, match="told apart in 16 turns"):
        tracked_orders(signal.channel("front"), shaft, [1.0, 1.05])


def test_all_bad_options_are_told():
    signal = recorded(ORDERS, seconds=2.0)
    with pytest.raises(InputError) as caught:
        order_spectrum(signal.channels[1], estimate_rotation(signal), highest=-1.0, turns=1, window="box")
    assert [one.field for one in caught.value.problems] == ["highest", "turns", "window"]


def test_a_channel_from_another_time_is_refused():
    signal = recorded(ORDERS, seconds=2.0)
    late = Channel(name="late", values=signal.channels[1].values, rate=4000.0, start=100.0)
    with pytest.raises(InputError, match="late: shares 0 turns"):
        order_spectrum(late, estimate_rotation(signal))


def test_a_map_that_is_stopped_ends_where_it_was_read_to_and_long_ones_are_read_in_blocks(monkeypatch):
    signal = recorded(ORDERS)
    shaft, front = estimate_rotation(signal), signal.channel("front")
    whole = order_map(front, shaft)
    tracked = tracked_orders(front, shaft)
    monkeypatch.setattr("cardan.questions.diagnosis.signals.orders.BLOCK", 3000)
    monkeypatch.setattr("cardan.maths.curves.resampling.BLOCK", 500)
    shares = []
    assert np.allclose(order_map(front, shaft, progress=shares.append).amplitude, whole.amplitude, rtol=0, atol=1e-12)
    assert np.allclose(tracked_orders(front, shaft).value, tracked.value, rtol=0, atol=1e-12)
    assert shares == sorted(shares)
    assert shares[-1] == 1.0
    part = order_map(front, shaft, progress=lambda share: "stop" if share > 0.5 else None)
    assert 0 < part.time.size < whole.time.size
    assert part.time[-1] < 0.7 * whole.time[-1]
    assert np.median(part.amplitude[:, part.order == 1.0]) == pytest.approx(1.0, rel=2e-3)
    with pytest.raises(InputError, match="was stopped after"):
        order_map(front, shaft, progress=lambda share: "stop", turns=4, highest=100.0)
