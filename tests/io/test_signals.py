import contextlib
import struct
import wave

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import cardan
from cardan import InputError
from cardan.io.signals import SIGNAL_FORMATS
from cardan.recordings import Channel, Signal, load_recording
from tests.builders.recordings import recorded

TIME = np.arange(400) / 1000
WAVE = np.sin(2 * np.pi * 23.7 * TIME)
TACHO = (TIME * 20 % 1 < 0.3).astype(float)


def table(path, titles="time_s,tacho,acceleration_front_z_m_s2", rows=None, mark=","):
    rows = zip(TIME, TACHO, WAVE, strict=True) if rows is None else rows
    path.write_text("\n".join([titles, *(mark.join(map(str, row)) for row in rows)]))
    return path


def test_a_table_is_read_in_si(tmp_path):
    found = load_recording(table(tmp_path / "run.csv", "time_ms,speed_rpm,acceleration_supports[1]_z_g"))
    assert found.tacho == 0
    assert found.channels[0].values[1] == pytest.approx(TACHO[1] * np.pi / 30)
    front = found.channels[1]
    assert (front.quantity, front.place, front.direction, front.unit) == ("acceleration", "supports[1]", "z", "g")
    assert front.values == pytest.approx(WAVE * 9.80665)
    assert front.rate == pytest.approx(1e6)  # milliseconds were written as seconds
    assert found.channels[0].trust == 1.0


@pytest.mark.parametrize("mark", [";", "\t"])
def test_other_marks_and_decimal_commas_are_read(tmp_path, mark):
    path = table(tmp_path / "run.csv", mark.join(["time_s", "tacho_V", "front_m_s2"]), mark=mark)
    path.write_text("# made by a data logger\n" + path.read_text().replace(".", ","))
    found = load_recording(path)
    assert found.channel("front").values == pytest.approx(WAVE)
    assert found.channels[found.tacho].name == "tacho"


@settings(max_examples=15, deadline=None)
@given(st.sampled_from([".csv", ".wav", ".uff", ".tdms"]), st.integers(200, 50000), st.integers(0, 10**6))
def test_what_is_written_is_read_again(tmp_path_factory, suffix, rate, seed):
    rng = np.random.default_rng(seed)
    rows = rng.normal(size=(3, 64))
    channels = (
        Channel(name="tacho", quantity="pulses", values=rows[0], rate=float(rate)),
        Channel(name="front", values=rows[1], rate=float(rate), place="supports[0]", direction="y"),
        Channel(name="gap", quantity="displacement", values=1e-5 * rows[2], rate=float(rate)),
    )
    path = tmp_path_factory.mktemp("kept") / f"run{suffix}"
    cardan.save(Signal(channels=channels, tacho=0), path)
    titles = () if suffix != ".wav" else ("tacho", "acceleration_front_supports[0]_y_m_s2", "displacement_gap_m")
    found = load_recording(path, titles=titles)
    assert found.tacho == 0
    for one, two in zip(channels, found.channels, strict=True):
        assert (one.name, one.quantity, one.place, one.direction) == (two.name, two.quantity, two.place, two.direction)
        assert two.rate == pytest.approx(one.rate, rel=1e-5 if suffix == ".uff" else 1e-9)
        assert np.allclose(two.values, one.values, rtol=1e-7 if suffix == ".wav" else 1e-9, atol=0)


@pytest.mark.parametrize(("width", "top"), [(1, 2**7), (2, 2**15), (3, 2**23), (4, 2**31)])
def test_whole_numbers_of_a_wav_are_scaled(tmp_path, width, top):
    numbers = np.round(0.9 * WAVE * (top - 1)).astype(int)
    with wave.open(str(tmp_path / "run.wav"), "wb") as file:
        file.setnchannels(2)
        file.setsampwidth(width)
        file.setframerate(1000)
        both = np.stack([numbers, numbers // 2], axis=1).ravel()
        raw = both + 128 if width == 1 else both
        file.writeframes(b"".join(int(v).to_bytes(width, "little", signed=width > 1) for v in raw))
    found = load_recording(tmp_path / "run.wav", titles=("front_m_s2", "rear_g"), full_scale=(50.0, 10.0))
    assert np.allclose(found.channel("front").values, 45.0 * WAVE, atol=100.0 / top)
    assert np.allclose(found.channel("rear").values, 4.5 * 9.80665 * WAVE, atol=2 * 98.0 / top)
    bare = load_recording(tmp_path / "run.wav")
    assert [one.name for one in bare.channels] == ["left", "right"]
    assert bare.tacho is None
    assert any("does not say what its channels measure" in one for one in bare.cautions)
    assert load_recording(tmp_path / "run.wav", tacho="right").tacho == 1


def universal(path, **given):
    """Write a universal file of one function by hand, as the format says."""
    fields = {"kind": 1, "way": 3, "ordinate": 12, "unit": "m/s^2", "count": WAVE.size, **given}
    lines = [f"{-1:6d}", f"{58:6d}", "front", "", "", "", ""]
    lines.append(
        f"{fields['kind']:5d}{0:10d}{0:5d}{0:10d} {'NONE':>10}{3:10d}{fields['way']:4d} {'NONE':>10}{0:10d}{0:4d}"
    )
    lines.append(f"{4:10d}{fields['count']:10d}{1:10d}{0.5:13.5e}{1e-3:13.5e}{0:13.5e}")
    for kind, label, unit in ((17, "time", "s"), (fields["ordinate"], "acc", fields["unit"]), (0, "NONE", "NONE")):
        lines.append(f"{kind:10d}{0:5d}{0:5d}{0:5d} {label:<20} {unit:<20}")
    lines.append(f"{0:10d}{0:5d}{0:5d}{0:5d} {'NONE':<20} {'NONE':<20}")
    lines += ["".join(f"{v:20.11e}" for v in WAVE[k : k + 4]) for k in range(0, WAVE.size, 4)]
    path.write_text("\n".join([*lines, f"{-1:6d}", ""]))
    return path


def test_a_universal_file_is_read(tmp_path):
    front = load_recording(universal(tmp_path / "run.uff")).channels[0]
    assert (front.name, front.quantity, front.direction, front.start) == ("front", "acceleration", "z", 0.5)
    assert front.rate == pytest.approx(1000)
    assert front.values == pytest.approx(WAVE, abs=1e-10)
    turned = load_recording(universal(tmp_path / "run.unv", way=-1, unit="g")).channels[0]
    assert turned.direction == "x"
    assert turned.values == pytest.approx(-9.80665 * WAVE, abs=1e-9)


def test_universal_files_without_a_recording_are_refused(tmp_path):
    with pytest.raises(InputError, match="no function over time"):
        load_recording(universal(tmp_path / "frf.uff", kind=4))
    with pytest.raises(InputError, match="'mm' is not a unit of acceleration"):
        load_recording(universal(tmp_path / "unit.uff", unit="mm"))
    whole = universal(tmp_path / "cut.uff").read_text()
    (tmp_path / "cut.uff").write_text(whole[:2000])
    with pytest.raises(InputError, match=r"cut off|can be read"):
        load_recording(tmp_path / "cut.uff")


def tdms(path, *, remarks=(["windy"],), **properties):
    from nptdms import ChannelObject, TdmsWriter

    step = {"wf_increment": 0.001, "unit_string": "m/s^2", **properties}
    step = {key: value for key, value in step.items() if value is not None}
    with TdmsWriter(str(path)) as writer:
        tacho = {**step, "unit_string": "V"}
        writer.write_segment(
            [
                ChannelObject("g", "front z", WAVE, properties=step),
                ChannelObject("g", "tacho", TACHO, properties=tacho),
                *(ChannelObject("g", "remark", one) for one in remarks),
            ]
        )
    return path


def test_a_tdms_file_is_read(tmp_path):
    found = load_recording(tdms(tmp_path / "run.tdms"))
    front = found.channels[0]
    assert (front.name, front.quantity, front.direction) == ("front", "acceleration", "z")
    assert front.values == pytest.approx(WAVE)
    assert found.channels[found.tacho].name == "tacho"
    assert any("remark of run.tdms holds no numbers" in one for one in found.cautions)
    with pytest.raises(InputError, match="does not say its rate"):
        load_recording(tdms(tmp_path / "bare.tdms", wf_increment=None))
    assert load_recording(tmp_path / "bare.tdms", rate=500.0).channels[0].rate == 500.0


def test_a_tdms_file_cut_off_is_read_as_far_as_it_goes(tmp_path):
    whole = tdms(tmp_path / "run.tdms", remarks=()).read_bytes()
    (tmp_path / "cut.tdms").write_bytes(whole[:-4000])
    found = load_recording(tmp_path / "cut.tdms")
    assert any("cut off" in one for one in found.cautions)


BROKEN = {
    "empty.csv": (b"", "is empty"),
    "titles.csv": (b"time_s,tacho\n", "has 0 rows"),
    "numbers.csv": (b"0,1\n1,2\n", "begins with numbers"),
    "bytes.csv": (b"time_s,\xb0\x00C\n1,2\n", "is not UTF-8"),
    "back.csv": (b"time_s,front_g\n0,1\n2,1\n1,1\n", "do not rise in 1 places, first at row 3"),
    "untimed.csv": (b"front_g,rear_g\n0,1\n2,1\n", "no column of times"),
    "alone.csv": (b"time_s\n0\n1\n", "no channel beside the times"),
    "unit.csv": (
        b"time_s,acceleration\n0,1\n1,1\n",
        "needs a unit of acceleration at its end: write acceleration_m_s2",
    ),
    "wrong.csv": (b"time_s,acceleration_mm\n0,1\n1,1\n", "needs a unit of acceleration"),
    "ragged.csv": (b"time_s,front_g\n0,1\n1\n2,3\n3,4\n", "line 3 has not 2 cells"),
    "wave.csv": (b"RIFF....WAVE", "is a .wav file by its content"),
    "text.wav": (b"hello", "not a WAV file that can be read"),
    "short.wav": (b"RIFF\x24\0\0\0WAVEfmt ", "not a WAV file that can be read"),
    "text.tdms": (b"hello world" * 9, "not a TDMS file that can be read"),
    "text.uff": (b"hello world", "cut off|can be read"),
    "run.mp3": (b"", "not a format of recordings; known are .csv"),
    "run": (b"", "not a format of recordings"),
}


@pytest.mark.parametrize("name", BROKEN)
def test_broken_files_are_refused_by_name(tmp_path, name):
    content, why = BROKEN[name]
    (tmp_path / name).write_bytes(content)
    with pytest.raises(InputError, match=why) as caught:
        load_recording(tmp_path / name)
    assert caught.value.field


@pytest.mark.parametrize("suffix", SIGNAL_FORMATS)
def test_any_file_cut_anywhere_or_spoilt_is_no_traceback(tmp_path, suffix):
    made = recorded({1: (1.0, 0.0)}, seconds=0.1, rate=1000.0)
    path = tmp_path / f"run{suffix}"
    if suffix in (".csv", ".wav"):
        cardan.save(made, path)
    elif suffix == ".txt":
        table(path)
    else:
        tdms(path) if suffix == ".tdms" else universal(path)
    whole = path.read_bytes()
    rng = np.random.default_rng(4)
    for _ in range(12):
        spoilt = bytearray(whole[: rng.integers(1, len(whole))] if rng.random() < 0.5 else whole)
        for place in rng.integers(0, len(spoilt), size=rng.integers(0, 9)):
            spoilt[place] = rng.integers(0, 256)
        path.write_bytes(bytes(spoilt))
        with contextlib.suppress(InputError):
            found = load_recording(path)
            assert all(np.all(np.isfinite(one.values)) for one in found.channels)


def test_what_is_missing_or_unknown_is_told(tmp_path):
    with pytest.raises(InputError, match="No such file"):
        load_recording(tmp_path / "none.csv")
    path = table(tmp_path / "run.csv")
    with pytest.raises(InputError, match="did you mean front"):
        load_recording(path, tacho="frint")
    with pytest.raises(InputError, match="channel front measures acceleration"):
        load_recording(path, tacho="front")
    with pytest.raises(InputError) as caught:
        load_recording(path, pulses_per_turn=0.0, rate=-1.0, full_scale=float("nan"))
    assert [one.field for one in caught.value.problems] == ["pulses_per_turn", "rate", "full_scale"]
    with pytest.raises(InputError, match="1 titles given"):
        load_recording(path, titles=["tacho"])
    with pytest.raises(InputError, match="there is no channel 'x'"):
        load_recording(path, titles={"x": "tacho"})
    assert load_recording(path, titles={"tacho": "angle_deg"}).channels[0].quantity == "angle"


def test_a_file_too_large_is_not_read(tmp_path):
    path = tmp_path / "large.csv"
    with path.open("wb") as stream:
        stream.truncate(10**9)  # sparse: takes no room
    with pytest.raises(InputError, match="larger than 200 MB"):
        load_recording(path)


def test_what_is_doubtful_is_a_caution(tmp_path):
    rows = [[t, p, w, "", 0.0] for t, p, w in zip(TIME, TACHO, np.clip(WAVE, -0.8, 0.8), strict=True)]
    rows[50][2] = "#N/A"
    found = load_recording(table(tmp_path / "run.csv", "time_s,tacho,clipped_g,gone_g,dead_g", rows))
    told = "\n".join(found.cautions)
    assert "clipped: 1 of its values" in told
    assert "clipped: clipped at its limits" in told
    assert "gone: holds no more than 0 numbers" in told
    assert "dead: constant" in told
    assert [one.name for one in found.channels] == ["tacho", "clipped", "dead"]
    assert found.channel("clipped").trust < 0.5
    assert found.channel("dead").trust == 0.0


def test_a_dead_or_missing_tacho_is_told(tmp_path):
    rows = [[t, 0.0, w] for t, w in zip(TIME, WAVE, strict=True)]
    dead = load_recording(table(tmp_path / "dead.csv", rows=rows))
    assert dead.tacho is None
    assert any("the tacho is dead" in one for one in dead.cautions)
    gone = load_recording(
        table(tmp_path / "gone.csv", "time_s,front_g", [[t, w] for t, w in zip(TIME, WAVE, strict=True)])
    )
    assert any("There is no tacho" in one for one in gone.cautions)
    two = load_recording(table(tmp_path / "two.csv", "time_s,tacho_a,tacho_b"))
    assert (two.tacho, two.channels[0].name) == (0, "a")
    assert any("a was taken as the tacho; b could be" in one for one in two.cautions)


def test_times_and_rate_that_differ_are_told(tmp_path):
    found = load_recording(table(tmp_path / "run.csv"), rate=2000.0)
    assert any("1000 values a second, not 2000" in one for one in found.cautions)
    assert found.trust < 1.0
    assert load_recording(table(tmp_path / "bare.csv", "a_g,b_g,c_g"), rate=2000.0).channels[0].rate == 2000.0


def test_reading_can_be_stopped(tmp_path, monkeypatch):
    monkeypatch.setattr("cardan.io.signals.csv.CHUNK", 100)
    told = []
    found = load_recording(table(tmp_path / "run.csv"), progress=lambda share: told.append(share) or "stop")
    assert told == [0.25]
    assert found.channels[0].values.size == 100
    assert any("Reading was stopped" in one for one in found.cautions)


def test_what_cannot_be_written_is_refused(tmp_path):
    one = Channel(name="a", values=WAVE, rate=1000.0)
    other = Channel(name="b", values=WAVE, rate=512.3)
    with pytest.raises(InputError, match="b has not the times of a"):
        cardan.save(Signal(channels=(one, other)), tmp_path / "run.csv")
    with pytest.raises(InputError, match="whole numbers only"):
        cardan.save(Signal(channels=(other,)), tmp_path / "run.wav")
    with pytest.raises(InputError, match=r"saved as \.csv or \.wav"):
        cardan.save(Signal(channels=(one,)), tmp_path / "run.mp3")
    with pytest.raises(InputError, match="longer than the 80 letters"):
        cardan.save(Signal(channels=(Channel(name="long" * 20, values=WAVE, rate=1000.0),)), tmp_path / "run.uff")


def test_overflown_numbers_of_a_wav_are_told(tmp_path):
    counts = (np.round(WAVE * 40000).astype(int) + 32768) % 65536 - 32768
    with wave.open(str(tmp_path / "run.wav"), "wb") as file:
        file.setparams((1, 2, 1000, 0, "NONE", ""))
        file.writeframes(struct.pack(f"<{counts.size}h", *counts))
    found = load_recording(tmp_path / "run.wav", titles=["front_g"])
    assert any("overflown" in one for one in found.cautions)
    assert found.trust < 0.2


@pytest.mark.parametrize(
    "titles",
    [
        "Time [s],Tacho [V],Acceleration front z [g]",
        "Time (ms),Tacho (V),Accel front z (g)",
        "time,tacho,acc front z\ns,V,g",
        "Logger 7\nDate,2024-05-06\n\n# made by hand\nt [s],tacho,acceleration_front_z [g]",
        "Name,Bob\nRate,2048\nGain,1,2\n\nt [s],tacho,acceleration_front_z [g]",
    ],
)
def test_heads_as_loggers_write_them_are_read(tmp_path, titles):
    path = table(tmp_path / "run.csv", titles)
    found = load_recording(path)
    front = found.channels[1]
    assert (front.name, front.quantity, front.direction, front.unit) == ("front", "acceleration", "z", "g")
    assert front.values == pytest.approx(WAVE * 9.80665)
    assert front.rate == pytest.approx(1e6 if "ms" in titles else 1e3)
    assert found.tacho == 0
    assert any("titles were taken from line 5" in one for one in found.cautions) == ("\n\n" in titles)


@pytest.mark.parametrize("code", ["utf-16", "cp1252", "utf-8-sig"])
def test_text_of_other_programs_is_read(tmp_path, code):
    path = table(tmp_path / "run.csv", "time_s,speed [°/s],front [m/s²]")
    path.write_bytes(path.read_text(encoding="utf-8").encode(code))
    found = load_recording(path)
    assert [one.unit for one in found.channels] == ["deg_s", "m_s2"]


def test_a_bad_line_is_named_by_its_number_in_the_file(tmp_path):
    path = table(tmp_path / "run.csv")
    lines = path.read_text().splitlines()
    path.write_text("\n".join(["# note", "", *lines[:50], "1,2", *lines[50:]]))
    with pytest.raises(InputError, match="line 53 has not 3 cells"):
        load_recording(path)


def test_volts_of_nothing_named_are_no_tacho(tmp_path):
    found = load_recording(table(tmp_path / "run.csv", "time_s,ch1_V,ch2 [V]"))
    assert [one.quantity for one in found.channels] == ["other", "other"]
    assert found.tacho is None
    assert load_recording(tmp_path / "run.csv", tacho="ch1").tacho == 0


def test_whole_numbers_of_a_wav_without_a_scale_are_doubted(tmp_path):
    with wave.open(str(tmp_path / "run.wav"), "wb") as file:
        file.setparams((1, 2, 1000, 0, "NONE", ""))
        file.writeframes(struct.pack("<400h", *(np.round(WAVE * 20000).astype(int))))
    assert load_recording(tmp_path / "run.wav", titles=["front_g"]).trust < 0.5
    assert load_recording(tmp_path / "run.wav", titles=["front_g"], full_scale=50.0).trust == 1.0
    assert load_recording(tmp_path / "run.wav", titles=["tacho"]).trust == 1.0


def test_a_universal_file_that_is_cut_off_is_told(tmp_path):
    pytest.importorskip("pyuff")
    channels = tuple(Channel(name=name, values=WAVE, rate=1000.0) for name in ("a", "b", "c"))
    path = tmp_path / "run.uff"
    cardan.save(Signal(channels=channels), path)
    assert not any("cut off" in one for one in load_recording(path).cautions)
    path.write_bytes(path.read_bytes()[:-4000])
    found = load_recording(path)
    assert len(found.channels) == 2
    assert any("cut off" in one for one in found.cautions)
