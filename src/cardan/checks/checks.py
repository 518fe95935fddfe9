"""All checks, and asking them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from cardan.answers.quantity import Text
from cardan.catalogue import Catalogue
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.errors import Problem
from cardan.errors import check as refuse_all
from cardan.maths.arrays import ArrayLike
from cardan.texts import _
from cardan.units import nearest

from .angles import (
    acceleration,
    angle_rule,
    angle_table,
    joint_angle,
    joint_angle_at_speed,
    output_error,
    speed_angle,
    speed_fluctuation,
    windup,
)
from .audit import answers_agree
from .check import Check
from .design import Design, design
from .moving import happening, instant, stood, stopped, worst_of_poses
from .practice import layout, length, lubrication, part_accuracy, plunge, pto_type, runout, spline_overlap
from .speeds import (
    balance,
    critical_speed,
    gap_closure,
    half_critical,
    max_speed,
    rim_speed,
    whirl_amplitude,
)
from .strength import (
    design_torque,
    ply_strength,
    shaft_life,
    spline_pressure,
    spline_strength,
    tube_buckling,
    tube_fatigue,
    tube_strength,
    twist,
)
from .strength.joints import (
    bearing_life,
    contact_pressure,
    inner_pressure,
    joint_torque,
    journal_strength,
    needle_static,
    rated_torque,
    small_oscillation,
    yoke_strength,
)
from .supports import seal_speed, support_life, support_speed, support_static
from .torsion import parametric_stability, start_fatigue, torque_reversal, torsional_resonance
from .verdict import Verdict

CHECKS: dict[str, Check] = {
    module.CHECK.name: module.CHECK
    for module in (
        joint_angle,
        acceleration,
        speed_fluctuation,
        output_error,
        bearing_life,
        rated_torque,
        joint_torque,
        max_speed,
        support_life,
        support_static,
        support_speed,
        seal_speed,
        speed_angle,
        rim_speed,
        journal_strength,
        yoke_strength,
        needle_static,
        tube_strength,
        tube_fatigue,
        shaft_life,
        tube_buckling,
        ply_strength,
        twist,
        windup,
        spline_strength,
        spline_pressure,
        spline_overlap,
        plunge,
        critical_speed,
        half_critical,
        whirl_amplitude,
        gap_closure,
        torsional_resonance,
        parametric_stability,
        torque_reversal,
        start_fatigue,
        balance,
        design_torque,
        part_accuracy,
        pto_type,
        lubrication,
        angle_rule,
        angle_table,
        joint_angle_at_speed,
        contact_pressure,
        inner_pressure,
        small_oscillation,
        runout,
        length,
        layout,
        answers_agree,
    )
}
"""Name of a check -> the check; its code is the file of the same name."""

FAR = 1.0 + 1e-6
"""Use of a limit from which a verdict fails whatever rounding and ties between poses do."""


def check(
    drive: Drive,
    duty: Duty | None = None,
    *,
    only: Sequence[str] = (),
    vary: Mapping[str, ArrayLike] | None = None,
    known: Catalogue | None = None,
) -> tuple[Verdict, ...]:
    """Return the verdicts of the checks on a drive.

    Parameters
    ----------
    drive : Drive
    duty : Duty, optional
        The drive's own when not given.
    only : sequence of str
        Names of checks; all when empty.
    vary : mapping of str to array (...), optional
        Path with unit -> values over many drives; the verdicts then hold arrays.
    known : Catalogue, optional
        The shipped one when not given.

    Returns
    -------
    tuple of Verdict
        A verdict that could not be reached names what is missing. A drive with poses is judged as drawn and in each
        pose, parts that must not break in starts and events too, and the worst counts.

    Raises
    ------
    InputError
        A check that is not known, a path that leads nowhere.

    See Also
    --------
    remedies, strength

    Examples
    --------
    >>> from dataclasses import replace
    >>> from cardan import Drive, check
    >>> from cardan.parts import Limits
    >>> drive = replace(Drive.from_angles([0.1, 0.5]), limits=Limits(joint_angle=0.4))
    >>> [verdict.state for verdict in check(drive, only=["joint_angle"])]
    ['passed', 'failed']
    """
    unknown = [name for name in only if name not in CHECKS]
    refuse_all(Problem("only", _unknown(name)) for name in unknown)
    return _worst(design(drive, duty, vary=vary, known=known), only)


def as_tried(drive: Drive, only: Sequence[str], *, known: Catalogue | None = None) -> tuple[Verdict, ...]:
    """Return the verdicts of some checks on one of many drives that are tried, see `Design.tried`."""
    return _worst(replace(design(drive, known=known), tried=True), only)


def _worst(subject: Design, only: Sequence[str]) -> tuple[Verdict, ...]:
    """Return the worst verdicts of a drive as drawn, in its poses, along its movements and in its events."""
    drawn, *others = _everywhere(subject, only)
    return worst_of_poses(drawn[1], [(said, verdicts) for said, verdicts, _time in others])


def passes(
    drive: Drive, name: str, title: str, *, known: Catalogue | None = None, last: dict[str, float] | None = None
) -> bool:
    """Return whether the verdict of a check that has a title is reached and passes, as `check` tells it.

    last [s]: title of a verdict -> instant of the movements at which it failed last. It is looked at first of all, and
    kept for the drive that is tried next.
    Poses and movements are followed only where it passes there and as drawn: quicker where many drives are tried.
    """
    subject = replace(design(drive, known=known), tried=True)
    failed_at = {} if last is None else last

    def fails(verdicts: Sequence[Verdict]) -> bool:
        return any(one.title == title and one.run and one.utilisation > FAR for one in verdicts)

    before = instant(subject, failed_at[title]) if title in failed_at and _moved([name]) else ()
    if any(fails(_judged(one, [name])) for one in before):
        return False
    found: list[tuple[Text, Sequence[Verdict]]] = []
    for said, verdicts, time in _everywhere(subject, [name]):
        if fails(verdicts):
            if time is not None:
                failed_at[title] = time
            return False
        found.append((said, verdicts))
    (_said, drawn), *poses = found
    worst = next((one for one in worst_of_poses(drawn, poses) if one.title == title and one.run), None)
    return worst is not None and bool(worst.passed)


def _moved(only: Sequence[str]) -> list[str]:
    """Return the checks that are looked at at the worst instants of movements."""
    return [name for name in only or CHECKS if CHECKS[name].gathers == "worst" and CHECKS[name].instants]


def _everywhere(subject: Design, only: Sequence[str]) -> Iterator[tuple[Text, Sequence[Verdict], float | None]]:
    """Yield verdicts as drawn, in poses, events and at the worst instants of movements, which it is and when [s]."""
    yield "", _judged(subject, only), None
    each = [name for name in only or CHECKS if CHECKS[name].gathers == "worst"]
    moved = _moved(only)
    lines = [name for name in moved if CHECKS[name].slides]
    loads = [name for name in moved if name not in lines]
    if each:
        yield from ((said, _judged(one, each), None) for said, one in stood(subject))
    if sudden := [name for name in each if CHECKS[name].events]:
        yield from ((said, _judged(one, sudden), None) for said, one in happening(subject))
    if loads:
        yield from stopped(subject, lambda one: _judged(one, loads))
    if lines:
        yield from stopped(subject, lambda one: _judged(one, lines), slides=True)


def _judged(subject: Design, only: Sequence[str]) -> tuple[Verdict, ...]:
    return tuple(
        verdict for name, one in CHECKS.items() if not only or name in only for verdict in one.verdicts(subject)
    )


def _unknown(name: str) -> str:
    near = nearest(name, CHECKS)
    text = _("unknown check {name}; the checks are {known}").format(name=repr(name), known=", ".join(CHECKS))
    return text + (_("; the nearest is {near}").format(near=near) if near else "")
