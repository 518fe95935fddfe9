"""Strength of the shafts of a drive: stress, fatigue, buckling and twist of their bodies, stress of their splines."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.material import Material
from cardan.drive.shaft import Notch, Shaft
from cardan.formulas.composite_tube import composite_tube
from cardan.formulas.fatigue import Fatigue, shaft_fatigue
from cardan.formulas.shaft_strength import (
    RATED_TWIST,
    ShaftStress,
    polar_moment,
    shaft_stress,
    torsion_modulus,
    wall_buckling_torque,
)
from cardan.formulas.spline_strength import SplineStress, spline_stress
from cardan.maths.arrays import Array
from cardan.maths.ties import foremost
from cardan.questions.forces.turn_loads import LoadCase
from cardan.questions.life.rainflow import rainflow, time_at_level
from cardan.texts import _

from .shaft_body import Stretch, stretches, weight_bending
from .shaft_loads import ShaftLoads
from .strength_use import Use, lacking

SPLINE = ("outer", "root", "teeth", "tooth_width", "length")
"""Sizes that the stresses of a spline need."""


@dataclass(frozen=True, eq=False, kw_only=True)
class ShaftStrength:
    """What a shaft goes through; None where the drive does not say enough.

    Attributes
    ----------
    number : int
        1 is the input shaft.
    torque, bending : float [N·m]
        Largest torque and largest secondary couple over all ways of running, shocks counted.
    weight_bending : float [N·m]
        Largest bending moment of its own weight between its joints; not part of the stresses. nan if not known.
    stress : ShaftStress or None
        Of the stretch that is worst off.
    stretch : int
        Which stretch that is, from 1.
    fatigue : Fatigue or None
        Of the stretch and the way of running with the least safety.
    fatigue_life : float [s]
        Running time until the shaft breaks by Palmgren's and Miner's rule; infinite where it does not, nan where not
        known.
    twist : float [rad]
        Under its largest torque, without shocks; nan where not known.
    spline : SplineStress or None
    buckling_torque : float [N·m]
        Of a tube of composite; else nan.
    """

    number: int
    torque: float
    bending: float
    weight_bending: float = math.nan
    stress: ShaftStress | None = None
    stretch: int = 1
    fatigue: Fatigue | None = None
    fatigue_life: float = math.nan
    twist: float = math.nan
    spline: SplineStress | None = None
    buckling_torque: float = math.nan


def judged_shafts(
    drive: Drive, duty: Duty, cases: Sequence[LoadCase], loads: ShaftLoads
) -> tuple[tuple[ShaftStrength, ...], tuple[Use, ...]]:
    """Return the strength of every shaft, and what it uses of its limits."""
    shafts: list[ShaftStrength] = []
    uses: list[Use] = []
    for k in range(len(drive.joints) + 1):
        one = _Judge(drive, duty, cases, loads, k)
        own = tuple(one.uses())
        shafts.append(one.strength())
        uses += own
    uses += _twist(drive, cases, loads)
    return tuple(shafts), tuple(uses)


@dataclass(frozen=True, eq=False)
class _Judge:
    """One shaft, counted from 0, with what it is judged by."""

    drive: Drive
    duty: Duty
    cases: Sequence[LoadCase]
    loads: ShaftLoads
    k: int

    @property
    def shaft(self) -> Shaft:
        return self.drive.shafts[self.k]

    def made(self, check: str, title: str, **more: Any) -> partial[Use]:
        words = title.format(number=self.k + 1)
        return partial(Use, check=check, part=f"shafts[{self.k}]", title=words, **more)

    def most(self, values: Array) -> tuple[float, str]:
        """Return the largest of values (c, n+1) of this shaft, and which part of the duty it is of."""
        own = values[:, self.k]
        at = int(foremost(own))
        return float(own[at]), self.cases[at].name

    def uses(self) -> Iterator[Use]:
        found = stretches(self.drive, self.k)
        between = 0 < self.k < len(self.drive.joints)
        if self.shaft.layup is not None:
            yield self._buckling()
        else:
            yield from (self._stress(one) for one in found)
            yield from (self._wall(one) for one in found if one.inner > 0.0)
            if found:
                yield self._fatigue(found)
            elif between:
                bare = (f"shafts[{self.k}].outer",)
                yield self.made("tube_strength", _("stress of shaft {number}"), dimension="stress", unit="MPa")(
                    missing=bare
                )
                yield self.made("tube_fatigue", _("safety of shaft {number} against fatigue"))(missing=bare)
        if self.shaft.spline is not None:
            yield from self._spline()

    def _wall(self, stretch: Stretch) -> Use:
        torque, case = self.most(self.loads.torque)
        material = stretch.material
        buckles = wall_buckling_torque(stretch.outer, stretch.inner, material.youngs, material.poisson)
        return self.made(
            "tube_buckling",
            _("torque on the wall of shaft {number}") + stretch.words,
            dimension="torque",
            unit="Nm",
        )(
            value=torque * self.duty.shock_factor,
            limit=float(buckles) / self.drive.limits.safety,
            source=_("buckling of the wall by Timoshenko and Gere, 11.11, over safety"),
            case=case,
        )

    def _stress(self, stretch: Stretch) -> Use:
        made = self.made("tube_strength", _("stress of shaft {number}") + stretch.words, dimension="stress", unit="MPa")
        own = self.drive.limits.shear_stress
        resisting = float(torsion_modulus(stretch.outer, stretch.inner))
        if own is not None:
            moment, case = self.most(self.loads.moment)
            source = _("Book (261), largest shear stress; limits of the drive file")
            return made(value=moment * self.duty.shock_factor / resisting, limit=own, source=source, case=case)
        missing = lacking(self.drive, f"{stretch.path}.material.yield_strength")
        if missing:
            return made(missing=missing)
        moment, case = self.most(self.loads.mises)
        return made(
            value=moment * self.duty.shock_factor / resisting,
            limit=(stretch.material.yield_strength or math.nan) / self.drive.limits.safety,
            source=_("torsion with the secondary couples, von Mises; yield strength over safety"),
            case=case,
        )

    def _tired(self, found: Sequence[Stretch]) -> list[tuple[Fatigue, int, int]]:
        """Return the fatigue of every stretch in every way of running."""
        return [(self._fatigue_of(one, c), s, c) for s, one in enumerate(found) for c in range(len(self.cases))]

    def _fatigue_of(self, stretch: Stretch, c: int) -> Fatigue:
        low, high = float(self.loads.low[c, self.k]), float(self.loads.high[c, self.k])
        return self._line(stretch, 0.5 * (high + low), 0.5 * (high - low), float(self.loads.bending[c, self.k]))

    def _line(self, stretch: Stretch, mean: float | Array, swing: float | Array, bending: float | Array) -> Fatigue:
        notch = self.shaft.notch or Notch()
        return shaft_fatigue(
            mean_torque=mean,
            swinging_torque=swing,
            mean_bending=0.0,
            swinging_bending=bending,
            outer=stretch.outer,
            inner=stretch.inner,
            ultimate=stretch.material.ultimate_strength or math.nan,
            yield_strength=stretch.material.yield_strength or math.nan,
            finish=self.shaft.finish,
            bending_notch=notch.bending,
            torsion_notch=notch.torsion,
            reliability=self.duty.reliability,
        )

    def _fatigue(self, found: Sequence[Stretch]) -> Use:
        made = self.made("tube_fatigue", _("safety of shaft {number} against fatigue"), at_least=True)
        names = ("ultimate_strength", "yield_strength")
        missing = lacking(self.drive, *(f"{one.path}.material.{name}" for one in found for name in names))
        if missing:
            return made(missing=missing)
        tired, _stretch, c = min(self._tired(found), key=lambda row: float(row[0].safety))
        return made(
            value=float(tired.safety),
            limit=self.drive.limits.fatigue_safety,
            source=_("Goodman with Marin's factors, Shigley chapter 6"),
            case=self.cases[c].name,
        )

    def _life(self, found: Sequence[Stretch]) -> float:
        """Return the time until the worst stretch breaks, by Palmgren and Miner [s]."""
        return min(1.0 / rate if rate > 0.0 else math.inf for rate in (self._rate(one) for one in found))

    def _rate(self, stretch: Stretch) -> float:
        """Return the damage a second: of every turn, and of the cycles of a torque history."""
        rate = 0.0
        for c, case in enumerate(self.cases):
            if case.share > 0.0 and case.speed is not None:
                cycles = float(self._fatigue_of(stretch, c).cycles)
                rate += case.share * case.speed / (2.0 * math.pi * max(cycles, 1.0))
        return rate + self._measured(stretch)

    def _measured(self, stretch: Stretch) -> float:
        """Return the damage a second of a torque history: its own cycles, and the turns at its levels."""
        history = self.duty.torque_history
        if history is None or not history.torques or self.duty.blocks:
            return 0.0
        most = max(abs(one) for one in history.torques) or 1.0
        low, high, bending = (
            float(table[-1, self.k]) / most for table in (self.loads.low, self.loads.high, self.loads.bending)
        )
        counted = rainflow(history.torques)
        own = self._line(stretch, high * np.abs(counted.mean), 0.5 * high * counted.range, 0.0)
        rate = float(np.sum(counted.count / np.maximum(own.cycles, 1.0))) / (history.times[-1] - history.times[0])
        if not self.duty.speed:
            return rate
        levels = time_at_level(history.times, history.torques)
        size = np.abs(levels.value)
        turned = self._line(stretch, 0.5 * (high + low) * size, 0.5 * (high - low) * size, bending * size)
        turns = abs(self.duty.speed) / (2.0 * math.pi)
        return rate + float(np.sum(levels.share / np.maximum(turned.cycles, 1.0))) * turns

    def _buckling(self) -> Use:
        made = self.made(
            "tube_buckling", _("torque of the composite tube of shaft {number}"), dimension="torque", unit="Nm"
        )
        missing = lacking(self.drive, f"shafts[{self.k}].outer")
        if missing:
            return made(missing=missing)
        torque, case = self.most(self.loads.torque)
        return made(
            value=torque * self.duty.shock_factor,
            limit=self._buckles() / self.drive.limits.safety,
            source=_("buckling of the wall, 2π r² t·0.272 (E_x E_y³)^(1/4) (t/r)^(3/2), over safety"),
            case=case,
        )

    def _buckles(self) -> float:
        layup, outer = self.shaft.layup, self.shaft.outer
        if layup is None or outer is None:
            return math.nan
        return composite_tube(layup, outer - len(layup.angles) * layup.ply_thickness).buckling_torque

    def _teeth(self) -> tuple[SplineStress, str] | None:
        spline = self.shaft.spline
        if spline is None or lacking(self.drive, *(f"shafts[{self.k}].spline.{name}" for name in SPLINE)):
            return None
        torque, case = self.most(self.loads.torque)
        sizes = {name: getattr(spline, name) for name in (*SPLINE, "chamfer", "load_share")}
        return spline_stress(torque * self.duty.shock_factor, **sizes), case

    def _spline(self) -> Iterator[Use]:
        path, strength = f"shafts[{self.k}].spline", f"shafts[{self.k}].material.yield_strength"
        sizes = tuple(f"{path}.{name}" for name in SPLINE)
        words = {"dimension": "stress", "unit": "MPa"}
        core = self.made("spline_strength", _("stress of the core of the spline of shaft {number}"), **words)
        press = self.made("spline_pressure", _("pressure on the spline of shaft {number}"), **words)
        found = self._teeth()
        missing = lacking(self.drive, *sizes, strength)
        if missing or found is None:
            yield core(missing=missing)
        else:
            stress, case = found
            material = self.shaft.material or Material()
            allowed = (material.yield_strength or math.nan) / self.drive.limits.safety
            yield core(
                value=math.sqrt(3.0) * float(stress.core_shear),
                limit=allowed,
                source=_("torsion at the root diameter, von Mises; yield strength over safety"),
                case=case,
            )
            teeth = _("stress of the teeth of the spline of shaft {number}").format(number=self.k + 1)
            yield core(
                title=teeth,
                value=math.sqrt(3.0) * float(stress.tooth_shear),
                limit=allowed,
                source=_("shear at the roots of the teeth, von Mises; yield strength over safety"),
                case=case,
            )
        missing = lacking(self.drive, *sizes, "limits.spline_pressure")
        if missing or found is None:
            yield press(missing=missing)
            return
        yield press(
            value=float(found[0].pressure),
            limit=self.drive.limits.spline_pressure or math.nan,
            source=_("2T/(d_m z ψ h l); limits of the drive file, no source gives one"),
            case=found[1],
        )

    def strength(self) -> ShaftStrength:
        """Return what the shaft goes through."""
        shock = self.duty.shock_factor
        found = stretches(self.drive, self.k)
        plain = ShaftStrength(
            number=self.k + 1,
            torque=shock * self.most(self.loads.torque)[0],
            bending=shock * self.most(self.loads.bending)[0],
            weight_bending=weight_bending(self.drive, self.k),
            twist=_shaft_twist(self.drive, self.k) * self.most(self.loads.torque)[0],
            spline=(self._teeth() or (None, ""))[0],
            buckling_torque=self._buckles(),
        )
        if not found or self.shaft.layup is not None:
            return plain
        worst = max(range(len(found)), key=lambda s: 1.0 / float(torsion_modulus(found[s].outer, found[s].inner)))
        at = int(foremost(self.loads.mises[:, self.k]))
        torque, bending = (shock * float(table[at, self.k]) for table in (self.loads.torque, self.loads.bending))
        stress = shaft_stress(torque, bending, found[worst].outer, found[worst].inner)
        plain = replace(plain, stress=stress, stretch=worst + 1)
        known = all(one.material.ultimate_strength and one.material.yield_strength for one in found)
        if not known:
            return plain
        tired = min(self._tired(found), key=lambda row: float(row[0].safety))[0]
        moving = any(one.share > 0.0 and one.speed for one in self.cases) or self.duty.torque_history is not None
        return replace(plain, fatigue=tired, fatigue_life=self._life(found) if moving else math.nan)


def _shaft_twist(drive: Drive, k: int) -> float:
    """Return the twist of a shaft under 1 N·m [rad]; nan where the drive does not say."""
    shaft, found = drive.shafts[k], stretches(drive, k)
    if shaft.stiffness is not None:
        return 1.0 / shaft.stiffness
    if not found or any(one.length is None for one in found):
        return math.nan
    return sum(
        (one.length or 0.0) / (one.material.shear_modulus * float(polar_moment(one.outer, one.inner))) for one in found
    )


def _twist(drive: Drive, cases: Sequence[LoadCase], loads: ShaftLoads) -> Iterator[Use]:
    """Yield the twist of all shafts together."""
    made = partial(Use, check="twist", title=_("twist of the shafts under torque"), dimension="angle", unit="deg")
    soft = np.asarray([_shaft_twist(drive, k) for k in range(len(drive.joints) + 1)])
    missing = [
        f"shafts[{k}].length" if stretches(drive, k) else f"shafts[{k}].outer"
        for k in range(1, len(drive.joints))
        if math.isnan(soft[k])
    ]
    if missing:
        yield made(missing=tuple(missing))
    elif not np.all(np.isnan(soft)):
        turned = np.sum(np.nan_to_num(soft) * loads.torque, axis=-1)
        at, own = int(foremost(turned)), drive.limits.twist
        yield made(
            value=float(turned[at]),
            limit=RATED_TWIST if own is None else own,
            source=_("Book (262): 9°") if own is None else _("limits of the drive file"),
            case=cases[at].name,
        )
