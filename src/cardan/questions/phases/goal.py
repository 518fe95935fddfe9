"""What to choose among yoke settings that leave the same speed fluctuation."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from cardan.drive.models.chain import Chain
from cardan.maths.arrays import Array, namespace
from cardan.questions.motion.equivalence import equivalent_joint

from .setting import with_yokes, wrapped


@dataclass(frozen=True, eq=False, kw_only=True)
class Choice:
    """What a goal may look at."""

    chain: Chain  # the drive
    as_built: Array  # (n-1,) [rad]: present yoke angles
    weight: Array  # (n-1,): weights of shafts 2 … n


@dataclass(frozen=True, kw_only=True)
class LeastIntermediate:
    """Least speed fluctuation of the intermediate shafts, Σ w δ over shafts 2 … n.

    Parameters
    ----------
    weights : tuple of float, optional
        Weights of shafts 2 … n; those of the drive's shafts by default.
    """

    blurs: ClassVar[tuple[float, ...]] = (1e-3, 1e-5, 1e-7)
    weights: tuple[float, ...] | None = None

    def cost(self, choice: Choice, yoke_angle: Array, *, blur: float = 0.0) -> Array:
        """Return the weighted sum for sets of yoke angles (..., n-1), array (...).

        ``blur`` rounds the corners that δ has where it vanishes.
        """
        xp = namespace(yoke_angle)
        uneven = equivalent_joint(with_yokes(choice.chain, yoke_angle)).shaft_speed_fluctuation[..., :-1]
        weight = choice.weight if self.weights is None else xp.asarray(self.weights, dtype=xp.float64)
        return xp.sum(weight * xp.sqrt(uneven * uneven + blur * blur), axis=-1)


@dataclass(frozen=True, kw_only=True)
class NearestYokes:
    """Smallest change of the present yoke angles, Σ w (turn)² [rad²] over shafts 2 … n.

    Parameters
    ----------
    weights : tuple of float, optional
        Weights of shafts 2 … n; equal by default.
    """

    blurs: ClassVar[tuple[float, ...]] = (0.0,)
    weights: tuple[float, ...] | None = None

    def cost(self, choice: Choice, yoke_angle: Array, *, blur: float = 0.0) -> Array:
        """Return the weighted sum of squares for sets of yoke angles (..., n-1), array (...)."""
        xp = namespace(yoke_angle)
        turn = wrapped(yoke_angle - choice.as_built)
        square = turn * turn
        return xp.sum(square if self.weights is None else square * xp.asarray(self.weights, dtype=xp.float64), axis=-1)


Goal = LeastIntermediate | NearestYokes
"""What has a method ``cost(choice, yoke_angle, *, blur)``, and the blurs with which a search follows it in turn."""

SYNCHRONOUS = LeastIntermediate()
NEAREST = NearestYokes()
