"""What is checked: a drive in its duty, some of its fields varied over many drives."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from cardan.catalogue import Catalogue, catalogue
from cardan.drive.chain import Chain, chain
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.geometry import geometry, geometry_from_points
from cardan.drive.paths import place
from cardan.errors import refuse
from cardan.maths.arrays import Array, ArrayLike
from cardan.texts import _

_STEP = re.compile(r"([a-z_]+)((?:\[\d+\])*)$")


@dataclass(frozen=True, eq=False, kw_only=True)
class Design:
    """A drive in its duty, or many drives that differ in a few fields.

    Attributes
    ----------
    drive : Drive
        With grades and sizes filled in.
    duty : Duty
    known : Catalogue
        Its norms, types and sizes.
    varied : mapping of str to array (...)
        Path without unit, as ``joints[0].cross.span`` or ``duty.torque`` -> values in SI, in place of the drive's.
    """

    drive: Drive
    duty: Duty
    known: Catalogue = field(default_factory=catalogue)
    varied: Mapping[str, Array] = field(default_factory=dict)

    @cached_property
    def shape(self) -> tuple[int, ...]:
        """Leading axes: () for one drive."""
        return np.broadcast_shapes(*(np.shape(one) for one in self.varied.values())) if self.varied else ()

    def value(self, path: str) -> Any:
        """Return what stands at a path without unit: an array where it is varied, None where nothing stands.

        Examples
        --------
        >>> Design(drive=Drive.from_angles([0.1]), duty=Duty()).value("joints[0].bend")
        0.1
        """
        if path in self.varied:
            return self.varied[path]
        here: Any = {"duty": self.duty}.get(path.partition(".")[0], self.drive)
        for word in path.removeprefix("duty.").split(".") if here is self.duty else path.split("."):
            match = _STEP.fullmatch(word)
            assert match is not None, path
            if here is None:
                return None
            here = getattr(here, match[1])
            for k in re.findall(r"\d+", match[2]):
                here = here[int(k)] if here is not None and int(k) < len(here) else None
        return here

    def missing(self, *paths: str) -> tuple[str, ...]:
        """Return those of the paths at which nothing stands."""
        return tuple(path for path in paths if self.value(path) in (None, "") and path not in self.varied)

    @cached_property
    def chain(self) -> Chain:
        """Kinematic half of the drives."""
        base = chain(self.drive)
        moved = {path: values for path, values in self.varied.items() if _is_geometry(path)}
        if not moved:
            return base
        bend, twist = base.bend, base.plane_twist
        if self.drive.form == "points":
            points = np.broadcast_to(
                np.asarray(geometry(self.drive).points, dtype=float), (*self.shape, len(self.drive.joints) + 2, 3)
            ).copy()
            for path, values in moved.items():
                row = _row(path, len(self.drive.joints))
                if row is not None:
                    part = re.search(r"\[(\d)\]$", path.partition(".")[2])
                    points[..., row, int(part[1]) if part else slice(None)] = values
            place_of = geometry_from_points(points)
            bend, twist = place_of.bend, place_of.plane_twist
        return Chain(
            bend=self._over(bend, moved, r"joints\[(\d+)\]\.bend$", 0),
            plane_twist=self._over(twist, moved, r"joints\[(\d+)\]\.plane_twist$", 1),
            yoke_angle=self._over(base.yoke_angle, moved, r"shafts\[(\d+)\]\.yoke_angle$", 1),
            start_phase=np.broadcast_to(np.asarray(moved.get("input.start_phase", base.start_phase)), self.shape),
        )

    def _over(self, values: Array, moved: Mapping[str, Array], pattern: str, first: int) -> Array:
        """Return values (..., k) with the varied ones in their places."""
        whole = np.broadcast_to(values, (*self.shape, values.shape[-1])).copy()
        for path, new in moved.items():
            match = re.match(pattern, path)
            if match:
                whole[..., int(match[1]) - first] = new
        return whole

    @property
    def bend(self) -> Array:
        """Bend of every joint, array (..., n) [rad]."""
        return self.chain.bend


def _is_geometry(path: str) -> bool:
    return bool(re.match(r"(joints\[\d+\]\.(centre|bend|plane_twist)|shafts\[\d+\]\.yoke_angle|input|output)", path))


def _row(path: str, joints: int) -> int | None:
    if path.startswith("input.point"):
        return 0
    if path.startswith("output.point"):
        return joints + 1
    match = re.match(r"joints\[(\d+)\]\.centre", path)
    return int(match[1]) + 1 if match else None


def design(
    drive: Drive,
    duty: Duty | None = None,
    *,
    vary: Mapping[str, ArrayLike] | None = None,
    known: Catalogue | None = None,
) -> Design:
    """Return what is to be checked.

    Parameters
    ----------
    drive : Drive
    duty : Duty, optional
        The drive's own when not given.
    vary : mapping of str to array (...), optional
        Path with unit, as in the drive file: ``shafts[1].outer_mm`` -> values in that unit, over many drives.
    known : Catalogue, optional
        The shipped one when not given.

    Raises
    ------
    InputError
        A path that leads nowhere.

    Examples
    --------
    >>> many = design(Drive.from_angles([0.1, 0.2]), vary={"joints[0].bend_deg": [0.0, 10.0, 20.0]})
    >>> many.bend.shape
    (3, 2)
    """
    varied: dict[str, Array] = {}
    for path, values in (vary or {}).items():
        there = place(drive, path)
        bare = "".join(f"[{step}]" if isinstance(step, int) else f".{step}" for step in there.steps)
        given = np.asarray(values, dtype=float)
        if not np.all(np.isfinite(given)):
            raise refuse(path, _("not every value is finite"))
        varied[bare.removeprefix(".")] = given * there.factor
    return Design(drive=drive, duty=duty or drive.duty, known=known or catalogue(), varied=varied)
