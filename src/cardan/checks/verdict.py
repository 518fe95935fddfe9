"""What a check says: value, limit, how much of the limit is used, where the limit comes from, what moves it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from cardan.answers.quantity import Joined, Quantity, Text, say
from cardan.catalogue.rows import UNSURE
from cardan.maths.arrays import Array
from cardan.texts import _

from .design import Design

Sense: TypeAlias = Literal["at_most", "at_least", "within", "outside"]

AMBER = 0.9
"""Utilisation from which a check that passes is close to its limit."""

ROUNDING = 1e-9
"""A limit passed by less than this share of it is kept: rounding of figures that stand at their limit."""

BELOW = 1.0 - 2.0 * ROUNDING
"""Share of what a value must not even reach that it may be at most."""

State: TypeAlias = Literal["passed", "unconfirmed", "close", "failed", "not_run"]


@dataclass(frozen=True, kw_only=True, eq=False)
class Verdict:
    """Answer of one check on one drive or on many; leading axes (...) are the drives'.

    Attributes
    ----------
    check : str
        Name of the check in `CHECKS`; the check itself fills in what all its verdicts share.
    subject : str
        What was judged, as a path: ``joints[1]``, ``shafts[2]``; empty for the drive as a whole.
    title : str
        What was judged, in words; where a check says it, with a place for number and name of joint or shaft.
    value : float or array (...)
        In SI.
    limit : float, array (...) or (float, float)
        In SI; a pair where the value must lie within or outside a band.
    sense : "at_most", "at_least", "within" or "outside"
    dimension : str
        Key of `cardan.units.DIMENSIONS`, empty for a plain number.
    unit : str
        Unit that people read it in.
    source : Text
        Where limit and formula come from.
    confidence : str
        How sure the limit is, as of `catalogue.rows.Row`; empty where it is the user's own or follows from formulas.
        The check itself fills in the least sure row of the catalogue that the verdict rests on.
    provenance : tuple of str
        In words, what of the limit nothing confirms: how sure it is, and rows of the catalogue it rests on.
    rests : tuple of str
        Paths beside the design variables on which the limit rests.
    design_variables : tuple of str
        Paths of the drive file whose change moves the value.
    missing : tuple of str
        Paths that the check needs and the drive does not give; then there is no value.
    unfit : str
        Why the check does not fit a joint of this kind; then there is no value either.
    note : Text
        One sentence on what it means or assumes.
    advice : bool
        Whether it is a rule of thumb that does not fail the drive.
    kind : str
        The title without the number, the same for all joints or shafts.
    power : float
        Exponent of the torque in the utilisation; 0 where it does not depend on it.
    factor : float, optional
        By which factor the torque may grow, where no power tells it.
    """

    check: str = ""
    title: str = ""
    subject: str = ""
    value: Array | float = float("nan")
    limit: Array | float | tuple[float, float] = float("nan")
    sense: Sense = "at_most"
    dimension: str = ""
    unit: str = ""
    source: Text = ""
    confidence: str = ""
    provenance: tuple[str, ...] = ()
    rests: tuple[str, ...] = ()
    design_variables: tuple[str, ...] = ()
    missing: tuple[str, ...] = ()
    unfit: str = ""
    note: Text = ""
    advice: bool = False
    kind: str = ""
    power: float = 0.0
    factor: Array | float | None = None

    @property
    def number(self) -> int:
        """Number of the joint or shaft that was judged, from 1; 0 for the drive as a whole."""
        return int(self.subject.partition("[")[2].partition("]")[0]) + 1 if self.subject else 0

    @property
    def run(self) -> bool:
        """Whether the drive had what the check needs, and joints of the kind it judges."""
        return not self.missing and not self.unfit

    @property
    def utilisation(self) -> Array | float:
        """Share of the limit that is used, at most 1 exactly when the check passes; an unlimited life uses none."""
        return utilisation(self.value, self.limit, self.sense)

    @property
    def bound(self) -> float:
        """The limit of a single verdict, where that is no band."""
        if isinstance(self.limit, tuple):
            raise TypeError(f"the limit of {self.title} is a band")
        return float(self.limit)

    @property
    def passed(self) -> Array | bool:
        """Whether the value keeps the limit."""
        return self.utilisation <= 1.0

    @property
    def torque_factor(self) -> Array | float:
        """By which factor all torques of the duty may grow until all of the limit is used."""
        if self.power == 0.0 or not self.run:
            return float("inf")
        if self.factor is not None:
            return self.factor
        with np.errstate(divide="ignore"):
            found = np.asarray(self.utilisation, dtype=float) ** (-1.0 / self.power)
        return float(found) if found.ndim == 0 else found

    @property
    def sure(self) -> bool:
        """Whether all it rests on is confirmed, follows from formulas or is the user's own."""
        return self.confidence not in UNSURE

    @property
    def state(self) -> State:
        """State of a single verdict; one that is met by what nothing confirms is not passed."""
        if not self.run:
            return "not_run"
        used = float(np.max(self.utilisation))
        if used < AMBER:
            return "passed" if self.sure else "unconfirmed"
        return "close" if used <= 1.0 else "failed"

    @property
    def met(self) -> bool:
        """Whether the limit of a single verdict is kept, and not nearly used up."""
        return self.state in ("passed", "unconfirmed")


def utilisation(value: Array | float, limit: Array | float | tuple[float, float], sense: Sense) -> Array | float:
    """Return the share of a limit that is used.

    Parameters
    ----------
    value : float or array (...)
    limit : float, array (...) or (float, float)
        A pair (a, b) for "within" and "outside".
    sense : "at_most", "at_least", "within" or "outside"

    Returns
    -------
    float or array (...)
        At most: value/limit; at least: limit/value; within a…b: the larger of value/b and a/value; outside: the
        smaller of value/a and b/value. At most 1 exactly when the value keeps the limit, but for `ROUNDING`; what must
        be at least something uses all of it, and more, where nothing is left.

    Examples
    --------
    >>> utilisation(80.0, 100.0, "at_most"), utilisation(5000.0, 4000.0, "at_least")
    (0.8, 0.8)
    >>> utilisation(float("inf"), 4000.0, "at_least"), utilisation(3000.0, (1900.0, 2100.0), "outside")
    (0.0, 0.7)
    >>> utilisation(6.000000000000001, 6.0, "at_most")
    1.0
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        if sense == "at_most":
            used = np.divide(value, limit)
        elif sense == "at_least":
            used = np.where(np.asarray(value) > 0.0, np.divide(limit, value), np.inf)
        else:
            low, high = limit  # type: ignore[misc]
            above, below = np.divide(value, high), np.divide(low, value)
            used = (
                np.maximum(above, below)
                if sense == "within"
                else np.minimum(np.divide(value, low), np.divide(high, value))
            )
    used = np.where((used > 1.0) & (used <= 1.0 + ROUNDING), 1.0, used)
    return float(used) if np.ndim(used) == 0 else used


# What a verdict tells of the way it was reached: at which speed, and by which limit where a rule goes too far.


def turning(speed: float) -> Quantity:
    """Return a speed [rad/s] as people read it, in whole turns a minute.

    >>> from cardan.answers.reader import USUAL
    >>> from cardan.units import rpm
    >>> turning(1800 * rpm).told(USUAL)
    '1\u202f800 rpm'
    """
    return Quantity(speed, "angular_speed", decimals=0)


def at_top_speed(design: Design) -> Text:
    """Return at which speed one drive is judged where that is not the speed of its duty; else nothing.

    >>> from cardan import Drive
    >>> from cardan.answers.quantity import told
    >>> from cardan.answers.reader import USUAL
    >>> from cardan.parts import Duty
    >>> from cardan.units import rpm
    >>> duty = Duty(speed=1500 * rpm, speed_range=(500 * rpm, 1800 * rpm))
    >>> told(at_top_speed(Design(drive=Drive.from_angles([0.1]), duty=duty)), USUAL)
    'at 1\u202f800 rpm'
    """
    top, own = design.top_speed, design.duty.speed
    if top is None or np.ndim(top) or (own is not None and float(top) <= abs(own) * (1.0 + 1e-9)):
        return ""
    return say(_("at {speed}"), speed=turning(float(top)))


def as_drawn(design: Design) -> str:
    """Return that a drive that moves is judged as drawn, where its joints turn by laws of their own; else nothing."""
    return _("as drawn, not while the drive moves") if design.swing is not None and design.drive.movements else ""


def bendable(design: Design, allowed: Array) -> tuple[Array, str]:
    """Return the joint angle that a rule allows, no more than joints of such kinds can reach, and a word on it.

    allowed (...) [rad].
    """
    most = min(joint.steepest for joint in design.drive.joints)
    note = _("joints of this kind reach no larger angle") if np.all(allowed > most) else ""
    return np.minimum(allowed, most), note


def joined(*parts: Text) -> Text:
    """Return the parts of a note that say something.

    >>> joined("at speed", "", "while the drive moves").parts
    ['at speed', 'while the drive moves']
    >>> joined("", "while the drive moves")
    'while the drive moves'
    """
    said = [part for part in parts if part]
    return Joined(said, between="; ") if len(said) > 1 else said[0] if said else ""
