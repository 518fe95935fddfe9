"""Amplitude and phase of some orders of a signal while the speed changes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cardan.errors import check, refuse
from cardan.maths.arrays import Array
from cardan.texts import _

from .order_windows import TURNS, cut, refused, turned, window_shape, windows_of
from .rotation import Rotation
from .signal import Channel
from .watching import Progress


@dataclass(frozen=True, eq=False, kw_only=True)
class TrackedOrders:
    """Amplitude and phase of some orders while the speed changed.

    Attributes
    ----------
    name, quantity : str
        Of the channel.
    orders : tuple of float
        Those followed.
    time : array (w,) [s]
        Middle of each window.
    speed : array (w,) [rad/s]
        Mean speed in it.
    value : complex array (o, w)
        ``|v| cos(order·angle + arg v)``: peak amplitude, and phase against the mark on the shaft.
    residual : array (w,)
        Root of the mean square of what is left beside these orders.
    turns : int
        In a window.
    phased : bool
        Whether phases mean something.
    confidence : float
        From 0 to 1.
    """

    name: str
    quantity: str
    orders: tuple[float, ...]
    time: Array
    speed: Array
    value: Array
    residual: Array
    turns: int
    phased: bool
    confidence: float

    @property
    def amplitude(self) -> Array:
        """Peak amplitudes, array (o, w)."""
        return np.abs(self.value)

    @property
    def phase(self) -> Array:
        """Phases, array (o, w) [rad], in (−π, π]."""
        return np.angle(self.value)


def tracked_orders(
    channel: Channel,
    rotation: Rotation,
    orders: Sequence[float] = (1.0, 2.0, 3.0, 4.0),
    *,
    turns: int = TURNS,
    progress: Progress | None = None,
) -> TrackedOrders:
    """Return amplitude and phase of some orders over the speed.

    Parameters
    ----------
    channel : Channel
        What shakes.
    rotation : Rotation
        How the shaft turned.
    orders : sequence of float
        Those to follow, whole or not.
    turns : int
        In a window; four windows in the length of one.
    progress : function, optional
        Told the share done; when it answers "stop" the orders are followed as far as the channel was read.

    Returns
    -------
    TrackedOrders

    Raises
    ------
    InputError
        Too few turns, or orders nearer to each other than two lines.

    See Also
    --------
    order_map, order_spectrum

    Notes
    -----
    In every window all orders are fitted together by weighted least squares (Hann's window), so that they do not leak
    into each other and need not be whole; the mean is fitted as well.

    Examples
    --------
    >>> import numpy as np
    >>> from cardan.questions.diagnosis.signals.rotation import Rotation
    >>> time = np.arange(20000) / 4000
    >>> angle = 2 * np.pi * (8 * time + 3 * time**2)
    >>> shaking = Channel(name="front", rate=4000.0, values=np.cos(angle) + 0.2 * np.sin(1.35 * angle))
    >>> found = tracked_orders(shaking, Rotation(time=time[::100], angle=angle[::100]), [1.0, 1.35])
    >>> print(np.round(np.median(found.amplitude, axis=1), 3), np.round(np.median(found.phase, axis=1), 3))
    [1.  0.2] [ 0.    -1.571]
    """
    wanted = np.asarray(orders, dtype=float)
    highest = float(np.max(wanted, initial=1.0))
    check(refused(highest, turns, "hann"))
    read = turned(channel, rotation, highest=highest, progress=progress)
    used, begins, time, speed = cut(read, turns)
    every = np.sort(np.concatenate([[0.0], wanted]))
    if wanted.size == 0 or float(np.min(np.diff(every))) < 1.5 / used:
        text = _("orders must lie {least:.3g} apart, and be above that, to be told apart in {turns} turns")
        raise refuse("orders", text.format(least=1.5 / used, turns=used), "out_of_range")
    length = used * read.per_turn
    angle = (np.arange(length) - 0.5 * length) * (2.0 * math.pi / read.per_turn)
    weight = np.sqrt(window_shape(length, "hann"))
    waves = np.concatenate(
        [np.ones((angle.size, 1)), np.cos(np.outer(angle, wanted)), np.sin(np.outer(angle, wanted))], axis=1
    )
    fit = np.linalg.pinv(weight[:, None] * waves).T * weight[:, None]
    solution, residual = np.empty((begins.size, waves.shape[1])), np.empty(begins.size)
    for some, rows in windows_of(read, used, begins):
        solution[some] = rows @ fit
        left = rows - solution[some] @ waves.T
        residual[some] = np.sqrt(np.sum((weight * left) ** 2, axis=1) / np.sum(weight**2))
    local = solution[:, 1 : wanted.size + 1] - 1j * solution[:, wanted.size + 1 :]
    middle = read.angle[0] + (2.0 * math.pi / read.per_turn) * (begins + 0.5 * length)
    return TrackedOrders(
        name=channel.name,
        quantity=channel.quantity,
        orders=tuple(float(one) for one in wanted),
        time=time,
        speed=speed,
        value=(local * np.exp(-1j * np.outer(middle, wanted))).T,
        residual=residual,
        turns=used,
        phased=rotation.phased,
        confidence=rotation.confidence * channel.trust,
    )
