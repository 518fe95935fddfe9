"""How far joints that plunge go in and out while a drive moves."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan import check
from cardan.io.drive_file import loads
from cardan.questions.mobility.mobility import mobility
from cardan.questions.motion.articulation import articulation

HALF_SHAFT = """format = 1
[[joints]]
{first}
centre_mm = [0, 0, 0]
[[joints]]
{second}
centre_mm = [0, 400, 30]
[input]
point_mm = [0, -200, 0]
[output]
point_mm = [0, 600, 0]
{more}
[[movements]]
kind = "harmonic"
moves = ["joints[1]", "output"]
amplitude_mm = [0, 5, 60]
frequency_Hz = 1.5
"""
TRIPOD = 'kind = "tripod"\nplunge_out_mm = 14\nplunge_in_mm = 12'
FIXED = 'kind = "rzeppa"\ndriving_offset_mm = 5\ndriven_offset_mm = 5\ngroove_radius_mm = 32'


def half_shaft(first=TRIPOD, second=FIXED, more=""):
    return loads(HALF_SHAFT.format(first=first, second=second, more=more))


def lengths():
    """Return the length of the shaft as drawn, and its least and greatest, by plain distances."""
    phase = np.linspace(0.0, 2.0 * np.pi, 200_001)
    every = np.hypot(400 + 5 * np.sin(phase), 30 + 60 * np.sin(phase)) * 1e-3
    return np.hypot(0.4, 0.03), every.min(), every.max()


def test_the_way_is_that_of_the_shaft():
    drawn, least, most = lengths()
    out, back = check(half_shaft(), only=["plunge"])
    assert out.value == pytest.approx(most - drawn, rel=1e-9)
    assert back.value == pytest.approx(drawn - least, rel=1e-9)
    assert (out.limit, back.limit) == (pytest.approx(0.014), pytest.approx(0.012))
    assert out.subject == back.subject == "joints[0]"
    assert [one.title for one in (out, back)] == ["plunge of joint 1, pulled out", "plunge of joint 1, pushed in"]
    assert (out.passed, back.passed) == (most - drawn <= 0.014, drawn - least <= 0.012)
    assert out.note == back.note == "while the drive moves"


def test_a_short_joint_fails():
    out = check(half_shaft(first=TRIPOD.replace("14", "3")), only=["plunge"])[0]
    assert out.state == "failed"
    assert out.design_variables == ("joints[0].plunge_out",)


def test_what_is_not_known_is_named():
    out, back = check(half_shaft(first='kind = "tripod"'), only=["plunge"])
    assert (out.missing, back.missing) == (("joints[0].plunge_out",), ("joints[0].plunge_in",))


def test_two_joints_that_plunge_share_their_limits():
    out, back = check(half_shaft(second=TRIPOD), only=["plunge"])
    assert (out.limit, back.limit) == (pytest.approx(0.028), pytest.approx(0.024))
    assert out.design_variables == ("joints[0].plunge_out", "joints[1].plunge_out")
    assert "both together" in out.note


def test_a_spline_takes_the_way_instead():
    assert check(half_shaft(more="[[shafts]]\nnumber = 2\nspline = {}"), only=["plunge"]) == ()
    assert check(half_shaft(first=FIXED), only=["plunge"]) == ()


def test_a_ball_joint_plunges_once_it_says_how_far():
    ideal = 'kind = "constant_velocity"'
    plunging = f"{ideal}\nplunge_out_mm = 14\nplunge_in_mm = 12"
    assert check(half_shaft(first=ideal), only=["plunge"]) == ()
    out = check(half_shaft(first=plunging), only=["plunge"])[0]
    assert out.value == pytest.approx(check(half_shaft(), only=["plunge"])[0].value)
    told = [str(one) for one in articulation(half_shaft(first=ideal)).warnings]
    assert any("no spline" in one for one in told)
    assert not any("no spline" in str(one) for one in articulation(half_shaft(first=plunging)).warnings)
    held = "[[supports]]\nshaft = {}\nposition_mm = {}\naxial = true\ntilt = true"
    bearings = "\n".join(held.format(number, place) for number, place in ((1, -100), (3, 100)))
    bound, free = (mobility(half_shaft(first=one, more=bearings)).redundant for one in (ideal, plunging))
    assert bound == free + 1


def test_many_drives_are_judged_at_once():
    heights = np.array([30.0, -10.0])
    out = check(half_shaft(), only=["plunge"], vary={"joints[1].centre_mm[2]": heights})[0]
    for k, height in enumerate(heights):
        moved = replace(half_shaft().joints[1], centre=(0.0, 0.4, height * 1e-3))
        alone = replace(half_shaft(), joints=(half_shaft().joints[0], moved))
        assert out.value[k] == pytest.approx(check(alone, only=["plunge"])[0].value)


def test_articulation_tells_the_same_way_and_when_it_is_too_far():
    """By plain distances, at both ends of each span and in its middle."""
    drawn, least, most = lengths()
    found = articulation(half_shaft(first=TRIPOD.replace("14", "3").replace("12", "0.5")))
    flags = {flag.field: flag for one in found.splines for flag in one.flags}
    assert flags["joints[0].plunge_out"].value == pytest.approx(most - drawn, rel=1e-6)
    assert flags["joints[0].plunge_in"].value == pytest.approx(drawn - least, rel=1e-6)
    for key, sign, limit in (("plunge_out", 1.0, 0.003), ("plunge_in", -1.0, 0.0005)):
        flag = flags[f"joints[0].{key}"]
        assert flag.limit == limit
        assert flag.spans
        for start, end in flag.spans:
            wave = np.sin(3.0 * np.pi * np.linspace(start, end, 101))
            ways = sign * (np.hypot(400 + 5 * wave, 30 + 60 * wave) * 1e-3 - drawn)
            assert np.min(ways) > limit - 2e-6
    assert not any(one.flags for one in articulation(half_shaft()).splines if most - drawn < 0.014)
    assert not any(one.flags for one in articulation(half_shaft(first='kind = "tripod"')).splines)
