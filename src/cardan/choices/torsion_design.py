"""A drive that vibrates least in torsion and keeps the limits of its file, as drawn and within its tolerances."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields, replace

from cardan.catalogue import Catalogue
from cardan.checks.checks import check
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty, Limits
from cardan.errors import InputError
from cardan.questions.torsion.optimise import optimise
from cardan.questions.torsion.optimise.answer import answer, lacking, otherwise
from cardan.questions.torsion.optimise.optimise import Method, OptimisedTorsion
from cardan.questions.torsion.steady.torsion_response import Progress

__all__ = ["answer", "ask", "lacking", "optimise_torsion", "otherwise"]

JUDGED = {
    "speed_fluctuation": "speed_fluctuation",
    "output_error": "output_error",
    "joint_angle": "joint_angle",
    "twist": "twist",
    "shear_stress": "tube_strength",
    "spline_pressure": "spline_pressure",
    "spline_overlap": "spline_overlap",
    "whirl": "whirl_amplitude",
    "critical_speed": "critical_speed",
}
"""Limit of the drive file -> the check that judges it. Safeties, which have values where the file gives none, are no
limits of a search, nor are rows that nothing confirms: `check` tells them of the design that is found."""


def limits_used(drive: Drive, *, known: Catalogue | None = None) -> Callable[[Drive], float] | None:
    """Return what tells the largest share of a limit of the drive file that a drive uses; None without limits.

    >>> drive = replace(Drive.from_angles([0.1, 0.2]), limits=Limits(joint_angle=0.4))
    >>> used = limits_used(drive)
    >>> used(drive), limits_used(Drive.from_angles([0.1]))
    (0.5, None)
    """
    given = {one.name for one in fields(Limits) if getattr(drive.limits, one.name) is not None}
    names = [name for limit, name in JUDGED.items() if limit in given]
    if not names:
        return None

    def used(other: Drive) -> float:
        try:
            found = check(other, only=names, known=known)
        except InputError:
            return float("inf")
        return max((float(one.utilisation) for one in found if one.run and one.sure and not one.advice), default=0.0)

    return used


def optimise_torsion(
    drive: Drive,
    duty: Duty | None = None,
    free: Mapping[str, Sequence[float]] | None = None,
    *,
    speeds: tuple[float, float] | None = None,
    elements: Sequence[int] | None = None,
    method: Method | None = None,
    tolerances: Mapping[str, float | str] | None = None,
    known: Catalogue | None = None,
    progress: Progress | None = None,
) -> OptimisedTorsion:
    """Return the values of a drive with which its largest swing of a torque over a band of speeds is smallest.

    Parameters
    ----------
    drive : Drive
        With bodies or inertias and stiffnesses of its shafts, or `[[stations]]`, and some damping. The best design
        keeps its `[limits]` where any design does.
    duty : Duty, optional
        What it does; that of the drive by default.
    free : mapping of str to (low, high) or (low, high, step), optional
        Path -> range in the unit of the path, as ``{"shafts[1].yoke_angle_deg": (-90, 90)}``; with a step only every
        such value from the lowest can be made. By default the yoke angles that are not fixed, in the steps of their
        splines.
    speeds : (float, float), optional [rad/s]
        Band of input speeds; that of the duty by default, else its speed alone.
    elements : sequence of int, optional
        Elements of the drive whose torque is judged, from 0; all by default.
    method : Evolution or Grid, optional
        How to search everywhere; differential evolution by default.
    tolerances : mapping of str to float or str, optional
        Path -> how far its value may be off to either side as made, in the unit of the path or as a share ``"5%"``. The
        worst within them counts, and the limits hold there.
    known : Catalogue, optional
        By which limits are judged; the shipped one when not given.
    progress : function, optional
        Told the share done; when it answers "stop" the best so far is returned as cancelled.

    Returns
    -------
    OptimisedTorsion

    Raises
    ------
    InputError
        What the model misses, each with the key to add; no band of speeds; a path that leads to no number, a range or a
        tolerance that is none, a grid of too many designs.

    See Also
    --------
    absorber, torsion_response

    Notes
    -----
    See `cardan.questions.torsion.optimise.optimise.optimise_torsion`, which searches; limits are those of `JUDGED`.

    Examples
    --------
    >>> from dataclasses import replace
    >>> from cardan import Drive, optimise_torsion
    >>> from cardan.methods import Grid
    >>> from cardan.parts import Duty, Shaft, Station
    >>> tube = Shaft(number=2, stiffness=5000.0, damping=2.0, inertia=0.01, yoke_angle=0.6)
    >>> drive = replace(Drive.from_angles([0.25, 0.25]), shafts=(tube,),
    ...     stations=(Station(shaft=3, inertia=0.8),), duty=Duty(torque=60.0, speed_range=(20.0, 60.0)))
    >>> yoke, spring = "shafts[1].yoke_angle_deg", "shafts[1].stiffness_Nm_per_rad"
    >>> found = optimise_torsion(drive, free={yoke: (-60, 60)}, method=Grid(points=5), tolerances={spring: "10%"})
    >>> print(found.worst_after.torque < 0.1 * found.worst_before.torque)
    True
    """
    whole = drive if duty is None else replace(drive, duty=duty)
    return optimise.optimise_torsion(
        whole,
        free=free,
        speeds=speeds,
        elements=elements,
        method=method,
        tolerances=tolerances,
        used=limits_used(whole, known=known),
        progress=progress,
    )


def ask(drive: Drive, *, known: Catalogue | None = None, progress: Progress | None = None) -> OptimisedTorsion | None:
    """Return the yoke angles with the least torsional vibration; None where no yoke may be turned.

    drive: with what `optimise_torsion` needs; its yokes that are not fixed may turn, within its limits.
    progress: told the share done; when it answers "stop" the best so far is returned.
    """
    if all(shaft.yoke_fixed for shaft in drive.shafts[1:-1]):
        return None
    return optimise_torsion(drive, known=known, progress=progress)
