"""Results are read as they were written, questions are answered as NumPy answers them, nothing is changed."""

from dataclasses import replace

import numpy as np
import pyarrow.dataset
import pytest

from cardan.batch.engine.running import run
from cardan.batch.search.goals import Goal, Limit
from cardan.batch.search.pareto import pareto
from cardan.batch.table.results import results, sql_names
from cardan.errors import InputError
from tests.batch.tables import COLUMNS, SIZE, Suspension, stored, whole

HEIGHT, JOINT_ANGLE = "joints[1].centre_mm[2]", "joint_angle_deg[1]"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return stored(tmp_path_factory.mktemp("sweep") / "it's here").folder


@pytest.fixture(scope="module", params=["folder", "one file", "memory"])
def found(request, folder, tmp_path_factory):
    if request.param == "memory":
        return results(run(Suspension(), chunk=50))
    return results(folder if request.param == "folder" else stored(tmp_path_factory.mktemp("one") / "out", 999).folder)


def same(rows, expected):
    assert list(rows) == list(expected)
    for name, column in rows.items():
        np.testing.assert_array_equal(column, expected[name])


def test_the_whole_table_in_order(found):
    same(found.table(), whole())
    assert found.columns == COLUMNS
    assert found.units[JOINT_ANGLE] == "deg"
    assert found.provenance["seed"] == 3
    assert [column.name for column in found.numbers] == [HEIGHT, "duty.speed_rpm", "speed_fluctuation", JOINT_ANGLE]


def test_some_columns_of_some_rows(found):
    table = whole()
    picked = (table[HEIGHT] > 20.0) & (table["supplier"] == "Alpha")
    rows = found.table(["duty.speed_rpm", HEIGHT], where=f"{HEIGHT} > 20 AND supplier = 'Alpha'", limit=7)
    same(rows, {name: table[name][picked][:7] for name in ("duty.speed_rpm", HEIGHT)})
    assert found.count() == SIZE
    assert found.count(f"{HEIGHT} > 90") == 10


def test_what_has_no_answer_is_null_and_not_the_greatest(found):
    """SQL takes nan for greater than all numbers."""
    rows = found.query(f"SELECT max(speed_fluctuation) AS most, count({JOINT_ANGLE}) AS answered FROM sweep")
    assert rows["most"][0] == pytest.approx(1e-6 * 100.0**2 + 1e-3)
    assert rows["answered"][0] == 200
    assert np.isnan(found.table(["speed_fluctuation"], where=f"{HEIGHT} > 90")["speed_fluctuation"]).all()


def test_words_without_a_value_are_none(found):
    rows = found.query("SELECT CASE WHEN status = 0 THEN supplier END AS who FROM sweep ORDER BY status DESC LIMIT 12")
    assert rows["who"].tolist()[:10] == [None] * 10
    assert rows["who"][10] in ("Alpha", "Beta")


def test_spans_are_those_of_the_rows_that_have_an_answer(found):
    answers = whole()["speed_fluctuation"]
    spans = found.spans(["speed_fluctuation", HEIGHT])
    assert spans["speed_fluctuation"] == pytest.approx(
        {"least": np.nanmin(answers), "mean": np.nanmean(answers), "most": np.nanmax(answers), "unknown": 10.0}
    )
    assert spans[HEIGHT]["most"] == 100.0
    assert set(found.spans()) == {column.name for column in found.numbers}


def test_the_best_rows(found):
    best = found.best(
        Goal(name=JOINT_ANGLE, largest=True), count=3, limits=[Limit(name="speed_fluctuation", high=0.0075)]
    )
    assert best[JOINT_ANGLE].tolist() == pytest.approx([16.0] * 3)
    assert best[HEIGHT].tolist() == [-80.0] * 3
    least = found.best(Goal(name="speed_fluctuation"), where="supplier = 'Beta'")
    assert least["speed_fluctuation"][0] == 1e-3
    assert least["supplier"][0] == "Beta"
    assert len(found.best(Goal(name=JOINT_ANGLE), limits=[Limit(name=JOINT_ANGLE, low=50.0)])[JOINT_ANGLE]) == 0


@pytest.mark.slow
def test_the_pareto_set_is_that_of_the_whole_table(found):
    goals = [Goal(name="speed_fluctuation"), Goal(name=JOINT_ANGLE)]
    table = whole()
    rows = found.pareto(goals)
    chosen = pareto(table, goals)
    assert len(rows[JOINT_ANGLE]) == np.count_nonzero(chosen)
    assert np.all(np.diff(rows["speed_fluctuation"]) >= 0.0)
    np.testing.assert_allclose(np.sort(rows[JOINT_ANGLE]), np.sort(table[JOINT_ANGLE][chosen]))
    some = found.pareto(goals, limits=[Limit(name=HEIGHT, high=50.0)], where="supplier = 'Alpha'")
    assert some[HEIGHT].max() == 50.0
    assert set(some["supplier"]) == {"Alpha"}


def test_a_sample_is_drawn_evenly_and_again_the_same(found):
    one, other = (found.sample([HEIGHT], 40, seed=1)[HEIGHT] for _k in range(2))
    np.testing.assert_array_equal(one, other)
    assert len(one) == 40
    assert len(np.unique(one)) > 10
    assert len(found.sample([HEIGHT], 1000)[HEIGHT]) == SIZE


@pytest.mark.parametrize(
    "sql",
    [
        "DROP VIEW sweep",
        "SELECT 1; SELECT 2",
        "COPY sweep TO 'stolen.csv'",
        "SET threads = 1",
        "",
        "SELECT * FROM read_csv('/etc/passwd')",
        "SELECT * FROM glob('/etc/*')",
        "ATTACH 'other.db'",
    ],
)
def test_questions_read_this_table_alone_and_change_nothing(found, sql):
    with pytest.raises(InputError, match=r"only one SELECT|cannot be answered"):
        found.query(sql)


def test_what_is_neither_number_nor_word_is_told_in_words(found):
    rows = found.query(
        "SELECT [1, 2] AS a, DATE '2020-01-01' AS b, INTERVAL 1 DAY AS c, NULL::DATE AS d, 'inf'::DOUBLE AS f"
    )
    assert rows["a"].tolist() == ["[1 2]"]
    assert rows["b"].tolist() == ["2020-01-01 00:00:00"]
    assert rows["c"].tolist() == ["1 day, 0:00:00"]
    assert rows["d"].tolist() == [None]
    assert rows["f"].tolist() == [np.inf]


def test_equal_ones_are_told_in_the_order_of_their_points(found):
    equal = found.best(Goal(name="status"), count=SIZE)
    places = list(zip(equal[HEIGHT], equal["duty.speed_rpm"], strict=True))
    assert places == sorted(places)


def test_a_question_that_has_no_answer_is_told_in_words(found):
    with pytest.raises(InputError, match=r"cannot be answered.*speed_fluctation"):
        found.query("SELECT speed_fluctation FROM sweep")
    with pytest.raises(InputError, match=r"columns: speed_fluctation.*nearest is speed_fluctuation"):
        found.table(["speed_fluctation"])
    with pytest.raises(InputError, match="none is given"):
        found.pareto([])


def test_folders_that_hold_no_sweep(tmp_path, folder):
    with pytest.raises(InputError, match="holds no sweep"):
        results(tmp_path)
    (tmp_path / "_manifest.json").write_text("{}", encoding="utf-8")
    with pytest.raises(InputError, match="is not the manifest of a sweep"):
        results(tmp_path)
    summaries = run(Suspension(), into=tmp_path / "none", rows="none").folder
    with pytest.raises(InputError, match="summaries alone"):
        results(summaries)


def test_the_folder_is_one_table_for_any_reader(folder):
    """Arrow's readers, by which pandas and Dask read too, take a folder as it is."""
    rows = pyarrow.dataset.dataset(folder, format="parquet").to_table()
    assert rows.num_rows == SIZE
    assert set(rows.column_names) >= {HEIGHT, "duty.speed_rpm"}


def test_a_damaged_file_is_one_clear_message(tmp_path):
    made = stored(tmp_path / "out").folder
    file = sorted(made.glob("*.parquet"))[1]
    file.write_bytes(file.read_bytes()[:-40])
    with pytest.raises(InputError, match=r"damaged.*run the sweep again"):
        results(made).count("speed_fluctuation > 0")


def test_a_sweep_of_which_parts_are_missing_is_read_as_far_as_it_is(tmp_path):
    made = stored(tmp_path / "out").folder
    sorted(made.glob("*.parquet"))[1].unlink()
    found = results(made)
    assert found.count() == SIZE - 50
    assert found.sweep.status == "incomplete"
    for file in made.glob("*.parquet"):
        file.unlink()
    assert results(made).count() == 0
    assert results(made).pareto([Goal(name=JOINT_ANGLE)])[JOINT_ANGLE].shape == (0,)


def test_a_sweep_without_a_status_has_all_its_rows_allowed():
    sweep = run(Suspension(), chunk=50)
    bare = replace(sweep, columns=COLUMNS[:-1])
    assert len(results(bare).best(Goal(name=JOINT_ANGLE), count=500)[JOINT_ANGLE]) == 200


def test_names_with_brackets_are_put_into_quotes_once_and_not_within_words():
    names = ["a[1].b", "a[1].b[2]", "plain"]
    assert sql_names('a[1].b[2] + a[1].b > "a[1].b"', names) == '"a[1].b[2]" + "a[1].b" > "a[1].b"'
    assert sql_names("x = 'a[1].b' AND plain > za[1].b", names) == "x = 'a[1].b' AND plain > za[1].b"
