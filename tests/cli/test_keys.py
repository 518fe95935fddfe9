"""``cardan keys`` and ``cardan help``: every key with its meaning, and what words of the trade lead to."""

import re
from pathlib import Path

import pytest

from cardan.cli.shared.words import SYNONYMS, finds
from cardan.drive.drive import Drive
from cardan.io import schema
from cardan.io.keys import file_keys, written_in_examples
from cardan.reading.fields import spellings_of

GLOSSARY = Path(__file__).parents[2] / "docs" / "glossary.md"


def properties(tree, root):
    """Yield every key of a JSON Schema once, through references and variants."""
    seen = set()

    def walk(node):
        if "$ref" in node:
            name = node["$ref"].rpartition("/")[2]
            if name not in seen:
                seen.add(name)
                yield from walk(root["$defs"][name])
            return
        for key, inner in node.get("properties", {}).items():
            yield key
            yield from walk(inner)
        for inner in (*node.get("oneOf", ()), *node.get("anyOf", ()), *filter(None, (node.get("items"),))):
            yield from walk(inner)

    yield from walk(tree)


def test_every_key_that_cardan_writes_by_the_schema_is_told():
    whole = schema()
    known = set(properties(whole, whole))
    told = {key.name for key in file_keys()}
    assert told <= known
    assert set(spellings_of(Drive)) & known <= known
    plain = {key for key in known if key not in {"format", "kind", "set"} and "_" not in key}
    assert plain - told - {one for key in file_keys() for one in (key.name.rpartition("_")[0],)} == set()


@pytest.mark.parametrize("path", ["joints.cross.span_mm", "joints[1].cross.span_in", "joints.cross.span"])
def test_a_key_is_told_under_any_way_of_writing_its_path(cardan, path):
    done = cardan("keys", path, "--json")
    (key,) = done.content["keys"]
    assert (key["key"], key["value"]) == ("joints[].cross.span_mm", "number, more than 0 mm")
    assert key["units"][0] == "mm"


def test_a_key_that_is_not_there_is_met_by_the_nearest(cardan):
    done = cardan("keys", "shafts.outter_mm")
    assert done.code == 2
    assert "outer_mm" in done.err


def test_examples_of_a_key_are_lines_of_shipped_files_in_its_own_table():
    line = written_in_examples(file_keys("duty.speed")[0])
    assert line.startswith("speed_rpm = ")
    assert written_in_examples(file_keys("joints.cross.span")[0]).startswith("span_mm = ")


@pytest.mark.parametrize(
    ("word", "command"),
    [
        ("stress", "strength"),
        ("critical", "bending"),
        ("U-joint", ""),
        ("operating angle", ""),
        ("campbell", "torsion modes"),
        ("phase", "phasing"),
        ("efficiency", "losses"),
        ("unbalance", "balance"),
        ("overconstrained", "mobility"),
    ],
)
def test_words_of_the_trade_lead_to_what_answers_them(cardan, word, command):
    done = cardan("help", word, "--json")
    names = [one["name"] for one in done.content["finds"] if one["sort"] == "command"]
    assert done.content["finds"]
    assert not command or command in names


@pytest.mark.slow
def test_every_synonym_finds_something():
    assert [same for row in SYNONYMS for same in row if not finds(same)] == []


def test_an_unknown_command_is_met_by_its_meaning(cardan):
    assert "Did you mean strength?" in cardan("stress", "truck.toml").err
    assert "bending" in cardan("whirl").err
    assert "Did you mean" not in cardan("brkt").err


@pytest.mark.slow
def test_every_term_of_the_glossary_leads_somewhere():
    rows = [line.split("|")[1] for line in GLOSSARY.read_text("utf-8").splitlines() if line.startswith("| ")]
    terms = [one.strip() for row in rows for one in re.split("[,;]", re.sub(r"[*`]|\(.*?\)|\$.*?\$", "", row))]
    assert len(terms) > 100
    assert [one for one in terms if one not in ("", "term") and not finds(one)] == []


@pytest.mark.parametrize(
    ("word", "sort", "name"),
    [
        ("telescope", "key", "shafts[].spline"),
        ("wide-angle joint", "kind", "double_cardan"),
        ("sprayer", "example", "pto-drive"),
        ("profile tube", "key", "shafts[].profile"),
        ("torque", "command", "forces"),
        ("errors tolerances", "command", "accuracy"),  # two words that never stand side by side
    ],
)
def test_words_of_the_trade_lead_where_they_should(word, sort, name):
    assert name in [one.name for one in finds(word) if one.sort == sort]


def test_a_key_is_found_in_the_unit_that_people_write(cardan):
    (key,) = cardan("keys", "duty.life_h", "--json").content["keys"]
    assert (key["key"], key["value"]) == ("duty.life_h", "number, more than 0 h")
