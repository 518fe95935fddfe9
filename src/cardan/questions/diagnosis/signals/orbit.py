"""The way a shaft's centre goes, from two sensors across it: raw, and each order as its ellipse."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cardan.errors import Problem, check, refuse
from cardan.maths.arrays import Array
from cardan.texts import _

from .orders import TURNS, turned
from .rotation import Rotation
from .signal import Channel

POINTS = 181  # points of an ellipse
SMOOTH = 16.0  # order up to which the raw way is read: it is drawn


@dataclass(frozen=True, eq=False, kw_only=True)
class Ellipse:
    """The part of an orbit that an order makes."""

    order: float  # turns of the point on it in a turn of the shaft
    # forward, backward: ``z = forward e^{i order θ} + backward e^{-i order θ}`` with z = x + i y: two circles, with the
    # shaft and against it. θ is the angle of the shaft.
    forward: complex
    backward: complex

    @property
    def major(self) -> float:
        """Half of the long axis."""
        return abs(self.forward) + abs(self.backward)

    @property
    def minor(self) -> float:
        """Half of the short axis, negative where it is run through against the shaft."""
        return abs(self.forward) - abs(self.backward)

    @property
    def incline(self) -> float:
        """Angle of the long axis from x towards y, from −π/2 to π/2 [rad]."""
        angle = 0.5 * float(np.angle(self.forward * self.backward)) if self.forward * self.backward else 0.0
        return (angle + 0.5 * math.pi) % math.pi - 0.5 * math.pi

    def points(self, count: int = POINTS) -> tuple[Array, Array]:
        """Return x and y of the ellipse over one round, arrays (count,)."""
        angle = np.linspace(0.0, 2.0 * math.pi, count)
        z = self.forward * np.exp(1j * angle) + self.backward * np.exp(-1j * angle)
        return z.real, z.imag


@dataclass(frozen=True, eq=False, kw_only=True)
class Orbit:
    """The way of a point over some turns of the shaft.

    Attributes
    ----------
    names : (str, str)
        Of the two channels.
    quantity : str
        What both measure.
    angle : array (n,) [rad]
        Of the shaft.
    x, y : arrays (n,)
        Raw, around their means, in the unit of the channels.
    mean : (float, float)
        Where the middle lies.
    speed : float [rad/s]
        Mean speed of these turns.
    ellipses : tuple of Ellipse
        One for each order asked for.
    residual : float
        Root of the mean square of what these orders leave.
    confidence : float
        From 0 to 1.
    """

    names: tuple[str, str]
    quantity: str
    angle: Array
    x: Array
    y: Array
    mean: tuple[float, float]
    speed: float
    ellipses: tuple[Ellipse, ...]
    residual: float
    confidence: float

    def filtered(self, *orders: float) -> tuple[Array, Array]:
        """Return x and y of some orders together over the turns, arrays (n,); of all of them where none is named."""
        z = np.zeros(self.angle.size, dtype=complex)
        for one in self.ellipses:
            if not orders or one.order in orders:
                turn = np.exp(1j * one.order * self.angle)
                z += one.forward * turn + one.backward / turn
        return z.real, z.imag


def orbit(
    x: Channel,
    y: Channel,
    rotation: Rotation,
    *,
    orders: Sequence[float] = (1.0, 2.0),
    at: float | None = None,
    turns: int = TURNS,
    angles: tuple[float, float] = (0.0, 0.5 * math.pi),
) -> Orbit:
    """Return the orbit that two sensors see, at one time.

    Parameters
    ----------
    x, y : Channel
        Of one quantity, at one place, in two directions across the shaft.
    rotation : Rotation
        How the shaft turned.
    orders : sequence of float
        Those whose ellipses are asked for.
    at : float [s], optional
        Time about which the turns lie; the middle of the recording when not given.
    turns : int
        How many.
    angles : (float, float) [rad]
        Where the sensors sit around the shaft, counted the way it turns.

    Returns
    -------
    Orbit

    Raises
    ------
    InputError
        The channels do not go together, or sit at one angle, or there are too few turns.

    See Also
    --------
    order_spectrum, integrate

    Examples
    --------
    >>> import numpy as np
    >>> from cardan.recordings import Channel, Rotation, orbit
    >>> time = np.arange(8000) / 2000
    >>> rows = np.cos(40 * time), 0.5 * np.sin(40 * time)
    >>> x, y = (Channel(name="xy"[k], quantity="displacement", values=rows[k], rate=2000.0) for k in range(2))
    >>> found = orbit(x, y, Rotation(time=time[::50], angle=40 * time[::50])).ellipses[0]
    >>> print(f"{found.major:.3f}, {found.minor:.3f}, {found.incline:.3f} rad")
    1.000, 0.500, 0.000 rad
    """
    check(_misfits(x, y, angles))
    highest = max(SMOOTH, 2.0 * max((float(one) for one in orders), default=1.0))
    rows = [turned(one, rotation, highest=highest) for one in (x, y)]
    first = max(row.angle[0] for row in rows)
    last = min(row.angle[-1] for row in rows)
    per_turn = rows[0].per_turn
    used = min(turns, int((last - first) / (2.0 * math.pi)))
    if used < 1:
        raise refuse(y.name, _("shares no turn with {name}").format(name=x.name), "out_of_range")
    middle = float(rotation.angle_at(at)) if at is not None else 0.5 * (first + last)
    begin = min(max(middle - math.pi * used, first), last - 2.0 * math.pi * used)
    cut = []
    for row in rows:
        k = round((begin - row.angle[0]) * per_turn / (2.0 * math.pi))
        cut.append(slice(k, k + used * per_turn))
    # From the axes of the sensors to x and y: each sees the part of the way along its own direction.
    along = np.asarray([[math.cos(one), math.sin(one)] for one in angles])
    seen = np.stack([row.values[some] for row, some in zip(rows, cut, strict=True)])
    way = np.linalg.solve(along, seen)
    angle = rows[0].angle[cut[0]]
    time = rows[0].time[cut[0]]
    wanted = np.asarray(orders, dtype=float)
    waves = [np.ones(angle.size)[:, None], np.exp(1j * np.outer(angle, wanted)), np.exp(-1j * np.outer(angle, wanted))]
    every = np.concatenate(waves, axis=1)
    z = way[0] + 1j * way[1]
    solved = np.linalg.lstsq(every, z, rcond=None)[0]
    left = z - every @ solved
    mean = complex(solved[0])
    return Orbit(
        names=(x.name, y.name),
        quantity=x.quantity,
        angle=angle,
        x=way[0] - mean.real,
        y=way[1] - mean.imag,
        mean=(mean.real, mean.imag),
        speed=float((angle[-1] - angle[0]) / (time[-1] - time[0])),
        ellipses=tuple(
            Ellipse(order=float(n), forward=complex(solved[1 + k]), backward=complex(solved[1 + wanted.size + k]))
            for k, n in enumerate(wanted)
        ),
        residual=float(np.sqrt(np.mean(np.abs(left) ** 2))),
        confidence=rotation.confidence * min(x.trust, y.trust),
    )


def _misfits(x: Channel, y: Channel, angles: tuple[float, float]) -> list[Problem]:
    found = []
    if x.quantity != y.quantity:
        text = _("{x} measures {one}, {y} measures {other}; an orbit needs one quantity")
        text = text.format(x=x.name, one=x.quantity, y=y.name, other=y.quantity)
        found.append(Problem("y", text, "inconsistent"))
    if x.place != y.place:
        text = _("{x} sits on {one}, {y} on {other}; an orbit needs one place")
        text = text.format(x=x.name, one=x.place or "–", y=y.name, other=y.place or "–")
        found.append(Problem("y", text, "inconsistent"))
    if abs(math.sin(angles[1] - angles[0])) < 0.1:
        found.append(Problem("angles", _("the sensors look along one line; they are to stand across"), "singular"))
    return found
