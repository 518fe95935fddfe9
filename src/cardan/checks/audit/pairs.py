"""Pairs of answers about one drive that speak of the same quantity: how each tells it, and how closely they agree.

A reading gives the values of a quantity in SI by the part they are of, as paths name it; nothing where the question
does not answer, or where what one of them counts the other leaves out on purpose and says so.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from cardan.checks.angles import acceleration, joint_angle, output_error, speed_fluctuation
from cardan.checks.check import Check
from cardan.checks.event_loads import followed
from cardan.checks.load_case import largest
from cardan.checks.moving import happening
from cardan.checks.practice import spline_overlap
from cardan.checks.speeds import balance, critical_speed
from cardan.checks.speeds.whirl import whirls
from cardan.checks.strength.joints import bearing_life
from cardan.checks.strength.section import sections
from cardan.checks.strength.shaft_life import STRENGTHS, fatigue, fatigue_life, lasting
from cardan.checks.supports import support_life
from cardan.checks.torsion.parametric_stability import CHECK as PARAMETRIC
from cardan.checks.torsion.torque_reversal import CHECK as REVERSAL
from cardan.drive.models.kinematics_model import mixed, unmapped
from cardan.drive.models.wobble import wobbling
from cardan.drive.torsional_layout import has_torsion
from cardan.maths.arrays import Array
from cardan.maths.curves.extremes import peak
from cardan.mechanism.constraints import FRAME, constraints
from cardan.questions.accuracy.accuracy import one_turn, sensitivity
from cardan.questions.forces.reactions import Determinacy
from cardan.questions.mobility.mobility import stresses
from cardan.questions.motion.motion import motion
from cardan.questions.motion.standing import still
from cardan.questions.motion.turning import each_shaft
from cardan.questions.torsion.model.excitation import turns_freely
from cardan.questions.torsion.model.torsional_train import TorsionalTrain
from cardan.questions.torsion.steady.run_stability import Verdict as Stability
from cardan.questions.torsion.steady.torsion_response import TorsionResponse
from cardan.questions.torsion.transient.torsion_transient import Transient
from cardan.texts import mark

from .asked import Asked, of_parts

Values: TypeAlias = Mapping[str, float]
"""Values of a quantity in SI by the path of the part they are of; empty for the drive as a whole."""

Sense: TypeAlias = Literal["same", "at_most"]
"""Whether both must be the same, or the first at most as large as the second."""

FOLLOWS = 1e-9
"""Both ways are exact: rounding, amplified by joints that bend steeply."""

DRAWN = 1e-2
"""One way takes stiffness and masses as drawn: a thousandth of them, amplified by resonance."""

SAMPLED = 1e-4
"""One way looks at places of a turn, and meets a kink of friction or the top of a curve between them so closely."""

FOUND = 1e-3
"""Both ways search: the tops of torques that swing in high orders are met so closely between the places looked at."""

RUBBING = 1e-3
"""Share of the input power that supports may turn to heat where their friction is left out of one of two answers."""


@dataclass(frozen=True, kw_only=True)
class Pair:
    """Two answers that speak of the same quantity."""

    quantity: str  # what both speak of, marked for translation
    first: str  # names of the questions or checks, as of `cardan.register.QUESTIONS` and `CHECKS`
    second: str
    read: tuple[Callable[[Asked], Values], Callable[[Asked], Values]]  # how each tells it; the same parts are compared
    tolerance: float  # share of the larger value by which they may differ
    why: str  # why they may, marked for translation
    dimension: str = ""  # of `cardan.units.DIMENSIONS`
    sense: Sense = "same"
    least: float = 0.0  # size in SI up to which the tolerance is a share of this
    quick: bool = True  # whether an ordinary check compares them: nothing is asked for it that takes long


EXACT = mark("both are exact, to rounding")
BETWEEN = mark("one looks at places of a turn, and between them by curves")
SEARCHED = mark("both search the top of a curve between places of a turn")
DAMPED = mark("damping takes more; one looks at places of a turn")
COUNTED = mark("a yes or a no")


# Motion.


def _uneven(asked: Asked) -> Values:
    return of_parts("shafts", asked.even.speed_fluctuation, 2)


def _seen_uneven(asked: Asked) -> Values:
    ratio = asked.motion.shaft_ratio[1:]
    return of_parts("shafts", peak(ratio[:, :-1], smooth=True) + peak(-ratio[:, :-1], smooth=True), 2)


def _phased(asked: Asked) -> Values:
    if unmapped(asked.drive.joints):
        return {}  # the phasing says what it leaves out, and seeks yoke angles long
    found = asked.phasing
    return {} if found is None else of_parts("shafts", found.as_built.shaft_speed_fluctuation, 2)


def _judged(check: Check, *, errors: bool = True) -> Callable[[Asked], Values]:
    """Return how the verdicts of a check tell its value; without errors only where no joint has any."""

    def read(asked: Asked) -> Values:
        if not errors and any(joint.error is not None for joint in asked.drive.joints):
            return {}
        return {one.subject: float(np.max(one.value)) for one in asked.verdicts(check)}

    return read


def _angle_error(asked: Asked) -> Values:
    return {f"shafts[{len(asked.drive.joints)}]": float(asked.even.max_angle_error[-1])}


def _output_uneven(asked: Asked) -> Values:
    return {f"shafts[{len(asked.drive.joints)}]": float(asked.even.speed_fluctuation[-1])}


def _seen_error(asked: Asked) -> Values:
    lead = asked.motion.angle_error[-1, :-1]
    return {f"shafts[{len(asked.drive.joints)}]": 0.5 * float(peak(lead) + peak(-lead))}


def _accelerated(asked: Asked) -> Values:
    top = asked.here.top_speed
    if top is None:
        return {}
    return {f"shafts[{len(asked.drive.joints)}]": float(np.max(top)) ** 2 * float(asked.even.max_acceleration[-1])}


def _bent(asked: Asked) -> Values:
    if any(one.joint_angle is not None for one in asked.drive.duty.blocks):
        return {}
    return of_parts("joints", asked.motion.joint_angle)


def _felt(asked: Asked) -> Values:
    """Return least and largest speed ratio as the accuracy has it: how the output feels the phase of joint 1."""
    if mixed(asked.drive.joints):
        return {}
    felt = sensitivity(asked.drive, one_turn())[:, 0, 0]
    return {"least": -float(peak(-felt)), "largest": float(peak(felt))}


def _ratios(asked: Asked) -> Values:
    return {"least": float(asked.even.ratio_min[-1]), "largest": float(asked.even.ratio_max[-1])}


def _moving(asked: Asked) -> Values:
    found = asked.articulation
    if found is None or unmapped(asked.drive.joints):
        return {}
    return {one.what: one.value for one in found.worst if one.what in ("speed_fluctuation", "joint_angle")}


def _standing(asked: Asked) -> Values:
    """Return the same of the drive that stands as it does at the worst instants."""
    found = asked.articulation
    if found is None or unmapped(asked.drive.joints):
        return {}
    told = {}
    for one in found.worst:
        if one.what == "speed_fluctuation":
            told[one.what] = float(each_shaft(still(asked.design.drive, one.time)).speed_fluctuation[one.number - 2])
        if one.what == "joint_angle":
            here = motion(still(asked.design.drive, one.time), [0.0])
            told[one.what] = float(here.joint_angle[one.number - 1])
    return told


def _engaged(asked: Asked) -> Values:
    """Return engaged length and way left to bottoming of every spline while the drive moves."""
    found = asked.articulation
    told: dict[str, float] = {}
    for one in found.splines if found is not None else ():
        for what, value in (("engaged", one.engaged_min), ("gap", one.gap_min)):
            if value is not None:
                told[f"shafts[{one.shaft - 1}].spline.{what}"] = value
    return told


def _engaged_judged(asked: Asked) -> Values:
    told: dict[str, float] = {}
    for one in spline_overlap.CHECK.verdicts(asked.moving) if asked.articulation is not None else ():
        if one.run and one.design_variables:
            told[one.design_variables[0]] = float(np.max(one.value))
    return told


# Torques, forces and heat.


def _light(asked: Asked) -> bool:
    """Tell whether neither friction, masses nor torsional vibration change the torques of the duty."""
    whole, case = asked.train, asked.case
    if whole is None or case is None or case.vibration is not None:
        return False
    if whole.rubs or whole.resisting_torque is not None:
        return False
    return not asked.drive.duty.speed or (whole.inertia is None and whole.cross_inertia is None)


def _torque_carried(asked: Asked) -> Values:
    found = asked.forces
    if found is None or not _light(asked):
        return {}
    return of_parts("shafts", peak(np.abs(found.shaft_torque[:, :-1])))


def _torque_counted(asked: Asked) -> Values:
    case = asked.case
    return {} if case is None else of_parts("shafts", case.shaft_torque)


def _couple_carried(asked: Asked) -> Values:
    """Return the largest part across each shaft of the couples that the joints at its ends put on it."""
    found = asked.forces
    if found is None or not _light(asked) or any(joint.ball is not None for joint in asked.drive.joints):
        return {}  # strength takes the couples of pins that meet

    def across(couple: Array, axis: Array) -> Array:
        """Return the largest part of couples (n, p, 3) across axes (n, p, 3) [N·m]."""
        along = np.sum(couple * axis, axis=-1, keepdims=True)
        return peak(np.linalg.norm(couple - along * axis, axis=-1)[:, :-1])

    before = across(found.driving_couple, found.axis[:-1])
    behind = across(found.driven_couple, found.axis[1:])
    return of_parts("shafts", np.maximum(np.append(before, 0.0), np.append(0.0, behind)))


def _couple_counted(asked: Asked) -> Values:
    case = asked.case
    return {} if case is None else of_parts("shafts", case.end_bending)


def _journals_carried(asked: Asked) -> Values:
    """Return the largest load of the journals of every joint, where no forces through the joints add to it."""
    found, whole = asked.forces, asked.train
    if found is None or whole is None or found.joint_force is not None or whole.cross_inertia is not None:
        return {}
    size = np.max(found.journals.size[..., :-1, :], axis=-1)
    return of_parts("joints", asked.drive.duty.shock_factor * peak(size))


def _journals_lasting(asked: Asked) -> Values:
    found = asked.life
    steady = found is not None and len(found.parts) == 1 and all(math.isnan(one) for one in found.vibration)
    if not steady or found is None or found.parts[0].path not in ("", "duty"):
        return {}
    return of_parts("joints", found.journal_force[0])


def _supports_carried(asked: Asked) -> Values:
    """Return the largest radial force on every support."""
    found = asked.forces
    if found is None or found.reaction is None:
        return {}
    ways = [found] if found.reverse is None else [found, found.reverse]
    return of_parts("supports", asked.drive.duty.shock_factor * np.max([np.max(one.radial, -1) for one in ways], 0))


def _supports_lasting(asked: Asked) -> Values:
    """Return the same of the supports that have a bearing, under the torque of the duty itself."""
    found = asked.life
    if found is None or found.supports is None:
        return {}
    rows = [k for k, part in enumerate(found.parts) if part.path == "duty"]
    return {
        f"supports[{number - 1}]": float(found.supports.loads.radial[k, place])
        for k in rows
        for place, number in enumerate(found.supports.number)
    }


def _rubs(asked: Asked) -> bool:
    """Tell whether losses and forces count the same friction, in one condition; losses take crosses without mass."""
    found, whole = asked.losses, asked.train
    if found is None or found.each or found.locked or not abs(found.input_power) > 0.0:
        return False
    if whole is None or whole.cross_inertia is not None or wobbling(asked.drive):
        return False  # losses leave the wobble of shafts out, and say so
    return found.heat - float(np.sum(found.joints)) <= RUBBING * SAMPLED * abs(found.input_power)


def _heat_of_forces(asked: Asked) -> Values:
    found = asked.forces
    if found is None or not _rubs(asked):
        return {}
    return of_parts("joints", np.mean(found.loss[:, :-1], axis=-1))


def _heat_of_losses(asked: Asked) -> Values:
    return of_parts("joints", asked.losses.joints) if asked.losses is not None and _rubs(asked) else {}


def _power_of_forces(asked: Asked) -> Values:
    found = asked.forces
    if found is None or not _rubs(asked):
        return {}
    entering = found.input_torque * found.speed[0]
    leaving = found.output_torque * found.speed[-1]
    return {"input": float(np.mean(entering[:-1])), "output": float(np.mean(leaving[:-1]))}


def _power_of_losses(asked: Asked) -> Values:
    found = asked.losses
    if found is None or not _rubs(asked):
        return {}
    return {"input": found.input_power, "output": found.output_power}


def _held_up(asked: Asked) -> Values:
    """Return the sum of all forces of the supports over the largest of them, along each axis."""
    found = asked.forces
    if found is None or found.reaction is None:
        return {}
    largest = float(np.max(np.abs(found.reaction)))
    total = np.mean(np.sum(found.reaction[:, :-1], axis=0), axis=0)
    return of_parts("axes", total / largest) if largest > 0.0 else {}


def _weighing(asked: Asked) -> Values:
    """Return the weight of all parts the other way round, over the same force."""
    found, whole = asked.forces, asked.train
    if found is None or found.reaction is None or whole is None or whole.gravity is None:
        return {}
    largest = float(np.max(np.abs(found.reaction)))
    mass = sum(float(np.sum(one)) for one in (whole.mass, whole.cross_mass) if one is not None)
    return of_parts("axes", -mass * np.asarray(whole.gravity) / largest) if largest > 0.0 else {}


# Strength and life.


def _life_judged(asked: Asked) -> Values:
    return {one.subject: float(np.max(one.value)) for one in asked.verdicts(bearing_life.CHECK)}


def _life_told(asked: Asked) -> Values:
    found = asked.life
    return {} if found is None else of_parts("joints", found.of("iso"))


def _supports_told(asked: Asked) -> Values:
    found = asked.life
    if found is None or found.supports is None:
        return {}
    return {f"supports[{n - 1}]": float(one) for n, one in zip(found.supports.number, found.of_supports, strict=True)}


def _supports_judged(asked: Asked) -> Values:
    return {one.subject: float(np.max(one.value)) for one in asked.verdicts(support_life.CHECK)}


def _fatigued(asked: Asked) -> Values:
    """Return of every shaft whether the ways of running that make up its time keep below its endurance, 1, or not."""
    return _endurance(asked, lambda k: min(_safeties(asked, k)) > 1.0)


def _endless(asked: Asked) -> Values:
    """Return of every shaft whether its life is without end."""
    return _endurance(asked, lambda k: math.isinf(float(fatigue_life(asked.here, k))))


def _safeties(asked: Asked, k: int) -> list[float]:
    here = asked.here
    return [float(fatigue(here, k, one, case).safety) for one in sections(here, k) for case in lasting(here)]


def _endurance(asked: Asked, lasts: Callable[[int], bool]) -> Values:
    here = asked.here
    if not lasting(here) or here.duty.torque_history is not None or here.events:
        return {}  # what is measured, and starts and events, damage beside the ways of running
    found = {}
    for k in range(here.joints + 1):
        stretches = list(sections(here, k))
        strengths = [one.of_material(name) for one in stretches for name in STRENGTHS]
        if not stretches or here.drive.shafts[k].layup is not None or here.missing(*strengths):
            continue
        if all(abs(one - 1.0) > FOUND for one in _safeties(asked, k)):  # at the endurance itself rounding decides
            found[f"shafts[{k}]"] = float(lasts(k))
    return found


# Torsional vibration.


def _torque_of_response(asked: Asked) -> Values:
    """Return the largest torque of every shaft at the speed of the duty."""
    found, case = asked.response, asked.case
    if found is None or case is None or not bool(np.all(found.steady.found)):
        return {}
    return _of_response(found)


def _of_response(found: TorsionResponse) -> Values:
    """Return the largest torque of every shaft in steady motion."""
    return _by_shaft(found.train, np.maximum(np.abs(found.torque_lowest), np.abs(found.torque_highest)))


def _by_shaft(train: TorsionalTrain, size: Array) -> Values:
    """Return the largest torque of every shaft, from those of the elements (E,)."""
    told: dict[str, float] = {}
    for e, (a, b) in enumerate(train.model.elements):
        if train.hangs[b] is None:
            path = f"shafts[{train.model.shaft[a]}]"
            told[path] = max(told.get(path, 0.0), float(size[e]))
    return told


def _torque_steady(asked: Asked) -> Values:
    """Return the largest torque of every shaft in a steady motion that keeps to itself."""
    found, followed_too = asked.response, asked.simulated
    if found is None or followed_too is None or not followed_too.complete:
        return {}
    return _of_response(found)


def _torque_in_time(asked: Asked) -> Values:
    """Return the same as it is followed in time."""
    found = asked.simulated
    return {} if found is None else _by_shaft(found.train, _largest(found))


def _largest(found: Transient) -> Array:
    """Return the largest torque of every element in time, array (E,)."""
    ends = found.motion.extremes
    return np.maximum(np.abs(ends.torque_low), np.abs(ends.torque_high))


def _torque_in_run_up(asked: Asked) -> Values:
    """Return the largest torque of every shaft in the run-up, followed to the end, where starts count."""
    found = asked.run_up if asked.drive.duty.starts is not None else None
    if found is None or found.motion is None or not found.motion.complete:
        return {}
    if np.any(found.motion.train.model.backlash > 0.0):
        return {}  # what is counted of starts takes backlash as closed, and says so
    return _by_shaft(found.motion.train, _largest(found.motion))


def _torque_in_starts(asked: Asked) -> Values:
    """Return the same as a start has it."""
    courses = followed(asked.drive)
    return {} if isinstance(courses, tuple) else {f"shafts[{k}]": one.largest for k, one in courses.items()}


def _torque_in_events(asked: Asked) -> Values:
    """Return the largest torque of every shaft in starts and other events, as they are followed in time."""
    told: dict[str, float] = {}
    for _k, event, _count in asked.here.events if has_torsion(asked.drive) else ():
        courses = followed(asked.drive, event)
        for k, one in courses.items() if isinstance(courses, dict) else ():
            told[f"shafts[{k}]"] = max(told.get(f"shafts[{k}]", 0.0), one.largest)
    return told


def _torque_borne(asked: Asked) -> Values:
    """Return the largest torque that strength counts for every shaft, running and in events."""
    every = (*asked.here.loaded, *(one.cases[0] for _said, one in happening(asked.here)))
    return of_parts("shafts", largest([one.shaft_torque for one in every])) if asked.here.loaded else {}


def _steady_torque(asked: Asked) -> Values:
    """Return the mean torque that drives the input at the speed of the duty, as the vibration has it."""
    found, duty = asked.response, asked.drive.duty
    if found is None or not bool(np.all(found.steady.found)) or turns_freely(asked.drive, duty) or duty.torques:
        return {}
    return {"": float(found.steady.drive_torque.mean[..., 0])}


def _driving_torque(asked: Asked) -> Values:
    """Return the same without damping, where no friction counts either."""
    found, whole, duty = asked.forces, asked.train, asked.drive.duty
    plain = duty.torque_at == "output" and (duty.speed or 0.0) > 0.0 and duty.load is None
    if found is None or whole is None or whole.rubs or whole.resisting_torque is not None or not plain:
        return {}
    return {"": float(np.mean(found.input_torque[:-1]))}


def _grows(asked: Asked) -> Values:
    found = asked.response
    return {} if found is None else {"": float(int(found.floquet.verdict) == Stability.UNSTABLE)}


def _damped(asked: Asked) -> Values:
    """Return whether the check of parametric resonance fails or is near to it."""
    found = asked.verdicts(PARAMETRIC)
    return {"": float(not all(one.met for one in found))} if found else {}


def _dip_along(asked: Asked) -> Values:
    """Return by how much torques that reverse along the movement fall below that of the duty."""
    found, torque = asked.road, abs(asked.drive.duty.torque or 0.0)
    if found is None or not torque or found.standing.times is None or np.any(found.train.model.backlash > 0.0):
        return {}  # a distribution has no instants, and open backlash is told at some of them
    told: dict[str, float] = {}
    places, model = found.standing, found.train.model
    length = np.linalg.norm(np.diff(places.points, axis=-2), axis=-1)[:, 1:-1]
    if not places.found.any() or np.any(np.abs(length / found.drawn - 1.0) > FOUND):
        return {}  # its masses and stiffness count as drawn
    for e in found.line:
        path = f"shafts[{model.shaft[model.elements[e][0]]}]"
        back = np.where(places.mean[:, e] < 0.0, places.high[:, e], -places.low[:, e])
        if np.nanmax(back) > FOUND * np.nanmax(places.largest[:, e]):
            told[path] = max(told.get(path, 0.0), torque + float(np.nanmax(back)))
    return told


def _dip_judged(asked: Asked) -> Values:
    """Return the same as judged, 0 of a shaft whose torque does not reverse."""
    if asked.case is None:
        return {}
    torque, told = abs(asked.drive.duty.torque or 0.0), {f"shafts[{k}]": 0.0 for k in range(len(asked.drive.shafts))}
    for one in asked.verdicts(REVERSAL, moving=True):
        told[one.subject] = torque + float(np.max(one.value)) - one.bound
    return told


# Bending.


def _whirl_judged(asked: Asked) -> Values:
    return {f"shafts[{one.shaft}]": float(np.max(one.actual)) for one in whirls(asked.here) if one.exact}


def _whirl_told(asked: Asked) -> Values:
    found = asked.bending
    if found is None:
        return {}
    told: dict[str, float] = {}
    for part, speed in zip(found.part, found.actual, strict=True):
        if part.kind == "shaft":
            told.setdefault(f"shafts[{part.number - 1}]", float(speed))
    return told


def _margin_judged(asked: Asked) -> Values:
    """Return the least margin of the shafts that whirl, in the verdicts."""
    found = [float(np.max(one.value)) for one in asked.verdicts(critical_speed.CHECK) if one.sense == "at_least"]
    return {"": min(found)} if found and asked.bending is not None else {}


def _margin_told(asked: Asked) -> Values:
    found = asked.bending
    if found is None or found.margin is None:
        return {}
    return {"": float(found.margin.ratio)}


def _one_mass(asked: Asked) -> Values:
    found = asked.rotor
    return {} if found is None else {f"shafts[{found.shaft - 1}]": found.critical}


def _balanced_mass(asked: Asked) -> Values:
    found = asked.balance
    return {} if found is None else {f"shafts[{one.number - 1}]": one.mass for one in found.shafts}


def _unbalanced(asked: Asked) -> Values:
    """Return the unbalance of every shaft between joints over what its grade allows, in the worse plane."""
    found = asked.balance
    if found is None or (asked.drive.duty.balance_class and not asked.drive.duty.balance_grade):
        return {}
    used = {f"shafts[{one.number - 1}]": [plane.utilisation for plane in one.planes] for one in found.shafts}
    return {path: max(two) for path, two in used.items() if two}


def _unbalance_judged(asked: Asked) -> Values:
    told: dict[str, float] = {}
    for one in asked.verdicts(balance.CHECK):
        told.setdefault(one.subject, float(np.max(one.value)) / float(np.max(np.asarray(one.limit))))
    return told


def _mass_carried(asked: Asked) -> Values:
    whole = asked.train
    return {} if whole is None or whole.mass is None else of_parts("shafts", whole.mass)


# What holds the shafts.


def _adrift(asked: Asked) -> Values:
    """Return whether shafts move while the input stands still."""
    found = asked.mobility
    return {} if found is None or found.parasitic is None or not found.certain else {"": float(found.parasitic > 0)}


def _housed(asked: Asked) -> bool:
    """Tell whether statics takes a housing to centre the shafts of a joint, and says so."""
    return any(joint.centred for joint in asked.drive.joints)


def _loose(asked: Asked) -> Values:
    """Return whether statics finds a shaft that nothing holds."""
    found = asked.forces
    return (
        {}
        if found is None or found.reaction is None or _housed(asked)
        else {"": float(np.any(found.status == Determinacy.LOOSE))}
    )


def _standing_fast(asked: Asked) -> Values:
    """Return whether shafts stand fast while the input stands still."""
    return {part: 1.0 - one for part, one in _adrift(asked).items()}


def _bows(asked: Asked) -> Values:
    """Return whether the line whirls at a speed above zero, as one that is held does."""
    found = asked.bending
    return {} if found is None else {"": float(np.min(found.speed) > 0.0)}


def _twice(asked: Asked) -> Values:
    """Return how many of the redundant constraints load what holds the shafts; others stay within a joint."""
    found = asked.mobility
    if found is None or not found.certain or found.mobility < 1:
        return {}  # of a drive that is locked the assembly counts what binds as one hold too many
    if not found.redundant:
        return {"": 0.0}
    system = constraints(found.mechanism)
    held = [k for k, ends in enumerate(system.ends) if FRAME in ends]
    loads = stresses(system)[:, held]
    return {"": float(np.linalg.matrix_rank(loads.reshape(len(loads), -1), tol=STRAINED))}


def _degree(asked: Asked) -> Values:
    found = asked.assembly
    return {} if found is None or _housed(asked) else {"": float(found.degree)}


def _surplus(asked: Asked) -> Values:
    """Return whether the balance of the shafts does not tell the forces of all supports."""
    found = asked.forces
    if found is None or found.reaction is None or _housed(asked):
        return {}
    return {"": float(np.any(found.status == Determinacy.INDETERMINATE))}


def _redundant(asked: Asked) -> Values:
    return {part: float(one > 0.0) for part, one in _twice(asked).items()}


STRAINED = 1e-6
"""Load of a support, beside unit loads within the drive, that is more than rounding."""

PAIRS: tuple[Pair, ...] = (
    Pair(
        quantity=mark("speed fluctuation of every shaft"),
        first="motion",
        second="motion",
        read=(_uneven, _seen_uneven),
        tolerance=SAMPLED,
        why=BETWEEN,
        dimension="share",
        least=1e-3,
    ),
    Pair(
        quantity=mark("speed fluctuation of every shaft"),
        first="motion",
        second="phasing",
        read=(_uneven, _phased),
        tolerance=FOLLOWS,
        why=EXACT,
        dimension="share",
        least=1.0,
        quick=False,
    ),
    Pair(
        quantity=mark("speed fluctuation of the output"),
        first="motion",
        second="speed_fluctuation",
        read=(_output_uneven, _judged(speed_fluctuation.CHECK, errors=False)),
        tolerance=FOLLOWS,
        why=EXACT,
        dimension="share",
        least=1.0,
    ),
    Pair(
        quantity=mark("angle error of the output"),
        first="motion",
        second="output_error",
        read=(_angle_error, _judged(output_error.CHECK, errors=False)),
        tolerance=FOLLOWS,
        why=EXACT,
        dimension="angle",
        least=1.0,
    ),
    Pair(
        quantity=mark("angle error of the output"),
        first="motion",
        second="motion",
        read=(_angle_error, _seen_error),
        tolerance=SAMPLED,
        why=BETWEEN,
        dimension="angle",
        least=1e-3,
    ),
    Pair(
        quantity=mark("acceleration of the output"),
        first="motion",
        second="acceleration",
        read=(_accelerated, _judged(acceleration.CHECK)),
        tolerance=FOLLOWS,
        why=EXACT,
        dimension="angular_acceleration",
        least=1.0,
    ),
    Pair(
        quantity=mark("joint angles"),
        first="motion",
        second="joint_angle",
        read=(_bent, _judged(joint_angle.CHECK)),
        tolerance=FOLLOWS,
        why=EXACT,
        dimension="angle",
        least=1.0,
    ),
    Pair(
        quantity=mark("speed ratio of the output"),
        first="motion",
        second="accuracy",
        read=(_ratios, _felt),
        tolerance=1e-6,
        why=BETWEEN,
    ),
    Pair(
        quantity=mark("the drive at the worst instants of its movement"),
        first="articulation",
        second="motion",
        read=(_moving, _standing),
        tolerance=1e-6,
        why=SEARCHED,
        least=1.0,
        quick=False,
    ),
    Pair(
        quantity=mark("engaged length and remaining travel of every spline"),
        first="articulation",
        second="spline_overlap",
        read=(_engaged, _engaged_judged),
        tolerance=1e-6,
        why=SEARCHED,
        dimension="length",
        least=0.1,
        quick=False,
    ),
    Pair(
        quantity=mark("torque of every shaft"),
        first="forces",
        second="strength",
        read=(_torque_carried, _torque_counted),
        tolerance=SAMPLED,
        why=BETWEEN,
        dimension="torque",
    ),
    Pair(
        quantity=mark("secondary couple of every shaft"),
        first="forces",
        second="strength",
        read=(_couple_carried, _couple_counted),
        tolerance=FOUND,
        why=BETWEEN,
        dimension="torque",
        least=1e-6,
    ),
    Pair(
        quantity=mark("load of the journals of every joint"),
        first="forces",
        second="life",
        read=(_journals_carried, _journals_lasting),
        tolerance=FOUND,
        why=BETWEEN,
        dimension="force",
    ),
    Pair(
        quantity=mark("radial force on every support"),
        first="forces",
        second="life",
        read=(_supports_carried, _supports_lasting),
        tolerance=FOLLOWS,
        why=EXACT,
        dimension="force",
    ),
    Pair(
        quantity=mark("heat of every joint"),
        first="forces",
        second="losses",
        read=(_heat_of_forces, _heat_of_losses),
        tolerance=SAMPLED,
        why=BETWEEN,
        dimension="power",
        least=1e-3,
    ),
    Pair(
        quantity=mark("power at both ends"),
        first="forces",
        second="losses",
        read=(_power_of_forces, _power_of_losses),
        tolerance=SAMPLED,
        why=BETWEEN,
        dimension="power",
    ),
    Pair(
        quantity=mark("forces of the supports together"),
        first="forces",
        second="weights",
        read=(_held_up, _weighing),
        tolerance=FOLLOWS,
        why=EXACT,
        least=1.0,
    ),
    Pair(
        quantity=mark("life of the bearings of every joint"),
        first="life",
        second="bearing_life",
        read=(_life_told, _life_judged),
        tolerance=FOLLOWS,
        why=EXACT,
        dimension="duration",
    ),
    Pair(
        quantity=mark("life of the bearings of every support"),
        first="life",
        second="support_life",
        read=(_supports_told, _supports_judged),
        tolerance=FOLLOWS,
        why=EXACT,
        dimension="duration",
    ),
    Pair(
        quantity=mark("whether every shaft keeps below its endurance"),
        first="tube_fatigue",
        second="shaft_life",
        read=(_fatigued, _endless),
        tolerance=0.5,
        why=COUNTED,
    ),
    Pair(
        quantity=mark("largest torque of every shaft in torsional vibration"),
        first="torsion",
        second="strength",
        read=(_torque_of_response, _torque_counted),
        tolerance=FOUND,
        why=SEARCHED,
        dimension="torque",
        sense="at_most",
        quick=False,
    ),
    Pair(
        quantity=mark("largest torque of every shaft in torsional vibration"),
        first="torsion",
        second="torsion simulate",
        read=(_torque_steady, _torque_in_time),
        tolerance=FOUND,
        why=SEARCHED,
        dimension="torque",
        least=1.0,
        quick=False,
    ),
    Pair(
        quantity=mark("largest torque of every shaft while it runs up"),
        first="run-up",
        second="start_fatigue",
        read=(_torque_in_run_up, _torque_in_starts),
        tolerance=DRAWN,
        why=mark("both follow it in time, in steps of their own"),
        dimension="torque",
        least=1.0,
        quick=False,
    ),
    Pair(
        quantity=mark("largest torque of every shaft in starts and events"),
        first="start_fatigue",
        second="strength",
        read=(_torque_in_events, _torque_borne),
        tolerance=FOLLOWS,
        why=EXACT,
        dimension="torque",
        sense="at_most",
        quick=False,
    ),
    Pair(
        quantity=mark("mean torque that drives the input"),
        first="forces",
        second="torsion",
        read=(_driving_torque, _steady_torque),
        tolerance=SAMPLED,
        why=DAMPED,
        dimension="torque",
        sense="at_most",
        quick=False,
    ),
    Pair(
        quantity=mark("whether torsional vibration grows at the speed of the duty"),
        first="torsion",
        second="parametric_stability",
        read=(_grows, _damped),
        tolerance=0.5,
        why=COUNTED,
        sense="at_most",
        quick=False,
    ),
    Pair(
        quantity=mark("dip of a torque that reverses along the movement"),
        first="road",
        second="torque_reversal",
        read=(_dip_along, _dip_judged),
        tolerance=DRAWN,
        why=mark("stiffness and masses of one are as drawn, and resonance amplifies that"),
        dimension="torque",
        sense="at_most",
        quick=False,
    ),
    Pair(
        quantity=mark("critical speed of every shaft"),
        first="bending",
        second="critical_speed",
        read=(_whirl_told, _whirl_judged),
        tolerance=1e-6,
        why=EXACT,
        dimension="angular_speed",
        quick=False,
    ),
    Pair(
        quantity=mark("margin of the highest speed below the critical speed"),
        first="bending",
        second="critical_speed",
        read=(_margin_told, _margin_judged),
        tolerance=1e-6,
        why=EXACT,
        quick=False,
    ),
    Pair(
        quantity=mark("critical speed of the shaft that whirls first"),
        first="rotor",
        second="bending",
        read=(_one_mass, _whirl_told),
        tolerance=1e-6,
        why=EXACT,
        dimension="angular_speed",
        quick=False,
    ),
    Pair(
        quantity=mark("unbalance of every shaft over what its grade allows"),
        first="balance",
        second="balance",
        read=(_unbalanced, _unbalance_judged),
        tolerance=FOLLOWS,
        why=EXACT,
        least=1.0,
    ),
    Pair(
        quantity=mark("mass of every shaft"),
        first="balance",
        second="forces",
        read=(_balanced_mass, _mass_carried),
        tolerance=FOLLOWS,
        why=EXACT,
        dimension="mass",
    ),
    Pair(
        quantity=mark("whether a shaft is held by nothing"),
        first="mobility",
        second="forces",
        read=(_adrift, _loose),
        tolerance=0.5,
        why=COUNTED,
    ),
    Pair(
        quantity=mark("whether what is held can whirl"),
        first="mobility",
        second="bending",
        read=(_standing_fast, _bows),
        tolerance=0.5,
        why=COUNTED,
        sense="at_most",
        quick=False,
    ),
    Pair(
        quantity=mark("whether supports hold more than they need"),
        first="mobility",
        second="forces",
        read=(_redundant, _surplus),
        tolerance=0.5,
        why=COUNTED,
    ),
    Pair(
        quantity=mark("redundant constraints"),
        first="mobility",
        second="assembly",
        read=(_twice, _degree),
        tolerance=0.5,
        why=COUNTED,
        least=1.0,
        quick=False,
    ),
)
"""All pairs, in the order of the questions."""
