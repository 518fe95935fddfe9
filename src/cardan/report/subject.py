"""Everything the report asks about a drive, asked once."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from cardan.analysis.articulation import Articulation, articulation
from cardan.analysis.book import BookComparison, book_comparison
from cardan.analysis.closure import Closure, closure
from cardan.analysis.equivalence import SYNCHRONOUS, EquivalentJoint, after_each_joint, equivalent_joint
from cardan.analysis.evidence import SelfCheck, evidence, swing_by_vectors
from cardan.analysis.motion import Motion, motion, phase_angles
from cardan.catalogue import Catalogue
from cardan.drive.chain import Chain, as_hooke, turning_chain
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.geometry import Geometry, geometry
from cardan.drive.laws import mixed
from cardan.drive.solids import Solids, solids
from cardan.errors import InputError
from cardan.maths.arrays import Array
from cardan.synthesis.phases import Phasing, phases
from cardan.synthesis.setting import YokeSetting

Progress = Callable[[float], object]

ALONE = 12
"""In drives with more joints than this, single yokes are not tried one by one."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Subject:
    """A drive and the answers to all questions about it.

    Attributes
    ----------
    drive : Drive
        The drive with the duty asked for.
    alone : tuple of (int, YokeSetting)
        Best setting when only the yoke of one shaft is turned, the most helpful shaft first.
    replayed : float
        Swing of the output's ratio at the best setting, by plain vectors.
    moving : Articulation or None
        None when the drive does not move.
    unmoved : InputError or None
        Why its movement was not reckoned.
    train : Chain
        The Hooke joints that turn like its joints.
    complete : bool
        False when the reader stopped the work; what was found by then is shown.
    known : Catalogue or None
        Norms, types and sizes that it is judged by; None for the shipped ones.
    """

    drive: Drive
    place: Geometry
    train: Chain
    seen: Solids
    found: Motion
    whole: EquivalentJoint
    each: EquivalentJoint
    phase: Array
    phasing: Phasing
    closing: Closure
    compared: BookComparison
    checks: tuple[SelfCheck, ...]
    alone: tuple[tuple[int, YokeSetting], ...] = ()
    replayed: float | None = None
    moving: Articulation | None = None
    unmoved: InputError | None = None
    complete: bool = True
    known: Catalogue | None = None

    @property
    def even(self) -> bool:
        """Whether the drive is synchronous as built."""
        return float(self.whole.irregularity) < SYNCHRONOUS

    @property
    def curable(self) -> bool:
        """Whether another setting of the yokes makes it synchronous."""
        return not self.even and self.phasing.feasible

    @property
    def best(self) -> YokeSetting | None:
        """The best setting, None for a single joint."""
        return self.phasing.settings[0] if self.phasing.settings else None

    @property
    def bend(self) -> Array:
        """Bend of every joint, array (n) [rad]."""
        return np.asarray(self.place.bend)

    @property
    def mixed(self) -> bool:
        """Whether any joint is of another kind than Hooke's."""
        return mixed(self.drive.joints)

    @property
    def joints(self) -> int:
        """Number of joints."""
        return len(self.drive.joints)


def asked(drive: Drive, duty: Duty | None, progress: Progress | None) -> Subject:
    """Ask every question about a drive.

    Parameters
    ----------
    drive : Drive
        The drive.
    duty : Duty or None
        What it does, instead of its own duty.
    progress : function or None
        Told the share done; answering "stop" leaves out what is still to do.
    """
    whole = drive if duty is None else replace(drive, duty=duty)
    stopped = False

    def told(share: float) -> bool:
        nonlocal stopped
        if not stopped and progress is not None:
            stopped = progress(share) == "stop"
        return not stopped

    def within(low: float, high: float) -> Progress:
        def report(share: float) -> object:
            return None if told(low + (high - low) * share) else "stop"

        return report

    told(0.0)
    phasing = phases(whole, progress=within(0.05, 0.3))
    alone: list[tuple[int, YokeSetting]] = []
    free = phasing.free if not phasing.as_built.irregularity < SYNCHRONOUS and len(phasing.free) <= ALONE else ()
    built = {k: shaft.yoke_angle for k, shaft in enumerate(whole.shafts, start=1)}
    for number in free if len(free) > 1 else ():
        held = {k: built[k] for k in phasing.free if k != number}
        best = phases(whole, fixed=held, poses={}).settings
        alone += [(number, one) for one in best[:1]]
    moving, unmoved = None, None
    if whole.movements and told(0.35):
        try:
            moving = articulation(whole)
        except InputError as error:
            if not mixed(whole.joints):
                raise
            unmoved = error
    law = as_hooke(whole)
    best_yokes = phasing.settings[0].yoke_angle if phasing.settings else None
    return Subject(
        drive=whole,
        place=geometry(whole),
        train=turning_chain(whole),
        seen=solids(whole),
        found=motion(whole),
        whole=equivalent_joint(whole),
        each=after_each_joint(whole),
        phase=np.asarray(phase_angles(whole)),
        phasing=phasing,
        closing=closure(whole),
        compared=book_comparison(whole),
        checks=evidence(law),
        alone=tuple(sorted(alone, key=lambda pair: pair[1].irregularity)),
        replayed=None if best_yokes is None else swing_by_vectors(law, best_yokes),
        moving=moving,
        unmoved=unmoved,
        complete=not stopped,
    )
