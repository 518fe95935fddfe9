"""A pin coupling between shafts that do not meet, against pin and cone by plain vectors."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

from cardan.mechanisms import example_mechanism, mechanism_motion
from cardan.questions.mobility.mobility import mobility
from cardan.units import deg

AXIS = np.asarray([24.0, 7.0, 0.0]) / 25.0
START, END, TOUCH = (np.asarray(one) for one in ((-50.0, 0.0, 0.0), (48.0, 14.0, 6.0), (-6.0, 42.0, 3.0)))


def turned(angle):
    """By how much the driven shaft has turned: where the driving pin meets the cone that the driven one sweeps."""
    slant = (TOUCH - END) @ AXIS / np.linalg.norm(TOUCH - END)
    pin, far, found = TOUCH - START, 1.0, []
    for one in angle:
        way = Rotation.from_rotvec([one, 0.0, 0.0]).apply(pin)

        def off(share, way=way):
            arm = START + share * way - END
            return arm @ AXIS - slant * np.linalg.norm(arm)

        far = brentq(off, far - 0.1, far + 0.1, xtol=1e-15)
        arm = START + far * way - END
        first, now = (one - (one @ AXIS) * AXIS for one in (TOUCH - END, arm))
        found.append(np.arctan2(np.cross(first, now) @ AXIS, first @ now))
    return np.unwrap(found)


def test_it_turns_as_a_pin_on_a_cone():
    angle = np.linspace(0.0, 2.0 * np.pi, 721)
    output, exact = mechanism_motion(example_mechanism("pin-coupling-apart"), angle).output, turned(angle)
    np.testing.assert_allclose(output.angle, exact, atol=1e-10)
    assert np.ptp(exact - angle) / deg == pytest.approx(2 * 7.189, abs=2e-3), "as the page on couplings says"
    assert np.ptp(output.ratio) == pytest.approx(0.2783, abs=1e-4), "as its file says"


def test_nothing_of_it_is_held_twice():
    found = mobility(example_mechanism("pin-coupling-apart"))
    assert (found.mobility, found.redundant) == (1, 0)


def test_the_bore_belongs_to_the_first_link():
    drawn = example_mechanism("pin-coupling-apart")
    swapped = tuple(replace(one, links=one.links[::-1]) if one.type == "SG" else one for one in drawn.joints)
    other = mechanism_motion(replace(drawn, joints=swapped)).output
    assert np.ptp(other.ratio) > 1.2 * np.ptp(mechanism_motion(drawn).output.ratio), (
        "a bore in the bead is another joint"
    )
