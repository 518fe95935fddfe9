"""Everything a recording tells at once: the causes of the diagnosis, the channel that shows most, two sensors."""

from dataclasses import replace

import numpy as np
import pytest

from cardan.errors import InputError
from cardan.io import example
from cardan.questions.diagnosis.examination import examine
from cardan.questions.diagnosis.findings import diagnose
from cardan.questions.diagnosis.signals.signal import Channel
from cardan.questions.diagnosis.signals.turning import estimate_rotation
from cardan.questions.diagnosis.simulate import TestSchedule, simulate_fault

SHORT = TestSchedule(run_up=5.0, hold=2.0, rate=1024.0)


@pytest.fixture(scope="module")
def drive():
    return example("truck-supports")


@pytest.fixture(scope="module")
def recording(drive):
    return simulate_fault(drive, "centre_bearing", seed=3, runs=SHORT)


@pytest.fixture(scope="module")
def found(recording, drive):
    return examine(recording, drive)


@pytest.mark.slow
def test_its_causes_are_those_of_the_diagnosis(found, recording, drive):
    assert found.findings == diagnose(recording, drive)
    assert found.findings[0].cause == "F23"
    assert found.expected.fault == "centre_bearing"
    assert found.confidence == found.findings[0].confidence


def test_the_channel_with_the_highest_line_is_shown(found):
    tops = {one.name: max(size for _order, size in one.peaks()) for one in found.spectra if one.peaks()}
    assert found.channel.name == max(tops, key=tops.get) == found.map.name == found.tracks.name == found.spectrum.name
    assert {one.quantity for one in found.spectra} == {"acceleration"}


@pytest.mark.slow
def test_another_channel_can_be_asked_for(recording, drive):
    assert examine(recording, drive, channel="output axial").map.name == "output axial"
    with pytest.raises(InputError, match="did you mean output axial"):
        examine(recording, drive, channel="output axiel")


@pytest.mark.slow
def test_two_sensors_across_the_shaft_make_an_orbit(recording, drive):
    """A circle run through against the shaft."""
    tacho = recording.channels[0]
    angle = angle_of(recording)
    rows = {"y": np.cos(angle), "z": -np.sin(angle)}
    probes = [
        Channel(name=f"probe {way}", quantity="displacement", values=1e-4 * row, rate=tacho.rate, direction=way)
        for way, row in rows.items()
    ]
    assert examine(recording, drive).orbit is None
    both = examine(replace(recording, channels=(*recording.channels, *probes)), drive).orbit
    assert both.names == ("probe y", "probe z")
    ellipse = both.ellipses[0]
    assert (ellipse.major, ellipse.minor) == pytest.approx((1e-4, -1e-4), rel=0.02)  # angles to a sample


def angle_of(recording):
    shaft = estimate_rotation(recording)
    return shaft.angle_at(recording.channels[0].time)


def test_a_tooth_wheel_tells_how_the_shaft_swings(recording, drive):
    """Eight teeth on the shaft of the tacho, which turns evenly: the twist is what sampling leaves."""
    tacho = recording.channels[0]
    angle = angle_of(recording)
    wheel = replace(tacho, name="wheel", values=np.sin(8.0 * angle))
    found = examine(replace(recording, channels=(wheel, *recording.channels[1:]), pulses_per_turn=8.0), drive)
    assert found.swing.teeth == 8
    assert np.max(found.swing.twist_amplitude) < 0.01


def test_a_recording_without_vibration_is_refused(recording, drive):
    only = replace(recording, channels=(recording.channels[0], recording.channels[-1]))
    with pytest.raises(InputError, match="no channel of vibration"):
        examine(only, drive)


def test_progress_rises_to_the_end(recording, drive):
    told = []
    examine(recording, drive, progress=told.append)
    assert told == sorted(told)
    assert told[-1] == 1.0


@pytest.mark.slow
def test_one_that_is_stopped_tells_what_it_knows_by_then(recording, drive):
    found = examine(recording, drive, progress=lambda share: "stop" if share > 0.1 else None)
    assert "stopped before" in found.cautions[-1]
    assert found.confidence < examine(recording, drive).confidence
