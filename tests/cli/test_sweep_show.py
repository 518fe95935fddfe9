"""cardan sweep show: the table told, the best points, choices, questions in SQL, exports and pictures."""

import csv
import io

import numpy as np
import pytest

from cardan.batch import show_answer as sweep_asked
from cardan.batch.search.pareto import pareto
from tests.batch.tables import SIZE, stored, whole
from tests.cli.test_forces import plain, widest

TABLE = whole()
GOALS = ("--pareto", "min speed_fluctuation", "--pareto", "min joint_angle_deg[1]")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return stored(tmp_path_factory.mktemp("sweep") / "travel").folder


def show(cardan, folder, *options):
    done = cardan("sweep", "show", folder, *options)
    assert (done.code, done.err) == (0, "")
    return done


@pytest.mark.parametrize(
    "options", [(), ("--best", "min speed_fluctuation"), GOALS, ("--query", "SELECT count(*) AS n FROM sweep")]
)
def test_the_answer_stands_within_80_columns(cardan, folder, options):
    done = show(cardan, folder, *options)
    assert done.out.startswith("travel: ")
    assert widest(done.out) <= 80


def test_the_table_is_told_by_its_spans(cardan, folder):
    done = show(cardan, folder)
    assert "travel: 210 points; speed fluctuation of the output lies between 0.001000 and" in done.out
    said = show(cardan, folder, "--json").content
    assert said["count"] == SIZE
    assert said["spans"]["speed_fluctuation"]["most"] == np.nanmax(TABLE["speed_fluctuation"])
    assert said["provenance"]["seed"] == 3
    assert said["columns"][4] == {
        "name": "joint_angle_deg[1]",
        "unit": "deg",
        "role": "answer",
        "text": "joint angle of a joint",
    }


def test_the_best_points(cardan, folder):
    said = show(
        cardan, folder, "--best", "max joint_angle_deg[1]", "--limit", "speed_fluctuation <= 0.0075", "--json"
    ).content
    assert said["count"] == 12
    assert said["rows"]["joint_angle_deg[1]"][0] == 16.0
    done = show(
        cardan, folder, "--best", "max joint_angle_deg[1]", "--where", "joints[1].centre_mm[2] > 0", "--count", "2"
    )
    assert "has joint_angle_deg[1] 11.50°" in done.out
    none = show(cardan, folder, "--best", "min speed_fluctuation", "--limit", "speed_fluctuation <= 0")
    assert "none of 210 points was answered and keeps the limits" in none.out


def test_numbers_without_end_are_told(cardan, folder):
    done = show(cardan, folder, "--query", "SELECT 'inf'::DOUBLE AS a, -('inf'::DOUBLE) AS b, 'nan'::DOUBLE AS c")
    assert done.out.split()[-3:] == ["∞", "−∞", "–"]


def test_a_table_without_any_answer(cardan, folder):
    assert "10 points, none of them answered" in show(cardan, folder, "--where", "status > 0").out


@pytest.mark.slow
def test_a_choice_between_goals(cardan, folder):
    said = show(cardan, folder, *GOALS, "--json").content
    chosen = pareto(TABLE, [sweep_asked.Goal(name="speed_fluctuation"), sweep_asked.Goal(name="joint_angle_deg[1]")])
    assert said["count"] == np.count_nonzero(chosen)
    assert "none is better in all goals" in plain(show(cardan, folder, *GOALS).out)


def test_csv_holds_all_that_was_told(cardan, folder):
    rows = list(csv.DictReader(io.StringIO(show(cardan, folder, "--csv").out)))
    assert len(rows) == SIZE
    assert [float(row["duty.speed_rpm"]) for row in rows] == TABLE["duty.speed_rpm"].tolist()
    assert rows[-1]["speed_fluctuation"] == ""
    best = list(csv.DictReader(io.StringIO(show(cardan, folder, "--best", "min speed_fluctuation", "--csv").out)))
    assert len(best) == 12
    some = show(cardan, folder, "--query", "SELECT supplier, count(*) AS n FROM sweep GROUP BY supplier", "--csv")
    assert sorted(some.out.splitlines()[1:]) == ["Alpha,70", "Beta,140"]


@pytest.mark.slow
@pytest.mark.parametrize("suffix", [".csv", ".xlsx", ".parquet"])
def test_exports(cardan, folder, tmp_path, suffix):
    done = show(cardan, folder, "--export", tmp_path / f"all{suffix}", "--where", "status = 0")
    assert (tmp_path / f"all{suffix}").stat().st_size > 1000
    assert "200 rows written" in " ".join(done.out.split())
    assert show(cardan, folder, *GOALS, "--export", tmp_path / f"some{suffix}", "--json").content["exported"]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("options", "titles"),
    [
        ((), ["Speed fluctuation of the output over", "How often"]),
        (GOALS, ["Pareto front", "Every point as a line"]),
        (("--kind", "tornado", "--of", "joint_angle_deg[1]"), ["What it goes with: joint_angle_deg[1]"]),
        (("--kind", "map", "--over", "supplier", "--over", "duty.speed_rpm"), ["over duty.speed_rpm and supplier"]),
        (("--kind", "histogram", "--kind", "lines", "--where", "status = 0"), ["How often", "Every point"]),
    ],
)
def test_pictures_that_suit(cardan, folder, tmp_path, options, titles):
    show(cardan, folder, *options, "--plot", tmp_path / "a.svg")
    drawn = (tmp_path / "a.svg").read_text(encoding="utf-8")
    assert all(title in drawn for title in titles)


def test_a_table_of_many_fields_is_drawn_as_lines(cardan, folder, tmp_path, monkeypatch):
    monkeypatch.setattr(sweep_asked, "FEW", 5)
    show(cardan, folder, "--plot", tmp_path / "a.svg")
    drawn = (tmp_path / "a.svg").read_text(encoding="utf-8")
    assert "Every point as a line" in drawn
    assert "What it goes with" in drawn


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("--kind", "pie"), "'pie' is none of lines"),
        (("--best", "min speed_fluctuation", *GOALS), "choose one of --best, --pareto"),
        (("--pareto", "min speed_fluctuation"), "two goals or more"),
        (("--best", "speed_fluctuation"), "not a goal"),
        (("--best", "min speed_fluctation"), "the nearest is speed_fluctuation"),
        (("--limit", "x"), "not a limit"),
        (("--where", "nothing > 1"), "cannot be answered"),
        (("--query", "DROP TABLE sweep"), "only one SELECT"),
        (("--over", "supplier"), "over two fields"),
        (("--kind", "pareto"), "two goals or more"),
        (("--of", "bent"), "no such column"),
        (("--export", "a.doc"), "should end in one of"),
    ],
)
def test_what_cannot_be_done_is_told(cardan, folder, options, said):
    done = cardan("sweep", "show", folder, *options)
    assert (done.code, done.out) == (2, "")
    assert said in " ".join(done.err.split())


def test_a_folder_without_a_sweep(cardan, tmp_path):
    done = cardan("sweep", "show", tmp_path)
    assert done.code == 2
    assert "holds no sweep" in done.err
