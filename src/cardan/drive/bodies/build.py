"""The bodies of a drive put together: every shaft and cross with the track it moves along over one turn."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.joints import Joint
from cardan.drive.models.geometry import Geometry
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.maths.kernel.meshes import Surface, joined, placed, quaternions
from cardan.texts import _
from cardan.units import mm

from .sizes import ROOM, JointSize, Sizes
from .solids import Arms

BACK = np.diag([-1.0, 1.0, -1.0])
"""Turns a yoke round, so that its hub lies against the power flow."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Track:
    """How a body moves over one turn: x = origin + turn * local.

    Attributes
    ----------
    origin : array (3,) or (p, 3) [m]
    turn : array (p, 4)
        Quaternions x y z w.
    """

    origin: Array
    turn: Array


@dataclass(frozen=True, eq=False, kw_only=True)
class Solid:
    """A body as it looks, in the frame of its track.

    Attributes
    ----------
    part : str
        What it is.
    number : int
        Number of the shaft or joint that it belongs to.
    path : str
        Where the file speaks of it.
    text : str
        What it is, in words.
    track : int
    surface : Surface
    role : str
        Role of its colour.
    shade : float
        Share of white in its colour.
    metal : bool
    """

    part: str
    number: int
    path: str
    text: str
    track: int
    surface: Surface
    role: str
    shade: float = 0.0
    metal: bool = True


@dataclass(eq=False, kw_only=True)
class Build:
    """A drive while its bodies are put together.

    Attributes
    ----------
    drive : Drive
    place : Geometry
        Where it lies; moved drives lie elsewhere than drawn.
    drawn : Geometry
        Where its file puts it: rigid parts keep the lengths they have there.
    sizes : Sizes
    arms : Arms
        Directions of its yokes at every frame, arrays (n, p, 3).
    tracks : list of Track
        The first stands still.
    solids : list of Solid
    starts, ends, free, stations : dict of int
        Tracks of the two ends of each shaft, of its free end, and of the stations by their index.
    profiles : dict of (float, float) [m]
        Radius of each shaft at its start and at its end.
    """

    drive: Drive
    place: Geometry
    drawn: Geometry
    sizes: Sizes
    arms: Arms
    tracks: list[Track] = field(default_factory=list)
    solids: list[Solid] = field(default_factory=list)
    starts: dict[int, int] = field(default_factory=dict)
    ends: dict[int, int] = field(default_factory=dict)
    free: dict[int, int] = field(default_factory=dict)
    stations: dict[int, int] = field(default_factory=dict)
    profiles: dict[int, tuple[float, float]] = field(default_factory=dict)

    @property
    def count(self) -> int:
        """Number of joints."""
        return len(self.drive.joints)

    @property
    def frames(self) -> int:
        """Number of places in a turn."""
        return int(self.arms.driving.shape[1])

    def centre(self, i: int) -> Array:
        """Return the centre of joint i, from 0."""
        found: Array = self.place.points[i + 1]
        return found

    def axis(self, k: int) -> Array:
        """Return the direction of shaft k, from 1."""
        found: Array = self.place.axis[k - 1]
        return found

    def track(self, origin: Array, *directions: Array) -> int:
        """Add a track whose x, y and z point to directions (p, 3), and return its number."""
        shape = (self.frames, 3)
        turn = quaternions(np.stack([np.broadcast_to(one, shape) for one in directions], axis=1))
        self.tracks.append(Track(origin=np.asarray(origin, dtype=float), turn=turn))
        return len(self.tracks) - 1

    def along(self, origin: Array, axis: Array, across: Array) -> int:
        """Add a track whose x points along an axis and y across it."""
        return self.track(origin, axis, across, frames.cross(np.broadcast_to(axis, across.shape), across))

    def twin(self, track: int) -> int:
        """Add a track like another one: of a part that may twist against it."""
        self.tracks.append(self.tracks[track])
        return len(self.tracks) - 1

    def add(
        self,
        part: str,
        number: int,
        path: str,
        text: str,
        track: int,
        *surfaces: Surface,
        role: str,
        shade: float = 0.0,
        metal: bool = True,
    ) -> None:
        """Add a body."""
        self.solids.append(
            Solid(
                part=part,
                number=number,
                path=path,
                text=text,
                track=track,
                surface=joined(*surfaces) if len(surfaces) > 1 else surfaces[0],
                role=role,
                shade=shade,
                metal=metal,
            )
        )

    def room(self, i: int, *, driving: bool) -> float:
        """Return how long a yoke of joint i can be at most [m]."""
        if (driving and i == 0) or (not driving and i == self.count - 1):
            return np.inf
        return ROOM * float(self.drawn.length[i if driving else i + 1])

    def reach(self, i: int, *, driving: bool) -> float:
        """Return from the centre of joint i to the end of a yoke's hub [m]."""
        size = self.sizes.joints[i]
        more = self.apart[i] if self.drive.joints[i].kind == "double_cardan" else 0.0
        return float(min(more + size.reach, self.room(i, driving=driving)))

    @cached_property
    def apart(self) -> tuple[float, ...]:
        """From the centre of each joint to the middle of either of two crosses that it may have [m]."""
        return tuple(
            min(1.02 * size.base, 0.5 * self.room(i, driving=True), 0.5 * self.room(i, driving=False))
            for i, size in enumerate(self.sizes.joints)
        )

    def body_radius(self, k: int) -> float:
        """Return the radius of shaft k, from 1, where it is thickest [m]."""
        return self.sizes.bodies[k - 1]

    def end_radius(self, k: int, *, driving: bool) -> float:
        """Return the radius of shaft k, from 1, where the hub of its driving or driven yoke ends [m]."""
        return self.profiles[k][1 if driving else 0]


def name_of(joint: Joint, i: int) -> str:
    """Return what a joint is called, in words."""
    number = _("joint {number}").format(number=i + 1)
    return f"{number}, {joint.name}" if joint.name else number


def length_text(*values: float) -> str:
    """Return lengths in millimetres as people write them."""
    return " × ".join(f"{value / mm:.4g}" for value in values)


def cross_text(joint: Joint, i: int, size: JointSize) -> str:
    """Return what to say of a cross."""
    if size.given:
        return _("cross of {joint}: span {span} mm, journals {journal} mm").format(
            joint=name_of(joint, i), span=length_text(2.0 * size.radius), journal=length_text(size.journal)
        )
    return _("cross of {joint}; the file gives no span, so its size is in proportion to the shafts").format(
        joint=name_of(joint, i)
    )


def forks(
    build: Build,
    i: int,
    size: JointSize,
    *,
    driving: bool,
    bore: bool = True,
    away: float = 0.0,
    part: str = "",
    tip: float = 0.0,
) -> None:
    """Add a yoke of joint i and its bearing caps.

    It swings ``away`` off the joint centre; ears without bores end at ``tip``, counted toward the hub.
    """
    from cardan.drive.shapes.yoke import caps, fork

    k = i + 1 if driving else i + 2
    track = build.ends[k] if driving else build.starts[k]
    reach = build.reach(i, driving=driving) - away
    cavity = min(size.cavity, 0.66 * reach)
    body = build.end_radius(k, driving=driving)
    made = fork(size.radius, size.ear, size.lug, size.cap if bore else 0.0, cavity, reach, body, tip)
    turn = BACK if driving else None
    shift = np.asarray([-away if driving else away, 0.0, 0.0])
    text = _("driving yoke of shaft {number}") if driving else _("driven yoke of shaft {number}")
    name = part or ("driving yoke" if driving else "driven yoke")
    path = f"joints[{i}]"
    build.add(name, k, path, text.format(number=k), track, placed(made, turn, shift), role=f"shaft {k}")
    if bore:
        cap = placed(caps(size.radius, size.ear, size.cap), turn, shift)
        build.add(
            "bearing cap",
            i + 1,
            path,
            _("bearings of joint {number}").format(number=i + 1),
            track,
            cap,
            role="cross",
            shade=0.35,
        )
