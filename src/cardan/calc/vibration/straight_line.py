"""Straight lines of shafts: natural frequencies, forced torsional vibration, absorbers, run-up through resonance."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from cardan.book.straight_line import line_modes, line_response
from cardan.calc.calculation import Formulas, Problems, Values
from cardan.errors import Problem, check
from cardan.formulas.absorbers import Tuning, absorber_response, den_hartog, h_infinity, viscous_optimum
from cardan.formulas.pendulum import pendulum
from cardan.formulas.run_up import joint_run_up, run_up
from cardan.reading.given import Given, at_least_zero, given, gives, joint_angle, positive, whole, word
from cardan.texts import _

formula = Formulas(__doc__)
INERTIA = at_least_zero("inertia_kgm2", "inertia of each station", axes=1)
STIFFNESS = positive("stiffness_Nm_per_rad", "stiffness of each element between neighbouring stations", axes=1)


def fitting(*names: str) -> Callable[[Values], Problems]:
    """Return a check that a line has inertia, and a value of each named list for each of its elements."""

    def problems(v: Values) -> Problems:
        inertia = v.get("inertia")
        if inertia is None:
            return
        if not inertia.size or not np.any(inertia):
            yield v.wrong("inertia", _("no station has inertia"))
            return
        yield from v.miscounted(inertia.size - 1, "stiffness", *names)
        station = v.get("torque_station")
        if station is not None and station > inertia.size:
            yield v.wrong("torque_station", _("station {given} of {count}"), given=station, count=inertia.size)

    return problems


@formula(
    "torsional natural frequencies of a straight free line of shafts, and the speeds that meet them",
    "(K - ω²J) x = 0 with ratio 1 at every joint",
    (INERTIA, STIFFNESS),
    gives("omega_rad_s", "natural frequencies, 0 for the free turning", "frequency"),
    "order2_critical_speed_rpm: speeds at which order 2 meets them",
    "parametric_principal_speed_rpm: speeds of the principal parametric zones",
    "mode_shape: angle of each station in each mode, the largest 1",
    check=fitting(),
)
def _torsional_natural_frequencies(v: Values) -> Any:
    found = line_modes(v.inertia, v.stiffness)
    there = np.isfinite(found.omega)
    swinging = there & (found.omega > 0.0)
    return found.omega[there], found.order2_speed[swinging], found.parametric_speed[swinging], found.shape[there]


@formula(
    "steady torsional vibration of a straight line of shafts under a harmonic torque at one station",
    "complex stiffness c(1 + iη) + iωb of each element",
    (INERTIA, STIFFNESS),
    at_least_zero("damping_Nms_per_rad", "viscous damping of each element", axes=1, default=None),
    at_least_zero("loss_factor", "structural damping of each element", axes=1, default=None),
    whole("torque_station", "station of the torque, counted from 1", low=1),
    given("torque_amplitude_Nm", "amplitude of the torque", default=1.0),
    at_least_zero("omega_rad_s", "frequency of the torque", "frequency", axes=(0, 1)),
    "station_amplitude_rad: amplitude of each station",
    "element_torque_Nm: amplitude of the torque in each element",
    check=fitting("damping", "loss_factor"),
)
def _linear_forced_response(v: Values) -> Any:
    inertia, omega = v.inertia, v.omega
    torque = np.zeros(inertia.size)
    torque[v.torque_station - 1] = v.torque_amplitude
    found = line_response(
        inertia,
        v.stiffness,
        np.atleast_1d(omega),
        torque,
        damping=v.damping if v.damping is not None else 0.0,
        loss_factor=v.loss_factor if v.loss_factor is not None else 0.0,
    )
    text = _("{omega:.9g} rad/s is a natural frequency and nothing damps it: the vibration grows without end")
    at = np.flatnonzero(found.resonant)
    check([Problem("omega", text.format(omega=found.omega[at[0]]))] if at.size else [])
    single = np.ndim(omega) == 0
    return tuple(np.abs(one[:, 0] if single else one) for one in (found.angle, found.torque))


RATIO = positive("inertia_ratio", "inertia of the absorber over that of the system, α_J")
BETA = at_least_zero("beta", "frequency of the torque over the system's natural one", axes=(0, 1))
XI = at_least_zero("xi", "damping of the absorber, ξ")
SYSTEM, ABSORBER = "b/(2 J_a omega_0)", "b/(2 J_a omega_a)"


def _definition(*choices: str) -> Given:
    return word("xi_definition", "which damping ratio xi is", *choices, default=SYSTEM)


def _amplification(v: Values, tuned: float, xi: float) -> tuple[object, object]:
    beta = v.beta
    found = absorber_response(np.atleast_1d(beta), v.inertia_ratio, tuned, xi)
    size = np.where(np.isfinite(found.amplification), found.amplification, np.nan)
    return (size[0] if np.ndim(beta) == 0 else size), found.natural


def _setting(found: Tuning) -> dict[str, Any]:
    return {"frequency_ratio": found.frequency_ratio, "xi": found.damping, "peak_amplification": found.peak}


@formula(
    "amplification of one mode with a tuned absorber, with or without damping, over the frequency",
    "Kozhevnikov & Perfil'ev (1978), eq. 248, 249",
    RATIO,
    positive("frequency_ratio_absorber", "frequency of the absorber over the system's, f"),
    XI,
    _definition(SYSTEM, ABSORBER),
    BETA,
    "amplification: amplitude over static angle; None at a resonance without damping",
    "natural_frequency_ratio_undamped: natural frequencies with the undamped absorber",
)
def _absorber_response(v: Values) -> Any:
    tuned = v.frequency_ratio_absorber
    xi = v.xi * (tuned if v.xi_definition == ABSORBER else 1.0)
    return _amplification(v, tuned, xi)


@formula(
    "amplification of one mode with a viscous damper, an inertia without spring, over the frequency",
    "Kozhevnikov & Perfil'ev (1978), eq. 252",
    (RATIO, XI, _definition(SYSTEM), BETA),
    "amplification: amplitude over static angle; None at a resonance without damping",
)
def _viscous_damper_response(v: Values) -> Any:
    return _amplification(v, 0.0, v.xi)[0]


@formula(
    "best tuning and damping of an absorber by fixed points and exactly, and of a viscous damper",
    "Kozhevnikov & Perfil'ev (1978), eq. 250, 251; exact H∞ optimum (Nishihara, Asami)",
    replace(RATIO, axes=(0, 1)),
    "den_hartog: setting by fixed points, with the true peak",
    "h_infinity: setting with the smallest peak",
    "viscous_damper: best damper without spring",
)
def _absorber_optimum(v: Values) -> Any:
    alpha = np.asarray(v.inertia_ratio)
    fixed, loose = den_hartog(alpha), viscous_optimum(alpha)
    return {
        "den_hartog": _setting(fixed)
        | {"fixed_point_amplification": fixed.fixed_amplification, "fixed_point_beta": fixed.fixed_beta},
        "h_infinity": _setting(h_infinity(alpha)),
        "viscous_damper": {"xi": loose.damping, "beta_peak": loose.peak_beta, "peak_amplification": loose.peak},
    }


@formula(
    "order that a centrifugal pendulum absorbs, and its effective inertia on the shaft at another one",
    "rotor and pendulum, small oscillations",
    positive("pendulum_mass_kg", "mass of one pendulum"),
    positive("pivot_radius_m", "radius of its pivot on the shaft"),
    positive("pendulum_length_m", "length of its arm"),
    at_least_zero("order", "order of the excitation, cycles a turn"),
    at_least_zero("rotor_inertia_kgm2", "inertia of the shaft", default=None),
    whole("count", "number of equal pendulums", low=1, default=1),
    "tuning_order = tuned_order: order at which the shaft is held still",
    "effective_inertia_kgm2 = inertia: inertia felt at the order; None at antiresonance",
    "total_inertia_kgm2: the same with that of the shaft",
    "swing_over_shaft = swing: amplitude of a pendulum over that of the shaft; None at antiresonance",
    "antiresonance: whether the order is the tuned one: infinite inertia",
)
def _pendulum_absorber(v: Values) -> Any:
    found = pendulum(v.pendulum_mass, v.pivot_radius, v.pendulum_length, v.order, count=v.count)
    rotor = v.rotor_inertia
    return found, {"total_inertia_kgm2": None if rotor is None else rotor + found.inertia}


EQUATION = "y''+2 z w0 y'+w0^2 y = w0^2 cos(al t^2/2), rest at t=0"

_SWEEP = ("natural_frequency", "damping_ratio", "sweep_acceleration")
_JOINT = ("alpha", "stiffness", "inertia", "input_acceleration")


def _forms(v: Values) -> Problems:
    """Yield what misses of the form that was begun, and keys of the other one."""
    begun = [name for name in _SWEEP if v.get(name) is not None or name not in v]
    other = [name for name in _JOINT if v.get(name) is not None or name not in v]
    if not begun and not other:
        text = _("missing; give it for a run-up behind a joint, or {other} for an oscillator")
        yield v.wrong("alpha", text.format(other=v.key("natural_frequency")))
        return
    wanted = _SWEEP if begun and not other else _JOINT if other and not begun else ()
    for name in wanted:
        if name in v and v[name] is None:
            yield v.wrong(name, _("missing; {other} needs it"), other=v.key((begun or other)[0]))
    if begun and other:
        text = _("not together with {other}: a run-up is that of an oscillator or that behind a joint")
        yield v.wrong(other[0], text.format(other=v.key(begun[0])))
    time, end = v.get("t"), v.get("t_max")
    if other and time is not None and end is not None and (time > end).any():
        yield v.wrong("t", _("later than {end}"), end=v.key("t_max"))


@formula(
    "peak while running up through resonance: an oscillator under a rising frequency, or behind a joint",
    "exact in complex error functions; behind a joint by impulse responses",
    positive("natural_frequency_rad_s", "natural frequency of the oscillator", "frequency", default=None),
    positive("damping_ratio", "its damping ratio", below=1.0, default=None),
    positive("sweep_acceleration_rad_s2", "rise of the frequency of its force", default=None),
    word("equation", "the oscillator's equation", EQUATION, default=EQUATION),
    joint_angle("alpha_deg", "joint angle of the joint", default=None),
    positive("stiffness_Nm_per_rad", "stiffness of the driven shaft", default=None),
    positive("inertia_kgm2", "inertia at its end", default=None),
    at_least_zero("damping_Nms_per_rad", "damping of the driven shaft", default=0.0),
    positive("input_acceleration_rad_s2", "acceleration of the driving shaft", default=None),
    at_least_zero("t_s", "instants of the curve", axes=1, default=None),
    positive("t_max_s", "end of the run"),
    "y: response at the instants, over the static one",
    "torque_Nm: torque at the instants",
    "peak_abs: largest response",
    "peak_torque_Nm: largest torque",
    "peak_time_s: when",
    "peak_input_speed_rad_s: input speed then",
    "passing_time_s: when the frequency of the force passes the natural one",
    "steady_peak_abs: largest steady response: the limit of a slow run-up",
    "critical_speed_order2_rad_s: speed at which order 2 meets the natural frequency",
    check=_forms,
)
def _run_up(v: Values) -> Any:
    time, end = v.t, v.t_max
    if v.natural_frequency is not None:
        omega, zeta, rate = (v[name] for name in _SWEEP)
        found = run_up(omega, zeta, rate, end, time=time)
        return {
            **{
                "y": found.response if time is not None else None,
                "peak_abs": found.peak,
                "peak_time_s": found.peak_time,
            },
            **{"passing_time_s": found.passing_time, "steady_peak_abs": found.steady_peak},
        }
    joint_angle, stiffness, inertia, rise = (v[name] for name in _JOINT)
    joint = joint_run_up(joint_angle, stiffness, inertia, rise, end, damping=v.damping, time=time)
    return {
        "torque_Nm": joint.torque if time is not None else None,
        "peak_torque_Nm": joint.peak_torque,
        "peak_time_s": joint.peak_time,
        "peak_input_speed_rad_s": joint.peak_speed,
        "critical_speed_order2_rad_s": joint.order2_speed,
    }
