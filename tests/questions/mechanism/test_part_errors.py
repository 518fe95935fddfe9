"""Tolerances of joints against loops closed anew with parts that are off."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan.mechanism.mechanism import Mechanism, Pair
from cardan.mechanisms import example_mechanism
from cardan.questions.mechanism.motion import mechanism_motion
from cardan.units import deg, mm

TURN = np.arange(5.0, 360.0, 40.0) * deg


def test_a_long_rod_shifts_the_piston_as_its_triangle_says():
    """A crank pin 0.1 mm off along the rod: the piston goes 0.1 mm/cos β; across it nothing else does more."""
    crank = example_mechanism("crank-slider-cured")
    joints = tuple(replace(one, tolerance=0.1 * mm if one.id == "crank pin" else None) for one in crank.joints)
    found = mechanism_motion(replace(crank, joints=joints), TURN)
    start = np.arctan2(40.0, 30.0)
    beta = np.arcsin(50.0 * np.sin(start + TURN) / np.hypot(170.0, 40.0))
    assert found.errors is not None
    assert found.errors.worst == pytest.approx(0.1 * mm / np.cos(beta), rel=1e-9)
    assert found.errors.likely == pytest.approx(found.errors.worst)
    assert not found.errors.turns


def test_a_coupler_of_another_length_turns_the_rocker():
    """Against Freudenstein's loop closed with a crank pin that is off, in the direction that does most."""
    bars = four_bar()
    found = mechanism_motion(bars, np.zeros(1))
    assert found.errors is not None
    most = 0.0
    for way in np.arange(0.0, 360.0, 2.0) * deg:
        off = 0.01 * mm * np.asarray([np.cos(way), np.sin(way)])
        most = max(most, abs(rocker(off) - rocker(np.zeros(2))))
    assert found.errors.turns
    assert float(found.errors.worst[0]) == pytest.approx(most, rel=1e-3)  # every other degree; of first order


A, B, C, D = np.asarray([0.0, 0.0]), np.asarray([30.0, 40.0]), np.asarray([180.0, 110.0]), np.asarray([160.0, 0.0])


def rocker(off):
    """Return the angle of the rocker with a crank pin that is off on the side of the coupler [rad]."""
    pin = B * mm + off
    coupler, arm = np.linalg.norm(C - B) * mm, np.linalg.norm(C - D) * mm
    apart = D * mm - pin
    far = float(np.linalg.norm(apart))
    inner = np.arccos((far**2 + arm**2 - coupler**2) / (2.0 * far * arm))
    return float(np.arctan2(-apart[1], -apart[0]) - inner)


def four_bar():
    """Return crank, coupler and rocker, the pins of the coupler a hinge and a ball so that all fits."""
    rows = (("crank bearing", "R", ("frame", "crank"), A), ("crank pin", "R", ("crank", "coupler"), B))
    more = (("rocker pin", "SG", ("coupler", "rocker"), C), ("rocker bearing", "R", ("frame", "rocker"), D))
    pairs = [
        Pair(id=name, type=kind, links=links, point=(*(point * mm), 0.0), axis=(0.0, 0.0, 1.0))
        for name, kind, links, point in (*rows, *more)
    ]
    pairs[1] = replace(pairs[1], tolerance=0.01 * mm)
    return Mechanism(
        frame="frame", input_link="crank", output_link="rocker", input_range=(0.0, 0.1), joints=tuple(pairs)
    )
