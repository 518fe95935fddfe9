"""``cardan sweep``: a plan is worked on, told, kept, gone on with, refused."""

import csv
import io
import json

import pytest

from tests.cli.conftest import EXAMPLES

PLAN = EXAMPLES / "sweeps" / "truck-suspension.toml"

SMALL = """
format = 1
drive = "DRIVE"
ask = ["speed_fluctuation", "alpha_eq"]
[[vary]]
key = "joints[0].joint_angle_deg"
values = [10, 20, 95]
"""


@pytest.fixture
def small(tmp_path):
    path = tmp_path / "small.toml"
    path.write_text(SMALL.replace("DRIVE", (EXAMPLES / "single-20deg.toml").as_posix()), "utf8")
    return path


def test_a_plan_tells_what_was_asked_of_all_points(cardan):
    done = cardan("sweep", PLAN)
    assert done.code == 0
    assert done.out.startswith("suspension travel of a truck: all 1\u202f056 points are answered.")
    assert "argmax speed_fluctuation_percent" in done.out
    assert "--into truck-suspension" in done.out


def test_without_reductions_the_first_rows_are_shown(cardan, small):
    done = cardan("sweep", small)
    assert done.code == 0
    assert "of 3 points 2 are answered" in done.out
    assert "1 point makes no drive, row 2: joints[0].joint_angle_deg" in " ".join(done.out.split())
    assert "16.119" not in done.out
    assert "20.000" in done.out


def test_json_holds_the_table_and_what_it_comes_from(cardan, small):
    content = cardan("sweep", small, "--json").content
    assert content["status"] == "done"
    assert content["table"]["status"] == [0, 0, 1]
    assert content["table"]["alpha_eq_deg"][:2] == pytest.approx([10.0, 20.0])
    assert content["reductions"]["points"]["no_drive"] == 1
    assert content["provenance"]["drive"]["joints"][0]["joint_angle_deg"] == 20


def test_a_grid_over_one_key_is_drawn_and_what_is_none_is_refused_before_any_work(cardan, small, tmp_path, monkeypatch):
    picture = tmp_path / "curve.svg"
    assert str(picture) in cardan("sweep", small, "--plot", picture).out
    assert "speed fluctuation of the output" in picture.read_text("utf-8")
    rows = small.with_name("rows.toml")
    given = '[[vary]]\nname = "two"\nrows = [{ "duty.speed_rpm" = 1, "shafts[0].mass_kg" = 2 }]\n'
    rows.write_text(small.read_text(encoding="utf-8") + given, encoding="utf-8")
    monkeypatch.setattr("cardan.cli.sweep.sweep.run", None)
    assert "grids over one or two fields" in cardan("sweep", rows, "--plot", picture).err


def test_rows_that_are_not_kept_are_refused_before_any_work(cardan, small, monkeypatch):
    plan = small.with_name("none.toml")
    plan.write_text('rows = "none"\n' + small.read_text(encoding="utf-8"), encoding="utf-8")
    monkeypatch.setattr("cardan.cli.sweep.sweep.run", None)
    assert "--csv: the plan keeps no rows" in cardan("sweep", plan, "--csv").err


def test_csv_holds_every_row(cardan, small):
    rows = list(csv.DictReader(io.StringIO(cardan("sweep", small, "--csv").out)))
    assert [float(row["joints[0].joint_angle_deg"]) for row in rows] == [10, 20, 95]
    assert rows[2]["status"] == "1"


def test_a_folder_keeps_the_table_and_is_gone_on_with(cardan, small, tmp_path):
    pytest.importorskip("pyarrow")
    folder = tmp_path / "kept"
    first = cardan("sweep", small, "--into", folder, "--json").content
    assert first["folder"] == str(folder)
    assert "table" not in first
    again = cardan("sweep", small, "--into", folder, "--resume", "--engine", "in-process")
    assert again.code == 0
    assert "cardan sweep show kept" in again.out  # as it is written from here


def test_resuming_needs_a_folder_with_a_sweep(cardan, small, tmp_path):
    assert cardan("sweep", small, "--resume", "--json").complaint["problems"][0]["field"] == "--resume"
    done = cardan("sweep", small, "--resume", "--into", tmp_path, "--json")
    assert done.code == 2
    assert "holds no sweep" in done.complaint["problems"][0]["message"]


def test_options_that_are_none_are_refused_together(cardan, small):
    done = cardan("sweep", small, "--engine", "abacus", "--device", "tpu", "--scheduler", "tcp://a", "--json")
    assert done.code == 2
    assert [one["field"] for one in done.complaint["problems"]] == ["--engine", "--device", "--scheduler"]


def test_everything_wrong_with_a_plan_is_told_with_its_file(cardan, small):
    small.write_text(small.read_text("utf8").replace("alpha_eq", "alpha_ex").replace("values", "valeus"), "utf8")
    done = cardan("sweep", small, "--json")
    assert done.code == 2
    assert done.complaint["file"] == str(small)
    assert {one["field"] for one in done.complaint["problems"]} >= {"vary[0].valeus", "vary[0].from"}


def test_a_plan_that_is_no_file_is_refused(cardan):
    done = cardan("sweep", "nothing.toml")
    assert done.code == 2
    assert "nothing.toml" in done.err


def test_interrupted_it_keeps_what_is_done_and_says_how_to_go_on(cardan, small, tmp_path, monkeypatch):
    pytest.importorskip("pyarrow")
    from cardan.cli.sweep import sweep

    folder = tmp_path / "kept"
    text = small.read_text("utf8") + '[[vary]]\nkey = "input.start_phase_deg"\nfrom = 0\nto = 90\ncount = 40\n'
    small.write_text(text + "[engine]\nchunk_rows = 10\n", "utf8")
    real = sweep.keeping

    class Stopping:
        stopped = False

        def __call__(self, share):
            self.stopped = self.stopped or share > 0.0
            return "stop" if self.stopped else None

    from contextlib import contextmanager

    @contextmanager
    def stopped(_what, *, count=0):
        assert count == 120
        yield Stopping()

    monkeypatch.setattr("cardan.batch.engine.running.OFTEN", 0.0)
    monkeypatch.setattr(sweep, "keeping", stopped)
    done = cardan("sweep", small, "--into", folder)
    assert done.code == 130
    assert "Missing: rows" in done.out
    assert "--into kept --resume" in " ".join(done.out.split())  # as it is written from here
    monkeypatch.setattr(sweep, "keeping", real)
    whole = cardan("sweep", small, "--into", folder, "--resume", "--json").content
    assert (whole["status"], whole["missing"]) == ("done", [])
    assert json.loads(json.dumps(whole["reductions"]["points"]))["answered"] == 80


MOVING = """
format = 1
drive = "DRIVE"
ask = ["speed_fluctuation", "movement", "check"]
[[vary]]
key = "joints[1].centre_mm[2]"
values = [0, -20]
"""


@pytest.mark.slow
def test_columns_that_leave_a_movement_out_say_so(cardan, tmp_path):
    """Of a hitch the motion is as drawn; the column of the movement and the checks count it."""
    path = tmp_path / "hitch.toml"
    path.write_text(MOVING.replace("DRIVE", (EXAMPLES / "pto-hitch.toml").as_posix()), "utf8")
    said = cardan("sweep", path, "--json").content
    (remark,) = [one["text"] for one in said["remarks"] if one.get("code") == "as_drawn"]
    assert remark == "speed_fluctuation_percent: of the drive as drawn at its duty; movements do not count there."
    assert said["table"]["moving_speed_fluctuation_percent"][0] == pytest.approx(0.6841006, rel=1e-6)
    assert said["table"]["speed_fluctuation_percent"][0] < 1e-10
