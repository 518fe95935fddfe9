"""The bodies of a drive put together: every shaft and cross with the track it moves along over one turn."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from cardan.answers.quantity import Text
from cardan.drive.drive import Drive
from cardan.drive.joints import Joint
from cardan.drive.joints.common.inner import Stance
from cardan.drive.joints.common.site import BACK, Side, Site
from cardan.drive.models.geometry import Geometry
from cardan.drive.models.wobble import Course
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.maths.kernel.meshes import Surface, joined, quaternions
from cardan.texts import _

from .sizes import ROOM, Sizes
from .solids import Arms


@dataclass(frozen=True, eq=False, kw_only=True)
class Track:
    """How a body moves over one turn: x = origin + turn * local."""

    origin: Array  # (3,) or (p, 3) [m]
    turn: Array  # (p, 4): quaternions x y z w


@dataclass(frozen=True, eq=False, kw_only=True)
class Solid:
    """A body as it looks, in the frame of its track."""

    part: str
    number: int  # number of the shaft or joint that it belongs to
    path: str  # where the file speaks of it
    text: Text  # what it is, in words
    track: int
    surface: Surface
    role: str  # role of its colour
    shade: float = 0.0  # share of white in its colour
    metal: bool = True


@dataclass(eq=False, kw_only=True)
class Build:
    """A drive while its bodies are put together."""

    drive: Drive
    place: Geometry  # where it lies; moved drives lie elsewhere than drawn
    drawn: Geometry  # where its file puts it: rigid parts keep the lengths they have there
    sizes: Sizes
    arms: Arms  # directions of its yokes at every frame, arrays (n, p, 3)
    lying: Course | None = None  # where its shafts lie, if any wobbles
    tracks: list[Track] = field(default_factory=list)  # the first stands still
    solids: list[Solid] = field(default_factory=list)
    # starts, ends, free, stations: tracks of the two ends of each shaft, of its free end, and of the stations by their
    # index
    starts: dict[int, int] = field(default_factory=dict)
    ends: dict[int, int] = field(default_factory=dict)
    free: dict[int, int] = field(default_factory=dict)
    stations: dict[int, int] = field(default_factory=dict)
    # [m]: radius of each shaft at its start and at its end
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
        text: Text,
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
        more = self.drive.joints[i].half_length(self.apart[i])
        return float(min(more + size.reach, self.room(i, driving=driving)))

    def stance(self, i: int) -> Stance:
        """Return where joint i, from 0, stands over a turn."""
        return Stance(
            centre=self.centre(i),
            before=self.axis(i + 1),
            after=self.axis(i + 2),
            normal=self.place.normal[i],
            joint_angle=float(self.place.joint_angle[i]),
            driving=self.arms.driving[i],
            driven=self.arms.driven[i],
            length=float(self.place.length[i + 1]),
        )

    def site(self, i: int) -> Site:
        """Return what the bodies of joint i, from 0, have to fit; its shafts are there already."""
        return Site(
            stage=self,
            number=i + 1,
            name=name_of(self.drive.joints[i], i),
            first=i == 0 and self.count > 1,
            stance=self.stance(i),
            size=self.sizes.joints[i],
            apart=self.apart[i],
            driving=self._side(i, driving=True),
            driven=self._side(i, driving=False),
            gravity=self.drive.settings.gravity,
        )

    def _side(self, i: int, *, driving: bool) -> Side:
        k = i + 1 if driving else i + 2
        return Side(
            driving=driving,
            number=k,
            track=self.ends[k] if driving else self.starts[k],
            turn=BACK if driving else None,
            reach=self.reach(i, driving=driving),
            body=self.profiles[k][1 if driving else 0],
            thickest=self.body_radius(k),
        )

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


def name_of(joint: Joint, i: int) -> str:
    """Return what a joint is called, in words."""
    number = _("joint {number}").format(number=i + 1)
    return f"{number}, {joint.name}" if joint.name else number
