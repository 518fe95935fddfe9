"""Lobed tubes against integrals over their wall and the torsion of its cross section by finite differences."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import spsolve

import cardan
from cardan.checks.design import design
from cardan.checks.strength.part_strength import shaft_strength
from cardan.checks.strength.section import sections
from cardan.drive.body import body_length, pieces, softness, weight
from cardan.drive.profile_tube import profile_section
from cardan.errors import InputError
from cardan.questions.bending.bending import bending_speeds
from cardan.questions.torsion.model.torsional_train import torsional_train

SIZES = [(0.054, 0.046, 0.003, 2), (0.054, 0.046, 0.003, 3), (0.060, 0.052, 0.003, 4)]

FILE = """
format = 1
[[joints]]
joint_angle_deg = 10
[[joints]]
joint_angle_deg = 10
[[shafts]]
number = 2
length_mm = 1000
outer_mm = 54
wall_mm = 3
material = "E355"
{profile}
[[stations]]
shaft = 3
inertia_kg_m2 = 1.0
[duty]
speed_rpm = 540
torque_Nm = 300
"""
LEMON = 'profile = { form = "lemon", inscribed_mm = 46 }'


def contour(outer: float, inscribed: float, lobes: int, angle: np.ndarray) -> np.ndarray:
    return 0.25 * (outer + inscribed) + 0.25 * (outer - inscribed) * np.cos(lobes * angle)


def grid(outer: float, inscribed: float, wall: float, lobes: int, step: float) -> tuple[np.ndarray, ...]:
    """Return places and the shares of a grid of squares that lie in the outer contour, and in the hole."""
    edge = np.arange(-0.5 * outer - 1.5 * step, 0.5 * outer + 2.5 * step, step)
    x, y = np.meshgrid(edge, edge, indexing="ij")
    fine = (np.arange(6) + 0.5) / 6.0 - 0.5
    whole, hole = np.zeros_like(x), np.zeros_like(x)
    for a in fine:
        for b in fine:
            r, phi = np.hypot(x + a * step, y + b * step), np.arctan2(y + b * step, x + a * step)
            limit = contour(outer, inscribed, lobes, phi)
            slope = -0.25 * (outer - inscribed) * lobes * np.sin(lobes * phi)
            # a wall of the thickness t across is t √(1 + (r'/r)²) thick along the radius
            inner = limit - wall * np.sqrt(1.0 + (slope / limit) ** 2)
            whole += (r < limit) / 36.0
            hole += (r < inner) / 36.0
    return x, y, whole, hole


@pytest.mark.slow
@pytest.mark.parametrize(("outer", "inscribed", "wall", "lobes"), SIZES)
def test_area_and_moments_are_those_of_the_wall(outer: float, inscribed: float, wall: float, lobes: int) -> None:
    step = 1e-4
    x, y, whole, hole = grid(outer, inscribed, wall, lobes, step)
    here = (whole - hole) * step**2
    found = profile_section(outer, inscribed, wall, lobes)
    assert found.area == pytest.approx(np.sum(here), rel=0.01)
    across, along = np.sum(here * y**2), np.sum(here * x**2)
    assert found.second_moment == pytest.approx(min(across, along), rel=0.02)
    assert found.polar == pytest.approx(across + along, rel=0.02)
    assert found.round[0] ** 2 - found.round[1] ** 2 == pytest.approx(4.0 * found.area / np.pi)
    assert np.pi / 64.0 * (found.round[0] ** 4 - found.round[1] ** 4) == pytest.approx(float(found.second_moment))


def membrane(size: tuple[float, float, float, int], step: float) -> float:
    """Return I_t = 2 ∫ψ of ∇·(k ∇ψ) = -2 by finite differences, ψ = 0 outside; the hole is a stiff plate, k large."""
    _x, _y, whole, hole = grid(*size, step)
    inside = np.flatnonzero(whole.ravel() > 0.5)
    place = np.full(whole.size, -1)
    place[inside] = np.arange(inside.size)
    pull = np.where(hole.ravel() > 0.5, 1e5, 1.0)
    rows, columns, values = [], [], []
    for shift in (1, -1, whole.shape[1], -whole.shape[1]):
        beside = inside + shift
        k = 2.0 / (1.0 / pull[inside] + 1.0 / pull[beside])
        rows += [np.arange(inside.size)]
        columns += [np.arange(inside.size)]
        values += [k]
        held = place[beside] >= 0
        rows += [np.flatnonzero(held)]
        columns += [place[beside[held]]]
        values += [-k[held]]
    matrix = coo_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns)))).tocsr()
    psi = spsolve(matrix, np.full(inside.size, 2.0 * step**2))
    return float(2.0 * np.sum(psi) * step**2)


@pytest.mark.slow
@pytest.mark.parametrize("size", SIZES)
def test_torsion_is_that_of_prandtls_membrane(size: tuple[float, float, float, int]) -> None:
    # the places outside, where the membrane is held, lie a part of a step off the contour: that goes with the step
    coarse, fine = membrane(size, 4e-4), membrane(size, 2e-4)
    assert profile_section(*size).torsion == pytest.approx(2.0 * fine - coarse, rel=0.01)


def test_a_round_tube_is_nearly_one() -> None:
    outer, inner = 0.054, 0.048
    found = profile_section(outer, outer * (1.0 - 1e-9), 0.003, 2)
    fourth = np.pi * (outer**4 - inner**4)
    assert found.torsion == pytest.approx(fourth / 32.0, rel=0.005)
    assert found.modulus == pytest.approx(fourth / (16.0 * outer), rel=0.005)
    assert found.area == pytest.approx(np.pi / 4.0 * (outer**2 - inner**2))


def drive_of(folder: Path, profile: str = LEMON) -> cardan.Drive:
    path = folder / "pto.toml"
    path.write_text(FILE.format(profile=profile), encoding="utf-8")
    return cardan.load(path)


def test_mass_whirl_twist_and_stress_follow_the_section(tmp_path: Path) -> None:
    drive = drive_of(tmp_path)
    shaft, found = drive.shafts[1], profile_section(0.054, 0.046, 0.003, 2)
    (piece,) = pieces(shaft, body_length(shaft, 1.0))
    steel = piece.material
    held = weight(shaft, 1.0)
    assert held.mass == pytest.approx(steel.density * float(found.area))
    assert held.inertia == pytest.approx(steel.density * float(found.polar))
    assert softness(shaft, 1.0).bending[0] == pytest.approx(1.0 / (steel.youngs * float(found.second_moment)))
    omega = np.pi**2 * np.sqrt(steel.youngs * float(found.second_moment) / (steel.density * float(found.area)))
    critical = bending_speeds(drive).speed[0]
    assert critical == pytest.approx(omega, rel=0.02)  # Timoshenko's beam is a little softer
    (stiffness,) = [c for c in torsional_train(drive).model.stiffness if c < 1e7]
    assert stiffness == pytest.approx(steel.shear_modulus * float(found.torsion))
    told = shaft_strength(design(drive), 1)
    assert told.twist == pytest.approx(told.torque / stiffness, rel=1e-6)
    assert told.stress.torsion == pytest.approx(told.torque / float(found.modulus), rel=1e-6)


def test_buckling_of_a_lobed_wall_says_why_it_is_not_judged(tmp_path: Path) -> None:
    (lobed,) = cardan.check(drive_of(tmp_path), only=("tube_buckling",))
    (round_tube,) = cardan.check(drive_of(tmp_path, ""), only=("tube_buckling",))
    assert lobed.state == "not_run"
    assert "formula" in lobed.unfit
    assert lobed.subject == round_tube.subject == "shafts[1]"
    assert round_tube.state == "passed"


def test_sections_vary_with_every_size(tmp_path: Path) -> None:
    vary = {"shafts[1].profile.inscribed_mm": np.asarray([44.0, 50.0])}
    (section,) = sections(design(drive_of(tmp_path), vary=vary), 1)
    for k, inscribed in enumerate((0.044, 0.050)):
        alone = profile_section(0.054, inscribed, 0.003, 2)
        assert section.torsion[k] == pytest.approx(float(alone.torsion))
    assert "shafts[1].profile.inscribed" in section.design_variables


@pytest.mark.parametrize(
    ("profile", "field"),
    [
        ('profile = { form = "lemon", inscribed_mm = 56 }', "shafts[1].profile.inscribed"),
        ('profile = { form = "star", inscribed_mm = 46 }', "shafts[1].profile.lobes"),
        ('profile = { form = "lemon", inscribed_mm = 46, lobes = 3 }', "shafts[1].profile.lobes"),
        (f"{LEMON}\ncrack = {{ depth_ratio = 0.2 }}", "shafts[1].profile"),
    ],
)
def test_a_contour_that_cannot_be_is_refused(tmp_path: Path, profile: str, field: str) -> None:
    with pytest.raises(InputError) as caught:
        drive_of(tmp_path, profile)
    assert any(problem.field.startswith(field) for problem in caught.value.problems)
