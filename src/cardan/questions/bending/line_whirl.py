"""How does the whole line of a drive whirl: unbalances, secondary couples, weight and cracks on damped supports?"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

import numpy as np
import scipy

from cardan.drive.conditions import used_speeds
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.fields.parts import known_lengths
from cardan.drive.models.dynamics_model import place_of, train
from cardan.drive.shaft import Shaft
from cardan.drive.yokes import with_yokes
from cardan.errors import InputError, refuse
from cardan.formulas.damping import LOSS
from cardan.formulas.run_up import Progress
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.kernel import frames
from cardan.maths.linear.rotor_beams import beam_stiffness, divided, layout, matrices
from cardan.maths.periodic.turning_spring import hump
from cardan.questions.forces.forces import forces
from cardan.questions.forces.kinetostatics import standing
from cardan.texts import _

from .balance import balance
from .bending import elements, wear_factors
from .whirl_line import WhirlLine, crack_hinge, crack_place, whirl_line

TURN = 64
"""Positions of the input in a turn at which forces are sampled; orders up to `REACH` of them are whole."""

REACH = 5
"""Orders from -REACH to REACH of the input that count; a breathing crack couples them."""

MODES = 12
"""Modes of the line that its motion is made of, beside the static shapes of all that pushes it."""

ELEMENTS = 8
"""Finite elements along the line for each mode, and one mode more."""

SAMPLES = 32
"""Instants of a turn at which the largest distance from the mean is looked for."""

BLOCK = 64
"""Speeds at which it is looked for at a time."""

SPEEDS = 200
"""Speeds where none are given, beside those about the resonances."""

ABOUT = (-3.0, -1.5, -0.8, -0.4, 0.0, 0.4, 0.8, 1.5, 3.0)
"""Speeds about a resonance, in half the width at which its amplitude is 0.7 of the peak."""

NARROW = 1e-4
"""Damping ratio from which a resonance is wide enough to be looked at like this."""

BEYOND = 1.25
"""Highest speed looked at over the highest in use."""

FAINT = 1e-7
"""Share of the largest order of a force below which an order counts as none: a hundredfold by resonance, it is 1e-5."""


@dataclass(frozen=True, eq=False, kw_only=True)
class LineWhirl:
    """Steady whirl of the whole line over the speed."""

    speed: Array  # (k,) [rad/s]: of the input
    order: Array  # (N,) of int: by the turns of the input; negative ones run backward
    place: Array  # (p,) [m]: along the line from joint 1 on
    shaft: Array  # (p,) of int: number of the shaft at each place
    # (k, N, p) [m], complex: Z_n of X + iY = Σ Z_n e^(inφ_1), X down and Y 90° ahead in the sense of rotation
    deflection: Array
    support: tuple[int, ...]  # numbers of the supports that give way, for `support_force`
    support_force: Array  # (k, N, s) [N], complex: force of the line on each of them, springs and dampers together
    used: tuple[float, float] | None  # [rad/s]: lowest and highest speed of running
    damping_ratio: Array  # (m,): of each mode, without the dampers of the supports
    cracked: tuple[int, ...]  # shafts with a crack that counts
    worn: tuple[int, ...]  # shafts whose spline has play, so that their stiffness counts with the square of k_n
    # what the basis of modes and static shapes misses of all finite elements where the line whirls most, over the
    # motion there; without cracks
    residual: float
    # largest moment at a crack that is not of the weight, over that of the weight there: above 1 the crack does not
    # breathe by weight; 0 without cracks
    beside_weight: float = 0.0
    assumed: tuple[str, ...] = ()  # paths of what the drive does not say and the answer assumes

    @cached_property
    def whirl(self) -> Array:
        """Largest distance from the mean position over a turn, array (k, p) [m]."""
        return largest_of_turn(self.order, self.deflection)

    @property
    def within(self) -> Array:
        """Whether each speed is in use, array of bool (k,); all of them where the drive says none."""
        if self.used is None:
            return np.ones(len(self.speed), dtype=bool)
        low, high = self.used
        inside: Array = (self.speed >= low * (1.0 - 1e-9)) & (self.speed <= high * (1.0 + 1e-9))
        return inside if np.any(inside) else np.ones(len(self.speed), dtype=bool)

    def peak(self, order: int | None = None, *, shaft: int | None = None) -> tuple[float, float, float]:
        """Return amplitude [m], speed [rad/s] and place [m] where the line whirls most within the speeds in use.

        order: one order alone; all of them together but for the mean when not given; shaft: one shaft alone.
        """
        size = self.whirl if order is None else np.abs(np.sum(self.deflection[:, self.order == order], axis=1))
        here = np.ones(len(self.place), dtype=bool) if shaft is None else self.shaft == shaft
        size = np.where(self.within[:, None] & here, size, -1.0)
        k, p = np.unravel_index(int(np.argmax(size)), size.shape)
        return float(size[k, p]), float(self.speed[k]), float(self.place[p])


def largest_of_turn(order: Array, value: Array) -> Array:
    """Return the largest distance from the mean of sums of orders, array (k, ...), from values (k, N, ...)."""
    there = (order != 0) & np.any(value != 0.0, axis=(0, *range(2, value.ndim)))
    wave = np.exp(1j * np.outer(np.arange(SAMPLES) * (2.0 * np.pi / SAMPLES), order[there]))
    rows = np.moveaxis(value[:, there], 1, 0)
    found = np.zeros((len(value), *value.shape[2:]))
    for k in range(0, len(value) if rows.size else 0, BLOCK):
        part = rows[:, k : k + BLOCK]
        moved = wave @ part.reshape(len(part), -1)
        found[k : k + BLOCK] = np.sqrt(np.max(moved.real**2 + moved.imag**2, axis=0)).reshape(part.shape[1:])
    return found


def line_whirl(
    drive: Drive,
    duty: Duty | None = None,
    *,
    speed: ArrayLike | None = None,
    damping_ratio: float | None = None,
    progress: Progress | None = None,
) -> LineWhirl:
    """Return how the whole line of a drive whirls over the speed.

    drive: with bodies of its shafts, unbalances, supports with stiffness and `damping`, cracks with their depth.
    duty: speeds of running and torque; those of the drive by default.
    speed (k,) [rad/s]: speeds of the input; by default up to beyond the highest in use, close about each resonance.
    damping_ratio: ζ of all modes; by default half the loss factors of steel shafts and of supports, by their share in
    the energy of each mode. The dampers of supports come on top.

    Timoshenko's beams of `bending_speeds`, hinged at the joints, M z̈ + (C - iΩG) ż + K z = Σ F_n e^(inΩt), in complex
    z = X + iY: (K + nΩ²G - n²Ω²M + inΩC) Z_n = F_n in a basis of the lowest modes and of the static shapes of all that
    pushes the line. Forces are the unbalances as their shafts turn, behind joints with their further odd orders (the
    allowed unbalance where a shaft between joints has none), the couples that the joints pass on across the shafts
    (order 0, 2, 4; without the inertia of the shafts), and the weight. A support whose `side_stiffness` differs
    couples order n with the conjugate of -n. A shaft with a wear factor k_n counts with k_n² of its bending stiffness,
    so that it whirls at its real critical speed. A crack is a hinge with the local compliance of its depth (strain
    energy release rates of a straight edge, Dimarogonas and Papadopoulos 1983; a tube as one through the wall), which
    breathes with the weight; all orders of it are solved together.
    See bending_speeds, rotor_response, balance
    """
    chosen = drive.duty if duty is None else duty
    model, used = line_model(drive, chosen, damping_ratio), used_speeds(chosen)
    if speed is None:
        if used is None:
            raise refuse("duty.speed_range", _("missing: the speeds at which the line is looked at"), "missing")
        at = model.speeds(0.0, BEYOND * used[1], used)
    else:
        at = np.atleast_1d(np.asarray(speed, dtype=float))
    if not np.all(np.isfinite(at)) or np.any(at < 0.0):
        raise refuse("speed", _("needs to be at least 0"), "negative")
    return model.steady(at, used, progress)


@lru_cache(maxsize=16)
def whirl_in_use(drive: Drive) -> LineWhirl:
    """Return how the whole line of a drive whirls over the speeds in use, found once for answers, checks and report."""
    return line_whirl(drive)


def line_model(drive: Drive, duty: Duty, damping_ratio: float | None) -> LineModel:
    """Return the line of a drive in a duty as matrices; see `line_whirl`."""
    if damping_ratio is not None and not 0.0 <= damping_ratio < 1.0:
        text = _("{value:.6g} is not at least 0 and below 1")
        raise refuse("damping_ratio", text.format(value=damping_ratio), "out_of_range")
    return LineModel(replace(drive, duty=duty), damping_ratio)


def turning_marks(drive: Drive) -> tuple[Array, Array, Array, Array]:
    """Return how the shafts of a drive turn, seen across each.

    Returns gravity (s,) [m/s²]: across each shaft; down, ahead (s, 3): X, down across the shaft, and Y 90° ahead in the
    sense of rotation; mark (s, TURN), complex: direction X + iY of the driving yoke, of the last shaft the driven one,
    over a turn of the input.
    """
    whole = train(drive, kinds=True)
    place = place_of(whole)
    stand = standing(whole.chain, place.axis, place.normal, np.arange(TURN) * (2.0 * np.pi / TURN), speed=1.0)
    axis = np.asarray(place.axis)
    pull = np.asarray(drive.settings.gravity, dtype=float)
    across = pull - np.sum(axis * pull, axis=-1)[:, None] * axis
    gravity = np.linalg.norm(across, axis=-1)
    steep = gravity <= 1e-9 * max(float(np.linalg.norm(pull)), 1.0)
    down = frames.unit(np.where(steep[:, None], frames.perpendicular(axis), across))
    ahead = frames.cross(axis, down)
    arms = np.concatenate([stand.driving_arm, stand.driven_arm[:, -1:]], axis=1)
    return gravity, down, ahead, np.sum(arms * down, axis=-1).T + 1j * np.sum(arms * ahead, axis=-1).T


class LineModel:
    """The line as matrices in its basis, and all that pushes it by orders of the input."""

    def __init__(self, drive: Drive, damping_ratio: float | None) -> None:
        self.drive = with_yokes(drive)
        self.whole = whirl_line(drive)
        self.assumed: list[str] = [*self.whole.assumed]
        cuts = elements(self.whole, MODES, ELEMENTS)
        soft = wear_factors(self.drive)[self.whole.shaft - 1] ** 2
        self.worn = tuple(np.unique(self.whole.shaft[soft < 1.0]).tolist())
        line = replace(self.whole.line, bending=soft * self.whole.line.bending, shear=self.whole.line.shear / soft)
        self.fine = divided(line, cuts)
        self.node = np.concatenate(([0], np.cumsum(cuts)))
        self.at = layout(self.fine)
        self.origin = _origins(self.whole)
        self.order = np.arange(-REACH, REACH + 1)
        size = len(self.at.deflection) + len(self.at.slope)
        self.number = np.full(size, -1)
        self.number[self.at.free] = np.arange(len(self.at.free))
        self.gravity, self.down, self.ahead, self.mark = turning_marks(self.drive)
        found = matrices(self.fine)
        self.inertia, self.gyroscopic = found.inertia, found.gyroscopic
        self._supports(found.stiffness)
        self.spinning, self.couples, self.weight = self._unbalance(), self._couples(), self._weight()
        self._cracks()
        self._basis(damping_ratio)

    def _orders(self, values: Array) -> Array:
        """Return the orders (N, ...) of what is sampled over a turn (TURN, ...)."""
        lines: Array = np.fft.fft(values, axis=0)[self.order % TURN] / TURN
        return np.where(np.abs(lines) > FAINT * np.max(np.abs(lines), initial=0.0), lines, 0.0)

    def _supports(self, stiffness: Array) -> None:
        """Find mean and difference of the supports' stiffness down and aside, and their dampers."""
        held = []
        for number, node in self.whole.support_node.items():
            one = self.drive.supports[number - 1]
            if one.radial and one.stiffness is not None:
                held.append((number, self._free(self.at.deflection[self.node[node]]), one))
        self.support = tuple(number for number, _row, _one in held)
        self.support_row = np.asarray([row for _number, row, _one in held], dtype=int)
        down = np.asarray([one.stiffness for *_rest, one in held], dtype=float)
        aside = np.asarray([one.side_stiffness or one.stiffness for *_rest, one in held], dtype=float)
        self.mean, self.unequal = 0.5 * (down + aside), 0.5 * (down - aside)
        self.damper = np.asarray([one.damping or 0.0 for *_rest, one in held], dtype=float)
        self.stiffness = stiffness.copy()
        self.stiffness[self.support_row, self.support_row] += self.mean - down
        self.lossy = np.zeros_like(stiffness)
        soft = np.asarray([one.damping is None for *_rest, one in held], dtype=bool)
        np.add.at(self.lossy, (self.support_row, self.support_row), np.where(soft, self.mean, 0.0))

    def _free(self, unknown: int) -> int:
        return int(self.number[unknown])

    def _element(self, number: int, position: float) -> tuple[Array, Array]:
        """Return the unknowns of the beam at a place of a shaft, -1 where held, and Hermite's shape there."""
        x = self.origin[number] + position - self.whole.place[0]
        k = int(np.clip(np.searchsorted(self.fine.place, x, side="right") - 1, 0, self.fine.beams - 1))
        h = float(self.fine.length[k])
        s = (x - float(self.fine.place[k])) / h
        shape = [1 - 3 * s**2 + 2 * s**3, h * (s - 2 * s**2 + s**3), 3 * s**2 - 2 * s**3, h * (s**3 - s**2)]
        return self.number[self.at.element[k]], np.asarray(shape)

    def _none(self) -> Array:
        return np.zeros((len(self.order), len(self.at.free)), dtype=complex)

    def _unbalance(self) -> Array:
        """Return the force of the unbalances over the square of the input speed, (N, f) [kg·m]."""
        total = self._none()
        for shaft in self.drive.shafts:
            if shaft.number not in self.origin:
                continue
            square = (self.order**2)[:, None] * self._orders(self.mark[shaft.number - 1][:, None])
            for place, vector in self._unbalances(shaft):
                rows, shape = self._element(shaft.number, place)
                there = rows >= 0
                total[:, rows[there]] += square * vector * shape[there]
        return total

    def _unbalances(self, shaft: Shaft) -> Iterator[tuple[float, complex]]:
        """Yield the unbalances of a shaft, what its grade allows amid it where a shaft between joints has none."""
        for one in shaft.unbalance:
            yield one.position, one.amount * complex(np.exp(1j * one.angle))
        if not shaft.unbalance and 1 < shaft.number <= len(self.drive.joints):
            self.assumed.append(f"shafts[{shaft.number - 1}].unbalance")
            try:
                limits = {one.number: one.limit for one in balance(self.drive).shafts}
            except InputError:
                limits = {}
            amount = limits.get(shaft.number, math.nan)
            if math.isfinite(amount):
                yield 0.5 * known_lengths(self.drive)[shaft.number], complex(amount)

    def _couples(self) -> Array:
        """Return what the couples of the joints across the shafts push, (N, f) [N, N·m]; none without a torque."""
        total = self._none()
        if self.drive.duty.torque is None:
            self.assumed.append("duty.torque")
            return total
        angle = np.arange(TURN) * (2.0 * np.pi / TURN)
        still = replace(self.drive.duty, speed=None, acceleration=0.0, harmonics=())
        try:
            found = forces(replace(self.drive, supports=()), still, angle)
        except InputError:
            self.assumed.append("duty.torque")
            return total
        for joint, node in self.whole.joint_node.items():
            before, after = joint - 1, joint
            ends = (
                (before, -found.driving_couple[joint - 1], self.fine.slope_before(int(self.node[node]))),
                (after, found.driven_couple[joint - 1], self.fine.slope_after(int(self.node[node]))),
            )
            for shaft, couple, slope in ends:
                row = self._free(self.at.slope[slope])
                if shaft + 1 in self.origin and row >= 0:
                    # A slope turns X toward the axis about Y: M·Y - i M·X works on it.
                    push = couple @ self.ahead[shaft] - 1j * (couple @ self.down[shaft])
                    total[:, row] += self._orders(push[:, None])[:, 0]
        return total

    def _weight(self) -> Array:
        """Return the weight of everything, (N, f) [N]."""
        field = np.zeros(len(self.number))
        shaft = np.repeat(self.whole.shaft, np.diff(self.node))
        node = np.concatenate([[shaft[0]], shaft])
        field[self.at.deflection] = self.gravity[node - 1]
        total = self._none()
        full = replace(self.fine, held=(), clamped=(), rotary=0.0 * self.fine.rotary)
        total[REACH] = (matrices(full).inertia @ field)[self.at.free]
        return total

    def _cracks(self) -> None:
        """Find the cracks: the column and the row of the beam behind each, its compliance, and how it breathes."""
        self.cracked: list[int] = []
        self.column, self.own, mean, swing = [], [], [], []
        beams = beam_stiffness(self.fine)
        sag = np.linalg.solve(self.stiffness, self.weight[REACH].real)
        for shaft in self.drive.shafts:
            if shaft.crack is None or shaft.number not in self.origin:
                continue
            if shaft.crack.position is None:
                self.assumed.append(f"shafts[{shaft.number - 1}].crack.position")
            x = self.origin[shaft.number] + crack_place(shaft, self._length(shaft)) - self.whole.place[0]
            k = int(np.argmin(np.abs(self.fine.place[:-1] - x)))
            along, across = crack_hinge(shaft, self._length(shaft))
            column = np.zeros(len(self.at.free))
            rows = self.number[self.at.element[k]]
            column[rows[rows >= 0]] = beams[k][rows >= 0, 1]
            self.cracked.append(shaft.number)
            self.column.append(column)
            self.own.append(float(beams[k][1, 1]))
            unit = self.mark[shaft.number - 1] * np.exp(1j * shaft.crack.angle)
            # The weight stretches the side below, or that above where the shaft hangs over what holds it.
            stretched = -1.0 if float(column @ sag) < 0.0 else 1.0
            opened = hump(stretched * unit / np.abs(unit), shaft.crack.breathing)[0]
            mean.append(0.5 * (along + across) * opened)
            swing.append(0.5 * (along - across) * opened * unit**2)
        self.soft = [np.fft.fft(one) / TURN for one in mean]
        self.turning_soft = [np.fft.fft(one) / TURN for one in swing]

    def _length(self, shaft: Shaft) -> float:
        inside = np.flatnonzero(self.whole.shaft == shaft.number)
        return float(self.whole.place[inside[-1] + 1] - self.whole.place[inside[0]])

    def _basis(self, damping_ratio: float | None) -> None:
        """Find the basis: modes and static shapes, as modes of what they span."""
        count = min(MODES, len(self.at.free))
        _roots, modes = scipy.linalg.eigh(self.stiffness, self.inertia, subset_by_index=[0, count - 1])
        loads = [part.real for part in (*self.spinning, *self.couples, *self.weight)]
        loads += [part.imag for part in (*self.spinning, *self.couples, *self.weight)]
        unit = np.zeros((len(self.support_row), len(self.at.free)))
        unit[np.arange(len(self.support_row)), self.support_row] = 1.0
        push = np.asarray([one for one in (*loads, *unit, *self.column) if np.any(one)]).reshape(-1, len(modes))
        push = push / np.linalg.norm(push, axis=-1, keepdims=True)
        _left, size, right = np.linalg.svd(push, full_matrices=False)
        shapes = np.linalg.solve(self.stiffness, right[size > 1e-9 * size[0]].T)
        # What the modes leave of the static shapes, of one size each before they are made square to each other.
        for _pass in range(2):
            shapes = shapes - modes @ (modes.T @ (self.inertia @ shapes))
        shapes = shapes / np.sqrt(np.sum(shapes * (self.inertia @ shapes), axis=0))
        roots, vectors = np.linalg.eigh(shapes.T @ self.inertia @ shapes)
        good = roots > 1e-8
        span = np.hstack([modes, shapes @ (vectors[:, good] / np.sqrt(roots[good]))])
        square, vectors = np.linalg.eigh(span.T @ self.stiffness @ span)
        self.basis = span @ vectors
        self.square = square
        shaken = self.basis.T @ self.lossy @ self.basis
        share = np.clip(np.diag(shaken) / square, 0.0, 1.0)
        loss = 0.5 * ((1.0 - share) * LOSS["shaft"] + share * LOSS["support"])
        self.damping = loss if damping_ratio is None else np.full(len(square), damping_ratio)

    def speeds(self, low: float, high: float, ends: tuple[float, ...] = ()) -> Array:
        """Return speeds from low to high [rad/s], close about those at which an order meets a mode."""
        even = np.linspace(low, high, SPEEDS + 1)[1:]
        near = [speed * (1.0 + max(ratio, NARROW) * np.asarray(ABOUT)) for speed, ratio in self.resonances()]
        found = np.unique(np.concatenate([even, *near, np.asarray(ends, dtype=float)]))
        return found[(found > 0.0) & (found >= low) & (found <= high)]

    def resonances(self) -> list[tuple[float, float]]:
        """Return the speeds at which an order that pushes the line meets a mode [rad/s], with its damping ratio.

        A crack makes every order push, and the modes softer by its mean compliance.
        """
        v, m = self.basis[self.support_row], len(self.square)
        plain = np.diag(self.square)
        for column, own, mean in zip(self.column, self.own, self.soft, strict=True):
            compliance, turned_by = float(mean[0].real), column @ self.basis
            plain -= compliance / (1.0 + compliance * own) * np.outer(turned_by, turned_by)
        turned = self.basis.T @ self.gyroscopic @ self.basis
        apart = (v.T * self.unequal) @ v
        loss = np.diag(2.0 * self.damping * np.sqrt(self.square)) + (v.T * self.damper) @ v
        pushed = self.spinning + self.couples
        coupled = bool(np.any(self.unequal))
        found: list[tuple[float, float]] = []
        for n in range(1, REACH + 1):
            there = [bool(self.cracked or np.any(pushed[REACH + n])), bool(np.any(pushed[REACH - n]))]
            # Forward whirl, K - n²Ω² (1 - G/n), and backward, with the other sign; unequal supports couple them.
            ways = [(1.0, -1.0)] if coupled and any(there) else [(1.0,)] * there[0] + [(-1.0,)] * there[1]
            for way in ways:
                stiff = scipy.linalg.block_diag(*[plain] * len(way))
                if len(way) > 1:
                    stiff[:m, m:] = stiff[m:, :m] = apart
                inert = scipy.linalg.block_diag(*(n * n * np.eye(m) - sign * n * turned for sign in way))
                roots, shapes = scipy.linalg.eigh(inert, stiff)
                parts = shapes[:, roots > 0.0].T.reshape(-1, len(way), m)
                speed = 1.0 / np.sqrt(roots[roots > 0.0])
                lost = np.einsum("kwi,ij,kwj->k", parts, loss, parts) / np.sum(parts**2, axis=(1, 2))
                found += zip(speed.tolist(), (lost / (2.0 * n * speed)).tolist(), strict=True)
        return found

    def steady(self, speed: Array, used: tuple[float, float] | None, progress: Progress | None = None) -> LineWhirl:
        """Return the steady whirl at the speeds."""
        sources = speed[:, None, None] ** 2 * (self.spinning @ self.basis) + (self.couples + self.weight) @ self.basis
        value = self.solved(speed, sources)
        beside = 0.0
        if self.cracked:
            columns = np.stack(self.column) @ self.basis
            moments = value @ columns.T
            beside = self._beside_weight(moments, columns)
            jumps = self._jumps(speed, moments, columns)
            value = value - self.solved(speed, jumps @ columns)
        deflection = np.zeros((*value.shape[:2], self.fine.beams + 1), dtype=complex)
        rows = self.number[self.at.deflection]
        deflection[..., rows >= 0] = value @ self.basis[rows[rows >= 0]].T
        if progress is not None:
            progress(1.0)
        there = value @ self.basis[self.support_row].T
        rate = 1j * speed[:, None, None] * self.order[:, None]
        held = (self.mean + self.damper * rate) * there + self.unequal * np.conj(there[:, ::-1])
        shaft = np.repeat(self.whole.shaft, np.diff(self.node))
        found = LineWhirl(
            speed=speed,
            order=self.order,
            place=self.fine.place + self.whole.place[0],
            shaft=np.concatenate([[shaft[0]], shaft]),
            deflection=deflection,
            support=self.support,
            support_force=held,
            used=used,
            damping_ratio=self.damping,
            cracked=tuple(self.cracked),
            worn=self.worn,
            residual=0.0,
            beside_weight=beside,
            assumed=tuple(dict.fromkeys(self.assumed)),
        )
        return replace(found, residual=self._residual(speed, found))

    def _dynamic(self, speed: Array, order: int) -> Array:
        """Return the matrix of an order in the basis, complex (k, m, m)."""
        v, rate = self.basis, order * speed[:, None, None]
        turned = v.T @ self.gyroscopic @ v
        dampers = (v[self.support_row].T * self.damper) @ v[self.support_row]
        plain = np.diag(self.square) + 0j
        loss = np.diag(2.0 * self.damping * np.sqrt(self.square)) + dampers
        found: Array = plain + rate * speed[:, None, None] * turned - rate**2 * np.eye(len(v.T)) + 1j * rate * loss
        return found

    def solved(self, speed: Array, push: Array) -> Array:
        """Return the motion in the basis under forces, both complex (k, N, m)."""
        value = np.zeros_like(push)
        coupled = bool(np.any(self.unequal))
        v = self.basis[self.support_row]
        apart = (v.T * self.unequal) @ v
        for n in range(REACH + 1):
            ahead, back = REACH + n, REACH - n
            if not (np.any(push[:, ahead]) or np.any(push[:, back])):
                continue
            at = speed if n else speed[:1]  # what stands still is the same at all speeds
            pair = [self._dynamic(at, n), np.conj(self._dynamic(at, -n))]
            sides = np.stack([push[:, ahead], np.conj(push[:, back])], axis=1)
            if coupled:
                m = len(apart)
                matrix = np.zeros((len(at), 2 * m, 2 * m), dtype=complex)
                matrix[:, :m, :m], matrix[:, m:, m:] = pair
                matrix[:, :m, m:] = matrix[:, m:, :m] = apart
                both = np.linalg.solve(matrix, sides.reshape(len(speed), 2 * m, 1)).reshape(len(speed), 2, m)
            else:
                both = np.stack(
                    [np.linalg.solve(one, sides[:, k, :, None])[..., 0] for k, one in enumerate(pair)], axis=1
                )
            value[:, ahead], value[:, back] = both[:, 0], np.conj(both[:, 1])
        return value

    def _beside_weight(self, moments: Array, columns: Array) -> float:
        """Return the largest moment at a crack that is not of the weight, over that of the weight there."""
        own = self.solved(np.zeros(1), (self.weight @ self.basis)[None])[0, REACH] @ columns.T
        others = np.sum(np.abs(moments), axis=1) - np.abs(moments[:, REACH]) + np.abs(moments[:, REACH] - own)
        with np.errstate(divide="ignore", invalid="ignore"):
            return float(np.nan_to_num(np.max(others / np.abs(own)), posinf=np.inf))

    def _jumps(self, speed: Array, moments: Array, columns: Array) -> Array:
        """Return the jumps of slope at the cracks, complex (k, N, c), of all orders at once.

        moments (k, N, c): what the sound line has there; κ + C(t) (moment + own κ - receptance κ) = 0, C(t) the
        compliance as it breathes, ½(c_ξ + c_η) f on the moment and ½(c_ξ - c_η) f e^(2iθ) on its conjugate.
        """
        count, orders = len(self.cracked), len(self.order)
        size = orders * count
        # Moment at the cracks by a unit of jump: linear in it, and by its conjugate on unequal supports.
        real = np.zeros((len(speed), size, size), dtype=complex)
        conj = np.zeros((len(speed), size, size), dtype=complex)
        for j in range(count):
            for n in range(orders):
                for unit in (1.0, 1j):
                    push = np.zeros((len(speed), orders, columns.shape[1]), dtype=complex)
                    push[:, n] = unit * columns[j]
                    seen = (self.solved(speed, push) @ columns.T).reshape(len(speed), size)
                    # a u + b u*: the sum and difference of what 1 and i give.
                    real[:, :, n * count + j] += seen / (2.0 * unit)
                    conj[:, :, n * count + j] += seen * unit / 2.0
        own = np.zeros(size)
        own[:] = np.tile(self.own, orders)
        passed = np.diag(own)[None] - real
        law, mirrored = np.zeros((size, size), dtype=complex), np.zeros((size, size), dtype=complex)
        for j in range(count):
            for a, n in enumerate(self.order.tolist()):
                for b, m in enumerate(self.order.tolist()):
                    law[a * count + j, b * count + j] = self.soft[j][(n - m) % TURN]
                    mirrored[a * count + j, b * count + j] = self.turning_soft[j][(n + m) % TURN]
        # κ + L (m + P κ - B κ*) + D (m + P κ - B κ*)* = 0 as real equations.
        given = moments.reshape(len(speed), size)
        linear = np.eye(size) + law @ passed - mirrored @ np.conj(conj)
        flipped = -law @ conj + mirrored @ np.conj(passed)
        right = -(given @ law.T + np.conj(given) @ mirrored.T)
        plus, minus = linear + flipped, linear - flipped
        matrix = np.block([[plus.real, -minus.imag], [plus.imag, minus.real]])
        solved = np.linalg.solve(matrix, np.concatenate([right.real, right.imag], axis=-1)[..., None])[..., 0]
        jumps: Array = (solved[:, :size] + 1j * solved[:, size:]).reshape(len(speed), orders, count)
        return jumps

    def _residual(self, speed: Array, found: LineWhirl) -> float:
        """Return what the basis misses of all finite elements, over the motion, where the line whirls most.

        Without cracks, of the order that is largest there, with the order that unequal supports couple to it.
        """
        size = np.max(np.abs(found.deflection[:, self.order != 0]), axis=-1)
        k, row = map(int, np.unravel_index(int(np.argmax(size)), size.shape))
        n, omega = abs(int(self.order[self.order != 0][row])), float(speed[k])
        push = omega**2 * self.spinning + self.couples
        basis = self.solved(speed[k : k + 1], (push @ self.basis)[None])[0] @ self.basis.T
        weights = self.inertia @ self.basis
        loss = (weights * (2.0 * self.damping * np.sqrt(self.square))) @ weights.T
        loss[self.support_row, self.support_row] += self.damper
        plain = self.stiffness - (n * omega) ** 2 * self.inertia + 1j * n * omega * loss
        turned = n * omega**2 * self.gyroscopic
        rows = push[REACH + n], np.conj(push[REACH - n])
        seen = basis[REACH + n], np.conj(basis[REACH - n])
        if np.any(self.unequal):
            apart = np.zeros_like(self.stiffness)
            apart[self.support_row, self.support_row] = self.unequal
            exact = np.linalg.solve(np.block([[plain + turned, apart], [apart, plain - turned]]), np.concatenate(rows))
        else:
            exact = np.concatenate(
                [
                    np.linalg.solve(plain + way * turned, one) if np.any(one) else one
                    for way, one in zip((1, -1), rows, strict=True)
                ]
            )
        most = float(np.max(np.abs(exact)))
        return float(np.max(np.abs(exact - np.concatenate(seen)))) / most if most else 0.0


def _origins(whole: WhirlLine) -> dict[int, float]:
    """Return where positions of each shaft of the line count from [m]: its end on shaft 1, else its beginning."""
    found = {}
    for number in np.unique(whole.shaft).tolist():
        beams = np.flatnonzero(whole.shaft == number)
        found[number] = float(whole.place[beams[-1] + 1] if number == 1 else whole.place[beams[0]])
    return found
