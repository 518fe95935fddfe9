"""Does torsional vibration of a running drive die out? At its speed, or over two quantities of the drive."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from functools import lru_cache, partial

import numpy as np

from cardan.drive.conditions import held_speeds, speed_ranges, used_speeds
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.fields.paths import place, read, with_values
from cardan.drive.models.kinematics_model import given_chain
from cardan.errors import InputError, Problem, check, refuse
from cardan.maths.arrays import Array, ArrayLike
from cardan.questions.torsion.model.joint_bends import bends
from cardan.questions.torsion.model.torsional_layouts import chosen as some_of
from cardan.questions.torsion.model.torsional_model import Torque, TorsionalModel
from cardan.questions.torsion.model.torsional_modes import straight_modes
from cardan.questions.torsion.model.torsional_train import TorsionalTrain, chained, sprung, torsional_train
from cardan.questions.torsion.steady.run_stability import Floquet, Verdict, Zone, floquet, joined
from cardan.questions.torsion.steady.several import (
    middle_ones,
    settled_judgement,
    several_looked_for,
    stable_motions,
    told_motions,
)
from cardan.questions.torsion.steady.torsion_response import (
    Progress,
    damped,
    loaded_model,
    order_jumps,
    parted,
)
from cardan.questions.torsion.steady.two_frequency_stability import meetings, with_torques
from cardan.texts import _
from cardan.units import deg

from .floquet_map import FloquetMap, floquet_map, within
from .proved_speeds import WORK, ProvedSpeeds, proved_speeds

CHUNK, FEW = 2048, 128
"""Points of a map that are judged at once: variants of one quantity beside the speed, and of two."""

MOST = 1_000_000
"""Points of a map at most."""

JOINT_ANGLE = "joint_angle_deg"
"""Stands for the joint angle of the most bent joint, the others in proportion."""

RANGE, TRIALS, ROUNDS = (1e-5, 1.0), 11, 3
"""Loss factors among which the least is looked for, how many at a time, and how often."""

PROVING, LITTLE = 0.5, 1.5e7
"""Share of the work after which stability over the speeds is proved, and how much that may take beside a map."""

CLOSER, PARTS, EDGE = 4, 6, 0.002
"""How often edges between such speeds are looked at closer, into how many parts each gap is divided, and the share of
the speed to which they are known then."""

EVEN, NARROW = 9, 0.02
"""Speeds of a range at most, evenly spread, at which torques that do not repeat are counted, and the share of the speed
by which they are apart at least."""

AROUND, SLOWEST = 0.1, 0.05
"""Share by which speeds are looked at beyond those in use, and of the highest below which none is."""

MANY = 1000
"""Points of a map at most at which torques that do not repeat within two turns count."""

ALONE = 0.2
"""Share of the work on points after which torques that do not repeat are counted, where there are some."""

TOLD = 4
"""Points of drives with several motions, up to which that is judged which `torsion_response` tells: seconds each."""

PACE = 0.001
"""Seconds that a point of a map takes, about."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Stability:
    """Stability of steady running, of one drive or over values (...) of one or two of its quantities.

    Attributes
    ----------
    over : tuple of (str, array)
        Paths of what varies with their values, in the unit of the path: the axes (...).
    train : TorsionalTrain
        The drive as it is.
    speed : array (...) [rad/s]
        Input speed.
    verdict : array of int (...)
        A `cardan.questions.torsion.steady.run_stability.Verdict` each.
    kind : array of int (...)
        A `cardan.questions.torsion.steady.run_stability.Kind` each: how the slowest disturbance to die out swings.
    growth_rate : array (...) [1/s]
        Of that disturbance; negative where it dies out.
    spectral_radius : array (...)
        Largest modulus of the multipliers.
    order : array (...)
        Lowest order of the shaft at which it swings.
    zone : Zone
        Nearest zone of parametric resonance.
    multipliers : array (..., m), complex
        What each disturbance is multiplied by over a period, the largest first.
    here : tuple of (str, float)
        Values of the drive itself on the axes, where it has one.
    cancelled : bool
        Whether the work was stopped; what was not done is unknown.
    units : tuple of (str, str)
        Dimension and unit of the values on every axis, empty where they have none.
    least_loss : float
        Loss factor of all shafts from which the drive is stable at its point, on top of its dampers; 0 where these are
        enough; nan over a map, and where no motion was found.
    proof : ProvedSpeeds, optional
        Over speeds: the unstable ranges between the lowest and the highest to their edges, and a proof that there are
        no others; on a map over something else too, of the drive as it is.
    together : array of bool (...)
        Whether torques of orders that do not repeat within two turns count, by the motion with them: at up to a
        thousand points, where that motion is known. All else is judged without them, the proof and the least loss
        factor too.
    jumped : array of bool (...)
        Whether a steady motion found first grows there, and another is judged that is stable beside it.
    """

    over: tuple[tuple[str, Array], ...]
    train: TorsionalTrain
    speed: Array
    verdict: Array
    kind: Array
    growth_rate: Array
    spectral_radius: Array
    order: Array
    zone: Zone
    multipliers: Array
    together: Array
    jumped: Array
    here: tuple[tuple[str, float], ...] = ()
    cancelled: bool = False
    units: tuple[tuple[str, str], ...] = ()
    least_loss: float = float("nan")
    proof: ProvedSpeeds | None = None

    @property
    def stable(self) -> Array:
        """Whether every disturbance dies out, array of bool (...)."""
        return self.verdict == Verdict.STABLE

    @property
    def unstable_share(self) -> float:
        """Share of the points known that are unstable."""
        known = self.verdict != Verdict.UNKNOWN
        return float(np.mean(self.verdict[known] == Verdict.UNSTABLE)) if np.any(known) else float("nan")


def stability(
    drive: Drive,
    duty: Duty | None = None,
    *,
    over: Mapping[str, ArrayLike] | None = None,
    pieces: int = 1,
    progress: Progress | None = None,
) -> Stability:
    """Return whether a drive runs stably in torsion, at its speed or over a map of two quantities.

    Parameters
    ----------
    drive : Drive
        With bodies or inertias and stiffnesses of its shafts, or `[[stations]]`; better with damping.
    duty : Duty, optional
        What it does; that of the drive by default.
    over : mapping of str to array, optional
        One or two paths, each with its values in the unit of the path, as ``{"duty.speed_rpm": [...],
        "shafts[1].damping_Nms_per_rad": [...]}``; ``"joint_angle_deg"`` is that of the most bent joint, the others in
        proportion. All else stays as it is.
    pieces : int
        Into how many equal stretches the body between two stations is divided.
    progress : function, optional
        Told the share done; when it answers "stop", what is not yet done stays unknown.

    Returns
    -------
    Stability

    Raises
    ------
    InputError
        What the model misses, a path that leads nowhere, a value that makes no drive, a map of too many points.

    See Also
    --------
    torsion_modes, torsion_response

    Notes
    -----
    Floquet multipliers of the exact equations about the periodic motion; see `run_stability.floquet`.

    Examples
    --------
    >>> from dataclasses import replace
    >>> from cardan import Drive, stability
    >>> from cardan.parts import Duty, Shaft, Station
    >>> from cardan.units import deg
    >>> drive = Drive.from_angles([25 * deg])
    >>> drive = replace(drive, shafts=(Shaft(number=1, stiffness=1000.0, damping=0.2),),
    ...     stations=(Station(shaft=2, inertia=0.4),), duty=Duty(speed=50.0))
    >>> found = stability(drive, over={"duty.speed_rad_s": [40.0, 50.0, 60.0]})
    >>> found.stable, found.zone.name((1,))
    (array([ True, False,  True]), 'principal zone of mode 1')
    """
    whole = drive if duty is None else replace(drive, duty=duty)
    axes = _axes(whole, over or {})
    shape = tuple(len(values) for _path, values in axes)
    variants = _Variants(whole, axes, pieces)
    count = int(np.prod(shape, dtype=int))
    parts: list[dict[str, Array]] = []
    stopped = False
    size = CHUNK if len(variants.others) < 2 else FEW
    order = variants.order(shape)
    for first in range(0, count, size):
        rows = order[first : first + size]
        last = first + len(rows)
        if stopped:
            parts.append(_unknown(parts[0], len(rows)))
            continue
        share = PROVING if variants.speeding is not None else 1.0
        told = within(progress, share * first / count, share * last / count)
        at = variants.at(np.unravel_index(rows, shape) if shape else (), len(rows), together=count <= MANY)
        model, speed, loose = at
        part, stopped = _judged(model, speed, told, loose, alone=count <= TOLD)
        parts.append(part)
        if progress is not None and not stopped:
            stopped = progress(share * last / count) == "stop" and last < count
    proof = variants.proof(within(progress, PROVING, 1.0)) if not stopped else None
    back = np.argsort(order)
    found = {name: np.concatenate([part[name] for part in parts])[back] for name in parts[0]}
    found = {name: values.reshape((*shape, *values.shape[1:])) for name, values in found.items()}
    zone = Zone(**{name.removeprefix("zone_"): found.pop(name) for name in list(found) if name.startswith("zone_")})
    known = not axes and int(found["verdict"]) != Verdict.UNKNOWN
    least = _least_loss(variants, int(found["verdict"]) <= Verdict.NEUTRAL) if known else float("nan")
    return Stability(
        least_loss=least,
        over=axes,
        train=variants.train,
        zone=zone,
        here=variants.here,
        cancelled=stopped,
        units=variants.units,
        proof=proof,
        **found,
    )


@lru_cache(maxsize=64)
def proved_in_use(drive: Drive, pieces: int = 1) -> ProvedSpeeds | None:
    """Return the unstable ranges at the speeds in use and a tenth beyond, None where the drive names no speed.

    Speeds that are held are judged by themselves too: where a line is too stiff for a proof, of several motions, and
    with torques of orders that do not repeat within two turns. With such torques so are some between them: evenly
    spread, and where they meet a mode twice, or two modes as a sum.
    Raises InputError: what the torsional model misses, each with the key to add.
    """
    used = used_speeds(drive.duty)
    if used is None or used[1] <= 0.0:
        return None
    sense = -1.0 if (drive.duty.speed or 1.0) < 0.0 else 1.0
    high = (1.0 + AROUND) * used[1]
    low = max((1.0 - AROUND) * used[0], SLOWEST * high)
    train = torsional_train(drive, drive.duty, speed=sense * low, pieces=pieces)
    between = (low, high) if sense > 0.0 else (-high, -low)
    proof = _proved(drive, between, train, pieces, LITTLE, None)

    told = partial(judged_of, drive, pieces=pieces)
    held = np.asarray(held_speeds(drive.duty))
    loose = parted(train.model)[1]
    for first, last in speed_ranges(drive.duty) if loose and not several_looked_for(train.model) else ():
        inside = held[(first <= held) & (held <= last)]
        speeds = np.union1d(inside, _between(max(first, low), last, train.model, loose))
        proof = proof.judged_at(*_edged(told, speeds))
        held = np.setdiff1d(held, inside)
    for one in held:
        proof = proof.judged_at(told(one[None]), one[None])
    return proof


def judged_of(drive: Drive, speeds: Array, *, pieces: int = 1) -> Floquet:
    """Return how stable the motions of a drive are at a few speeds above 0 [rad/s], in the sense in which it turns."""
    turning = speeds if (drive.duty.speed or 1.0) > 0.0 else -speeds
    model, loose = parted(loaded_model(drive, drive.duty, turning, pieces=pieces)[1])
    return judged(model, turning, loose)


def _edged(told: Callable[[Array], Floquet], speeds: Array) -> tuple[Floquet, Array]:
    """Return what is told at speeds (s,), and at more between a stable one and an unstable one; with all of them."""
    found = told(speeds)
    for _round in range(CLOSER):
        grows = found.verdict == Verdict.UNSTABLE
        left = np.flatnonzero(np.diff(grows) & (np.diff(speeds) > EDGE * speeds[1:]))
        if not left.size:
            break
        more = np.linspace(speeds[left], speeds[left + 1], PARTS + 1)[1:-1].ravel()
        order = np.argsort(np.concatenate([speeds, more]))
        found, speeds = joined(found, told(more), order), np.concatenate([speeds, more])[order]
    return found, speeds


def _between(low: float, high: float, model: TorsionalModel, loose: tuple[Torque, ...]) -> Array:
    """Return the speeds of a range at which torques that do not repeat are counted, rising, array (s,) [rad/s]."""
    meeting = meetings(straight_modes(replace(model, torques=())).omega, loose)
    count = int(np.clip(np.ceil((high - low) / (NARROW * high)), 1, EVEN - 1)) + 1
    every = np.concatenate([np.linspace(low, high, count), meeting[(low < meeting) & (meeting < high)]])
    return np.unique(every.round(6))


def proved_in_band(drive: Drive, low: float, high: float) -> ProvedSpeeds | None:
    """Return the unstable ranges of a drive between two speeds [rad/s]; None of a single speed.

    Raises InputError: what the torsional model misses, each with the key to add.
    """
    if not 0.0 < low < high:
        return None
    return _proved(drive, (low, high), torsional_train(drive, drive.duty, speed=low), 1, LITTLE, None)


def _proved(
    drive: Drive,
    between: tuple[float, float],
    train: TorsionalTrain,
    pieces: int,
    work: float,
    progress: Progress | None,
) -> ProvedSpeeds:
    def build(speeds: Array) -> TorsionalModel:
        return parted(loaded_model(drive, drive.duty, speeds, pieces=pieces)[1])[0]

    return proved_speeds(build, *between, breaks=order_jumps(train.model), work=work, progress=progress)


def no_smooth_motion(train: TorsionalTrain) -> str:
    """Return why a drive may have no smooth steady motion, or more than one, over a range of speeds."""
    loose, bends = bool(np.any(train.model.backlash > 0.0)), any(one.twists for _element, one in train.springs)
    if loose and bends:
        return _("backlash opens, a spring bends or the motion jumps")
    if loose:
        return _("backlash opens or the motion jumps")
    return _("a spring bends or the motion jumps") if bends else _("the motion jumps")


def _least_loss(variants: _Variants, kept: bool) -> float:
    """Return the loss factor of all shafts from which the drive is stable at its own point; nan where none is enough.

    kept: whether it is with its own. Of drives with several motions the first one found is judged, as one is searched
    for each loss factor; nan where that of their own contradicts it.
    """
    own = variants.train.model.loss_factor
    if kept and not np.any(own):
        return 0.0
    least = _least_of_all(variants)
    if several_looked_for(variants.model) and (least > np.max(own) if kept else least <= np.min(own)):
        return float("nan")
    return least


def _least_of_all(variants: _Variants) -> float:
    """Return the same of the first motion found.

    Its place is narrowed down between two loss factors of which the smaller is not stable, ten at a time.
    """
    train, speed = variants.train, variants.speeds[:1]

    def stable(loss: Array) -> Array:
        speeds = np.full(len(loss), speed[0])
        lossy = replace(train.model, loss_factor=loss[:, None] * np.ones_like(train.model.loss_factor))
        model = sprung(damped(lossy, train.model, speeds), train, speed[0])
        model = model if model.free else replace(model, input_speed=speeds)
        return np.asarray(_settled(floquet_map(parted(model)[0], speed=speeds)).verdict) <= Verdict.NEUTRAL

    trial = np.concatenate(([0.0], np.geomspace(*RANGE, TRIALS)))
    for _round in range(ROUNDS):
        kept = stable(trial)
        if kept[0] and trial[0] == 0.0:
            return 0.0
        if not kept.any():
            return float("nan")
        first = int(np.argmax(kept))
        trial = np.linspace(trial[first - 1], trial[first], TRIALS)
    return float(trial[int(np.argmax(stable(trial)))])


def judged(model: TorsionalModel, speed: Array, loose: tuple[Torque, ...] = ()) -> Floquet:
    """Return how stable the motions are that `torsion_response` tells at a few speeds (s,) [rad/s].

    loose: torques that do not repeat within two turns.
    """
    if several_looked_for(model):
        return floquet(told_motions(model, speed)[0])
    found = floquet_map(model, speed=speed)
    return _with_torques(found, _settled(found), loose)[0]


def _judged(
    model: TorsionalModel, speed: Array, progress: Progress | None, loose: tuple[Torque, ...] = (), *, alone: bool
) -> tuple[dict[str, Array], bool]:
    """Return what is known of some points, and whether the work was stopped.

    loose: torques that do not repeat within two turns.
    alone: judge the motions that `torsion_response` tells, where it searches several; else the first ones found.
    """
    if alone and several_looked_for(model):
        verdict, cancelled = judged(model, speed), False
        together = jumped = np.zeros(np.shape(verdict.verdict), dtype=bool)
    else:
        share = ALONE if loose else 1.0
        found = floquet_map(model, speed=speed, progress=within(progress, 0.0, share))
        rest = within(progress, share, 1.0)
        said: list[object] = []

        def told(done: float) -> object:
            said.append(rest(done) if rest is not None else None)
            return said[-1]

        settled = _settled(found)
        jumped = (found.floquet.verdict == Verdict.UNSTABLE) & (settled.verdict != Verdict.UNSTABLE)
        verdict, together = _with_torques(found, settled, loose, told)
        jumped &= verdict.verdict != Verdict.UNSTABLE
        cancelled = found.cancelled or "stop" in said
    zone = {f"zone_{one.name}": getattr(verdict.zone, one.name) for one in fields(Zone)}
    names = ("verdict", "kind", "growth_rate", "spectral_radius", "order", "multipliers")
    own = {"speed": speed, "together": together, "jumped": jumped}
    return {name: getattr(verdict, name) for name in names} | zone | own, cancelled


def _with_torques(
    found: FloquetMap, alone: Floquet, loose: tuple[Torque, ...], progress: Progress | None = None
) -> tuple[Floquet, Array]:
    """Return stability with torques that do not repeat, and where it counts them; alone: what it is without them."""
    if not loose:
        return alone, np.zeros(np.shape(alone.verdict), dtype=bool)
    several = bool(np.any(middle_ones(found.orbit, found.floquet)))
    orbit = stable_motions(found.orbit, found.status)[0] if several else found.orbit
    return with_torques(orbit, alone, loose, progress=progress)


def _settled(found: FloquetMap) -> Floquet:
    """Return how stable the motions of a map are, a stable one in place of the middle one of three."""
    return settled_judgement(found.orbit, found.status, found.floquet)


def _unknown(like: dict[str, Array], count: int) -> dict[str, Array]:
    """Return points that were not looked at."""
    empty = {name: np.nan if values.dtype.kind in "fc" else values.dtype.type(0) for name, values in like.items()}
    found = {name: np.full((count, *values.shape[1:]), empty[name]) for name, values in like.items()}
    return found | {"verdict": np.full(count, int(Verdict.UNKNOWN))}


def _axes(drive: Drive, over: Mapping[str, ArrayLike]) -> tuple[tuple[str, Array], ...]:
    """Return the paths with their values, and refuse what makes no map."""
    problems: list[Problem] = []
    axes: list[tuple[str, Array]] = []
    if len(over) > 2:
        text = _("{count} paths given; a map has one or two")
        problems.append(Problem("over", text.format(count=len(over))))
    for path, given in over.items():
        values = np.asarray(given, dtype=float)
        if values.ndim != 1 or not len(values) or not np.all(np.isfinite(values)):
            problems.append(Problem(path, _("a list of finite numbers is needed")))
        if path == JOINT_ANGLE:
            problems += _joint_angle_problems(drive, values)
        else:
            try:
                place(drive, path)
            except InputError as error:
                problems += error.problems
        axes.append((path, values))
    count = int(np.prod([values.size for _path, values in axes], dtype=float))
    if count > MOST:
        text = _("{count:,} points would take about {hours:,.0f} h; at most {most:,} are done")
        hours = count * PACE / 3600.0
        problems.append(Problem("over", text.format(count=count, hours=hours, most=MOST).replace(",", "\u202f")))
    check(problems)
    return tuple(axes)


def _joint_angle_problems(drive: Drive, values: Array) -> Iterator[Problem]:
    """Yield bends that no joint can have, or that none of the drive grows with."""
    if values.ndim == 1 and np.any((values < 0.0) | (values >= 90.0)):
        yield Problem(JOINT_ANGLE, _("a joint angle is from 0° to less than 90°"))
    if not np.max(given_chain(drive).joint_angle):
        yield Problem(JOINT_ANGLE, _("all joint angles are zero; there is nothing to scale in proportion"))


def _bent(drive: Drive, model: TorsionalModel, largest: float) -> TorsionalModel:
    """Return a model whose most bent joint bends so much [rad], the others in proportion, its yokes as they are."""
    whole = given_chain(drive)
    bent = replace(whole, joint_angle=whole.joint_angle * (largest / np.max(whole.joint_angle)))
    return replace(model, **bends(drive, bent))


class _Variants:
    """The drive with other values at the points of a map, and at its own where there is none."""

    def __init__(self, drive: Drive, axes: Sequence[tuple[str, Array]], pieces: int) -> None:
        self.drive, self.axes, self.pieces = drive, axes, pieces
        spots = [None if path == JOINT_ANGLE else place(drive, path) for path, _values in axes]
        self.bending = next((k for k, spot in enumerate(spots) if spot is None), None)
        speeds = ((k, spot) for k, spot in enumerate(spots) if spot is not None and spot.steps == ("duty", "speed"))
        self.speeding: int | None
        self.speeding, factor = next(((k, spot.factor) for k, spot in speeds), (None, 1.0))
        if drive.duty.speed is None and self.speeding is None:
            raise refuse("duty.speed", _("missing; torsional vibration needs it"), "missing")
        self.speeds = np.asarray([drive.duty.speed or 0.0])
        if self.speeding is not None:
            path, values = axes[self.speeding]
            self.speeds = values * factor
            if np.any(self.speeds == 0.0):
                raise refuse(path, _("0 is given; steady running needs a speed other than 0"))
        self.others = [k for k in range(len(axes)) if k != self.speeding]
        largest = float(np.max(given_chain(drive).joint_angle, initial=0.0)) / deg
        own = {path: largest if path == JOINT_ANGLE else read(drive, path) for path, _values in axes}
        self.units = tuple(
            ("angle", "deg")
            if spot is None
            else (spot.field.key.dimension or "", spot.field.unit(spot.spelling) if spot.field.key.dimension else "")
            for spot in spots
        )
        self.here = tuple((path, float(value)) for path, value in own.items() if isinstance(value, float | int))
        self.train, self.model = loaded_model(drive, drive.duty, self.speeds[:1], pieces=pieces)

    def proof(self, progress: Progress | None) -> ProvedSpeeds | None:
        """Return the unstable ranges between the lowest and the highest of the speeds, of the drive as it is."""
        low, high = float(np.min(self.speeds)), float(np.max(self.speeds))
        if self.speeding is None or not low < high or low * high < 0.0:
            return None
        work = LITTLE if self.others else WORK
        return _proved(self.drive, (low, high), self.train, self.pieces, work, progress)

    def order(self, shape: tuple[int, ...]) -> Array:
        """Return the points of a map in the order they are asked in: every drive at all its speeds, then the next."""
        every = np.arange(int(np.prod(shape, dtype=int))).reshape(shape)
        return every.reshape(-1) if self.speeding is None else np.moveaxis(every, self.speeding, -1).reshape(-1)

    def at(
        self, index: Sequence[Array], count: int, *, together: bool
    ) -> tuple[TorsionalModel, Array, tuple[Torque, ...]]:
        """Return the models (b,) and speeds (b,) of points by their places on the axes, and torques that do not repeat.

        together: whether these are asked for; none where the points have others than each other.
        """
        column = np.zeros(count, dtype=int) if self.speeding is None else index[self.speeding]
        speed = self.speeds[column]
        keys = np.stack([index[k] for k in self.others], axis=-1) if self.others else np.zeros((count, 0), dtype=int)
        found: list[TorsionalModel] = []
        beside: list[TorsionalModel] = []
        order: list[Array] = []
        for key in np.unique(keys, axis=0):
            rows = np.flatnonzero(np.all(keys == key, axis=-1))
            drive = self._variant(key)
            _train, model = loaded_model(drive, drive.duty, speed[rows], pieces=self.pieces)
            if self.bending is not None:
                largest = float(self.axes[self.bending][1][key[self.others.index(self.bending)]])
                model = _bent(drive, model, largest * deg)
            steady, loose = parted(model)
            for kept, torques in ((found, steady.torques), *([(beside, loose)] if together and loose else [])):
                own = replace(steady, torques=torques)
                kept.append(some_of(own, (len(rows),), np.arange(len(rows)), moments=False))
            order.append(rows)
        back = np.argsort(np.concatenate(order), kind="stable")
        kinds = {tuple((torque.station, torque.law.order) for torque in one.torques) for one in beside}
        alike = len(kinds) == 1 and len(beside) == len(found)
        whole = some_of(chained(found), (count,), back, moments=False)
        loose = some_of(chained(beside), (count,), back, moments=False).torques if alike else ()
        return whole, speed, loose

    def _variant(self, key: Array) -> Drive:
        pairs = [(self.axes[k], j) for k, j in zip(self.others, key, strict=True) if k != self.bending]
        values = {path: float(given[j]) for (path, given), j in pairs}
        return with_values(self.drive, values) if values else self.drive
