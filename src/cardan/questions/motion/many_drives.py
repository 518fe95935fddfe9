"""How do the outputs of many drives turn, position by position?"""

from __future__ import annotations

from dataclasses import dataclass
from math import prod

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.drives import Drives, kinematics
from cardan.drive.models.kinematics_model import Chain
from cardan.errors import refuse
from cardan.later import later
from cardan.maths.arrays import Array, ArrayLike, namespace, real, unit_complex
from cardan.maths.compiled import plain
from cardan.maths.compiled.method import Compiled, Method, buffers, chosen, share
from cardan.texts import _

from .motion import positions

compiled = later("cardan.maths.compiled.traces")

LARGE = 10_000_000
"""Values of each output that are worth loading the kernel: half a second in a new process, two when first compiled."""

_THREAD = 100_000
"""Values of each output that are worth a thread."""

_CACHE = 16_000
"""Values of each output for which the plain form stays in the caches."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Traces:
    """Motion of the output shafts of many drives; leading axes are those of the drives.

    Attributes
    ----------
    angle : array (p,) [rad]
        Input angle φ_1 from the start position.
    output_angle : array (..., p) [rad]
        φ_{n+1}, continuous over any number of turns, zero at the start.
    ratio : array (..., p)
        ω_{n+1}/ω_1.
    acceleration : array (..., p) [rad/s²]
        ε_{n+1}.
    """

    angle: Array
    output_angle: Array
    ratio: Array
    acceleration: Array


def traces(
    drives: Drives | Drive | Chain,
    angle: ArrayLike | None = None,
    *,
    speed: ArrayLike | None = None,
    acceleration: ArrayLike | None = None,
    out: Traces | None = None,
    method: Method | None = None,
) -> Traces:
    """Return output angle, speed ratio and acceleration of many drives, exactly.

    Where `motion` returns every shaft, this returns the output alone, and large jobs run at the speed of the memory
    that takes the results.

    Parameters
    ----------
    drives : Drives (...)
        The drives.
    angle : array (p,) [rad], optional
        Input angle φ_1 from the start position; one turn in steps of a degree by default.
    speed : float or array (...) [rad/s], optional
        Input speed; that of a single drive's duty by default, else 1 rad/s, so that the acceleration is that per ω_1².
    acceleration : float or array (...) [rad/s²], optional
        Input acceleration; that of a single drive's duty by default, else zero.
    out : Traces, optional
        Results of an earlier call of the same size, to be written over: fresh memory costs more than the arithmetic.
    method : Plain or Compiled, optional
        Compiled by default from ten million values on, where numba is installed; small jobs never wait for it.

    Returns
    -------
    Traces
        output_angle, ratio, acceleration : arrays (..., p).

    Raises
    ------
    InputError
        ``out`` has not the size of the results.

    See Also
    --------
    motion, extremes

    Notes
    -----
    The drive's Möbius pair (a, b), then for each position k = b̄ w + ā, w = e^(2iφ_1): ratio 1/\\|k\\|², angle
    φ_1 - arg(k/ā), slope 4 Im(k̄ b̄ w)/\\|k\\|⁴. The compiled and the plain form agree to about 1e-14 of the largest
    value below 80 degrees of equivalent angle; they round differently.

    Examples
    --------
    >>> from cardan.sweeps import Drives, traces
    >>> batch = Drives.from_angles([[0.2, 0.2], [0.3, 0.2]], yoke_angle=[[0.0], [0.0]])
    >>> traces(batch, [0.0, 1.0]).ratio
    array([[1.        , 1.        ],
           [1.02588626, 0.98915572]])
    """
    chain = kinematics(drives)
    xp = namespace(chain.joint_angle, angle)
    phi = positions(angle, xp)
    duty = drives.duty if isinstance(drives, Drive) else None
    outer = tuple(chain.joint_angle.shape[:-1])
    omega = _each(speed, duty.speed if duty else None, 1.0, outer, xp)
    epsilon = _each(acceleration, duty.acceleration if duty else None, 0.0, outer, xp)
    shape = (*outer, int(phi.shape[0]))
    size = prod(shape)
    how = chosen(method, xp, size >= LARGE)
    if xp is not np:
        if out is not None:
            raise refuse("out", _("only results held in NumPy arrays can be written over"))
        return _written(phi, plain.traces(chain.products()[-1], phi, omega, epsilon, unit_complex(2.0 * phi)))
    room = buffers(("output_angle", "ratio", "acceleration"), shape, out)
    if size:
        job = (rows_of(chain), phi, omega.reshape(-1), epsilon.reshape(-1), room)
        if isinstance(how, Compiled):
            _compiled(*job, threads=how.threads)
        else:
            _plain(*job)
    return _written(phi, room)


def _written(angle: Array, results: tuple[Array, ...]) -> Traces:
    return Traces(angle=angle, output_angle=results[0], ratio=results[1], acceleration=results[2])


def _each(given: ArrayLike | None, own: float | None, default: float, outer: tuple[int, ...], xp: object) -> Array:
    value = given if given is not None else own if own is not None else default
    return xp.broadcast_to(real(value, xp), outer)  # type: ignore[attr-defined]


def rows_of(chain: Chain) -> Chain:
    """Return a chain with one leading axis."""
    n, outer = chain.joints, chain.joint_angle.shape[:-1]
    rows = prod(outer)
    return Chain(
        joint_angle=chain.joint_angle.reshape(rows, n),
        plane_twist=np.broadcast_to(chain.plane_twist, (*outer, n - 1)).reshape(rows, n - 1),
        yoke_angle=np.broadcast_to(chain.yoke_angle, (*outer, n - 1)).reshape(rows, n - 1),
        start_phase=np.broadcast_to(chain.start_phase, outer).reshape(rows),
    )


def _plain(chain: Chain, phi: Array, speed: Array, acceleration: Array, room: tuple[Array, ...]) -> None:
    w = unit_complex(2.0 * phi)
    rows = int(chain.joint_angle.shape[0])
    a, b = chain.products()[-1]
    piece = max(1, _CACHE // phi.size)
    for first in range(0, rows, piece):
        part = slice(first, first + piece)
        found = plain.traces((a[part], b[part]), phi, speed[part], acceleration[part], w)
        for place, values in zip(room, found, strict=True):
            place.reshape(rows, phi.size)[part] = values


def _compiled(
    chain: Chain, phi: Array, speed: Array, acceleration: Array, room: tuple[Array, ...], *, threads: int | None
) -> None:
    shared = compiled().position_arrays(phi)
    places = [place.reshape(-1) for place in room]

    def work(first: int, last: int) -> None:
        compiled().kernel(
            *(chain.joint_angle, chain.plane_twist, chain.yoke_angle, chain.start_phase, speed, acceleration),
            *(*shared, phi.size, first, last, *places),
        )

    share(work, int(chain.joint_angle.shape[0]), threads=threads, least=max(1, _THREAD // phi.size))
