import numpy as np
import pytest

from cardan import InputError
from cardan.questions.diagnosis.signals.signal import Channel, Signal


def channel(name="a", **given):
    return Channel(**{"name": name, "values": np.arange(5.0), "rate": 100.0, **given})


@pytest.mark.parametrize("values", [["a", "b"], [1j, 2.0], [None, 1.0], [[1.0], [1.0, 2.0]]])
def test_what_are_no_real_numbers_is_refused(values):
    with pytest.raises(InputError, match="values: one row of real numbers"):
        channel(values=values)


def test_a_channel_knows_its_times():
    one = channel(start=2.0)
    assert one.time == pytest.approx([2.0, 2.01, 2.02, 2.03, 2.04])
    assert one.duration == pytest.approx(0.04)


def test_all_that_is_wrong_with_a_channel_is_told_at_once():
    with pytest.raises(InputError) as caught:
        channel(quantity="heat", direction="up", rate=0.0, start=np.inf, trust=2.0, values=[1.0, np.nan])
    assert [one.field for one in caught.value.problems] == ["quantity", "direction", "rate", "start", "trust", "values"]
    with pytest.raises(InputError, match="one row of numbers"):
        channel(values=np.zeros((2, 3)))


def test_a_recording_tells_the_tacho_from_what_shakes():
    pulses, other = channel("tacho", quantity="pulses"), channel("second", quantity="pulses")
    found = Signal(channels=(pulses, channel("front", trust=0.5), other), tacho=0)
    assert [one.name for one in found.measured] == ["front"]
    assert found.trust == 0.5
    assert found.channel("front") is found.channels[1]
    with pytest.raises(InputError, match="did you mean front"):
        found.channel("frnt")


@pytest.mark.parametrize(
    ("given", "fields"),
    [
        ({"tacho": 1}, ["tacho"]),
        ({"tacho": 0}, ["tacho"]),
        ({"channels": (), "pulses_per_turn": 0.0}, ["channels", "pulses_per_turn"]),
    ],
)
def test_a_recording_that_cannot_be_is_refused(given, fields):
    with pytest.raises(InputError) as caught:
        Signal(**{"channels": (channel(),), **given})
    assert [one.field for one in caught.value.problems] == fields
