"""Which type of joint to take: every row of the catalogue accepted, accepted under conditions, or rejected, and why."""

from __future__ import annotations

import math
from dataclasses import dataclass

from cardan.catalogue import Catalogue, catalogue
from cardan.catalogue.rows import JointType
from cardan.errors import Problem, check
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
        Whether the output must turn evenly.
    service_factor : float
        Factor on the torque.
    continuous : bool
        Whether it runs for long at a time: then the product of speed and bend counts.
    outer : float [m], optional
        Outer diameter of the joint: then the speed of its rim counts.
    """

    torque: float
    joint_angle: float
    speed: float
    synchronous: bool = False
    service_factor: float = 1.0
    continuous: bool = True
    outer: float | None = None

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
        """How it stands: "ok", "conditional" or "rejected"."""
        return "rejected" if self.causes else "conditional" if self.flags else "ok"


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
        Those accepted, then those under the fewest conditions, then those with the most torque to spare, then the
        rejected ones.

    See Also
    --------
    joint_duty, size

    Examples
    --------
    >>> found = select_joint(JointDuty(torque=2.5e6, joint_angle=math.radians(9.0), speed=6.28))
    >>> sorted(one.row.id for one in found if one.state == "ok")
    ['mill_slipper', 'super_heavy']
    """
    rows = (known or catalogue()).rows(JointType).values()
    judged = [_judged(row, need) for row in rows if include_beyond or row.confidence != "beyond"]
    order = {"ok": 0, "conditional": 1, "rejected": 2}

    def rank(one: Candidate) -> tuple[float, ...]:
        spare = 0.0 if math.isnan(one.headroom) else -one.headroom
        return order[one.state], len(one.flags) if not one.causes else len(one.causes), spare

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
