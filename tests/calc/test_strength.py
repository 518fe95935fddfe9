"""Calculations of strength against integrals, tensors and searches made here."""

import math

import numpy as np
import pytest

from cardan import InputError, calc

RNG = np.random.default_rng(7)


def refused(capability, inputs):
    with pytest.raises(InputError) as caught:
        calc(capability, inputs)
    return {(problem.field, problem.code) for problem in caught.value.problems}


def ring(outer, inner, places=400):
    """Gauss points of a ring: radius, angle, area [mm²]."""
    x, w = np.polynomial.legendre.leggauss(40)
    r = 0.25 * (outer - inner) * x + 0.25 * (outer + inner)
    angle = 2 * math.pi * np.arange(places) / places
    area = (0.25 * (outer - inner) * w * r)[:, None] * np.full(places, 2 * math.pi / places)
    return r[:, None] + 0 * angle, angle + 0 * r[:, None], area


def test_stresses_of_a_shaft_are_those_of_the_tensor():
    torque, bending, outer, inner = 1700.0, 640.0, 62.0, 51.0
    r, angle, area = ring(outer, inner)
    polar, across = np.sum(area * r**2), np.sum(area * (r * np.sin(angle)) ** 2)
    tau, sigma = 1e3 * torque * 0.5 * outer / polar, 1e3 * bending * 0.5 * outer / across
    principal = np.linalg.eigvalsh([[sigma, tau, 0], [tau, 0, 0], [0, 0, 0]])
    found = calc("shaft_stress", {"torque_Nm": torque, "bending_Nm": bending, "d_out_mm": outer, "d_in_mm": inner})
    assert found["tau_torsion_MPa"] == pytest.approx(tau, rel=1e-12)
    assert found["tau_resultant_MPa"] == pytest.approx(0.5 * (principal[-1] - principal[0]), rel=1e-12)
    deviator = principal - principal.mean()
    assert found["sigma_mises_MPa"] == pytest.approx(math.sqrt(1.5 * np.sum(deviator**2)), rel=1e-12)


def test_the_diameter_found_carries_just_the_torque():
    found = calc("shaft_diameter", {"torque_Nm": 930.0, "tau_allow_MPa": 71.0, "bore_ratio": 0.83})["d_out_mm"]
    back = calc("shaft_stress", {"torque_Nm": 930.0, "bending_Nm": 0.0, "d_out_mm": found, "d_in_mm": 0.83 * found})
    assert back["tau_torsion_MPa"] == pytest.approx(71.0, rel=1e-12)


def test_the_teeth_carry_the_torque_by_their_moments():
    """Torque = force on each tooth that carries times the mean radius; stress = force over its own area."""
    inputs = {"torque_Nm": 800.0, "D_mm": 42.0, "d_mm": 36.0, "teeth": 8, "tooth_width_mm": 7.0} | {
        "length_mm": 80.0,
        "chamfer_mm": 0.4,
    }
    found = calc("spline", inputs | {"load_share": 0.6})
    height, carrying, radius = 3.0 - 0.8, 0.6 * 8, 19.5e-3
    assert found["sigma_crush_MPa"] * height * 80.0 * carrying * radius == pytest.approx(800.0, rel=1e-12)
    assert found["tau_tooth_MPa"] * 7.0 * 80.0 * carrying * radius == pytest.approx(800.0, rel=1e-12)
    assert refused("spline", inputs | {"chamfer_mm": 1.5}) == {("chamfer_mm", "out_of_range")}


@pytest.mark.slow
@pytest.mark.parametrize(("height", "width"), [(32.0, 22.0), (20.0, 50.0), (25.0, 25.0)])
def test_a_rectangle_twists_as_prandtl_s_membrane_has_it(height, width):
    """Poisson's equation on the section by sines, a double series in place of Saint-Venant's single one."""
    m, n = np.meshgrid(np.arange(1, 4000, 2), np.arange(1, 4000, 2), indexing="ij")
    long, short = max(height, width), min(height, width)
    weight = 32.0 / (math.pi**4 * m * n * ((m / long) ** 2 + (n / short) ** 2))
    moment = 2.0 * np.sum(weight * (2 * long / (m * math.pi)) * (2 * short / (n * math.pi)))
    # slope of the membrane in the middle of the long side
    slope = np.sum(weight * np.sin(0.5 * m * math.pi) * n * math.pi / short)
    inputs = {"journal_force_N": 9000.0, "bending_arm_mm": 0.0, "torsion_arm_mm": 14.0}
    section = {"shape": "rect", "height_mm": height, "width_mm": width}
    found = calc("yoke", inputs | {"section": section})
    assert found["tau_torsion_MPa"] == pytest.approx(
        9000.0 * 14.0 * slope / moment, rel=2e-3
    )  # the slope converges like 1/n


def test_shear_in_a_journal_is_that_of_the_static_moment():
    diameter, bore, force = 22.0, 9.0, 17000.0
    r, angle, area = ring(diameter, bore)
    upper = r * np.sin(angle) * (np.sin(angle) > 0)
    static, inertia = np.sum(area * upper), np.sum(area * (r * np.sin(angle)) ** 2)
    inputs = {"journal_force_N": force, "d_mm": diameter, "bore_mm": bore, "length_mm": 20.0}
    found = calc("journal", inputs)
    assert found["tau_max_MPa"] == pytest.approx(force * static / (inertia * (diameter - bore)), rel=1e-4)  # 400 places
    assert found["sigma_bending_MPa"] == pytest.approx(force * 10.0 * 0.5 * diameter / inertia, rel=1e-12)
    assert refused("journal", inputs | {"bore_mm": 22.0}) == {("bore_mm", "out_of_range")}


def test_fatigue_lies_on_goodman_s_line():
    """Loads times the safety found stand on the line; a life found gives its own stress back."""
    inputs = {
        "T_mean_Nm": 900.0, "T_alt_Nm": 210.0, "M_mean_Nm": 15.0, "M_alt_Nm": 120.0, "d_out_mm": 44.0, "d_in_mm": 30.0,
        "Sut_MPa": 600.0, "Sy_MPa": 355.0, "finish": "machined", "Kf": 1.4, "Kfs": 1.2, "reliability_percent": 99,
    }  # fmt: skip
    found = calc("fatigue", inputs)
    n = found["n_goodman"]
    scaled = {key: value * n if key.endswith("_Nm") else value for key, value in inputs.items()}
    assert calc("fatigue", scaled)["n_goodman"] == pytest.approx(1.0, rel=1e-12)
    heavy = {key: 1.7 * value if key.endswith("_Nm") else value for key, value in scaled.items()}
    tired = calc("fatigue", heavy)
    assert tired["n_goodman"] < 1.0
    level = 0.9 * 600.0
    slope = math.log10(level / tired["Se_MPa"]) / 3.0
    stress = level * (tired["life_cycles"] / 1e3) ** -slope  # 0.9 S_ut at 1000 cycles, S_e at a million
    assert stress == pytest.approx(tired["sigma_a_eq_MPa"] / (1.0 - tired["sigma_m_eq_MPa"] / 600.0), rel=1e-9)
    assert refused("fatigue", inputs | {"Sy_MPa": 700.0}) == {("Sy_MPa", "inconsistent")}


def test_a_composite_of_one_material_is_that_material():
    """Plies of an isotropic sheet at any angles: E_x = E_y = E, G = E/(2(1+ν)), buckling and whirl as of metal."""
    young, poisson = 70.0, 0.3
    inputs = {
        "layup_deg": [10, -35, 80], "ply_thickness_mm": 0.7, "mean_d_mm": 80.0, "length_mm": 1400.0, "E1_GPa": young,
        "E2_GPa": young, "G12_GPa": 0.5 * young / (1 + poisson), "nu12": poisson, "density_kg_m3": 2700.0,
    }  # fmt: skip
    found = calc("composite_tube", inputs)
    assert found["E_x_GPa"] == pytest.approx(young, rel=1e-12)
    assert found["G_xy_GPa"] == pytest.approx(0.5 * young / (1 + poisson), rel=1e-12)
    outer, inner, length = 0.0821, 0.0779, 1.4
    area, second = math.pi * (outer**2 - inner**2) / 4, math.pi * (outer**4 - inner**4) / 64
    whirl = (math.pi / length) ** 2 * math.sqrt(young * 1e9 * second / (2700.0 * area)) * 30 / math.pi
    assert found["n_critical_rpm"] == pytest.approx(whirl, rel=1e-12)
    assert found["mass_kg"] == pytest.approx(2700.0 * area * length, rel=1e-12)


def test_the_design_torque_is_what_engine_and_wheels_allow():
    whole = {"kind": "halfshaft", "engine_power_W": 29500.0, "engine_speed_rpm": 2000.0, "gear_ratio": 3.0}
    whole |= {"axle_ratio": 4.5, "wheel_load_N": 7357.5, "friction": 0.6, "wheel_radius_m": 0.355}
    found = calc("design_torque", whole)
    engine = 29.5e3 / (2000.0 * math.pi / 30.0)
    assert found["torque_drive_Nm"] == pytest.approx(engine * 13.5, rel=1e-12)
    assert (found["torque_design_Nm"], found["governed_by"]) == (pytest.approx(0.6 * 7357.5 * 0.355), "adhesion")
    assert calc("design_torque", whole | {"wheel_load_N": 0.0})["torque_design_Nm"] == 0.0  # lifted wheels
    assert refused("design_torque", whole | {"friction": -0.1}) == {("friction", "negative")}
    before = calc("design_torque", whole | {"kind": "propshaft"})
    assert before["torque_design_Nm"] * 4.5 == pytest.approx(found["torque_design_Nm"], rel=1e-12)


def test_the_thrust_alone_is_that_in_the_joint():
    joint = calc("spline_axial_force", {"alpha_deg": 12, "phi1_deg": 30, "M2_Nm": 400, "mu": 0.1, "d_spline_m": 0.04})
    alone = calc("spline_axial_force", {"torque_Nm": 400, "friction": 0.1, "d_m_mm": 40})
    assert joint["T_N"] == pytest.approx(alone["axial_force_N"], rel=1e-12) == pytest.approx(2 * 0.1 * 400 / 0.04)


def test_a_bore_too_wide_is_named_as_it_was_given():
    segment = {"length_m": 1.0, "d_out_m": 0.05, "d_in_m": 0.06}
    found = refused("shaft_twist", {"torque_Nm": 1.0, "G_GPa": 80.0, "segments": [segment]})
    assert found == {("segments[0].d_in_m", "out_of_range")}
