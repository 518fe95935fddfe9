"""All that follows from the couples of a drive's joints: forces, what supports hold, what the balances leave."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from cardan.drive.models.train import Train
from cardan.errors import refuse
from cardan.maths.arrays import Array, namespace
from cardan.maths.kernel import frames
from cardan.texts import _

from .cross_loads import JournalLoads, journal_loads
from .elastic import elastic, refuse_soft
from .kinetostatics import Couples, Stand
from .reactions import Frame, Held, Load, forces_of, frame, right_side, solved, thrusts, weights, whole_balance
from .redundancy import redundancy


@dataclass(frozen=True, eq=False, kw_only=True)
class Forces:
    """Torques, couples and forces of a drive over the input angle; leading axes are those of the drives.

    Attributes
    ----------
    angle : array (p,) [rad]
        Input angle φ_1 from the start position.
    speed, acceleration : arrays (..., n+1, p) [rad/s, rad/s²]
        ω_i and ε_i of every shaft; for ω_1 = 1 and without inertia when the drive does not say how fast it turns.
    shaft_torque : array (..., n+1, p) [N·m]
        τ_i, torque that must enter every shaft; that of shaft 1 drives the drive.
    output_torque : array (..., p) [N·m]
        Torque that resists the output.
    joint_torque : array (..., n, p) [N·m]
        T_i, part of the couple along the normal of each cross.
    driving_couple, driven_couple : arrays (..., n, p, 3) [N·m]
        Couple of the driving yoke on the cross, and of the cross on the driven yoke.
    secondary_couple : array (..., n+1, p, 3) [N·m]
        Couple across every shaft, which bends it in the planes of its yokes and which its supports must balance.
    driving_arm, driven_arm : arrays (..., n, p, 3)
        Directions of the arms of each cross.
    axis : array (..., n+1, p, 3)
        Directions of the shafts.
    joint_force : array (..., n, p, 3) [N] or None
        Force in each joint centre on the driven shaft, on the driving shaft the opposite; None without supports.
    reaction, support_couple : arrays (..., k, p, 3) [N, N·m] or None
        Force and couple of every support on its shaft.
    support_shaft : tuple of int
        Number of the shaft of every support.
    journals : JournalLoads
        Of each cross, axes (..., n, p); nan where the span is not known.
    spline_thrust : array (..., number of splines, p) [N]
        Friction thrust in every spline, positive where it pushes the two parts apart.
    loss : array (..., n, p) [W]
        Power lost in the journals of each joint.
    power_left : array (..., p)
        What the power balance leaves, over the largest power in it.
    force_left, moment_left : arrays (..., p) or None
        What the external forces and moments on the whole drive leave, over the largest of them.
    status : array of int (...)
        `Held`: whether the supports hold the drive just enough; what is held too much shares by stiffness.
    equations, unknowns : int
        Of the balance of all shafts.
    reverse : Forces or None
        The same with the splines sliding the other way, where they slide both ways and rub.
    assumed : tuple of str
        Paths of what the drive does not say and this answer assumes.
    """

    angle: Array
    speed: Array
    acceleration: Array
    shaft_torque: Array
    output_torque: Array
    joint_torque: Array
    driving_couple: Array
    driven_couple: Array
    secondary_couple: Array
    driving_arm: Array
    driven_arm: Array
    axis: Array
    joint_force: Array | None
    reaction: Array | None
    support_couple: Array | None
    support_shaft: tuple[int, ...]
    journals: JournalLoads
    spline_thrust: Array
    loss: Array
    power_left: Array
    force_left: Array | None
    moment_left: Array | None
    status: Array
    equations: int
    unknowns: int
    reverse: Forces | None = None
    assumed: tuple[str, ...] = ()

    @property
    def input_torque(self) -> Array:
        """Torque that drives the input shaft, array (..., p) [N·m]."""
        return self.shaft_torque[..., 0, :]

    @property
    def bending_couple(self) -> Array:
        """Size of the secondary couple of every shaft, array (..., n+1, p) [N·m]."""
        return frames.norm(self.secondary_couple)

    @property
    def support_axis(self) -> Array:
        """Direction of the shaft at every support, array (..., k, p, 3)."""
        xp = namespace(self.axis)
        return xp.stack([self.axis[..., number - 1, :, :] for number in self.support_shaft], axis=-3)

    @property
    def axial(self) -> Array:
        """Axial part of the reactions, positive along the power flow, array (..., k, p) [N]; needs supports."""
        return frames.dot(self._held, self.support_axis)

    @property
    def radial(self) -> Array:
        """Size of the radial part of the reactions, array (..., k, p) [N]; needs supports."""
        return frames.norm(self._held - self.axial[..., None] * self.support_axis)

    @property
    def _held(self) -> Array:
        if self.reaction is None:
            raise refuse("supports", _("missing; reactions need [[supports]] that hold the shafts"))
        return self.reaction


def forces_from(
    whole: Train,
    stand: Stand,
    points: Array,
    acceleration: Array | None,
    angle: Array,
    carried: tuple[Couples, Array],
    *,
    still: bool,
    field: str,
    sense: Array | None = None,
) -> Forces:
    """Return all forces of drives whose couples are known.

    whole (...): masses and supports; stand (..., p): how shafts and crosses stand and turn.
    points (..., p or 1, n+2, 3) [m]: B_0 … B_{n+1}.
    acceleration (p, n+2, 3) [m/s²]: of the points; None where they stand still.
    angle (p,) [rad]: φ_1 from the start position.
    carried (Couples, array (..., p) [N·m]): couples of the joints, and the torque that resists the output.
    still: whether no speed is known, so that inertia does not count; field: what an error about the supports names.
    sense (p, number of splines): sense of the friction thrust of each spline; that of the train when not given.
    """
    xp = namespace(points, angle)
    found, output = carried
    n = whole.joints
    shape = found.shaft_torque.shape[:-1]
    push = thrusts(whole, found, sense)
    joint_force = reaction = turn = force_left = moment_left = None
    status = xp.zeros(shape[:-1], dtype=xp.int64)
    equations = unknowns = 0
    carried_by: list[Array | None] = [None, None]
    if whole.bearings:
        held = frame(whole, stand, points)
        equations, unknowns = held.equations, held.unknowns
        loads = weights(whole, held, stand, acceleration)
        known = right_side(held, found.secondary, loads, push)
        amounts, status = _amounts(
            whole, held, known, field, lambda: elastic(whole, held, stand, found, loads, push, known)
        )
        joint_force, reaction, turn = forces_of(held, amounts)
        force_left, moment_left = whole_balance(whole, held, stand, found, loads, (reaction, turn), output)
        carried_by = [joint_force - _cross_pull(whole, loads, joint_force), joint_force]
    span = xp.asarray(whole.span)[..., None, :] if whole.span is not None else xp.full((1, n), xp.nan)
    journals = journal_loads(found.driving, found.driven, stand.driving_arm, stand.driven_arm, span, *carried_by)

    def turned(table: Array | None, width: int = 1) -> Array | None:
        """Put the axis of the positions behind that of the parts."""
        return None if table is None else xp.moveaxis(table, -1 - width, -width)

    flow = xp.where(found.flow > 0.0, found.flow, 1.0)
    axis = xp.broadcast_to(stand.axis, (*shape, n + 1, 3))
    return Forces(
        angle=angle,
        speed=turned(stand.speed),
        acceleration=turned(stand.acceleration),
        shaft_torque=turned(found.shaft_torque),
        output_torque=output,
        joint_torque=turned(found.joint_torque),
        driving_couple=turned(found.driving, 2),
        driven_couple=turned(found.driven, 2),
        secondary_couple=turned(found.secondary, 2),
        driving_arm=turned(stand.driving_arm, 2),
        driven_arm=turned(stand.driven_arm, 2),
        axis=turned(axis, 2),
        joint_force=turned(joint_force, 2),
        reaction=turned(reaction, 2),
        support_couple=turned(turn, 2),
        support_shaft=tuple(shaft + 1 for shaft, _holds in whole.bearings),
        journals=JournalLoads(load=turned(journals.load, 3), thrust=turned(journals.thrust, 2)),
        spline_thrust=turned(push),
        loss=turned(found.loss),
        power_left=xp.abs(found.power) / flow,
        force_left=force_left,
        moment_left=moment_left,
        status=status,
        equations=equations,
        unknowns=unknowns,
        assumed=whole.assumed + (("duty.speed",) if still else ()),
    )


def _cross_pull(whole: Train, loads: list[Load], like: Array) -> Array:
    """Return the weight of every cross, which its driving journals carry, array (..., p, n, 3)."""
    xp = namespace(like)
    if whole.cross_mass is None or whole.gravity is None:
        return xp.zeros_like(like)
    rows = [xp.broadcast_to(load.force, (*like.shape[:-2], 3)) for load in loads[-whole.joints :]]
    return xp.stack(rows, axis=-2)


def _amounts(whole: Train, held: Frame, known: Array, field: str, share: Callable[[], Array]) -> tuple[Array, Array]:
    """Return the unknowns, and whether each drive is held just enough; what is held too much shares by stiffness.

    A single drive that is loose, or whose forces follow from a stiffness not given, is refused.
    """
    xp = namespace(known)
    rows, columns = held.matrix.shape[-2:]
    fits = xp.zeros(known.shape[:-2], dtype=xp.bool)
    amounts = xp.full((*known.shape[:-1], columns), xp.nan)
    if rows == columns:
        amounts, regular = solved(held, known)
        fits = xp.all(regular, axis=-1)
        if bool(xp.all(fits)):
            return amounts, xp.zeros(fits.shape, dtype=xp.int64)
    if known.ndim == 2:
        many = redundancy(np.asarray(held.matrix), held.layout, field=field)
        refuse_soft(whole, many, field)
        return share() if many.degree else amounts, _status(fits, Held.INDETERMINATE)
    if columns > rows and whole.stiffness is not None:
        amounts = share()
    return amounts, _status(fits, Held.LOOSE if columns <= rows else Held.INDETERMINATE)


def _status(fits: Array, otherwise: Held) -> Array:
    xp = namespace(fits)
    return xp.astype(~fits, xp.int64) * int(otherwise)
