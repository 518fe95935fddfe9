"""Questions that need the whole drive: asked of one drive after another."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from cardan.drive.drive import Drive
from cardan.errors import refuse
from cardan.texts import _, mark

from .questions import Question, Told

MODES = 3
"""How many natural frequencies and critical speeds are told."""


def _losses(drive: Drive) -> Sequence[float]:
    from cardan.questions.losses.losses import losses

    found = losses(drive)
    if found.locked:
        raise refuse("joints", _("friction in the journals reaches what turns them"))
    return (found.efficiency, found.heat)


def _life(drive: Drive) -> Sequence[float]:
    from cardan.questions.life.life import life

    return (life(drive).drive,)


def _strength(drive: Drive) -> Sequence[float]:
    from cardan.checks.strength.strength import strength

    found = strength(drive)
    return (found.utilisation, found.rated_torque)


def _check(drive: Drive) -> Sequence[float]:
    from cardan.checks.checks import check

    judged = [one for one in check(drive) if one.run and not one.advice]
    used = [float(np.max(one.utilisation)) for one in judged]
    return (max(used, default=0.0), float(sum(not one <= 1.0 for one in used)))


def _critical_speed(drive: Drive) -> Sequence[float]:
    from cardan.questions.bending.bending import bending_speeds

    return _first(bending_speeds(drive, modes=MODES).actual)


def _torsion(drive: Drive) -> Sequence[float]:
    from cardan.questions.torsion.model.torsion import torsion_modes

    return _first(torsion_modes(drive).omega)


def _first(values: np.ndarray) -> list[float]:
    """Return the first `MODES` values, nan where there are fewer."""
    kept = [float(one) for one in values[:MODES]]
    return kept + [math.nan] * (MODES - len(kept))


def _stability(drive: Drive) -> Sequence[float]:
    from cardan.questions.torsion.stability.torsion_stability import stability
    from cardan.questions.torsion.steady.run_stability import Verdict

    found = stability(drive)
    if int(found.verdict) == Verdict.UNKNOWN:
        raise refuse("", _("no steady motion was found"))
    return (float(found.growth_rate), float(found.spectral_radius), float(found.verdict == Verdict.UNSTABLE))


def _tolerance(drive: Drive) -> Sequence[float]:
    from cardan.questions.accuracy.tolerance import tolerance

    found = tolerance(drive)
    return (found.output.largest, found.output.peak_to_peak, found.shift.largest)


def _forces(drive: Drive) -> Sequence[float]:
    from cardan.questions.forces.forces import forces

    found = forces(drive)
    held = math.nan if found.reaction is None or not found.support_shaft else float(np.max(found.radial))
    return (float(np.max(found.bending_couple)), held, float(np.max(np.abs(found.input_torque))))


def _movement(drive: Drive) -> Sequence[float]:
    from cardan.questions.motion.articulation import articulation

    found = articulation(drive)
    strokes = [one.stroke for one in found.splines]
    return (
        float(np.nanmax(found.joint_angle)),
        float(np.nanmax(found.speed_fluctuation)),
        max(strokes, default=0.0),
    )


def _mass(drive: Drive) -> Sequence[float]:
    from cardan.drive.body import body_length, weight
    from cardan.drive.fields.parts import known_lengths

    known = known_lengths(drive)
    inside = drive.shafts[1:-1]
    found = [weight(shaft, body_length(shaft, known.get(shaft.number))).mass for shaft in inside]
    lacking = [shaft.number - 1 for shaft, mass in zip(inside, found, strict=True) if not mass]
    if lacking:
        raise refuse(f"shafts[{lacking[0]}].outer", _("missing; the mass of the shaft needs it, or its mass itself"))
    return (float(sum(mass for mass in found if mass)),)


def _numbered(stem: str, dimension: str, unit: str, text: str) -> tuple[Told, ...]:
    return tuple(Told(name=f"{stem}_{unit}[{k}]", dimension=dimension, unit=unit, text=text) for k in range(MODES))


DRIVE = (
    Question(
        name="check",
        doc=mark("greatest utilisation over all checks that the drive can be put to, and how many fail"),
        told=lambda _drive: (
            Told(name="utilisation", text=mark("greatest utilisation of a limit")),
            Told(name="failed_checks", text=mark("how many checks fail")),
        ),
        of_one=_check,
    ),
    Question(
        name="losses",
        doc=mark("efficiency and heat at the speed and torque of the duty"),
        told=lambda _drive: (
            Told(name="efficiency", text=mark("efficiency")),
            Told(name="heat_W", dimension="power", unit="W", text=mark("heat of the drive")),
        ),
        of_one=_losses,
    ),
    Question(
        name="life",
        doc=mark("life of the bearings of the joints, the shortest of them"),
        told=lambda _drive: (Told(name="life_h", dimension="time", unit="h", text=mark("life of the drive")),),
        of_one=_life,
    ),
    Question(
        name="strength",
        doc=mark("greatest use of the strength of a part, and the torque at which it is used up"),
        told=lambda _drive: (
            Told(name="strength_used", text=mark("greatest use of the strength of a part")),
            Told(name="rated_torque_Nm", dimension="torque", unit="Nm", text=mark("torque that uses the strength up")),
        ),
        of_one=_strength,
    ),
    Question(
        name="critical_speed",
        doc=mark("bending critical speeds of the real shafts, lowest first"),
        told=lambda _drive: _numbered("critical_speed", "angular_speed", "rpm", mark("bending critical speed")),
        of_one=_critical_speed,
    ),
    Question(
        name="natural_frequency",
        doc=mark("torsional natural frequencies, slowest first"),
        told=lambda _drive: _numbered("natural_frequency", "frequency", "Hz", mark("torsional natural frequency")),
        of_one=_torsion,
    ),
    Question(
        name="stability",
        doc=mark("whether a small torsional disturbance grows, and how fast"),
        told=lambda _drive: (
            Told(name="growth_rate", text=mark("growth rate of the disturbance slowest to decay, 1/s")),
            Told(name="spectral_radius", text=mark("largest modulus of the Floquet multipliers")),
            Told(name="unstable", text=mark("1 where a disturbance grows, else 0")),
        ),
        of_one=_stability,
    ),
    Question(
        name="tolerance",
        doc=mark("what the tolerances of the drive leave open at its output"),
        told=lambda _drive: (
            Told(name="error_arcmin", dimension="angle", unit="arcmin", text=mark("largest error of the output angle")),
            Told(name="error_change_arcmin", dimension="angle", unit="arcmin", text=mark("change of it over a turn")),
            Told(name="shift_mm", dimension="length", unit="mm", text=mark("largest shift of the output along itself")),
        ),
        of_one=_tolerance,
    ),
    Question(
        name="forces",
        doc=mark("largest secondary couple, support force and input torque over a turn"),
        told=lambda _drive: (
            Told(name="couple_Nm", dimension="torque", unit="Nm", text=mark("largest secondary couple of a shaft")),
            Told(name="support_N", dimension="force", unit="N", text=mark("largest radial force on a support")),
            Told(name="input_torque_Nm", dimension="torque", unit="Nm", text=mark("largest torque at the input")),
        ),
        of_one=_forces,
    ),
    Question(
        name="movement",
        doc=mark("what the movements of the drive ask: bend, speed fluctuation, stroke of the splines"),
        told=lambda _drive: (
            Told(
                name="moving_joint_angle_deg",
                dimension="angle",
                unit="deg",
                text=mark("greatest joint angle while it moves"),
            ),
            Told(name="moving_speed_fluctuation", text=mark("greatest speed fluctuation while it moves")),
            Told(name="stroke_mm", dimension="length", unit="mm", text=mark("stroke of the splines")),
        ),
        of_one=_movement,
    ),
    Question(
        name="mass",
        doc=mark("mass of the shafts between the joints"),
        told=lambda _drive: (Told(name="mass_kg", dimension="mass", unit="kg", text=mark("mass of the shafts")),),
        of_one=_mass,
    ),
)
"""Questions about the whole drive."""
