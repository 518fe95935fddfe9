"""Calculations of absorbers, dampers and pendulums against torsional vibration."""

from __future__ import annotations

import numpy as np

from cardan.calc.calculation import Calculation, Given, Values, given, gives
from cardan.formulas.absorber_tuning import Tuning, den_hartog, h_infinity, viscous_optimum
from cardan.formulas.absorbers import absorber_response
from cardan.formulas.pendulum import pendulum
from cardan.texts import mark

RATIO = given("inertia_ratio", mark("inertia of the absorber over that of the system, α_J"), above=0.0)
BETA = given("beta", mark("frequency of the torque over the system's natural one"), axes=(0, 1), low=0.0)
XI = given("xi", mark("damping of the absorber, ξ"), low=0.0)
SYSTEM, ABSORBER = "b/(2 J_a omega_0)", "b/(2 J_a omega_a)"


def _definition(*choices: str) -> Given:
    return given("xi_definition", mark("which damping ratio xi is"), kind="word", choices=choices, default=SYSTEM)


def _amplification(values: Values, tuned: float, xi: float) -> tuple[object, object]:
    beta = values["beta"]
    found = absorber_response(np.atleast_1d(beta), values["inertia_ratio"], tuned, xi)
    size = np.where(np.isfinite(found.amplification), found.amplification, np.nan)
    return (size[0] if np.ndim(beta) == 0 else size), found.natural


def _absorber(values: Values) -> Values:
    tuned = values["frequency_ratio_absorber"]
    xi = values["xi"] * (tuned if values["xi_definition"] == ABSORBER else 1.0)
    size, natural = _amplification(values, tuned, xi)
    return {"amplification": size, "natural_frequency_ratio_undamped": natural}


def _viscous(values: Values) -> Values:
    return {"amplification": _amplification(values, 0.0, values["xi"])[0]}


def _setting(found: Tuning) -> Values:
    return {"frequency_ratio": found.frequency_ratio, "xi": found.damping, "peak_amplification": found.peak}


def _optimum(values: Values) -> Values:
    alpha = np.asarray(values["inertia_ratio"])
    fixed, loose = den_hartog(alpha), viscous_optimum(alpha)
    return {
        "den_hartog": _setting(fixed)
        | {"fixed_point_amplification": fixed.fixed_amplification, "fixed_point_beta": fixed.fixed_beta},
        "h_infinity": _setting(h_infinity(alpha)),
        "viscous_damper": {"xi": loose.damping, "beta_peak": loose.peak_beta, "peak_amplification": loose.peak},
    }


def _pendulum(values: Values) -> Values:
    found = pendulum(
        values["pendulum_mass"],
        values["pivot_radius"],
        values["pendulum_length"],
        values["order"],
        count=values["count"],
    )
    rotor = values["rotor_inertia"]
    return {
        "tuning_order": found.tuned_order,
        "effective_inertia_kgm2": found.inertia,
        "total_inertia_kgm2": None if rotor is None else rotor + found.inertia,
        "swing_over_shaft": found.swing,
        "antiresonance": found.antiresonance,
    }


CALCULATIONS = (
    Calculation(
        name="absorber_response",
        doc=mark("amplification of one mode with a tuned absorber, with or without damping, over the frequency"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 248, 249",
        takes=(
            RATIO,
            given("frequency_ratio_absorber", mark("frequency of the absorber over the system's, f"), above=0.0),
            XI,
            _definition(SYSTEM, ABSORBER),
            BETA,
        ),
        returns=(
            gives("amplification", mark("amplitude over static angle; None at a resonance without damping")),
            gives("natural_frequency_ratio_undamped", mark("natural frequencies with the undamped absorber")),
        ),
        answer=_absorber,
    ),
    Calculation(
        name="viscous_damper_response",
        doc=mark("amplification of one mode with a viscous damper, an inertia without spring, over the frequency"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 252",
        takes=(RATIO, XI, _definition(SYSTEM), BETA),
        returns=(gives("amplification", mark("amplitude over static angle; None at a resonance without damping")),),
        answer=_viscous,
    ),
    Calculation(
        name="absorber_optimum",
        doc=mark("best tuning and damping of an absorber by fixed points and exactly, and of a viscous damper"),
        source=mark("Kozhevnikov & Perfil'ev (1978), eq. 250, 251; exact H∞ optimum (Nishihara, Asami)"),
        takes=(given(RATIO.key, RATIO.meaning.doc, axes=(0, 1), above=0.0),),
        returns=(
            gives("den_hartog", mark("setting by fixed points, with the true peak")),
            gives("h_infinity", mark("setting with the smallest peak")),
            gives("viscous_damper", mark("best damper without spring")),
        ),
        answer=_optimum,
    ),
    Calculation(
        name="pendulum_absorber",
        doc=mark("order that a centrifugal pendulum absorbs, and what it weighs on the shaft at another one"),
        source=mark("rotor and pendulum, small oscillations"),
        takes=(
            given("pendulum_mass_kg", mark("mass of one pendulum"), "mass", above=0.0),
            given("pivot_radius_m", mark("radius of its pivot on the shaft"), "length", above=0.0),
            given("pendulum_length_m", mark("length of its arm"), "length", above=0.0),
            given("order", mark("order of the excitation, cycles a turn"), low=0.0),
            given("rotor_inertia_kgm2", mark("inertia of the shaft"), "inertia", low=0.0, default=None),
            given("count", mark("number of equal pendulums"), kind="whole", low=1, default=1),
        ),
        returns=(
            gives("tuning_order", mark("order at which the shaft is held still")),
            gives("effective_inertia_kgm2", mark("inertia felt at the order; None at antiresonance"), "inertia"),
            gives("total_inertia_kgm2", mark("the same with that of the shaft"), "inertia"),
            gives("swing_over_shaft", mark("amplitude of a pendulum over that of the shaft; None at antiresonance")),
            gives("antiresonance", mark("whether the order is the tuned one: infinite inertia")),
        ),
        answer=_pendulum,
    ),
)
