"""What Mathieu's equation says of a drive with elastic shafts: the book's parameters, put right.

Two inertias at the ends, n joints, n + 1 springs and nothing heavy between them. The twist y between the ends obeys
y'' + (a - 2q cos 2(φ + δ_0)) y = forcing. The book's q is half of what it should be: it lets the first joint turn
evenly, where it is the common centre of inertia that does.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.errors import Problem, check
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.periodic.mathieu import boundaries
from cardan.texts import _

REPEATS = 200
"""Repetitions at most that find where a ray crosses a boundary."""


@dataclass(frozen=True, eq=False, kw_only=True)
class MathieuReduction:
    """Parameters of Mathieu's equation of a drive with massless joints."""

    joint_angle: Array  # joint_angle, phase (n,) [rad]: α_k and ψ_k of the joints
    phase: Array  # (n,) [rad]
    springs: Array  # (n + 1,) [N·m/rad]: c_1 … c_(n+1), before, between and behind the joints
    first_inertia: float  # first_inertia, last_inertia [kg m²]: J_1, J_(n+1)
    last_inertia: float  # [kg m²]
    speed: float  # [rad/s]: mean speed ω_1

    @property
    def tau(self) -> Array:
        """c_k1 = tan²(α_k/2), array (n,)."""
        return np.tan(0.5 * self.joint_angle) ** 2

    @property
    def arms(self) -> Array:
        """c_k1 e^(2iψ̄_k), complex array (n,): what each joint adds to A + iB."""
        turned = np.concatenate(([0.0], np.cumsum(self.tau * np.sin(2.0 * self.phase))[:-1]))
        return np.asarray(self.tau * np.exp(2j * (self.phase - turned)))

    @property
    def lag(self) -> float:
        """Θ_n: by how much the output falls back from its start position on the mean [rad]."""
        return float(np.sum(self.tau * np.sin(2.0 * self.phase)))

    @property
    def forcing(self) -> complex:
        """A + iB = s_n1 e^(2iδ_1) [rad]."""
        return complex(np.sum(self.arms))

    @property
    def play(self) -> complex:
        """D + iF [rad/(N·m)]."""
        return complex(2.0 * np.sum(self.arms * np.cumsum(1.0 / self.springs)[:-1]))

    @property
    def amplitude(self) -> float:
        """s_n1 [rad]: the joints' sway of second order at the output, were the shafts rigid."""
        return abs(self.forcing)

    @property
    def forcing_phase(self) -> float:
        """δ_1 [rad]."""
        return float(0.5 * np.angle(self.forcing))

    @property
    def stiffness(self) -> float:
        """Stiffness c of all springs in a row [N·m/rad]."""
        return float(1.0 / np.sum(1.0 / self.springs))

    @property
    def inertia(self) -> float:
        """J_0 = J_1 J_(n+1)/(J_1 + J_(n+1)) [kg m²]."""
        return self.first_inertia * self.last_inertia / (self.first_inertia + self.last_inertia)

    @property
    def natural_frequency(self) -> float:
        """ω_e = √(c/J_0) [rad/s]."""
        return float(np.sqrt(self.stiffness / self.inertia))

    @property
    def a(self) -> float:
        """Parameter a = c/(J_0 ω_1²)."""
        return (self.natural_frequency / self.speed) ** 2

    @property
    def share(self) -> Array:
        """Share σ_k of the twist that lies before each joint, array (n,)."""
        return self.stiffness * np.cumsum(1.0 / self.springs)[:-1]

    @property
    def off_node(self) -> Array:
        """κ_k: where each joint stands from the node of the elastic mode, a share of the twist, array (n,)."""
        return self.share - self.last_inertia / (self.first_inertia + self.last_inertia)

    @property
    def wave(self) -> complex:
        """Phasor q e^(2iδ_0) as it should be."""
        return complex(2.0 * self.a * np.sum(self.arms * self.off_node))

    @property
    def q(self) -> float:
        """Parameter q as it should be: twice the book's."""
        return abs(self.wave)

    @property
    def q_book(self) -> float:
        """Parameter q by Book (196)."""
        return 0.5 * abs(self.wave)

    @property
    def wave_phase(self) -> float:
        """δ_0 [rad]."""
        return float(0.5 * np.angle(self.wave))

    def zone_speeds(self, zone: int = 1) -> tuple[float, float]:
        """Return the speeds between which steady running is unstable without damping [rad/s].

        zone: 1 is the principal zone, about ω_e; zone r lies about ω_e/r.
        Another speed moves (a, q) along the ray through the origin: a = a_r(q), b_r(q) with q = a (q/a), found by
        repetition.
        """
        slope = self.q / self.a
        ends = []
        for which in (0, 1):
            a = float(zone * zone)
            for _round in range(REPEATS):
                before, a = a, float(boundaries(slope * a, zone)[which][-1])
                if abs(a - before) <= 1e-14 * a:
                    break
            ends.append(self.natural_frequency / np.sqrt(a))
        return float(ends[0]), float(ends[1])


def mathieu_reduction(
    joint_angle: ArrayLike,
    phase: ArrayLike,
    springs: ArrayLike,
    *,
    first_inertia: float,
    last_inertia: float,
    speed: float,
) -> MathieuReduction:
    """Return the parameters of Mathieu's equation of a drive with massless joints between two inertias.

    Parameters
    ----------
    joint_angle, phase : arrays (n,) [rad]
        α_k and ψ_k of the joints.
    springs : array (n + 1,) [N·m/rad]
        c_1 … c_(n+1).
    first_inertia, last_inertia : float [kg m²]
        J_1, J_(n+1).
    speed : float [rad/s]
        Mean speed ω_1.

    Returns
    -------
    MathieuReduction

    Raises
    ------
    InputError
        Lists that do not fit one another, bends outside [0°, 90°), values that are not positive.

    Notes
    -----
    Book (195), (196): A + iB = Σ c_k1 e^(2iψ̄_k), ψ̄_k = ψ_k - Θ_(k-1), c_k1 = tan²(α_k/2). The book's X and Y come to
    q_book e^(2iδ_0) = a Σ c_k1 κ_k e^(2iψ̄_k) with κ_k = Σ_{i≤k} c/c_i - J_(n+1)/(J_1 + J_(n+1)); q is twice that.
    A joint in the node of the elastic mode, κ_k = 0, gives nothing to q. Of first order in c_k1, the static twist
    neglected.

    Examples
    --------
    >>> from cardan.units import deg, rpm
    >>> values = {"first_inertia": 1.0, "last_inertia": 0.4, "speed": 500 * rpm}
    >>> found = mathieu_reduction([20 * deg], [0.0], [1000.0, 4000.0], **values)
    >>> print(f"{found.a:.4f} {found.q_book:.5f} {found.q:.5f} {found.off_node}")
    1.0213 0.01633 0.03266 [0.51428571]
    """
    alpha, psi, springs = (np.atleast_1d(np.asarray(value, dtype=float)) for value in (joint_angle, phase, springs))
    check(
        [
            *([] if alpha.size else [Problem("joint_angle", _("an empty list has no joint"))]),
            *_fits("phase", psi.size, alpha.size),
            *_fits("springs", springs.size, alpha.size + 1),
            *_within(
                "joint_angle", alpha, (alpha >= 0.0) & (alpha < 0.5 * np.pi), _("a joint angle lies in [0°, 90°)")
            ),
            *_within("phase", psi, np.isfinite(psi), _("needs to be finite")),
            *_within("springs", springs, (springs > 0.0) & np.isfinite(springs), _("needs to be positive")),
            *(
                Problem(name, _("needs to be positive"))
                for name, value in (("first_inertia", first_inertia), ("last_inertia", last_inertia), ("speed", speed))
                if not (np.isfinite(value) and value > 0.0)
            ),
        ]
    )
    return MathieuReduction(
        joint_angle=alpha,
        phase=psi,
        springs=springs,
        first_inertia=float(first_inertia),
        last_inertia=float(last_inertia),
        speed=float(speed),
    )


def _fits(name: str, given: int, wanted: int) -> list[Problem]:
    text = _("{given} values given, {wanted} needed")
    return [] if given == wanted else [Problem(name, text.format(given=given, wanted=wanted))]


def _within(name: str, values: Array, right: Array, text: str) -> list[Problem]:
    return [
        Problem(f"{name}[{k}]", _("{value:g} given; {text}").format(value=values[k], text=text))
        for k in np.flatnonzero(~right)
    ]
