"""How long joints and supports last: life over the loads, by each method, what each part of the duty cycle does."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from cardan.answers.palette import dash_of, shaft
from cardan.answers.quantity import Quantity, Say, Text, say
from cardan.figures.axes import axis, log_axis, steps, written
from cardan.figures.figure import Axis, Bars, Curve, Figure, Panel, Row, Rule
from cardan.maths.ties import foremost
from cardan.texts import _
from cardan.units import hour

from .lives import Life

REACH = np.linspace(0.5, 2.0, 61)
"""Loads over those of the duty that the curves span."""

SHOWN = 12
"""Parts of a duty cycle with bars of their own."""


def life_figures(found: Life) -> tuple[Figure, ...]:
    """Return the figures of the life of a drive."""
    if not math.isfinite(found.drive):
        return (_unlimited(found),)
    figures = [load_figure(found)]
    if np.any(np.isfinite(found.joints)):
        figures.append(methods_figure(found))
    if found.history is not None:
        figures.append(history_figure(found))
    elif len(found.parts) > 1:
        figures.append(parts_figure(found))
    return tuple(figures)


def load_figure(found: Life) -> Figure:
    """Return the life of every joint over its loads.

    found: of a drive whose life is limited. Supports that outlive every joint are left out.
    """
    lives = found.loaded(REACH) / hour
    curves = tuple(
        Curve(
            x=100.0 * REACH,
            y=lives[:, i],
            role=shaft(i + 2),
            dash=dash_of(i + 2),
            label=_("joint {number}").format(number=i + 1),
        )
        for i in range(lives.shape[1])
        if np.all(np.isfinite(lives[:, i]))
    )
    curves += tuple(_held(found))
    rules = [Rule(value=100.0, upright=True, text=_("duty"), role="ink")]
    asked = [] if found.demanded is None else [found.demanded / hour]
    rules += [Rule(value=value, text=_("asked for"), role="accent") for value in asked]
    point = Curve(x=np.asarray([100.0]), y=np.asarray([found.drive / hour]), role=_tone(found), width=0.0, marker=7.0)
    x = axis(_("all loads over those of the duty"), "percent", [100.0 * REACH], dimension="share", margin=0.0, count=6)
    y = _decades(_("Life"), np.concatenate([*(curve.y for curve in curves), asked]))
    over = Panel(series=(*curves, *rules, point), x=x, y=y)
    return Figure(
        name="life",
        title=_("How long the bearings last") if found.supports is not None else _("How long the joints last"),
        sentence=_sentence(found),
        source=_("ISO 281 with the exact integral over the turn"),
        rows=(Row(panels=(over,), height=2.0),),
    )


def _held(found: Life) -> Iterator[Curve]:
    """Yield the lives of the bearings of supports, those that outlive every joint left out."""
    if found.supports is None:
        return
    lives = found.supports_loaded(REACH) / hour
    longest = float(np.max(found.joints[np.isfinite(found.joints)], initial=0.0)) or math.inf
    for k, number in enumerate(found.supports.number):
        if math.isfinite(found.of_supports[k]) and found.of_supports[k] <= longest:
            role = len(found.joints) + 1 + number
            label = _("support {number}").format(number=number)
            yield Curve(x=100.0 * REACH, y=lives[:, k], role=shaft(role), dash=dash_of(role), label=label)


def methods_figure(found: Life) -> Figure:
    """Return the lives of the joint that fails first, by each method."""
    i = found.governing - 1
    kind = found.bearings.convention[i]
    named = [
        (_("ISO 281, driving yoke"), found.combined(found.driving)[i]),
        (_("ISO 281, driven yoke"), found.combined(found.driven)[i]),
        (_("by the mean load"), found.of("simple")[i]),
        (_("maker, {convention}").format(convention=kind) if kind else _("maker"), found.of("maker")[i]),
        (_("book"), found.of("book")[i]),
    ]
    rows = [(name, float(life) / hour, "accent") for name, life in named if math.isfinite(life)]
    if found.demanded is not None:
        rows.append((_("asked for"), found.demanded / hour, "muted"))
    size = np.asarray([life for _name, life, _role in rows])
    top = float(np.max(size))
    ticks = steps(0.0, top, 5)
    at = np.arange(len(rows), 0, -1, dtype=float)
    bars = Bars(
        at=at,
        size=size,
        texts=tuple(Quantity(hour * life, "duration", 3) for life in size.tolist()),
        roles=tuple(role for _name, _life, role in rows),
        thick=0.62,
        lying=True,
    )
    names = tuple(name for name, _life, _role in rows)
    panel = Panel(
        series=(bars,),
        x=Axis(low=0.0, high=1.16 * top, ticks=ticks, texts=written(ticks)),
        y=Axis(low=0.4, high=len(rows) + 0.6, ticks=tuple(at), texts=names, grid=False),
        title=_("Joint {number} by each method").format(number=found.governing),
        dimension="duration",
        unit="h",
    )
    return Figure(
        name="life-methods",
        aside=True,  # the table of the joints tells the same
        title=_("Life by each method"),
        sentence="",
        source=_(
            "ISO 281 with the exact integral over the turn; Kozhevnikov & Perfil'ev (1978), eq. 267, 269; "
            "makers' formulas"
        ),
        rows=(Row(panels=(panel,), height=1.3),),
    )


def parts_figure(found: Life) -> Figure:
    """Return time and damage of the parts of a duty cycle, in the joint or support that fails first."""
    damage, held = 100.0 * found.first_damage, found.governing_support
    of_joint, of_support = (
        _("Shares of time and of damage in joint {number}"),
        _("Shares of time and of damage in support {number}"),
    )
    text = _("{part} in {time} of the time does {damage} of the damage to joint {number}.")
    if held:
        text = _("{part} in {time} of the time does {damage} of the damage to support {number}.")
    time = 100.0 * found.share
    shown = np.argsort(-damage, kind="stable")[:SHOWN] if damage.size > SHOWN else np.arange(damage.size)
    loads = [
        say(
            "{torque}, {speed}", torque=Quantity(one.torque, "torque", 3), speed=Quantity(one.speed, "angular_speed", 3)
        )
        for one in found.parts
    ]
    every: Sequence[Text] = part_names(found) if found.named else loads
    names = tuple(every[k] for k in shown)
    at = np.arange(len(shown), 0, -1, dtype=float)
    bars = tuple(
        Bars(
            at=at + shift,
            size=values[shown],
            texts=tuple(Quantity(float(value) / 100.0, "share", 3) for value in values[shown]),
            label=label,
            roles=(role,) * len(shown),
            thick=0.34,
            lying=True,
        )
        for values, label, role, shift in ((time, _("time"), "muted", 0.19), (damage, _("damage"), "accent", -0.19))
    )
    top = float(max(np.max(time[shown]), np.max(damage[shown])))
    ticks = steps(0.0, top, 5)
    most = int(foremost(damage))
    panel = Panel(
        series=bars,
        x=Axis(low=0.0, high=1.16 * top, ticks=ticks, texts=written(ticks)),
        y=Axis(low=0.4, high=len(shown) + 0.6, ticks=tuple(at), texts=names, grid=False),
        title=(of_support if held else of_joint).format(number=held or found.governing),
        dimension="share",
        unit="percent",
    )
    return Figure(
        name="life-parts",
        aside=True,  # the table of the parts tells the same
        title=_("What each part of the duty cycle does"),
        sentence=say(
            text,
            part=every[most] if found.named else Quantity(found.parts[most].torque, "torque", 3),
            time=Quantity(float(found.share[most]), "share", 3),
            damage=Quantity(float(damage[most]) / 100.0, "share", 3),
            number=held or found.governing,
        ),
        source=_("rule of Palmgren and Miner, Kozhevnikov & Perfil'ev (1978), eq. 268"),
        rows=(Row(panels=(panel,), height=0.5 * len(shown) + 0.3),),
    )


def part_names(found: Life) -> list[str]:
    """Return what the parts of the duty are called."""
    cases = len({part.path for part in found.parts if part.path}) > 1
    return [part.name or (_("the torque of the duty") if cases else _("as drawn")) for part in found.parts]


def history_figure(found: Life) -> Figure:
    """Return the time that a measured torque spends at each level, and what it does there."""
    levels = found.history
    assert levels is not None
    spent = levels.share > 0.0
    middle = 0.5 * (levels.edge[1:] + levels.edge[:-1])[spent]
    thick = 0.9 * float(np.min(np.diff(levels.edge)))
    damage, held = 100.0 * found.first_damage, found.governing_support
    label = _("Share of the damage to support {number}") if held else _("Share of the damage to joint {number}")
    time = 100.0 * levels.share[spent]

    def panel(values: np.ndarray, label: str, role: str, *, named: bool) -> Panel:
        bars = Bars(at=middle, size=values, roles=(role,) * values.size, thick=thick)
        mark = Rule(value=levels.equivalent, upright=True, text=_("damages as much") if not named else "", role="ink")
        made = axis("", "", [levels.edge], include=(levels.equivalent,))
        if named:
            made = replace(made, label=_("torque"), unit="Nm", dimension="torque")
        upright = axis(label, "percent", [values], dimension="share", include=(0.0,), count=4)
        return Panel(series=(bars, mark), x=made, y=upright)

    return Figure(
        name="life-history",
        title=_("What the measured torque does"),
        sentence=say(
            _("The torque from {low:bare} to {high} damages as much as a constant one of {same}."),
            low=Quantity(levels.low, "torque", 3),
            high=Quantity(levels.high, "torque", 3),
            same=Quantity(levels.equivalent, "torque"),
        ),
        source=_(
            "time at level, mean of the 10/3rd power; rule of Palmgren and Miner, Kozhevnikov & Perfil'ev "
            "(1978), eq. 268"
        ),
        rows=(
            Row(panels=(panel(time, _("Share of the time"), "muted", named=False),), height=1.2),
            Row(
                panels=(panel(damage, label.format(number=held or found.governing), "accent", named=True),), height=1.2
            ),
        ),
    )


def _unlimited(found: Life) -> Figure:
    """Return a figure that says that nothing is damaged."""
    at = np.arange(1.0, found.joint_angle.shape[1] + 1.0)
    forces = np.nan_to_num(np.max(found.journal_force, axis=0))
    return Figure(
        name="life",
        title=_("How long the joints last"),
        sentence=_("No joint is damaged: none of them carries torque and oscillates."),
        source=_("ISO 281"),
        rows=(
            Row(
                panels=(
                    Panel(
                        series=(Bars(at=at, size=forces, roles=("muted",) * at.size),),
                        x=Axis(
                            label=_("joint"), low=0.4, high=at.size + 0.6, ticks=tuple(at), texts=written(tuple(at))
                        ),
                        y=axis(_("Largest journal force"), "N", [forces], dimension="force", include=(0.0, 1.0)),
                    ),
                )
            ),
        ),
    )


def _tone(found: Life) -> str:
    return "ink" if found.enough is None else "good" if found.enough else "failed"


def _sentence(found: Life) -> Say | str:
    """Return how far the loads are from those of the life asked for."""
    if found.demanded is None:
        return ""
    text = _("The loads would have to fall to {factor}.")
    if found.enough:
        text = _("The loads may grow to {factor}.")
    return say(text, factor=Quantity(found.torque_margin, "share", 3))


def _decades(label: str, values: np.ndarray) -> Axis:
    """Return a logarithmic axis of hours over whole decades and their halves."""
    low, high = float(np.min(values)) / 1.15, float(np.max(values)) * 1.15
    return log_axis(label, "h", low, high, dimension="duration")


FIGURES = {Life: life_figures}
"""Result -> what makes its figures."""
