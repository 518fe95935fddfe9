"""Why a type or size of joint is taken or not: each reason with its figure, its limit and where that comes from."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from cardan.answers.quantity import Quantity, Text, say
from cardan.catalogue import Catalogue, catalogue, filled
from cardan.catalogue.rows import JointSize
from cardan.checks import design
from cardan.checks.moving import stood, stopped
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.errors import Problem, check
from cardan.texts import _

from .selection import SLACK, Candidate, JointDuty


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

    @property
    def fits(self) -> bool:
        """Whether no figure of its maker is exceeded."""
        return not self.reasons


def joint_duty(
    drive: Drive, duty: Duty | None = None, *, joint: int | None = None, known: Catalogue | None = None
) -> JointDuty:
    """Return what the joints of a drive must do: the largest torque, bend and speed of one joint or of all of them.

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
    stands = [made, *(one for _said, one in (*stood(made), *stopped(made)))]
    torque = [case.joint_torque[own] for one in stands for case in one.loaded]
    joint_angle = [case.joint_angle[own] for one in stands for case in one.loaded]
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
    )


def reasons(candidate: Candidate, need: JointDuty) -> tuple[Reason, ...]:
    """Return why a type of joint is rejected, or under which conditions it is accepted.

    candidate: of `select_joint` for this need.

    >>> from cardan.answers.reader import USUAL
    >>> from cardan.choices.selection import select_joint
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
    rows = (known or catalogue()).rows(JointSize).values()
    found = []
    for row in rows:
        limit = row.rating.max_torque if row.rating is not None else None
        room = math.nan if limit is None else limit / (need.torque * need.service_factor)
        found.append(SizeFit(row=row, reasons=tuple(_size_reasons(row, need)), headroom=room))
    return tuple(sorted(found, key=lambda one: (not one.fits, _outer(one.row), one.row.id)))


def _size_reasons(row: JointSize, need: JointDuty) -> Iterator[Reason]:
    rating = row.rating
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


def _outer(row: JointSize) -> float:
    return math.inf if row.rating is None or row.rating.outer is None else row.rating.outer


def _given(value: float, dimension: str) -> Quantity:
    """Return a figure as it is given, without zeros at its end."""
    return Quantity(value, dimension, trim=True)
