"""cardan accuracy: bounds of the output, what makes them, and the cheapest tolerances for a target."""

import csv
import io

import numpy as np
import pytest

from cardan import io as files
from cardan.cli.motion.accuracy import goal_of
from cardan.errors import InputError
from cardan.questions.accuracy.allocation import allocate
from cardan.questions.accuracy.sampling import MonteCarlo
from cardan.questions.accuracy.tolerance import WorstCase, tolerance
from cardan.units import arcmin, deg
from tests.cli.conftest import EXAMPLES
from tests.cli.test_forces import plain, widest

INSTRUMENT = EXAMPLES / "instrument-joint.toml"
ROUND = {"rtol": 1e-12, "atol": 1e-12}
"""Printed in full precision: what is read back differs by the conversion of units alone."""


@pytest.mark.parametrize(
    "options",
    [(), ("--method", "worst"), ("--method", "samples", "--samples", 512), ("--allocate", "2arcmin")],
    ids=["squares", "worst", "samples", "allocate"],
)
def test_the_answer_stands_within_80_columns(cardan, options):
    done = cardan("accuracy", INSTRUMENT, *options)
    assert (done.code, done.err) == (0, "")
    assert widest(done.out) <= 80
    assert done.out.startswith("instrument joint: ")


def test_the_old_name_asks_it_too(cardan):
    assert cardan("tolerance", INSTRUMENT).out == cardan("accuracy", INSTRUMENT).out


def test_known_errors_alone_are_answered(cardan, drive_file):
    text = "format = 1\n[[joints]]\njoint_angle_deg = 20\nerror = { alpha2_arcmin = 2 }\n"
    done = cardan("accuracy", drive_file(text))
    assert done.code == 0
    assert "known errors make an angle error of up to" in plain(done.out)


def test_errors_that_keep_a_joint_from_closing_are_told(cardan, drive_file):
    text = "format = 1\n[[joints]]\njoint_angle_deg = 20\nerror = { alpha2_deg = 80 }\n"
    done = cardan("accuracy", drive_file(text), "--json")
    assert (done.code, done.content["closes"]) == (0, False)


def test_json_is_the_band(cardan):
    said = cardan("accuracy", INSTRUMENT, "--json").content
    found = tolerance(files.load(INSTRUMENT))
    assert said["angle"]["largest_arcmin"] == pytest.approx(found.output.largest / arcmin, rel=1e-12)
    assert said["shift"]["largest_um"] == pytest.approx(found.shift.largest * 1e6, rel=1e-12)
    fields = [row["field"] for row in said["angle"]["contributions"]]
    assert fields == [one.field for one in found.output.contributions]
    assert sum(row["share"] for row in said["angle"]["contributions"]) == pytest.approx(1.0, rel=1e-12)
    np.testing.assert_allclose(said["bounds"]["error_upper_arcmin"], found.output.upper / arcmin, **ROUND)
    np.testing.assert_allclose(said["bounds"]["shift_lower_95_um"], found.shift.lower_95 * 1e6, **ROUND)


@pytest.mark.slow
def test_the_worst_case_is_the_widest(cardan):
    """Sums of sizes exceed roots of squares, and hold every drive that can be drawn."""
    sizes = {
        method: cardan("accuracy", INSTRUMENT, "--method", method, "--json").content["angle"]["largest_arcmin"]
        for method in ("squares", "worst", "samples")
    }
    assert sizes["worst"] > sizes["squares"]
    assert sizes["worst"] > sizes["samples"]
    found = tolerance(files.load(INSTRUMENT), method=WorstCase())
    assert sizes["worst"] == pytest.approx(found.output.largest / arcmin, rel=1e-12)


def test_samples_and_seed_count(cardan):
    options = ("--method", "samples", "--samples", 256, "--seed", 7)
    said = cardan("accuracy", INSTRUMENT, *options, "--json").content
    found = tolerance(files.load(INSTRUMENT), method=MonteCarlo(samples=256, seed=7))
    assert (said["samples"], said["seed"], said["lost_samples"]) == (256, 7, 0)
    assert said["angle"]["largest_arcmin"] == pytest.approx(found.output.largest / arcmin, rel=1e-12)
    assert "256 drives drawn, seed 7" in plain(cardan("accuracy", INSTRUMENT, *options).out)


def test_csv_and_json_agree(cardan):
    table = list(csv.DictReader(io.StringIO(cardan("accuracy", INSTRUMENT, "--csv").out)))
    said = cardan("accuracy", INSTRUMENT, "--json").content["bounds"]
    assert {key: [float(row[key]) for row in table] for key in said} == said


def test_allotted_tolerances_are_those_of_the_library(cardan):
    said = cardan("accuracy", INSTRUMENT, "--allocate", "2arcmin", "--keep", "alpha4", "--json").content
    found = allocate(files.load(INSTRUMENT), 2 * arcmin, keep=["joints[0].tolerance.alpha4"])
    assert said["cost"] == pytest.approx(found.cost, rel=1e-9)
    assert [row["kept"] for row in said["tolerances"]] == [False, False, False, False, True]
    assert said["largest_arcmin"] == pytest.approx(2.0, rel=1e-9)
    assert "joints[0].tolerance.alpha4_arcmin" not in said["values"]


@pytest.mark.parametrize("options", [(), ("--method", "worst")], ids=["squares", "worst"])
def test_what_is_written_keeps_the_target_and_the_comments(cardan, tmp_path, options):
    done = cardan("accuracy", INSTRUMENT, "--allocate", "2arcmin", *options, "-o", "better.toml")
    assert done.code == 0, done.err
    for line in INSTRUMENT.read_text().splitlines():
        if "#" in line:
            assert line in (tmp_path / "better.toml").read_text()
    left = cardan("accuracy", "better.toml", *options, "--json").content["angle"]["largest_arcmin"]
    assert 1.98 < left <= 2.0  # rounded down to three digits


def test_tolerances_are_found_where_none_is_given(cardan, tmp_path):
    path = EXAMPLES / "six-joints.toml"
    done = cardan("accuracy", path, "--allocate", "0.1deg", "-o", "new.toml")
    assert done.code == 0, done.err
    found = tolerance(files.load(tmp_path / "new.toml"))
    assert found.output.largest == pytest.approx(0.1 * deg, rel=1e-2)
    assert found.output.largest <= 0.1 * deg


def test_a_length_limits_the_shift(cardan, tmp_path):
    said = cardan("accuracy", INSTRUMENT, "--allocate", "5um", "-o", "new.json", "--json").content
    assert said["of"] == "shift"
    assert said["target_um"] == pytest.approx(5.0)
    assert tolerance(files.load(tmp_path / "new.json")).shift.largest <= 5e-6


def test_the_suggested_commands_work(cardan, tmp_path):
    for options in ((), ("--allocate", "2arcmin", "--of", "change", "--method", "worst", "--keep", "phase")):
        out = cardan("accuracy", INSTRUMENT, *options).out
        line = next(line for line in out.splitlines() if line.startswith("    cardan"))
        done = cardan(*line.replace("'", "").split()[1:])
        assert done.code == 0, done.err
    assert (tmp_path / "better.toml").exists()


@pytest.mark.parametrize(
    ("text", "size", "length"),
    [("2arcmin", 2 * arcmin, False), ("0.05 deg", 0.05 * deg, False), ("2′", 2 * arcmin, False), ("7um", 7e-6, True)],
)
def test_targets_have_units(text, size, length):
    found = goal_of(text)
    assert found == (pytest.approx(size, rel=1e-12), length)


@pytest.mark.parametrize("text", ["2", "arcmin", "2rpm", "1e", "--1deg", ""])
def test_targets_without_sense_are_refused(text):
    with pytest.raises(InputError, match="not an error with a unit"):
        goal_of(text)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("--samples", 500), "--samples: belongs to --method samples"),
        (("--seed", 5), "--seed: belongs to --method samples"),
        (("--method", "samples", "--samples", 3), "--samples: 3 given; at least"),
        (("--keep", "alpha1"), "--keep: belongs to --allocate"),
        (("-o", "x.toml"), "--out: belongs to --allocate"),
        (("--allocate", "2arcmin", "--method", "samples"), "--method: --allocate adds errors up"),
        (("--allocate", "2"), "--allocate: not an error with a unit: 2"),
        (("--allocate=-2deg",), "--allocate: -2deg is not allowed; the error must be above 0"),
        (("--allocate", "0arcmin"), "--allocate: 0arcmin is not allowed"),
        (("--method", "samples", "--samples", 10**12), "--samples: 1000000000000 drives asked for; the limit is"),
        (("--allocate", "2arcmin", "--keep", "wrong"), "--keep: no joint has a tolerance wrong"),
        (("--allocate", "0.1arcmin", "--keep", "phase"), "--allocate: known errors and the tolerances"),
    ],
)
def test_bad_options_are_refused(cardan, tmp_path, options, said):
    done = cardan("accuracy", INSTRUMENT, *options)
    assert (done.code, done.out) == (2, "")
    assert said in done.err
    assert not list(tmp_path.iterdir())


def test_missing_tolerances_are_named(cardan):
    done = cardan("accuracy", EXAMPLES / "six-joints.toml")
    assert (done.code, done.out) == (2, "")
    assert "joints[0].tolerance: missing" in done.err
    assert "alpha1_deg" in done.err


@pytest.mark.parametrize("options", [(), ("--allocate", "2arcmin")], ids=["band", "allotted"])
def test_a_figure_is_drawn(cardan, tmp_path, options):
    assert cardan("accuracy", INSTRUMENT, *options, "--plot", "band.svg").code == 0
    assert (tmp_path / "band.svg").stat().st_size > 1000


def test_errors_beyond_first_order_are_told_to_be_so(cardan, drive_file):
    # sin α/(2 cos α) of the joint angle multiplies a minute of alpha2 by 3 000 at 89.99°.
    text = "format = 1\n[[joints]]\njoint_angle_deg = 89.99\ntolerance = { alpha2_arcmin = 1 }\n"
    out = plain(cardan("accuracy", drive_file(text)).out)
    assert "▲ Warning: errors this large are beyond first order" in out
    assert "beyond first order" not in cardan("accuracy", INSTRUMENT).out
