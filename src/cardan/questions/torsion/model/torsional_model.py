"""Torsional model of a drive: stations with inertia, elements with stiffness between them, joints that bind them.

Every shaft carries stations along the power flow; elements join stations. The last station of a shaft is the driving
yoke of the joint behind it, the first of the next shaft its driven yoke. A driven yoke turns by the law of its joint
from its driving yoke; every other station has a coordinate of its own. Angles are turns about the own shaft axis, zero
in the unloaded start position, positive with the rotation.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from cardan.errors import Problem, check
from cardan.maths.arrays import Array, ArrayLike
from cardan.texts import _

from .inputs import InputMotion, Law


@dataclass(frozen=True, kw_only=True)
class Torque:
    """A torque on a station: station number from 0 in station order, and its law; positive with the rotation."""

    station: int
    law: Law


@dataclass(frozen=True, kw_only=True, eq=False)
class TorsionalModel:
    """Stations and elements of one drive or of many that are built alike; leading axes (...) are the drives'."""

    inertia: Array  # (..., N) [kg m²]: J of every station, in the order of the power flow
    # for a driven yoke the station of its driving yoke and the joint between them, both from 0; None for a station that
    # has a coordinate of its own. A driving yoke stands before its driven yoke.
    driven: tuple[tuple[int, int] | None, ...]
    # stations A and B that each element joins; its torque is positive when it carries power from A to B
    elements: tuple[tuple[int, int], ...]
    # stiffness, damping, backlash (..., E) [N·m/rad, N·m·s/rad, rad]: of every element; backlash is the whole play, the
    # damper acts in contact only
    stiffness: Array
    damping: Array  # (..., E) [N·m·s/rad]
    backlash: Array  # (..., E) [rad]
    joint_angle: Array  # joint_angle, phase (..., n) [rad]: α and ψ of every joint: F_out = T(F_in + ψ; α) - T(ψ; α)
    phase: Array  # (..., n) [rad]
    ground_damping: Array  # (..., N) [N·m·s/rad]
    loss_factor: Array  # (..., E): structural damping η, in the frequency domain only
    torques: tuple[Torque, ...] = ()
    # (...) [rad/s]: speed that is forced on the first station; None where the drive is free and torques turn it
    input_speed: Array | None = None
    # motion that is forced on the first station instead, where its speed changes
    input_motion: InputMotion | None = None
    rest: Array | None = None  # (..., E) [rad]: twist of every element at which it carries nothing; 0 where not given
    # (..., 2Kn) [rad]: what joints turn beside T by laws of their own, T(θ) + Re Σ c_k e^(ikθ): Re and Im of c_0 …
    # c_(K-1) of each, see `flat_sums`; None where all turn by T
    sums: Array | None = None
    # pendulums with their own angle, in time: station of the pivot, station of the pendulum; the inertia of the first
    # holds its mass at the pivot, m R², that of the second is m l²
    hinges: tuple[tuple[int, int], ...] = ()
    coupling: Array | None = None  # (..., P) [kg m²]: m R l of every hinge
    # of every element, in time: twists [rad] and torques [N·m] of a spring whose stiffness changes, beside the others
    tables: tuple[tuple[tuple[float, ...], tuple[float, ...]] | None, ...] = ()
    friction: Array | None = None  # friction, creep (..., E) [N·m, rad/s]: dry friction, and the band about rest
    creep: Array | None = None
    # (..., E) [N·m·s/rad]: what small disturbances of steady running meet instead of the damping, as structural damping
    # goes with the frequency; None where it is the same
    disturbed_damping: Array | None = None
    shaft: tuple[int, ...] = ()  # shaft of every station from 0
    names: tuple[str, ...] = ()  # of the stations, for tables and pictures

    @cached_property
    def coordinate(self) -> tuple[int, ...]:
        """Coordinate that turns each station."""
        found: list[int] = []
        count = 0
        for source in self.driven:
            found.append(count if source is None else found[source[0]])
            count += source is None
        return tuple(found)

    @cached_property
    def owner(self) -> tuple[int, ...]:
        """Station whose angle is each coordinate."""
        return tuple(k for k, source in enumerate(self.driven) if source is None)

    @property
    def own_laws(self) -> Array | None:
        """Sums c_k of every joint, complex (..., K, n) [rad], see `sums`; None where all turn by T."""
        if self.sums is None:
            return None
        joints = self.joint_angle.shape[-1]
        parts = self.sums.reshape(*self.sums.shape[:-1], self.sums.shape[-1] // (2 * joints), 2, joints)
        return np.asarray(parts[..., 0, :] + 1j * parts[..., 1, :])

    @property
    def special(self) -> bool:
        """Whether elements have tables or dry friction."""
        return bool(self.tables) or self.friction is not None

    @property
    def rubs(self) -> bool:
        """Whether elements have dry friction."""
        return self.friction is not None and bool(np.any(self.friction > 0.0))

    @property
    def steppable(self) -> bool:
        """Whether steps of one length may follow it: no tables, friction, pendulums, nor laws of joints' own."""
        return not (self.special or self.hinges or self.sums is not None)

    @property
    def of_disturbances(self) -> TorsionalModel:
        """The same with the damping that small disturbances of steady running meet."""
        damping = self.disturbed_damping
        return self if damping is None else replace(self, damping=damping, disturbed_damping=None)

    @property
    def coordinates(self) -> int:
        """Number of coordinates R."""
        return len(self.owner)

    @property
    def free(self) -> bool:
        """Whether torques turn the drive and no speed is forced on it."""
        return self.input_speed is None and self.input_motion is None


def flat_sums(sums: Array | None) -> Array | None:
    """Return sums (..., K, n), complex, as a model has them: (..., 2Kn), more of them behind."""
    return None if sums is None else np.stack([sums.real, sums.imag], axis=-2).reshape(*sums.shape[:-2], -1)


def torsional_line(
    inertia: Sequence[ArrayLike],
    *,
    stiffness: Sequence[ArrayLike],
    damping: Sequence[ArrayLike] | None = None,
    backlash: Sequence[ArrayLike] | None = None,
    ground_damping: Sequence[ArrayLike] | None = None,
    loss_factor: Sequence[ArrayLike] | None = None,
    joint_angle: ArrayLike = (),
    phase: ArrayLike | None = None,
    torques: Iterable[Torque] = (),
    input_speed: ArrayLike | None = None,
) -> TorsionalModel:
    """Return the model of shafts in line, each with its stations, joined by Hooke joints.

    Parameters
    ----------
    inertia : sequence of n+1 arrays (..., N_i) [kg m²]
        Stations of each shaft along the power flow; a shaft with one station is rigid.
    stiffness : sequence of n+1 arrays (..., N_i - 1) [N·m/rad]
        Elements between the stations of each shaft.
    damping, backlash, loss_factor : as stiffness [N·m·s/rad, rad, 1], optional
        Zero when not given.
    ground_damping : as inertia [N·m·s/rad], optional
        Zero when not given.
    joint_angle, phase : array (..., n) [rad]
        α and ψ of the joints; phase is zero when not given.
    torques : iterable of Torque
    input_speed : array (...) [rad/s], optional
        Speed forced on the first station.

    Raises
    ------
    InputError
        Shafts and joints that do not fit, and values that cannot be: `torsional_problems`.

    Examples
    --------
    >>> line = torsional_line([[1.2, 0.05], [0.03, 0.6]], stiffness=[[4000.0], [5000.0]], joint_angle=[0.35])
    >>> line.driven, line.elements, line.coordinate
    ((None, None, (1, 0), None), ((0, 1), (2, 3)), (0, 1, 1, 2))
    """
    masses = [np.asarray(one, dtype=float) for one in inertia]
    joint_angles = np.asarray(joint_angle, dtype=float)
    counts = [one.shape[-1] for one in masses]
    springs = [np.asarray(one, dtype=float) for one in stiffness]
    check(_shape_problems(counts, [one.shape[-1] for one in springs], joint_angles.shape[-1]))
    starts = [sum(counts[:i]) for i in range(len(counts))]
    driven: list[tuple[int, int] | None] = []
    for i, count in enumerate(counts):
        driven += [(starts[i] - 1, i - 1) if i else None, *[None] * (count - 1)]
    model = TorsionalModel(
        inertia=_joined(masses),
        driven=tuple(driven),
        elements=tuple(
            (start + k, start + k + 1) for start, n in zip(starts, counts, strict=True) for k in range(n - 1)
        ),
        stiffness=_joined(springs),
        damping=_joined(_like(damping, springs)),
        backlash=_joined(_like(backlash, springs)),
        loss_factor=_joined(_like(loss_factor, springs)),
        joint_angle=joint_angles,
        phase=np.zeros_like(joint_angles) if phase is None else np.asarray(phase, dtype=float),
        ground_damping=_joined(_like(ground_damping, masses)),
        torques=tuple(torques),
        input_speed=None if input_speed is None else np.asarray(input_speed, dtype=float),
        shaft=tuple(i for i, count in enumerate(counts) for _k in range(count)),
    )
    check(torsional_problems(model))
    return model


def _like(given: Sequence[ArrayLike] | None, pattern: Sequence[Array]) -> list[Array]:
    if given is None:
        return [np.zeros_like(one) for one in pattern]
    return [np.asarray(one, dtype=float) for one in given]


def _joined(parts: Sequence[Array]) -> Array:
    outer = np.broadcast_shapes(*(part.shape[:-1] for part in parts))
    return np.concatenate([np.broadcast_to(part, (*outer, part.shape[-1])) for part in parts], axis=-1)


def _shape_problems(counts: list[int], springs: list[int], joints: int) -> Iterator[Problem]:
    if joints != len(counts) - 1:
        text = _("{joints} joints given, {wanted} needed between {shafts} shafts")
        yield Problem("joints", text.format(joints=joints, wanted=len(counts) - 1, shafts=len(counts)))
    for i, count in enumerate(counts):
        if count < 1:
            yield Problem(f"shafts[{i}].inertia", _("empty; a shaft has at least one station"))
    for i, (count, given) in enumerate(zip(counts, springs, strict=False)):
        if count >= 1 and given != count - 1:
            text = _("{given} values given, {wanted} needed between {count} stations")
            yield Problem(f"shafts[{i}].stiffness", text.format(given=given, wanted=count - 1, count=count))


def torsional_problems(model: TorsionalModel) -> Iterator[Problem]:
    """Yield what cannot be in a model: negative values, bends of 90° and more, torques on missing stations."""
    for name, values, positive in (
        ("inertia", model.inertia, False),
        ("stiffness", model.stiffness, True),
        ("damping", model.damping, False),
        ("backlash", model.backlash, False),
        ("ground_damping", model.ground_damping, False),
        ("loss_factor", model.loss_factor, False),
    ):
        for k in range(values.shape[-1]):
            one = values[..., k]
            wrong = ~np.isfinite(one) | ((one <= 0.0) if positive else (one < 0.0))
            if np.any(wrong):
                text = _("{value:.6g} given; more than 0 is needed") if positive else _("{value:.6g} given; at least 0")
                yield Problem(f"{name}[{k}]", text.format(value=float(one[wrong].flat[0])))
    for k in range(model.joint_angle.shape[-1]):
        one = model.joint_angle[..., k]
        wrong = ~((one >= 0.0) & (one < 0.5 * np.pi))
        if np.any(wrong):
            text = _("{value:.6g}° given; a joint angle is from 0° to less than 90°")
            yield Problem(f"joints[{k}].joint_angle", text.format(value=float(np.degrees(one[wrong].flat[0]))))
    for k, torque in enumerate(model.torques):
        if not 0 <= torque.station < len(model.driven):
            text = _("station {given} given; the drive has {count}")
            yield Problem(f"torques[{k}].station", text.format(given=torque.station, count=len(model.driven)))
