"""Parametric vibration: Mathieu's equation, the book's engineering rules, and the solved answers beside them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np

from cardan.book.dynamic_book import (
    TRUCK,
    book_beta,
    book_half_trace,
    book_zone,
    engineering_torque,
    truck_example,
    validity,
)
from cardan.book.mathieu_drive import mathieu_reduction, steady_twist
from cardan.calc.calculation import Calculation, Formulas, Problems, Values
from cardan.errors import InputError, refuse
from cardan.maths.periodic.mathieu import LARGEST_A, LARGEST_Q, LEAST_A, boundaries, damped_zone, exponents, forced
from cardan.reading.given import Given, at_least_zero, given, gives, joint_angle, positive, rows, whole
from cardan.texts import _
from cardan.units import rpm

formula = Formulas(__doc__)
SHOWN = 1e-8
"""Amplitudes below this one are not told."""

HIGHEST = 200
"""Highest order of the boundaries told."""

WAVE = given("q", "parametric term q of the equation", low=-LARGEST_Q, high=LARGEST_Q)
STIFFNESS = given("a", "parameter a of the equation, (ω_e/ω_1)²", low=LEAST_A, high=LARGEST_A)
DAMPING = given("n", "damping n per radian, b/(2 J_0 ω_1)", low=-100.0, high=100.0, default=0.0)
FIRST = positive("J_first_kgm2", "inertia at the driving end")
LAST = positive("J_last_kgm2", "inertia at the driven end")


@contextmanager
def fields_named(names: Mapping[str, str]) -> Iterator[None]:
    """Name fields of functions by the inputs they come from, those with a place by ``forcing[].order``."""

    def renamed(field: str) -> str:
        name, bracket, place = field.partition("[")
        if name not in names:
            return field
        return names[name].replace("[]", bracket + place) if bracket else names[name]

    try:
        yield
    except InputError as error:
        raise error.renamed(renamed) from None


def told(value: Any) -> float | None:
    """Return a number, None where it is undefined."""
    return float(value) if np.isfinite(value) else None


def label(order: float) -> str:
    """Return an order as the key of a table.

    >>> label(2.0), label(6.8), label(0.5)
    ('2', '6.8', '0.5')
    """
    return f"{order:.10g}"


def harmonics_of(v: Values, name: str) -> tuple[list[float], list[float]]:
    """Return orders and amplitudes of a list of harmonics."""
    table = v[name]
    return [row.order for row in table], [row.amplitude for row in table]


@dataclass(frozen=True, kw_only=True, slots=True)
class UpToOrder(Calculation):
    """A calculation whose outputs ``…_to_N`` carry the order asked for in their names."""

    def __call__(self, inputs: Mapping[str, Any]) -> dict[str, Any]:
        """Return the outputs, N in their names replaced by the order."""
        found = Calculation.__call__(self, inputs)
        order = inputs.get("boundaries_up_to_order")
        return {key.replace("_to_N", f"_to_{order}"): value for key, value in found.items()}

    def meaning(self, key: str) -> str:
        """Return what an output means, whatever the order in its name."""
        return Calculation.meaning(self, re.sub(r"_to_\d+$", "_to_N", key))


def _order(key: str, doc: str, low: int) -> Given:
    return whole(key, doc, low=low, high=HIGHEST, default=None)


def _asked(v: Values) -> Problems:
    asked = [v.get(name, 0) is not None for name in ("a", "boundaries_up_to_order", "zone")]
    if not any(asked):
        yield v.wrong("a", _("missing; or ask for boundaries_up_to_order, or for a zone"))
    if v.get("zone") is not None and v.get("n", 0.0) < 0.0:
        yield v.wrong("n", _("a zone needs damping of at least 0"))


def _fits(v: Values) -> Problems:
    alpha = v.get("alpha")
    if alpha is None:
        return
    if not alpha.size:
        yield v.wrong("alpha", _("an empty list has no joint"))
    yield from v.miscounted(alpha.size, "psi")
    yield from v.miscounted(alpha.size + 1, "stiffness")


@formula(
    "exponent, growth and boundaries of y'' + 2n y' + (a - 2q cos 2z) y = 0",
    "Hill's determinant; Kozhevnikov & Perfil'ev (1978), eq. 197, 208, 221, 225 beside it",
    given("a", "parameter a of the equation, (ω_e/ω_1)²", low=LEAST_A, high=LARGEST_A, default=None),
    (WAVE, DAMPING),
    _order("boundaries_up_to_order", "order N up to which to tell the boundaries of stability", low=0),
    _order("zone", "number of the unstable zone whose edges to tell, with damping; 1 is the principal one", low=1),
    "half_trace_undamped: cos πβ of the equation freed of its damping",
    "beta: characteristic exponent, where the undamped equation is stable",
    gives("growth_rate_per_rad", "rate of growth per radian of shaft angle", None),
    "stable: whether nothing grows",
    "half_trace_book208: cos πβ by Kozhevnikov & Perfil'ev (1978), eq. 208, for small q",
    "beta_book225: characteristic exponent by Kozhevnikov & Perfil'ev (1978), eq. 225, for 0 < a < 1 and small q",
    gives("a_0_to_N", "boundaries a_0 … a_N of the undamped equation", None),
    gives("b_1_to_N", "boundaries b_1 … b_N of the undamped equation", None),
    "a_lower: lower edge of the zone; undefined where damping leaves nothing of it",
    "a_upper: upper edge of the zone",
    "a_lower_book221: lower edge of the principal zone by Kozhevnikov & Perfil'ev (1978), eq. 221",
    "a_upper_book221: upper edge of the principal zone by Kozhevnikov & Perfil'ev (1978), eq. 221",
    check=_asked,
    kind=UpToOrder,
)
def _mathieu_stability(v: Values) -> Any:
    a, q, n = v.a, v.q, v.n
    found: dict[str, Any] = {}
    if a is not None:
        one = exponents(a, q, n)
        inner = a - n * n
        found |= {
            "half_trace_undamped": one.half_trace,
            "beta": told(one.beta),
            "growth_rate_per_rad": one.growth,
            "stable": bool(one.stable),
            "half_trace_book208": book_half_trace(inner, q),
            "beta_book225": told(book_beta(inner, q)),
        }
    if v.boundaries_up_to_order is not None:
        even, odd = boundaries(q, v.boundaries_up_to_order)
        found |= {"a_0_to_N": even, "b_1_to_N": odd}
    if v.zone is not None:
        lower, upper = damped_zone(q, n, v.zone)
        found |= {"a_lower": lower, "a_upper": upper}
        if v.zone == 1:
            lower, upper = book_zone(q, n)
            found |= {"a_lower_book221": lower, "a_upper_book221": upper}
    return found


@formula(
    "parameters of Mathieu's equation of a drive with massless joints between two inertias",
    "Kozhevnikov & Perfil'ev (1978), eq. 187–196, parametric term put right; exact: shooting, variational equations",
    joint_angle("alpha_deg", "joint angles of the joints", axes=1, entries=True),
    given("psi_deg", "phase angles of the joints", axes=1, entries=True),
    positive("stiffness_Nm_per_rad", "stiffness before, between and behind the joints", axes=1, entries=True),
    (FIRST, LAST),
    positive("speed_rpm", "mean speed"),
    given("drive_torque_Nm", "constant drive torque, and load; asks for the exact drive as well", default=None),
    "A: forcing by sin 2φ, Kozhevnikov & Perfil'ev (1978), eq. 195 [rad]",
    "B: forcing by cos 2φ, Kozhevnikov & Perfil'ev (1978), eq. 195 [rad]",
    "D: change of the compliance by cos 2φ, Kozhevnikov & Perfil'ev (1978), eq. 195 [rad/(N·m)]",
    "F: change of the compliance by sin 2φ, Kozhevnikov & Perfil'ev (1978), eq. 195 [rad/(N·m)]",
    "s_n1 = amplitude: amplitude √(A² + B²) [rad]",
    "delta1_rad = forcing_phase: its phase δ_1",
    "c_Nm_per_rad = stiffness: stiffness of all springs in a row",
    "J0_kgm2 = inertia: inertia J_1 J_(n+1)/(J_1 + J_(n+1))",
    "natural_frequency_rad_s = natural_frequency: natural frequency √(c/J_0)",
    "a: parameter a = c/(J_0 ω_1²)",
    "kappa = off_node: place of each joint from the node of the elastic mode, a share of the twist",
    "principal_zone_speeds_rpm: speeds between which steady running is unstable without damping",
    "q_book: parametric term by Kozhevnikov & Perfil'ev (1978), eq. 196, half of what it should be",
    "q_corrected = q: parametric term",
    "delta0_rad = wave_phase: its phase δ_0",
    "half_trace_exact: half the trace of the elastic multipliers over half a turn, exact drive",
    "half_trace_mathieu_q_book: the same by Mathieu's equation with the book's parametric term",
    "half_trace_mathieu_q_corrected: the same with the right parametric term",
    check=_fits,
)
def _mathieu_reduction(v: Values) -> Any:
    found = mathieu_reduction(
        v.alpha, v.psi, v.stiffness, **v.of("speed", first_inertia="J_first", last_inertia="J_last")
    )
    forcing, play = found.forcing, found.play
    answer: dict[str, Any] = {
        **{"A": forcing.real, "B": forcing.imag, "D": play.real, "F": play.imag},
        "principal_zone_speeds_rpm": found.zone_speeds(),
    }
    if v.drive_torque is not None:
        slow = max(found.a / LARGEST_A, found.q / LARGEST_Q)
        if slow > 1.0:
            text = _("too slow for Mathieu's equation of this drive: {least:.4g} rpm are the least")
            raise refuse("speed", text.format(least=found.speed * np.sqrt(slow) / rpm))
        traces = exponents(found.a, np.asarray([found.q_book, found.q])).half_trace
        answer |= {
            "half_trace_exact": steady_twist(found, v.drive_torque).half_trace,
            "half_trace_mathieu_q_book": traces[0],
            "half_trace_mathieu_q_corrected": traces[1],
        }
    return found, answer


@formula(
    "steady solution of y'' + 2n y' + (a - 2q cos 2z) y = Σ Q sin(νz + δ): mean and amplitude of each order",
    "harmonic balance; Kozhevnikov & Perfil'ev (1978), eq. 200–204, 223, 236, 243",
    (STIFFNESS, WAVE, DAMPING),
    rows(
        "forcing",
        "terms of the right side",
        given("amplitude", "amplitude Q"),
        at_least_zero("order", "order ν; 0 is the constant Q sin δ"),
        given("phase_deg", "phase δ", default=0.0),
    ),
    "mean: mean of y",
    "order_amplitude: amplitude of each order that has one",
    "order_phase_deg: phase of each order, y = Σ A sin(νz + δ)",
)
def _mathieu_forced(v: Values) -> Any:
    orders, amplitudes = harmonics_of(v, "forcing")
    with fields_named({"order": "forcing[].order"}):
        found = forced(v.a, v.q, v.n, order=orders, amplitude=amplitudes, phase=[row.phase for row in v.forcing])
    shown = [(label(w), k) for k, w in enumerate(found.order) if found.amplitude[k] >= SHOWN]
    return {
        "mean": found.mean,
        "order_amplitude": {label: found.amplitude[k] for label, k in shown},
        "order_phase_deg": {label: found.phase[k] for label, k in shown},
    }


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
    order, amplitude = positive("order", "order per turn of the driving shaft"), given("amplitude_Nm", "its amplitude")
    return rows(key, doc, order, amplitude, default=[])


@formula(
    "torque in the last shaft by the book's formula for sizing: mean, second order, orders of drive and load",
    "Kozhevnikov & Perfil'ev (1978), eq. 246",
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
    "Kozhevnikov & Perfil'ev (1978), eq. 206, 207, 237; harmonic balance",
    (STIFFNESS, WAVE),
    at_least_zero("forcing_orders", "orders of the forcing", axes=1, entries=True),
    "stable: whether steady running is stable",
    "beta: characteristic exponent, where it is",
    "distance_to_resonance: distance of each order from the nearest ±β + 2r",
    "book_237_satisfied = rule: whether Kozhevnikov & Perfil'ev (1978), eq. 237 is met, orders 0, 1 and 2 included",
    "solved_amplitude: amplitude of each order under a unit forcing of it, solved",
    "simplified_amplitude: the same, the parametric term neglected",
    "largest_side_band: largest amplitude at another order, solved",
    "neglecting_q_costs: error of neglecting the parametric term, a share of the simplified amplitude",
    gives(
        "neglecting_q_costs_over_5_percent = too_far", "whether that is more than 5 % anywhere: do not neglect it", None
    ),
)
def _validity_check(v: Values) -> Any:
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
    "Kozhevnikov & Perfil'ev (1978), pp. 210–216",
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
