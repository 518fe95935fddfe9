"""Calculations of the book's engineering rules for torsional vibration, the solved answers beside them."""

from __future__ import annotations

from typing import Any

import numpy as np

from cardan.book.dynamic_book import TRUCK, truck_example, validity
from cardan.book.engineering_torque import engineering_torque
from cardan.calc.calculation import Calculation, Given, Values, given, gives, rows
from cardan.maths.periodic.mathieu import LARGEST_A, LARGEST_Q
from cardan.texts import mark

from .mathieu import FIRST, LAST, STIFFNESS, WAVE, fields_named, harmonics_of, label, told


def defined(value: Any) -> Any:
    """Return numbers with what is not finite undefined."""
    return np.where(np.isfinite(value), value, np.nan)


def by_order(orders: list[float], sizes: Any) -> dict[str, float]:
    """Return amplitudes by their orders; those of one order, whose phases are not known, in the worst case."""
    found: dict[str, float] = {}
    for order, size in zip(orders, sizes, strict=True):
        found[label(order)] = found.get(label(order), 0.0) + float(size)
    return found


def _engineering(values: Values) -> Values:
    drive, drive_torque = harmonics_of(values, "drive_torque_harmonics")
    load, load_torque = harmonics_of(values, "load_torque_harmonics")
    with fields_named({"drive_order": "drive_torque_harmonics[].order", "load_order": "load_torque_harmonics[].order"}):
        found = engineering_torque(
            stiffness=values["c"],
            amplitude=values["s_n1"],
            a=values["a"],
            first_inertia=values["J_first"],
            last_inertia=values["J_last"],
            mean=values["drive_torque_mean"],
            drive_order=drive,
            drive_torque=drive_torque,
            load_order=load,
            load_torque=load_torque,
        )
    return {
        "mean_abs_Nm": found.mean,
        "order2_joint_abs_Nm": found.order2,
        "engine_order_abs_Nm": by_order(drive, found.drive),
        "load_order_abs_Nm": by_order(load, found.load) if load else None,
        "speed_rad_s": found.speed,
    }


def _validity(values: Values) -> Values:
    with fields_named({"order": "forcing_orders[]"}):
        found = validity(values["a"], values["q"], values["forcing_orders"])
    turning = np.isfinite(found.beta)
    return {
        "stable": found.stable,
        "beta": told(found.beta),
        "distance_to_resonance": found.distance if turning else None,
        "book_237_satisfied": found.rule,
        "solved_amplitude": defined(found.solved),
        "simplified_amplitude": defined(found.simple),
        "largest_side_band": defined(found.side),
        "neglecting_q_costs": defined(found.error),
        "neglecting_q_costs_over_5_percent": found.too_far,
    }


def _truck(values: Values) -> Values:
    found = truck_example(speed=values["speed"], a=values["a"], q=values["q"], sway=values["Q2"])
    return {
        "speed_squared_rad2_s2": found.speed**2,
        "natural_frequency_rad_s": found.natural_frequency,
        "s_41": found.amplitude,
        "beta": told(found.beta),
        "order2_resonance_speed_rpm": found.resonance_speed,
        "principal_zone_speed_rpm": found.principal_speed,
    }


def _harmonic_rows(key: str, doc: str) -> Given:
    return rows(
        key,
        doc,
        given("order", mark("order per turn of the driving shaft"), above=0.0),
        given("amplitude_Nm", mark("its amplitude"), "torque"),
        default=[],
    )


CALCULATIONS: tuple[Calculation, ...] = (
    Calculation(
        name="dynamic_torque_engineering",
        doc=mark(
            "torque in the last shaft by the book's formula for sizing: mean, second order, orders of drive and load"
        ),
        source="Kozhevnikov & Perfil'ev (1978), eq. 246",
        takes=(
            given("c_Nm_per_rad", mark("stiffness of all springs in a row"), "turning_stiffness", above=0.0),
            given("s_n1", mark("amplitude of the joints' second order [rad]"), low=0.0),
            given("a", mark("parameter a = c/(J_0 ω_1²)"), above=0.0),
            FIRST,
            LAST,
            given("drive_torque_mean_Nm", mark("mean torque"), "torque"),
            _harmonic_rows("drive_torque_harmonics", mark("harmonics of the drive torque")),
            _harmonic_rows("load_torque_harmonics", mark("harmonics of the load")),
        ),
        returns=(
            gives("mean_abs_Nm", mark("mean torque, without sign"), "torque"),
            gives("order2_joint_abs_Nm", mark("amplitude of second order, from the joints"), "torque"),
            gives("engine_order_abs_Nm", mark("amplitude of each order of the drive torque"), "torque"),
            gives("load_order_abs_Nm", mark("amplitude of each order of the load"), "torque"),
            gives("speed_rad_s", mark("speed that belongs to a"), "angular_speed"),
        ),
        answer=_engineering,
    ),
    Calculation(
        name="validity_check",
        doc=mark("whether the parametric term may be neglected: the book's rule, and what that costs when solved"),
        source=mark("Kozhevnikov & Perfil'ev (1978), eq. 206, 207, 237; harmonic balance"),
        takes=(
            STIFFNESS,
            WAVE,
            given("forcing_orders", mark("orders of the forcing"), axes=(1,), low=0.0, entries=True),
        ),
        returns=(
            gives("stable", mark("whether steady running is stable")),
            gives("beta", mark("characteristic exponent, where it is")),
            gives("distance_to_resonance", mark("distance of each order from the nearest ±β + 2r")),
            gives(
                "book_237_satisfied",
                mark("whether Kozhevnikov & Perfil'ev (1978), eq. 237 is met, orders 0, 1 and 2 included"),
            ),
            gives("solved_amplitude", mark("amplitude of each order under a unit forcing of it, solved")),
            gives("simplified_amplitude", mark("the same, the parametric term neglected")),
            gives("largest_side_band", mark("largest amplitude at another order, solved")),
            gives(
                "neglecting_q_costs",
                mark("error of neglecting the parametric term, a share of the simplified amplitude"),
            ),
            gives(
                "neglecting_q_costs_over_5_percent", mark("whether that is more than 5 % anywhere: do not neglect it")
            ),
        ),
        answer=_validity,
    ),
    Calculation(
        name="worked_example_truck",
        doc=mark("the book's worked example, the power unit of a truck, computed anew"),
        source="Kozhevnikov & Perfil'ev (1978), pp. 210–216",
        takes=(
            given("speed_rpm", mark("speed"), "angular_speed", above=0.0, default=TRUCK["speed"]),
            given("a", mark("parameter a"), above=0.0, high=LARGEST_A, default=TRUCK["a"]),
            given("Q2", mark("forcing of second order, a s_41"), default=TRUCK["sway"]),
            given("q", mark("parametric term as printed"), low=-LARGEST_Q, high=LARGEST_Q, default=TRUCK["q"]),
        ),
        returns=(
            gives("speed_squared_rad2_s2", mark("square of the speed")),
            gives("natural_frequency_rad_s", mark("natural frequency √a ω_1"), "angular_speed"),
            gives("s_41", mark("amplitude Q_2/a [rad]")),
            gives("beta", mark("characteristic exponent")),
            gives("order2_resonance_speed_rpm", mark("speed of the resonance of second order"), "angular_speed"),
            gives("principal_zone_speed_rpm", mark("speed of the principal zone"), "angular_speed"),
        ),
        answer=_truck,
    ),
)
