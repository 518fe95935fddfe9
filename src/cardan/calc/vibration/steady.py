"""Steady running: response by orders, and whether it is stable."""

from __future__ import annotations

from typing import Any

import numpy as np

from cardan.calc.calculation import Formulas, Problems, Values
from cardan.errors import InputError
from cardan.maths.arrays import Array
from cardan.maths.periodic.harmonics import Status
from cardan.questions.torsion.model.torsional_batch import repeating
from cardan.questions.torsion.model.torsional_model import TorsionalModel
from cardan.questions.torsion.steady.run_stability import Floquet, Kind, Verdict, floquet
from cardan.questions.torsion.steady.steady import periodic_response
from cardan.questions.torsion.steady.steady_result import Orders, SteadyResponse
from cardan.reading.given import given, gives
from cardan.texts import _

from .torsion_tables import MODEL, model_of, model_problems

formula = Formulas(__doc__)


MEAN_SPEED = given("mean_speed_rad_s", "mean speed of a free drive; its constant drive torque is sought", default=None)
"""Mean speed of a free drive."""


def speed_problems(v: Values) -> Problems:
    """Yield what is wrong with the tables, and with the speed: exactly one of the two is needed, and not 0."""
    yield from model_problems(v)
    speeds = {name: v.get(name) for name in ("input_speed", "mean_speed")}
    there = [name for name, value in speeds.items() if value is not None]
    if any(name not in v for name in speeds):
        return
    if not there:
        yield v.wrong(
            "input_speed", _("missing; give it, or {other} for a free drive").format(other=v.key("mean_speed"))
        )
    elif len(there) > 1:
        yield v.wrong("mean_speed", _("given beside {other}; give one of them").format(other=v.key("input_speed")))
    for name in there:
        if speeds[name] == 0.0:
            yield v.wrong(name, _("0 given; steady running needs a speed"))


def _steady(model: TorsionalModel, v: Values) -> SteadyResponse:
    try:
        return periodic_response(model, speed=v.mean_speed)
    except InputError as error:
        raise error.renamed(lambda field: "mean_speed" if field == "speed" else field) from None


def _multipliers(found: Floquet) -> dict[str, Any]:
    left = found.multipliers[np.isfinite(found.multipliers)]
    return {
        "multiplier_modulus_sorted": np.abs(left),
        "multiplier_angle_deg": np.angle(left),
        "multipliers_removed": int(found.removed),
    }


def _table(orders: list[str], curves: Orders) -> list[dict[str, Array]]:
    return [dict(zip(orders, row, strict=True)) for row in curves.amplitude]


@formula(
    "steady torsional running at a speed: torque of every element and speed of every station by orders",
    "harmonic balance of the exact equations of motion",
    (*MODEL, MEAN_SPEED),
    "elements: of every element: mean, amplitude and phase of each order, true extremes",
    gives("station_speed_order_amplitude_rad_s", "amplitude of every station's speed by order", None),
    gives("constant_drive_torque_Nm", "constant torque on the first station that keeps the mean speed", None),
    gives("drive_torque_mean_Nm", "mean torque that the input needs to turn at its speed", None),
    gives("drive_torque_order_amplitude_Nm", "amplitude of that torque by order", None),
    "stable: whether small disturbances decay",
    "verdict: stable, neutral, unstable or unknown",
    "status: converged, coarse or no_convergence",
    "residual: by how much the equations fail to hold, over the largest torque",
    "power_residual: what the power balance misses, over the power that flows",
    check=speed_problems,
)
def _periodic_response(v: Values) -> Any:
    found = _steady(model_of(v), v)
    model, steadiness = found.model, floquet(found)
    orders = [f"{order:g}" for order in found.order]
    free = model.free
    return {
        "elements": [
            {
                "mean_Nm": found.torque.mean[e],
                "order_amplitude_Nm": dict(zip(orders, found.torque.amplitude[e], strict=True)),
                "order_phase_deg": dict(zip(orders, np.degrees(found.torque.phase[e]), strict=True)),
                "peak_to_peak_Nm": found.peak_to_peak[e],
                "highest_Nm": found.torque_highest[e],
                "lowest_Nm": found.torque_lowest[e],
            }
            for e in range(len(model.elements))
        ],
        "station_speed_order_amplitude_rad_s": _table(orders, found.station_speed),
        "constant_drive_torque_Nm": found.drive_torque.mean[0] if free else None,
        "drive_torque_mean_Nm": None if free else found.drive_torque.mean[0],
        "drive_torque_order_amplitude_Nm": None if free else _table(orders, found.drive_torque)[0],
        "stable": bool(steadiness.stable),
        "verdict": Verdict(int(steadiness.verdict)).name.lower(),
        "status": Status(int(found.status)).name.lower(),
        "residual": found.residual,
        "power_residual": found.power_residual,
    }


@formula(
    "whether steady torsional running is stable: multipliers of a period, growth, nearest zone of resonance",
    "exact equations of motion linearised about their periodic motion",
    (*MODEL, MEAN_SPEED),
    gives("multiplier_period_rad = period", "shaft angle of a period", None),
    "multiplier_modulus_sorted: by what each disturbance is multiplied over a period",
    "multiplier_angle_deg: angle of these multipliers",
    "multipliers_removed: left out of a free drive: shift in time, and any speed being possible",
    "spectral_radius = spectral_radius: the largest of them",
    "stable: whether every disturbance decays",
    "verdict: stable, neutral, unstable or unknown",
    gives("growth_rate_1_per_s", "rate at which the largest disturbance grows", None),
    "kind: how a growing disturbance oscillates: repeating, doubling or combination",
    "disturbance_order = order: lowest order at which it oscillates",
    "nearest_zone: nearest zone of parametric resonance",
    gives("nearest_zone_rad_s", "its speed by the straight drive", None),
    "status: of the steady motion: converged, coarse or no_convergence",
    "determinant_residual = determinant_residual: what the product of the multipliers misses against the damping",
    "torques_left_out: numbers of torques whose order does not repeat within two turns",
    check=speed_problems,
)
def _floquet_stability(v: Values) -> Any:
    model, loose = repeating(model_of(v))
    steady = _steady(model, v)
    found = floquet(steady)
    return found, {
        **_multipliers(found),
        "stable": bool(found.stable),
        "verdict": Verdict(int(found.verdict)).name.lower(),
        "growth_rate_1_per_s": np.where(np.isfinite(found.growth_rate), found.growth_rate, np.nan)[()],
        "kind": Kind(int(found.kind)).name.lower() if found.verdict == Verdict.UNSTABLE else None,
        "nearest_zone": found.zone.name(),
        "nearest_zone_rad_s": found.zone.speed,
        "status": Status(int(steady.status)).name.lower(),
        "torques_left_out": [k + 1 for k in loose] or None,
    }
