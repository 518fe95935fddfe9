"""What joints weigh counts wherever shafts weigh: by hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, example
from cardan.catalogue.catalogue import catalogue
from cardan.catalogue.completion import completed, shortened
from cardan.catalogue.rows import JointSize
from cardan.drive.cross import Cross
from cardan.drive.duty import Duty
from cardan.drive.shaft import PointMass, Shaft
from cardan.drive.support import Support
from cardan.drive.yokes import unweighed, with_yokes, yoke_mass
from cardan.questions.bending.balance import balance
from cardan.questions.forces.forces import forces
from cardan.questions.torsion.model.torsional_train import torsional_train

LENGTH, SPAN, MASS, CROSS, G = 1.2, 0.08, 5.0, 0.8, 9.80665
YOKE = 0.5 * (MASS - CROSS)


def drive(**shaft):
    made = Drive.from_angles([0.0, 0.0])
    joints = tuple(replace(one, mass=MASS, cross=Cross(span=SPAN, mass=CROSS)) for one in made.joints)
    return replace(made, joints=joints, shafts=(Shaft(number=2, length=LENGTH, outer=0.07, inner=0.066, **shaft),))


def test_a_size_says_what_its_joint_weighs_and_the_file_overrules_it():
    row = catalogue().row(JointSize, "example-75")
    sized = completed(
        replace(drive(), joints=tuple(replace(one, mass=None, size="example-75") for one in drive().joints))
    )
    assert sized.joints[0].mass == row.mass
    assert yoke_mass(sized.joints[0]) == pytest.approx(0.5 * (row.mass - CROSS))
    assert shortened(sized).joints[0].mass is None
    own = completed(replace(drive(), joints=tuple(replace(one, size="example-75") for one in drive().joints)))
    assert own.joints[0].mass == MASS
    assert shortened(own).joints[0].mass == MASS


def test_a_shaft_carries_a_yoke_at_either_end():
    one, two = with_yokes(drive()).shafts[1].masses
    assert (one.position, two.position) == (pytest.approx(0.5 * SPAN), pytest.approx(LENGTH - 0.5 * SPAN))
    assert one.mass == two.mass == pytest.approx(YOKE)
    # A solid cylinder as thick and as long as the span.
    assert one.polar_inertia == pytest.approx(YOKE * SPAN**2 / 8)
    assert one.diametral_inertia == pytest.approx(YOKE * (3 * (SPAN / 2) ** 2 + SPAN**2) / 12)
    assert [lump.position for lump in with_yokes(drive()).shafts[0].masses] == [pytest.approx(-0.5 * SPAN)]
    assert [lump.position for lump in with_yokes(drive()).shafts[2].masses] == [pytest.approx(0.5 * SPAN)]


def test_twice_is_once_and_what_a_file_says_stands():
    made = with_yokes(drive())
    assert with_yokes(made) == made
    assert with_yokes(drive(mass=4.0)).shafts[1].masses == ()
    own = PointMass(position=0.1, mass=0.9)
    kept = with_yokes(drive(masses=(own,))).shafts[1].masses
    assert [lump.mass for lump in kept] == [0.9, pytest.approx(YOKE)]
    still = with_yokes(drive(inertia=0.01)).shafts[1].masses
    assert [lump.polar_inertia for lump in still] == [0.0, 0.0]


def test_joints_whose_yokes_weigh_nothing_are_named():
    assert unweighed(drive()) == ()
    bare = replace(drive(), joints=tuple(replace(one, mass=None) for one in drive().joints))
    assert unweighed(bare) == (1, 2)
    assert unweighed(example("car-propshaft")) == ()


def test_the_allowed_unbalance_grows_with_the_mass_by_hand():
    """G40 at 3000 rpm: the eccentricity 40 mm/s over ω times tube and two yokes."""
    omega = 3000 * np.pi / 30
    tube = 7850 * np.pi / 4 * (0.07**2 - 0.066**2) * LENGTH
    (found,) = balance(replace(drive(), duty=Duty(speed=omega)), grade="G40").shafts
    assert found.mass == pytest.approx(tube + 2 * YOKE, rel=2e-3)
    assert found.allowed == pytest.approx(0.040 / omega * (tube + 2 * YOKE), rel=2e-3)


def test_supports_carry_the_weight_of_the_joints():
    """Straight, all of it on machines: half the tube and a cross, and both yokes of its joint, at either end."""
    held = replace(
        drive(),
        supports=tuple(
            Support(shaft=s, position=x, axial=x in (-0.2, 0.2)) for s, x in ((1, -0.2), (1, -0.1), (3, 0.1), (3, 0.2))
        ),
        shafts=(replace(drive().shafts[1], spline=example("car-propshaft").shafts[1].spline),),
        duty=Duty(torque=10.0),
    )
    found = forces(held)
    tube = 7850 * np.pi / 4 * (0.07**2 - 0.066**2) * LENGTH
    lifted = np.asarray(found.reaction)[:, 0, 2].sum()
    assert lifted == pytest.approx(G * (tube + 2 * MASS), rel=2e-3)


def test_yokes_turn_with_their_shafts():
    made = replace(drive(), joints=tuple(replace(one, mass=None) for one in drive().joints))
    heavy, light = (torsional_train(one, loaded=False).model for one in (drive(), made))
    assert np.sum(heavy.inertia) - np.sum(light.inertia) == pytest.approx(4 * YOKE * SPAN**2 / 8)
    assert heavy.elements == light.elements
