"""What do many drives reach over a turn? Answered without positions."""

from __future__ import annotations

from dataclasses import dataclass
from math import prod

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.drives import Drives, kinematics
from cardan.drive.models.kinematics_model import Chain
from cardan.errors import refuse
from cardan.later import later
from cardan.maths.arrays import Array, namespace
from cardan.maths.compiled import plain
from cardan.maths.compiled.method import Compiled, Method, buffers, chosen, share
from cardan.maths.kernel import mobius
from cardan.texts import _

from .equivalence import SYNCHRONOUS
from .many_drives import rows_of

compiled = later("cardan.maths.compiled.extremes")

LARGE = 100_000
"""Drives that are worth loading the kernel: half a second in a new process, two when first compiled."""

_PIECE = 4096
"""Drives that are worth a thread, or that stay in the caches of the plain form."""

_NAMES = ("speed_fluctuation", "tau", "joint_angle", "any_phase", "ratio_max", "max_acceleration")


@dataclass(frozen=True, eq=False, kw_only=True)
class Extremes:
    """SpeedFluctuation, equivalent joint and extremes of many drives; the axes (...) are those of the drives.

    Attributes
    ----------
    speed_fluctuation : array (...)
        δ = i_max - i_min.
    tau : array (...)
        τ = tan²(α_eq/2); orders 2, 4 … 2k of the ratio have the amplitudes 2 τ^k.
    joint_angle : array (...) [rad]
        Equivalent angle α_eq.
    any_phase : array (...) [rad]
        Phase ψ_eq in [0, π], also where the drive is synchronous and it means nothing; see `phase`.
    ratio_max : array (...)
        Largest speed ratio 1/cos α_eq.
    max_acceleration : array (...)
        Largest \\|ε_out\\|/ω_1² at uniform input.
    """

    speed_fluctuation: Array
    tau: Array
    joint_angle: Array
    any_phase: Array
    ratio_max: Array
    max_acceleration: Array

    @property
    def phase(self) -> Array:
        """Phase ψ_eq in [0, π], array (...) [rad]; nan where the drive is synchronous to rounding."""
        xp = namespace(self.tau)
        return xp.where(self.speed_fluctuation < SYNCHRONOUS, xp.nan * self.tau, self.any_phase)

    @property
    def ratio_min(self) -> Array:
        """Smallest speed ratio cos α_eq, array (...)."""
        return 1.0 / self.ratio_max

    @property
    def max_angle_error(self) -> Array:
        """Largest \\|φ_out - φ_in\\| about its mean, array (...) [rad]."""
        xp = namespace(self.tau)
        return xp.asin(self.tau)

    def harmonics(self, count: int) -> Array:
        """Return the amplitudes τ^k/k of orders 2, 4 … 2·count of the angle error, array (..., count) [rad]."""
        xp = namespace(self.tau)
        if xp is not np:
            k = xp.arange(1, count + 1, dtype=xp.float64)
            return self.tau[..., None] ** k / k
        rows = np.empty((count, *self.tau.shape))  # each written in place: fresh memory costs more than the products
        rows[:1] = self.tau
        for k in range(1, count):
            np.multiply(rows[k - 1], self.tau, out=rows[k, ...])
        for k in range(1, count):
            rows[k] /= k + 1
        return np.moveaxis(rows, 0, -1)


def extremes(drives: Drives | Drive | Chain, *, out: Extremes | None = None, method: Method | None = None) -> Extremes:
    """Return speed fluctuation, equivalent joint and extremes of many drives.

    What `equivalent_joint` tells of the output shaft, in one pass over memory: for batches of a million.

    Parameters
    ----------
    drives : Drives (...)
        The drives.
    out : Extremes, optional
        Results of an earlier call of the same size, to be written over.
    method : Plain or Compiled, optional
        Compiled by default from 100,000 drives on, where numba is installed.

    Returns
    -------
    Extremes
        speed_fluctuation, tau, joint_angle, phase, ratio_max, max_acceleration : arrays (...).

    Raises
    ------
    InputError
        ``out`` has not the size of the results.

    See Also
    --------
    motion, traces, equivalent_joint

    Notes
    -----
    δ = 4 \\|a\\| \\|b\\|, τ = \\|b\\|/\\|a\\|, i_max = (\\|a\\| + \\|b\\|)² of the drive's Möbius pair (a, b). The
    compiled and the plain form agree to about 1e-14; they round differently.

    Examples
    --------
    >>> from cardan import extremes
    >>> from cardan.sweeps import Drives
    >>> extremes(Drives.from_angles([[0.0, 0.2], [0.2, 0.3]])).speed_fluctuation
    array([0.04027227, 0.05111933])
    """
    chain = kinematics(drives)
    xp = namespace(chain.joint_angle)
    outer = tuple(chain.joint_angle.shape[:-1])
    size = prod(outer)
    how = chosen(method, xp, size >= LARGE)
    if xp is not np:
        if out is not None:
            raise refuse("out", _("only results held in NumPy arrays can be written over"))
        return Extremes(**dict(zip(_NAMES, plain.extremes(chain.products()[-1]), strict=True)))
    room = buffers(_NAMES, outer, out)
    if size:
        if isinstance(how, Compiled):
            _compiled(rows_of(chain), room, threads=how.threads)
        else:
            _plain(rows_of(chain), room)
    return Extremes(**dict(zip(_NAMES, room, strict=True)))


def _plain(chain: Chain, room: tuple[Array, ...]) -> None:
    turn_before = chain.turn_before
    for first in range(0, int(chain.joint_angle.shape[0]), _PIECE):
        part = slice(first, first + _PIECE)
        pair = mobius.partial_products(chain.joint_angle[part], turn_before[part])[-1]
        for place, values in zip(room, plain.extremes(pair), strict=True):
            place.reshape(-1)[part] = values


def _compiled(chain: Chain, room: tuple[Array, ...], *, threads: int | None) -> None:
    places = [place.reshape(-1) for place in room]

    def work(first: int, last: int) -> None:
        compiled().kernel(
            chain.joint_angle, chain.plane_twist, chain.yoke_angle, chain.start_phase, first, last, *places
        )

    share(work, int(chain.joint_angle.shape[0]), threads=threads, least=_PIECE)
