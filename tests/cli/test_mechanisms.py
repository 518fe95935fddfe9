"""A mechanism file is asked by the commands that drives are asked by: motion, forces, mobility, report."""

import csv
import io
import json

import pytest

from cardan.mechanisms import example_mechanism, mechanism_forces, mechanism_motion
from cardan.register import QUESTIONS
from tests.cli.conftest import EXAMPLES
from tests.cli.test_forces import plain, widest

FOLDER = EXAMPLES / "mechanisms"
SOME = ("crank-slider", "friction-cones", "maize-drive", "parallelogram", "slot-cam", "thompson")
UNHELD = ("hooke-book-repair", "three-joints-e")
LOADED = [name for name in SOME if name != "thompson"]


def one_line(text):
    return " ".join(plain(text).split())


@pytest.mark.slow
@pytest.mark.parametrize("name", SOME)
def test_motion_of_a_mechanism_is_told_within_80_columns(cardan, name):
    done = cardan("motion", FOLDER / f"{name}.toml", "--table")
    assert (done.code, done.err) == (0, "")
    assert widest(done.out) <= 80
    assert example_mechanism(name).output_link in one_line(done.out)


@pytest.mark.slow
@pytest.mark.parametrize("name", LOADED)
def test_forces_of_a_mechanism_are_told_within_80_columns(cardan, name):
    done = cardan("forces", FOLDER / f"{name}.toml")
    assert (done.code, done.err) == (0, "")
    assert widest(done.out) <= 80
    assert "balance of every link, close to" in one_line(done.out)


@pytest.mark.slow
def test_json_and_csv_hold_what_was_found(cardan):
    path = FOLDER / "crank-slider.toml"
    said = cardan("motion", path, "--json", "--speed-rpm", "60").content
    found = mechanism_motion(example_mechanism("crank-slider"))
    assert said["ways"] == {"crank": "turns", "rod": "plane", "piston": "slides"}
    assert said["speed_rpm"] == pytest.approx(60)
    assert len(said["motion"]["piston_path_mm"]) == 361
    assert said["motion"]["piston_path_mm"][90] == pytest.approx(1000 * found.output.path[90])
    rows = list(
        csv.DictReader(io.StringIO(cardan("forces", path, "--csv", "--angle-deg", "0", "--angle-deg", "90").out))
    )
    loads = mechanism_forces(example_mechanism("crank-slider"))
    assert [float(row["angle_deg"]) for row in rows] == [0, 90]
    assert float(rows[1]["crank_pin_force_x_N"]) == pytest.approx(loads.reaction[90, 1, 3], rel=1e-9)


@pytest.mark.slow
def test_torque_and_speed_of_the_command_line_stand_in_place_of_the_file(cardan):
    path = FOLDER / "friction-cones.toml"
    said = cardan("forces", path, "--torque-Nm", "10", "--speed-rpm", "30", "--json").content
    assert said["speed_rpm"] == pytest.approx(30)
    assert said["input"][0]["largest_Nm"] == pytest.approx(7.5)
    assert said["rolling"][0]["safety"] == pytest.approx(0.8)
    out = one_line(cardan("forces", path, "--torque-Nm", "10").out)
    assert "Failed: driven cone slips at contact from 0° on: it is to carry 125.0 N, and 100.0 N is what it can." in out


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("forces", "thompson.toml"), "output_torque_Nm or output_force_N or loads or masses: missing"),
        (
            ("forces", "crank-slider.toml", "--movement", "all"),
            "--movement: is of drives; a mechanism moves by its input",
        ),
        (("forces", "crank-slider.toml", "--torque-Nm", "-1"), "--torque-Nm: -1.0 is below zero"),
        (("motion", "maize-drive-offset.toml"), "input_link: 'shackle' cannot follow: with 'input shaft' turned by 4°"),
        (("motion", "three-joints-e.toml"), "'output shaft' is not held: with 'input shaft' at rest"),
        (("motion", "boom-cylinder.toml", "--speed-rpm", "3"), "--speed-rpm: is of an input that turns; 'rod' slides"),
        (("motion", "boom-cylinder.toml", "--angle-deg", "3"), "--angle-deg: is of an input that turns; 'rod' slides"),
        (("bending", "crank-slider.toml"), "of mechanisms cardan tells motion, forces, mobility and a report"),
    ],
)
def test_what_cannot_be_is_one_message(cardan, words, said):
    done = cardan(words[0], FOLDER / words[1], *words[2:])
    assert done.code == 2
    assert said in one_line(done.err)


@pytest.mark.slow
def test_an_input_that_slides_is_told_by_its_path_and_force(cardan, tmp_path):
    path = FOLDER / "boom-cylinder.toml"
    said = cardan("motion", path, "--json").content
    assert (said["speed_m_s"], said["input_range_mm"]) == (0.1, [0.0, 300.0])
    said = cardan("forces", path, "--json").content
    assert said["input"][0]["largest_N"] == pytest.approx(10167.458, rel=1e-6)
    said = cardan("mobility", path, "--turn", "--json").content["turn"]
    assert said["turns_through"]
    assert (said["path_mm"][0], said["path_mm"][-1]) == pytest.approx((0.0, 300.0))
    bare = tmp_path / "bare.toml"
    bare.write_text(path.read_text("utf-8").replace("input_stroke_mm = [0, 300]", ""), "utf-8")
    assert "input_stroke_mm: missing" in cardan("mobility", bare, "--turn").err
    assert "input_stroke_mm: missing" in cardan("motion", bare).err


def test_the_message_for_other_questions_names_what_a_mechanism_answers():
    assert [name for name, one in QUESTIONS.items() if one.mechanism] == ["motion", "forces", "mobility"]


@pytest.mark.slow
@pytest.mark.parametrize("suffix", ["html", "xlsx", "pdf"])
def test_report_of_a_mechanism(cardan, tmp_path, suffix):
    place = tmp_path / f"slider.{suffix}"
    done = cardan("report", FOLDER / "crank-slider.toml", "-o", place, "--full", "--author", "N. N.", "--json")
    assert (done.code, done.err) == (0, "")
    assert json.loads(done.out)["report"] == str(place)
    if suffix == "html":
        text = place.read_text("utf-8")
        for words in (
            "Mechanism report",
            "N. N.",
            "Forces",
            "Mobility",
            "crank pin",
            "Input file",
            "Piston slides over",
        ):
            assert words in text


@pytest.mark.slow
def test_a_report_tells_what_does_not_turn(cardan, tmp_path):
    place = tmp_path / "offset.html"
    assert cardan("report", FOLDER / "maize-drive-offset.toml", "-o", place).code == 0
    text = place.read_text("utf-8")
    assert "cannot follow" in text
    assert "redundant constraint" in text
