"""How does a straight line of shafts vibrate in torsion? Natural frequencies, the speeds they fall on, forced response.

Without bends a drive is a chain of stations joined by elements, and linear. With joint angles this is where to begin:
joints swing twice a turn, and the line shows at which speeds that meets a natural frequency.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.errors import Problem, check
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.compiled.method import Method
from cardan.maths.linear import tridiagonal
from cardan.texts import _


@dataclass(frozen=True, eq=False, kw_only=True)
class LineModes:
    """Natural frequencies and modes of straight lines, the slowest first."""

    # (..., n) [rad/s]: natural frequencies; 0 for the turning of a line that nothing holds, infinite for each station
    # without inertia
    omega: Array
    shape: Array  # (..., n, n): angle of each station in each mode, a mode a row; the largest is 1
    inertia: Array  # (..., n) [kg·m²]: of the stations
    # (...): largest step of a Holzer table down the modes that does not meet the next station, over the largest angle
    residual: Array

    @property
    def order2_speed(self) -> Array:
        """Speed at which two swings a turn meet each natural frequency, ω/2: array (..., n) [rad/s]."""
        return 0.5 * self.omega

    @property
    def parametric_speed(self) -> Array:
        """Speed of the principal zone of parametric resonance of each natural frequency, ω: array (..., n) [rad/s]."""
        return self.omega

    @property
    def modal_inertia(self) -> Array:
        """Inertia of each mode for unit angle at each station, array (..., n, n) [kg·m²]; infinite at a node.

        What an absorber at that station meets: its inertia ratio is its own inertia over this.
        """
        energy = np.sum(self.inertia[..., None, :] * self.shape**2, axis=-1)[..., None]
        with np.errstate(divide="ignore"):
            found: Array = energy / self.shape**2
        return found


def line_modes(inertia: ArrayLike, stiffness: ArrayLike, *, ground: ArrayLike = 0.0) -> LineModes:
    """Return natural frequencies and modes of straight lines.

    Parameters
    ----------
    inertia : array (..., n) [kg·m²]
        J of each station, at least 0 and not all 0.
    stiffness : array (..., n-1) [N·m/rad]
        c of each element, positive.
    ground : array (..., n) or number [N·m/rad]
        Stiffness from each station to the ground; a line held at an end has its spring here.

    Returns
    -------
    LineModes

    Raises
    ------
    InputError
        Values out of range, lists that do not fit, a line without any inertia.

    Notes
    -----
    (K - ω²J) x = 0, spec of torsion with all joint angles 0: ratio 1 at every joint. ω keeps full relative accuracy,
    see `cardan.maths.linear.tridiagonal.modes`.

    Examples
    --------
    >>> found = line_modes([2.0, 0.6], [900.0])
    >>> print(found.omega, found.order2_speed[1] * 30 / np.pi)
    [ 0.         44.15880433] 210.84275971
    """
    j, c, g = (np.asarray(one, dtype=float) for one in (inertia, stiffness, ground))
    check(_problems(j, c, {"ground": (g, 0)}))
    omega, shape = tridiagonal.modes(j, c, g)
    largest = np.max(np.abs(shape), axis=-1, keepdims=True)
    shape = shape / np.where(np.isfinite(largest), largest, 1.0)
    real = np.isfinite(omega)
    square = np.where(real, omega, 0.0)[..., None] ** 2
    pull = square * j[..., None, :] - g * np.ones_like(j)[..., None, :]
    torque = np.cumsum(pull * np.where(real[..., None], shape, 0.0), axis=-1)[..., :-1]
    step = np.where(real[..., None], np.diff(shape, axis=-1) + torque / c[..., None, :], 0.0)
    return LineModes(
        omega=omega,
        shape=shape,
        inertia=np.broadcast_to(j, omega.shape),
        residual=np.max(np.abs(step), axis=(-2, -1), initial=0.0),
    )


@dataclass(frozen=True, eq=False, kw_only=True)
class LineResponse:
    """Steady vibration of straight lines under harmonic torques."""

    omega: Array  # (f,) [rad/s]: frequencies
    angle: Array  # (..., n, f) [rad], complex: amplitude and phase of each station
    torque: Array  # (..., n-1, f) [N·m], complex: in each element, positive where it passes power on
    # (..., f) of bool: the frequency is a natural one and nothing damps it: no steady vibration, all values nan
    resonant: Array
    # (..., f): what the balance of power misses: put in by the torques less lost in damping, over the largest product
    # of torque and speed
    residual: Array


def line_response(
    inertia: ArrayLike,
    stiffness: ArrayLike,
    omega: ArrayLike,
    torque: ArrayLike,
    *,
    damping: ArrayLike = 0.0,
    loss_factor: ArrayLike = 0.0,
    ground: ArrayLike = 0.0,
    ground_damping: ArrayLike = 0.0,
    attached: ArrayLike | None = None,
    method: Method | None = None,
) -> LineResponse:
    """Return the steady vibration of straight lines under harmonic torques, at many frequencies at once.

    Parameters
    ----------
    inertia : array (..., n) [kg·m²]
        J of each station, at least 0.
    stiffness : array (..., n-1) [N·m/rad]
        c of each element, positive.
    omega : array (f,) [rad/s]
        Frequencies of the torque, at least 0.
    torque : complex array (..., n) [N·m]
        Amplitude and phase of the torque at each station.
    damping : array (..., n-1) or number [N·m·s/rad]
        b of each element.
    loss_factor : array (..., n-1) or number
        η of each element: structural damping, the same share of energy lost at every frequency.
    ground, ground_damping : arrays (..., n) or numbers [N·m/rad], [N·m·s/rad]
        From each station to the ground.
    attached : complex array (..., n, f), optional [N·m/rad]
        Dynamic stiffness of what hangs on each station, such as that of
        `cardan.formulas.absorbers.absorber_stiffness`.
    method : Plain or Compiled, optional
        Compiled by default from a million stations times frequencies on.

    Returns
    -------
    LineResponse

    Raises
    ------
    InputError
        Values out of range or lists that do not fit.

    Notes
    -----
    Each element has the complex stiffness c(1 + iη) + iωb. A loss factor has a meaning for harmonic vibration
    only; in time b = ηc/ω at one frequency stands for it.

    Examples
    --------
    >>> found = line_response([1.5, 0.05, 0.8], [8000.0, 4000.0], [60.0], [1.0, 0.0, 0.0], loss_factor=[0.02, 0.05])
    >>> abs(found.torque[:, 0]), bool(found.residual[0] < 1e-12)
    (array([1.17886063, 1.1584548 ]), True)
    """
    j, c, w, b, eta, g, gd = (
        np.asarray(one, dtype=float)
        for one in (inertia, stiffness, omega, damping, loss_factor, ground, ground_damping)
    )
    load = np.asarray(torque, dtype=complex)
    more = {"damping": (b, -1), "loss_factor": (eta, -1), "ground": (g, 0), "ground_damping": (gd, 0)}
    check([*_problems(j, c, more, load), *_frequencies(w)])
    coupling = c * (1.0 + 1j * eta) if np.any(eta) else c
    found = tridiagonal.response(
        j, coupling, w, load, drag=b, ground=g, ground_drag=gd, attached=attached, method=method
    )
    return LineResponse(
        omega=w,
        angle=found.displacement,
        torque=found.flow,
        resonant=found.resonant,
        residual=_balance(found, w, load, (coupling, b), (g, gd), attached),
    )


def _balance(
    found: tridiagonal.Response,
    omega: Array,
    load: Array,
    elements: tuple[Array, Array],
    grounds: tuple[Array, Array],
    attached: ArrayLike | None,
) -> Array:
    """Return what is put in and not lost, over the largest product of torque and angle at any station."""
    moved = found.displacement
    stiffness, damping = (one[..., None] if one.ndim else one for one in elements)
    carried = stiffness + 1j * omega * damping
    lost = np.sum(np.abs(found.flow / carried) ** 2 * carried.imag, axis=-2)
    hung = grounds[0][..., None] + 1j * omega * grounds[1][..., None]
    hung = hung + (0.0 if attached is None else np.asarray(attached))
    lost = lost + np.sum(np.abs(moved) ** 2 * np.asarray(hung).imag, axis=-2)
    given = load[..., None] * np.conj(moved)
    size = np.max(np.abs(given), axis=-2)
    return np.abs(np.sum(given, axis=-2).imag - lost) / np.where(size > 0.0, size, 1.0)


def _frequencies(omega: Array) -> list[Problem]:
    if omega.ndim == 1 and np.all(np.isfinite(omega)) and np.all(omega >= 0.0):
        return []
    return [Problem("omega", _("a list of numbers, none of them negative, is needed"))]


def _problems(
    inertia: Array, stiffness: Array, more: dict[str, tuple[Array, int]], torque: Array | None = None
) -> list[Problem]:
    """Return what is wrong with a line: signs, lengths of lists, no inertia."""
    found = []
    n = inertia.shape[-1] if inertia.ndim else 0
    if not n:
        found.append(Problem("inertia", _("a line has one station at least")))
    elif not np.all(np.isfinite(inertia) & (inertia >= 0.0)):
        found.append(Problem("inertia", _("negative or not finite")))
    elif not np.all(np.any(inertia > 0.0, axis=-1)):
        found.append(Problem("inertia", _("no station has inertia")))
    if not np.all(np.isfinite(stiffness) & (stiffness > 0.0)):
        found.append(Problem("stiffness", _("not positive or not finite")))
    for name, (values, _less) in more.items():
        if not np.all(np.isfinite(values) & (values >= 0.0)):
            found.append(Problem(name, _("negative or not finite")))
    if torque is not None and not np.all(np.isfinite(torque)):
        found.append(Problem("torque", _("not finite")))
    text = _("{given} values given, {wanted} needed")
    lists = {"stiffness": (stiffness, -1)} | {name: one for name, one in more.items() if one[0].ndim}
    lists |= {} if torque is None else {"torque": (torque, 0)}
    for name, (values, less) in lists.items():
        given = values.shape[-1] if values.ndim else 1
        if n and given != n + less:
            found.append(Problem(name, text.format(given=given, wanted=n + less)))
    return found
