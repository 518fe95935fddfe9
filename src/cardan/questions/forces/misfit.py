"""What parts that do not fit do to each other: forces of assembly in a chain of shafts, as arrays."""

from __future__ import annotations

from dataclasses import dataclass

from cardan.maths.arrays import Array, namespace
from cardan.maths.kernel import frames
from cardan.maths.linear.redundant import least_energy

from .held import Actions, Layout, balance


@dataclass(frozen=True, eq=False, kw_only=True)
class Crosses:
    """Where the crosses stand, and how they turn with the input; the axes (...) are those of drives and positions."""

    driving: Array  # driving, driven (..., n, 3): arms u_i and v_{i+1}
    driven: Array  # (..., n, 3)
    driving_rate: Array  # driving_rate, driven_rate (..., n, 3) [1/rad]: their derivatives by φ_1
    driven_rate: Array  # (..., n, 3) [1/rad]


@dataclass(frozen=True, eq=False, kw_only=True)
class Misfit:
    """Forces that balance themselves; the axes (...) are those of drives and positions."""

    unknowns: Array  # (..., u) [N]: joint forces and what the bearings hold, in the order of the layout; couples in N·m
    energy: Array  # (...) [J]: what bending and pressing the parts together has stored
    torque: Array  # (...) [N·m]: torque the input needs beside all others to turn against that energy, without friction


def crosses(axis: Array, driving: Array, driven: Array) -> Crosses:
    """Return the arms of the crosses with their rates.

    axis (..., n+1, 3): directions e_i of the shafts; driving, driven (..., n, 3): arms u_i and v_{i+1}.
    An arm turns with its shaft: u_i' = (ω_i/ω_1) e_i×u_i; ω_{i+1}/ω_i = (e_i·e_{i+1})/|e_{i+1}×u_i|².
    """
    xp = namespace(axis, driving)
    whole = 0.0 * driving
    before, after = axis[..., :-1, :] + whole, axis[..., 1:, :] + whole
    square = frames.cross(after, driving)
    step = frames.dot(before, after) / frames.dot(square, square)
    ratio = [xp.ones_like(step[..., 0])]
    for i in range(step.shape[-1]):
        ratio.append(ratio[-1] * step[..., i])
    speed = xp.stack(ratio, axis=-1)[..., None]
    return Crosses(
        driving=driving,
        driven=driven,
        driving_rate=speed[..., :-1, :] * frames.cross(before, driving),
        driven_rate=speed[..., 1:, :] * frames.cross(after, driven),
    )


def joint_gap(axis: Array, normal: Array, arms: Crosses, error: Array) -> tuple[Array, Array]:
    """Return how far shaft i+1 is off its place in the centre of joint i, before anything gives way.

    axis (..., n+1, 3): directions e_i of the shafts; normal (..., n, 3): normals N_i of the joints' planes.
    arms: where the crosses stand; error (..., n, 5) [m]: s_1, a_1, a_2, a_3, a_4 of each joint.
    Returns gap (..., n, 3) [m]: s_1 z_1 + a_1 x_2 + a_2 x_3 + a_3 x_4 + a_4 x_1 of the loop of axes shaft, journals,
    journals, shaft: where the end of the parts of shaft i lies, seen from the end of shaft i+1; rate
    (..., n, 3) [m/rad]: its derivative by φ_1.

    The common normals of the ideal loop are x_2 = -e_i×u_i, x_3 = u_i×v_{i+1}, x_4 = e_{i+1}×v_{i+1}, x_1 = -N_i:
    the cross turns, x_1 stands still. With the errors free to slide this gap is what the pairs take up, -(s_2 z_2 +
    s_3 z_3 + s_4 z_4), Book (171). Errors of angles change it in the second order only.
    """
    u, v, du, dv = arms.driving, arms.driven, arms.driving_rate, arms.driven_rate
    whole = 0.0 * u
    before, after = axis[..., :-1, :] + whole, axis[..., 1:, :] + whole
    s1, a1, a2, a3, a4 = (error[..., k, None] for k in range(5))
    turning = -a1 * frames.cross(before, u) + a2 * frames.cross(u, v) + a3 * frames.cross(after, v)
    rate = -a1 * frames.cross(before, du) + a2 * (frames.cross(du, v) + frames.cross(u, dv))
    return s1 * before + turning - a4 * normal, rate + a3 * frames.cross(after, dv)


def sliding(layout: Layout, arms: Crosses, *, rate: bool = False) -> Array | None:
    """Return the conditions that no force acts along journals that slide, array (..., slides, u); None without any.

    arms: where the crosses stand; rate: the derivatives by φ_1 instead.
    """
    xp = namespace(arms.driving)
    count = len(layout.unknowns)
    pairs = (arms.driving_rate, arms.driven_rate) if rate else (arms.driving, arms.driven)
    rows = []
    for i, free in enumerate(layout.slides):
        for slides, arm in zip(free, pairs, strict=True):
            if slides:
                none = 0.0 * arm[..., 0, :1]
                before = xp.zeros(3 * i, dtype=xp.float64) + none
                after = xp.zeros(count - 3 * i - 3, dtype=xp.float64) + none
                rows.append(xp.concat((before, arm[..., i, :], after), axis=-1))
    return xp.stack(rows, axis=-2) if rows else None


def conditions(acting: Actions, layout: Layout, arms: Crosses) -> Array:
    """Return all conditions the unknowns meet: balance of the shafts, and no force along what slides."""
    xp = namespace(acting.force)
    rows, free = balance(acting), sliding(layout, arms)
    if free is None:
        return rows
    outer = free.shape[:-2]
    return xp.concat((xp.broadcast_to(rows, (*outer, *rows.shape[-2:])), free), axis=-2)


def misfit(
    acting: Actions, layout: Layout, arms: Crosses, compliance: Array, gap: tuple[Array, Array], housing: Array
) -> Misfit:
    """Return the forces that parts which do not fit put on each other.

    acting: the unknowns; its arrays have the axes of the drives, and one or none for the positions.
    arms: where the crosses stand, (..., n, 3); compliance (..., u, u) [m/N]: how bearings and shafts give way.
    gap (array (..., n, 3) [m], array (..., n, 3) [m/rad]): what is off in the joints, and its derivative by φ_1.
    housing (..., u) [m]: how far each bearing's housing is off in the direction of its unknown; 0 for the joints.
    The stationary value of L = d·X - ½ X·C X - y·A X is the stored energy, so the torque is dU/dφ_1 = X·d' - y·A'X:
    the gaps turn with the crosses, and so do the directions in which they slide.
    """
    xp = namespace(acting.force, arms.driving)
    off, rate = gap
    outer = off.shape[:-2]
    rest = xp.zeros((*outer, len(layout.unknowns) - 3 * layout.joints), dtype=xp.float64)

    def joined(joints: Array) -> Array:
        return xp.concat((xp.reshape(joints, (*outer, 3 * layout.joints)), rest), axis=-1)

    matrix = conditions(acting, layout, arms)
    given = joined(off) + housing
    load = xp.zeros(matrix.shape[-2], dtype=xp.float64)
    found, give = least_energy(matrix, load, compliance, given)
    torque = frames.dot(joined(rate), found)
    turned = sliding(layout, arms, rate=True)
    if turned is not None:
        along = xp.matmul(turned, found[..., None])[..., 0]
        torque = torque - frames.dot(give[..., -turned.shape[-2] :], along)
    return Misfit(unknowns=found, energy=0.5 * frames.dot(given, found), torque=torque)
