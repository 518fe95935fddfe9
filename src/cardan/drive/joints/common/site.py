"""Where the bodies of a joint are put together: what they have to fit, and what takes them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from cardan.answers.quantity import Text
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.maths.kernel.meshes import Surface, placed

from .stance import Stance

BACK = np.diag([-1.0, 1.0, -1.0])
"""Turns a yoke round, so that its hub lies against the power flow."""


@dataclass(frozen=True, kw_only=True, slots=True)
class JointSize:
    """Sizes of a joint [m]."""

    radius: float  # from the joint centre to the middle of a bearing
    ear: float  # thickness of the ears of a yoke, along the journals
    journal: float  # diameter of the journals
    cap: float  # outer radius of a bearing cap
    lug: float  # outer radius of an ear
    cavity: float  # from the joint centre to the bottom between the ears
    given: bool  # whether the file says how large the joint is

    @property
    def base(self) -> float:
        """From the joint centre to where the hub of a yoke begins [m]."""
        return self.cavity + 0.4 * self.radius

    @property
    def reach(self) -> float:
        """From the joint centre to the end of a yoke's hub [m]."""
        return self.base + 0.35 * self.radius

    @property
    def outer(self) -> float:
        """Radius that the joint needs when it turns straight [m]."""
        return self.radius + 0.5 * self.ear + 0.04 * self.radius


class Stage(Protocol):
    """What takes tracks and bodies."""

    def track(self, origin: Array, *directions: Array) -> int:
        """Add a track whose x, y and z point to directions (p, 3), and return its number."""

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
        """Add a body, whose surface is told in the frame of its track."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Side:
    """One side of a joint, where its shaft begins."""

    driving: bool
    number: int  # number of the shaft
    track: int  # track of its end; x runs along the power flow
    turn: Array | None  # (3, 3): turns a body whose x runs away from the joint to the track
    reach: float  # [m]: from the joint centre to the end of the yoke's hub
    body: float  # [m]: radius of the shaft there
    thickest: float  # [m]: radius of the shaft where it is thickest

    @property
    def role(self) -> str:
        """Role of the colour of what belongs to the shaft."""
        return f"shaft {self.number}"

    @property
    def yoke(self) -> str:
        """What its yoke is called among the parts."""
        return "driving yoke" if self.driving else "driven yoke"


@dataclass(frozen=True, eq=False, kw_only=True)
class Site:
    """A joint while its bodies are put together."""

    stage: Stage  # what takes them
    number: int  # number of the joint, from 1
    name: str  # what it is called, in words
    first: bool  # whether it is the first of several, whose wide side then belongs on the driving shaft
    stance: Stance  # where it stands over a turn, marks (p, 3)
    size: JointSize
    apart: float  # [m]: from the joint centre to the middle of either of two crosses that there is room for
    driving: Side
    driven: Side
    gravity: tuple[float, float, float]  # [m/s²]

    @property
    def path(self) -> str:
        """Where the file speaks of the joint."""
        return f"joints[{self.number - 1}]"

    @property
    def sides(self) -> tuple[Side, Side]:
        """The driving side and the driven one."""
        return self.driving, self.driven

    def along(self, origin: Array, axis: Array, across: Array) -> int:
        """Add a track whose x points along an axis and y across it."""
        return self.stage.track(origin, axis, across, frames.cross(np.broadcast_to(axis, across.shape), across))

    def said(self, text: str) -> str:
        """Return a text in which {joint} stands for what the joint is called."""
        return text.format(joint=self.name)

    def add(
        self,
        part: str,
        text: Text,
        track: int,
        *surfaces: Surface,
        role: str = "cross",
        shade: float = 0.0,
        metal: bool = True,
    ) -> None:
        """Add a body of the joint itself."""
        self.stage.add(part, self.number, self.path, text, track, *surfaces, role=role, shade=shade, metal=metal)

    def add_to(self, side: Side, part: str, text: Text, surface: Surface) -> None:
        """Add a body of a shaft, whose x runs away from the joint."""
        shape = placed(surface, side.turn)
        self.stage.add(part, side.number, self.path, text, side.track, shape, role=side.role)
