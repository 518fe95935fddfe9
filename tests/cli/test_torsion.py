"""cardan torsion: modes, response, simulate and stability, on the terminal, as JSON and as CSV."""

import csv
import io
import os
import re
import signal

import numpy as np
import pytest

from cardan import io as files
from cardan import stability, torsion_modes, torsion_response, transient
from cardan.cli.shared.progress import keeping
from cardan.questions.torsion.transient import torsion_transient
from cardan.units import rpm
from tests.cli.test_forces import plain, widest

RIG = """format = 1
name = "test rig"
[[joints]]
joint_angle_deg = 12
[[joints]]
joint_angle_deg = 12
[[shafts]]
number = 2
length_mm = 1200
outer_mm = 60
wall_mm = 3
loss_factor = 0.02
[[stations]]
shaft = 1
name = "flywheel"
inertia_kg_m2 = 1.2
[[stations]]
shaft = 3
name = "mill"
inertia_kg_m2 = 0.5
[duty]
speed_rpm = 1500
torque_Nm = 300
speed_range_rpm = [300, 2000]
engine = { cylinders = 3, mean_torque_Nm = 300 }
"""

COMMANDS = [
    ("modes",),
    ("response",),
    ("response", "--speeds", "500:2500:9"),
    ("simulate", "--span-s", "0.1"),
    ("stability",),
    ("stability", "--speeds", "500:2500:7"),
    ("stability", "--speeds", "2600:2900:6", "--joint-angles", "4:20:5"),
]


@pytest.fixture
def rig(drive_file):
    return drive_file(RIG)


@pytest.mark.slow
@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
def test_the_answer_stands_within_80_columns(cardan, rig, command):
    done = cardan("torsion", command[0], rig, *command[1:])
    assert (done.code, done.err) == (0, "")
    assert widest(done.out) <= 80
    assert "test rig" in done.out.splitlines()[0]


@pytest.mark.slow
@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
def test_a_figure_is_drawn_and_every_table_is_csv(cardan, rig, tmp_path, command):
    done = cardan("torsion", command[0], rig, *command[1:], "--plot", "it.svg", "--csv")
    assert done.code == 0
    assert (tmp_path / "it.svg").stat().st_size > 1000
    rows = list(csv.reader(io.StringIO(done.out)))
    assert len({len(row) for row in rows}) == 1
    assert len(set(rows[0])) == len(rows[0])


def test_modes_are_those_of_the_library(cardan, rig):
    said = cardan("torsion", "modes", rig, "--json").content
    found = torsion_modes(files.load(rig))
    assert [mode["frequency_Hz"] * 2 * np.pi for mode in said["modes"]] == pytest.approx(found.omega)
    assert said["modes"][0]["joint_weight"] == found.joint_weight[0].tolist()
    assert [one["speed_rpm"] for one in said["crossings"]] == pytest.approx(
        [one.speed / rpm for one in found.crossings]
    )
    assert said["input"] == "free"


@pytest.mark.slow
def test_modes_say_what_meets_in_use(cardan, rig, drive_file):
    out = plain(cardan("torsion", "modes", rig).out)
    assert out.startswith("▲ test rig: the first torsional natural frequency is 45.5 Hz; joints excite it at 1 364 rpm")
    assert "Campbell crossings in or near the operating range." in out
    assert "Joint 1 is nearest to the node of mode 1." in out
    high = drive_file(RIG.replace("[300, 2000]", "[2500, 3000]").replace("0.02", "0.001"))
    assert plain(cardan("torsion", "modes", high).out).startswith("✖ test rig:")
    calm = drive_file(RIG.replace("[300, 2000]", "[2050, 2200]").replace("= 1500", "= 2100"))
    assert plain(cardan("torsion", "modes", calm).out).startswith("● test rig:")


def test_response_is_that_of_the_library(cardan, rig):
    said = cardan("torsion", "response", rig, "--json").content
    found = torsion_response(files.load(rig))
    assert said["max_Nm"] == pytest.approx(found.torque_highest.tolist())
    assert said["verdict"] == ["stable"]
    table = list(csv.DictReader(io.StringIO(cardan("torsion", "response", rig, "--speeds", "500:900:3", "--csv").out)))
    assert [float(row["speed_rpm"]) for row in table] == pytest.approx([500, 700, 900])
    swept = torsion_response(files.load(rig), speed=np.asarray([500, 700, 900]) * rpm)
    assert [float(row["element_1_max_Nm"]) for row in table] == pytest.approx(swept.torque_highest[:, 0].tolist())


def test_speed_and_torque_of_the_command_line_count(cardan, rig):
    said = cardan("torsion", "response", rig, "--speed-rpm", 900, "--torque-Nm", 100, "--json").content
    assert said["speed_rpm"] == pytest.approx(900)
    assert said["mean_Nm"] == pytest.approx([100], rel=0.02)


def test_unstable_running_fails(cardan, drive_file):
    path = drive_file(RIG.replace("0.02", "0.002").replace("speed_rpm = 1500", "speed_rpm = 2728"))
    for command in ("response", "stability"):
        done = cardan("torsion", command, path)
        assert done.code == 1
        assert done.out.startswith("✖")
        assert "principal zone of mode 1" in plain(done.out)
    assert cardan("torsion", "stability", path, "--json").content["verdict"] == "unstable"


def test_stability_maps_what_the_library_maps(cardan, rig):
    said = cardan(
        "torsion", "stability", rig, "--speeds", "2600:2900:6", "--over", "shafts[1].loss_factor=0.001:0.03:4", "--json"
    ).content
    over = {"duty.speed_rpm": np.linspace(2600, 2900, 6), "shafts[1].loss_factor": np.linspace(0.001, 0.03, 4)}
    found = stability(files.load(rig), over=over)
    assert said["stable"] == found.stable.tolist()
    assert said["over"]["shafts[1].loss_factor"] == over["shafts[1].loss_factor"].tolist()
    assert not all(said["stable"][2])  # 2720 rpm
    out = cardan("torsion", "stability", rig, "--speeds", "2600:2900:6", "--joint-angles", "4:40:5").out
    assert "#" in out.split("\n\n")[1]


@pytest.mark.slow
def test_simulation_is_that_of_the_library(cardan, rig):
    said = cardan("torsion", "simulate", rig, "--span-s", "0.1", "--json").content
    found = transient(files.load(rig), span=0.1)
    assert said["elements"][0]["max_Nm"] == pytest.approx(float(found.motion.extremes.torque_high[0]))
    assert said["curves"]["time_s"][-1] == 0.1
    settled = cardan("torsion", "simulate", rig, "--span-s", "0.1", "--settled", "--json").content
    assert settled["elements"][0]["max_Nm"] < said["elements"][0]["max_Nm"]


@pytest.mark.parametrize("command", ["response", "simulate"])
def test_a_drive_without_speed_is_not_taken_for_one_that_stands(cardan, tmp_path, command):
    path = tmp_path / "still.toml"
    path.write_text(
        re.sub(r"(?m)^speed_rpm.*\n", "", files.example_text("unstable-drive").replace('input = "free"', ""))
    )
    said = cardan("torsion", command, path)
    assert said.code == 2
    assert "duty.speed_rpm: missing" in said.err
    assert "--speed-rpm" in said.err


WAYS = {
    "blocks": "blocks = [{ torque_Nm = 50, speed_rpm = 700, share_percent = 70 }, "
    "{ torque_Nm = 90, speed_rpm = 900, share_percent = 30 }]",
    "cases": 'speed_rpm = 900\ncases = [{ name = "peak", torque_Nm = 90 }, { name = "road", torque_Nm = 50 }]',
    "history": 'speed_rpm = 900\ntorque_history = "torque.csv"',
}


@pytest.mark.slow
@pytest.mark.parametrize(("way", "named"), list(zip(WAYS, ("part 2 of the", "peak", "the peak of the"), strict=True)))
def test_response_is_of_the_heaviest_load_case_where_the_duty_has_no_torque(cardan, tmp_path, way, named):
    """As strength counts it, and not about no mean torque; at another speed where one is asked for."""
    path = tmp_path / "loaded.toml"
    text = files.example_text("unstable-drive")
    path.write_text(text[: text.index("[duty]")] + f"[duty]\n{WAYS[way]}\n")
    (tmp_path / "torque.csv").write_text("time_s,torque_Nm\n0,50\n1,90\n2,60\n")
    path.with_name("alone.toml").write_text(text[: text.index("[duty]")] + "[duty]\nspeed_rpm = 900\ntorque_Nm = 90\n")
    said = cardan("torsion", "response", path, "--json").content
    alone = cardan("torsion", "response", "alone.toml", "--json").content
    assert said["max_Nm"] == alone["max_Nm"]
    assert said["speed_rpm"] == pytest.approx(900.0)
    for command in ("response", "stability") if way == "history" else ("response",):  # many maps take long
        out = " ".join(cardan("torsion", command, path).out.split())
        assert f"figures are of this condition: {named}" in out
        assert ("In each condition" in out) == (way != "history")
    out = " ".join(cardan("torsion", "response", path, "--speed-rpm", "800").out.split())
    assert out.count("at 800.0 rpm the alternating torque") == (1 if way == "history" else 3)
    assert "no mean torque" not in out.lower()


def test_load_cases_are_told_over_the_speeds_asked_for(cardan, tmp_path):
    path = tmp_path / "loaded.toml"
    text = files.example_text("unstable-drive")
    path.write_text(
        text[: text.index("[duty]")] + f"[duty]\n{WAYS['blocks']}\n".replace("70 }", "70, joint_angle_deg = 5 }")
    )
    said = cardan("torsion", "response", path, "--speeds", "800:900:3", "--json").content
    assert said["speed_rpm"] == pytest.approx([800.0, 850.0, 900.0])
    assert [row["condition"] for row in said["conditions"]] == [f"part {k} of the duty cycle" for k in (1, 2)]


@pytest.mark.parametrize(
    ("options", "field"),
    [
        (("response", "--speeds", "500"), "--speeds"),
        (("response", "--speeds", "900:500"), "--speeds"),
        (("response", "--speeds", "0:500"), "--speeds"),
        (("response", "--speeds", "a:b"), "--speeds"),
        (("response", "--speeds", "1:2:1000000000"), "--speeds"),
        (("stability", "--speeds", "1:2:40000", "--joint-angles", "1:2:40000"), "over"),
        (("stability", "--joint-angles", "1:120"), "joint_angle_deg"),
        (("stability", "--over", "shafts[1].outer_mm"), "--over"),
        (("stability", "--over", "shafts[1].oute_mm=1:2"), "shafts[1].oute_mm"),
        (("simulate", "--span-s", "-1"), "--span-s"),
        (("simulate", "--span-s", "1e9"), "--span-s"),
        (("modes", "--speed-rpm", "nan"), "--speed-rpm"),
    ],
)
def test_bad_options_are_named(cardan, rig, options, field):
    done = cardan("torsion", options[0], rig, *options[1:], "--json")
    assert (done.code, done.out) == (2, "")
    assert field in [problem["field"] for problem in done.complaint["problems"]]


def test_a_map_of_a_thousand_million_points_is_refused_with_its_time(cardan, rig):
    done = cardan("torsion", "stability", rig, "--speeds", "500:3000:31623", "--joint-angles", "1:20:31623")
    assert done.code == 2
    assert "would take about" in done.err


def test_what_the_file_lacks_is_told_by_its_keys(cardan, drive_file):
    path = drive_file("format = 1\n[[joints]]\njoint_angle_deg = 10\n[[stations]]\nshaft = 1\ninertia_kg_m2 = 1\n")
    done = cardan("torsion", "modes", path)
    assert done.code == 2
    assert "shafts[0].stiffness_Nm_per_rad: missing" in done.err
    done = cardan("torsion", "response", path)
    assert "duty.speed_rpm: missing" in done.err
    assert "--speed-rpm" in done.err


def test_help_lists_the_questions(cardan):
    for arguments in (("torsion",), ("torsion", "--help")):
        done = cardan(*arguments)
        assert (done.code, done.err) == (0, "")
        assert all(name in done.out for name in ("modes", "response", "simulate", "stability"))
    for name in ("modes", "response", "simulate", "stability"):
        done = cardan("torsion", name, "--help")
        assert f"$ cardan torsion {name}" in done.out
        assert max(map(len, done.out.splitlines())) <= 80


@pytest.mark.slow
def test_ctrl_c_keeps_what_is_done(cardan, rig, monkeypatch):
    """The signal comes while the motion is followed; what was found by then is told, and the code says so."""

    def interrupted(*arguments, **options):
        os.kill(os.getpid(), signal.SIGINT)
        return simulate(*arguments, **options)

    simulate = torsion_transient.simulate
    monkeypatch.setattr(torsion_transient, "simulate", interrupted)
    before = signal.getsignal(signal.SIGINT)
    done = cardan("torsion", "simulate", rig, "--span-s", "100", "--json")
    assert done.code == 130
    assert not done.content["complete"]
    assert signal.getsignal(signal.SIGINT) is before


def test_a_second_ctrl_c_ends_it_at_once():
    def twice():
        with keeping("waiting") as tell:
            os.kill(os.getpid(), signal.SIGINT)
            assert tell(0.5) == "stop"
            os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(KeyboardInterrupt):
        twice()


@pytest.mark.slow
def test_a_drive_that_finds_no_steady_motion_says_so(cardan, drive_file, tmp_path, recwarn):
    steep = drive_file(
        'format = 1\nname = "steep"\njoints = [{ joint_angle_deg = 89 }]\nshafts = [\n'
        "  { number = 1, stiffness_Nm_per_rad = 6000, damping_Nms_per_rad = 0.5 },\n"
        "  { number = 2, stiffness_Nm_per_rad = 60000, damping_Nms_per_rad = 0.5 },\n]\nstations = [\n"
        "  { shaft = 1, inertia_kg_m2 = 0.9 },\n  { shaft = 2, inertia_kg_m2 = 0.4 },\n]\n"
        'duty = { speed_rpm = 1340, torque_Nm = 60, input = "free" }\n'
    )
    for command in ("stability", "response"):
        done = cardan("torsion", command, steep, "--plot", f"{command}.svg")
        assert (done.code, done.err) == (1, "")
        assert done.out.startswith("✖ steep: no steady motion was found")
    assert not (tmp_path / "response.svg").exists()
    assert "Figure drawn" not in done.out
    mapped = cardan("torsion", "stability", steep, "--speeds", "1000:2000:3")
    assert mapped.out.startswith("✖ steep: no steady motion was found")
    assert not [one for one in recwarn if one.category is RuntimeWarning]


@pytest.mark.slow
def test_a_map_marks_the_drive_and_names_its_zones(cardan, drive_file):
    path = drive_file(RIG.replace("0.02", "0.002").replace("speed_rpm = 1500", "speed_rpm = 2728"))
    done = cardan("torsion", "stability", path, "--speeds", "2600:2900:13", "--joint-angles", "6:20:8")
    first = plain(done.out)
    assert "of the map is unstable: principal zone of mode 1." in first
    marked = [line for line in done.out.splitlines() if line.endswith(("·", "#")) and "O" in line]
    assert len(marked) == 1
    assert marked[0].split()[0] == "12.00"


def test_large_counts_are_grouped_by_thin_blanks(cardan, rig):
    err = cardan("torsion", "stability", rig, "--speeds", "100:200:1000000000").err
    assert "1\u202f000\u202f000\u202f000 values" in err


def test_a_mean_of_nothing_but_rounding_is_zero(cardan, rig):
    rows = cardan("torsion", "response", rig, "--torque-Nm", 0).out
    assert "e-1" not in rows.partition("station")[0]
