"""cardan sweep --design: what designs of a plan find, told, in JSON, in CSV and as a picture."""

import csv
import io

import numpy as np
import pytest

from tests.cli.conftest import EXAMPLES
from tests.cli.test_forces import widest

SWEEPS = EXAMPLES / "sweeps"
HEAD = f'format = 1\ndrive = "{EXAMPLES / "single-20deg.toml"}"\ntitle = "a joint"\nask = ["speed_fluctuation"]\n'
JOINT_ANGLE = 'between = { "joints[0].joint_angle_deg" = [0, 30] }\n'
PLANS = {
    "best": HEAD
    + '[search]\ngoals = ["max speed_fluctuation_percent"]\nlimits = ["speed_fluctuation_percent <= 10"]\n'
    + JOINT_ANGLE,
    "none": HEAD
    + '[search]\ngoals = ["max speed_fluctuation_percent"]\nlimits = ["speed_fluctuation_percent <= -100"]\n'
    + JOINT_ANGLE,
    "choice": HEAD.replace('"]', '", "greatest_joint_angle"]')
    + "[search]\npopulation = 20\ngenerations = 3\n"
    + 'goals = ["min speed_fluctuation_percent", "max greatest_joint_angle_deg"]\n'
    + JOINT_ANGLE,
    "boundary": HEAD
    + '[boundary]\nlimits = ["speed_fluctuation_percent <= 10"]\ncoarse = [4, 2]\nhalvings = 1\n'
    + 'between = { "joints[0].joint_angle_deg" = [5, 30], "duty.speed_rpm" = [500, 1000] }\n',
    "sensitivity": HEAD
    + '[[vary]]\ndesign = "lhs"\ncount = 10\nfields = [{ key = "joints[0].joint_angle_deg", distribution = "uniform", '
    + "plus_minus = 1 }]\n[sensitivity]\nsamples = 64\n",
}


@pytest.fixture
def design(cardan, tmp_path):
    def run(name, *options, code=0):
        (tmp_path / f"{name}.toml").write_text(PLANS[name], encoding="utf-8")
        if name == "sensitivity":
            options = ("--design", "sensitivity", *options)
        done = cardan("sweep", tmp_path / f"{name}.toml", *options)
        assert (done.code, done.err) == (code, "")
        return done

    return run


@pytest.mark.parametrize("name", PLANS)
def test_the_answer_stands_within_80_columns_and_is_drawn(design, tmp_path, name):
    done = design(name, "--plot", tmp_path / "a.svg", code=int(name == "none"))
    assert done.out.removeprefix("▲ ").startswith("a joint: ")
    assert widest(done.out) <= 80
    assert (tmp_path / "a.svg").stat().st_size > 1000


@pytest.mark.slow
def test_the_best_point_keeps_the_limit(design):
    """δ = sin α tan α = 0.1 at 18.03°."""
    said = design("best", "--json").content
    assert said["status"] == "converged"
    joint_angle = np.radians(said["point"]["joints[0].joint_angle_deg"])
    assert np.sin(joint_angle) * np.tan(joint_angle) == pytest.approx(0.1, abs=1e-5)
    assert said["values"]["speed_fluctuation_percent"] <= 10.0 + 1e-7
    assert "max speed_fluctuation_percent is 10" in design("best").out
    none = design("none", code=1)
    assert "none of" in none.out
    assert design("none", "--json", code=1).content["status"] == "nothing found"


def test_a_choice(design):
    said = design("choice", "--json").content
    assert len(said["points"]["joints[0].joint_angle_deg"]) > 10
    rows = list(csv.DictReader(io.StringIO(design("choice", "--csv").out)))
    assert [float(row["speed_fluctuation_percent"]) for row in rows] == said["points"]["speed_fluctuation_percent"]
    assert "none is better in all goals" in " ".join(design("choice").out.split())


def test_a_boundary(design):
    said = design("boundary", "--json").content
    rows = list(csv.DictReader(io.StringIO(design("boundary", "--csv").out)))
    assert [[float(row[name]) for name in said["fields"]] for row in rows] == said["lines"][0]
    assert said["grid"] == 9 * 5
    assert "1 line bounds where speed_fluctuation_percent <= 10" in design("boundary").out


def test_shares_of_the_variance(design):
    said = design("sensitivity", "--json").content
    assert said["answers"]["speed_fluctuation_percent"]["total"] == pytest.approx([1.0], abs=0.1)
    (row,) = csv.DictReader(io.StringIO(design("sensitivity", "--csv").out))
    assert float(row["in_all"]) == said["answers"]["speed_fluctuation_percent"]["total"][0]


def test_the_tolerance_field_that_is_shipped(cardan):
    """Fields that undo each other: together they bring about more than alone."""
    said = cardan("sweep", SWEEPS / "tolerance-field.toml", "--design", "sensitivity", "--json").content
    told = said["answers"]["speed_fluctuation_percent"]
    assert sum(told["first"]) < 0.6 < 1.0 < sum(told["total"])
    assert said["fields"][int(np.argmax(told["total"]))] == "joints[2].joint_angle_deg"


@pytest.mark.slow
def test_the_choice_of_suppliers_that_is_shipped(cardan, tmp_path):
    done = cardan("sweep", SWEEPS / "supplier-choice.toml", "--into", tmp_path / "offers")
    assert done.code == 0
    said = cardan(
        "sweep",
        "show",
        tmp_path / "offers",
        *("--pareto", "min price_eur", "--pareto", "max life_h", "--limit", "strength_used_percent <= 100", "--json"),
    ).content
    assert said["rows"]["supplier"] == ["Birch", "Dogwood"]
    assert all(one <= 100.0 for one in said["rows"]["strength_used_percent"])


@pytest.mark.slow
def test_the_boundary_of_stability_that_is_shipped(cardan, tmp_path):
    """Coarser than shipped: its tip lies at the speed of the zone, and the stand as it is lies within."""
    text = (SWEEPS / "stability-boundary.toml").read_text(encoding="utf-8")
    text = text.replace("../unstable", str(EXAMPLES / "unstable")).replace("halvings = 2", "halvings = 0")
    (tmp_path / "coarse.toml").write_text(text, encoding="utf-8")
    said = cardan("sweep", tmp_path / "coarse.toml", "--json").content
    (line,) = np.asarray(said["lines"])
    tip = line[np.argmin(line[:, 1])]
    assert tip == pytest.approx([1340.0, 12.0], abs=15.0)
    at_18 = line[np.argsort(np.abs(line[:, 1] - 18.0))[:4], 0]
    assert at_18.min() < 1340.0 < at_18.max()
