"""Friction in mechanisms: against closed forms of a screw, a slider in its guide and a journal, and where they lock."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan import InputError
from cardan.mechanism.load import Load
from cardan.mechanism.mechanism import Mechanism, Pair
from cardan.mechanisms import example_mechanism
from cardan.questions.mechanism.forces import mechanism_forces
from cardan.units import deg, rpm

SCREW = Mechanism(
    frame="frame",
    input_link="spindle",
    output_link="nut",
    output_force=1000.0,
    speed=60 * rpm,
    joints=(
        Pair(id="bearing", type="R", links=("frame", "spindle"), point=(0.0, 0.0, 0.0), axis=(1.0, 0.0, 0.0)),
        Pair(
            id="thread",
            type="H",
            links=("spindle", "nut"),
            point=(0.1, 0.0, 0.0),
            axis=(1.0, 0.0, 0.0),
            pitch=0.005 / (2.0 * np.pi),
            diameter=0.018,
            friction=0.1,
        ),
        Pair(id="guide", type="P", links=("frame", "nut"), point=(0.1, 0.0, 0.0), axis=(1.0, 0.0, 0.0)),
    ),
)


def test_a_screw_has_the_efficiency_of_its_lead_angle():
    """tan λ/tan(λ + ρ) for a square thread, whichever way it turns against its load."""
    lead = np.arctan(0.005 / (np.pi * 0.018))
    for speed in (60 * rpm, -60 * rpm):
        found = mechanism_forces(replace(SCREW, speed=speed, input_range=(0.0, 1.0)), np.linspace(0.0, 1.0, 5))
        torque = 1000.0 * 0.009 * np.tan(lead + np.arctan(0.1))
        assert np.abs(found.input_torque) == pytest.approx(torque, rel=1e-9)
        assert found.efficiency == pytest.approx(np.tan(lead) / np.tan(lead + np.arctan(0.1)), rel=1e-9)
        assert found.unbalanced < 1e-9


def test_a_slider_rubs_by_what_presses_it():
    """Crank and slider without mass: from the triangle of forces at the piston, at each angle."""
    crank = example_mechanism("crank-slider")
    mu = 0.12
    joints = tuple(replace(one, friction=mu if one.id == "guide" else None) for one in crank.joints)
    plain = replace(crank, masses=(), joints=joints)
    turn = np.linspace(0.1, 2.9, 15)
    found = mechanism_forces(plain, turn)
    start = np.arctan2(40.0, 30.0)
    rod = np.hypot(170.0, 40.0)
    phi = start + turn
    beta = np.arcsin(50.0 * np.sin(phi) / rod)
    push = 800.0 / (np.cos(beta) - mu * np.abs(np.sin(beta)))  # in the rod: load and friction along the guide
    lever = 0.05 * np.sin(phi) * np.cos(beta) + 0.05 * np.cos(phi) * np.sin(beta)
    assert np.abs(found.input_torque) == pytest.approx(np.abs(push * lever), rel=1e-9)


def test_a_journal_rubs_at_its_radius():
    """A wheel with a load at its rim: μ F d/2 against turning."""
    wheel = Mechanism(
        frame="frame",
        input_link="wheel",
        output_link="wheel",
        output_torque=10.0,
        speed=10.0,
        joints=(
            Pair(
                id="journal",
                type="R",
                links=("frame", "wheel"),
                point=(0.0, 0.0, 0.0),
                axis=(0.0, 0.0, 1.0),
                diameter=0.04,
                bearing_distance=0.2,
                friction=0.1,
            ),
        ),
    )
    loaded = replace(wheel, loads=(Load(link="wheel", force=(0.0, -500.0, 0.0), point=(0.0, 0.0, 0.05)),))
    found = mechanism_forces(loaded, np.asarray([0.0]))
    assert found.input_torque[0] == pytest.approx(10.0 + 0.1 * 0.02 * (500.0 + 2.0 * 25.0 / 0.2), rel=1e-12)


def test_what_friction_locks_is_told():
    jam = example_mechanism("crank-slider")
    joints = tuple(replace(one, friction=9.0 if one.id == "guide" else None) for one in jam.joints)
    with pytest.raises(InputError, match="friction locks the mechanism"):
        mechanism_forces(replace(jam, masses=(), joints=joints), np.linspace(0.0, 3.0, 40))


def test_what_rubs_needs_its_diameter():
    with pytest.raises(InputError, match=r"joints\[0\]\.diameter: missing: what turns rubs at a diameter"):
        replace(SCREW, joints=(replace(SCREW.joints[0], friction=0.1), *SCREW.joints[1:]))


@pytest.mark.slow
def test_a_whole_turn_keeps_its_powers():
    crank = example_mechanism("crank-slider")
    joints = tuple(
        replace(one, friction=0.08, diameter=None if one.kind.turns == "" else 0.02, bearing_distance=0.03)
        for one in crank.joints
    )
    found = mechanism_forces(replace(crank, joints=joints), np.arange(360) * deg)
    assert found.unbalanced < 1e-9
    smooth = mechanism_forces(crank, np.arange(360) * deg)
    given = np.nanmean(found.input_torque) - np.nanmean(smooth.input_torque)
    assert given * (crank.speed or 1.0) == pytest.approx(np.nanmean(np.sum(found.loss, axis=-1)), rel=0.05)
    assert 0.8 < (found.efficiency or 0.0) < 1.0
