"""Stepped bodies and what shafts carry, by hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, InputError
from cardan.drive.body import body_length, pieces, softness
from cardan.drive.material import Material
from cardan.drive.models.dynamics_model import train
from cardan.drive.shaft import Layup, Ply, PointMass, Segment, Shaft
from cardan.io import dumps, loads

DRIVE = Drive.from_points([(-0.3, 0, 0), (0, 0, 0), (1.0, 0, 0), (1.5, 0, -0.1)])
STEPS = (
    Segment(length=0.2, outer=0.05),
    Segment(length=0.7, outer=0.08, inner=0.076),
    Segment(length=0.1, outer=0.06, material=Material(density=2700.0, youngs=7e10)),
)


def with_shaft(**keys: object) -> Drive:
    return replace(DRIVE, shafts=(Shaft(**{"number": 2, **keys}),))  # type: ignore[arg-type]


def fields(**keys: object) -> list[str]:
    with pytest.raises(InputError) as caught:
        with_shaft(**keys)
    return [problem.field for problem in caught.value.problems]


def test_a_stepped_body_weighs_what_its_stretches_do() -> None:
    found = train(with_shaft(segments=STEPS))
    mass = np.pi / 4 * np.asarray([7850 * 0.2 * 0.05**2, 7850 * 0.7 * (0.08**2 - 0.076**2), 2700 * 0.1 * 0.06**2])
    square = np.asarray([0.05**2, 0.08**2 + 0.076**2, 0.06**2])
    place, long = np.asarray([0.1, 0.55, 0.95]), np.asarray([0.2, 0.7, 0.1])
    centre = mass @ place / mass.sum()
    assert found.mass[1] == pytest.approx(mass.sum())
    assert found.centre_of_mass[1] == pytest.approx(centre)
    assert found.inertia[1] == pytest.approx(mass @ square / 8)
    across = mass @ (square / 16 + long**2 / 12 + (place - centre) ** 2)
    assert found.transverse_inertia[1] == pytest.approx(across)


def test_what_a_shaft_carries_comes_on_top() -> None:
    parts = (
        PointMass(position=0.1, mass=2.0, polar_inertia=0.01, diametral_inertia=0.006),
        PointMass(position=0.9, mass=1.0),
    )
    found = train(with_shaft(mass=3.0, centre_of_mass=0.5, inertia=0.02, transverse_inertia=0.25, masses=parts))
    assert found.mass[1] == 6.0
    assert found.centre_of_mass[1] == pytest.approx((0.2 + 0.9 + 1.5) / 6)
    assert found.inertia[1] == pytest.approx(0.03)
    centre = 2.6 / 6
    spread = 0.25 + 0.006 + 2 * (centre - 0.1) ** 2 + (0.9 - centre) ** 2 + 3 * (0.5 - centre) ** 2
    assert found.transverse_inertia[1] == pytest.approx(spread)
    assert train(with_shaft(masses=parts)).mass[1] == 3.0


def test_on_the_input_shaft_places_count_from_joint_1() -> None:
    body = (Segment(length=0.1, outer=0.03), Segment(length=0.1, outer=0.06))
    found = train(with_shaft(number=1, segments=body, masses=(PointMass(position=-0.2, mass=1.0),)))
    one, other = 7850 * np.pi / 4 * 0.1 * np.asarray([0.03**2, 0.06**2])
    assert found.centre_of_mass[0] == pytest.approx(0.3 + (-0.15 * one - 0.05 * other - 0.2) / (one + other + 1.0))
    # The body begins 0.1 behind the input point, its second stretch 0.2.
    assert found.stretch_start[0].tolist() == [-np.inf, pytest.approx(0.2)]


def test_stretches_give_way_one_by_one() -> None:
    found = softness(Shaft(number=2, segments=STEPS), 1.0)
    assert found.start == pytest.approx((-np.inf, 0.2, 0.9), rel=1e-14)
    assert found.bending[0] == pytest.approx(64 / (np.pi * 2.06e11 * 0.05**4))
    assert found.stretching[2] == pytest.approx(4 / (np.pi * 7e10 * 0.06**2))
    whole = train(replace(DRIVE, shafts=(Shaft(number=2, segments=STEPS), Shaft(number=3, outer=0.05))))
    assert whole.bending.shape == (3, 3)
    assert whole.bending[0].tolist() == [0.0, 0.0, 0.0]
    assert len(set(whole.bending[2])) == 1


def test_stretches_are_drawn_to_fit_between_the_joints() -> None:
    near = tuple(replace(one, length=1.0004 * one.length) for one in STEPS)
    found = pieces(with_shaft(segments=near).shafts[1], 1.0)
    assert sum(one.length for one in found) == pytest.approx(1.0, rel=1e-15)
    far = tuple(replace(one, length=1.002 * one.length) for one in STEPS)
    assert fields(segments=far) == ["shafts[1].segments"]
    assert body_length(Shaft(number=1, segments=STEPS), None) == pytest.approx(1.0)
    assert pieces(Shaft(number=1, outer=0.05), None) == ()


@pytest.mark.parametrize(
    ("keys", "found"),
    [
        ({"segments": STEPS, "outer": 0.05}, ["shafts[1].segments"]),
        ({"segments": (Segment(length=1.0, outer=0.05, inner=0.05),)}, ["shafts[1].segments[0].inner"]),
        ({"segments": (Segment(length=1.0, outer=0.0),)}, ["shafts[1].segments[0].outer"]),
        ({"segments": STEPS, "wall": 0.002}, ["shafts[1].wall"]),
        ({"wear_factor": 0.8}, ["shafts[1].wear_factor"]),
        ({"outer": 0.05, "wear_factor": 1.1}, ["shafts[1].wear_factor"]),
        ({"masses": (PointMass(position=0.1, mass=-1.0),)}, ["shafts[1].masses[0].mass"]),
        ({"masses": (PointMass(position=1.1, mass=1.0),)}, ["shafts[1].masses[0].position"]),
        ({"number": 1, "masses": (PointMass(position=0.1, mass=1.0),)}, ["shafts[0].masses[0].position"]),
    ],
)
def test_contradictions(keys: dict[str, object], found: list[str]) -> None:
    assert fields(**keys) == found


def test_files_keep_bodies() -> None:
    drive = with_shaft(
        segments=STEPS, masses=(PointMass(position=0.25, mass=1.5, polar_inertia=2e-3),), wear_factor=0.75
    )
    for form in ("toml", "json"):
        assert loads(dumps(drive, form=form), form=form) == drive


def test_shear_modulus_follows_from_the_others() -> None:
    assert Material().shear_modulus == pytest.approx(7.92e10, rel=1e-3)
    assert Material(shear=5e10).shear_modulus == 5e10


def test_a_composite_tube_weighs_and_bends_as_its_plies():
    ply = Ply(along=135e9, across=10e9, shear=5e9, density=1600.0)
    tube = Shaft(number=2, outer=0.09, layup=Layup(angles=(0.0,) * 6, ply_thickness=5e-4, ply=ply))
    one = pieces(tube, 1.5)[0]
    assert one.inner == pytest.approx(0.084)
    assert one.mass == pytest.approx(1600 * np.pi / 4 * (0.09**2 - 0.084**2) * 1.5)
    assert one.material.youngs == pytest.approx(135e9)
    assert one.material.shear_modulus == pytest.approx(5e9)
