"""What is said of formulas: in the units of their keys, whole names for whoever types them."""

import math

import pytest

from cardan.answers.data import data
from cardan.answers.printed import printed
from cardan.answers.reader import Reader
from cardan.calc import CALCULATIONS, calc, find
from cardan.calc.answer import answer, answer_of_all, answer_of_keys

COMMA = Reader(units={"angle": "rad"}, decimal=",")


def test_values_keep_the_units_of_their_keys_whoever_looks():
    found = calc("fourier_single", {"alpha_deg": 20, "kmax": 3})
    one = answer(find("fourier_single"), found)
    assert data(one, COMMA)["result"] == found
    shown = {row[0].text: row[1].text for row in printed(one.tables[0], COMMA, "brief").rows}
    assert shown["c_exact"] == "[0,0310912; 0,000483331; 0,0000100182]"


def test_long_lists_are_summed_up_for_people_alone():
    found = calc("fourier_single", {"alpha_deg": 20, "kmax": 9})
    one = answer(find("fourier_single"), found)
    assert "9 values, see --json" in [row[1].text for row in printed(one.tables[0], COMMA, "brief").rows]
    assert len(data(one, COMMA)["result"]["c_exact"]) == 9


def test_a_list_of_numbers_is_a_table_with_a_row_each():
    asked = {"alpha_rad": [0.1, 0.2, 0.3]}
    one = answer(find("single_joint_extremes"), calc("single_joint_extremes", asked), asked)
    rows = data(one, COMMA)["result"]
    assert [row["alpha_rad"] for row in rows] == [0.1, 0.2, 0.3]
    for row in rows:
        assert row["delta"] == pytest.approx(math.sin(row["alpha_rad"]) * math.tan(row["alpha_rad"]), rel=1e-12)
    shown = printed(one.tables[0], COMMA, "brief")
    assert [column.heading for column in shown.columns][:3] == ["alpha_rad", "ratio_max", "ratio_min"]
    assert [row[0].text for row in shown.rows] == ["0,100000", "0,200000", "0,300000"]
    table = printed(one.full(), COMMA)
    assert len(table.rows) == 3


def test_a_list_that_is_one_input_makes_no_rows():
    # Two speeds of running have one band of speeds to keep out of: from one speed to another.
    asked = {"n_critical_rpm": 7000, "n_max_rpm": 3000, "operating_rpm": [1000, 2000]}
    single = answer(find("critical_speed_margin"), calc("critical_speed_margin", asked), asked)
    assert isinstance(data(single, COMMA)["result"], dict)


def test_outputs_named_by_an_order_have_their_meaning():
    asked = {"q": 3, "boundaries_up_to_order": 4}
    one = answer(find("mathieu_stability"), calc("mathieu_stability", asked), asked)
    shown = printed(one.tables[0], COMMA, "brief").rows
    assert [row[0].text for row in shown] == ["a_0_to_4", "b_1_to_4"]
    assert all(row[2].text for row in shown)


def test_every_formula_and_its_keys_are_told():
    assert [row["capability"] for row in data(answer_of_all(), COMMA)["capabilities"]] == list(CALCULATIONS)
    told = data(answer_of_keys(find("chain")), COMMA)
    assert told["takes"][0] == {
        "key": "alpha_deg", "form": "list or list of lists", "required": True, "doc": find("chain").takes[0].doc,
    }  # fmt: skip
