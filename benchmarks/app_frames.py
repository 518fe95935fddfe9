"""The app: frames a second of the drive turning, in a browser that draws without a graphics card."""

from __future__ import annotations

import math
import os
import statistics
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from .browser import opened
from .harness import Figure

AIM = 50.0
"""Frames a second."""

EXAMPLE = "truck-printed-angles"


def busy() -> float:
    """Return the processor time of all processes that this one has begun, theirs included [s]; nan off Linux."""
    spent: dict[int, float] = {}
    begun: dict[int, list[int]] = {}
    for entry in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = entry.read_text().rpartition(")")[2].split()
        except OSError:  # it has just ended
            continue
        number = int(entry.parent.name)
        begun.setdefault(int(fields[1]), []).append(number)
        spent[number] = (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def below(number: int) -> float:
        return sum(spent[one] + below(one) for one in begun.get(number, []))

    return below(os.getpid()) if spent else math.nan


def watched(page: Any, spans: int) -> tuple[list[float], float, dict[str, Any]]:
    """Return the frames a second in spans of two seconds, the processor time of one [s], and how they were drawn."""
    page.wait_for_function("window.cardanView && cardanView.playing && cardanView.bodies.thinned !== undefined")
    page.wait_for_timeout(4000)  # thinner forms of the bodies are ready, the curves have been drawn
    frames = "cardanView.renderer.info.render.frame"
    rates, first, begin = [], page.evaluate(frames), busy()
    for _span in range(spans):
        page.wait_for_timeout(2000)
        rates.append(float(page.evaluate("cardanView.fps")))
    each = (busy() - begin) / max(page.evaluate(frames) - first, 1)
    return rates, each, dict(page.evaluate("cardanView.state"))


def figures(quick: bool) -> Iterator[Figure]:
    with opened(EXAMPLE) as page:
        rates, each, drawn = watched(page, 1 if quick else 8)
        size = page.evaluate("[cardanView.width, cardanView.height].join(' x ')")
    how = f"{size} pixels, {drawn['triangles']} triangles in {drawn['calls']} calls, quality {drawn['level']}"
    for name, rate in (("middle", statistics.median(rates)), ("slowest two seconds", min(rates))):
        yield Figure(
            bench=f"frames of {EXAMPLE} in the app, {name}: {how}",
            value=rate,
            unit="1/s",
            yardstick="50 1/s without a graphics card, aim ≥ 1",
            ratio=rate / AIM,
        )
    yield Figure(
        bench=f"processor time of a frame of {EXAMPLE} in the app, browser and server: {how}",
        value=1e3 * each,
        unit="ms",
        yardstick="40 ms: two cores at 50 frames a second, aim ≤ 1",
        ratio=1e3 * each * AIM / 2e3,
    )
