"""Everything the report asks about a drive, each once and not before a page needs it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from cardan.book.evidence import SelfCheck, evidence, swing_by_vectors
from cardan.catalogue import Catalogue
from cardan.catalogue.completion import sized
from cardan.drive.bodies.solids import Solids, solids
from cardan.drive.conditions import in_poses
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.models.geometry import Geometry, geometry
from cardan.drive.models.kinematics_model import Chain, as_hooke, mixed, turning_chain, unlike_hooke
from cardan.errors import InputError
from cardan.maths.arrays import Array
from cardan.questions.motion.articulation import Articulation
from cardan.questions.motion.equivalence import (
    SYNCHRONOUS,
    Closure,
    EquivalentJoint,
    closure,
    equivalent_joint,
    is_rounding,
)
from cardan.questions.motion.motion import initial_phases, motion
from cardan.questions.motion.turning import Evenness, swing
from cardan.questions.phases.phases import Phasing, phases
from cardan.questions.phases.setting import YokeSetting
from cardan.register import QUESTIONS

Progress = Callable[[float], object]

ALONE = 12  # in drives with more joints than this, single yokes are not tried one by one


@dataclass(frozen=True, eq=False, kw_only=True)
class Subject:
    """A drive and what the first and the last page tell of it, each calculated when it is read first.

    All else is asked through `cardan.register.QUESTIONS`, of the drive itself.
    """

    drive: Drive  # the drive with the duty asked for
    # what its yokes can do, where somebody watched the search for it; None to search when it is needed
    watched: Phasing | None = None
    complete: bool = True  # False when the reader stopped the work; what was found by then is shown
    known: Catalogue | None = None  # norms, types and sizes that it is judged by; None for the shipped ones

    @cached_property
    def place(self) -> Geometry:
        """Where everything is."""
        return geometry(self.drive)

    @cached_property
    def train(self) -> Chain:
        """The Hooke joints that turn like its joints."""
        return turning_chain(self.drive)

    @cached_property
    def seen(self) -> Solids:
        """What it looks like."""
        return solids(sized(self.drive, self.known))

    @cached_property
    def whole(self) -> EquivalentJoint:
        """The one joint that it amounts to."""
        return equivalent_joint(self.drive)

    @cached_property
    def evenness(self) -> Evenness:
        """How even its shafts turn, of joints of any kinds."""
        return swing(self.drive) if self.by_laws else self.whole

    @property
    def fluctuation(self) -> float:
        """Speed fluctuation of its output."""
        return float(np.ravel(self.evenness.speed_fluctuation)[-1])

    @cached_property
    def phase(self) -> Array:
        """Phase angle of every joint, array (n) [rad]."""
        if self.by_laws:
            return np.asarray(motion(self.drive, [0.0]).yoke_rotation[:, 0])
        return np.asarray(initial_phases(self.drive))

    @cached_property
    def phasing(self) -> Phasing:
        """What its yokes can do."""
        found: Phasing = QUESTIONS["phasing"].ask(self.drive) if self.watched is None else self.watched
        return found

    @cached_property
    def closing(self) -> Closure:
        """Whether its joint angles can be closed to a polygon."""
        return closure(self.drive)

    @cached_property
    def checks(self) -> tuple[SelfCheck, ...]:
        """What speaks for these figures."""
        return evidence(as_hooke(self.drive))

    @cached_property
    def alone(self) -> tuple[tuple[int, YokeSetting], ...]:
        """Best setting when only the yoke of one shaft is turned, the most helpful shaft first."""
        found: list[tuple[int, YokeSetting]] = []
        uneven = not self.phasing.as_built.speed_fluctuation < SYNCHRONOUS
        free = self.phasing.free if uneven and len(self.phasing.free) <= ALONE else ()
        built = {k: shaft.yoke_angle for k, shaft in enumerate(self.drive.shafts, start=1)}
        for number in free if len(free) > 1 else ():
            held = {k: built[k] for k in self.phasing.free if k != number}
            best = phases(self.drive, fixed=held, poses={}).settings
            found += [(number, one) for one in best[:1]]
        return tuple(sorted(found, key=lambda pair: pair[1].speed_fluctuation))

    @cached_property
    def replayed(self) -> float | None:
        """Swing of the output's ratio at the best setting, by plain vectors."""
        return None if self.best is None else swing_by_vectors(as_hooke(self.drive), self.best.yoke_angle)

    @cached_property
    def moved(self) -> Articulation | InputError | None:
        """What its movement does to it, or why that was not calculated; None where there is none to tell."""
        if not self.drive.movements or not self.complete:
            return None
        try:
            found: Articulation = QUESTIONS["articulation"].ask(self.drive)
        except InputError as error:
            if not self.mixed:
                raise
            return error
        return found

    @property
    def moving(self) -> Articulation | None:
        """What its movement does to it; None when it does not move."""
        return None if isinstance(self.moved, InputError) else self.moved

    @cached_property
    def swept(self) -> tuple[tuple[str, Articulation], ...]:
        """What its movement does to it as drawn and in every pose that can be calculated, with the names of these."""
        if self.moving is None:
            return ()
        found = [("", self.moving)]
        for one in in_poses(self.drive)[1:] if self.drive.poses else ():
            try:
                found.append((one.name, QUESTIONS["articulation"].ask(one.drive)))
            except InputError:
                continue
        return tuple(found)

    @property
    def even(self) -> bool:
        """Whether the drive is synchronous as built."""
        return self.fluctuation < SYNCHRONOUS

    @property
    def rounded(self) -> bool:
        """Whether it is synchronous as built but for the rounding of the figures that describe it."""
        return not self.even and self.rounding(self.fluctuation)

    def rounding(self, share: float) -> bool:
        """Tell whether a fluctuation is no more than rounding, see `is_rounding`."""
        return is_rounding(self.drive, share, self.closing.length)

    @property
    def curable(self) -> bool:
        """Whether another setting of the yokes makes it synchronous, but for rounding."""
        if self.even or self.rounded:
            return False
        return self.phasing.feasible or self.rounding(self.phasing.speed_fluctuation_min)

    @property
    def best(self) -> YokeSetting | None:
        """The best setting, None for a single joint."""
        return self.phasing.settings[0] if self.phasing.settings else None

    @property
    def joint_angle(self) -> Array:
        """Joint angle of every joint, array (n) [rad]."""
        return np.asarray(self.place.joint_angle)

    @property
    def mixed(self) -> bool:
        """Whether any joint is of another kind than Hooke's."""
        return mixed(self.drive.joints)

    @property
    def by_laws(self) -> bool:
        """Whether joints turn by laws of their own, so that no single joint and no polygon of yokes is like it."""
        return unlike_hooke(self.drive)

    @property
    def joints(self) -> int:
        """Number of joints."""
        return len(self.drive.joints)


def asked(drive: Drive, duty: Duty | None, progress: Progress | None) -> Subject:
    """Return a drive to be asked about, the search for its yokes watched.

    duty: what it does, instead of its own duty.
    progress: told the share done; answering "stop" leaves out what is still to do.
    """
    on = Subject(drive=drive if duty is None else replace(drive, duty=duty))
    if progress is None or on.by_laws:
        return on
    stopped = False

    def told(share: float) -> bool:
        nonlocal stopped
        if not stopped:
            stopped = progress(share) == "stop"
        return not stopped

    told(0.0)
    found = phases(on.drive, progress=lambda share: None if told(0.05 + 0.25 * share) else "stop")
    told(0.35)
    return replace(on, watched=found, complete=not stopped)
