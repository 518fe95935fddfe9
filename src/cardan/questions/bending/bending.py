"""At which speeds do the shafts of a drive whirl, and how far does it stay away from them?"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from enum import IntEnum
from typing import Any, Literal

import numpy as np

from cardan.drive.body import pieces
from cardan.drive.conditions import held_speeds, used_speeds
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.fields.parts import known_lengths
from cardan.drive.models.geometry import geometry
from cardan.errors import Problem, check, refuse
from cardan.formulas.critical_speed import HALF_BAND, SEPARATION, Margin, speed_margin, uniform_speed
from cardan.formulas.damping import LOSS
from cardan.formulas.run_up import passing_time
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.kernel import frames
from cardan.maths.linear.modes import Modes, strain, synchronous
from cardan.maths.linear.rotor_beams import Line, divided
from cardan.maths.linear.transfer import modes_below, speeds
from cardan.questions.motion.moving_points import moving_points
from cardan.texts import _

from .whirl_line import WhirlLine, whirl_line

SPLINED = 0.9
"""Real over computed critical speed of a shaft with a spline, where the drive does not say."""

FINE = 16
"""Elements along the line for each mode, and one mode more."""

MORE = 3
"""Modes looked at beyond those asked for, to find one in which a shaft bows."""

APART = 1e-6
"""Share by which the count of modes keeps off the last one: rounding of soft bearings under stiff shafts."""

MOST = 40
"""Most modes that can be asked for."""


class Running(IntEnum):
    """How a drive runs beside its critical speeds."""

    CLEAR = 0
    """All rules are kept."""
    CLOSE = 1
    """It stays below the critical speed, nearer than a rule allows."""
    BEYOND = 2
    """It reaches the critical speed."""
    UNKNOWN = 3
    """The drive says no speed."""
    NEAR = 4
    """It holds a speed too near to one that excites a mode, of a shaft or of a support."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Part:
    """What moves in a mode."""

    kind: Literal["shaft", "support"]  # a shaft that bows, or a support that gives way while shafts hardly bend
    number: int
    waves: int = 1  # half waves of the shaft between its ends; 1 for a support
    # whether the support gives way sideways, where its stiffness that way is another one
    sideways: bool = field(default=False, repr=False)


@dataclass(frozen=True, eq=False, kw_only=True)
class CriticalSpeeds:
    """Bending critical speeds of a drive, lowest first, and what whirls.

    Attributes
    ----------
    speed : array (m,) [rad/s]
        Critical speeds as computed.
    actual : array (m,) [rad/s]
        Those of the real shafts, k_n times the computed ones.
    wear : array (m,)
        k_n of each mode: of the shaft that bows in it; 1 where a support gives way, which no spline slackens.
    at_rest : array (m,) [rad/s]
        Natural frequencies of the standing shafts, as a tap shows them.
    part : tuple of Part
        What moves in each mode.
    shaft_share : array (m, n+1)
        Share of the energy of each mode that bends each shaft.
    support_share : array (m, k)
        Share that each support takes up.
    used : (float, float) or None [rad/s]
        Lowest and highest speed of running; None where the drive says none.
    steady : tuple of float [rad/s]
        Speeds that it holds: of the duty and of its load cases, in rising order.
    crossed : array of bool (m,)
        Whether the drive passes the real critical speed on its way to the highest speed.
    half_crossed : array of bool (m,)
        Whether it comes into the band about half of it, where the secondary couples excite the mode.
    near : array of bool (m,)
        Whether it holds a speed within 20 percent of the real critical speed.
    half_near : array of bool (m,)
        Whether it holds a speed in the band about half of it.
    deciding : int or None
        Mode that the rules are about: the lowest in which a shaft bows, counted from 0; it may lie beyond those asked
        for. None where none was found.
    bowing : Part or None
        That shaft.
    margin : Margin or None
        How far the drive stays below that mode; None without a speed.
    alone : array (n+1,) [rad/s]
        First critical speed of each shaft between two joints by itself, by the closed formula for a plain tube like its
        longest stretch; nan for others.
    place : array (p,) [m]
        Along the line from joint 1 on.
    deflection : array (m, p)
        Shape of each mode; the largest of each is 1.
    joint_place : array (n,) [m]
        Where the joints are; nan where they are not part of the line.
    support_place : array (k,) [m]
        Where the supports are; nan where they are not part of the line.
    shaft_span : array (n+1, 2) [m]
        Beginning and end of each shaft; nan where it is not part of the line.
    rigid : tuple of bool
        For each support, whether it holds its shaft still sideways.
    held : tuple of int
        Joints at the ends that count as held by the machine.
    residual : float
        Largest difference between the finite elements and the transfer matrices, over the speed.
    missed : int
        Critical speeds up to the last one that the count of the transfer matrices has more; zero when all were found.
    assumed : tuple of str
        Paths of what the drive does not say and the answer assumes.
    """

    speed: Array
    actual: Array
    wear: Array
    at_rest: Array
    part: tuple[Part, ...]
    shaft_share: Array
    support_share: Array
    used: tuple[float, float] | None
    steady: tuple[float, ...]
    crossed: Array
    half_crossed: Array
    near: Array
    half_near: Array
    deciding: int | None
    bowing: Part | None
    margin: Margin | None
    alone: Array
    place: Array
    deflection: Array
    joint_place: Array
    support_place: Array
    shaft_span: Array
    rigid: tuple[bool, ...]
    held: tuple[int, ...]
    residual: float
    missed: int
    assumed: tuple[str, ...] = ()

    @property
    def status(self) -> Running:
        """How the drive runs beside its critical speeds."""
        if self.margin is None:
            return Running.UNKNOWN
        if "supercritical" in self.margin.violated:
            return Running.BEYOND
        if np.any(self.near | self.half_near):
            return Running.NEAR
        return Running.CLOSE if self.margin.violated else Running.CLEAR

    @property
    def failed(self) -> bool:
        """Whether a rule is broken that is no advice."""
        return self.status in (Running.BEYOND, Running.NEAR) or bool(self.margin and self.margin.failed)

    @property
    def band(self) -> Array:
        """Speeds about each real critical speed to keep out of, array (m, 2) [rad/s]."""
        return _bands(self.actual, np.full(len(self.actual), SEPARATION))

    @property
    def half_band(self) -> Array:
        """Speeds about half of each real critical speed to keep out of, array (m, 2) [rad/s]."""
        return _bands(0.5 * self.actual, half_widths(self.part))

    @property
    def clearance(self) -> float:
        """Distance of the speeds held from the nearest critical speed or half of one, over it; nan without a speed."""
        middle = np.concatenate((self.actual, 0.5 * self.actual))[:, None]
        return float(np.min(np.abs(np.asarray(self.steady) / middle - 1.0), initial=np.inf)) if self.steady else np.nan

    def passing(self, mode: int, *, half: bool = False) -> tuple[float, float]:
        """Return how long passing a mode, or the band about half of it, may take for half and all to build up [s]."""
        width = float(half_widths(self.part)[mode]) if half else SEPARATION
        return passing(float(self.actual[mode]), self.part[mode].kind, width)


def bending_speeds(drive: Drive, duty: Duty | None = None, *, modes: int = 3) -> CriticalSpeeds:
    """Return the bending critical speeds of a drive, what whirls at them, and how far it stays below.

    Parameters
    ----------
    drive : Drive
        With a body for each shaft between two joints; better with masses of its yokes and stiffness of its supports.
    duty : Duty, optional
        Speeds of running; those of the drive by default.
    modes : int
        How many critical speeds; more where speeds of running come near to more of them.

    Returns
    -------
    CriticalSpeeds

    Raises
    ------
    InputError
        A shaft has no body or no length, or shafts can swing freely: with the keys to add.

    See Also
    --------
    critical_speed_map, rotor_response

    Notes
    -----
    Timoshenko's beams with rotary inertia and gyroscopic action, hinged at the joints, in forward whirl as fast as
    they spin (dynamics of rotors; Book (253)-(260) is the uniform shaft between two joints). Speeds are those of exact
    transfer matrices, shapes those of finite elements, and each checks the other. Shafts are taken along their own
    axes, as if the joints were straight. The rules of book and makers are about the lowest mode in which a shaft bows;
    in the modes below it a soft support gives way; one that is stiffer or softer sideways gives way at two speeds, that
    way and up and down. No speed is held within 20 percent of any mode, or in the band about
    half of it: 8 percent to either side where a shaft bows, a maker's rule, 20 where a support gives way.

    Examples
    --------
    >>> from cardan import bending_speeds, example
    >>> from cardan.units import rpm
    >>> found = bending_speeds(example("truck-supports"))
    >>> (found.speed / rpm).round(), found.part[0], round(found.margin.ratio, 2)
    (array([ 9325., 17679., 35533.]), Part(kind='shaft', number=3, waves=1), 4.66)
    """
    if not 1 <= modes <= MOST:
        raise refuse("modes", _("{value} is not allowed; allowed is 1 to {most}").format(value=modes, most=MOST))
    found, other = _critical_speeds(drive, duty, modes), sideways(drive)
    return found if other is None else _both_ways(drive, found, _critical_speeds(other, duty, modes))


def sideways(drive: Drive) -> Drive | None:
    """Return a drive whose supports are as stiff up and down as they are sideways; None where they are as they are."""
    if all(one.side_stiffness in (None, one.stiffness) for one in drive.supports):
        return None
    aside = (
        one if one.side_stiffness is None else replace(one, stiffness=one.side_stiffness, side_stiffness=None)
        for one in drive.supports
    )
    return replace(drive, supports=tuple(aside))


def _both_ways(drive: Drive, down: CriticalSpeeds, aside: CriticalSpeeds) -> CriticalSpeeds:
    """Return critical speeds with those at which supports give way sideways among them."""
    rows = [
        k
        for k, one in enumerate(aside.part)
        if one.kind == "support" and drive.supports[one.number - 1].side_stiffness is not None
    ]
    order = np.argsort(np.concatenate([down.speed, aside.speed[rows]]), kind="stable")
    parts = (*down.part, *(replace(aside.part[k], sideways=True) for k in rows))
    shapes = [np.interp(down.place, aside.place, aside.deflection[k]) for k in rows]
    deflection = np.concatenate([down.deflection, np.reshape(shapes, (len(rows), len(down.place)))])
    each = ("speed", "actual", "wear", "at_rest", "shaft_share", "support_share")
    judged = ("crossed", "half_crossed", "near", "half_near")
    columns: dict[str, Any] = {
        name: np.concatenate([getattr(down, name), getattr(aside, name)[rows]])[order] for name in (*each, *judged)
    }
    deciding = down.deciding
    if deciding is not None:
        deciding = int(np.flatnonzero(order == deciding)[0]) if deciding < len(down.part) else deciding + len(rows)
    return replace(
        down,
        **columns,
        part=tuple(parts[k] for k in order),
        deflection=deflection[order],
        deciding=deciding,
        residual=max(down.residual, aside.residual),
        missed=down.missed + aside.missed,
    )


def _critical_speeds(drive: Drive, duty: Duty | None, modes: int) -> CriticalSpeeds:
    """Return the critical speeds of a drive whose supports are as stiff sideways as up and down."""
    whole = whirl_line(drive)
    factors = wear_factors(drive)
    chosen = drive.duty if duty is None else duty
    used, steady = used_speeds(chosen), held_speeds(chosen)
    if used is not None:
        reach = 2.0 * used[1] / ((1.0 - SEPARATION) * float(np.min(factors)))
        modes = min(max(modes, modes_below(whole.line, reach)), MOST)
    cuts = elements(whole, modes)
    fine = divided(whole.line, cuts)
    found = synchronous(fine, modes + MORE)
    part, shaft_share, support_share = _parts(drive, whole, fine, cuts, found)
    bowing = next((k for k, one in enumerate(part) if one.kind == "shaft"), None)
    wanted = modes if bowing is None else max(modes, bowing + 1)
    speed = speeds(whole.line, wanted, near=found.speed[:wanted])
    # a worn spline lets its shaft bow; a line that bounces on its supports does not feel it
    bounces = np.asarray([one.kind != "shaft" for one in part])
    wear = np.where(bounces, 1.0, factors[np.argmax(shaft_share, axis=-1)])[:wanted]
    first = slice(0, modes)
    at_rest = synchronous(fine, modes, spinning=False).speed
    actual = wear * speed
    top = np.nan if used is None else used[1]
    band = _bands(actual[first], np.full(modes, SEPARATION))
    half_band = _bands(0.5 * actual[first], half_widths(part[first]))
    return CriticalSpeeds(
        speed=speed[first],
        actual=actual[first],
        wear=wear[first],
        at_rest=speeds(whole.line, modes, spin=0.0, near=at_rest),
        part=part[first],
        shaft_share=shaft_share[first],
        support_share=support_share[first],
        used=used,
        steady=steady,
        crossed=actual[first] <= top,
        half_crossed=half_band[:, 0] <= top,
        near=_inside(steady, band),
        half_near=_inside(steady, half_band),
        deciding=bowing,
        bowing=None if bowing is None else part[bowing],
        margin=None
        if used is None or bowing is None
        else speed_margin(
            float(speed[bowing]),
            used[1],
            wear=float(wear[bowing]),
            application=chosen.application,
            operating=used,
            through=True,
            least=drive.limits.critical_speed,
        ),
        alone=_alone(drive),
        place=fine.place + whole.place[0],
        deflection=found.deflection[first],
        joint_place=_places(whole, whole.joint_node, len(drive.joints)),
        support_place=_places(whole, whole.support_node, len(drive.supports)),
        shaft_span=_spans(whole, len(drive.shafts)),
        rigid=tuple(one.radial and one.stiffness is None for one in drive.supports),
        held=whole.held,
        residual=float(np.max(np.abs(found.speed[first] / speed[first] - 1.0))),
        missed=_missed(whole, speed[first]),
        assumed=(*whole.assumed, *_assumed(drive)),
    )


def elements(whole: WhirlLine, modes: int, fine: int = FINE) -> Array:
    """Return into how many finite elements each beam of a line is cut for its lowest modes, int array (e,)."""
    size = (whole.place[-1] - whole.place[0]) / (fine * (modes + 1))
    return np.ceil(whole.line.length / size).astype(int)


def _parts(
    drive: Drive, whole: WhirlLine, fine: Line, cuts: Array, found: Modes
) -> tuple[tuple[Part, ...], Array, Array]:
    """Return what moves in each mode, and the shares of shafts and supports in its energy."""
    energy = strain(fine, found)
    owner = np.repeat(whole.shaft, cuts)
    numbers = [shaft.number for shaft in drive.shafts]
    shafts = np.stack([np.sum(energy.beams[:, owner == number], axis=-1) for number in numbers], axis=-1)
    node = np.concatenate(([0], np.cumsum(cuts)))
    supports = np.zeros((len(found.speed), len(drive.supports)))
    for number, at in whole.support_node.items():
        support = drive.supports[number - 1]
        slope = fine.slope_before(int(node[at])) + whole.support_slope[number] - whole.line.slope_before(at)
        # Supports at one place share what its spring takes up by their stiffness.
        for given, total, share in (
            (support.stiffness, whole.line.spring[at], energy.springs[:, node[at]]),
            (
                support.tilt_stiffness,
                whole.line.tilt_spring[whole.support_slope[number]],
                energy.tilt_springs[:, slope],
            ),
        ):
            if given is not None and total > 0.0:
                supports[:, number - 1] += given / total * share
    parts = []
    for k, soft in enumerate(supports):
        if np.sum(soft) > 0.5:
            parts.append(Part(kind="support", number=int(np.argmax(soft)) + 1))
        else:
            number = int(np.argmax(shafts[k])) + 1
            inside = np.flatnonzero(owner == number)
            parts.append(
                Part(kind="shaft", number=number, waves=_waves(found.deflection[k, inside[0] : inside[-1] + 2]))
            )
    return tuple(parts), shafts, supports


def _waves(shape: Array) -> int:
    """Return how many half waves a shaft makes about the line between its ends."""
    off = shape - np.linspace(shape[0], shape[-1], len(shape))
    side = np.sign(off[np.abs(off) > 0.02 * np.max(np.abs(off))])
    return 1 + int(np.count_nonzero(np.diff(side)))


def wear_factors(drive: Drive) -> Array:
    """Return real over computed critical speed of each shaft, array (n+1,).

    What the shaft says, else 0.9 with a spline and 1 without: the play of a spline lets the shaft whirl sooner, Book
    p. 228, where a new one has 0.9 to 0.95 and a worn one 0.7 to 0.8.
    """
    usual = [1.0 if shaft.spline is None else SPLINED for shaft in drive.shafts]
    given = [shaft.wear_factor for shaft in drive.shafts]
    return np.asarray([two if one is None else one for one, two in zip(given, usual, strict=True)])


def _assumed(drive: Drive) -> tuple[str, ...]:
    splined = [shaft for shaft in drive.shafts if shaft.spline is not None and shaft.wear_factor is None]
    return tuple(f"shafts[{shaft.number - 1}].wear_factor" for shaft in splined if shaft.has_body)


def passing(critical: float, kind: str, width: float = SEPARATION) -> tuple[float, float]:
    """Return how long passing a band about a critical speed may take for half and all of its resonance to build up [s].

    The damping is that of `LOSS`. About half its speed, excited twice a turn, a mode behaves alike.
    """
    half, full = (passing_time(critical, 0.5 * LOSS[kind], 2.0 * width, reached) for reached in ("half", "full"))
    return half, full


def half_widths(parts: tuple[Part, ...]) -> Array:
    """Return half the width of the band about half the critical speed of each mode, over its middle, array (m,)."""
    return np.asarray([SEPARATION if part.kind == "support" else HALF_BAND for part in parts])


def _bands(middle: Array, width: Array) -> Array:
    return middle[:, None] * (1.0 + width[:, None] * np.asarray([-1.0, 1.0]))


def _inside(speeds: tuple[float, ...], band: Array) -> Array:
    """Return whether one of some speeds lies in each band, array of bool (m,)."""
    held = np.asarray(speeds)
    return np.any((held > band[:, :1]) & (held < band[:, 1:]), axis=-1)


def _missed(whole: WhirlLine, speed: Array) -> int:
    """Return by how many the count of the transfer matrices differs from the speeds found below the last one."""
    below = float(speed[-1]) * (1.0 - APART)
    return abs(modes_below(whole.line, below) - int(np.sum(speed < below)))


def _alone(drive: Drive) -> Array:
    """Return the first critical speed of each shaft between two joints as a plain tube, nan for others."""
    found = np.full(len(drive.shafts), np.nan)
    for number, length in known_lengths(drive).items():
        body = pieces(drive.shafts[number - 1], length)
        if body:
            tube = max(body, key=lambda one: one.length)
            steel = tube.material
            found[number - 1] = uniform_speed(length, tube.outer, tube.inner, steel.youngs, steel.density, modes=1)[0]
    return found


def _places(whole: WhirlLine, node: dict[int, int], count: int) -> Array:
    found = np.full(count, np.nan)
    for number, at in node.items():
        found[number - 1] = whole.place[at]
    return found


def _spans(whole: WhirlLine, count: int) -> Array:
    found = np.full((count, 2), np.nan)
    for number in np.unique(whole.shaft):
        beams = np.flatnonzero(whole.shaft == number)
        found[number - 1] = whole.place[beams[0]], whole.place[beams[-1] + 1]
    return found


# How do the critical speeds of a drive change with the stiffness of a support or the length of a shaft?

VALUES = 49
"""Values of a map where none are given."""

COARSE = 8
"""Elements along the line for each mode, and one mode more: enough for curves."""

STIFFNESS = (1e4, 1e9)
"""Range of stiffness for a support whose own is not known [N/m]: soft rubber to a rigid housing."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CriticalSpeedMap:
    """Critical speeds over one quantity of the drive.

    Attributes
    ----------
    over : "stiffness" or "length"
        Radial stiffness of a support, or length of a shaft between its joints.
    number : int
        Of that support or shaft.
    value : array (v,) [N/m or m]
        Its values.
    speed : array (v, m) [rad/s]
        Critical speeds as computed, lowest first.
    drawn : float or None [N/m or m]
        Value in the drive; None for a support without a stiffness, which counts as rigid.
    used : (float, float) or None [rad/s]
        Lowest and highest speed of running; None where the drive says none.
    """

    over: Literal["stiffness", "length"]
    number: int
    value: Array
    speed: Array
    drawn: float | None
    used: tuple[float, float] | None


def critical_speed_map(
    drive: Drive,
    value: ArrayLike | None = None,
    *,
    support: int | None = None,
    shaft: int | None = None,
    modes: int = 3,
) -> CriticalSpeedMap:
    """Return the critical speeds of a drive over the stiffness of a support or the length of a shaft, all at once.

    Parameters
    ----------
    drive : Drive
        As for `bending_speeds`.
    value : array (v,) [N/m or m], optional
        Values; a range about that of the drive by default.
    support : int, optional
        Number of the support whose radial stiffness varies; by default the first elastic one, else the first that
        holds a shaft between two joints.
    shaft : int, optional
        Number of the shaft whose length varies; what is on it moves along. By default the longest, where no support
        can vary.
    modes : int
        How many critical speeds.

    Returns
    -------
    CriticalSpeedMap

    Raises
    ------
    InputError
        As `bending_speeds`; or the support or shaft is not part of the line, or values are not positive.

    See Also
    --------
    bending_speeds

    Notes
    -----
    Finite elements, all values in one stack.

    Examples
    --------
    >>> from cardan import example
    >>> from cardan.sweeps import critical_speed_map
    >>> from cardan.units import rpm
    >>> found = critical_speed_map(example("truck-supports"), [0.9, 1.2, 1.5], shaft=3, modes=1)
    >>> (found.speed / rpm).round(-1).tolist()
    [[16710.0], [10990.0], [7160.0]]
    """
    whole = whirl_line(drive)
    number = _chosen(drive, whole) if support is None and shaft is None else support
    given = None if value is None else np.atleast_1d(np.asarray(value, dtype=float))
    at = "support" if shaft is None and number is not None else "shaft"
    own = shaft or _longest(drive)
    check(_problems(drive, whole, at, number, own, given))
    if at == "support":
        assert number is not None
        return _over_stiffness(drive, whole, number, given, modes)
    return _over_length(drive, whole, own, given, modes)


def _chosen(drive: Drive, whole: WhirlLine) -> int | None:
    """Return the support whose stiffness varies when none is named, None where there is none to vary."""
    radial = [number for number in whole.support_node if drive.supports[number - 1].radial]
    elastic = [number for number in radial if drive.supports[number - 1].stiffness is not None]
    between = [number for number in radial if 1 < drive.supports[number - 1].shaft <= len(drive.joints)]
    return next(iter(sorted(elastic) + sorted(between)), None)


def _longest(drive: Drive) -> int:
    known = known_lengths(drive)
    return max(known, key=lambda number: known[number]) if known else 0


def _problems(
    drive: Drive, whole: WhirlLine, at: str, support: int | None, shaft: int, value: Array | None
) -> list[Problem]:
    found = []
    if at == "support" and (support not in whole.support_node or not drive.supports[support - 1].radial):
        found.append(
            Problem("support", _("support {number} holds no shaft of the line sideways").format(number=support))
        )
    if at == "shaft" and shaft not in known_lengths(drive):
        found.append(Problem("shaft", _("shaft {number} does not lie between two joints").format(number=shaft)))
    if value is not None and not bool(np.all(np.isfinite(value) & (value > 0.0))):
        found.append(Problem("value", _("not every value is finite and more than 0")))
    return found


def _over_stiffness(drive: Drive, whole: WhirlLine, number: int, given: Array | None, modes: int) -> CriticalSpeedMap:
    node, drawn = whole.support_node[number], drive.supports[number - 1].stiffness
    if given is None:
        low, high = STIFFNESS if drawn is None else (drawn / 30.0, 30.0 * drawn)
        given = np.geomspace(low, high, VALUES)
    beside = whole.line.spring[node] - (drawn or 0.0)
    spring = np.tile(whole.line.spring, (len(given), 1))
    spring[:, node] = beside + given
    free = tuple(one for one in whole.line.held if one != node)
    varied = replace(whole, line=replace(whole.line, spring=spring, held=free if drawn is None else whole.line.held))
    speed = _speeds(varied, whole, modes)
    return CriticalSpeedMap(
        over="stiffness", number=number, value=given, speed=speed, drawn=drawn, used=used_speeds(drive.duty)
    )


def _over_length(drive: Drive, whole: WhirlLine, number: int, given: Array | None, modes: int) -> CriticalSpeedMap:
    drawn = known_lengths(drive)[number]
    value = np.linspace(0.5 * drawn, 1.5 * drawn, VALUES) if given is None else given
    factor = np.where(whole.shaft == number, value[:, None] / drawn, 1.0)
    varied = replace(whole, line=replace(whole.line, length=whole.line.length * factor))
    speed = _speeds(varied, whole, modes)
    return CriticalSpeedMap(
        over="length", number=number, value=value, speed=speed, drawn=drawn, used=used_speeds(drive.duty)
    )


def _speeds(varied: WhirlLine, whole: WhirlLine, modes: int) -> Array:
    """Return the critical speeds of a stack of lines, array (v, m) [rad/s]."""
    return synchronous(divided(varied.line, elements(whole, modes, COARSE)), modes).speed


# Where do the critical speeds go while a spline slides in a movement?

STRETCH = 0.02
"""Share of a length by which it is changed to see how the critical speeds go with it."""


def length_powers(drive: Drive, modes: int) -> Array:
    """Return by which powers of the length of each shaft between two joints critical speeds go, array (n-1, m).

    drive: as for `bending_speeds`; modes: how many critical speeds, lowest first.
    """
    lengths = [known_lengths(drive).get(number) for number in range(2, len(drive.joints) + 1)]
    found = np.zeros((len(lengths), modes))
    for k, length in enumerate(lengths):
        if length is not None:
            ends = length * (1.0 + STRETCH * np.asarray([-1.0, 1.0]))
            speed = np.log(critical_speed_map(drive, ends, shaft=k + 2, modes=modes).speed)
            found[k] = (speed[1] - speed[0]) / np.log(ends[1] / ends[0])
    return found if sideways(drive) is None else found[:, _upright(bending_speeds(drive, modes=modes).part[:modes])]


def _upright(parts: tuple[Part, ...]) -> list[int]:
    """Return of modes their place among those up and down; of a support sideways that of its own up and down."""
    among = [one for one in parts if not one.sideways]
    alike = {one.number: k for k, one in reversed(list(enumerate(among))) if one.kind == "support"}
    before = np.cumsum([not one.sideways for one in parts])
    return [
        alike.get(one.number, int(count)) if one.sideways else int(count) - 1
        for one, count in zip(parts, before, strict=True)
    ]


def over_movement(drive: Drive) -> Callable[[Array], Array]:
    """Return how near a moving drive is to its critical speeds at any instants.

    drive: with movements, as for `bending_speeds`.
    Returns a function of instants (t,) [s] to values (k, t): the deciding critical speed and how far the speeds held
    keep off all of them and half of them, each negative.
    The lengths of the shafts move them, by `length_powers`: near enough for instants that are then asked by themselves.
    """
    found, points = bending_speeds(drive), np.asarray(geometry(drive).points)
    powers, drawn = length_powers(drive, len(found.actual)), _lengths(points)
    deciding = min(found.deciding or 0, len(found.actual) - 1)

    def values(times: Array) -> Array:
        length = _lengths(moving_points(points, drive.movements, times)[0])
        actual = found.actual * np.exp(np.log(length / drawn) @ powers)
        middle = np.concatenate((actual, 0.5 * actual), axis=-1)[..., None]
        off = np.min(np.abs(np.log(np.asarray(found.steady) / middle)), axis=(-2, -1), initial=np.inf)
        return np.stack((-actual[:, deciding], np.where(np.isfinite(off), -off, np.nan)))

    return values


def _lengths(points: Array) -> Array:
    """Return the lengths of the shafts between two joints, array (..., n-1) [m]."""
    return frames.norm(np.diff(points, axis=-2))[..., 1:-1]
