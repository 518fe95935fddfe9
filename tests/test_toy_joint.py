"""A kind of joint that someone adds is one file: it is asked every question, on every surface, without another edit."""

from __future__ import annotations

import json

import numpy as np
import pytest

from cardan.batch.answering.questions import questions
from cardan.drive.joints import JOINTS, register
from cardan.errors import InputError
from cardan.io import dumps, loads
from cardan.io.schema import reference, schema
from cardan.questions.motion.motion import motion
from cardan.register import QUESTIONS
from cardan.report.answers import answered, subject
from cardan.report.report import page as page_of
from cardan.scene.gltf import render
from cardan.scene.scene import scene
from cardan.sweeps import sweep
from cardan.texts import LANGUAGES, speaking
from tests.cli.conftest import cardan, drive_file  # noqa: F401 - fixtures
from tests.fixtures.toy_joint import TOYS
from tests.house.surfaces import once

KEYS = {"mechanism": 'file = "hooke-stiff-bearings"'}
"""Kind -> keys without which it is nothing: a joint of one's own is asked as those that someone adds."""

KINDS = (*(toy.kind for toy in TOYS), *KEYS)

PLACES = ("first", "second", "alone")
"""Where the toy stands in a drive."""

CROSS = """
[[joints]]
centre_mm = {centre}
friction = 0.02
cross = { span_mm = 80, journal_mm = 20, inertia_kgm2 = [1e-3, 1e-3, 2e-3] }
needles = { capacity_kN = 20 }
tolerance = { alpha2_deg = 0.05 }
rating = { max_torque_Nm = 900 }
"""

TOY = """
[[joints]]
kind = "{kind}"
name = "clever {{thing}}"
{keys}
centre_mm = {centre}
rating = {{ max_torque_Nm = 900, max_joint_angle_deg = 30 }}
"""

MOVEMENT = """
[[movements]]
kind = "harmonic"
moves = ["output"]
amplitude_mm = [0, 0, 20]
frequency_Hz = 2
"""


def file_of(kind: str, where: str, *, moving: bool = False) -> str:
    """Return a drive file with all that any question asks for."""
    toy = TOY.format(kind=kind, keys=KEYS.get(kind, ""), centre="{centre}")
    joints = {"first": (toy, CROSS), "second": (CROSS, toy), "alone": (toy,)}[where]
    centres = ("[0, 0, 0]", "[600, 0, 30]")
    last = len(joints) + 1
    shafts = "\n".join(
        f"[[shafts]]\nnumber = {k}\ninertia_kgm2 = 0.01\nouter_mm = 60\nwall_mm = 3\nmaterial = '35'"
        + ("\nspline = { friction = 0.1, mean_diameter_mm = 40 }" if 1 < k < last else "")
        for k in range(1, last + 1)
    )
    return f"""format = 1
name = "with a toy"
input.point_mm = [-300, 0, 0]
output.point_mm = [{1100 if last > 2 else 500}, 0, 80]
{"".join(joint.replace("{centre}", centre) for joint, centre in zip(joints, centres, strict=False))}
{shafts}

[duty]
torque_Nm = 300
speed_rpm = 900
speed_range_rpm = [600, 1200]
life_h = 1000

[limits]
speed_fluctuation_percent = 5
output_error_deg = 1

[[supports]]
shaft = 1
position_mm = -200
axial = true
bore_mm = 40
friction = 0.002

[[supports]]
shaft = 1
position_mm = -50

[[supports]]
shaft = {last}
position_mm = 50
offset_mm = [0, 0.1, 0]

[[supports]]
shaft = {last}
position_mm = 200
axial = true
{MOVEMENT if moving else ""}"""


@pytest.fixture(autouse=True)
def toys():
    """Make the toys known, and forget them after."""
    before = dict(JOINTS)
    register(*TOYS)
    yield
    JOINTS.clear()
    JOINTS.update(before)


def with_every_toy(test):
    """Run a test for the toys at every place, and for what is read from a file at one."""
    pairs = [(kind, where) for kind in KINDS for where in PLACES if kind not in KEYS or where == "first"]
    return pytest.mark.parametrize(("kind", "where"), pairs)(test)


@with_every_toy
def test_its_file_is_written_as_it_was_read(kind, where):
    drive = loads(file_of(kind, where))
    assert loads(dumps(drive)) == drive
    assert f'kind = "{kind}"' in dumps(drive)


@with_every_toy
def test_it_turns_as_its_law_says(kind, where):
    drive = loads(file_of(kind, where))
    found = motion(drive)
    assert np.all(np.isfinite(found.output_angle))
    step = 1e-5
    after, before = (motion(drive, found.angle + shift).output_angle for shift in (step, -step))
    assert (after - before) / (2.0 * step) == pytest.approx(found.ratio, abs=1e-8)  # h² times a third derivative


@pytest.mark.slow
@with_every_toy
def test_every_question_has_a_page(kind, where):
    for moving in (False, True):
        drive = loads(file_of(kind, where, moving=moving))
        with pytest.MonkeyPatch.context() as patch:
            for name, question in QUESTIONS.items():
                patch.setitem(QUESTIONS, name, once(question))  # for all languages
            for language in LANGUAGES:
                with speaking(language):
                    pages = {name: answered(name, subject(drive)) for name in QUESTIONS}
                assert [name for name, page in pages.items() if not (page.answer and page.title)] == [], language


COMMANDS = (
    *("motion", "phases", "articulation", "forces", "losses", "life", "strength", "balance", "select", "tolerance"),
    *("bending", "rotor", "assembly", "mobility", "check"),
    *("torsion modes", "torsion response", "torsion stability", "torsion simulate --span-s 0.05"),
    "torsion absorber --speeds 600:900",
    "strength --size joint",
)
"""Every command that asks something of a drive file."""


@pytest.mark.slow
@pytest.mark.parametrize("command", COMMANDS)
@with_every_toy
def test_every_command_answers_or_says_why_not(cardan, drive_file, monkeypatch, command, kind, where):  # noqa: F811
    monkeypatch.setenv("CARDAN_TRACEBACK", "1")
    file = drive_file(file_of(kind, where, moving=command == "articulation"))
    name, *options = command.split(" --")
    words = [*name.split(), file, *(word for one in options for word in f"--{one}".split())]
    told = cardan(*words)
    assert told.code in (0, 1) if told.out else told.code == 2
    assert told.out or said_why(told.err)
    done = cardan(*words, "--json")
    assert done.code == told.code
    if done.code == 2:
        assert all(one["message"] for one in done.complaint["problems"])
    else:
        assert done.content["question"]


def said_why(text):
    """Tell whether an error is a sentence about a key of the file."""
    return text.startswith("error: ") and "Traceback" not in text and len(text.split()) > 4


@pytest.mark.slow
@with_every_toy
def test_the_report_tells_it(kind, where):
    for moving in (False, True):
        page = page_of(loads(file_of(kind, where, moving=moving)))
        assert where == "alone" or kind.replace("_", " ") in page
        assert "clever {thing}" in page


@pytest.mark.slow
@with_every_toy
def test_it_stands_in_space(kind, where, cardan, drive_file):  # noqa: F811
    shown = scene(loads(file_of(kind, where)), frames=12)
    text = json.dumps(shown.described(), allow_nan=False)
    assert "clever {thing}" in text
    assert len(render(shown)) > 1000
    done = cardan("convert", drive_file(file_of(kind, where)), "drive.glb")
    assert done.code == 0, done.err


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_the_keys_of_its_file_are_told(kind, cardan):  # noqa: F811
    assert kind in json.dumps(schema())
    assert f'kind = "{kind}"' in reference()
    listed = {one["kind"]: one for one in cardan("joint", "--json").content["kinds"]}
    assert [key["key"] for key in listed[kind]["keys"]]
    assert listed[kind]["types"] == []
    keys = [KEYS[kind].replace(" ", "").replace('"', "")] if kind in KEYS else []
    (by_itself,) = cardan("joint", kind, *keys, "--json", "--joint-angle-deg", "20").content["joints"]
    assert by_itself["speed_fluctuation_percent"] > 0.0
    assert kind in cardan("joint", kind, *keys, "hooke", "--joint-angle-deg", "20").out


@pytest.mark.slow
@with_every_toy
def test_every_column_of_a_sweep_is_answered_or_refused(kind, where):
    drive = loads(file_of(kind, where))
    refused = {}
    for name in questions():
        try:
            found = sweep(drive, {"duty.torque_Nm": [200.0, 300.0]}, [name])
        except InputError as error:
            refused[name] = str(error)
        else:
            assert len(next(iter(found.table().values()))) == 2
    assert all(refused.values())
    assert {"speed_fluctuation", "ratio", "joint_angle", "check", "critical_speed", "mass"}.isdisjoint(refused)
