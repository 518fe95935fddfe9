"""What a recording tells of a drive: its causes by likelihood, then its orders over speed."""

from __future__ import annotations

from collections.abc import Sequence
from math import isfinite

import numpy as np

from cardan.answers.quantity import Quantity, Text, say
from cardan.figures.axes import steps, written
from cardan.figures.figure import Axis, Bars, Figure, Panel, Row
from cardan.questions.diagnosis.examination import Examination
from cardan.questions.diagnosis.findings import Finding
from cardan.texts import _

from .motion import orbit_figure, rotation_figure, torsional_figure
from .orders import map_figure, spectrum_figure, tracks_figure, trusted

SHOWN = 6
"""Causes with a bar."""

LONG = 44
"""Letters of the name of a cause."""

LIKELY = 0.5
"""Probability from which on a cause is called likely."""


def examination_figures(found: Examination) -> tuple[Figure, ...]:
    """Return the figures of an examination: causes, orders over speed, spectrum, orders followed, motion."""
    figures = [causes_figure(found.findings), examined_map(found), spectrum_figure(found.spectrum)]
    figures += [tracks_figure(found.tracks), rotation_figure(found.rotation)]
    if found.orbit is not None:
        figures.append(orbit_figure(found.orbit))
    if found.swing is not None:
        figures.append(torsional_figure(found.swing))
    return tuple(figures)


def examined_map(found: Examination) -> Figure:
    """Return the order map with the critical speed of the drive, and the orders of the likeliest cause."""
    critical = [found.critical] if isfinite(found.critical) else []
    lines = found.expected.orders if found.expected is not None else ()
    orders = sorted({line.order for line in lines} | {1.0, 2.0})
    return map_figure(found.map, critical_speeds=critical, orders=orders)


def causes_figure(findings: Sequence[Finding]) -> Figure:
    """Return the probability of the likeliest causes.

    findings: by falling score.
    """
    shown = findings[:SHOWN]
    size = np.asarray([100.0 * one.score for one in shown])
    at = np.arange(len(shown), 0, -1, dtype=float)
    first = "good" if shown[0].cause == "healthy" else "accent"
    bars = Bars(
        at=at,
        size=size,
        texts=tuple(Quantity(one.score, "share", decimals=0) for one in shown),
        roles=(first, *("muted",) * (len(shown) - 1)),
        thick=0.62,
        lying=True,
    )
    ticks = steps(0.0, 100.0, 5)
    names = tuple(_short(one.fault) for one in shown)
    panel = Panel(
        series=(bars,),
        x=Axis(low=0.0, high=112.0, ticks=ticks, texts=written(ticks)),
        y=Axis(low=0.4, high=len(shown) + 0.6, ticks=tuple(at), texts=names, grid=False),
        title=_("Probability"),
        dimension="share",
        unit="percent",
    )
    return Figure(
        name="causes",
        title=_("What is likely wrong"),
        sentence="",
        source=_("weights of a multinomial logistic model, calibrated on simulated recordings"),
        rows=(Row(panels=(panel,), height=0.27 * len(shown) + 0.3),),
        legend=False,
    )


def verdict(findings: Sequence[Finding]) -> Text:
    """Return in one sentence what a recording comes to, never surer than it is.

    findings: by falling score.

    >>> from cardan.answers.quantity import told
    >>> from cardan.answers.reader import USUAL
    >>> one = Finding(cause="F01", fault="unbalance", score=0.81, confidence=0.9)
    >>> other = Finding(cause="F02", fault="tube bent", score=0.1, confidence=0.9)
    >>> told(verdict([one, other]), USUAL)
    'Likely: unbalance (81 %).'
    """
    first, second = findings[0], findings[1]
    share, other = (Quantity(one.score, "share", decimals=0) for one in (first, second))
    if first.score < LIKELY:
        text = _("No cause stands out: {first} ({share}), or {second} ({next_share}).")
    elif first.cause == "healthy":
        text = _("No fault shows ({share}).")
    else:
        text = _("Likely: {first} ({share}).")
    said = say(text, first=first.fault, share=share, second=second.fault, next_share=other)
    return trusted(said, first.confidence)


def _short(name: str) -> str:
    return name if len(name) <= LONG else name[: LONG - 1] + "…"
