"""What there is to say of forces: what shafts, joints and supports carry, as drawn and while the drive moves."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from cardan.answers.answer import FILE, Answer, KeyFigure, Listing, Remark, Table, Tone, closely
from cardan.answers.quantity import Joined, Quantity, Say, Text, Written, listed, say
from cardan.answers.question import Lacking, absent
from cardan.answers.sweepable import OutputColumn, SweepQuestion
from cardan.drive.drive import Drive
from cardan.drive.fields.keys import spelled
from cardan.drive.fields.wording import written
from cardan.drive.models.kinematics_model import Chain
from cardan.drive.models.machine_held import machine_held, machines_of, proposed, tables_of
from cardan.drive.models.wobble import wobbling
from cardan.errors import InputError, Problem
from cardan.later import later
from cardan.maths.arrays import Array
from cardan.maths.curves.cycle_statistics import harmonics
from cardan.maths.ties import foremost, largest
from cardan.questions.assumed import centred_by_housings, held_by_machines, yokes_estimated
from cardan.questions.motion.articulation_answer import random_facts, random_tables
from cardan.questions.motion.kinds import steep_joints, without_vibration
from cardan.questions.motion.motion import motion
from cardan.questions.motion.random_motion import RandomMotion, Results, random_motion
from cardan.questions.seals import seal_torques
from cardan.texts import _, mark, plural

from .force_tables import (
    ROUNDING,
    constant,
    inner_table,
    joint_table,
    largest_left,
    rubs,
    senses,
    shaft_table,
    size,
    span,
    support_names,
    support_table,
    tidy,
    together,
    trace,
    turn,
)
from .forces import Forces, forces
from .gap_closure import Gaps, gaps
from .inner_loads import InnerLoad, Thrust, inner_loads, thrusts
from .moving_forces import Extreme, MovingForces, moving_forces
from .reactions import Determinacy, reaction_groups
from .turn_loads import turn_loads

drawn = later("cardan.questions.forces.figures")

__all__ = ["COLUMNS", "Carried", "answer", "ask", "followed", "lacking", "over_movement"]

MANY = 40
"""Places in half a turn at which the loads of random movements are looked at."""

WORSE = 1.0 + 1e-9
"""What moves is worse than what stands from here on; less is rounding."""

ORDERS = 7
"""Orders 0 to 6 of the input speed are told to programs."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Carried:
    """What a drive carries."""

    forces: Forces  # as drawn
    moving: MovingForces | None = None  # while it moves, where the file says how
    unheld: tuple[Problem, ...] = ()  # why the supports tell nothing
    unmoved: tuple[Problem, ...] = ()  # why nothing is told of the movement
    inner: tuple[InnerLoad, ...] = ()  # what the parts inside of the joints carry, as drawn
    thrusts: tuple[Thrust, ...] = ()  # how friction in the joints pushes their shafts along, as drawn
    random: RandomMotion | None = None  # what random movements make of the loads, without masses and friction


def lacking(drive: Drive) -> Lacking:
    """Return what the drive file lacks for the forces on its supports."""
    return absent((drive.duty.torque is not None, "duty.torque"), (bool(drive.supports), "supports"))


def ask(drive: Drive) -> Carried:
    """Return what a drive carries as drawn and while it moves; without supports where these tell nothing.

    Raises InputError: what even the torques lack.
    """
    try:
        return followed(drive, forces(drive))
    except InputError as error:
        bare = replace(drive, supports=())
        try:
            found = forces(bare)
        except InputError:
            raise error from None
        return replace(followed(bare, found), unheld=error.problems)


def followed(drive: Drive, found: Forces) -> Carried:
    """Return what a drive carries as drawn with what it carries while it moves, where the file says how fast."""
    inside: dict[str, Any] = {"inner": inner_loads(drive, found), "thrusts": thrusts(drive, found)}
    if not drive.movements:
        return Carried(forces=found, **inside)
    try:
        chance = random_motion(drive, None, _loads(drive), fewer=2)
        moving = moving_forces(drive) if drive.duty.speed else None
    except InputError as error:
        return Carried(forces=found, unmoved=error.problems, **inside)
    return Carried(forces=found, moving=moving, random=chance, **inside)


def _loads(drive: Drive) -> Results:
    """Return the largest loads over a turn wherever the points are, masses and friction not counted."""
    duty, n = drive.duty, len(drive.joints)

    def results(_points: Array, chain: Chain) -> dict[tuple[str, int], Array]:
        torque = duty.torque or 0.0
        found = turn_loads(
            chain, torque, torque_at=duty.torque_at, harmonics=duty.harmonics, scale=abs(torque), look=MANY
        )
        given = n if duty.torque_at == "output" else 0
        loads = {("couple", i + 1): found.couple[:, i] for i in range(n)}
        loads |= {("shaft_torque", k + 1): found.torque[:, k] for k in range(n + 1) if k != given}
        return loads | {("secondary_couple", k + 1): found.bending[:, k] for k in range(n + 1)}

    return results


def over_movement(drive: Drive) -> Callable[[Array], Array] | None:
    """Return that no instant is left to be asked for where the forces are followed through the movement itself.

    Without a speed it stands still at the instants asked for.
    """
    if not drive.duty.speed:
        return None
    return lambda times: np.zeros((0, times.size))


def answer(drive: Drive, result: Carried, curves: Forces | None = None) -> Answer:
    """Return what there is to say of what a drive carries. curves: at the positions whose curves are asked for."""
    found = result.forces
    shown = found if curves is None else curves
    machines, own, drive = machines_of(drive), drive, machine_held(drive) if found.reaction is not None else drive
    return Answer(
        name="forces",
        title=_("Forces"),
        sentence=_sentence(drive, found),
        figures=lambda: _figures(drive, result),
        tables=(*_tables(drive, result), *_back(shown), *_random(result)),
        remarks=tuple(_remarks(drive, result, machines)),
        listings=() if found.reaction is not None else tuple(_listings(own)),
        keys=tuple(_keys(drive, result)),
        facts={
            **_facts(drive, found),
            **random_facts(result.random),
            "generated_axial_force": [
                {
                    "joint": one.joint,
                    "force_max": Quantity(one.most, "force"),
                    "order": one.order,
                    "amplitude": Quantity(one.amplitude, "force"),
                }
                for one in result.thrusts
            ],
            "held_by_machines": list(machines) if found.reaction is not None else [],
        },
        full=lambda: trace(shown),
    )


def _random(result: Carried) -> Iterator[Table]:
    """Yield what random movements make of the loads."""
    if result.random is not None:
        for one in random_tables(result.random):
            yield (
                one
                if one.name
                else replace(one, note=Joined([one.note, _("Largest values over a turn.")], between=" "))
            )


def _figures(drive: Drive, result: Carried) -> tuple[Any, ...]:
    own = drawn().forces_figures(result.forces, drive if result.forces.reaction is not None else None)
    return own if result.moving is None else (*own, *drawn().moving_forces_figures(result.moving, support_names(drive)))


def needed(drive: Drive, low: float, high: float) -> Say:
    """Return what the torque of the duty at one end is at the other."""
    given = Quantity(drive.duty.torque or 0.0, "torque")
    if constant(low, high):
        text = _("{given} at the output need {high} at the input")
        if drive.duty.torque_at == "input":
            text = _("{given} at the input meet {high} at the output")
    else:
        text = _("{given} at the output need {low:bare} to {high} at the input")
        if drive.duty.torque_at == "input":
            text = _("{given} at the input meet {low:bare} to {high} at the output")
    return say(text, given=given, **span(low, high, "torque"))


def _sentence(drive: Drive, found: Forces) -> Say:
    other = turn(found.angle, found.output_torque if drive.duty.torque_at == "input" else found.input_torque)
    torque = needed(drive, float(other.low), float(other.high))
    if found.reaction is None:
        bent = turn(found.angle, found.bending_couple).high
        places = largest(bent)
        if not bent[places[0]] > 0.0:
            return say(_("{torque}; the joints are straight, so there is no secondary couple."), torque=torque)
        text = _("{torque}; the secondary couple is largest on shaft {which}, {most}.")
        if len(places) > 1:
            text = _("{torque}; the secondary couple is largest on shafts {which}, {most} each.")
        which = together([one.name for one in drive.shafts], places)
        return say(text, torque=torque, which=which, most=Quantity(float(bent[places[0]]), "torque"))
    total = _support_peaks(found)
    places = largest(total)
    if not total[places[0]] > 0.0:
        return say(_("{torque}; the supports carry nothing."), torque=torque)
    text = _("{torque}; support {which} carries most, up to {most}.")
    if len(places) > 1:
        text = _("{torque}; supports {which} carry most, up to {most} each.")
    which = together(support_names(drive), places)
    return say(text, torque=torque, which=which, most=Quantity(float(total[places[0]]), "force"))


def _support_peaks(found: Forces) -> Any:
    """Return the largest force on each support, array (k,) [N]."""
    return np.max([turn(one.angle, size(one.reaction)).high for one in senses(found)], axis=0)


def _tables(drive: Drive, result: Carried) -> Iterator[Table]:
    found = result.forces
    yield shaft_table(drive, found)
    yield joint_table(drive, found)
    if result.inner:
        yield inner_table(drive, result.inner)
    if found.reaction is not None:
        yield support_table(drive, found)


def _back(shown: Forces) -> Iterator[Table]:
    """Yield the curves of the splines sliding back, for programs."""
    if shown.reverse is not None:
        yield trace(shown.reverse, "forces_sliding_back")


def _listings(drive: Drive) -> Iterator[Listing]:
    """Yield the supports that are missing, as tables for the file."""
    tables = tables_of(proposed(drive))
    if tables:
        title = _("Supports that would hold the drive; put them where they are")
        yield Listing(title=title, text=tables, depth="brief")


def _remarks(drive: Drive, result: Carried, machines: tuple[int, ...]) -> Iterator[Remark]:
    found = result.forces
    for k, problem in enumerate(result.unheld):
        text = _("Warning: forces on the supports are not calculated: {field}: {message}")
        yield Remark(text=say(text, **_parts(problem)), tone="warning", alarm=k == 0)
    yield from _apart(drive, found)
    yield from steep_joints(drive)
    yield from without_vibration(drive)
    yield from yokes_estimated(drive)
    yield from centred_by_housings(drive)
    yield from held_by_machines(machines if found.reaction is not None else ())
    surplus = int(found.status == Determinacy.INDETERMINATE) and found.unknowns - found.equations
    if surplus:
        text = _(
            "Warning: statically indeterminate, degree {n}: the supports share the forces by their stiffness, "
            "misalignment included."
        )
        yield Remark(text=say(text, n=surplus), tone="warning")
    groups = reaction_groups(drive) if found.reaction is not None else ()
    if len(groups) > 1:
        order = _(", then ").join(_(" and ").join(map(str, group)) for group in groups)
        yield Remark(text=say(_("By hand the reactions follow from shaft {order}."), order=order), aside=True)
    yield from _closing(drive, found)
    yield from _thrust(found)
    yield from _pushed(result.thrusts)
    yield from _without(drive, found)
    if result.random is not None:
        text = _(
            "Masses and friction do not count in the table under random movements, since they depend on how fast the "
            "axes move, not only on where they stand; the forces over one sample path count them."
        )
        yield Remark(text=text, code="random_without_masses")
    yield from _moving(drive, result)
    yield balanced(found)
    yield from _next(drive, found, surplus)


def _parts(problem: Problem) -> dict[str, str]:
    return {"field": spelled(problem.field), "message": problem.message}


def _closing(drive: Drive, found: Forces) -> Iterator[Remark]:
    """Yield whether the load keeps the gaps of the joints closed, where inertia counts."""
    one = gaps(drive, found)
    if one is None or not one.load_needed > ROUNDING * abs(drive.duty.torque or 0.0):
        return
    where = _("at the input") if drive.duty.torque_at == "input" else _("at the output")
    most = Quantity(one.load_needed, "torque")
    opened = [k for k, share in enumerate(one.open_share) if share > 0.0]
    if not opened:
        text = _("The load keeps the gaps of all joints closed; {most} {where} is the least that does.")
        yield Remark(text=say(text, most=most, where=where), depth="full")
        return
    text = plural(
        "Warning: the gaps of joint {which} open: inertia reverses its torque over {share} of the turn; only {most} "
        "{where} would keep all of them closed.",
        "Warning: the gaps of joints {which} open: inertia reverses their torque over up to {share} of the turn; only "
        "{most} {where} would keep all of them closed.",
        len(opened),
    )
    which = together([joint.name for joint in drive.joints], opened)
    share = Quantity(float(max(one.open_share)), "share", 3)
    yield Remark(text=say(text, which=which, share=share, most=most, where=where), tone="warning")


def _thrust(found: Forces) -> Iterator[Remark]:
    """Yield what friction in the splines does."""
    most = float(np.max(np.abs(found.spline_thrust), initial=0.0))
    if most > 0.0:
        text = _("Friction in the spline thrusts with up to {most}.")
        if found.reverse is not None:
            text = _("Friction in the spline thrusts with up to {most}; loads are the largest of sliding in and out.")
        yield Remark(text=say(text, most=Quantity(most, "force")))


def _pushed(pushed: Sequence[Thrust]) -> Iterator[Remark]:
    """Yield how friction inside of joints pushes their shafts along."""
    for one in pushed:
        if one.amplitude > 0.0:
            text = _(
                "Friction in joint {joint} pushes its shafts along each other with up to {most}; of order {order} of "
                "the turn it is ±{amplitude}."
            )
            values = {"most": Quantity(one.most, "force"), "amplitude": Quantity(one.amplitude, "force")}
            yield Remark(text=say(text, joint=one.joint, order=one.order, **values), code="generated_axial_force")


NOTED = 1e-3
"""Share of a speed ratio or of a torque from which what is left out is a warning."""


def _apart(drive: Drive, found: Forces) -> Iterator[Remark]:
    """Yield by how much speeds and forces do not belong together where shafts wobble."""
    felt = wobbling(drive)
    if not felt or not np.all(found.speed[0]):
        return
    which = listed([i + 2 for i in felt])
    ratio = found.speed[-1] / found.speed[0]
    off = float(np.max(np.abs(ratio - motion(drive, found.angle).ratio)))
    if off > ROUNDING:
        text = plural(
            "That shaft {which} wobbles is not in these torques and forces: with it the speed ratio of the "
            "drive differs by up to {off}, see motion.",
            "That shafts {which} wobble is not in these torques and forces: with it the speed ratio of the "
            "drive differs by up to {off}, see motion.",
            len(felt),
        )
        said = say(text, which=which, off=Quantity(off, digits=2))
        yield Remark(text=said, tone="warning" if off > NOTED else "plain", code="wobble")
    left = float(np.max(found.power_left))
    if left > ROUNDING:
        text = _(
            "Warning: up to {share} of the power that goes in neither comes out nor is lost: as the shafts are told to "
            "wobble, a joint or bearing that is held here would have to give way; torques and forces are off by about "
            "that."
        )
        yield Remark(text=say(text, share=Quantity(left, "share", 2)), tone="warning", code="power")


def balanced(found: Forces) -> Remark:
    """Return how closely all balances hold."""
    left = largest_left(found.power_left, found.force_left, found.moment_left)
    text = _("Power balance checked: input less output, losses and inertia closes {closely}.")
    if found.force_left is not None:
        text = _("Balances checked: power, and the external forces and moments on the whole drive, close {closely}.")
    good = left <= ROUNDING
    return Remark(text=say(text, closely=closely(left)), tone="plain" if good else "failed", aside=good)


def _without(drive: Drive, found: Forces) -> Iterator[Remark]:
    """Yield what was left out because the file does not say."""
    if any(joint.error is not None for joint in drive.joints):
        if int(found.status) == Determinacy.INDETERMINATE:
            yield Remark(
                text=_("Errors of length of the joints as made load the supports here, those of angles do not.")
            )
        else:
            text = _(
                "Errors of the joints as made load nothing here: the supports give way to them, or there are none."
            )
            yield Remark(text=text, code="without_error")
    names = [joint.name for joint in drive.joints]
    crossed = [i for i, joint in enumerate(drive.joints, 1) if "cross" not in joint.foreign]
    bare = [i for i in crossed if not np.all(np.isfinite(found.journals.size[i - 1]))]
    if bare:
        text = plural(
            "Joint {numbers} gives no {key}: the loads of its journals are not known.",
            "Joints {numbers} give no {key}: the loads of their journals are not known.",
            len(bare),
        )
        key = Written("cross.span_mm", _("span of the cross"))
        yield Remark(text=say(text, key=key, numbers=together(names, [i - 1 for i in bare])))
    elif found.joint_force is None:
        yield Remark(
            text=_("Journals carry the couples alone here; supports would tell the forces between the shafts.")
        )
    short = {i: joint.without(joint.rubbing) for i, joint in enumerate(drive.joints, 1) if joint.friction}
    lacking = [f"joints[{i - 1}].{one}" for i, keys in short.items() for one in keys]
    if lacking:
        text = _("Warning: friction within joints does not count where the file does not give {keys}.")
        yield Remark(text=say(text, keys=written(*lacking)), tone="warning")
    loose = [
        i
        for i, joint in enumerate(drive.joints, 1)
        if not joint.rubbing and not rubs(joint) and (joint.friction or joint.material_friction)
    ]
    if loose:
        text = plural(
            "Warning: friction of joint {numbers} does not count: {span} or {journal} is not given.",
            "Warning: friction of joints {numbers} does not count: {span} or {journal} is not given.",
            len(loose),
        )
        keys = {
            "span": Written("cross.span_mm", _("span of the cross")),
            "journal": Written("cross.journal_mm", _("diameter of its journals")),
        }
        yield Remark(text=say(text, **keys, numbers=together(names, [i - 1 for i in loose])), tone="warning")
    if sealed := float(np.sum(seal_torques(drive))):
        text = _("Friction of the seals, {torque} in all, is not in these torques and forces; it is in the power loss:")
        noted = sealed > NOTED * float(np.max(np.abs(found.input_torque)))
        tone: Tone = "warning" if noted else "plain"
        command = ("cardan", "losses", FILE)
        yield Remark(text=say(text, torque=Quantity(sealed, "torque")), command=command, tone=tone, code="seals")
    if any(one.friction and one.bore for one in drive.supports):
        text = _("Friction of the supports is not in these torques and forces; it is in the power loss:")
        yield Remark(text=text, command=("cardan", "losses", FILE), depth="full", aside=True, code="supports")
    light = [int(path.partition("[")[2].partition("]")[0]) + 1 for path in found.assumed if path.endswith(".inertia")]
    if "duty.speed" in found.assumed:
        yield Remark(text=_("Without a speed inertia does not count; --speed-rpm counts it."))
    elif light:
        text = plural(
            "Shaft {numbers} counts as without inertia: neither {inertia} nor {outer} is given.",
            "Shafts {numbers} count as without inertia: neither {inertia} nor {outer} is given.",
            len(light),
        )
        shafts = [shaft.name for shaft in drive.shafts]
        keys = {"inertia": Written("inertia_kg_m2", _("inertia")), "outer": Written("outer_mm", _("outer diameter"))}
        yield Remark(text=say(text, **keys, numbers=together(shafts, [k - 1 for k in light])))
    others = [path for path in found.assumed if path != "duty.speed" and not path.endswith(".inertia")]
    if others:
        text = _("Not given, so assumed: {paths}.")
        yield Remark(text=say(text, paths=written(*others)), depth="full")


def _moving(drive: Drive, result: Carried) -> Iterator[Remark]:
    """Yield what the supports carry while the drive moves, or why that is not told."""
    for problem in result.unmoved[:1]:
        text = _("Warning: forces while the drive moves are not calculated: {field}: {message}")
        yield Remark(text=say(text, **_parts(problem)), tone="warning")
    if result.moving is not None and result.forces.reaction is not None:
        text = _("While it moves, support {which} carries most, up to {most} at {time}.")
        yield Remark(text=say(text, **worst_moving(drive, result.moving)))
    worse: list[Text] = [
        say("{title} {value} ({place})", title=one.title, value=one.value, place=one.place)
        for one in _keys(drive, result)
        if one.place and one.name != "support_force"
    ]
    if worse:
        yield Remark(text=say(_("The worst over the movement: {figures}."), figures=Joined(worse, between="; ")))


def worst_moving(drive: Drive, found: MovingForces) -> dict[str, Any]:
    """Return which support carries most while the drive moves, how much, and when."""
    peak = found.extreme(found.reaction_size)
    k = int(foremost(peak.high))
    return {
        "which": together(support_names(drive), [k]),
        "most": Quantity(float(peak.high[k]), "force"),
        "time": Quantity(float(peak.high_time[k]), "time", 3),
    }


def _next(drive: Drive, found: Forces, surplus: int) -> Iterator[Remark]:
    """Yield the next step."""
    if surplus:
        text = _("What misalignment does alone, and what to release:")
        yield Remark(text=text, command=("cardan", "assembly", FILE), tone="next")
    elif found.reaction is None:
        yield Remark(text=_("Add [[supports]] to the file for the loads of bearings and journals."), tone="next")
    elif found.loss.any() and drive.duty.speed:
        yield Remark(text=_("Where power is lost:"), command=("cardan", "losses", FILE), tone="next")


def _keys(drive: Drive, result: Carried) -> Iterator[KeyFigure]:
    """Yield the largest couple, journal load and reaction, as drawn or over the movement, and when."""
    found, moving = result.forces, result.moving
    couple = np.max(np.asarray(found.bending_couple), axis=-1)
    couples = None if moving is None else moving.extreme(tidy(moving.forces.bending_couple))
    places, most, when = _larger(couple, couples)
    if most > ROUNDING * float(np.max(np.abs(np.asarray(found.shaft_torque)), initial=0.0)):
        title = say(_("largest secondary couple, shaft {k}"), k=places[0] + 1)
        yield KeyFigure(name="secondary_couple", title=title, place=when, value=Quantity(most, "torque"))
    journal = np.max([np.max(np.asarray(one.journals.size), axis=(-1, -2)) for one in senses(found)], axis=0)
    journals = None if moving is None else moving.extreme(np.max(moving.forces.journals.size, axis=-1))
    if np.any(np.isfinite(journal)):
        places, most, when = _larger(journal, journals)
        title = say(_("largest load of a journal, joint {k}"), k=places[0] + 1)
        yield KeyFigure(name="journal_load", title=title, place=when, value=Quantity(most, "force"))
    if found.reaction is None:
        return
    total = np.max([np.max(size(one.reaction), axis=-1) for one in senses(found)], axis=0)
    places, most, when = _larger(total, None if moving is None else moving.extreme(moving.reaction_size))
    title = say(_("largest force on a support, {name}"), name=together(support_names(drive), places))
    yield KeyFigure(name="support_force", title=title, place=when, value=Quantity(most, "force"))


def _larger(drawn: Array, moving: Extreme | None) -> tuple[tuple[int, ...], float, Text]:
    """Return which of several is largest, as drawn (k,) or while it moves, how large, and when where that moves."""
    places = largest(drawn)
    if moving is not None:
        k = int(foremost(moving.high))
        if moving.high[k] > drawn[places[0]] * WORSE:
            at = say(_("at {time} of the movement"), time=Quantity(float(moving.high_time[k]), "time", 3, trim=True))
            return (k,), float(moving.high[k]), at
    return places, float(drawn[places[0]]), ""


def _facts(drive: Drive, found: Forces) -> dict[str, Any]:
    orders = harmonics(found.angle, found.shaft_torque, count=ORDERS).amplitude
    return {
        **duty_facts(drive),
        "status": Determinacy(int(found.status)).name.lower(),
        "equations": found.equations,
        "unknowns": found.unknowns,
        "solving_order": [list(group) for group in reaction_groups(drive)],
        "torque_orders": Quantity([tidy(row).tolist() for row in orders], "torque"),
        **({} if found.reaction is not None else {"supports": []}),
        **balance_facts(found),
        "gap_closure": _gap_facts(gaps(drive, found)),
        "assumed": found.assumed,
    }


def _gap_facts(found: Gaps | None) -> dict[str, Any] | None:
    if found is None:
        return None
    return {
        "closed": not np.any(found.open_share > 0.0),
        "load_needed": Quantity(found.load_needed, "torque"),
        "open_share": [Quantity(float(one), "share") for one in found.open_share],
    }


def duty_facts(drive: Drive) -> dict[str, Any]:
    """Return speed and torque that the forces are told for."""
    speed = drive.duty.speed
    return {
        "speed": None if speed is None else Quantity(speed, "angular_speed"),
        "torque": Quantity(drive.duty.torque or 0.0, "torque"),
        "torque_at": drive.duty.torque_at,
    }


def balance_facts(found: Forces) -> dict[str, Any]:
    """Return what the balances leave."""
    rows = {"power_left": found.power_left, "force_left": found.force_left, "moment_left": found.moment_left}
    return {name: None if row is None else float(np.max(np.asarray(row))) for name, row in rows.items()}


def _column_values(drive: Drive) -> tuple[float, float, float]:
    every = [forces(drive)]
    if drive.movements and drive.duty.speed:
        every.append(moving_forces(drive).forces)
    held = [math.nan if one.reaction is None or not one.support_shaft else float(np.max(one.radial)) for one in every]
    couple, torque = (
        max(float(np.max(np.abs(getattr(one, name)))) for one in every) for name in ("bending_couple", "input_torque")
    )
    return couple, max(held), torque


COLUMNS = (
    SweepQuestion(
        name="forces",
        doc=mark("largest secondary couple, support force and input torque over a turn"),
        told=(
            OutputColumn.of("couple_Nm", mark("largest secondary couple of a shaft")),
            OutputColumn.of("support_N", mark("largest radial force on a support")),
            OutputColumn.of("input_torque_Nm", mark("largest torque at the input")),
        ),
        of_one=_column_values,
        counts=("movement",),
    ),
)
"""What a sweep may ask of forces."""
