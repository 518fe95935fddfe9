import numpy as np
import pytest

from cardan.questions.diagnosis.signals.quality import evened, sound

TIME = np.arange(8000) / 1000
RNG = np.random.default_rng(7)
WAVE = np.sin(2 * np.pi * 13.7 * TIME) + 0.4 * np.sin(2 * np.pi * 31.1 * TIME + 1)


@pytest.mark.parametrize(
    "values",
    [
        WAVE,
        np.sin(2 * np.pi * 13.7 * TIME),
        np.sin(2 * np.pi * 10 * TIME),  # meets its own peaks again and again
        RNG.normal(size=TIME.size),
        np.round(WAVE * 20),
        np.round(3 * np.sin(2 * np.pi * 13.7 * TIME)),
        np.round(WAVE * 3e4),
        WAVE * np.exp(-TIME),
    ],
    ids=["two tones", "a tone", "a tone in step", "noise", "coarse", "7 levels", "fine", "decay"],
)
def test_a_sound_channel_is_left_as_it_is(values):
    found = sound("front", values)
    assert found.cautions == ()
    assert found.trust == 1.0
    assert np.array_equal(found.values, values)


@pytest.mark.parametrize("steps", [None, 2000, 32767])
@pytest.mark.parametrize("limit", [0.5, 0.9, 0.98])
@pytest.mark.parametrize("noise", [0.0, 0.3])
def test_clipping_is_seen(limit, noise, steps):
    values = WAVE + noise * RNG.normal(size=TIME.size)
    top = limit * np.max(np.abs(values)) * (0.8 if noise else 1.0)  # noise has few values at its very top
    cut = np.clip(values, -top, top)
    if steps:
        cut = np.round(cut / top * steps)
    found = sound("front", cut)
    assert "clipped" in found.cautions[0]
    assert found.trust < 1.0
    assert sound("tacho", cut, swings=False).cautions == ()


def test_gaps_are_bridged_and_told():
    values = WAVE.copy()
    values[100:140] = np.nan
    values[3000] = np.inf
    found = sound("front", values)
    assert np.all(np.isfinite(found.values))
    assert "41 of its values" in found.cautions[0]
    assert 0.9 < found.trust < 1.0
    assert sound("front", np.where(TIME < 5, np.nan, WAVE)) is None


def test_a_dead_channel_is_told():
    found = sound("front", np.full(100, 3.3))
    assert found.trust == 0.0
    assert "constant" in found.cautions[0]


def test_overflow_is_told():
    counts = np.round(WAVE * 30000)
    wrapped = (counts + 32768) % 65536 - 32768
    found = sound("front", wrapped)
    assert "overflown" in found.cautions[0]
    assert found.trust < 0.2


def test_a_square_wave_has_not_overflown():
    assert "overflown" not in "".join(sound("front", np.sign(WAVE)).cautions)


def test_even_times_need_nothing():
    rate, start, rows, told, trust = evened(TIME + 3, WAVE[None])
    assert (rate, start) == pytest.approx((1000.0, 3.0), rel=1e-12)
    assert (told, trust) == ((), 1.0)
    assert rows[0] is not None


def test_times_written_with_few_digits_are_even():
    times = np.round(np.arange(3000) / 5120, 4)  # steps of 0.1 and 0.2 ms for 0.1953 ms
    rate, _start, rows, told, _trust = evened(times, WAVE[None, :3000])
    assert rate == pytest.approx(5120, rel=1e-4)
    assert told == ()
    assert rows.shape == (1, 3000)


def test_uneven_times_are_evened():
    times = np.sort(TIME + RNG.uniform(-2e-4, 2e-4, size=TIME.size))
    rate, start, rows, told, trust = evened(times, np.sin(10 * times)[None])
    assert rate == pytest.approx(1000, rel=1e-3)
    assert rows[0][50:-50] == pytest.approx(np.sin(10 * (start + np.arange(rows.shape[1]) / rate))[50:-50], abs=1e-3)
    assert "time steps differ" in told[0]
    assert trust < 0.8


def test_a_gap_in_time_is_a_gap_in_the_values():
    kept = (TIME < 2) | (TIME > 2.5)
    rate, _start, rows, told, trust = evened(TIME[kept], WAVE[None, kept])
    assert rate == pytest.approx(1000)
    assert rows.shape[1] == TIME.size
    assert np.sum(np.isnan(rows[0])) == pytest.approx(500, abs=2)
    assert "1 gap" in told[0]
    assert trust < 1.0


def test_a_channel_that_stays_at_one_value_is_told():
    loose = np.where(np.arange(WAVE.size) < 0.7 * WAVE.size, WAVE, 0.0)
    found = sound("front", loose)
    assert "stays at one value for 30 %" in found.cautions[0]
    assert found.trust == pytest.approx(0.4, abs=0.01)
    assert sound("tacho", loose, swings=False).trust == 1.0
