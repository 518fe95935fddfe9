"""Plies and bond of composite tubes: against closed forms, finite differences and a laminate calculated apart."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_bvp

from cardan import Drive, InputError, strength
from cardan.catalogue.catalogue import ply
from cardan.checks.checks import check
from cardan.drive.duty import Duty
from cardan.drive.material import Material
from cardan.drive.shaft import Bond, Layup, Ply, Shaft
from cardan.formulas.shaft_strength import bond_shear, ply_exposure
from cardan.io import dumps, example, load, loads
from cardan.maths.linear.laminate import ply_stresses

CARBON = ply("CFRP-HT-UD")
CROSSED = Layup(angles=(math.pi / 4, -math.pi / 4), ply_thickness=1e-3, ply=CARBON)


def test_one_ply_along_the_tube_carries_by_its_shear_alone():
    """T/(2πr²t) over S; Tsai and Wu with shear alone is τ/S."""
    straight = replace(CROSSED, angles=(0.0, 0.0))
    found = ply_exposure(straight, 0.09, 1e-3, 500.0)
    tau = 500.0 / (2 * math.pi * 0.045**2 * 2e-3)
    assert float(found.shear) == pytest.approx(tau)
    assert float(found.exposure) == pytest.approx(tau / CARBON.shear_strength)


def test_one_ply_along_the_tube_in_bending_is_pulled_and_pressed():
    """σ = M/(πr²t) on either side; alone along the fibres, the exposure is σ/X of the weaker side."""
    straight = replace(CROSSED, angles=(0.0, 0.0))
    sigma = 800.0 / (math.pi * 0.045**2 * 2e-3)
    found = ply_exposure(straight, 0.09, 1e-3, 0.0, 800.0)
    assert float(found.exposure) == pytest.approx(sigma / CARBON.compression_along)


def test_stresses_of_a_laminate_by_a_calculation_apart():
    """Compliance of each ply turned by the tensor, strains from forces by least squares, for [10/-10/45/-45/90]."""
    angles, t = np.radians([10, -10, 45, -45, 90]), 0.3e-3
    s = np.array([[1 / 135e9, -0.3 / 135e9, 0], [-0.3 / 135e9, 1 / 10e9, 0], [0, 0, 1 / 5e9]])
    whole = np.zeros((3, 3))
    turns = []
    for a in angles:
        c, z = math.cos(a), math.sin(a)
        turn = np.array([[c * c, z * z, 2 * c * z], [z * z, c * c, -2 * c * z], [-c * z, c * z, c * c - z * z]])
        reuter = np.diag([1.0, 1.0, 2.0])
        whole += t * np.linalg.inv(turn) @ np.linalg.inv(s) @ reuter @ turn @ np.linalg.inv(reuter)
        turns.append(turn)
    force = np.array([2e5, -4e4, 1.5e5])
    strain = np.linalg.solve(whole, force)
    there = ply_stresses(angles, [t] * 5, CARBON.stiffness) @ force
    for turn, stress in zip(turns, there, strict=True):
        reuter = np.diag([1.0, 1.0, 2.0])
        own = np.linalg.solve(s, reuter @ turn @ np.linalg.inv(reuter) @ strain)
        np.testing.assert_allclose(stress, own, rtol=1e-10)
    # What the plies carry together is what pulls.
    together = sum(t * np.linalg.inv(turn) @ stress for turn, stress in zip(turns, there, strict=True))
    np.testing.assert_allclose(together, force, rtol=1e-10)


def test_the_exposure_is_the_inverse_of_the_factor_to_failure():
    """Loads over the exposure lie on the surface of Tsai and Wu, here written apart for the ply that is worst off."""
    layup = replace(CROSSED, angles=tuple(np.radians([10, -10, 45, -45])), ply_thickness=0.4e-3)
    found = ply_exposure(layup, 0.08, 0.4e-3, 1500.0, 300.0)
    radius, worst = 0.04, 0.0
    unit = ply_stresses(layup.angles, [0.4e-3] * 4, CARBON.stiffness)
    xt, xc, yt, yc, s = 1500e6, 1200e6, 50e6, 250e6, 70e6
    for way in (1, -1):
        for side in (1, -1):
            force = np.array([side * 300 / math.pi / radius**2, 0, way * 1500 / 2 / math.pi / radius**2])
            for one, two, tau in unit @ force / float(found.exposure):
                worst = max(worst, one * (1 / xt - 1 / xc) + two * (1 / yt - 1 / yc) + one**2 / xt / xc
                            + two**2 / yt / yc + tau**2 / s**2 - one * two / math.sqrt(xt * xc * yt * yc))  # fmt: skip
    assert worst == pytest.approx(1.0, abs=1e-9)


@pytest.mark.parametrize("wall", [None, 3e-3])
def test_the_bond_as_its_differential_equation_says(wall):
    """Twist of tube and end along the lap by a boundary-value solver: dT/dx = 2πa²τ, τ = G a (φ_1 - φ_2)/t."""
    bond = Bond(length=0.05, thickness=0.2e-3, shear=1e9, strength=30e6, wall=wall)
    found = float(bond_shear(bond, CROSSED, 0.092, 1e-3, 1000.0))
    a = 0.044
    shear = 1 / np.linalg.inv(np.linalg.inv(ply_stresses_compliance()))[2, 2]
    tube = shear * 2 * math.pi * 0.045**3 * 2e-3
    end = 1e9 * tube if wall is None else Material().shear_modulus * math.pi / 2 * (a**4 - (a - wall) ** 4)

    def slope(_x, y):
        first, tau = 1e3 * y[0], 1e7 * y[1]
        turned = first / tube - (1000.0 - first) / end
        return np.stack([2e-3 * math.pi * a * a * tau, 1e-7 * 1e9 * a / 0.2e-3 * turned])

    done = solve_bvp(slope, lambda p, q: np.array([p[0] - 1.0, q[0]]), np.linspace(0, 0.05, 200),
                     np.stack([np.linspace(1, 0, 200), np.full(200, -0.2)]), tol=1e-6, max_nodes=50_000)  # fmt: skip
    tau = 1e7 * np.abs(done.sol(np.linspace(0, 0.05, 2001))[1])
    assert done.success
    assert found == pytest.approx(float(np.max(tau)), rel=2e-3)
    # The mean of the stress carries the torque.
    assert 2 * math.pi * a * a * 0.05 * found > 1000.0


def ply_stresses_compliance():
    """Mean compliance of the crossed laminate, from the closed form of ±45: G_xy = E_1/(4(1 + ν_12)) put exactly."""
    q11, q22 = (modulus / (1 - 0.09 * 10 / 135) for modulus in (135e9, 10e9))
    q12 = 0.3 * q22
    g = 0.25 * (q11 + q22 - 2 * q12)
    return np.diag([1.0, 1.0, 1.0 / g])


def tube(layup, **duty):
    shaft = Shaft(number=2, length=1.2, outer=0.09, layup=layup)
    return replace(Drive.from_angles([0.1, 0.1]), shafts=(shaft,), duty=Duty(torque=600.0, **duty))


def test_verdicts_stand_in_strength_and_checks_and_grow_with_the_torque():
    layup = replace(CROSSED, bond=Bond(length=0.05, thickness=0.2e-3, shear=1e9, strength=30e6))
    drive = tube(layup)
    told = [one for one in check(drive, only=["ply_strength"])]
    assert [one.state for one in told] == ["passed"] * 3
    assert {one.title for one in strength(drive).verdicts if one.check == "ply_strength"} == {one.title for one in told}
    twice = check(replace(drive, duty=Duty(torque=1200.0)), only=["ply_strength"])
    for one, two in zip(told, twice, strict=True):
        assert float(two.value) == pytest.approx(2 * float(one.value))
    many = check(drive, only=["ply_strength"], vary={"duty.torque_Nm": [600.0, 1200.0, 9000.0]})
    # Plies at 45° carry the torque along and across their fibres alone.
    assert [bool(one.utilisation[2] > 1.0) for one in many] == [True, False, True]
    np.testing.assert_allclose(many[0].value[:2], [float(told[0].value), float(twice[0].value)])


def test_plies_without_strength_are_not_judged_and_say_what_lacks():
    bare = Ply(along=135e9, across=10e9, shear=5e9)
    (one,) = check(tube(replace(CROSSED, ply=bare)), only=["ply_strength"])
    assert one.missing[0] == "shafts[1].layup.ply.tension_along"
    with pytest.raises(InputError, match="strength of the ply"):
        ply_exposure(replace(CROSSED, ply=bare), 0.09, 1e-3, 100.0)


def test_a_lamina_by_its_name_has_the_figures_of_the_catalogue_and_is_saved_as_a_name():
    drive = example("composite-propshaft")
    assert drive.shafts[1].layup.ply == CARBON
    text = dumps(drive)
    assert 'ply = "CFRP-HT-UD"' in text
    assert loads(text) == drive
    with pytest.raises(InputError, match="CFRP-HT"):
        loads(text.replace("CFRP-HT-UD", "CFRP-HT-XX"))
    with pytest.raises(InputError, match="missing; or name a lamina"):
        loads(text.replace('ply = "CFRP-HT-UD"', "ply = { along_GPa = 135 }"))


def test_the_example_is_read_from_its_file(tmp_path):
    path = tmp_path / "one.toml"
    path.write_text(dumps(example("composite-propshaft")))
    assert load(path).shafts[1].layup.bond is not None
