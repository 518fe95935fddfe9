"""report, init, example, convert, schema, calc: what they write and print."""

import html
import json
import tomllib

import jsonschema
import numpy as np
import pytest

from cardan import io as files
from cardan.calc import CALCULATIONS, calc
from cardan.questions.motion.equivalence import equivalent_joint
from cardan.report.render import renderer
from tests.cli.conftest import EXAMPLES

TRUCK = EXAMPLES / "truck-printed-angles.toml"


def test_a_report_is_one_file_named_after_the_drive_file(cardan, tmp_path):
    done = cardan("report", TRUCK, "--full")
    assert done.code == 0
    text = (tmp_path / "truck-printed-angles.html").read_text()
    assert "truck power unit" in text
    assert html.escape("joint_angle_arcmin = 920").strip() in text
    assert [path.name for path in tmp_path.iterdir()] == ["truck-printed-angles.html"]


def test_a_report_goes_where_it_is_told(cardan, tmp_path):
    (tmp_path / "out").mkdir()
    done = cardan("report", TRUCK, "-o", "out/truck.html", "--speed-rpm", 1234, "--json")
    assert done.content["report"] == "out/truck.html"
    assert "1\u202f234" in (tmp_path / "out/truck.html").read_text()


@pytest.mark.slow
def test_a_report_for_paper_is_written_or_says_what_it_needs(cardan, tmp_path, monkeypatch):
    done = cardan("report", EXAMPLES / "single-20deg.toml", "-o", "one.pdf")
    assert done.code == 0
    assert "Open one.pdf, or print it." in done.out
    assert (tmp_path / "one.pdf").read_bytes().startswith(b"%PDF")
    monkeypatch.setattr(renderer, "find_spec", lambda name: None)
    refused = cardan("report", TRUCK, "-o", "two.pdf")
    assert refused.code == 2
    assert refused.err.strip() == "error: two.pdf needs typst: pip install 'cardan[pdf]'"
    assert not (tmp_path / "two.pdf").exists()


def test_a_first_file_loads_and_can_be_asked(cardan, tmp_path):
    assert cardan("init", "my.toml").code == 0
    assert (tmp_path / "my.toml").read_text() == files.starter()
    assert cardan("motion", "my.toml").code == 0
    assert cardan("init", "-").out == files.starter()


def test_a_file_is_overwritten_only_when_told(cardan, tmp_path):
    (tmp_path / "my.toml").write_text("mine")
    done = cardan("init", "my.toml")
    assert done.code == 2
    assert "--force" in done.err
    assert (tmp_path / "my.toml").read_text() == "mine"
    assert cardan("init", "my.toml", "--force").code == 0
    for command in (("example", "single-20deg", "my.toml"), ("convert", TRUCK, "my.toml")):
        assert cardan(*command).code == 2
        assert cardan(*command, "--force").code == 0


def test_examples_are_listed_and_copied(cardan, tmp_path):
    listed = cardan("example", "--json").content["examples"]
    names = [*files.example_names(), *files.mechanism_names(), *files.recording_names()]
    assert [row["name"] for row in listed] == names
    assert all(row["shows"] for row in listed)
    out = cardan("example").out
    assert all(name in out for name in names)
    assert max(map(len, out.splitlines())) <= 80
    assert cardan("example", "single-20deg").code == 0
    assert (tmp_path / "single-20deg.toml").read_text() == files.example_text("single-20deg")
    assert cardan("example", "single-20deg", "-").out == files.example_text("single-20deg")
    assert "cardan mobility maize-drive.toml" in cardan("example", "maize-drive").out
    assert "cardan diagnose truck-crack.csv truck-supports.toml" in cardan("example", "truck-crack").out
    assert (tmp_path / "truck-crack.csv").read_text() == files.example_text("truck-crack")


def test_an_unknown_example_names_the_nearest(cardan):
    done = cardan("example", "single-20")
    assert done.code == 2
    assert "single-20deg" in done.err


@pytest.mark.parametrize("form", ["points", "angles", "slopes"])
@pytest.mark.parametrize("suffix", [".toml", ".json"])
def test_a_drive_moves_alike_in_every_form(cardan, tmp_path, form, suffix):
    source = EXAMPLES / "truck-printed-coordinates.toml"
    assert cardan("convert", source, f"out{suffix}", "--form", form).code == 0
    moved = files.load(tmp_path / f"out{suffix}")
    assert moved.form == form
    before, after = (float(equivalent_joint(drive).speed_fluctuation) for drive in (files.load(source), moved))
    assert after == pytest.approx(before, rel=1e-12)


def test_what_is_converted_and_back_means_the_same(cardan, tmp_path):
    assert cardan("convert", TRUCK, "a.json").code == 0
    assert cardan("convert", "a.json", "b.toml").code == 0
    assert files.load(tmp_path / "b.toml") == files.load(TRUCK)
    assert files.loads(cardan("convert", "a.json", "-").out) == files.load(TRUCK)


@pytest.mark.slow
def test_the_schema_accepts_the_examples(cardan, tmp_path):
    schema = json.loads(cardan("schema").out)
    validator = jsonschema.Draft202012Validator(schema)
    for path in EXAMPLES.glob("*.toml"):
        validator.validate(tomllib.loads(path.read_text()))
    assert cardan("schema", "-o", "schema.json").code == 0
    assert json.loads((tmp_path / "schema.json").read_text()) == schema


@pytest.mark.slow
def test_every_formula_is_listed(cardan):
    out = cardan("calc", "--list").out
    assert all(name in out for name in CALCULATIONS)
    assert [row["capability"] for row in cardan("calc", "--list", "--json").content["capabilities"]] == list(
        CALCULATIONS
    )
    for name in CALCULATIONS:
        done = cardan("calc", "--list", name)
        assert done.code == 0
        assert max(map(len, done.out.splitlines())) <= 80


def test_a_formula_answers_as_in_python(cardan):
    inputs = {"alpha_deg": [11.5, 15.0], "beta_deg": [2.0], "gamma_deg": [0.0], "psi1_deg": 10.0}
    said = cardan("calc", "equivalent_joint", *(f"{key}={value}" for key, value in inputs.items()), "--json").content
    assert said["result"] == calc("equivalent_joint", inputs)


def test_inputs_come_from_a_file_and_the_command_line_wins(cardan, drive_file):
    path = drive_file('{"alpha_deg": 45, "psi1_deg": 0, "phi1_deg": 0}', "in.json")
    said = cardan("calc", "single_joint", "alpha_deg=20", "--input", path, "--json").content["result"]
    assert said["ratio_21"] == pytest.approx(1 / np.cos(np.deg2rad(20)), rel=1e-14)


def test_a_formula_as_csv_is_flat(cardan):
    out = cardan("calc", "fourier_single", "alpha_deg=20", "kmax=3", "--csv").out.splitlines()
    assert out[0] == "key,value"
    assert out[1].startswith("c_exact[0],0.0310912")


def test_long_lists_are_summed_up(cardan):
    done = cardan("calc", "single_joint", "alpha_deg=20", f"phi1_deg={list(range(0, 360, 10))}")
    assert sum(line.lstrip()[:3].strip().isdigit() for line in done.out.splitlines()) >= 36  # a row a value
    assert max(map(len, done.out.splitlines())) <= 80
