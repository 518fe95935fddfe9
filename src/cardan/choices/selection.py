"""Which type of joint to take: every row of the catalogue accepted, accepted under conditions, or rejected, and why."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np

from cardan.answers.quantity import Quantity, Text, say
from cardan.catalogue import Catalogue, catalogue, filled
from cardan.catalogue.rows import JointSize, JointType
from cardan.checks import design
from cardan.checks.moving import along, stood
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.errors import InputError, Problem, check
from cardan.maths.arrays import Array
from cardan.maths.curves.extremes import tops
from cardan.questions.life.bearing_life import CONVENTIONS, maker_life, reliability_factor
from cardan.questions.life.duty_cycle import combined_life
from cardan.questions.life.life import DutyLoads, duty_loads, mean_life
from cardan.questions.motion.moving_points import default_times
from cardan.texts import _

SLACK = 1e-12
"""A limit may be exceeded by this share: what is left of rounding."""


@dataclass(frozen=True, kw_only=True)
class JointDuty:
    """What a joint must do.

    Attributes
    ----------
    torque : float [N·m]
    joint_angle : float [rad]
        Of the joint.
    speed : float [rad/s]
    synchronous : bool
        Whether the output must turn uniformly.
    service_factor : float
        Factor on the torque.
    continuous : bool
        Whether it runs for long at a time: then the product of speed and joint angle counts.
    outer : float [m], optional
        Outer diameter of the joint: then the speed of its rim counts.
    life : float [s], optional
        Running time asked of its bearings.
    reliability : float
        Share of the bearings that reach it.
    loads : tuple of DutyLoads
        What they carry in every part of the duty; without any, the largest torque at the highest speed all the time.
    """

    torque: float
    joint_angle: float
    speed: float
    synchronous: bool = False
    service_factor: float = 1.0
    continuous: bool = True
    outer: float | None = None
    life: float | None = None
    reliability: float = 0.9
    loads: tuple[DutyLoads, ...] = field(default=(), repr=False)

    def __post_init__(self) -> None:
        check(
            Problem(name, _("{value:.6g} given; {allowed} is needed").format(value=value, allowed=allowed))
            for name, value, fine, allowed in (
                ("torque", self.torque, self.torque > 0.0, _("more than 0")),
                (
                    "joint_angle",
                    math.degrees(self.joint_angle),
                    0.0 <= self.joint_angle < 0.5 * math.pi,
                    _("0° to less than 90°"),
                ),
                ("speed", self.speed, self.speed >= 0.0, _("at least 0")),
                ("service_factor", self.service_factor, self.service_factor > 0.0, _("more than 0")),
                ("outer", self.outer, self.outer is None or self.outer > 0.0, _("more than 0")),
                ("life", self.life, self.life is None or self.life > 0.0, _("more than 0")),
            )
            if not fine
        )


@dataclass(frozen=True, kw_only=True)
class Candidate:
    """A type of joint and what is to be said for and against it.

    Attributes
    ----------
    row : JointType
    causes : tuple of str
        Why it is rejected: "angle", "n_alpha", "rim_speed", "synchronous", "torque".
    flags : tuple of str
        Under which conditions it is accepted: "approx_synchronous", "oversized", "pair_needed", "unverified_angle",
        "unverified_rim_speed", "unverified_torque".
    headroom : float
        Largest torque over the torque needed; nan where the catalogue gives none.
    """

    row: JointType
    causes: tuple[str, ...] = ()
    flags: tuple[str, ...] = ()
    headroom: float = math.nan

    @property
    def state(self) -> str:
        """How it stands: "ok", "conditional", "unrated" where no torque of it is known, or "rejected"."""
        if self.causes or "unverified_torque" in self.flags:
            return "rejected" if self.causes else "unrated"
        return "conditional" if self.flags else "ok"


def select_joint(
    need: JointDuty, *, known: Catalogue | None = None, include_beyond: bool = False
) -> tuple[Candidate, ...]:
    """Return every type of joint of the catalogue with what is for and against it, the best first.

    Parameters
    ----------
    need : JointDuty
    known : Catalogue, optional
        The shipped one when not given.
    include_beyond : bool
        Whether modern types count whose limits are typical values of the trade.

    Returns
    -------
    tuple of Candidate
        Those accepted, then those under the fewest conditions, too large ones last, the least torque to spare first;
        then those without a torque in their source, which are no candidates, then the rejected ones.

    See Also
    --------
    joint_duty, size

    Examples
    --------
    >>> import math
    >>> from cardan.joints import JointDuty, select_joint
    >>> found = select_joint(JointDuty(torque=2.5e6, joint_angle=math.radians(9.0), speed=6.28))
    >>> sorted(one.row.id for one in found if one.state == "ok")
    ['mill_slipper', 'super_heavy']
    """
    rows = (known or catalogue()).rows(JointType).values()
    judged = [_judged(row, need) for row in rows if include_beyond or row.confidence != "beyond"]
    order = ("ok", "conditional", "unrated", "rejected")

    def rank(one: Candidate) -> tuple[float, ...]:
        spare = 0.0 if math.isnan(one.headroom) else one.headroom
        return order.index(one.state), "oversized" in one.flags, len(one.causes or one.flags), spare

    return tuple(sorted(judged, key=rank))


def _judged(row: JointType, need: JointDuty) -> Candidate:
    torque = need.torque * need.service_factor
    causes, flags = set(), set()

    def compare(value: float, limit: float | None, cause: str, unverified: str | None) -> None:
        if limit is None:
            flags.update([unverified] if unverified else [])
        elif value > limit * (1.0 + SLACK):
            causes.add(cause)

    compare(torque, row.max_torque, "torque", "unverified_torque")
    compare(need.joint_angle, row.max_joint_angle, "angle", "unverified_angle")
    if need.continuous:
        compare(need.speed * need.joint_angle, row.max_speed_angle, "n_alpha", None)
    if row.max_rim_speed is not None:
        if need.outer is None:
            flags.add("unverified_rim_speed")
        else:
            compare(0.5 * need.speed * need.outer, row.max_rim_speed, "rim_speed", None)
    if row.min_torque is not None and torque < row.min_torque * (1.0 - SLACK):
        flags.add("oversized")
    if need.synchronous:
        if row.synchronous == "approx":
            flags.add("approx_synchronous")
        elif row.synchronous == "no" and row.synchronous_as_pair:
            flags.add("pair_needed")
        elif row.synchronous == "no":
            causes.add("synchronous")
    headroom = math.nan if row.max_torque is None else row.max_torque / torque
    return Candidate(
        row=row, causes=tuple(sorted(causes)), flags=() if causes else tuple(sorted(flags)), headroom=headroom
    )


# Why a type or size of joint is taken or not: each reason with its figure, its limit and where that comes from.


@dataclass(frozen=True, kw_only=True)
class Reason:
    """One reason."""

    code: str  # cause or condition, as in `Candidate`
    message: Text  # in a sentence, without its full stop
    value: float | None = None  # value, limit: in SI, where figures decide
    limit: float | None = None
    source: str = ""  # where the limit comes from


@dataclass(frozen=True, kw_only=True)
class SizeFit:
    """A size of the catalogue and what its maker's figures say of a need."""

    row: JointSize
    reasons: tuple[Reason, ...]  # why it is too small; none where it fits
    headroom: float  # largest torque over the torque needed; nan where the catalogue gives none
    life: float  # [s]: L10 of its bearings by its maker's formula; nan where its rating is not one of bearings

    @property
    def fits(self) -> bool:
        """Whether no figure of its maker is exceeded."""
        return not self.reasons


def joint_duty(
    drive: Drive, duty: Duty | None = None, *, joint: int | None = None, known: Catalogue | None = None
) -> JointDuty:
    """Return what the joints of a drive must do: the largest torque, joint angle and speed of one joint or of all.

    Parameters
    ----------
    drive : Drive
    duty : Duty, optional
        That of the drive by default.
    joint : int, optional
        Number of a joint; all of them by default.
    known : Catalogue, optional
        The shipped one when not given.

    Returns
    -------
    JointDuty
        Torque without the factor for shocks, which is its service factor.

    Raises
    ------
    InputError
        There is no torque or no speed; no such joint.

    See Also
    --------
    select_joint

    Examples
    --------
    >>> from cardan import Drive
    >>> from cardan.joints import joint_duty
    >>> from cardan.parts import Duty
    >>> found = joint_duty(Drive.from_angles([0.1, 0.3]), Duty(torque=100.0, speed=50.0, shock_factor=1.5))
    >>> print(f"{found.torque:.3f} {found.joint_angle} {found.service_factor}")
    104.675 0.3 1.5
    """
    rows = known or catalogue()
    whole = filled(drive if duty is None else replace(drive, duty=duty), rows)
    n = len(whole.joints)
    made = design(whole, known=rows)
    problems = [] if made.loaded else [Problem("duty.torque", _("missing; the choice depends on it"), "missing")]
    if made.top_speed is None:
        problems.append(Problem("duty.speed", _("missing; the choice depends on it"), "missing"))
    if joint is not None and not 1 <= joint <= n:
        problems.append(
            Problem("joint", _("there is no joint {number}; the joints are 1 to {last}").format(number=joint, last=n))
        )
    check(problems)
    own = list(range(n)) if joint is None else [joint - 1]
    stands = [made, *(one for _said, one in stood(made))]
    stands += [along(one, default_times(one.drive.movements)) for one in stands if one.drive.movements]
    torque = [_top(case.joint_torque[..., own]) for one in stands for case in one.loaded]
    joint_angle = [_top(case.joint_angle[..., own]) for one in stands for case in one.loaded]
    outers = [one.rating.outer for k, one in enumerate(whole.joints) if k in own and one.rating is not None]
    outer = max((one for one in outers if one is not None), default=None)
    used = whole.duty
    return JointDuty(
        torque=float(np.max(torque)),
        joint_angle=float(np.max(joint_angle)),
        speed=float(np.max(made.top_speed if made.top_speed is not None else 0.0)),
        synchronous=used.synchronous,
        service_factor=used.shock_factor,
        continuous=used.continuous,
        outer=outer,
        life=used.life,
        reliability=used.reliability,
    )


def over_time(need: JointDuty, drive: Drive, *, joint: int | None = None, known: Catalogue | None = None) -> JointDuty:
    """Return what the joints of a drive must do, or one of them, with what they carry in every part of the duty.

    The same as given where the duty says too little for that.
    """
    own = range(len(drive.joints)) if joint is None else [joint - 1]
    try:
        found = duty_loads(filled(drive, known or catalogue()))
    except InputError:
        return need
    return replace(need, loads=tuple(replace(one, loads=tuple(part.of(own) for part in one.loads)) for one in found))


def _top(values: Array) -> float:
    """Return the largest of values (k,), or of values over the instants of a movement (t, k)."""
    return float(np.max(tops(values.T) if values.ndim > 1 else values))


def reasons(candidate: Candidate, need: JointDuty) -> tuple[Reason, ...]:
    """Return why a type of joint is rejected, or under which conditions it is accepted.

    candidate: of `select_joint` for this need.

    >>> from cardan.answers.reader import USUAL
    >>> from cardan.joints import select_joint
    >>> from cardan.units import deg
    >>> need = JointDuty(torque=50.0, joint_angle=20 * deg, speed=10.0)
    >>> said = next(reasons(one, need)[0].message for one in select_joint(need) if one.row.id == "light")
    >>> said.told(USUAL)
    '50 N·m is more than its 12.5 N·m'
    """
    return tuple(_reason(code, candidate, need) for code in (*candidate.causes, *candidate.flags))


def _reason(code: str, candidate: Candidate, need: JointDuty) -> Reason:
    row, torque = candidate.row, need.torque * need.service_factor
    figures = {
        "torque": (torque, row.max_torque, "torque"),
        "angle": (need.joint_angle, row.max_joint_angle, "angle"),
        "n_alpha": (need.speed * need.joint_angle, row.max_speed_angle, "speed_angle"),
        "rim_speed": (0.5 * need.speed * (need.outer or math.nan), row.max_rim_speed, "speed"),
    }
    if code in figures:
        value, limit, dimension = figures[code]
        text = _("{value} is more than its {limit}")
        if code == "n_alpha":
            text = _("speed times angle n·α is {value}, more than its {limit}")
        if code == "rim_speed":
            text = _("its rim runs at {value}, faster than {limit}")
        said = say(text, value=_given(value, dimension), limit=_given(limit or math.nan, dimension))
        return Reason(code=code, message=said, value=value, limit=limit, source=row.source)
    if code == "oversized":
        said = say(_("made for {least} and more"), least=_given(row.min_torque or 0.0, "torque"))
        return Reason(code=code, message=said, value=torque, limit=row.min_torque, source=row.source)
    texts = {
        "synchronous": _("its output is not uniform, in a pair neither"),
        "pair_needed": _("uniform only as a pair with the right yoke angle"),
        "approx_synchronous": _("nearly uniform"),
        "unverified_torque": _("no largest torque given"),
        "unverified_angle": _("no largest joint angle given"),
        "unverified_rim_speed": _("limited in rim speed, no outer diameter given"),
    }
    return Reason(code=code, message=texts[code], source=row.source)


def fitting_sizes(need: JointDuty, *, known: Catalogue | None = None) -> tuple[SizeFit, ...]:
    """Return every size of the catalogue with what its maker's figures say, those that fit first, the smallest first.

    known: the shipped one when not given.
    Returns: only ratings are compared; whether a size lasts is for `cardan.size` and `cardan.life` to say.
    """
    found = []
    for row in (known or catalogue()).offered():
        limit = row.rating.max_torque if row.rating is not None else None
        room = math.nan if limit is None else limit / (need.torque * need.service_factor)
        lasts = _life(row, need)
        found.append(SizeFit(row=row, reasons=tuple(_size_reasons(row, need, lasts)), headroom=room, life=lasts))
    return tuple(
        sorted(
            found,
            key=lambda one: (not one.fits, need.life is not None and math.isnan(one.life), one.row.space, one.row.id),
        )
    )


def _life(row: JointSize, need: JointDuty) -> float:
    """Return the life of the bearings of a size by its maker's formula [s]; nan where it has no rating for it.

    In the worst pose where nobody says how long each lasts, as `cardan.life` has it.
    """
    rating = row.rating
    if rating is None or rating.torque is None or rating.convention not in CONVENTIONS or not need.speed:
        return math.nan
    lasts = partial(maker_life, rating.torque, convention=rating.convention)
    factor = float(reliability_factor(need.reliability))
    if not need.loads:
        angle, shock = need.joint_angle, need.service_factor
        return factor * float(lasts(need.torque, speed=need.speed, joint_angle=angle, shock=shock))
    parts: list[tuple[str, float | None, float, Array]] = []
    for one in need.loads:
        lives = [
            lasts(load.torque, speed=one.speed, joint_angle=load.joint_angle, shock=one.shocks) for load in one.loads
        ]
        table = mean_life(lives, one.when)
        parts += [(one.stand.pose, one.share(part), part.share, table[k]) for k, part in enumerate(one.parts)]
    unknown = any(share is None for _pose, share, _alone, _life in parts)
    found = []
    for pose in dict.fromkeys(pose for pose, *_rest in parts) if unknown else [None]:
        its = [one for one in parts if pose in (None, one[0])]
        shares = np.asarray([alone if share is None else share for _pose, share, alone, _life in its])
        found.append(np.min(combined_life(np.stack([life for *_rest, life in its], axis=-1), shares)))
    return factor * float(min(found))


def _size_reasons(row: JointSize, need: JointDuty, lasts: float) -> Iterator[Reason]:
    rating = row.rating
    if rating is None or rating.max_torque is None:
        yield Reason(code="unverified_torque", message=_("no largest torque given"), source=row.source)
    if need.life is not None and lasts < need.life:
        text = _("lasts {life}, less than the {asked} asked")
        asked, found = (Quantity(one, "time", digits=3, unit="h", trim=True) for one in (need.life, lasts))
        yield Reason(code="life", message=say(text, life=found, asked=asked), value=lasts, limit=need.life)
    if rating is None:
        return
    rim = 0.5 * need.speed * (rating.outer or math.nan)
    for code, value, limit, dimension in (
        ("torque", need.torque * need.service_factor, rating.max_torque, "torque"),
        ("angle", need.joint_angle, rating.max_joint_angle, "angle"),
        ("speed", need.speed, rating.max_speed, "angular_speed"),
        ("n_alpha", need.speed * need.joint_angle if need.continuous else 0.0, rating.speed_angle, "speed_angle"),
        ("rim_speed", rim, rating.rim_speed, "speed"),
    ):
        if limit is not None and value > limit * (1.0 + SLACK):
            text = _("{value} is more than its {limit}")
            said = say(text, value=_given(value, dimension), limit=_given(limit, dimension))
            yield Reason(code=code, message=said, value=value, limit=limit, source=row.source)


def _given(value: float, dimension: str) -> Quantity:
    """Return a figure as it is given, without zeros at its end."""
    return Quantity(value, dimension, trim=True)
