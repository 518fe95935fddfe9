"""What does each joint do to a mode? Where it stands beside the node, what it excites, and what their phases leave."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from cardan.maths.arrays import Array
from cardan.questions.torsion.model.torsional_layouts import Turning
from cardan.questions.torsion.model.torsional_modes import (
    changing_orders,
    joint_orders,
    joint_waves,
    main_order,
    mean_phases,
    straight_modes,
)
from cardan.questions.torsion.model.torsional_train import TorsionalTrain
from cardan.questions.torsion.steady.orbit import at_rest


@dataclass(frozen=True, eq=False, kw_only=True)
class NodeRule:
    """What the joints of a drive do to one of its modes."""

    mode: int  # from 1
    omega: float  # [rad/s]
    damping_ratio: float  # ζ
    # (n,): position of each joint relative to the node of the mode, 0 in it: its angle in the mode times Σ J u behind
    # it
    kappa: Array
    # (n,): by what each joint leads at the order ν, a [rad], τ = tan²(α/2) of a cross twice a turn
    joint_angle_share: Array
    # (n,), complex: share by which each joint modulates the stiffness at that order, with its phase: ν a κ e^(iνψ̄)
    parametric: Array
    # (n,) [√(kg m²)], complex: how each joint pushes the mode where the order ν meets it, with its phase, over ω²:
    # a e^(iνψ̄) (S (1 + iνδ) - iν u t/ω²) with S = Σ J u behind it, its mean torque t and lag δ under load
    forced: Array
    torque_of_mode: float  # [N·m/√(kg m²)]: largest torque of an element of the mode at unit amplitude
    position: Array  # (n,) [m]: of the joints along the line of the shafts
    nodes: tuple[float, ...]  # [m]: where the mode stands still; the input is one where its speed is forced
    order: float = 2.0  # ν: at which joints change the speed most
    others: bool = False  # whether joints that turn by laws of their own excite it at other orders too

    @property
    def modulation(self) -> float:
        """Share by which all joints together modulate the stiffness of the mode at that order."""
        return float(np.abs(np.sum(self.parametric)))

    @property
    def grows(self) -> bool:
        """Whether the mode grows amid its principal zone: modulation above 2 ζ."""
        return self.modulation > 2.0 * self.damping_ratio

    @property
    def push(self) -> float:
        """How all joints together push the mode at that order [√(kg m²)]."""
        return float(np.abs(np.sum(self.forced)))

    @property
    def left(self) -> float:
        """What the phases leave of the pushes, over what they would be with all in phase; 0 where nothing pushes."""
        whole = float(np.sum(np.abs(self.forced)))
        return self.push / whole if whole > 0.0 else 0.0

    @property
    def resonance_torque(self) -> float:
        """Largest torque where that order meets the mode, by this mode alone [N·m]; infinite without damping."""
        if self.push == 0.0:
            return 0.0
        return self.torque_of_mode * self.push / (2.0 * self.damping_ratio) if self.damping_ratio > 0.0 else np.inf


def node_rules(train: TorsionalTrain, *, speed: float = 1.0) -> tuple[NodeRule, ...]:
    """Return what the joints of a drive do to each of its modes, the slowest first.

    Parameters
    ----------
    train : TorsionalTrain
        The model of a drive.
    speed : float [rad/s]
        At which torques are asked for their mean and for how they change with the speed.

    Returns
    -------
    tuple of NodeRule

    Notes
    -----
    Angles counted free of what the joints before add, a straight line is left whose masses behind joint k are shaken
    by ε_k = τ_k sin 2(φ + ψ̄_k): the mode is pushed by 4Ω² Σ_k τ_k S_k sin 2(φ + ψ̄_k), S_k = Σ J u behind it. As the
    phase of joint k follows its own swing u_k, each push also changes with the swing: the parametric part, 2 τ_k κ_k of
    the stiffness with κ_k = u_k S_k. For one mass at either end κ_k = Σ_{i≤k} c/c_i - J_b/(J_a + J_b): a joint in the
    node of the mode excites no parametric vibration. ψ̄ as in `torsional_modes.modulation`. A drive under load pushes
    a little otherwise, by its twist: each joint lags by δ, and its mean torque works on its swing. Joints that turn by
    laws of their own may change the speed most at another order than 2, see `torsional_modes.main_order`: that counts.

    Examples
    --------
    A joint amid a symmetric drive stands in the node:

    >>> from dataclasses import replace
    >>> from cardan import Drive
    >>> from cardan.parts import Duty, Shaft, Station
    >>> from cardan.questions.torsion.model.torsional_train import torsional_train
    >>> ends = (Station(shaft=1, end="start", inertia=0.6), Station(shaft=2, end="end", inertia=0.6))
    >>> drive = replace(Drive.from_angles([0.2]), stations=ends, duty=Duty(input="free", speed=50.0),
    ...     shafts=(Shaft(number=1, stiffness=900.0), Shaft(number=2, stiffness=900.0)))
    >>> (rule,) = node_rules(torsional_train(drive))
    >>> abs(rule.kappa.round(12))
    array([0.])
    """
    model = train.model
    modes = straight_modes(model, speed=speed)
    order = main_order(model)
    wave = joint_waves(model, order)
    turn = np.exp(1j * order * mean_phases(model))
    shaft = np.asarray(model.shaft)
    lag, carried = _under_load(train, speed)
    driving = [one for one, _driven in train.joints]
    rules = []
    for k, omega in enumerate(modes.omega):
        shape = modes.shape[k]
        behind = np.asarray([np.sum((model.inertia * shape)[shaft >= shaft[driven]]) for _one, driven in train.joints])
        push = behind * (1.0 + 1j * order * lag) - 1j * order * shape[driving] * carried / omega**2
        twist = [shape[a] - shape[b] for a, b in model.elements]
        rules.append(
            NodeRule(
                mode=k + 1,
                omega=float(omega),
                damping_ratio=float(modes.damping_ratio[k]),
                kappa=modes.joint_weight[k],
                joint_angle_share=np.abs(wave),
                parametric=order * wave * modes.joint_weight[k] * turn,
                forced=wave * push * turn,
                torque_of_mode=float(np.max(np.abs(model.stiffness * np.asarray(twist)), initial=0.0)),
                position=train.position[driving],
                nodes=tuple(_nodes(train, shape)),
                order=order,
                others=any(one != order for one in changing_orders(model)) and bool(joint_orders(model)),
            )
        )
    return tuple(rules)


def _under_load(train: TorsionalTrain, speed: float) -> tuple[Array, Array]:
    """Return by how much the driving yoke of each joint is ahead under mean torques, and the torque it carries."""
    model, count = train.model, len(train.joints)
    orders = [torque.law.order for torque in model.torques]
    if not model.elements or any(order is None for order in orders):
        return np.zeros(count), np.zeros(count)
    bare = replace(model, torques=tuple(t for t in model.torques if t.law.order == 0.0), backlash=0.0 * model.backlash)
    turning = Turning(replace(bare, input_speed=None), (), np.asarray([speed]), np.pi)
    twist = at_rest(turning)[0, :, 0].real
    angle, load = twist[list(model.coordinate)], -speed * model.ground_damping
    for torque in bare.torques:
        load[torque.station] += float(torque.law.at(np.asarray(0.0), np.asarray(0.0), np.asarray(speed))[0])
    shaft = np.asarray(model.shaft)
    lag = np.asarray([angle[driving] for driving, _driven in train.joints])
    carried = np.asarray([-np.sum(load[shaft >= shaft[driven]]) for _driving, driven in train.joints])
    return lag.reshape(count), carried.reshape(count)


def _nodes(train: TorsionalTrain, shape: Array) -> Iterator[float]:
    """Yield where a mode stands still along the line."""
    largest, line, place = float(np.max(np.abs(shape))), set(train.line), train.position
    if not train.model.free:
        yield float(place[0])
    for a, b in train.model.elements:
        if a not in line or b not in line:
            continue
        one, two = float(shape[a]), float(shape[b])
        if abs(two) <= 1e-9 * largest < abs(one):
            yield float(place[b])
        elif one * two < 0.0 and abs(one) > 1e-9 * largest:
            yield float(place[a] + one / (one - two) * (place[b] - place[a]))
