"""What is said of the catalogue: in the units of whoever looks, with keys that a file may have."""

import pytest

from cardan.answers.answer import Answer
from cardan.answers.data import as_csv, data
from cardan.answers.printed import printed
from cardan.answers.reader import Reader, reading
from cardan.catalogue import catalogue
from cardan.catalogue.answer import answer, answer_of_keys, answer_of_row, answer_of_table

INCH = Reader(units={"length": "in", "torque": "lbft"}, decimal=",")


def first_cells(one: Answer, who: Reader) -> dict[str, str]:
    table = printed(one.tables[0], who, "brief")
    return {column.heading: cell.text for column, cell in zip(table.columns, table.rows[0], strict=True)}


def test_rows_stand_in_the_units_of_the_reader():
    with reading(INCH):
        one = answer_of_table(catalogue(), "joint_sizes")
        cells = first_cells(one, INCH)
        row = data(one, INCH)["rows"][0]
        head = next(iter(as_csv(one.full(), INCH))).splitlines()[0]
    assert (cells["id"], cells["outer"], cells["torque"]) == ("example-58", "2,283", "405,7")
    assert row["rating"]["outer_in"] == pytest.approx(58.0 / 25.4)
    assert "rating.torque_lbft" in head.split(",")


def test_rows_stand_as_a_file_gives_them_where_nothing_is_chosen():
    one = answer_of_table(catalogue(), "joint_sizes")
    assert first_cells(one, Reader())["outer"] == "58"
    assert data(one, Reader())["rows"][0]["rating"]["max_joint_angle_deg"] == 35.0


def test_intervals_of_lubrication_stand_in_hours_and_kilometres():
    one = answer_of_table(catalogue(), "lubrication")
    assert first_cells(one, Reader()) == {
        "id": "needle_bearings", "hours": "500", "distance": "10\u202f000", "years": "–", "how sure": "book",
    }  # fmt: skip
    assert data(one, Reader())["rows"][0]["distance_km"] == 10000.0
    with reading(INCH):
        assert data(answer_of_table(catalogue(), "lubrication"), INCH)["rows"][0]["distance_in"] == pytest.approx(
            1e7 / 0.0254
        )


def test_a_row_tells_flags_in_words():
    one = answer_of_row(catalogue(), "joint_sizes", catalogue().tables["joint_sizes"]["example-75"])
    cells = {row[0].text: row[1].text for row in printed(one.tables[0], Reader(), "brief").rows}
    assert (cells["cross.slides"], cells["cross.mass_kg"]) == ("no", "0.36")


def test_tables_and_keys_are_records():
    assert data(answer(catalogue()), Reader())["tables"][0].keys() == {"table", "rows", "what"}
    assert data(answer_of_keys("materials"), Reader())["keys"][0].keys() == {"key", "needed", "meaning"}
