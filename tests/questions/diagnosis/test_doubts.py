"""What does not fit between a recording and its drive lowers the confidence, and says why."""

from dataclasses import replace

import pytest

from cardan.io import example
from cardan.questions.diagnosis.drive_model import plant
from cardan.questions.diagnosis.features import FAR, MISFIT, PLACELESS, SIZELESS, doubts
from cardan.questions.diagnosis.signals.signal import Signal
from cardan.questions.diagnosis.signals.turning import estimate_rotation
from cardan.questions.diagnosis.simulate import TestSchedule, simulate_fault

SHORT = TestSchedule(run_up=4.0, hold=1.0, rate=1024.0)


@pytest.fixture(scope="module")
def drive():
    return example("truck-supports")


@pytest.fixture(scope="module")
def base(drive):
    return plant(drive)


@pytest.fixture(scope="module")
def recording(drive):
    return simulate_fault(drive, runs=SHORT)


def told(signal, base):
    return list(doubts(signal, estimate_rotation(signal), base))


def at_rate(signal, share):
    """Return a recording that says it was sampled otherwise than it was."""
    channels = tuple(replace(one, rate=share * one.rate) for one in signal.channels)
    return replace(signal, channels=channels)


def test_a_sound_recording_raises_none(recording, base):
    assert told(recording, base) == []


def test_a_rate_too_high_makes_a_shaft_too_fast_and_unlike_its_output(recording, base):
    texts, shares = zip(*told(at_rate(recording, 2.0), base), strict=True)
    assert shares == (MISFIT, MISFIT)
    assert "rpm; the drive runs up to 1800 rpm" in texts[0]
    assert texts[1].startswith("output speed turns at")


def test_a_rate_too_low_shows_where_another_speed_was_measured(recording, base):
    ((text, share),) = told(at_rate(recording, 0.5), base)
    assert (text[:12], share) == ("output speed", MISFIT)
    ((text, share), _other) = told(at_rate(recording, 0.1), base)
    assert ("only" in text, share) == (True, FAR)


def test_a_place_that_the_drive_lacks_is_named(recording, base):
    lost = tuple(
        replace(one, place="supports[9]") if one.name == "output radial" else one for one in recording.channels
    )
    ((text, share),) = told(Signal(channels=lost, tacho=0), base)
    assert "output radial (supports[9])" in text
    assert share == PLACELESS


def test_supports_shafts_and_joints_belong_to_housings(base):
    assert base.housing_at("supports[2]").kind == base.housing_at("shafts[1]").kind == "centre"
    assert base.housing_at("joints[0]").kind == "input"
    assert base.housing_at("") is None
    assert [base.housing_at(one.place).kind for one in base.housings] == [one.kind for one in base.housings]


def test_sizes_that_are_assumed_leave_doubt(recording, drive):
    bare = replace(drive, duty=replace(drive.duty, torque=None))
    (_text, share), *rest = told(recording, plant(bare))
    assert share == SIZELESS
    assert rest == []
