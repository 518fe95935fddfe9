"""From a drive to its torsional model: stations and elements of every shaft, the joints between them, the torques.

What the drive does not say counts as absent, shafts without stiffness or body as rigid; `TorsionalTrain.assumed` lists
it.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from cardan.answers.quantity import Quantity, Text, say, told
from cardan.answers.reader import USUAL
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.joints import Joint
from cardan.drive.models.geometry import geometry
from cardan.drive.models.kinematics_model import given_chain
from cardan.drive.station import Pendulum, ToNext
from cardan.drive.yokes import with_yokes
from cardan.errors import Problem, check, refuse
from cardan.formulas.damping import LOSS
from cardan.maths.arrays import Array, ArrayLike
from cardan.texts import _

from .excitation import machine_torques, turns_freely
from .inputs import Law
from .joint_bends import Bends, bends
from .shaft_line import ShaftLine, cut_name, shaft_line
from .torsional_balance import gathered
from .torsional_layouts import ARRAYS, SHARED, chosen, leading
from .torsional_model import Torque, TorsionalModel

HOLDING = 1e-5
"""Torque of what holds a damper without spring in place, over its drag at order 2: nothing else says where it is."""


@dataclass(frozen=True, eq=False, kw_only=True)
class TorsionalTrain:
    """The torsional model of a drive, and where its stations are."""

    model: TorsionalModel
    position: Array  # (N,) [m]: of every station along the line of the shafts, from the input end
    joints: tuple[tuple[int, int], ...]  # stations of the driving and of the driven yoke of every joint
    hangs: tuple[int | None, ...]  # station that an absorber or pendulum hangs on; None for one of the line itself
    pendulums: tuple[int, ...]  # elements that hold pendulums: their stiffness goes with the square of the speed
    hung: tuple[Pendulum, ...]  # what hangs at each of these elements
    springs: tuple[tuple[int, ToNext], ...]  # elements that have a table of torques over twists, or dry friction
    assumed: tuple[str, ...]  # paths of what the drive does not say and the model assumes
    # tuple of N (float) [m]: where on their shafts the stations are that only part its body; None for all others
    cuts: tuple[float | None, ...]
    # whether the positions follow from lengths that the drive gives; else some shafts are as long as others
    to_scale: bool = True
    # loss factor that every shaft counts with, as the drive says no damping anywhere; 0 where it says some
    usual_loss: float = 0.0

    @property
    def station_names(self) -> tuple[Text, ...]:
        """What the stations are called, with places in the units of whoever reads it."""
        return tuple(
            name if cut is None else cut_name(shaft + 1, cut)
            for name, cut, shaft in zip(self.model.names, self.cuts, self.model.shaft, strict=True)
        )

    @property
    def element_names(self) -> tuple[str, ...]:
        """What the elements are called, in the usual units; see `elements`."""
        return tuple(told(one, USUAL) for one in self.elements)

    @property
    def elements(self) -> tuple[Text, ...]:
        """What the elements are called: by their shaft where it has but one, else with the stations at their ends."""
        model, names = self.model, self._end_names
        line = [b for _a, b in model.elements if self.hangs[b] is None]
        alone = {k for k in model.shaft if sum(model.shaft[b] == k for b in line) == 1}
        found: list[Text] = []
        for a, b in model.elements:
            number = model.shaft[a] + 1
            if self.hangs[b] is not None:
                found.append(model.names[b])
            elif model.shaft[a] in alone:
                found.append(_("shaft {number}").format(number=number))
            else:
                found.append(say(_("shaft {number}, {one} to {two}"), number=number, one=names[a], two=names[b]))
        return tuple(found)

    @property
    def _end_names(self) -> tuple[Text, ...]:
        """Names of the stations short enough for the ends of an element: what its shaft is, is said before them."""
        names: list[Text] = list(self.model.names)
        for number, ends in enumerate(self.joints, start=1):
            for end in ends:
                names[end] = _("joint {number}").format(number=number)
        return tuple(
            name if cut is None else Quantity(cut, "length", trim=True)
            for name, cut in zip(names, self.cuts, strict=True)
        )

    @property
    def line(self) -> tuple[int, ...]:
        """Stations of the line itself, along the power flow."""
        return tuple(k for k, host in enumerate(self.hangs) if host is None)


def torsional_train(
    drive: Drive, duty: Duty | None = None, *, speed: ArrayLike | None = None, pieces: int = 1, loaded: bool = True
) -> TorsionalTrain:
    """Return the torsional model of a drive with the places of its stations.

    Parameters
    ----------
    drive : Drive
        With bodies or inertias and stiffnesses of its shafts, or `[[stations]]`.
    duty : Duty, optional
        What it does; that of the drive by default.
    speed : float or array (s,), optional [rad/s]
        Of the input, in place of that of the duty; at many, what changes with it has that axis.
    pieces : int
        Into how many equal stretches the body between two stations is divided.
    loaded : bool
        Whether torques act. The bare line needs no speed, but for pendulums.

    Returns
    -------
    TorsionalTrain

    Raises
    ------
    InputError
        What the model misses, each with the key to add: elements without stiffness, no inertia anywhere, no speed.

    Notes
    -----
    A body is a tube with G I_p/L between its stations and half its inertia at each end of every stretch. Joint angles
    and phase angles are those of `motion`, so that a rigid drive turns exactly as there. A pendulum counts as the
    absorber it equals at the speed: J = m (R+l)², stiffness J Ω² R/l. A damper without spring is held in place by one
    too soft to matter, 10⁻⁵ of its drag at order 2. A drive that says no damping anywhere has the loss factor of steel
    shafts, `cardan.formulas.damping.LOSS`; ``damping = 0`` of a shaft says that there is none.

    Examples
    --------
    >>> from cardan.parts import Shaft, Station
    >>> drive = Drive.from_angles([0.2, 0.2])
    >>> tube = Shaft(number=2, length=1.0, outer=0.07, inner=0.066)
    >>> found = torsional_train(
    ...     replace(drive, shafts=(tube,), stations=(Station(shaft=1, inertia=0.5), Station(shaft=3, inertia=2.0))),
    ...     loaded=False,
    ... )
    >>> found.model.names
    ('shaft 1', 'joint 1, driven yoke', 'joint 2, driving yoke', 'shaft 3')
    >>> found.model.stiffness.round(), found.position
    (array([39167.]), array([1., 1., 2., 2.]))
    """
    drive = with_yokes(drive, at_joint=True)
    asked = drive.duty if duty is None else duty
    turning = asked.speed if speed is None else speed
    if pieces < 1:
        raise refuse("pieces", _("{given} given; at least 1").format(given=pieces))
    problems: list[Problem] = []
    turns = bends(drive, given_chain(drive), geometry(drive))
    lines = [shaft_line(drive, shaft, pieces, problems) for shaft in drive.shafts]
    lines = [lines[0], *(_softened(line, joint) for line, joint in zip(lines[1:], drive.joints, strict=True))]
    base = _joined(drive, lines, turns)
    base = _usually_damped(drive, base)
    base = _with_branches(drive, base, lines, turning, problems)
    problems += _empty_problems(base.model)
    check(problems)
    free = turns_freely(drive, asked)
    if not free and turning is None and loaded:
        raise refuse("duty.speed", _("missing; torsional vibration needs it"), "missing")
    model = replace(base.model, input_speed=None if free else np.asarray(0.0 if turning is None else turning))
    if loaded:
        named = {drive.stations[k].name: at for line, start in _starts(lines) for k, at in line.stations(start)}
        last = base.line[-1]
        ends = [start + len(line.inertia) - 1 for line, start in _starts(lines)]
        model = replace(model, torques=machine_torques(drive, asked, named, last, ends, speed=turning, free=free))
    return replace(base, model=model)


def _usually_damped(drive: Drive, bare: TorsionalTrain) -> TorsionalTrain:
    """Return the model with the loss factor of steel shafts where the drive says no damping anywhere, not even none."""
    given = [one for part in drive.shafts for one in (part.damping, part.loss_factor)]
    behind = [part.to_next for part in drive.stations if part.to_next is not None]
    given += [one for part in behind for one in (part.damping, part.loss_factor)]
    model = bare.model
    if any(one is not None for one in given) or np.any(model.damping) or np.any(model.ground_damping):
        return bare
    loss = np.where(np.asarray(model.stiffness) > 0.0, LOSS["shaft"], 0.0)
    assumed = tuple(re.sub(r"\.damping$", ".loss_factor", path) for path in bare.assumed)
    return replace(bare, model=replace(model, loss_factor=loss), assumed=assumed, usual_loss=LOSS["shaft"])


def _softened(line: ShaftLine, joint: Joint) -> ShaftLine:
    """Return the shaft behind an elastic joint, with a station before the joint's own spring."""
    if joint.twist_spring is None:
        return line
    stiffness, damping = joint.twist_spring
    return replace(
        line,
        inertia=[0.0, *line.inertia],
        ground_damping=[0.0, *line.ground_damping],
        stiffness=[stiffness, *line.stiffness],
        damping=[damping, *line.damping],
        backlash=[0.0, *line.backlash],
        loss_factor=[0.0, *line.loss_factor],
        springs=[None, *line.springs],
        share=[line.share[0], *line.share],
        names=[_("{name}, before the elastic joint").format(name=line.names[0]), *line.names],
        cuts=[None, *line.cuts],
        held=[(), *line.held],
    )


def torsional_model(
    drive: Drive, duty: Duty | None = None, *, speed: float | None = None, pieces: int = 1
) -> TorsionalModel:
    """Return the torsional model of a drive under its duty; see `torsional_train`."""
    return torsional_train(drive, duty, speed=speed, pieces=pieces).model


def _starts(lines: Sequence[ShaftLine]) -> Iterator[tuple[ShaftLine, int]]:
    """Yield every shaft with the number of its first station."""
    start = 0
    for line in lines:
        yield line, start
        start += len(line.inertia)


def _joined(drive: Drive, lines: Sequence[ShaftLine], turns: Bends) -> TorsionalTrain:
    """Return the shafts as one model, without what hangs on it."""
    starts = [start for _line, start in _starts(lines)]
    driven: list[tuple[int, int] | None] = []
    elements: list[tuple[int, int]] = []
    for i, (line, start) in enumerate(_starts(lines)):
        count = len(line.inertia)
        driven += [(start - 1, i - 1) if i else None, *[None] * (count - 1)]
        elements += [(start + k, start + k + 1) for k in range(count - 1)]
    play = [list(line.backlash) for line in lines]
    for i, joint in enumerate(drive.joints):
        if joint.backlash:  # beside the joint: at the end of its driving shaft, else at the start of its driven one
            side, at = (i, -1) if play[i] else (i + 1, 0)
            play[side][at] += joint.backlash
    model = TorsionalModel(
        inertia=_row([line.inertia for line in lines]),
        driven=tuple(driven),
        elements=tuple(elements),
        stiffness=_row([line.stiffness for line in lines]),
        damping=_row([line.damping for line in lines]),
        backlash=_row(play),
        ground_damping=_row([line.ground_damping for line in lines]),
        loss_factor=_row([line.loss_factor for line in lines]),
        shaft=tuple(i for i, line in enumerate(lines) for _k in line.inertia),
        names=tuple(name for line in lines for name in line.names),
        **turns,
    )
    place = geometry(drive)
    length = np.asarray(place.length, dtype=float)
    drawn = [i for i, line in enumerate(lines) if i == 0 or len(line.inertia) > 1]
    begin = np.append(0.0, np.cumsum(length))
    places = [begin[i] + share * length[i] for i, line in enumerate(lines) for share in line.share]
    return TorsionalTrain(
        model=model,
        position=np.asarray(places, dtype=float),
        joints=tuple((start - 1, start) for start in starts[1:]),
        hangs=(None,) * len(driven),
        pendulums=(),
        hung=(),
        springs=tuple(
            (e, one) for e, one in enumerate(one for line in lines for one in line.springs) if one is not None
        ),
        assumed=tuple(path for line in lines for path in line.assumed),
        cuts=tuple(cut for line in lines for cut in line.cuts),
        to_scale=not any(f"shafts[{i}].length" in place.assumed for i in drawn),
    )


def _row(parts: Sequence[Sequence[float]]) -> Array:
    return np.asarray([one for part in parts for one in part], dtype=float)


def _with_branches(
    drive: Drive, train: TorsionalTrain, lines: Sequence[ShaftLine], speed: ArrayLike | None, problems: list[Problem]
) -> TorsionalTrain:
    """Return the model with absorbers and pendulums, each a station behind those of the line."""
    model = train.model
    inertia, stiffness, damping = list(model.inertia), [*map(np.asarray, model.stiffness)], list(model.damping)
    elements, hangs, names = list(model.elements), list(train.hangs), list(model.names)
    pendulums: list[int] = []
    bodies: list[Pendulum] = []
    turning = np.asarray(0.0 if speed is None else speed, dtype=float)
    holding = 2.0 * HOLDING * np.where(turning == 0.0, 1.0, np.abs(turning))
    for k, host in ((k, at) for line, start in _starts(lines) for k, at in line.stations(start)):
        station = drive.stations[k]
        if station.absorber is not None:
            mass, damper = station.absorber.inertia, station.absorber.damping
            spring = np.asarray(station.absorber.stiffness or holding * damper)
            name = _("absorber on {name}")
        elif station.pendulum is not None:
            if speed is None:
                problems.append(
                    Problem("duty.speed", _("missing; the stiffness of a pendulum comes from it"), "missing")
                )
            hung = station.pendulum
            mass = hung.count * hung.mass * (hung.radius + hung.length) ** 2
            spring, damper = mass * turning**2 * hung.radius / hung.length, 0.0
            name = _("pendulum on {name}")
            pendulums.append(len(elements))
            bodies.append(hung)
        else:
            continue
        elements.append((host, len(inertia)))
        inertia.append(mass)
        stiffness.append(spring)
        damping.append(damper)
        hangs.append(host)
        names.append(name.format(name=names[host]))
    more = len(inertia) - len(model.inertia)
    whole = replace(
        model,
        inertia=np.asarray(inertia),
        driven=(*model.driven, *[None] * more),
        elements=tuple(elements),
        stiffness=np.stack(np.broadcast_arrays(*stiffness), axis=-1) if stiffness else np.zeros(0),
        damping=np.asarray(damping),
        backlash=np.append(model.backlash, [0.0] * more),
        loss_factor=np.append(model.loss_factor, [0.0] * more),
        ground_damping=np.append(model.ground_damping, [0.0] * more),
        shaft=(*model.shaft, *(model.shaft[host] for host in hangs[len(model.inertia) :] if host is not None)),
        names=tuple(names),
    )
    position = np.append(train.position, [train.position[host] for host in hangs if host is not None])
    cuts = (*train.cuts, *[None] * more)
    found = replace(train, model=whole, position=position, hangs=tuple(hangs), cuts=cuts)
    return replace(found, pendulums=tuple(pendulums), hung=tuple(bodies))


def _empty_problems(model: TorsionalModel) -> Iterator[Problem]:
    """Yield what keeps a model from moving: no inertia at all, and parts that neither mass nor spring holds."""
    if not np.any(model.inertia > 0.0):
        text = _("nothing here has inertia: give the body or inertia of shafts, or [[stations]] with inertia")
        yield Problem("stations", text)


def in_time(model: TorsionalModel, frequency: ArrayLike, disturbed: ArrayLike | None = None) -> TorsionalModel:
    """Return a model whose structural damping is viscous, equal at one frequency: b = ηc/ω on top of its dampers.

    frequency (...) [rad/s]: ω at which both lose the same; disturbed (...) [rad/s]: that for small disturbances.
    """
    if not np.any(model.loss_factor):
        return model

    def viscous(omega: ArrayLike) -> Array:
        lost: Array = model.loss_factor * model.stiffness / np.asarray(omega, dtype=float)[..., None]
        return model.damping + lost

    return replace(
        model,
        damping=viscous(frequency),
        disturbed_damping=None if disturbed is None else viscous(disturbed),
        loss_factor=np.zeros_like(model.loss_factor),
    )


def swinging(train: TorsionalTrain) -> TorsionalModel:
    """Return the model with pendulums as bodies with their own angle, exact for any swing, as motion in time needs.

    A point mass m on an arm l at the pivot radius R counts with m R² on its station, m l² about its own turning angle
    θ and m R l cos(θ - F) between the two; its element is the stop. Raises InputError: a pivot on a station without
    inertia.
    """
    model = train.model
    if not train.pendulums:
        return model
    inertia, stiffness, damping, backlash = (
        np.array(one, dtype=float) for one in (model.inertia, model.stiffness, model.damping, model.backlash)
    )
    own = gathered(model, model.inertia)
    hinges = tuple(model.elements[e] for e in train.pendulums)
    coupling = np.zeros(len(hinges))
    for k, (e, (pivot, tip), hung) in enumerate(zip(train.pendulums, hinges, train.hung, strict=True)):
        if not own[model.coordinate[pivot]] > 0.0:
            text = _("{name} has no inertia; pendulums in time need some on their station")
            raise refuse("stations.inertia", text.format(name=model.names[pivot]))
        mass = hung.count * hung.mass
        inertia[pivot] += mass * hung.radius**2
        inertia[tip] = mass * hung.length**2
        coupling[k] = mass * hung.radius * hung.length
        stiffness[e] = hung.count * (hung.stop_stiffness or 0.0)
        damping[e] = hung.count * hung.stop_damping
        backlash[e] = 2.0 * (hung.stop_angle or 0.0)
    return replace(
        model,
        inertia=inertia,
        stiffness=stiffness,
        damping=damping,
        backlash=backlash,
        hinges=hinges,
        coupling=coupling,
    )


BAND = 2e-4
"""Share of a speed below which dry friction grows with the speed of the twist, so that it sticks but for a creep."""


def sprung(model: TorsionalModel, train: TorsionalTrain, speed: ArrayLike) -> TorsionalModel:
    """Return a model of a train with its springs by their tables and dry friction by Coulomb.

    speed (...) [rad/s]: by which the band of friction is told. A table stands beside the straight spring of the model,
    with what its torques differ from that.
    """
    if not train.springs:
        return model
    friction = np.zeros(len(model.elements))
    tables: list[tuple[tuple[float, ...], tuple[float, ...]] | None] = [None] * len(model.elements)
    for e, one in train.springs:
        friction[e] = one.friction
        if one.twists:
            straight = float(np.ravel(train.model.stiffness[..., e])[0]) * np.asarray(one.twists)
            tables[e] = one.twists, tuple((np.asarray(one.torques) - straight).tolist())
    turning = np.abs(np.asarray(speed, dtype=float))
    creep = BAND * np.where(turning > 0.0, turning, 1.0)[..., None] * np.ones(len(model.elements))
    return replace(model, tables=tuple(tables), friction=friction, creep=creep)


def in_full(train: TorsionalTrain, speed: float) -> TorsionalModel:
    """Return the model for motion in time: pendulums as bodies, springs by their tables, dry friction by Coulomb.

    speed [rad/s]: by which the band of friction is told. Raises InputError: see `swinging`.
    """
    return sprung(swinging(train), train, speed)


def stacked(models: Sequence[TorsionalModel]) -> TorsionalModel:
    """Return models that are built alike as one with a leading axis.

    models: with the same stations, elements and kinds of torque; numbers may differ, tables of torques may not.
    Raises InputError: they are not built alike.
    """
    return _merged(models, np.stack)


def chained(models: Sequence[TorsionalModel]) -> TorsionalModel:
    """Return models with one leading axis each, that are built alike, as one: their drives one after the other.

    models, sequence of TorsionalModel (b,).
    Raises InputError: they are not built alike.
    """
    angle_errors = [leading(one) for one in models]
    return _merged(
        [
            chosen(one, angle_error, np.arange(angle_error[0]), moments=False)
            for one, angle_error in zip(models, angle_errors, strict=True)
        ],
        np.concatenate,
    )


def _merged(models: Sequence[TorsionalModel], join: Callable[[list[Array]], Array]) -> TorsionalModel:
    first = models[0]
    built = [
        (one.driven, one.elements, one.free, [(t.station, type(t.law), _shared(t.law)) for t in one.torques])
        for one in models
    ]
    if any(one != built[0] for one in built):
        raise refuse("models", _("are not built alike: their stations, elements or torques differ"))
    wide = max(0 if one.sums is None else one.sums.shape[-1] for one in models)
    models = [replace(one, sums=_widened(one, wide)) for one in models] if wide else models
    models = [one if one.tables == first.tables else _beside(one, first) for one in models]
    if any(one.disturbed_damping is not None for one in models):
        models = [replace(one, disturbed_damping=one.of_disturbances.damping) for one in models]
    first = models[0]
    given = [name for name in ARRAYS if getattr(first, name) is not None]
    parts: dict[str, Any] = {name: join([getattr(one, name) for one in models]) for name in given}
    parts["torques"] = tuple(
        Torque(station=torque.station, law=_merged_law([one.torques[k].law for one in models], join))
        for k, torque in enumerate(first.torques)
    )
    speed = None if first.input_speed is None else join([np.asarray(one.input_speed) for one in models])
    return replace(first, input_speed=speed, **parts)


def _beside(model: TorsionalModel, other: TorsionalModel) -> TorsionalModel:
    """Return a model with the tables of another that stand beside other straight springs, and with these."""
    stiffness = np.array(model.stiffness)
    for e, (own, its) in enumerate(zip(model.tables, other.tables, strict=True)):
        if own is None or its is None:
            continue
        both = [
            np.asarray(t) + np.ravel(m.stiffness[..., e])[0] * np.asarray(x)
            for m, (x, t) in ((model, own), (other, its))
        ]
        if own[0] != its[0] or not np.allclose(*both):
            raise refuse("models", _("are not built alike: their springs by tables differ"))
        stiffness[..., e] = np.ravel(other.stiffness[..., e])[0]
    return replace(model, stiffness=stiffness, tables=other.tables)


def _widened(model: TorsionalModel, width: int) -> Array:
    """Return the sums of a model with zeros for what it has less."""
    sums = np.zeros((*model.joint_angle.shape[:-1], 0)) if model.sums is None else model.sums
    return np.concatenate([sums, np.zeros((*sums.shape[:-1], width - sums.shape[-1]))], axis=-1)


def _shared(law: Law) -> list[object]:
    return [np.asarray(getattr(law, one.name)).tolist() for one in fields(law) if one.name in SHARED]  # type: ignore[arg-type]


def _merged_law(laws: Sequence[Law], join: Callable[[list[Array]], Array]) -> Law:
    own = [one.name for one in fields(laws[0]) if one.name not in SHARED]  # type: ignore[arg-type]
    return replace(laws[0], **{name: join([np.asarray(getattr(one, name)) for one in laws]) for name in own})  # type: ignore[type-var]
