"""cardan simulate-fault: what a fault should show, and a recording of it that the diagnosis reads."""

import csv
import io

import pytest

from cardan import load
from cardan.questions.diagnosis.expected import FAULTS
from cardan.questions.diagnosis.simulate import TestSchedule
from cardan.recordings import expected_orders, load_recording, simulate_fault
from tests.cli.conftest import EXAMPLES
from tests.cli.test_forces import widest

DRIVE = EXAMPLES / "truck-supports.toml"
SHORT = ("--run-up-s", 3, "--hold-s", 1, "--rate-hz", 1000)


def test_all_faults_are_listed(cardan):
    said = cardan("simulate-fault", DRIVE, "--list", "--json").content
    assert {one["fault"]: one["cause"] for one in said["faults"]} == FAULTS
    assert all(one["words"] for one in said["faults"])


def test_what_should_show_is_that_of_the_library(cardan):
    said = cardan("simulate-fault", DRIVE, "joint_angles", "--severity", 1.5, "--json").content
    found = expected_orders(load(DRIVE), "joint_angles", severity=1.5)
    assert [one["order"] for one in said["orders"]] == [one.order for one in found.orders]
    sizes = [abs(complex(found.value(one, found.speed[1], found.reference))) for one in found.orders]
    keys = ["amplitude_rad_s" if one.direction == "torsion" else "amplitude_m_s2" for one in found.orders]
    assert [one[key] for one, key in zip(said["orders"], keys, strict=True)] == pytest.approx(sizes)
    rows = list(
        csv.DictReader(io.StringIO(cardan("simulate-fault", DRIVE, "joint_angles", "--severity", 1.5, "--csv").out))
    )
    assert len(rows) == len(found.orders)
    parts = [float(one["amplitude_m_s2"] or one["speed_amplitude_rad_s"]) for one in rows]
    assert parts == pytest.approx(sizes)


def test_it_stands_within_80_columns(cardan):
    for arguments in (("--list",), ("worn_spline",)):
        done = cardan("simulate-fault", DRIVE, *arguments)
        lines = [one for one in done.out.splitlines() if not one.startswith("    cardan")]
        assert (done.code, done.err) == (0, "")
        assert widest("\n".join(lines)) <= 80


@pytest.mark.slow
@pytest.mark.parametrize("suffix", [".csv", ".wav", ".uff", ".tdms"])
def test_the_recording_is_that_of_the_library(cardan, tmp_path, suffix):
    said = cardan("simulate-fault", DRIVE, "crack", "-o", f"run{suffix}", "--seed", 3, *SHORT, "--json").content
    made = simulate_fault(load(DRIVE), "crack", seed=3, runs=TestSchedule(run_up=3.0, hold=1.0, rate=1000.0))
    assert said["recording"]["channels"] == [one.name for one in made.channels]
    kept = load_recording(tmp_path / f"run{suffix}")
    for one, other in zip(kept.channels, made.channels, strict=True):
        assert one.values == pytest.approx(other.values, rel=1e-6, abs=1e-6)  # single precision in a WAV


def test_it_is_diagnosed_by_the_command_it_names(cardan):
    done = cardan("simulate-fault", DRIVE, "centre_bearing", "-o", "run.csv", *SHORT)
    assert done.out.splitlines()[-1].split()[:3] == ["cardan", "diagnose", "run.csv"]
    assert cardan("diagnose", "run.csv", DRIVE, "--json").content["causes"][0]["cause"] == "F23"


def test_one_speed_is_kept(cardan):
    cardan("simulate-fault", DRIVE, "healthy", "-o", "run.csv", "--steady-rpm", 1200, "--hold-s", 2, "--rate-hz", 1000)
    said = cardan("diagnose", "run.csv", DRIVE, "--json").content
    assert said["rotation"]["speeds_rpm"] == pytest.approx([1200.0, 1200.0], rel=2e-3)  # pulses to a part of a sample


def test_nothing_is_overwritten(cardan):
    assert cardan("simulate-fault", DRIVE, "bent", "-o", "run.csv", *SHORT).code == 0
    done = cardan("simulate-fault", DRIVE, "bent", "-o", "run.csv", *SHORT)
    assert (done.code, "--force overwrites it" in done.err) == (2, True)
    assert cardan("simulate-fault", DRIVE, "bent", "-o", "run.csv", "--force", *SHORT).code == 0


def test_the_figure_shows_every_order(cardan, tmp_path):
    cardan("simulate-fault", DRIVE, "centre_bearing", "--plot", "orders.svg")
    drawn = (tmp_path / "orders.svg").read_text()
    assert drawn.count("order 0.5") == 1


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((), "FAULT: missing: one of healthy"),
        (("klunk",), "'klunk' is none of"),
        (("worn_splin",), "the nearest is worn_spline"),
        (("bent", "-o", "run.mp3"), "should end in one of .csv, .wav, .uff"),
        (("bent", "--seed", -1), "-1 is negative"),
        (("bent", "--severity", 0), "--severity: 0 given"),
        (("bent", "--shaft", 9), "--shaft: shaft 9 lies not between two joints"),
        (("bent", "-o", "r.csv", "--snr-db", "nan"), "--snr-db: is not finite"),
        (("bent", "-o", "r.csv", "--hold-s", 0, "--rate-hz", -1), "--rate-hz: -1 given"),
        (("bent", "-o", "r.csv", "--run-up-s", 0), "--steady-rpm keeps one speed"),
        (("bent", "-o", "r.csv", "--steady-rpm", -5), "--steady-rpm"),
    ],
)
def test_what_is_wrong_is_said(cardan, arguments, words):
    done = cardan("simulate-fault", DRIVE, *arguments)
    assert (done.code, done.out) == (2, "")
    assert words in " ".join(done.err.split())


def test_a_fault_that_the_drive_cannot_have_is_refused(cardan):
    done = cardan("simulate-fault", EXAMPLES / "car-propshaft.toml", "centre_bearing")
    assert (done.code, "no centre bearing" in done.err) == (2, True)
