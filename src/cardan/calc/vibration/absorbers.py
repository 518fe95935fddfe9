"""Absorbers, dampers and pendulums against torsional vibration."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from cardan.calc.calculation import Formulas, Values
from cardan.formulas.absorber_tuning import Tuning, den_hartog, h_infinity, viscous_optimum
from cardan.formulas.absorbers import absorber_response
from cardan.formulas.pendulum import pendulum
from cardan.reading.given import Given, at_least_zero, positive, whole, word

formula = Formulas(__doc__)


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
    "Book (248), (249)",
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
    size, natural = _amplification(v, tuned, xi)
    return size, natural


@formula(
    "amplification of one mode with a viscous damper, an inertia without spring, over the frequency",
    "Book (252)",
    (RATIO, XI, _definition(SYSTEM), BETA),
    "amplification: amplitude over static angle; None at a resonance without damping",
)
def _viscous_damper_response(v: Values) -> Any:
    return _amplification(v, 0.0, v.xi)[0]


@formula(
    "best tuning and damping of an absorber by fixed points and exactly, and of a viscous damper",
    "Book (250), (251); exact H∞ optimum (Nishihara, Asami)",
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
    "order that a centrifugal pendulum absorbs, and what it weighs on the shaft at another one",
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
    "antiresonance = antiresonance: whether the order is the tuned one: infinite inertia",
)
def _pendulum_absorber(v: Values) -> Any:
    found = pendulum(
        v.pendulum_mass,
        v.pivot_radius,
        v.pendulum_length,
        v.order,
        count=v.count,
    )
    rotor = v.rotor_inertia
    return found, {"total_inertia_kgm2": None if rotor is None else rotor + found.inertia}
