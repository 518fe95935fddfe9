"""Keys of the calculations of steady running and stability, and what they say about bad input."""

from __future__ import annotations

import copy
import json

import numpy as np
import pytest

from cardan import calc
from cardan.errors import InputError

BASE = {
    "shafts": [
        {"inertia_kgm2": [1.0, 0.02], "stiffness_Nm_per_rad": [4000.0], "damping_Nms_per_rad": [1.0]},
        {"inertia_kgm2": [0.02, 0.4], "stiffness_Nm_per_rad": [6000.0], "damping_Nms_per_rad": [1.0]},
    ],
    "joints": [{"alpha_deg": 20.0, "psi_deg": 0.0}],
    "torques": [{"shaft": 2, "station": 2, "kind": "constant", "value_Nm": -60.0}],
    "input_speed_rad_s": 30.0,
}
BOTH = ("periodic_response", "floquet_stability")


def changed(**more):
    return {key: value for key, value in (copy.deepcopy(BASE) | more).items() if value is not None}


def with_torque(**torque):
    return changed(torques=[*copy.deepcopy(BASE["torques"]), {"shaft": 1, "station": 2, **torque}])


def harmonic(order):
    return with_torque(kind="harmonic", amplitude_Nm=5.0, order=order, phase_deg=10.0)


@pytest.mark.parametrize(
    ("order", "keys"),
    [
        (4.0, ["2", "4", "6", "8", "10"]),
        (3.0, [str(k) for k in range(1, 11)]),
        (1.5, [f"{k / 2:g}" for k in range(1, 21)]),
    ],
)
def test_order_tables_hold_every_multiple_up_to_ten(order: float, keys: list[str]) -> None:
    found = calc("periodic_response", harmonic(order))
    assert list(found["elements"][0]["order_amplitude_Nm"]) == keys
    assert list(found["station_speed_order_amplitude_rad_s"][3]) == keys
    json.dumps(found, allow_nan=False)


def test_the_period_of_the_multipliers_is_that_of_the_torques() -> None:
    half, whole, two = (
        calc("floquet_stability", harmonic(order))["multiplier_period_rad"] for order in (2.0, 1.0, 0.5)
    )
    assert (whole / half, two / half) == (2.0, 4.0)


def test_a_free_drive_tells_its_constant_torque() -> None:
    found = calc("periodic_response", changed(input_speed_rad_s=None, mean_speed_rad_s=30.0))
    assert found["constant_drive_torque_Nm"] == pytest.approx(found["elements"][0]["mean_Nm"], rel=1e-9)
    assert "drive_torque_mean_Nm" not in found
    free = changed(input_speed_rad_s=None, mean_speed_rad_s=30.0)
    assert calc("floquet_stability", free)["multipliers_removed"] == 2
    governed = {"shaft": 1, "station": 1, "kind": "linear_speed", "M0_Nm": 90.0, "slope_Nms_per_rad": 1.0}
    found = calc("floquet_stability", free | {"torques": [*free["torques"], governed]})
    assert found["multipliers_removed"] == 1


def test_stability_leaves_out_an_order_that_does_not_repeat() -> None:
    found = calc("floquet_stability", harmonic(6.8))
    assert found["torques_left_out"] == [2]
    alone = calc("floquet_stability", BASE)
    assert found["spectral_radius"] == alone["spectral_radius"]
    assert "torques_left_out" not in alone


def test_backlash_opens_under_little_load() -> None:
    shafts = copy.deepcopy(BASE["shafts"])
    shafts[0]["gap_rad"] = [0.01]
    found = calc("periodic_response", changed(shafts=shafts))
    assert found["status"] == "converged"
    assert found["elements"][0]["lowest_Nm"] < 0.0
    assert found["stable"] is calc("floquet_stability", changed(shafts=shafts))["stable"]


@pytest.mark.parametrize("name", BOTH)
@pytest.mark.parametrize(
    ("inputs", "field"),
    [
        (changed(input_speed_rad_s=None), "input_speed_rad_s"),
        (changed(input_speed_rad_s=0.0), "input_speed_rad_s"),
        (changed(mean_speed_rad_s=5.0), "mean_speed_rad_s"),
        (changed(input_speed_rad_s=None, mean_speed_rad_s=0.0), "mean_speed_rad_s"),
        (changed(joints=[{"alpha_deg": 90.0, "psi_deg": 0.0}]), "joints[0].alpha_deg"),
        (changed(joints=[]), "joints"),
        (with_torque(kind="time_history", t_s=[0.0, 1.0], M_Nm=[0.0, 1.0]), "torques[1].kind"),
        (with_torque(kind="spring"), "torques[1].kind"),
    ],
)
def test_bad_input_names_its_field(name: str, inputs: dict, field: str) -> None:
    with pytest.raises(InputError) as caught:
        calc(name, inputs)
    assert [problem.field for problem in caught.value.problems] == [field]


def test_a_response_by_orders_needs_orders_that_repeat() -> None:
    with pytest.raises(InputError) as caught:
        calc("periodic_response", harmonic(6.8))
    assert caught.value.field == "torques[1].order"


def test_a_drive_that_only_its_input_moves_is_stable_and_has_no_multipliers() -> None:
    """Both stations follow the forced speed: nothing can be disturbed."""
    shafts = [{"inertia_kgm2": [1.0]}, {"inertia_kgm2": [0.5]}]
    drive = {"shafts": shafts, "joints": [{"alpha_deg": 20.0}], "input_speed_rad_s": 30.0}
    found = calc("floquet_stability", drive)
    assert (found["stable"], found["multiplier_modulus_sorted"]) == (True, [])
    assert (found["spectral_radius"], found["growth_rate_1_per_s"]) == (None, None)
    speeds = calc("periodic_response", drive)["station_speed_order_amplitude_rad_s"]
    assert speeds[0]["2"] == 0.0
    tau = np.tan(np.radians(10.0)) ** 2
    assert speeds[1]["2"] == pytest.approx(30.0 * 2.0 * tau, rel=1e-9)  # T = θ + Σ (τ^k/k) sin 2kθ
