import pytest

from cardan import InputError, calc

AXLES = {"axles": 3, "wheel_radius_max_m": 0.525, "wheel_radius_min_m": 0.52}
PRESS = {"torque_Nm": 0.5, "radius_m": 0.02, "friction": 0.15, "safety": 2.5}
DISC = {"omega1_rad_s": 10, "roller_radius_m": 0.02, "rho_start_m": 0.005, "rho_end_m": 0.01, "duration_s": 2}
CAM = {
    "r3_m": 0.03,
    "l_m": 0.12,
    "G3_N": 8.0,
    "Q2_N": 20.0,
    "Q4_N": 35.0,
    "beta2_deg": 55,
    "beta4_deg": 60,
    "fE": 0.1,
    "fF": 0.1,
    "fN": 0.12,
    "fS": 0.12,
    "fC": 0.1,
    "fC_end": 0.1,
    "fD": 0.1,
    "psi_deg": 0,
    "zE_m": -0.02,
    "zF_m": 0.03,
    "zP_m": 0.05,
}
UNHELD = {"G3_N": 30, "Q2_N": 10, "Q4_N": 55, "l_m": 0.24, "zP_m": 0.03, "psi_rad": 5.7, "psi_deg": None}


def fields(capability, inputs):
    with pytest.raises(InputError) as caught:
        calc(capability, {key: value for key, value in inputs.items() if value is not None})
    return [problem.field for problem in caught.value.problems]


@pytest.mark.parametrize(
    ("capability", "good", "changed", "named"),
    [
        ("multi_drive", AXLES, {"axles": 0}, ["axles"]),
        ("multi_drive", AXLES, {"axles": 2.5}, ["axles"]),
        ("multi_drive", AXLES, {"wheel_radius_max_m": 0}, ["wheel_radius_max_m"]),
        ("multi_drive", AXLES, {"wheel_radius_min_m": -1}, ["wheel_radius_min_m"]),
        ("multi_drive", AXLES, {"wheel_radius_min_m": 0.6}, ["wheel_radius_min_m"]),
        ("multi_drive", AXLES, {"torque_share": [1, 1]}, ["torque_share"]),
        ("multi_drive", AXLES, {"torque_share": [1, 0, 1]}, ["torque_share"]),
        ("helical_cam", CAM, {"beta2_deg": 12.5}, ["beta2_deg"]),
        ("helical_cam", CAM, {"beta4_deg": 12}, ["beta4_deg"]),
        ("helical_cam", CAM, {"beta2_deg": 12, "beta4_deg": 0}, ["beta4_deg", "beta2_deg"]),
        ("helical_cam", CAM, {"fN": 2.0}, ["beta2_deg"]),
        ("helical_cam", CAM, {"r3_m": 0}, ["r3_m"]),
        ("helical_cam", CAM, {"l_m": 0}, ["l_m"]),
        ("helical_cam", CAM, {"fD": -0.1}, ["fD"]),
        ("helical_cam", CAM, UNHELD, ["psi_rad"]),
        ("friction_drive", PRESS, {"friction": 0}, ["friction"]),
        ("friction_drive", PRESS, {"radius_m": 0}, ["radius_m"]),
        ("friction_drive", PRESS, {"safety": 0.9}, ["safety"]),
        ("friction_drive", PRESS, {"torque_Nm": -1}, ["torque_Nm"]),
        ("disc_integrator", DISC, {"roller_radius_m": 0}, ["roller_radius_m"]),
        ("disc_integrator", DISC, {"duration_s": -1}, ["duration_s"]),
        ("disc_integrator", DISC, {"law": "square"}, ["law"]),
    ],
)
def test_bad_inputs_are_named(capability, good, changed, named):
    calc(capability, good)
    assert fields(capability, good | changed) == named


def test_axles_pull_as_asked():
    found = calc("multi_drive", AXLES | {"torque_share": [2, 1, 1]})
    assert found["torque_share"] == pytest.approx([0.5, 0.25, 0.25], rel=1e-15)
    assert found["simple_ratios"] == pytest.approx([1.0, 1.0], rel=1e-15)
    alone = calc("multi_drive", AXLES | {"axles": 1})
    assert (alone["differentials"], alone["simple_ratios"], alone["torque_share"]) == (0, [], [1.0])


def test_axles_wind_up_until_a_wheel_slips():
    bare = calc("multi_drive", AXLES)
    assert not {"circulating_torque_Nm_per_m", "slips_after_m"} & set(bare)
    found = calc("multi_drive", AXLES | {"stiffness_kNm_per_rad": 20, "slip_torque_kNm": 4})
    assert found["slips_after_m"] * found["windup_rad_per_m"] * 20e3 == pytest.approx(4e3, rel=1e-14)
    even = calc("multi_drive", AXLES | {"wheel_radius_min_m": 0.525, "stiffness_kNm_per_rad": 20, "slip_torque_kNm": 4})
    assert even["windup_rad_per_m"] == 0.0
    assert "slips_after_m" not in even


def test_the_cam_says_how_well_it_is_in_balance():
    found = calc("helical_cam", CAM)
    assert found["imbalance"] < 1e-14
    assert found["P_N"] == pytest.approx(52.886675127229196, rel=1e-12)
    assert calc("helical_cam", CAM | {"psi_deg": 360})["RCn_N"] == pytest.approx(found["RCn_N"], rel=1e-12)


def test_swapped_followers_push_the_other_end():
    """Mirrored end for end, follower 4 is follower 2; the cam turns as before."""
    one = calc("helical_cam", CAM)
    swapped = {"Q2_N": 35, "Q4_N": 20, "beta2_deg": 60, "beta4_deg": 55, "zE_m": -0.03, "zF_m": 0.02, "zP_m": -0.05}
    other = calc("helical_cam", CAM | swapped)
    assert other["sign_zC"] == -one["sign_zC"]
    for key in ("P_N", "RCm_N", "RCn_N", "RDn_N"):
        assert other[key] == pytest.approx(one[key], rel=1e-12)


def test_the_roller_slips_in_the_middle():
    assert calc("disc_integrator", DISC)["warnings"] == []
    found = calc("disc_integrator", DISC | {"rho_start_m": -0.01})
    assert found["warnings"] == ["dead_zone"]
    assert found["phi2_rad"] == pytest.approx(0.0, abs=1e-15)
    assert (found["omega2_start_rad_s"], found["omega2_end_rad_s"]) == pytest.approx((-5.0, 5.0), rel=1e-15)


def test_wheels_of_a_friction_drive_have_a_ratio():
    assert calc("friction_drive", PRESS | {"driving_radius_m": 0.01})["ratio"] == pytest.approx(2.0, rel=1e-15)
    assert "ratio" not in calc("friction_drive", PRESS)
