"""What is said of formulas: in the units of their keys, whole names for whoever types them."""

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
    found = calc("single_joint", {"alpha_deg": 20, "phi1_deg": list(range(0, 360, 10))})
    one = answer(find("single_joint"), found)
    assert "36 values, see --json" in [row[1].text for row in printed(one.tables[0], COMMA, "brief").rows]
    assert len(data(one, COMMA)["result"]["ratio_21"]) == 36


def test_every_formula_and_its_keys_are_told():
    assert [row["capability"] for row in data(answer_of_all(), COMMA)["capabilities"]] == list(CALCULATIONS)
    told = data(answer_of_keys(find("chain")), COMMA)
    assert told["takes"][0] == {
        "key": "alpha_deg", "form": "list or list of lists", "required": True, "doc": find("chain").takes[0].doc,
    }  # fmt: skip
