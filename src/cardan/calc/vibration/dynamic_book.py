"""The book's engineering rules for torsional vibration, the solved answers beside them."""

from __future__ import annotations

from typing import Any

import numpy as np

from cardan.book.dynamic_book import TRUCK, truck_example, validity
from cardan.book.engineering_torque import engineering_torque
from cardan.calc.calculation import Formulas, Values
from cardan.maths.periodic.mathieu import LARGEST_A, LARGEST_Q
from cardan.reading.given import Given, at_least_zero, given, gives, positive, rows

from .mathieu import FIRST, LAST, STIFFNESS, WAVE, fields_named, harmonics_of, label, told

formula = Formulas(__doc__)


def defined(value: Any) -> Any:
    """Return numbers with what is not finite undefined."""
    return np.where(np.isfinite(value), value, np.nan)


def by_order(orders: list[float], sizes: Any) -> dict[str, float]:
    """Return amplitudes by their orders; those of one order, whose phases are not known, in the worst case."""
    found: dict[str, float] = {}
    for order, size in zip(orders, sizes, strict=True):
        found[label(order)] = found.get(label(order), 0.0) + float(size)
    return found


def _harmonic_rows(key: str, doc: str) -> Given:
    return rows(
        key,
        doc,
        positive("order", "order per turn of the driving shaft"),
        given("amplitude_Nm", "its amplitude"),
        default=[],
    )


@formula(
    "torque in the last shaft by the book's formula for sizing: mean, second order, orders of drive and load",
    "Book (246)",
    positive("c_Nm_per_rad", "stiffness of all springs in a row"),
    at_least_zero("s_n1", "amplitude of the joints' second order [rad]"),
    positive("a", "parameter a = c/(J_0 ω_1²)"),
    (FIRST, LAST),
    given("drive_torque_mean_Nm", "mean torque"),
    _harmonic_rows("drive_torque_harmonics", "harmonics of the drive torque"),
    _harmonic_rows("load_torque_harmonics", "harmonics of the load"),
    "mean_abs_Nm = mean: mean torque, without sign",
    "order2_joint_abs_Nm = order2: amplitude of second order, from the joints",
    "engine_order_abs_Nm: amplitude of each order of the drive torque",
    "load_order_abs_Nm: amplitude of each order of the load",
    "speed_rad_s = speed: speed that belongs to a",
)
def _dynamic_torque_engineering(v: Values) -> Any:
    drive, drive_torque = harmonics_of(v, "drive_torque_harmonics")
    load, load_torque = harmonics_of(v, "load_torque_harmonics")
    with fields_named({"drive_order": "drive_torque_harmonics[].order", "load_order": "load_torque_harmonics[].order"}):
        found = engineering_torque(
            drive_order=drive,
            drive_torque=drive_torque,
            load_order=load,
            load_torque=load_torque,
            **v.of(
                "a",
                stiffness="c",
                amplitude="s_n1",
                first_inertia="J_first",
                last_inertia="J_last",
                mean="drive_torque_mean",
            ),
        )
    return found, {
        "engine_order_abs_Nm": by_order(drive, found.drive),
        "load_order_abs_Nm": by_order(load, found.load) if load else None,
    }


@formula(
    "whether the parametric term may be neglected: the book's rule, and what that costs when solved",
    "Book (206), (207), (237); harmonic balance",
    (STIFFNESS, WAVE),
    at_least_zero("forcing_orders", "orders of the forcing", axes=1, entries=True),
    "stable = stable: whether steady running is stable",
    "beta: characteristic exponent, where it is",
    "distance_to_resonance: distance of each order from the nearest ±β + 2r",
    "book_237_satisfied = rule: whether Book (237) is met, orders 0, 1 and 2 included",
    "solved_amplitude: amplitude of each order under a unit forcing of it, solved",
    "simplified_amplitude: the same, the parametric term neglected",
    "largest_side_band: largest amplitude at another order, solved",
    "neglecting_q_costs: error of neglecting the parametric term, a share of the simplified amplitude",
    gives(
        "neglecting_q_costs_over_5_percent = too_far", "whether that is more than 5 % anywhere: do not neglect it", None
    ),
)
def _validity_check(v: Values) -> Any:
    with fields_named({"order": "forcing_orders[]"}):
        found = validity(v.a, v.q, v.forcing_orders)
    turning = np.isfinite(found.beta)
    return found, {
        "beta": told(found.beta),
        "distance_to_resonance": found.distance if turning else None,
        "solved_amplitude": defined(found.solved),
        "simplified_amplitude": defined(found.simple),
        "largest_side_band": defined(found.side),
        "neglecting_q_costs": defined(found.error),
    }


@formula(
    "the book's worked example, the power unit of a truck, computed anew",
    "Book pp. 210-216",
    positive("speed_rpm", "speed", default=TRUCK["speed"]),
    positive("a", "parameter a", high=LARGEST_A, default=TRUCK["a"]),
    given("Q2", "forcing of second order, a s_41", default=TRUCK["sway"]),
    given("q", "parametric term as printed", low=-LARGEST_Q, high=LARGEST_Q, default=TRUCK["q"]),
    "speed_squared_rad2_s2: square of the speed",
    "natural_frequency_rad_s = natural_frequency: natural frequency √a ω_1",
    "s_41 = amplitude: amplitude Q_2/a [rad]",
    "beta: characteristic exponent",
    "order2_resonance_speed_rpm = resonance_speed: speed of the resonance of second order",
    "principal_zone_speed_rpm = principal_speed: speed of the principal zone",
)
def _worked_example_truck(v: Values) -> Any:
    found = truck_example(speed=v.speed, a=v.a, q=v.q, sway=v.Q2)
    return found, {"speed_squared_rad2_s2": found.speed**2, "beta": told(found.beta)}
