"""What the four journals of each cross carry."""

from __future__ import annotations

from dataclasses import dataclass

from cardan.maths.arrays import Array, namespace
from cardan.maths.kernel import frames

SIDES = (1.0, -1.0)
"""Journals of an arm: on its positive end, on its negative end."""


@dataclass(frozen=True, eq=False, kw_only=True)
class JournalLoads:
    """Loads of the journals of crosses; leading axes (...) are those of drives, joints and positions."""

    # (..., 4, 3) [N]: force across each journal: on the cross at +u and -u, on the driven yoke at +v and -v
    load: Array
    # (..., 2) [N]: force along u and along v that one of the two journals of the arm, or both together, pass on
    thrust: Array

    @property
    def size(self) -> Array:
        """Size of the force across each journal, array (..., 4) [N]."""
        return frames.norm(self.load)


def journal_loads(
    driving: Array,
    driven: Array,
    driving_arm: Array,
    driven_arm: Array,
    span: Array,
    driving_force: Array | None = None,
    driven_force: Array | None = None,
) -> JournalLoads:
    """Return the loads of the journals.

    driving, driven (..., 3) [N·m]: K⁻, couple of the driving yoke on the cross; K⁺, of the cross on the driven yoke.
    driving_arm, driven_arm (..., 3): u and v; span (...) [m]: d, between the middles of opposite bearings.
    driving_force, driven_force (..., 3) [N]: force of the driving yoke on the cross, and of the cross on the driven
    yoke, in the joint centre; none when not given.
    R = ±(K×u)/d + ½[F - (F·u)u] at ±(d/2) u, the same with v, Book (101)-(105); thrust F·u and F·v, Book (109).
    """
    xp = namespace(driving, driving_arm, span)
    rows, thrusts = [], []
    for couple, arm, force in ((driving, driving_arm, driving_force), (driven, driven_arm, driven_force)):
        turn = frames.cross(couple, arm) / span[..., None]
        pull = 0.0 * turn if force is None else force + 0.0 * turn
        along = frames.dot(pull, arm)
        half = 0.5 * (pull - along[..., None] * arm)
        rows += [side * turn + half for side in SIDES]
        thrusts.append(along)
    return JournalLoads(load=xp.stack(rows, axis=-2), thrust=xp.stack(thrusts, axis=-1))
