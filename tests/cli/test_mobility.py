"""cardan mobility: does it turn, which constraints are redundant, and what should be released?"""

import csv
import io
import json

import pytest

from cardan import io as files
from cardan.mechanisms import example_mechanism
from cardan.questions.mobility.mobility import mobility
from tests.cli.conftest import EXAMPLES
from tests.cli.test_forces import plain, widest

MECHANISMS = sorted((EXAMPLES / "mechanisms").glob("*.toml"))
PUMP = EXAMPLES / "overconstrained-pump.toml"


def one_line(text):
    return " ".join(plain(text).split())


@pytest.mark.slow
@pytest.mark.parametrize("path", MECHANISMS, ids=lambda path: path.stem)
def test_every_mechanism_is_answered_within_80_columns(cardan, path):
    done = cardan("mobility", path)
    assert (done.code, done.err) == (0, "")
    assert widest(done.out) <= 80
    found = mobility(example_mechanism(path.stem))
    assert found.mechanism.name in one_line(done.out)
    assert ("(overconstrained)" in one_line(done.out) or "locked" in one_line(done.out)) == bool(found.redundant)


@pytest.mark.slow
def test_the_pump_is_told_which_keys_to_change(cardan, drive_file):
    done = cardan("mobility", PUMP)
    assert widest(done.out) <= 80
    out = one_line(done.out)
    assert "mobility 1, 3 redundant constraints (overconstrained)" in out
    assert "(supports[2] omitted and supports[3].axial = false)" in out
    text = PUMP.read_text("utf-8")
    blocks = text.split("[[supports]]")
    last, _dot, rest = blocks[4].partition("\n\n")
    last = last.replace("axial = true", "axial = false")
    last = "\n".join(line for line in last.splitlines() if "axial_stiffness" not in line)
    cured = "[[supports]]".join([*blocks[:3], last + _dot + rest])
    done = cardan("mobility", drive_file(cured))
    assert done.code == 0, done.err
    assert "mobility 1, no redundant constraints" in one_line(done.out)


@pytest.mark.slow
def test_the_faulty_three_joint_drive_is_found_out_by_all_but_the_formula(cardan):
    said = cardan("mobility", EXAMPLES / "mechanisms" / "three-joints-e.toml", "--json").content
    assert (said["formula"], said["mobility"], said["redundant"], said["parasitic"]) == (1, 3, 2, 2)
    assert said["by_graph"]["overconstrained_links"] == ["cross 1", "shaft 3"]
    assert said["by_graph"]["redundant"] == 2
    assert said["checked_by_loops"]
    assert "output shaft" in said["adrift"]
    assert {one["joint"] for one in said["joints"] if one["strained_by"]} == {
        "input bearing",
        "cross 1, driving",
        "cross 1, driven",
        "bearing of shaft 3",
    }


@pytest.mark.slow
def test_a_turn_tells_whether_it_turns_through(cardan):
    path = EXAMPLES / "mechanisms" / "hooke-stiff-bearings.toml"
    assert "turns through 360° with constant mobility" in one_line(cardan("mobility", path, "--turn").out)
    said = cardan("mobility", path, "--turn", "--json").content["turn"]
    assert (said["turns_through"], said["redundant_everywhere"], said["special_deg"]) == (True, 3, [])


def test_what_is_not_held_is_told(cardan, drive_file):
    whole = (EXAMPLES / "truck-supports.toml").read_text("utf-8")
    first, last = (whole.index(f'[[supports]]\nname = "{name}"') for name in ("gearbox, inner", "gearbox, outer"))
    out = one_line(cardan("mobility", drive_file(whole[:first] + whole[last:])).out)
    assert out.startswith("▲")
    assert "mobility 4, underconstrained" in out
    assert "the input has 4 degrees of freedom instead of one" in out
    text = (EXAMPLES / "mechanisms" / "crank-slider.toml").read_text("utf-8").replace('input_link = "crank"\n', "")
    done = cardan("mobility", drive_file(text), "--turn", "--json")
    assert (done.code, done.complaint["problems"][0]["field"]) == (2, "--turn")


@pytest.mark.slow
def test_csv_has_every_joint(cardan):
    path = EXAMPLES / "mechanisms" / "crank-slider.toml"
    rows = list(csv.DictReader(io.StringIO(cardan("mobility", path, "--csv").out)))
    assert [row["joint"] for row in rows] == [one.id for one in example_mechanism("crank-slider").joints]


@pytest.mark.slow
def test_the_figure_is_drawn(cardan, tmp_path):
    done = cardan("mobility", EXAMPLES / "mechanisms" / "crank-slider.toml", "--plot", "graph.svg")
    assert done.code == 0
    assert (tmp_path / "graph.svg").read_text("utf-8").startswith("<?xml")


def test_a_drive_without_supports_says_what_it_misses(cardan):
    done = cardan("mobility", EXAMPLES / "single-20deg.toml", "--json")
    assert done.code == 2
    assert [one["field"] for one in done.complaint["problems"]] == ["supports"]


def test_a_mechanism_file_with_mistakes_names_them_all(cardan, drive_file):
    text = (EXAMPLES / "mechanisms" / "crank-slider.toml").read_text("utf-8")
    bad = text.replace('type = "P"', 'type = "Q"').replace("axis = [0, 0, 1]", "axis = [0, 0, 0]", 1)
    done = cardan("mobility", drive_file(bad), "--json")
    assert {one["field"] for one in done.complaint["problems"]} == {"joints[0].axis", "joints[3].type"}


def test_spinning_rods_are_told_from_motions_of_an_output_that_nobody_named(cardan, drive_file):
    text = """
format = 1
frame = "0"
input_link = "1"
output_link = "3"
"""
    for number, ends in enumerate((("0", "1"), ("1", "2"), ("2", "3"), ("3", "0"))):
        kind = "R" if "0" in ends else "S"
        axis = "axis = [0, 1, 0]" if "0" in ends else ""
        place = ([0, 0, 0], [10, 0, 200], [300, 20, 250], [310, 0, 0])[number]
        text += f"""
[[joints]]
id = "{number}"
type = "{kind}"
links = ["{ends[0]}", "{ends[1]}"]
point_mm = {place}
{axis}
"""
    named = cardan("mobility", drive_file(text))
    assert "1 motion leaves input and output at rest, as balls and rods do that spin" in one_line(named.out)
    bare = cardan("mobility", drive_file(text.replace('output_link = "3"', "")))
    assert "1 motion leaves the input at rest; name output_link" in one_line(bare.out)


def test_a_question_about_drives_tells_what_a_mechanism_answers(cardan):
    done = cardan("life", EXAMPLES / "mechanisms" / "crank-slider.toml")
    assert done.code == 2
    assert "of mechanisms cardan tells motion, forces, mobility" in one_line(done.err)


def test_the_schema_of_the_mechanism_file(cardan):
    assert json.loads(cardan("schema", "--mechanism").out) == files.mechanism_schema()
    assert json.loads(cardan("schema").out) == files.schema()


TWO = """# two joints
format = 1
[[joints]]
joint_angle_deg = 12  # the first
[[joints]]
kind = "half_cardan"
joint_angle_deg = 3
pairs = 3
[[shafts]]
number = 2
length_mm = 800
[[supports]]
shaft = 1
position_mm = -100
"""


@pytest.mark.slow
def test_a_layout_is_written_into_a_copy_of_the_file(cardan, drive_file, tmp_path):
    copy = tmp_path / "held.toml"
    told = cardan("mobility", drive_file(TWO), "--layouts", "-o", str(copy))
    assert told.code == 0
    assert "are statically determinate by their graph" in one_line(told.out)
    assert "# the first" in copy.read_text("utf-8")
    found = mobility(files.load(copy))
    assert (found.mobility, found.redundant, found.parasitic) == (1, 0, 0)
    other = tmp_path / "other.toml"
    cardan("mobility", drive_file(TWO), "--layouts", "--other-joints", "--apply", "2", "-o", str(other))
    assert mobility(files.load(other)).redundant == 0


@pytest.mark.slow
@pytest.mark.parametrize(
    ("options", "field"),
    [
        (["--apply", "1"], "--apply"),
        (["--layouts", "--apply", "1"], "--apply"),
        (["--layouts", "--apply", "99", "-o", "held.toml"], "--apply"),
        (["--other-joints"], "--other-joints"),
        (["--layouts", "--turn"], "--turn"),
    ],
)
def test_options_of_layouts_are_refused_where_they_mean_nothing(cardan, drive_file, options, field):
    told = cardan("mobility", drive_file(TWO), *options)
    assert told.code == 2
    assert field in told.err
