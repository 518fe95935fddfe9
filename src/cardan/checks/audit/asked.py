"""What the questions answer about one drive as drawn, each asked once and not before a pair of answers needs it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeVar

import numpy as np

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.load_case import Case
from cardan.checks.moving import stopped, worst_of_poses
from cardan.checks.verdict import Verdict
from cardan.drive.drive import Drive
from cardan.drive.models.dynamics_model import Train, train
from cardan.errors import InputError
from cardan.maths.arrays import Array
from cardan.questions.bending.balance import Balance, balance
from cardan.questions.bending.bending import CriticalSpeeds, bending_speeds
from cardan.questions.bending.rotor import Rotor, rotor
from cardan.questions.forces.assembly import AssemblyForces, assembly
from cardan.questions.forces.forces import Forces, forces
from cardan.questions.life.life import life
from cardan.questions.life.lives import Life
from cardan.questions.losses.losses import Losses, losses
from cardan.questions.mobility.mobility import Mobility, mobility
from cardan.questions.motion.articulation import Articulation, articulation
from cardan.questions.motion.motion import Motion, motion
from cardan.questions.motion.turning import Evenness, each_shaft
from cardan.questions.phases.phases import Phasing, phases
from cardan.questions.torsion.model.answer import lacking
from cardan.questions.torsion.model.excitation import forced_run_up
from cardan.questions.torsion.road.answer import lacking as road_lacking
from cardan.questions.torsion.road.road import RoadTorsion, road_torsion
from cardan.questions.torsion.steady.pendulum_swing import pendulum_swing
from cardan.questions.torsion.steady.run_stability import Verdict as Stability
from cardan.questions.torsion.steady.torsion_response import TorsionResponse, torsion_response
from cardan.questions.torsion.transient.run_up_answer import FollowedRunUp, follow
from cardan.questions.torsion.transient.torsion_transient import Transient, transient
from cardan.units import deg

T = TypeVar("T")

TURNS, FEW = 2, 257
"""Turns in which a steady motion repeats, and samples of a simulation, whose extremes are found between them."""

NEAR = 0.5 * deg
"""Swing of a pendulum that is small."""


def _told(ask: Callable[[], T]) -> T | None:
    """Return an answer, None where the file does not let it be told."""
    try:
        return ask()
    except InputError:
        return None


@dataclass(frozen=True, eq=False, kw_only=True)
class Asked:
    """A drive and what each question answers about it, as it stands in its duty; None where it does not answer."""

    design: Design  # of one drive

    @cached_property
    def here(self) -> Design:
        """The design as drawn: without poses and movements."""
        whole = self.design
        if not whole.drive.poses and not whole.drive.movements:
            return whole
        return replace(whole, drive=replace(whole.drive, poses=(), movements=()))

    @property
    def drive(self) -> Drive:
        """The drive as drawn: without poses and movements."""
        return self.here.drive

    def verdicts(self, check: Check, *, moving: bool = False) -> Sequence[Verdict]:
        """Return those of the verdicts of a check on the drive as drawn, or where it moves, that were reached."""
        found = tuple(check.verdicts(self.here))
        if moving:
            moves = replace(self.design, drive=replace(self.design.drive, poses=()))
            there = stopped(moves, lambda one: tuple(check.verdicts(one)))
            found = worst_of_poses(found, [(said, verdicts) for said, verdicts, _time in there])
        return [one for one in found if one.run]

    @property
    def moving(self) -> Design:
        """The design with its movements, but as drawn: without poses."""
        return replace(self.design, drive=replace(self.design.drive, poses=()))

    @property
    def case(self) -> Case | None:
        """The duty itself among the ways to run; None where it has no torque."""
        return next((one for one in self.here.loaded if not one.name and not one.block), None)

    @cached_property
    def motion(self) -> Motion:
        """How every shaft turns."""
        return motion(self.drive)

    @cached_property
    def even(self) -> Evenness:
        """How uniformly every shaft turns."""
        return each_shaft(self.drive)

    @cached_property
    def articulation(self) -> Articulation | None:
        """What happens while it moves; None where it does not move."""
        moving = replace(self.design.drive, poses=())
        return _told(lambda: articulation(moving)) if moving.movements else None

    @cached_property
    def phasing(self) -> Phasing | None:
        """What its yokes can do."""
        return _told(lambda: phases(self.drive, poses={}))

    @cached_property
    def train(self) -> Train | None:
        """Its points, masses and supports."""
        return _told(lambda: train(self.drive, kinds=True))

    @cached_property
    def forces(self) -> Forces | None:
        """What its parts carry."""
        return _told(lambda: forces(self.drive))

    @cached_property
    def losses(self) -> Losses | None:
        """What it turns to heat."""
        return _told(lambda: losses(self.drive))

    @cached_property
    def life(self) -> Life | None:
        """How long its joints last."""
        return _told(lambda: life(self.drive))

    @cached_property
    def response(self) -> TorsionResponse | None:
        """How it vibrates in torsion at the speed of its duty."""
        if lacking(self.drive) or not self.drive.duty.speed:
            return None
        return _told(lambda: torsion_response(self.drive))

    @cached_property
    def simulated(self) -> Transient | None:
        """The same in time, over two turns from the steady motion, where that repeats in them and keeps to itself."""
        found = self.response
        if found is None or found.apart or found.beside or not bool(np.all(found.steady.found)):
            return None
        if int(found.floquet.verdict) != Stability.STABLE or np.any(pendulum_swing(found) > NEAR):
            return None  # a pendulum that swings wider is not the one that is counted, and that is told
        duty = replace(self.drive.duty, run_up=None)
        span = TURNS * 2.0 * math.pi / abs(float(found.speed))
        return _told(lambda: transient(self.drive, duty, span=span, times=FEW, start="settled"))

    @cached_property
    def run_up(self) -> FollowedRunUp | None:
        """Its run-up in time; None where torques turn its input."""
        course = forced_run_up(self.drive, self.drive.duty)
        if course is None or lacking(self.drive):
            return None
        return _told(lambda: follow(self.drive, course))

    @cached_property
    def road(self) -> RoadTorsion | None:
        """How it vibrates in torsion at every instant of its movement; None where it does not move."""
        moving = replace(self.design.drive, poses=())
        return None if road_lacking(moving) else _told(lambda: road_torsion(moving, progress=lambda _share: "stop"))

    @cached_property
    def bending(self) -> CriticalSpeeds | None:
        """Its critical speeds in bending."""
        return _told(lambda: bending_speeds(self.drive))

    @cached_property
    def rotor(self) -> Rotor | None:
        """Its shaft that whirls first, as a mass on a spring."""
        return _told(lambda: rotor(self.drive))

    @cached_property
    def balance(self) -> Balance | None:
        """How well its shafts must be balanced."""
        return _told(lambda: balance(self.drive, known=self.design.known))

    @cached_property
    def mobility(self) -> Mobility | None:
        """How it can move, and what holds it twice."""
        return _told(lambda: mobility(self.drive))

    @cached_property
    def assembly(self) -> AssemblyForces | None:
        """What it carries because its parts do not fit."""
        return _told(lambda: assembly(self.drive))


def of_parts(kind: str, values: Array | Sequence[float], first: int = 1) -> Mapping[str, float]:
    """Return values by the part they are of, counted from ``first``.

    >>> of_parts("shafts", [1.0, 2.0])
    {'shafts[0]': 1.0, 'shafts[1]': 2.0}
    """
    return {f"{kind}[{k + first - 1}]": float(one) for k, one in enumerate(values)}
