"""What is said of mobility: the numbers of the analysis, in the trade's words, for drives and mechanisms."""

from dataclasses import replace

import pytest

from cardan.answers.data import data
from cardan.answers.printed import printed
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL, Reader
from cardan.drive.drive import Drive
from cardan.drive.support import Support
from cardan.io import example
from cardan.mechanisms import example_mechanism
from cardan.questions.mobility.answer import answer, ask, lacking, otherwise, turned
from cardan.questions.mobility.mobility import mobility
from cardan.texts import speaking

INCHES = Reader(units={"length": "in", "force": "lbf"}, decimal=",")
PUMP = example("overconstrained-pump")


HEAVY = example("truck-duty-cycle")
"""Only its centre bearing is described: its machines hold the ends."""

LOOSE = replace(HEAVY, supports=tuple(Support(shaft=k, position=p) for k, p in ((1, 0.0), (4, 0.0))))
"""Both ends stand on one bearing each, so that no machine counts as holding them."""


def texts(said):
    return [told(one.text, USUAL) for one in said.remarks]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("thing", "sentence", "tone"),
    [
        (PUMP, "mobility 1, 3 redundant constraints (overconstrained): part errors cause internal loads.", "warning"),
        (
            example("truck-supports"),
            "mobility 1, no redundant constraints: part errors cause no internal loads.",
            "good",
        ),
        (HEAVY, "mobility 1, no redundant constraints: part errors cause no internal loads.", "good"),
        (LOOSE, "mobility 9, underconstrained; no redundant constraints.", "warning"),
        (
            example_mechanism("maize-drive"),
            "mobility 1, 1 redundant constraint (overconstrained): part errors cause internal loads.",
            "warning",
        ),
    ],
    ids=["pump", "truck", "machines", "loose", "maize"],
)
def test_the_sentence_tells_mobility_and_redundant_constraints(thing, sentence, tone):
    said = answer(thing, mobility(thing))
    assert (told(said.sentence, USUAL), said.tone) == (sentence, tone)


@pytest.mark.slow
def test_the_methods_are_named_by_their_names():
    said = answer(PUMP, mobility(PUMP))
    rows = [[cell.text for cell in row] for row in printed(said.tables[-1], USUAL).rows]
    assert rows == [
        ["Grübler count", "−2", "–"],
        ["graph of the joints", "1", "3"],
        ["rank of the constraints", "1", "3"],
    ]
    assert [(one.name, one.value.value) for one in said.keys] == [("redundant_constraints", 3.0)]


@pytest.mark.slow
def test_remedies_name_the_keys_of_the_file():
    said = texts(answer(PUMP, mobility(PUMP)))
    (first,) = [text for text in said if text.startswith("Remedy: ")]
    assert first.startswith("Remedy: omit support 3 (pump, near); let the bearing of shaft 2, support 4 (pump, far),")
    assert first.endswith("(supports[2] omitted and supports[3].axial = false).")


@pytest.mark.slow
def test_no_remedy_is_told_that_was_not_tried():
    """A crank-slider whose rod is too short does not come round, whatever lets go."""
    slider = example_mechanism("crank-slider")
    short = replace(
        slider,
        joints=tuple(
            replace(one, point=(0.07, 0.01, 0.0)) if one.id in ("piston pin", "guide") else one for one in slider.joints
        ),
    )
    said = texts(answer(short, mobility(short)))
    assert any("No change that was tried" in one for one in said)
    assert not any("Remedy" in one or "add a" in one for one in said)


@pytest.mark.slow
def test_readers_are_told_in_their_units_and_language():
    found = mobility(PUMP)
    said = data(answer(PUMP, found), INCHES)
    assert said["misalignment_in"] == pytest.approx(found.misalignment / 0.0254)
    assert said["remedies"][0]["redundant_after"] == 0
    warning = next(one["text"] for one in said["remarks"] if "do not fit" in one["text"])
    assert "0,00175 in have to be forced into place" in warning
    with speaking("ru"):
        assert printed(answer(PUMP, found).tables[0], USUAL).columns[0].heading == "шарнир"


@pytest.mark.slow
def test_a_turn_that_locks_fails_and_says_by_how_much():
    thing = example_mechanism("maize-drive-offset")
    said = answer(thing, mobility(thing), turned(thing))
    assert said.tone == "failed"
    assert [one.name for one in said.figures()] == ["mechanism", "mobility-turn", "closure"]
    (failed,) = [text for text in texts(said) if text.startswith("Failed: ")]
    assert "at 180° its loops miss each other by 8.41 mm and 0.225°" in failed


@pytest.mark.slow
def test_a_turn_that_closes_has_constant_mobility():
    thing = example_mechanism("maize-drive-cured")
    said = answer(thing, mobility(thing), turned(thing))
    assert "It turns through 360° with constant mobility." in texts(said)
    assert data(said, USUAL)["turn"]["turns_through"] is True


def test_a_file_that_leaves_bearings_out_says_nothing():
    assert ask(LOOSE) is None
    assert "leaves bearings out" in otherwise(LOOSE)
    assert ask(PUMP).redundant == 3
    assert lacking(PUMP) == ()
    assert lacking(Drive.from_angles([0.3])) == (("supports",),)
    assert lacking(replace(PUMP, supports=())) == (("supports",),)


def test_a_mechanism_without_an_input_is_answered():
    free = replace(example_mechanism("three-joints-a"), input_link="", output_link="")
    assert answer(free, mobility(free)).sentence
