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
    """Sizes of a joint [m].

    Attributes
    ----------
    radius : float
        From the joint centre to the middle of a bearing.
    ear : float
        Thickness of the ears of a yoke, along the journals.
    journal : float
        Diameter of the journals.
    cap : float
        Outer radius of a bearing cap.
    lug : float
        Outer radius of an ear.
    cavity : float
        From the joint centre to the bottom between the ears.
    given : bool
        Whether the file says how large the joint is.
    """

    radius: float
    ear: float
    journal: float
    cap: float
    lug: float
    cavity: float
    given: bool

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
    """One side of a joint, where its shaft begins.

    Attributes
    ----------
    driving : bool
    number : int
        Number of the shaft.
    track : int
        Track of its end; x runs along the power flow.
    turn : array (3, 3) or None
        Turns a body whose x runs away from the joint to the track.
    reach : float [m]
        From the joint centre to the end of the yoke's hub.
    body : float [m]
        Radius of the shaft there.
    thickest : float [m]
        Radius of the shaft where it is thickest.
    """

    driving: bool
    number: int
    track: int
    turn: Array | None
    reach: float
    body: float
    thickest: float

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
    """A joint while its bodies are put together.

    Attributes
    ----------
    stage : Stage
        What takes them.
    number : int
        Number of the joint, from 1.
    name : str
        What it is called, in words.
    first : bool
        Whether it is the first of several, whose wide side then belongs on the driving shaft.
    stance : Stance
        Where it stands over a turn, marks (p, 3).
    size : JointSize
    apart : float [m]
        From the joint centre to the middle of either of two crosses that there is room for.
    driving, driven : Side
    gravity : (float, float, float) [m/s²]
    """

    stage: Stage
    number: int
    name: str
    first: bool
    stance: Stance
    size: JointSize
    apart: float
    driving: Side
    driven: Side
    gravity: tuple[float, float, float]

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
