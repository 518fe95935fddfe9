"""Calculations of steady running: response by orders, and whether it is stable."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from cardan.calc.calculation import Calculation, Values, given, gives
from cardan.errors import InputError, Problem
from cardan.maths.arrays import Array
from cardan.maths.periodic.harmonics import Status
from cardan.questions.torsion.model.torsional_batch import repeating
from cardan.questions.torsion.model.torsional_model import TorsionalModel
from cardan.questions.torsion.steady.run_stability import Floquet, Kind, Verdict, floquet
from cardan.questions.torsion.steady.steady import periodic_response
from cardan.questions.torsion.steady.steady_result import Orders, SteadyResponse
from cardan.texts import _, mark

from .torsion_tables import MODEL, model_of, model_problems

MEAN_SPEED = given(
    "mean_speed_rad_s",
    mark("mean speed of a free drive; its constant drive torque is sought"),
    "angular_speed",
    default=None,
)
"""Mean speed of a free drive."""


def speed_problems(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    """Yield what is wrong with the tables, and with the speed: exactly one of the two is needed, and not 0."""
    yield from model_problems(values, key)
    speeds = {name: values.get(name) for name in ("input_speed", "mean_speed")}
    there = [name for name, value in speeds.items() if value is not None]
    if any(name not in values for name in speeds):
        return
    if not there:
        yield Problem(
            key("input_speed"), _("missing; give it, or {other} for a free drive").format(other=key("mean_speed"))
        )
    elif len(there) > 1:
        yield Problem(key("mean_speed"), _("given beside {other}; give one of them").format(other=key("input_speed")))
    for name in there:
        if speeds[name] == 0.0:
            yield Problem(key(name), _("0 given; steady running needs a speed"))


def _steady(model: TorsionalModel, values: Values) -> SteadyResponse:
    try:
        return periodic_response(model, speed=values["mean_speed"])
    except InputError as error:
        raise error.renamed(lambda field: "mean_speed" if field == "speed" else field) from None


def _stability(values: Values) -> Values:
    model, loose = repeating(model_of(values))
    steady = _steady(model, values)
    found = floquet(steady)
    return {
        "multiplier_period_rad": found.period,
        **_multipliers(found),
        "spectral_radius": found.spectral_radius,
        "stable": bool(found.stable),
        "verdict": Verdict(int(found.verdict)).name.lower(),
        "growth_rate_1_per_s": np.where(np.isfinite(found.growth_rate), found.growth_rate, np.nan)[()],
        "kind": Kind(int(found.kind)).name.lower() if found.verdict == Verdict.UNSTABLE else None,
        "disturbance_order": found.order,
        "nearest_zone": found.zone.name(),
        "nearest_zone_rad_s": found.zone.speed,
        "status": Status(int(steady.status)).name.lower(),
        "determinant_residual": found.determinant_residual,
        "torques_left_out": [k + 1 for k in loose] or None,
    }


def _multipliers(found: Floquet) -> Values:
    left = found.multipliers[np.isfinite(found.multipliers)]
    return {
        "multiplier_modulus_sorted": np.abs(left),
        "multiplier_angle_deg": np.angle(left),
        "multipliers_removed": int(found.removed),
    }


def _response(values: Values) -> Values:
    found = _steady(model_of(values), values)
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


def _table(orders: list[str], curves: Orders) -> list[dict[str, Array]]:
    return [dict(zip(orders, row, strict=True)) for row in curves.amplitude]


CALCULATIONS = (
    Calculation(
        name="periodic_response",
        doc=mark("steady torsional running at a speed: torque of every element and speed of every station by orders"),
        source="harmonic balance of the exact equations of motion",
        takes=(*MODEL, MEAN_SPEED),
        returns=(
            gives("elements", mark("of every element: mean, amplitude and phase of each order, true extremes")),
            gives("station_speed_order_amplitude_rad_s", mark("amplitude of every station's speed by order")),
            gives("constant_drive_torque_Nm", mark("constant torque on the first station that keeps the mean speed")),
            gives("drive_torque_mean_Nm", mark("mean torque that the input needs to turn at its speed")),
            gives("drive_torque_order_amplitude_Nm", mark("amplitude of that torque by order")),
            gives("stable", mark("whether small disturbances decay")),
            gives("verdict", mark("stable, neutral, unstable or unknown")),
            gives("status", mark("converged, coarse or no_convergence")),
            gives("residual", mark("by how much the equations fail to hold, over the largest torque")),
            gives("power_residual", mark("what the power balance misses, over the power that flows")),
        ),
        answer=_response,
        check=speed_problems,
    ),
    Calculation(
        name="floquet_stability",
        doc=mark(
            "whether steady torsional running is stable: multipliers of a period, growth, nearest zone of resonance"
        ),
        source="exact equations of motion linearised about their periodic motion",
        takes=(*MODEL, MEAN_SPEED),
        returns=(
            gives("multiplier_period_rad", mark("shaft angle of a period")),
            gives("multiplier_modulus_sorted", mark("by what each disturbance is multiplied over a period")),
            gives("multiplier_angle_deg", mark("angle of these multipliers"), "angle"),
            gives("multipliers_removed", mark("left out of a free drive: shift in time, and any speed being possible")),
            gives("spectral_radius", mark("the largest of them")),
            gives("stable", mark("whether every disturbance decays")),
            gives("verdict", mark("stable, neutral, unstable or unknown")),
            gives("growth_rate_1_per_s", mark("rate at which the largest disturbance grows")),
            gives("kind", mark("how a growing disturbance oscillates: repeating, doubling or combination")),
            gives("disturbance_order", mark("lowest order at which it oscillates")),
            gives("nearest_zone", mark("nearest zone of parametric resonance")),
            gives("nearest_zone_rad_s", mark("its speed by the straight drive")),
            gives("status", mark("of the steady motion: converged, coarse or no_convergence")),
            gives("determinant_residual", mark("what the product of the multipliers misses against the damping")),
            gives("torques_left_out", mark("numbers of torques whose order does not repeat within two turns")),
        ),
        answer=_stability,
        check=speed_problems,
    ),
)
