"""Calculations of cracked shafts: other values than the cases', and bad input under its own key."""

import numpy as np
import pytest

from cardan import InputError, calc

ROTOR = {"mass_kg": 0.617, "damping_ratio": 0.02, "k0_N_per_m": 18875.0, "loss_xi": 0.1, "loss_eta": 0.02}
ROTOR |= {"breathing": "cos^(2m)(theta/2)", "breathing_m": 1, "unbalance_kgm": 4e-6, "speed_ratio": 0.5}
SHAFTS = {"alpha_deg": 6.0, "psi_deg": 90.0, "speed_rad_s": 80.0, "loss_xi": 0.1, "loss_eta": 0.02, "t_end_s": 0.01}
SHAFTS |= {"k1_N_per_m": 18875.0, "k2_N_per_m": 18875.0, "M1_kg": 0.617, "M2_kg": 0.617, "mu1_kg": 4e-4}
SHAFTS |= {"mu2_kg": 4e-4, "e1_m": 0.01, "e2_m": 0.01, "J1_kgm2": 6e-4, "J2_kgm2": 5e-4, "K1T_Nm_per_rad": 120.0}
SHAFTS |= {"C1T_Nms_per_rad": 0.01, "c1_Ns_per_m": 4.0, "c2_Ns_per_m": 4.0, "breathing_m": 1}
SECTION = {"radius_m": 0.005, "delta": 0.45}
JOINT = {"alpha_deg": 20.0, "psi_deg": 30.0}


def fields(capability, inputs):
    with pytest.raises(InputError) as caught:
        calc(capability, inputs)
    return [problem.field for problem in caught.value.problems]


@pytest.mark.parametrize(
    ("capability", "inputs", "named"),
    [
        ("crack_section", SECTION | {"radius_m": 0.0}, ["radius_m"]),
        ("crack_section", SECTION | {"delta": 2.0}, ["delta"]),
        ("crack_section", SECTION | {"delta": -0.1, "radius_m": -1.0}, ["radius_m", "delta"]),
        ("crack_breathing", {"m": 0}, ["m"]),
        ("crack_breathing", {"m": 1.5}, ["m"]),
        ("unbalance_behind_joint", JOINT | {"alpha_deg": 90.0}, ["alpha_deg"]),
        ("unbalance_behind_joint", JOINT | {"alpha_deg": -1.0}, ["alpha_deg"]),
        ("cracked_rotor_response", ROTOR | {"breathing": "hinge"}, ["breathing"]),
        ("cracked_rotor_response", ROTOR | {"speed_ratio": 0.0}, ["speed_ratio"]),
        ("cracked_rotor_response", ROTOR | {"loss_xi": 0.0, "loss_eta": 0.0, "damping_ratio": 0.0, "speed_ratio": 1.0},
         ["speed_ratio"]),
        ("cracked_two_shaft_model", SHAFTS | {"t_end_s": 0.0}, ["t_end_s"]),
        ("cracked_two_shaft_model", SHAFTS | {"t_end_s": 1e6}, ["t_end_s"]),
        ("cracked_two_shaft_model", SHAFTS | {"alpha_deg": 90.0, "loss_eta": 1.0}, ["alpha_deg", "loss_eta"]),
    ]
    + [("cracked_rotor_response", ROTOR | {key: bad}, [key]) for key, bad in (
        ("mass_kg", 0.0), ("k0_N_per_m", -1.0), ("damping_ratio", -0.1), ("loss_xi", 1.0), ("loss_eta", -0.1),
        ("breathing_m", 0), ("unbalance_kgm", -1e-6))]
    + [("cracked_two_shaft_model", SHAFTS | {key: -1.0}, [key]) for key in SHAFTS
       if key not in ("psi_deg", "breathing_m")],
)  # fmt: skip
def test_bad_cracked_shafts_are_named(capability, inputs, named):
    assert fields(capability, inputs) == named


def test_many_speeds_are_single_ones():
    many = calc("cracked_rotor_response", ROTOR | {"speed_ratio": [0.4, 0.5, 1.9]})
    one = calc("cracked_rotor_response", ROTOR)
    assert many["stable"] == [True, True, True]
    assert many["order_amplitude_complex_m"]["2"][1] == pytest.approx(one["order_amplitude_complex_m"]["2"], rel=1e-12)
    assert one["half_order_unstable"] is False


def test_other_units_and_defaults():
    grams = {key: value for key, value in ROTOR.items() if key not in ("unbalance_kgm", "breathing", "breathing_m")}
    found = calc("cracked_rotor_response", grams | {"unbalance_g_mm": 4.0})
    assert found == calc("cracked_rotor_response", ROTOR)
    sections = calc("crack_section", {"radius_mm": [5, 20], "delta": 0.45})
    np.testing.assert_allclose(np.divide(*sections["Ix_centroidal_m4"]), 4.0**-4, rtol=1e-12)
    joints = calc("unbalance_behind_joint", {"alpha_deg": [6, 20]})["force_order_over_meOmega2"]
    assert joints["3"][1] == pytest.approx(calc("unbalance_behind_joint", JOINT)["force_order_over_meOmega2"]["3"])
    shafts = calc("cracked_two_shaft_model", SHAFTS)
    assert shafts["energy_residual"] < 1e-9
    assert shafts == calc("cracked_two_shaft_model", SHAFTS | {"gravity_m_s2": 9.81})
