"""Calculations of parametric vibration: Mathieu's equation, and what it says of a drive."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np

from cardan.book.dynamic_book import book_beta, book_half_trace, book_zone
from cardan.book.massless_joints import steady_twist
from cardan.book.mathieu_reduction import mathieu_reduction
from cardan.calc.calculation import Calculation, Values, given, gives, rows
from cardan.calc.motion.kinematics import RIGHT
from cardan.errors import InputError, Problem, refuse
from cardan.maths.periodic.mathieu import LARGEST_A, LARGEST_Q, LEAST_A, boundaries, damped_zone, exponents
from cardan.maths.periodic.mathieu_forced import forced
from cardan.texts import _, mark
from cardan.units import rpm

SHOWN = 1e-8
"""Amplitudes below this one are not told."""

HIGHEST = 200
"""Highest order of the boundaries told."""

WAVE = given("q", mark("parametric term q of the equation"), low=-LARGEST_Q, high=LARGEST_Q)
STIFFNESS = given("a", mark("parameter a of the equation, (ω_e/ω_1)²"), low=LEAST_A, high=LARGEST_A)
DAMPING = given("n", mark("damping n per radian, b/(2 J_0 ω_1)"), low=-100.0, high=100.0, default=0.0)
FIRST = given("J_first_kgm2", mark("inertia at the driving end"), "inertia", above=0.0)
LAST = given("J_last_kgm2", mark("inertia at the driven end"), "inertia", above=0.0)


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

    Examples
    --------
    >>> label(2.0), label(6.8), label(0.5)
    ('2', '6.8', '0.5')
    """
    return f"{order:.10g}"


def harmonics_of(values: Values, name: str) -> tuple[list[float], list[float]]:
    """Return orders and amplitudes of a list of harmonics."""
    table = values[name]
    return [row["order"] for row in table], [row["amplitude"] for row in table]


@dataclass(frozen=True, kw_only=True, slots=True)
class UpToOrder(Calculation):
    """A calculation whose outputs ``…_to_N`` carry the order asked for in their names."""

    def __call__(self, inputs: Mapping[str, Any]) -> Values:
        """Return the outputs, N in their names replaced by the order."""
        found = Calculation.__call__(self, inputs)
        order = inputs.get("boundaries_up_to_order")
        return {key.replace("_to_N", f"_to_{order}"): value for key, value in found.items()}


def _stability(values: Values) -> Values:
    a, q, n = values["a"], values["q"], values["n"]
    found: Values = {}
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
    if values["boundaries_up_to_order"] is not None:
        even, odd = boundaries(q, values["boundaries_up_to_order"])
        found |= {"a_0_to_N": even, "b_1_to_N": odd}
    if values["zone"] is not None:
        lower, upper = damped_zone(q, n, values["zone"])
        found |= {"a_lower": lower, "a_upper": upper}
        if values["zone"] == 1:
            lower, upper = book_zone(q, n)
            found |= {"a_lower_book221": lower, "a_upper_book221": upper}
    return found


def _asked(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    asked = [values.get(name, 0) is not None for name in ("a", "boundaries_up_to_order", "zone")]
    if not any(asked):
        yield Problem(key("a"), _("missing; or ask for boundaries_up_to_order, or for a zone"))
    if values.get("zone") is not None and values.get("n", 0.0) < 0.0:
        yield Problem(key("n"), _("a zone needs damping of at least 0"))


def _reduction(values: Values) -> Values:
    found = mathieu_reduction(
        values["alpha"],
        values["psi"],
        values["stiffness"],
        first_inertia=values["J_first"],
        last_inertia=values["J_last"],
        speed=values["speed"],
    )
    answer: Values = {
        "A": found.forcing.real,
        "B": found.forcing.imag,
        "D": found.play.real,
        "F": found.play.imag,
        "s_n1": found.amplitude,
        "delta1_rad": found.forcing_phase,
        "c_Nm_per_rad": found.stiffness,
        "J0_kgm2": found.inertia,
        "natural_frequency_rad_s": found.natural_frequency,
        "a": found.a,
        "kappa": found.off_node,
        "principal_zone_speeds_rpm": found.zone_speeds(),
        "q_book": found.q_book,
        "q_corrected": found.q,
        "delta0_rad": found.wave_phase,
    }
    if values["drive_torque"] is not None:
        slow = max(found.a / LARGEST_A, found.q / LARGEST_Q)
        if slow > 1.0:
            text = _("too slow for Mathieu's equation of this drive: {least:.4g} rpm are the least")
            raise refuse("speed", text.format(least=found.speed * np.sqrt(slow) / rpm))
        with fields_named({"torque": "drive_torque"}):
            traces = exponents(found.a, np.asarray([found.q_book, found.q])).half_trace
            answer |= {
                "half_trace_exact": steady_twist(found, values["drive_torque"]).half_trace,
                "half_trace_mathieu_q_book": traces[0],
                "half_trace_mathieu_q_corrected": traces[1],
            }
    return answer


def _fits(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    alpha = values.get("alpha")
    if alpha is None:
        return
    if not alpha.size:
        yield Problem(key("alpha"), _("an empty list has no joint"))
    for name, wanted in (("psi", alpha.size), ("stiffness", alpha.size + 1)):
        if values.get(name) is not None and values[name].size != wanted:
            text = _("{given} values given, {wanted} needed")
            yield Problem(key(name), text.format(given=values[name].size, wanted=wanted))


def _forced(values: Values) -> Values:
    orders, amplitudes = harmonics_of(values, "forcing")
    with fields_named({"order": "forcing[].order"}):
        found = forced(
            values["a"],
            values["q"],
            values["n"],
            order=orders,
            amplitude=amplitudes,
            phase=[row["phase"] for row in values["forcing"]],
        )
    shown = [(label(w), k) for k, w in enumerate(found.order) if found.amplitude[k] >= SHOWN]
    return {
        "mean": found.mean,
        "order_amplitude": {label: found.amplitude[k] for label, k in shown},
        "order_phase_deg": {label: found.phase[k] for label, k in shown},
    }


CALCULATIONS: tuple[Calculation, ...] = (
    UpToOrder(
        name="mathieu_stability",
        doc=mark("exponent, growth and boundaries of y'' + 2n y' + (a - 2q cos 2z) y = 0"),
        source=mark("Hill's determinant; Kozhevnikov & Perfil'ev (1978), eq. 197, 208, 221, 225 beside it"),
        takes=(
            given(
                "a",
                mark("parameter a of the equation, (ω_e/ω_1)²"),
                low=LEAST_A,
                high=LARGEST_A,
                default=None,
            ),
            WAVE,
            DAMPING,
            given(
                "boundaries_up_to_order",
                mark("order N up to which to tell the boundaries of stability"),
                kind="whole",
                low=0,
                high=HIGHEST,
                default=None,
            ),
            given(
                "zone",
                mark("number of the unstable zone whose edges to tell, with damping; 1 is the principal one"),
                kind="whole",
                low=1,
                high=HIGHEST,
                default=None,
            ),
        ),
        returns=(
            gives("half_trace_undamped", mark("cos πβ of the equation freed of its damping")),
            gives("beta", mark("characteristic exponent, where the undamped equation is stable")),
            gives("growth_rate_per_rad", mark("rate of growth per radian of shaft angle")),
            gives("stable", mark("whether nothing grows")),
            gives("half_trace_book208", mark("cos πβ by Kozhevnikov & Perfil'ev (1978), eq. 208, for small q")),
            gives(
                "beta_book225",
                mark("characteristic exponent by Kozhevnikov & Perfil'ev (1978), eq. 225, for 0 < a < 1 and small q"),
            ),
            gives("a_0_to_N", mark("boundaries a_0 … a_N of the undamped equation")),
            gives("b_1_to_N", mark("boundaries b_1 … b_N of the undamped equation")),
            gives("a_lower", mark("lower edge of the zone; undefined where damping leaves nothing of it")),
            gives("a_upper", mark("upper edge of the zone")),
            gives(
                "a_lower_book221", mark("lower edge of the principal zone by Kozhevnikov & Perfil'ev (1978), eq. 221")
            ),
            gives(
                "a_upper_book221", mark("upper edge of the principal zone by Kozhevnikov & Perfil'ev (1978), eq. 221")
            ),
        ),
        answer=_stability,
        check=_asked,
    ),
    Calculation(
        name="mathieu_reduction",
        doc=mark("parameters of Mathieu's equation of a drive with massless joints between two inertias"),
        source=mark(
            "Kozhevnikov & Perfil'ev (1978), eq. 187–196, the parametric term put right; exact: shooting "
            "and variational equations"
        ),
        takes=(
            given(
                "alpha_deg", mark("joint angles of the joints"), "angle", axes=(1,), low=0.0, below=RIGHT, entries=True
            ),
            given("psi_deg", mark("phase angles of the joints"), "angle", axes=(1,), entries=True),
            given(
                "stiffness_Nm_per_rad",
                mark("stiffness before, between and behind the joints"),
                "turning_stiffness",
                axes=(1,),
                above=0.0,
                entries=True,
            ),
            FIRST,
            LAST,
            given("speed_rpm", mark("mean speed"), "angular_speed", above=0.0),
            given(
                "drive_torque_Nm",
                mark("constant drive torque, and load; asks for the exact drive as well"),
                "torque",
                default=None,
            ),
        ),
        returns=(
            gives("A", mark("forcing by sin 2φ, Kozhevnikov & Perfil'ev (1978), eq. 195 [rad]")),
            gives("B", mark("forcing by cos 2φ, Kozhevnikov & Perfil'ev (1978), eq. 195 [rad]")),
            gives("D", mark("change of the compliance by cos 2φ, Kozhevnikov & Perfil'ev (1978), eq. 195 [rad/(N·m)]")),
            gives("F", mark("change of the compliance by sin 2φ, Kozhevnikov & Perfil'ev (1978), eq. 195 [rad/(N·m)]")),
            gives("s_n1", mark("amplitude √(A² + B²) [rad]")),
            gives("delta1_rad", mark("its phase δ_1"), "angle"),
            gives("c_Nm_per_rad", mark("stiffness of all springs in a row"), "turning_stiffness"),
            gives("J0_kgm2", mark("inertia J_1 J_(n+1)/(J_1 + J_(n+1))"), "inertia"),
            gives("natural_frequency_rad_s", mark("natural frequency √(c/J_0)"), "angular_speed"),
            gives("a", mark("parameter a = c/(J_0 ω_1²)")),
            gives("kappa", mark("place of each joint from the node of the elastic mode, a share of the twist")),
            gives(
                "principal_zone_speeds_rpm",
                mark("speeds between which steady running is unstable without damping"),
                "angular_speed",
            ),
            gives(
                "q_book", mark("parametric term by Kozhevnikov & Perfil'ev (1978), eq. 196, half of what it should be")
            ),
            gives("q_corrected", mark("parametric term")),
            gives("delta0_rad", mark("its phase δ_0"), "angle"),
            gives("half_trace_exact", mark("half the trace of the elastic multipliers over half a turn, exact drive")),
            gives("half_trace_mathieu_q_book", mark("the same by Mathieu's equation with the book's parametric term")),
            gives("half_trace_mathieu_q_corrected", mark("the same with the right parametric term")),
        ),
        answer=_reduction,
        check=_fits,
    ),
    Calculation(
        name="mathieu_forced",
        doc=mark(
            "steady solution of y'' + 2n y' + (a - 2q cos 2z) y = Σ Q sin(νz + δ): mean and amplitude of each order"
        ),
        source=mark("harmonic balance; Kozhevnikov & Perfil'ev (1978), eq. 200–204, 223, 236, 243"),
        takes=(
            STIFFNESS,
            WAVE,
            DAMPING,
            rows(
                "forcing",
                mark("terms of the right side"),
                given("amplitude", mark("amplitude Q")),
                given("order", mark("order ν; 0 is the constant Q sin δ"), low=0.0),
                given("phase_deg", mark("phase δ"), "angle", default=0.0),
            ),
        ),
        returns=(
            gives("mean", mark("mean of y")),
            gives("order_amplitude", mark("amplitude of each order that has one")),
            gives("order_phase_deg", mark("phase of each order, y = Σ A sin(νz + δ)"), "angle"),
        ),
        answer=_forced,
    ),
)
