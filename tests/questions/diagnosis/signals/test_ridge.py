import numpy as np
import pytest
from scipy.signal import bilinear, lfilter

from cardan import InputError
from cardan.questions.diagnosis.signals.ridge import ridge
from cardan.questions.diagnosis.signals.signal import Channel, Signal
from cardan.questions.diagnosis.signals.turning import estimate_rotation
from tests.builders.recordings import recorded

INSIDE = np.linspace(1.0, 5.0, 41)
TRUE = 2 * np.pi * (15.0 + 2.0 * INSIDE)


def found(orders, *, noise=0.5, seed=0, **given):
    signal = recorded(orders, first=15.0, gain=2.0, rate=2000.0, noise=noise, seed=seed, tacho=False)
    return estimate_rotation(signal, **given)


@pytest.mark.parametrize("orders", [{1: (1.0, 0.3), 2: (0.4, 0.0)}, {2: (1.0, 0.3), 1: (0.4, 0.0)}])
def test_the_speed_is_found_without_a_tacho(orders):
    one = found(orders, speed_range=(80.0, 180.0))
    # A line of the spectrogram is 0.5 Hz wide and read to a tenth.
    assert one.speed_at(INSIDE) == pytest.approx(TRUE, rel=0.01)
    assert one.confidence > 0.6
    assert not one.phased
    assert "no tacho" in one.cautions[0]


def test_a_lone_line_may_be_another_order_and_the_answer_says_so():
    alone = found({2: (1.0, 0.0)})
    assert alone.confidence < 0.7
    factors = dict(alone.alternatives)
    assert 0.5 in factors
    assert sum(factors.values()) == pytest.approx(1 - factors_of(alone), abs=1e-9)
    assert "may be another order" in alone.cautions[1]
    told = found({2: (1.0, 0.0)}, order=2.0)
    assert told.speed_at(INSIDE) == pytest.approx(TRUE, rel=0.01)
    assert told.alternatives == ()


def factors_of(one):
    """Return the probability of the answer itself."""
    return 1.0 - sum(share for _factor, share in one.alternatives)


def test_halves_of_the_line_tell_that_it_is_the_second_order():
    assert found({2: (1.0, 0.3), 1: (0.4, 0.0), 3: (0.3, 0.0)}, noise=0.2).order == 2.0


@pytest.mark.parametrize("seed", range(3))
def test_noise_is_not_believed(seed):
    assert found({}, noise=1.0, seed=seed).confidence < 0.15


@pytest.mark.parametrize("damping", [0.005, 0.01, 0.02, 0.05])
def test_a_resonance_that_noise_excites_is_not_taken_for_a_shaft(damping):
    square = (2 * np.pi * 40.0) ** 2
    upper, lower = bilinear([1, 0, 0], [1, 2 * damping * np.sqrt(square), square], 2000.0)
    values = lfilter(upper, lower, np.random.default_rng(1).normal(size=20000))
    one = ridge([Channel(name="a", values=values, rate=2000.0)], speed_range=(150.0, 350.0))
    assert one.confidence < 0.3
    assert any("wavers" in text for text in one.cautions)


def test_a_shaft_that_passes_a_resonance_is_believed():
    time = np.arange(20000) / 2000
    angle = 2 * np.pi * (10 * time + time**2)
    ratio = 2 * (10 + 2 * time) / 50
    values = np.real(ratio**2 / (1 - ratio**2 + 0.06j * ratio) * np.exp(2j * angle))
    values += np.random.default_rng(2).normal(size=time.size)
    one = ridge([Channel(name="a", values=values, rate=2000.0)], speed_range=(60.0, 200.0))
    assert one.speed_at(INSIDE) == pytest.approx(2 * np.pi * (10 + 2 * INSIDE), rel=0.02)
    assert one.confidence > 0.5


def test_several_channels_help():
    rng = np.random.default_rng(3)
    time = np.arange(12000) / 2000
    angle = 2 * np.pi * (15 * time + time**2)
    rows = [0.3 * np.cos(angle + k) + rng.normal(size=time.size) for k in range(4)]
    channels = [Channel(name=f"{k}", values=row, rate=2000.0) for k, row in enumerate(rows)]
    one, four = (ridge(some, speed_range=(80.0, 180.0)) for some in (channels[:1], channels))
    assert four.confidence > one.confidence
    assert four.speed_at(INSIDE) == pytest.approx(TRUE, rel=0.02)


def test_nothing_to_look_at_is_refused():
    with pytest.raises(InputError, match="neither a tacho nor a channel"):
        estimate_rotation(Signal(channels=(Channel(name="dead", values=np.zeros(100), rate=100.0),)))
    with pytest.raises(InputError, match="too little to find a speed"):
        estimate_rotation(Signal(channels=(Channel(name="short", values=np.arange(10.0), rate=100.0),)))


def test_a_search_that_is_stopped_has_tried_one_length_of_the_window():
    shares = []
    whole = found({1: (1.0, 0.3), 2: (0.4, 0.0)}, speed_range=(80.0, 180.0), progress=shares.append)
    first = found({1: (1.0, 0.3), 2: (0.4, 0.0)}, speed_range=(80.0, 180.0), progress=lambda share: "stop")
    assert shares == sorted(shares)
    assert shares[-1] == 1.0
    assert first.speed_at(INSIDE) == pytest.approx(TRUE, rel=0.02)
    assert whole.confidence >= first.confidence - 0.2


def test_channels_that_end_a_little_apart_are_sought_in_together():
    time = np.arange(8000) / 2000
    row = np.cos(2 * np.pi * (20 * time + time**2))
    channels = [Channel(name="a", rate=2000.0, values=row[:-90]), Channel(name="b", rate=2000.0, values=row)]
    channels.append(Channel(name="short", rate=2000.0, values=row[:400]))
    for some in (channels, channels[::-1]):
        found = estimate_rotation(Signal(channels=tuple(some)), order=1.0)
        assert found.speed_at(2.0) == pytest.approx(2 * np.pi * 24, rel=0.01)
