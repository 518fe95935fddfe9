"""torsional_simulation by its keys: units, defaults, and every fault under the name it was given by."""

from __future__ import annotations

import copy
from typing import Any

import numpy as np
import pytest

from cardan import InputError, calc

DRIVE: dict[str, Any] = {
    "shafts": [
        {"inertia_kgm2": [1.2, 0.05], "stiffness_Nm_per_rad": [4000.0], "damping_Nms_per_rad": [1.0]},
        {"inertia_kgm2": [0.03, 0.6], "stiffness_Nm_per_rad": [5000.0], "damping_Nms_per_rad": [0.8]},
    ],
    "joints": [{"alpha_deg": 20.0, "psi_deg": 15.0}],
    "torques": [{"shaft": 2, "station": 2, "kind": "constant", "value_Nm": -40.0}],
    "input_speed_rad_s": 60.0,
    "t_end_s": 0.02,
}


def changed(path: str, value: Any) -> dict[str, Any]:
    """Return the drive with one value in another place: "shafts.0.inertia_kgm2"."""
    drive = copy.deepcopy(DRIVE)
    place: Any = drive
    *way, last = path.split(".")
    for name in way:
        place = place[int(name) if name.isdecimal() else name]
    if value is None:
        del place[last]
    else:
        place[int(last) if last.isdecimal() else last] = value
    return drive


def fields(inputs: dict[str, Any]) -> list[str]:
    with pytest.raises(InputError) as caught:
        calc("torsional_simulation", inputs)
    return [problem.field for problem in caught.value.problems]


@pytest.mark.parametrize(
    ("path", "value", "field"),
    [
        ("joints.0.alpha_deg", 90.0, "joints[0].alpha_deg"),
        ("joints.0.alpha_deg", -1.0, "joints[0].alpha_deg"),
        ("joints.0.alpha_deg", None, "joints[0].alpha_deg"),
        ("joints.0.psi_deg", float("nan"), "joints[0].psi_deg"),
        ("joints", [], "joints"),
        ("joints", DRIVE["joints"] * 2, "joints"),
        ("shafts", [], "shafts"),
        ("shafts.0.inertia_kgm2", [1.2, -0.05], "shafts[0].inertia_kgm2[1]"),
        ("shafts.1.inertia_kgm2", [float("inf"), 0.6], "shafts[1].inertia_kgm2[0]"),
        ("shafts.1.inertia_kgm2", [], "shafts[1].inertia_kgm2"),
        ("shafts.0.stiffness_Nm_per_rad", [0.0], "shafts[0].stiffness_Nm_per_rad[0]"),
        ("shafts.0.stiffness_Nm_per_rad", [1.0, 2.0], "shafts[0].stiffness_Nm_per_rad"),
        ("shafts.1.stiffness_Nm_per_rad", None, "shafts[1].stiffness_Nm_per_rad"),
        ("shafts.1.damping_Nms_per_rad", [-0.1], "shafts[1].damping_Nms_per_rad[0]"),
        ("shafts.1.damping_Nms_per_rad", [0.1, 0.1], "shafts[1].damping_Nms_per_rad"),
        ("shafts.0.gap_rad", [-0.1], "shafts[0].gap_rad[0]"),
        ("shafts.0.ground_damping_Nms_per_rad", [0.1], "shafts[0].ground_damping_Nms_per_rad"),
        ("shafts.0.colour", 1, "shafts[0].colour"),
        ("torques.0.station", 3, "torques[0].station"),
        ("torques.0.station", 0, "torques[0].station"),
        ("torques.0.station", 1.5, "torques[0].station"),
        ("torques.0.shaft", 3, "torques[0].station"),
        ("torques.0.kind", "constnat", "torques[0].kind"),
        ("torques.0.kind", None, "torques[0].kind"),
        ("torques.0.value_Nm", None, "torques[0].value_Nm"),
        ("torques.0.order", 2.0, "torques[0].order"),
        ("t_end_s", 0.0, "t_end_s"),
        ("t_end_s", -1.0, "t_end_s"),
        ("t_end_s", None, "t_end_s"),
        ("initial_angles_rad", [0.0, 0.0], "initial_angles_rad"),
        ("initial_angles_rad", [0.0, 0.0, float("nan")], "initial_angles_rad[2]"),
        ("input_speed_rad_s", "fast", "input_speed_rad_s"),
    ],
)
def test_a_fault_is_named_by_its_key(path: str, value: Any, field: str) -> None:
    assert fields(changed(path, value)) == [field]


@pytest.mark.parametrize(
    ("row", "field"),
    [
        ({"kind": "time_history", "t_s": [0.0, 2.0, 1.0], "M_Nm": [0.0, 1.0, 2.0]}, "t_s"),
        ({"kind": "time_history", "t_s": [0.0, 0.0], "M_Nm": [0.0, 1.0]}, "t_s"),
        ({"kind": "time_history", "t_s": [0.0, 1.0], "M_Nm": [0.0]}, "M_Nm"),
        ({"kind": "time_history", "t_s": [], "M_Nm": []}, "t_s"),
        ({"kind": "speed_table", "omega_rpm": [10.0, 5.0], "M_Nm": [0.0, 1.0]}, "omega_rpm"),
        ({"kind": "speed_table", "omega_rad_s": [0.0, 5.0], "M_Nm": [0.0, float("nan")]}, "M_Nm[1]"),
        (
            {"kind": "asynchronous", "omega_sync_rad_s": 0.0, "M_pullout_Nm": 1.0, "slip_pullout": 0.1},
            "omega_sync_rad_s",
        ),
        ({"kind": "asynchronous", "omega_sync_rad_s": 9.0, "M_pullout_Nm": 1.0, "slip_pullout": 0.0}, "slip_pullout"),
        ({"kind": "harmonic", "amplitude_Nm": 9.0}, "order"),
        ({"kind": "linear_speed", "M0_Nm": 9.0}, "slope_Nms_per_rad"),
    ],
)
def test_a_fault_of_a_torque_is_named_by_its_key(row: dict[str, Any], field: str) -> None:
    drive = changed("torques.0", {"shaft": 1, "station": 1} | row)
    assert fields(drive) == [f"torques[0].{field}"]


def test_a_group_without_inertia_spring_and_damper_is_named() -> None:
    rigid = [{"inertia_kgm2": [0.0]}, {"inertia_kgm2": [0.0]}]
    drive = {"shafts": rigid, "joints": DRIVE["joints"], "initial_speed_rad_s": 1.0, "t_end_s": 1.0}
    assert fields(drive) == ["shafts[0].inertia_kgm2[0]"]
    rigid[1]["inertia_kgm2"] = [0.3]
    assert calc("torsional_simulation", drive)["energy_J"] > 0.0  # the joint carries the inertia of both


def test_a_free_drive_without_any_inertia_is_named_unless_something_brakes_it() -> None:
    weightless = {"inertia_kgm2": [0.0, 0.0], "stiffness_Nm_per_rad": [10.0]}
    drive = {"shafts": [weightless, weightless], "joints": DRIVE["joints"], "t_end_s": 0.1}
    assert fields(drive) == ["shafts[0].inertia_kgm2"]
    push = {"shaft": 1, "station": 1, "kind": "constant", "value_Nm": 3.0}
    assert fields(drive | {"torques": [push]}) == ["shafts[0].inertia_kgm2"]
    assert calc("torsional_simulation", drive | {"input_speed_rad_s": 5.0})["station_speed_rad_s"][0] == 5.0
    braked = weightless | {"ground_damping_Nms_per_rad": [0.0, 2.0]}
    found = calc("torsional_simulation", drive | {"shafts": [braked], "joints": [], "torques": [push]})
    assert found["station_speed_rad_s"] == pytest.approx([1.5, 1.5], rel=1e-9)  # 3 N·m against 2 N·m·s/rad
    running = {"shaft": 1, "station": 2, "kind": "linear_speed", "M0_Nm": 8.0, "slope_Nms_per_rad": 2.0}
    found = calc("torsional_simulation", drive | {"shafts": [weightless], "joints": [], "torques": [running]})
    assert found["station_speed_rad_s"] == pytest.approx([4.0, 4.0], rel=1e-9)


def test_all_faults_are_told_at_once() -> None:
    drive = changed("joints.0.alpha_deg", 95.0)
    drive["shafts"][1]["stiffness_Nm_per_rad"] = [-1.0]
    drive["torques"][0]["kind"] = "x"
    drive["t_end_s"] = 0.0
    assert fields(drive) == [
        "shafts[1].stiffness_Nm_per_rad[0]",
        "joints[0].alpha_deg",
        "torques[0].kind",
        "t_end_s",
    ]


def test_other_units_and_left_out_keys_mean_the_same() -> None:
    wanted = calc("torsional_simulation", DRIVE)
    drive = copy.deepcopy(DRIVE)
    drive["shafts"][0] = {
        "inertia_kg_cm2": [12000.0, 500.0],
        "stiffness_kNm_per_rad": [4.0],
        "damping_Nms_per_rad": [1.0],
        "gap_deg": [0.0],
        "ground_damping_Nms_per_rad": [0.0, 0.0],
    }
    drive["joints"] = [{"alpha_rad": np.radians(20.0), "psi_rad": np.radians(15.0)}]
    del drive["input_speed_rad_s"], drive["t_end_s"]
    drive |= {"input_speed_rpm": 600.0 * 3.0 / np.pi, "t_end_ms": 20.0}
    found = calc("torsional_simulation", drive)
    for key in ("station_angle_rad", "station_speed_rad_s", "element_torque_Nm"):
        assert found[key] == pytest.approx(wanted[key], rel=1e-8)
    straight = calc("torsional_simulation", changed("joints.0.psi_deg", 0.0))
    assert calc("torsional_simulation", changed("joints.0.psi_deg", None)) == straight


def test_what_starts_a_drive() -> None:
    free = changed("input_speed_rad_s", None)
    still = calc("torsional_simulation", free | {"torques": []})
    assert still["energy_J"] == 0.0
    turning = calc("torsional_simulation", free | {"torques": [], "initial_speed_rad_s": 60.0, "t_end_s": 1e-6})
    assert turning["energy_J"] == pytest.approx(0.5 * 3600.0 * (1.25 + 0.6) + 0.5 * 0.03 * turning_square(), rel=1e-6)
    both = calc("torsional_simulation", DRIVE | {"initial_speed_rad_s": 10.0, "t_end_s": 1e-7})
    assert both["station_speed_rad_s"] == pytest.approx([60.0, 10.0, turning_square() ** 0.5 / 6.0, 10.0], rel=1e-3)
    twisted = calc(
        "torsional_simulation", free | {"torques": [], "initial_angles_rad": [0.0, 0.0, 0.02], "t_end_s": 1e-6}
    )
    assert twisted["element_torque_Nm"][1] == pytest.approx(-100.0, rel=1e-4)


def turning_square() -> float:
    """Return the square of the speed of the driven yoke at the start, 15° after the plane of the shafts."""
    alpha, psi = np.radians(20.0), np.radians(15.0)
    return float((60.0 * np.cos(alpha) / (1.0 - (np.sin(alpha) * np.cos(psi)) ** 2)) ** 2)


@pytest.mark.slow
def test_a_motion_without_bounds_is_an_error_that_says_when() -> None:
    drive = changed(
        "torques.0", {"shaft": 1, "station": 1, "kind": "linear_speed", "M0_Nm": 9.0, "slope_Nms_per_rad": -90.0}
    )
    del drive["input_speed_rad_s"]
    with pytest.raises(InputError, match=r"t_end_s: the motion leaves all bounds at 0\.\d+ s"):
        calc("torsional_simulation", drive | {"t_end_s": 2.0})
