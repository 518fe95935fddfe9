"""Every mistake of a user: exit code 2, all problems in one message on stderr, nothing on stdout, nothing written."""

import errno
import os

import pytest

from cardan.cli.main import main
from tests.cli.conftest import EXAMPLES

TRUCK = EXAMPLES / "truck-printed-angles.toml"
JOINT = "[[joints]]\n"
POINTS = "input.point_mm = [-100, 0, 0]\noutput.point_mm = [300, 0, 40]\n"

FILES = {
    "empty": ("", ["format"]),
    "not TOML": ("format = \n", ["is not TOML", "line 1"]),
    "other format": ("format = 7\n[[joints]]\njoint_angle_deg = 5\n", ["format", "7"]),
    "unknown key": (
        "format = 1\n[[joints]]\njoint_angle_degg = 5\n",
        ["joints[0].joint_angle_degg", "joint_angle_deg"],
    ),
    "key to be obeyed": (
        'format = 1\n"\\u001b[31mred" = 1\n[[joints]]\njoint_angle_deg = 5\n',
        ["\\x1b[31mred: unknown key"],
    ),
    "name to be obeyed": (
        'format = 1\nname = "\\u001b[2J"\n[[joints]]\njoint_angle_deg = 5\n',
        ["name: holds", "\\x1b"],
    ),
    "missing unit": ("format = 1\n[[joints]]\njoint_angle = 5\n", ["joints[0].joint_angle", "joint_angle_deg"]),
    "wrong dimension": ("format = 1\n[[joints]]\njoint_angle_mm = 5\n", ["joints[0].joint_angle_mm"]),
    "not a number": ("format = 1\n[[joints]]\njoint_angle_deg = nan\n", ["joints[0].joint_angle", "nan"]),
    "infinite": ("format = 1\n[[joints]]\njoint_angle_deg = inf\n", ["joints[0].joint_angle", "inf"]),
    "a word": ('format = 1\n[[joints]]\njoint_angle_deg = "steep"\n', ["joints[0].joint_angle_deg", "steep"]),
    "joint angle of 90": ("format = 1\n[[joints]]\njoint_angle_deg = 90\n", ["joints[0].joint_angle", "90°"]),
    "negative bend": ("format = 1\n[[joints]]\njoint_angle_deg = -1\n", ["joints[0].joint_angle", "-1", "at least 0°"]),
    "no joint": ("format = 1\n", ["joints"]),
    "one shaft only": (
        "format = 1\ninput.point_mm = [0, 0, 0]\noutput.point_mm = [9, 0, 0]\njoints = []\n",
        ["joints", "at least one joint"],
    ),
    "coincident points": (
        f"format = 1\n{POINTS}{JOINT}centre_mm = [0, 0, 0]\n{JOINT}centre_mm = [0, 0, 0]\n",
        ["joints[1].centre"],
    ),
    "shafts at a right angle": (f"format = 1\n{POINTS}{JOINT}centre_mm = [0, 0, 999]\n", ["shafts 1 and 2", "90°"]),
    "missing end point": (
        f"format = 1\ninput.point_mm = [-9, 0, 0]\n{JOINT}centre_mm = [0, 0, 0]\n",
        ["output.point"],
    ),
    "teeth not whole": (
        f"format = 1\n{JOINT}joint_angle_deg=5\n{JOINT}joint_angle_deg=5\n[[shafts]]\nnumber=2\nspline.teeth = 1.5\n",
        ["teeth", "1.5"],
    ),
    "10,000 joints": ("format = 1\n" + f"{JOINT}joint_angle_deg = 5\n" * 10_000, ["10000", "400"]),
}


def refused(done, *words):
    """Check that a command refused its input in words, and in no others."""
    assert done.code == 2
    assert done.out == ""
    assert done.err.startswith("error: ")
    for word in words:
        assert word in done.err


@pytest.mark.parametrize("case", FILES)
@pytest.mark.parametrize("command", ["motion", "phases", "articulation", "report", "convert"])
def test_a_bad_drive_file_is_refused_by_every_command(cardan, drive_file, tmp_path, command, case):
    text, words = FILES[case]
    path = drive_file(text)
    more = ("out.toml",) if command == "convert" else ()
    refused(cardan(command, path, *more), path.name, *words)
    assert [there.name for there in tmp_path.iterdir()] == [path.name]


def test_all_problems_come_at_once(cardan, drive_file):
    path = drive_file(
        "format = 1\ncolour = 1\n[[joints]]\njoint_angle = 5\n[[joints]]\njoint_angle_deg = 95\nsize = 3\n"
    )
    refused(
        cardan("motion", path),
        "4 problems",
        "colour",
        "joints[0].joint_angle",
        "joints[1].joint_angle",
        "joints[1].size",
    )
    complaint = cardan("motion", path, "--json").complaint
    assert len(complaint["problems"]) == 4
    assert complaint["file"] == str(path)
    assert complaint["exit_code"] == 2


def test_very_many_problems_are_counted(cardan, drive_file):
    path = drive_file("format = 1\n" + "[[joints]]\njoint_angle = 5\n" * 100)
    done = cardan("motion", path)
    refused(done, "100 problems", "and 60 more")
    assert len(done.err.splitlines()) == 42
    assert len(cardan("motion", path, "--json").complaint["problems"]) == 100


def test_files_that_cannot_be_read(cardan, tmp_path):
    refused(cardan("motion", "missing.toml"), "missing.toml", "No such file")
    refused(cardan("motion", tmp_path), "directory")
    (tmp_path / "binary.toml").write_bytes(bytes(range(128, 256)))
    refused(cardan("motion", "binary.toml"), "binary.toml", "UTF-8")
    (tmp_path / "deep.json").write_text("[" * 100_000)
    refused(cardan("motion", "deep.json"), "deep.json")


@pytest.mark.slow
def test_standard_input_that_is_no_drive(process):
    done = process("motion", "-", input=b"\xff\xfe", capture_output=True)
    assert done.returncode == 2
    assert b"UTF-8" in done.stderr
    done = process("motion", "-", input=b"format = 1\n[[joints]]\nbend = 3", capture_output=True)
    assert done.returncode == 2
    assert b"standard input" in done.stderr


PLACES = ["nowhere/out", "file/out", "folder"]


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize(
    ("suffix", "command"),
    [
        (".svg", ("motion", TRUCK, "--plot")),
        (".pdf", ("phases", TRUCK, "--plot")),
        (".html", ("report", TRUCK, "-o")),
        (".toml", ("phases", TRUCK, "--apply", "A", "-o")),
        (".toml", ("convert", TRUCK)),
        (".toml", ("init",)),
        (".toml", ("example", "single-20deg")),
        (".json", ("schema", "-o")),
    ],
    ids=lambda value: value if isinstance(value, str) else " ".join(map(str, value[::2])),
)
def test_places_that_cannot_be_written(cardan, tmp_path, command, suffix, place):
    (tmp_path / "file").write_text("kept")
    (tmp_path / f"folder{suffix}").mkdir()
    refused(cardan(*command, place + suffix), place.split("/")[0])
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(["file", f"folder{suffix}"])
    assert (tmp_path / "file").read_text() == "kept"


@pytest.mark.slow
@pytest.mark.parametrize(
    "command", [("motion", TRUCK, "--plot", "out.svg"), ("report", TRUCK, "-o", "out.html")], ids=lambda c: c[0]
)
def test_a_full_disk_leaves_nothing_behind(cardan, tmp_path, monkeypatch, command):
    def full(*_ways):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "replace", full)
    refused(cardan(*command), "No space left on device")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("command", "words"),
    [
        (("motion",), ["FILE"]),
        (("moton", TRUCK), ["moton", "motion"]),
        (("motion", TRUCK, "extra"), ["extra"]),
        (("motion", TRUCK, "--colour"), ["--colour"]),
        (("motion", TRUCK, "--speed-rpm", "fast"), ["--speed-rpm"]),
        (("motion", TRUCK, "--speed-rpm", "nan"), ["--speed-rpm", "nan"]),
        (("motion", TRUCK, "--speed-rpm", "-1e300"), ["--speed-rpm", "no drive has"]),
        (("phases", TRUCK, "--apply", "E", "-o", "new.toml"), ["--apply", "no setting E", "16-tooth splines"]),
        (("motion", TRUCK, "--angle", "inf"), ["--angle-deg", "inf"]),
        (("motion", TRUCK, "--angle-step", "0"), ["--angle-step-deg"]),
        (("motion", TRUCK, "--angle-step", "1e-9"), ["--angle-step-deg"]),
        (("motion", TRUCK, "--angle-step", "5", "--angle", "5"), ["not both"]),
        (("motion", TRUCK, "--plot", "figure.gif"), ["--plot", ".svg"]),
        (("motion", TRUCK, "--plot", "figure"), ["--plot", ".svg"]),
        (("motion", TRUCK, "--csv", "--plot", "figure.bmp"), ["--plot"]),
        (("report", TRUCK, "-o", "report.odt"), [".html", ".pdf"]),
        (("report", TRUCK, "-o", "report.pdf", "--interactive"), ["--out", "figures to point at", ".html"]),
        (("phases", TRUCK, "--fix", "2"), ["--fix", "2=90"]),
        (("phases", TRUCK, "--fix", "2=x", "--fix", "3=inf", "--fix", "4=1", "--fix", "4=2"), ["3 problems", "twice"]),
        (("phases", TRUCK, "--fix", "9=1", "--fix", "1=1"), ["--fix 9", "--fix 1"]),
        (("phases", TRUCK, "--goal", "best"), ["--goal", "nearest"]),
        (("phases", TRUCK, "--apply", "A"), ["-o"]),
        (("phases", TRUCK, "--apply", "Z", "-o", "out.toml"), ["Z", "A; B"]),
        (("phases", TRUCK, "--apply", "Z"), ["no setting Z", "A; B"]),
        (("phases", TRUCK, "-o", "out.yaml"), ["--out", ".toml, .json"]),
        (("phases", TRUCK, "--layout"), ["given by angles"]),
        (("articulation", TRUCK, "--until", "-1"), ["--until-s"]),
        (("articulation", TRUCK, "--step", "1"), ["--step-s", "--until-s"]),
        (("articulation", TRUCK, "--until", "1", "--step", "1e-9"), ["--step-s"]),
        (("convert", TRUCK, "out.xml"), [".toml"]),
        (("convert", TRUCK, "out.toml", "--form", "circles"), ["--form"]),
        (("example", "nothing"), ["nothing"]),
        (("calc",), ["--list"]),
        (("calc", "chian"), ["error: there is no calculation named 'chian'; did you mean chain?"]),
        (("calc", "0"), ["error: there is no calculation named '0'; there are", "chain"]),
        (("calc", "chain", "alpha_deg"), ["alpha_deg=20"]),
        (("calc", "chain", "=3"), ["alpha_deg=20"]),
        (("calc", "single_joint", "alpha_deg=1", "alpha_deg=2"), ["twice"]),
        (
            ("calc", "single_joint", "alpha_deg=90", "joint_angle=2"),
            ["3 problems", "alpha_deg", "joint_angle", "phi1_deg"],
        ),
        (("calc", "single_joint", "alpha_deg=NaN", "phi1_deg=Infinity"), ["nan is not allowed", "inf is not allowed"]),
        (("calc", "single_joint", "--input", "missing.json"), ["missing.json", "no such file"]),
        (("calc", "single_joint", "--input", TRUCK), ["is not JSON"]),
    ],
    ids=lambda value: " ".join(map(str, value)).replace(str(TRUCK), "FILE") if isinstance(value, tuple) else "",
)
def test_a_wrong_command_line_is_refused_in_one_message(cardan, tmp_path, command, words):
    refused(cardan(*command), *words)
    said = cardan(*command, "--json")
    assert said.code == 2
    assert said.out == ""
    assert said.complaint["problems"]
    assert list(tmp_path.iterdir()) == []


def test_json_and_csv_exclude_each_other(cardan):
    done = cardan("motion", TRUCK, "--json", "--csv")
    assert done.code == 2
    assert done.complaint["problems"][0]["field"] == "--csv"


@pytest.mark.parametrize("command", ["motion", "phasing", "losses"])
def test_a_joint_that_does_not_turn_is_named_with_its_file_and_key(cardan, tmp_path, command):
    path = tmp_path / "balls.toml"
    sizes = "balls = 1\ndriving_offset_mm = 27.3\ndriven_offset_mm = 14.8\ngroove_radius_mm = 23.8\n"
    path.write_text(f'format = 1\n[[joints]]\nkind = "weiss"\njoint_angle_deg = 72\n{sizes}')
    done = cardan(command, path)
    assert done.code == 2
    assert done.err.startswith(f"error: {path}: joints[0].joint_angle_deg: ")
    assert "turns to and fro by 132.2°" in done.err


def test_a_fault_of_ours_is_no_traceback(cardan, monkeypatch):
    def broken(*_ways, **_more):
        raise ZeroDivisionError("division by zero")

    monkeypatch.setattr("cardan.cli.motion.motion.ask", broken)
    done = cardan("motion", TRUCK)
    assert done.code == 70
    assert "ZeroDivisionError: division by zero" in done.err
    monkeypatch.setenv("CARDAN_TRACEBACK", "1")
    with pytest.raises(ZeroDivisionError):
        main(["motion", str(TRUCK)])


def test_too_little_memory_is_said(cardan, monkeypatch):
    def greedy(*_ways, **_more):
        raise MemoryError

    monkeypatch.setattr("cardan.cli.motion.motion.ask", greedy)
    refused(cardan("motion", TRUCK), "not enough memory")
