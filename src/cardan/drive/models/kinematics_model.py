"""The kinematic half of a drive: what motion needs to know, as arrays."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.joints import Joint
from cardan.drive.joints.joint import PLACES
from cardan.errors import InputError, Problem, check
from cardan.maths.arrays import Array, namespace, unit_complex
from cardan.maths.curves.extremes import peaks
from cardan.maths.kernel import mobius
from cardan.texts import _

from .geometry import geometry, given_angles
from .wobble import wobbling


@dataclass(frozen=True, eq=False, kw_only=True)
class Chain:
    """Joint angles, plane twists and yoke angles of one drive of Hooke joints (n,) or of many (..., n).

    Joints of other kinds stand in it as the Hooke joints that turn alike, see `cardan.drive.models.kinematics_model`.
    """

    joint_angle: Array  # (..., n) [rad]: α_1 … α_n
    plane_twist: Array  # (..., n-1) [rad]: β_2 … β_n
    yoke_angle: Array  # (..., n-1) [rad]: γ_2 … γ_n, from the driving to the driven yoke of a shaft
    start_phase: Array  # (...) [rad]: ψ_1
    laws: Laws | None = None  # the joints as they are, where any is of another kind

    @property
    def joints(self) -> int:
        """Number of joints n."""
        return int(self.joint_angle.shape[-1])

    @property
    def turn_before(self) -> Array:
        """Angle μ_i added before joint i: μ_1 = ψ_1, μ_i = π/2 - γ_i - β_i; array (..., n) [rad]."""
        xp = namespace(self.joint_angle)
        first = xp.broadcast_to(self.start_phase, self.joint_angle.shape[:-1])[..., None]
        between = 0.5 * xp.pi - self.yoke_angle - self.plane_twist
        return xp.concat((first, xp.broadcast_to(between, (*self.joint_angle.shape[:-1], self.joints - 1))), axis=-1)

    def products(self) -> list[mobius.Pair]:
        """Return the Möbius pairs of the first 1 … n joints, each from the input shaft on."""
        return mobius.partial_products(self.joint_angle, self.turn_before)


def chain(drive: Drive) -> Chain:
    """Return the kinematic half of a drive of Hooke joints.

    Raises
    ------
    InputError
        A joint of another kind: who takes the Hooke joints that turn alike asks `turning_chain`.

    Examples
    --------
    >>> from cardan.units import deg
    >>> chain(Drive.from_angles([20 * deg, 20 * deg])).turn_before
    array([0.        , 1.57079633])
    """
    if mixed(drive.joints):
        refuse_kinds(drive, _("this question"))
    return given_chain(drive)


def turning_chain(drive: Drive) -> Chain:
    """Return the Hooke joints that turn like the joints of a drive, those of other kinds among them."""
    check(wobble_problems(drive))
    return turning(given_chain(drive), drive.joints)


def wobble_problems(drive: Drive) -> Iterator[Problem]:
    """Yield the problems of a question that takes the joints of a drive by Hooke joints, where a shaft wobbles."""
    text = _("its driven shaft wobbles, which the next joint feels: no chain of Hooke joints turns as this drive does")
    yield from (Problem(f"joints[{i}].kind", text, "unknown_kind") for i in wobbling(drive))


def turning(whole: Chain, joints: Sequence[Joint], *, near: bool = False) -> Chain:
    """Return the Hooke joints that turn like joints of any kind with the joint angles and planes of a chain.

    whole (..., n): bends and plane twists as they are.
    near: take a joint without a Möbius map by the nearest one: good enough for loads, not for motion.
    """
    if not mixed(joints):
        return whole
    joint_angle, twist, start, laws = alike(joints, whole.joint_angle, whole.plane_twist, near=near)
    start_phase = whole.start_phase + start
    return Chain(
        joint_angle=joint_angle, plane_twist=twist, yoke_angle=whole.yoke_angle, start_phase=start_phase, laws=laws
    )


def nearly_turning_chain(drive: Drive, question: str) -> Chain:
    """Return the Hooke joints that turn like the joints of a drive, but for angles that nobody can measure."""
    check(lawless(i, drive.joints[i], question) for i in far_laws(drive))
    return turning(given_chain(drive), drive.joints, near=True)


def far_laws(drive: Drive) -> tuple[int, ...]:
    """Return the indices of joints that turn otherwise than any Hooke joint, by more than anybody can measure."""
    if not unmapped(drive.joints):
        return ()
    angles = given_chain(drive).joint_angle.tolist()
    left = (left_over(joint, alpha) for joint, alpha in zip(drive.joints, angles, strict=True))
    return tuple(i for i, rest in enumerate(left) if rest > NEGLIGIBLE)


def as_hooke(drive: Drive) -> Drive:
    """Return a drive of Hooke joints that turns like a drive, itself where it has no other joints."""
    if not mixed(drive.joints):
        return drive
    whole = turning_chain(drive)
    return Drive.from_angles(
        np.asarray(whole.joint_angle).tolist(),
        plane_twists=np.asarray(whole.plane_twist).tolist(),
        yoke_angles=np.asarray(whole.yoke_angle).tolist(),
        start_phase=float(whole.start_phase),
        name=drive.name,
    )


def given_chain(drive: Drive) -> Chain:
    """Return bends, planes and yokes of a drive as they are, whatever the kinds of its joints."""
    if drive.form == "angles":
        joint_angle, twist = given_angles(drive)
        twist = twist[1:]
    else:
        place = geometry(drive)
        joint_angle, twist = place.joint_angle, place.plane_twist
    yoke_angle = np.asarray([shaft.yoke_angle for shaft in drive.shafts[1:-1]], dtype=float)
    start_phase = np.asarray(drive.input.start_phase, dtype=float)
    return Chain(joint_angle=joint_angle, plane_twist=twist, yoke_angle=yoke_angle, start_phase=start_phase)


# How joints of every kind turn: each that has a Möbius map as the Hooke joint that turns alike.
#
# The map of such a joint is tan θ' = κ tan θ. Where κ ≥ 1 it is that of a Hooke joint with cos α = 1/κ; where κ < 1
# that of one with cos α = κ whose driving yoke stands a quarter turn ahead. So a chain of mixed kinds is a chain of
# Hooke joints with other joint angles and plane twists, and all that is known of those holds for it.

NEGLIGIBLE = 1e-6  # what a joint may leave beside its nearest map [rad] to be taken by it: a fifth of a second of arc
STEP = 1e-5  # step [rad] of the joint angle in the central difference of `growth`; what it leaves is of order 1e-10


@dataclass(frozen=True, eq=False, kw_only=True)
class Laws:
    """The joints as they are, of a chain given by the Hooke joints that turn alike."""

    joint_angle: Array  # (..., n) [rad]: α_i, bends of the joints themselves
    steepness: Array  # (..., n): κ_i of tan θ' = κ tan θ
    growth: Array  # (..., n) [1/rad]: dκ_i/dα_i
    # (..., n) [rad]: how far the driving yoke of the Hooke joint stands ahead of the driving mark: 0 or π/2
    ahead: Array
    spring: Array  # (..., n) [N·m/rad]: their stiffness against the joint angle
    own: tuple[bool, ...]  # tuple of bool (n): which joints are of another kind


def mixed(joints: Sequence[Joint]) -> bool:
    """Tell whether any joint is of another kind than Hooke's."""
    return any(not joint.single_cross for joint in joints)


def unmapped(joints: Sequence[Joint]) -> tuple[int, ...]:
    """Return the indices of joints whose motion is no Möbius map, so that no Hooke joint turns alike."""
    return tuple(i for i, joint in enumerate(joints) if not joint.has_map)


def unlike_hooke(drive: Drive) -> bool:
    """Tell whether no chain of Hooke joints turns as a drive does.

    A joint has a law of its own, or a shaft wobbles so that the next joint feels it.
    """
    return bool(unmapped(drive.joints) or wobbling(drive))


def left_over(joint: Joint, joint_angle: float) -> float:
    """Return how far the turn of a joint is at most from that of its nearest Möbius map [rad]; 0 where it has a map.

    joint_angle [rad].
    """
    if joint.has_map:
        return 0.0
    theta, alpha = np.arange(PLACES) * (2.0 * np.pi / PLACES), np.asarray(joint_angle)
    near = joint.near_pair(alpha)

    def rest(angle: Array) -> Array:
        with np.errstate(invalid="ignore", divide="ignore"):
            angle_error = joint.deviation(angle, alpha)[0] - mobius.angle_error(near, unit_complex(2.0 * angle))
        return np.abs(angle_error)[None]

    return float(peaks(rest, theta, rest(theta))[1][0])


def refuse_kinds(drive: Drive, question: str, key: str = "cross") -> None:
    """Refuse a drive with joints that do not answer a question.

    question: what was asked, in words; key: the same as a key of `cardan.drive.joints.joint.REFUSALS`.
    """
    whys = ((i, joint, joint.refusal(key)) for i, joint in enumerate(drive.joints))
    check(kind_problem(i, joint, question, why) for i, joint, why in whys if why)


def kind_problem(i: int, joint: Joint, question: str, why: str) -> Problem:
    """Return the problem that a joint, counted from 0, does not answer a question, and why."""
    text = _("{question}: not answered for a joint of kind {kind}: {why}")
    return Problem(f"joints[{i}].kind", text.format(question=question, kind=joint.kind, why=why), "unknown_kind")


def lawless(i: int, joint: Joint, question: str) -> Problem:
    """Return the problem that a question needs a law that a joint does not have."""
    return kind_problem(i, joint, question, _("it turns by a law of its own, far from tan θ' = κ tan θ"))


def alike(
    joints: Sequence[Joint], joint_angle: Array, plane_twist: Array, *, near: bool = False
) -> tuple[Array, Array, Array, Laws]:
    """Return bends, plane twists and start of the Hooke joints that turn like joints of other kinds.

    joints: all with a Möbius map; joint_angle (..., n) [rad]: α_i; plane_twist (..., n-1) [rad]: β_2 … β_n.
    Returns joint_angle, plane_twist (..., n), (..., n-1) [rad]: of the Hooke joints, with the same yoke angles; start
    (...) [rad]: what to add to the start phase.
    The driving yoke of the Hooke joint stands λ ahead of the driving mark, and so does the driven one, which stands a
    quarter turn ahead of its own: β_i becomes β_i + (π/2 - q_{i-1}) + λ_{i-1} - λ_i, q = π/2 for a cross, else 0.
    """
    xp = namespace(joint_angle)
    columns: list[tuple[Array, ...]] = []
    for i, joint in enumerate(joints):
        alpha = joint_angle[..., i]
        here = _steepness(joint, alpha, i, near)
        tau = (here - 1.0) / (here + 1.0)
        if joint.single_cross:
            columns.append((alpha, here, xp.sin(alpha) * here * here, 0.0 * alpha))
            continue
        growth = (_steepness(joint, alpha + STEP, i, near) - _steepness(joint, alpha - STEP, i, near)) / (2.0 * STEP)
        ahead = xp.where(tau < 0.0, 0.5 * xp.pi, 0.0 * alpha)
        columns.append((2.0 * xp.atan(xp.sqrt(xp.abs(tau))), here, growth, ahead))
    equal, steepness, growths, aheads = (xp.stack(column, axis=-1) for column in zip(*columns, strict=True))
    quarter = xp.asarray([0.0 if joint.crossed else 0.5 * np.pi for joint in joints[:-1]], dtype=xp.float64)
    twist = plane_twist + quarter + aheads[..., :-1] - aheads[..., 1:]
    own = tuple(not joint.single_cross for joint in joints)
    spring = xp.asarray([joint.bend_spring for joint in joints], dtype=xp.float64) + 0.0 * joint_angle
    laws = Laws(joint_angle=joint_angle, steepness=steepness, growth=growths, ahead=aheads, spring=spring, own=own)
    return equal, twist, aheads[..., 0], laws


def as_given(chain: Chain, joints: Sequence[Joint]) -> Chain:
    """Return bends, planes and yokes of the joints themselves, from the chain of Hooke joints that turn alike."""
    laws = chain.laws
    if laws is None:
        return chain
    xp = namespace(chain.joint_angle)
    quarter = xp.asarray([0.0 if joint.crossed else 0.5 * np.pi for joint in joints[:-1]], dtype=xp.float64)
    return Chain(
        joint_angle=laws.joint_angle,
        plane_twist=chain.plane_twist - quarter - laws.ahead[..., :-1] + laws.ahead[..., 1:],
        yoke_angle=chain.yoke_angle,
        start_phase=chain.start_phase - laws.ahead[..., 0],
    )


def _steepness(joint: Joint, joint_angle: Array, i: int, near: bool) -> Array:
    """Return κ = (1 + τ)/(1 - τ), τ = -b/a, of a joint with a Möbius map."""
    xp = namespace(joint_angle)
    pair = joint.near_pair(joint_angle) if near else joint.pair(joint_angle)
    if pair is None:
        text = _("its kind, {kind}, turns by a law of its own; this question needs one of the form tan θ' = κ tan θ")
        raise InputError([Problem(f"joints[{i}].kind", text.format(kind=joint.kind), "unknown_kind")])
    a, b = (xp.real(part) for part in pair)
    found: Array = (a - b) / (a + b)
    _turns(joint, joint_angle, found, i)
    return found


def _turns(joint: Joint, joint_angle: Array, values: Array, i: int) -> None:
    """Refuse a joint that does not turn at its bend."""
    xp = namespace(joint_angle, values)
    stuck = ~xp.isfinite(values)
    if bool(xp.any(stuck)):
        most = float(xp.max(xp.where(stuck, joint_angle, 0.0)))
        raise InputError([Problem(f"joints[{i}].joint_angle", joint.stuck(most), "out_of_range")], where=stuck)
