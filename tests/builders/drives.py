"""Hypothesis strategies for drives."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from hypothesis import strategies as st

from cardan import Drive
from cardan.units import deg
from tests.builders.vector_model import VectorModel

ANGLES = st.floats(-np.pi, np.pi, allow_subnormal=False)


@dataclass(frozen=True)
class Plan:
    """Numbers of a spatial chain, to be made into whatever a test compares."""

    joint_angles: tuple[float, ...]
    plane_twists: tuple[float, ...]
    yoke_angles: tuple[float, ...]
    start_phase: float

    @property
    def drive(self) -> Drive:
        return Drive.from_angles(
            self.joint_angles,
            plane_twists=self.plane_twists,
            yoke_angles=self.yoke_angles,
            start_phase=self.start_phase,
        )

    @property
    def vectors(self) -> VectorModel:
        return VectorModel.from_angles(self.joint_angles, self.plane_twists, self.yoke_angles, self.start_phase)


@st.composite
def plans(
    draw: st.DrawFn, *, least: int = 1, most: int = 6, joint_angle: float = 40 * deg, straight: bool = True
) -> Plan:
    """Draw a chain of ``least`` to ``most`` joints that bend up to ``joint_angle``; some may be straight."""
    n = draw(st.integers(least, most))
    joint_angles = st.floats(0.0 if straight else 0.5 * deg, joint_angle, allow_subnormal=False)
    return Plan(
        tuple(draw(joint_angles) for _ in range(n)),
        tuple(draw(ANGLES) for _ in range(n - 1)),
        tuple(draw(ANGLES) for _ in range(n - 1)),
        draw(ANGLES),
    )
