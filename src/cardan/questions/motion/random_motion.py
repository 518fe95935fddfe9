"""What random movements make of a drive: mean, deviation, spectrum, and levels that are rarely crossed."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.models.geometry import geometry
from cardan.drive.models.kinematics_model import Chain, unmapped
from cardan.drive.movement import Movement, Random
from cardan.errors import refuse
from cardan.maths.arrays import Array
from cardan.maths.curves import paths
from cardan.maths.curves.normal_coordinates import Chance, chance, grid_of, spectrum
from cardan.maths.kernel import frames
from cardan.texts import _

from .equivalence import equivalent_joint
from .moving_points import random_shifts
from .standing import chain_at

SURE = 6.0
"""Within so many deviations every joint must turn, else nothing is told."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Expected:
    """What one result comes to while a drive moves at random, in SI."""

    # ``joint_angle``, ``length``, ``speed_fluctuation``, ``angle_error``, ``acceleration``; of forces ``couple``,
    # ``shaft_torque``, ``secondary_couple``
    what: str
    number: int  # number of the joint or shaft
    mean: float
    deviation: float
    error: float  # standard error of the mean, where it rests on directions that are drawn; else 0
    high: float  # level that it rises through once in `RandomMotion.span` on average; nan where there is none
    low: float  # level that it falls through once in that time
    held: float  # share of the variance that its spectrum holds


@dataclass(frozen=True, eq=False, kw_only=True)
class RandomMotion:
    """Results of a drive under random movements, as it stands at each instant."""

    span: float  # [s]: longest of the durations that the movements say
    results: tuple[Expected, ...]
    frequency: Array  # (f,) [rad/s]
    density: Array  # (c, f) [unit²·s/rad]: one-sided spectra of the results about their means
    chance: Chance  # for other levels: `Chance.rate`
    resting: tuple[str, ...] = ()  # names of the other movements, which rest meanwhile


Results = Callable[[Array, Chain], dict[tuple[str, int], Array]]
"""From points (p, n+2, 3) [m] and a chain (p, n) to results (p,) by name and number."""


def random_motion(
    drive: Drive, movements: Sequence[Movement] | None = None, results: Results | None = None, *, fewer: int = 1
) -> RandomMotion | None:
    """Return what the random movements of a drive make of its results, all of them at once; None without any.

    movements: those of the drive when not given; results: those of the motion when not given.
    fewer: by how much fewer places do, where results are slow.
    Raises InputError: a joint bends 90° or more within `SURE` deviations.

    The shifts at an instant are independent and normal; a result that follows from where the points are is a function
    of them, see `cardan.maths.curves.normal_coordinates`. Beside them other movements rest.

    >>> from dataclasses import replace
    >>> from cardan.drive.movement import Spectrum
    >>> shake = Random(moves=("output",), axis=(0, 0, 1), deviation=0.01, duration=60.0,
    ...                spectrum=Spectrum(frequency=(5.0, 10.0), density=(1.0, 1.0)))
    >>> drive = replace(Drive.from_points([(0, 0, 0), (1, 0, 0), (2, 0, 0)]), movements=(shake,))
    >>> found = {one.what: one for one in random_motion(drive).results}
    >>> print(f"{found['speed_fluctuation'].mean:.3g} {found['speed_fluctuation'].deviation:.3g}")
    0.0001 0.000141
    """
    every = drive.movements if movements is None else tuple(movements)
    moves = [one for one in every if isinstance(one, Random)]
    if not moves or unmapped(drive.joints):
        return None
    base = np.asarray(geometry(drive).points)
    shifts = random_shifts(len(drive.joints), moves)
    ask = _of_motion(drive) if results is None else results
    grid = grid_of(len(moves), fewer=fewer)
    names: list[tuple[str, int]] = []

    def values(places: Array) -> Array:
        points = base + np.tensordot(places, shifts, axes=1)
        chain, possible = chain_at(drive, points)
        if np.any(~possible & (frames.norm(places) <= SURE)):
            text = _("a joint bends 90° or more within {count} standard deviations of the random movements")
            raise refuse("movements", text.format(count=f"{SURE:.0f}"))
        found = ask(points, chain)
        names[:] = found
        return np.where(possible, np.stack(list(found.values())), 0.0)

    spectra = [(one.spectrum.frequency, one.spectrum.density) for one in moves]
    rates = [math.sqrt(paths.rate_variance(*one) / paths.variance(*one)) for one in spectra]
    found = chance(values, rates, grid)
    frequency, density, held = spectrum(found, spectra)
    span = max(one.duration for one in moves)
    rows = [
        Expected(
            what=what,
            number=number,
            mean=float(found.mean[k]),
            deviation=float(found.deviation[k]),
            error=float(found.error[k]),
            high=found.level(k, 1.0 / span),
            low=found.level(k, 1.0 / span, least=True),
            held=float(held[k]),
        )
        for k, (what, number) in enumerate(names)
    ]
    return RandomMotion(
        span=span,
        results=tuple(rows),
        frequency=frequency,
        density=density,
        chance=found,
        resting=tuple(one.name or one.kind for one in every if not isinstance(one, Random)),
    )


def _of_motion(drive: Drive) -> Results:
    """Return joint angles, lengths between joints, and how unevenly the output turns."""

    def results(points: Array, chain: Chain) -> dict[tuple[str, int], Array]:
        joint_angle = chain.joint_angle if chain.laws is None else chain.laws.joint_angle
        length = frames.norm(np.diff(points, axis=-2))
        whole, n = equivalent_joint(chain), len(drive.joints)
        found = {("joint_angle", i + 1): joint_angle[:, i] for i in range(n)}
        found |= {("length", k + 1): length[:, k] for k in range(1, n)}
        found["speed_fluctuation", n + 1] = whole.speed_fluctuation
        found["angle_error", n + 1] = whole.max_angle_error
        if drive.duty.speed:
            found["acceleration", n + 1] = drive.duty.speed**2 * whole.max_acceleration
        return found

    return results
