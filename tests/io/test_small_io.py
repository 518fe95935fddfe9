"""What small functions of io return."""

import numpy as np

from cardan.drive.joints import Hooke
from cardan.io.amend import steps_of
from cardan.io.formats.json import plain
from cardan.io.reader import meant, tables, unknown
from cardan.io.signals.columns import meaning, suffix_of, title_of, underlined


def test_steps_of():
    assert steps_of("joints[1].cross.span_mm") == ("joints", 1, "cross", "span_mm")


def test_plain():
    assert plain({"a": np.asarray([1.0, np.nan]), "b": 1 + 2j}) == {"a": [1.0, None], "b": [1.0, 2.0]}


def test_tables():
    assert [title for title, cls in tables()][:6] == [
        "the head of the file, above its first table",
        "[report]",
        "[settings]",
        "[input]",
        "[output]",
        "[[joints]] kind = 'hooke'",
    ]


def test_unknown():
    assert unknown(Hooke, "plane_twist_dg") == "unknown key; the nearest known one is plane_twist_deg"


def test_meant():
    assert (meant(Hooke, "centre"), meant(Hooke, "joint_angle_mm"), meant(Hooke, "colour")) == (
        "centre",
        "joint_angle",
        "",
    )


def test_title_of():
    assert (title_of("front", "acceleration", "supports[1]", "z"), title_of("tacho", "pulses", "", "")) == (
        "acceleration_front_supports[1]_z_m_s2",
        "tacho",
    )


def test_meaning():
    found = meaning("acceleration_supports[1]_z_mm_s2")
    assert (found.quantity, found.unit, found.place, found.direction) == ("acceleration", "mm_s2", "supports[1]", "z")
    assert (meaning("speed_rpm").quantity, meaning("tacho").quantity, meaning("front_g").name) == (
        "angular_speed",
        "pulses",
        "front",
    )


def test_suffix_of():
    assert (suffix_of("m/s²"), suffix_of("N·m"), suffix_of("[RPM]"), suffix_of("furlong")) == ("m_s2", "Nm", "rpm", "")


def test_underlined():
    assert (underlined("Acceleration front [m/s²]"), underlined("Time (sec)"), underlined("velocity_shafts[1]")) == (
        "Acceleration_front_m_s2",
        "Time_s",
        "velocity_shafts[1]",
    )
