"""Whether every shaft lasts as long as the duty asks under a measured torque, by the damage of its cycles and turns."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.event_loads import followed, sorted_into_classes
from cardan.checks.load_case import Case
from cardan.checks.moving import stands
from cardan.checks.verdict import Verdict
from cardan.drive.duty import History
from cardan.drive.machine import Event, RunUp
from cardan.drive.shaft import Notch
from cardan.formulas.shaft_strength import Fatigue, fatigue_cycles, shaft_fatigue
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.ties import foremost_of
from cardan.questions.life.rainflow import Cycles, Levels, rainflow, speed_at_level, time_at_level
from cardan.texts import _, mark

from .section import Section, sections

STRENGTHS = ("ultimate_strength", "yield_strength")

ROUNDS, REACH = 40, 100.0
"""Halvings in search of the factor on the torques, and how far above the least that damages it is looked for."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Spectrum:
    """Stress cycles of a stretch of a shaft in a time; leading axes (...) are those of the drives."""

    alternating: Array  # alternating, mean (..., k) [Pa]: equivalent stresses by von Mises
    mean: Array  # (..., k) [Pa]
    rate: Array  # (..., k) [1/s]: how often each of them comes
    endurance: Array  # endurance, ultimate (..., 1) [Pa]: S_e and S_ut
    ultimate: Array

    def damage(self, factor: ArrayLike = 1.0) -> Array:
        """Return the damage a second with all torques times a factor (...), array (...), by Palmgren and Miner."""
        more = np.asarray(factor, dtype=float)[..., None]
        cycles = fatigue_cycles(more * self.alternating, more * self.mean, self.endurance, self.ultimate)
        found: Array = np.sum(self.rate / np.maximum(cycles, 1.0), axis=-1)
        return found

    @property
    def unharmed(self) -> Array:
        """Factor on all torques up to which nothing damages, array (...): the least safety of its cycles by Goodman."""
        use = np.where(self.rate > 0.0, self.alternating / self.endurance + self.mean / self.ultimate, 0.0)
        with np.errstate(divide="ignore"):
            found: Array = 1.0 / np.max(use, axis=-1, initial=0.0)
        return found

    def safety(self, life: ArrayLike | None) -> Array:
        """Return the factor on all torques with which the damage in a life [s] comes to 1, array (...).

        Without a life it is that from which there is any damage.
        """
        low = self.unharmed
        if life is None:
            return low
        low, high = np.where(np.isfinite(low), low, 1.0), REACH * np.where(np.isfinite(low), low, 1.0)
        allowed = 1.0 / np.asarray(life, dtype=float)
        for _round in range(ROUNDS):
            middle = np.sqrt(low * high)
            kept = self.damage(middle) <= allowed
            low, high = np.where(kept, middle, low), np.where(kept, high, middle)
        return np.where(np.isfinite(self.unharmed), low, np.inf)


def measured(design: Design) -> bool:
    """Tell whether the torque of a duty was measured over time."""
    history = design.duty.torque_history
    return history is not None and bool(history.torques) and not design.duty.blocks


def spectrum(design: Design, k: int, section: Section) -> Spectrum:
    """Return the stress cycles of a stretch of a shaft, counted from 0, under a measured torque, over all poses.

    Cycles of the torque itself by rainflow, and the turns of the shaft in the time at its levels.
    """
    found = [(fatigue, share * rate) for share, one in stands(design) for fatigue, rate in _measured(one, k, section)]
    outer = np.broadcast_shapes(*(np.shape(one)[:-1] for its, rate in found for one in (its.alternating, rate)))

    def whole(rows: Sequence[Array]) -> Array:
        return np.concatenate([np.broadcast_to(one, (*outer, np.shape(one)[-1])) for one in rows], axis=-1)

    ultimate = np.asarray(design.value(section.of_material("ultimate_strength")), dtype=float)[..., None]
    return Spectrum(
        alternating=whole([one.alternating for one, _rate in found]),
        mean=whole([one.mean for one, _rate in found]),
        rate=whole([rate for _one, rate in found]),
        endurance=found[0][0].endurance,
        ultimate=ultimate,
    )


def _measured(design: Design, k: int, section: Section) -> Iterator[tuple[Fatigue, Array]]:
    """Yield cycles and turns of a drive that stands in one way, with how often they come [1/s]."""
    history = design.duty.torque_history
    assert history is not None
    peak, most = design.loaded[-1], max(abs(one) for one in history.torques) or 1.0
    low, high = (np.asarray(torque[..., [k]]) / most for torque in peak.torque_range)
    bending = np.asarray(peak.end_bending[..., [k]]) / most
    counted, levels = _counted(history)
    spent = levels.share > 0.0
    size = np.abs(levels.value[spent])
    speed = design.value("duty.speed")
    if history.speeds:
        speed = speed_at_level(history.times, history.torques, history.speeds, levels.edge)[spent]
        turns = speed / (2.0 * math.pi)
    else:
        turns = np.abs(np.asarray(0.0 if speed is None else speed))[..., None] / (2.0 * math.pi)
    for mean, swing, bent, rate in (
        (high * np.abs(counted.mean), 0.5 * high * counted.range, 0.0 * bending, counted.count / _duration(design)),
        (0.5 * (high + low) * size, 0.5 * (high - low) * size, bending * size, turns * levels.share[spent]),
    ):
        yield of_loads(design, k, section, mean, swing, bent, spread=True), rate


@lru_cache(maxsize=8)
def _counted(history: History) -> tuple[Cycles, Levels]:
    """Return cycles and levels of a measured torque."""
    return sorted_into_classes(rainflow(history.torques)), time_at_level(history.times, history.torques)


def _duration(design: Design) -> float:
    history = design.duty.torque_history
    assert history is not None
    return history.times[-1] - history.times[0]


def lasting(design: Design) -> Sequence[Case]:
    """Return the ways of running that make up the time of a duty by themselves: none where a torque was measured."""
    history = design.duty.torque_history
    given = history is not None and bool(history.torques)
    return [one for one in design.running if np.all(np.asarray(one.share) > 0.0) and (one.block or not given)]


def fatigue_life(design: Design, k: int) -> Array:
    """Return the running time until the worst stretch of a shaft, counted from 0, breaks, array (...) [s]."""
    parts = (_of_turns, _of_history, _of_starts)
    rates = [sum((part(design, k, one) for part in parts), np.zeros(design.shape)) for one in sections(design, k)]
    with np.errstate(divide="ignore"):
        found: Array = 1.0 / np.max(np.stack(np.broadcast_arrays(*rates)), axis=0)
    return found


def fatigue_used(design: Design, k: int) -> Array | None:
    """Return the share of its fatigue life that a shaft, counted from 0, uses in the life asked for, array (...).

    Without one it is that of starts and events, whose number is given; None where running adds to it what decides.
    """
    life, running = design.value("duty.life"), fatigue_life(design, k)
    if life is not None:
        return np.asarray(life) / running
    every = [_of_events(design, k, one) for one in sections(design, k)]
    found = np.asarray(np.max(np.stack(np.broadcast_arrays(*every)), axis=0))
    return found if np.all(np.isinf(running) | (found > 1.0)) else None


def start_damage(design: Design, k: int, event: Event | RunUp | None = None) -> Array:
    """Return the damage that one start or event does to the worst stretch of a shaft, counted from 0, array (...).

    event: that of the run-up of the duty when not given.
    """
    every = [_of_start(design, k, one, event) for one in sections(design, k)]
    return np.asarray(np.max(np.stack(np.broadcast_arrays(*every)), axis=0))


def _of_start(design: Design, k: int, section: Section, event: Event | RunUp | None) -> Array:
    """Return the damage that one event does to a stretch of a shaft: its cycles by rainflow, with secondary couples.

    The couples are those of the larger torque of each cycle.
    """
    found = followed(design.drive, event)
    if isinstance(found, tuple) or k not in found:
        return np.zeros(design.shape)
    cycles, bent = found[k].cycles, _couple(design, k)
    swing, mean = 0.5 * cycles.range, np.abs(cycles.mean)
    loads = of_loads(design, k, section, mean, swing, bent * (mean + swing), spread=True)
    return np.asarray(np.sum(cycles.count / np.maximum(loads.cycles, 1.0), axis=-1))


def _couple(design: Design, k: int) -> Array:
    """Return the secondary couple of a shaft over its torque, of a newton metre where the duty has no torque."""
    plain = next((one for one in design.loaded if np.all(one.shaft_torque[..., k] > 0.0)), None)
    if plain is None:
        duty = replace(design.duty, torque=1.0)
        varied = {path: values for path, values in design.varied.items() if path != "duty.torque"}
        whole = replace(design.drive, duty=duty)
        plain = replace(design, drive=whole, duty=duty, varied=varied, vibrates=False).loaded[0]
    return np.asarray(plain.end_bending[..., [k]] / plain.shaft_torque[..., [k]])


def _of_starts(design: Design, k: int, section: Section) -> Array:
    """Return the damage a second of the starts and events in the life asked for."""
    life = design.value("duty.life")
    return np.zeros(design.shape) if life is None else _of_events(design, k, section) / np.asarray(life)


def _of_events(design: Design, k: int, section: Section) -> Array:
    """Return the damage of all starts and events to a stretch of a shaft."""
    return sum(
        (np.asarray(count) * _of_start(design, k, section, one) for _k, one, count in design.events),
        np.zeros(design.shape),
    )


def _of_turns(design: Design, k: int, section: Section) -> Array:
    """Return the damage a second of every turn, in all poses by their shares."""
    rate: Array = np.zeros(design.shape)
    for share, one in stands(design):
        for case in lasting(one):
            turns = share * np.asarray(case.share) * np.abs(0.0 if case.speed is None else case.speed) / (2.0 * math.pi)
            rate = rate + turns / np.maximum(fatigue(one, k, section, case).cycles, 1.0)
    return rate


def _of_history(design: Design, k: int, section: Section) -> Array:
    """Return the damage a second of a measured torque."""
    return spectrum(design, k, section).damage() if measured(design) else np.zeros(design.shape)


def life_safety(design: Design, k: int) -> Array:
    """Return the factor on a measured torque with which a shaft, counted from 0, lasts just as asked, array (...)."""
    life = design.value("duty.life")
    every = [spectrum(design, k, one).safety(life) for one in sections(design, k)]
    return np.asarray(np.min(np.stack(np.broadcast_arrays(*every)), axis=0))


def hardest_cycle(design: Design, k: int) -> Fatigue:
    """Return the fatigue of the worst stretch of a shaft of one drive in the cycle with the least safety."""
    every = [spectrum(design, k, one) for one in sections(design, k)]
    worst = foremost_of(every, lambda one: float(one.unharmed), least=True)
    at = int(np.argmax(worst.alternating / worst.endurance + worst.mean / worst.ultimate))
    swing, mean, endurance = worst.alternating[at], worst.mean[at], worst.endurance[0]
    strengths = [design.value(one.of_material("yield_strength")) for one in sections(design, k)]
    return Fatigue(
        endurance=endurance,
        alternating=swing,
        mean=mean,
        safety=worst.unharmed,
        yield_safety=np.asarray(min(strengths) / max(float(swing + mean), 1e-300)),
        cycles=fatigue_cycles(swing, mean, endurance, worst.ultimate[0]),
    )


def fatigue(design: Design, k: int, section: Section, case: Case) -> Fatigue:
    """Return the fatigue of a stretch of a shaft, counted from 0, in one way of running."""
    least, most = (torque[..., k] for torque in case.torque_range)
    return of_loads(design, k, section, 0.5 * (most + least), 0.5 * (most - least), case.end_bending[..., k])


def of_loads(
    design: Design,
    k: int,
    section: Section,
    mean: ArrayLike,
    alternating: ArrayLike,
    bending: ArrayLike,
    *,
    spread: bool = False,
) -> Fatigue:
    """Return the fatigue of a stretch under a mean and an alternating torque and a bending moment that turns [N·m].

    spread: whether the loads have one axis more than the design, of cycles.
    """
    shaft = design.drive.shafts[k]
    notch = shaft.notch or Notch()
    factors = {name: design.value(f"shafts[{k}].notch.{name}") for name in ("bending", "torsion")}

    def wide(value: ArrayLike) -> Array:
        given = np.asarray(value, dtype=float)
        return given[..., None] if spread else given

    return shaft_fatigue(
        mean_torque=np.abs(np.asarray(mean)),
        swinging_torque=alternating,
        mean_bending=0.0,
        swinging_bending=bending,
        outer=wide(section.stressed[0]),
        inner=wide(section.stressed[1]),
        ultimate=wide(design.value(section.of_material("ultimate_strength"))),
        yield_strength=wide(design.value(section.of_material("yield_strength"))),
        finish=shaft.finish,
        bending_notch=wide(notch.bending if factors["bending"] is None else factors["bending"]),
        torsion_notch=wide(notch.torsion if factors["torsion"] is None else factors["torsion"]),
        reliability=design.duty.reliability,
    )


def _judge(design: Design, k: int) -> Iterator[Verdict]:
    found = list(sections(design, k))
    if not measured(design) or design.drive.shafts[k].layup is not None or not (found or 0 < k < design.joints):
        return
    strengths = [section.of_material(name) for section in found for name in STRENGTHS]
    body = () if found else (f"shafts[{k}].outer",)
    lacking = (*body, *design.missing("duty.life", *strengths))
    if lacking:
        yield Verdict(missing=lacking)
        return
    factor = life_safety(design, k)
    yield Verdict(
        value=fatigue_life(design, k),
        limit=design.value("duty.life"),
        source=_("rainflow by ASTM E1049, turns by time at level, Palmgren-Miner; S-N line of Shigley chapter 6"),
        design_variables=(*fatigue_variables(design, k), "duty.life"),
        factor=factor,
    )


def fatigue_variables(design: Design, k: int) -> tuple[str, ...]:
    """Return the paths that move the fatigue of a shaft, counted from 0."""
    found = list(sections(design, k))
    return (
        *(path for section in found for path in section.design_variables),
        found[0].of_material("ultimate_strength"),
        *design.design_variables(f"shafts[{k}].notch.bending", f"shafts[{k}].notch.torsion"),
        *design.joint_angle_design_variables,
        *design.torque_design_variables,
    )


CHECK = Check(
    name="shaft_life",
    doc=mark("fatigue life of every shaft under a measured torque against the life asked for"),
    shaft=_judge,
    title=mark("fatigue life of shaft {number}"),
    dimension="duration",
    unit="h",
    sense="at_least",
    power=1.0,
    gathers="sum",
)
