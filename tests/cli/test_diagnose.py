"""cardan diagnose: the ranking of the library in words, and every broken recording told as what it is."""

import csv
import io
import wave

import numpy as np
import pytest

from cardan import load
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.questions.diagnosis.findings import BY_SIGNS
from cardan.recordings import diagnose, load_recording
from tests.cli.conftest import EXAMPLES
from tests.cli.test_forces import widest

DRIVE = EXAMPLES / "truck-supports.toml"
RUN = EXAMPLES / "recordings" / "truck-worn-spline.csv"


@pytest.fixture(scope="module")
def table():
    """Return the titles and the numbers of a recording."""
    lines = [one for one in RUN.read_text().splitlines() if not one.startswith("#")]
    return lines[0].split(","), np.loadtxt(lines[1:], delimiter=",")


@pytest.fixture
def spoilt(tmp_path, table):
    """Write a recording with something wrong with it."""

    def write(change=None, *, without=(), name="run.csv"):
        titles, rows = table[0], table[1].copy()
        if change is not None:
            change(titles, rows)
        kept = [k for k, title in enumerate(titles) if not any(word in title for word in without)]
        path = tmp_path / name
        head = ",".join(titles[k] for k in kept)
        np.savetxt(path, rows[:, kept], delimiter=",", header=head, comments="", fmt="%.6g")
        return path

    return write


def of(title, titles):
    return next(k for k, one in enumerate(titles) if title in one)


@pytest.mark.slow
def test_the_answer_is_that_of_the_library(cardan):
    done = cardan("diagnose", RUN, DRIVE, "--json")
    found = diagnose(load_recording(RUN), load(DRIVE))
    said = done.content
    assert done.code == said["exit_code"] == 1
    assert [one["cause"] for one in said["causes"]] == [one.cause for one in found]
    assert [one["probability_percent"] for one in said["causes"]] == pytest.approx([100.0 * one.score for one in found])
    assert said["causes"][0]["evidence"] == [told(one, USUAL) for one in found[0].evidence]
    assert said["answer"].startswith("Likely: spline worn (9")
    assert said["rotation"]["source"] == "pulses"
    assert [one["name"] for one in said["channels"] if one["tacho"]] == ["tacho"]
    peaks = next(one for one in said["orders"] if one["channel"] == "centre radial")["peaks"]
    assert peaks[0]["order"] == pytest.approx(2.0, abs=0.01)


def test_it_says_what_to_check_and_to_do_within_80_columns(cardan):
    done = cardan("diagnose", RUN, DRIVE)
    assert (done.code, done.err) == (1, "")
    lines = [one for one in done.out.splitlines() if not one.startswith("    cardan")]
    assert widest("\n".join(lines)) <= 80
    for words in (
        "truck-worn-spline.csv: Likely",
        "speaks for and against: spline worn",
        "Check: turn shaft and slip yoke",
        "Repair, once that is proved: replace both",
        "Confidence in the",
    ):
        assert words in done.out


def test_a_drive_in_order_is_no_failure(cardan):
    done = cardan("diagnose", EXAMPLES / "recordings" / "truck-healthy.csv", DRIVE)
    assert done.code == 0
    assert "No fault shows" in done.out


def test_csv_lists_every_cause(cardan):
    done = cardan("diagnose", RUN, DRIVE, "--csv")
    rows = list(csv.DictReader(io.StringIO(done.out)))
    assert [one["cause"] for one in rows][:1] == ["F21"]
    assert sum(float(one["probability_percent"]) for one in rows) == pytest.approx(100.0)


@pytest.mark.slow
@pytest.mark.parametrize("suffix", [".html", ".pdf", ".xlsx"])
def test_report_and_figure_are_written(cardan, tmp_path, suffix):
    done = cardan("diagnose", RUN, DRIVE, "--report", f"d{suffix}", "--plot", "d.svg", "--json")
    assert done.content["report"] == f"d{suffix}"
    assert (tmp_path / f"d{suffix}").stat().st_size > 10_000
    assert (tmp_path / "d.svg").read_text().startswith("<?xml")


def test_orders_and_symptoms_alone_rank_with_little_confidence(cardan):
    said = cardan("diagnose", "--orders", "2", "--with-torque", "--json").content
    assert said["causes"][0]["cause"] == "F10"
    assert said["confidence"] == BY_SIGNS
    assert said["causes"][0]["probability_percent"] < 20.0
    small = cardan("diagnose", "--orders", "1=0.01,2=5", "--with-torque", "--json").content
    assert small["orders"] == [2.0]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((), "missing: the recording"),
        ((RUN,), "DRIVE: missing"),
        ((DRIVE, RUN), "the recording stands first"),
        (("--orders", "1,two", "--symptom", "klunk"), "not an order: 'two'"),
        (("--orders", "1=nan,2=3"), "not an order: '1=nan'"),
        (("--orders", "1=-3"), "not an order: '1=-3'"),
        ((RUN, DRIVE, "--orders", "2"), "neither a recording nor a drive file"),
        ((RUN, DRIVE, "--place", "front=supports[9]:up"), "there is no channel 'front'"),
        ((RUN, DRIVE, "--tacho", "tachi"), "did you mean tacho"),
        ((RUN, DRIVE, "--channel", "centre"), "there is no channel 'centre'"),
        ((RUN, DRIVE, "--title", "left"), "is not NAME="),
        ((RUN, DRIVE, "--report", "d.odt"), "should end in one of .html"),
        ((RUN, DRIVE, "--speeds", "100"), "write LOW:HIGH"),
        ((RUN, DRIVE, "--pulses-per-turn", "0"), "--pulses-per-turn: 0 given"),
        (("none.csv", "none.toml"), "none.toml: cannot be read"),
    ],
)
def test_what_is_wrong_is_said_at_once(cardan, arguments, words):
    done = cardan("diagnose", *arguments)
    assert (done.code, done.out) == (2, "")
    assert words in " ".join(done.err.split())


def test_all_that_is_wrong_with_places_is_said_together(cardan):
    told = cardan("diagnose", RUN, DRIVE, "--place", "front=supports[9]:up", "--json").complaint["problems"]
    assert [one["code"] for one in told] == ["unknown_key", "out_of_range", "out_of_range"]


def test_a_place_of_the_command_line_counts(cardan, spoilt):
    path = spoilt(without=("axial",))
    path.write_text(path.read_text().replace("supports[2]_", "", 1))
    lost = cardan("diagnose", path, DRIVE, "--json").content
    assert any("counts as sitting at the output" in one for one in lost["cautions"])
    kept = cardan("diagnose", path, DRIVE, "--place", "centre radial=supports[2]", "--json").content
    assert not any("counts as sitting" in one for one in kept["cautions"])
    assert kept["confidence"] > lost["confidence"]


def first(cardan, *arguments):
    """Return exit code, content, and score of the first cause."""
    done = cardan("diagnose", *arguments, "--json")
    assert done.code in (0, 1), done.err
    return done.content, done.content["causes"][0]["probability_percent"] / 100.0


def test_without_a_tacho_the_answer_is_less_sure_and_says_so(cardan, spoilt):
    path = spoilt(without=("tacho", "speed"))
    said, score = first(cardan, path, DRIVE)
    assert said["rotation"]["source"] == "ridge"
    assert said["confidence"] < 0.7
    assert score < 0.75
    assert any("no tacho" in one for one in said["cautions"])
    narrowed, _score = first(cardan, path, DRIVE, "--speeds", "500:1850")
    assert narrowed["rotation"]["source"] == "ridge"


def test_clipped_channels_are_told_and_distrusted(cardan, spoilt):
    def clip(titles, rows):
        k = of("centre", titles)
        np.clip(rows[:, k], -0.3, 0.3, out=rows[:, k])

    said, score = first(cardan, spoilt(clip), DRIVE)
    assert any("clipped" in one for one in said["cautions"])
    assert said["confidence"] < 0.5
    assert score < 0.6


def test_holes_are_bridged_and_told(cardan, spoilt):
    def hole(titles, rows):
        rows[1000:2500, of("output radial", titles)] = np.nan

    said, _score = first(cardan, spoilt(hole), DRIVE)
    assert any("missing or no numbers" in one for one in said["cautions"])
    assert said["confidence"] < 0.9


def test_an_empty_channel_is_left_out_and_told(cardan, spoilt):
    def empty(titles, rows):
        rows[:, of("output axial", titles)] = np.nan

    said, _score = first(cardan, spoilt(empty), DRIVE)
    assert any("output axial: holds no more than 0 numbers" in one for one in said["cautions"])
    assert "output axial" not in [one["name"] for one in said["channels"]]


@pytest.mark.parametrize("factor", [0.5, 2.0])
def test_a_wrong_sampling_rate_shows_in_the_speeds(cardan, spoilt, factor):
    """Times that are off by a factor: the speed of the output was measured, and does not fit."""

    def stretched(titles, rows):
        rows[:, 0] /= factor

    said, score = first(cardan, spoilt(stretched), DRIVE)
    assert any("the sampling rate" in one for one in said["cautions"])
    assert said["confidence"] < 0.4
    assert score < 0.5


def test_the_wrong_drive_is_doubted(cardan):
    said, score = first(cardan, RUN, EXAMPLES / "mill-spindle.toml")
    assert said["confidence"] < 0.5
    assert score < 0.5
    assert any("the drive file" in one or "It is not known where" in one for one in said["cautions"])


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("text.csv", b"Dear colleague,\nthe machine shakes.\n", ""),
        ("empty.csv", b"", ""),
        ("binary.csv", bytes(range(256)) * 20, ""),
        ("torn.wav", b"RIFF\x00\x00", ""),
        ("none.tdms", b"TDSm" + bytes(40), ""),
        ("few.csv", b"time_s,tacho,a_g\n0,1,2\n0.1,0,3\n", ""),
        ("run.xls", b"x", "is not a format of recordings"),
    ],
)
def test_files_that_are_no_recording_are_refused_by_name(cardan, tmp_path, name, content, words):
    path = tmp_path / name
    path.write_bytes(content)
    done = cardan("diagnose", path, DRIVE)
    assert (done.code, done.out) == (2, "")
    assert name in done.err
    assert words in done.err


def test_a_shaft_that_stands_is_no_recording(cardan, spoilt):
    def stand(titles, rows):
        rows[:, 1:] = 0.0

    done = cardan("diagnose", spoilt(stand), DRIVE)
    assert done.code == 2


def test_a_wav_without_rate_or_titles_is_read_with_them(cardan, tmp_path, table):
    titles, rows = table
    path = tmp_path / "run.wav"
    kept = [of("tacho", titles), of("centre", titles), of("output radial", titles)]
    scale = [float(np.max(np.abs(rows[:, k]))) for k in kept]
    whole = np.round(32767 * rows[:, kept] / scale).astype("<i2")
    with wave.open(str(path), "wb") as file:
        file.setnchannels(3)
        file.setsampwidth(2)
        file.setframerate(500)
        file.writeframes(whole.tobytes())
    named = ["tacho", "acceleration_centre_supports[2]_radial_m_s2", "acceleration_output_supports[3]_radial_m_s2"]
    options = [part for k, one in enumerate(named) for part in ("--title", f"channel {k + 1}={one}")]
    options += [part for one in scale for part in ("--full-scale", f"{one:.6g}")]
    said, _score = first(cardan, path, DRIVE, *options)
    order_2 = next(one for one in said["orders"] if one["channel"] == "centre")["peaks"][0]
    whole_csv, _score = first(cardan, RUN, DRIVE)
    same = next(one for one in whole_csv["orders"] if one["channel"] == "centre radial")["peaks"][0]
    assert order_2["amplitude_m_s2"] == pytest.approx(same["amplitude_m_s2"], rel=1e-3)  # 16 bits
    assert "channel 1=tacho" in cardan("diagnose", path, DRIVE, *options).out


def test_a_tooth_wheel_is_said_by_its_pulses(cardan, spoilt):
    """Four pulses a turn taken for one make a shaft four times too fast."""
    wrong, _score = first(cardan, RUN, DRIVE, "--pulses-per-turn", "0.25")
    assert wrong["rotation"]["speeds_rpm"][1] > 4000.0
    assert wrong["confidence"] < 0.2
    assert any("pulses per turn" in one for one in wrong["cautions"])
