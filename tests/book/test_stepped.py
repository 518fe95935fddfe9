"""Stepped shafts: published cases, and the same shaft told in different ways."""

from __future__ import annotations

import numpy as np
import pytest

from cardan import InputError
from cardan.book.stepped import Node, placed_speeds, stepped_speeds
from cardan.maths.linear.rotor_beams import round_section

STEEL = {"youngs": 2.06e11, "density": 7850.0}
PINNED = Node(held=True)


def test_a_mass_amid_a_light_shaft():
    """Massless shaft with a mass at a share a of the span: ω² = 3 EI L/(m a²b²), by the deflection under the mass."""
    bar = round_section(0.02, 0.0, 2.06e11, 1e-3)
    found = placed_speeds([1.0], bar, masses=[(0.3, 5.0)], supports=[(0.0, "pinned"), (1.0, "pinned")], modes=1)
    want = np.sqrt(3 * bar.bending / (5.0 * 0.3**2 * 0.7**2))
    assert found[0] == pytest.approx(want, rel=1e-6)


def test_a_rigid_shaft_bounces_on_its_springs():
    """Two springs k at the ends of a stiff bar m, l: ω² = 2k/m across, 6k/m in tilt."""
    bar = round_section(0.2, 0.0, 2.06e15, 7850.0)
    found = placed_speeds([0.5], bar, springs=[(0.0, 1e5), (0.5, 1e5)])
    mass = float(bar.mass) * 0.5
    np.testing.assert_allclose(found, [np.sqrt(2e5 / mass), np.sqrt(6e5 / mass)], rtol=1e-6)


def test_places_may_come_in_any_order_and_split():
    tube = round_section(np.asarray([0.05, 0.07]), np.asarray([0.0, 0.066]), **STEEL)
    one = placed_speeds(
        [0.4, 1.0],
        tube,
        springs=[(1.2, 3e5), (0.2, 1e5)],
        masses=[(0.4, 1.0), (1.4, 2.0)],
        supports=[(0.0, "pinned"), (0.9, "pinned")],
    )
    cut = round_section(np.asarray([0.05, 0.05, 0.07, 0.07]), np.asarray([0.0, 0.0, 0.066, 0.066]), **STEEL)
    other = placed_speeds(
        [0.1, 0.3, 0.5, 0.5],
        cut,
        springs=[(0.2, 6e4), (0.2, 4e4), (1.2, 3e5)],
        masses=[(1.4, 1.5), (0.4, 1.0), (1.4, 0.5)],
        supports=[(0.9, "pinned"), (0.0, "pinned")],
    )
    np.testing.assert_allclose(one, other, rtol=1e-10)


def test_both_ways_to_tell_a_shaft_agree():
    tube = round_section(np.asarray([0.05, 0.07]), np.asarray([0.0, 0.066]), **STEEL)
    nodes = [Node(held=True, clamped=True), Node(mass=1.5), Node(stiffness=2e5)]
    want = stepped_speeds([0.4, 1.0], tube, nodes, modes=2).speed
    found = placed_speeds([0.4, 1.0], tube, springs=[(1.4, 2e5)], masses=[(0.4, 1.5)], supports=[(0.0, "fixed")])
    np.testing.assert_allclose(found, want, rtol=1e-11)


@pytest.mark.parametrize("supports", [(), [(0.3, "pinned")]])
def test_what_nothing_holds_is_refused(supports):
    with pytest.raises(InputError) as caught:
        placed_speeds([1.0], round_section(0.05, 0.0, **STEEL), supports=supports)
    assert [problem.field for problem in caught.value.problems] == ["supports"]
    spring = placed_speeds([1.0], round_section(0.05, 0.0, **STEEL), springs=[(0.9, 1e4)], supports=[(0.3, "pinned")])
    assert spring[0] > 0.0


def test_spin_raises_what_whirls_forward():
    """Gyroscopic action of a disc: at rest, at half the speed, in step, and against the whirl."""
    bar = round_section(0.03, 0.0, **STEEL, poisson=0.3)
    nodes = [PINNED, Node(mass=5.0, diametral_inertia=0.05, polar_inertia=0.09), PINNED]
    still, half, back = (stepped_speeds([0.2, 0.6], bar, nodes, spin=spin).speed for spin in (0.0, 200.0, -200.0))
    critical = stepped_speeds([0.2, 0.6], bar, nodes)
    assert np.all(back < still)
    assert np.all(still < half)
    assert critical.lost == 1
    # At its own critical speed the shaft whirls as fast as it spins.
    first = critical.speed[0]
    at_speed = stepped_speeds([0.2, 0.6], bar, nodes, spin=float(first)).speed
    assert np.min(np.abs(at_speed - first)) < 1e-9 * first


def test_inertia_at_a_hinge_goes_with_the_part_before():
    bar = round_section(np.asarray([0.03, 0.03]), 0.0, **STEEL)
    at_hinge = [PINNED, Node(hinge=True, diametral_inertia=0.02, stiffness=1e5), PINNED]
    before = [PINNED, Node(diametral_inertia=0.02), Node(hinge=True, stiffness=1e5), PINNED]
    three = round_section(np.asarray([0.03, 0.03, 0.03]), 0.0, **STEEL)
    want = stepped_speeds([0.5 - 1e-5, 1e-5, 0.7], three, before).speed
    np.testing.assert_allclose(stepped_speeds([0.5, 0.7], bar, at_hinge).speed, want, rtol=1e-4)


def test_a_free_shaft_has_two_motions_without_bending():
    found = stepped_speeds([1.0], round_section(0.05, 0.0, **STEEL), [Node(), Node()], modes=3)
    assert found.rigid == 2
    assert found.speed[:2].tolist() == [0.0, 0.0]
    assert found.speed[2] == pytest.approx(4.730040744862704**2 * np.sqrt(2.06e11 / 7850.0) * 0.05 / 4, rel=1e-10)
