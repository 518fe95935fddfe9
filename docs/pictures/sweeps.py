"""Pictures of sweeps: what ``cardan sweep show`` and designs draw, by the renderer of the program itself."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from cardan import figures
from cardan.batch.engine.running import run
from cardan.batch.figures.sweep import heat_figure, parallel_figure, pareto_figure
from cardan.batch.search.goals import Goal
from cardan.batch.table.results import results
from cardan.batch.table.views import map_of
from cardan.io.plan_designs import design_of
from cardan.io.plan_file import read_plan

PLANS = Path(__file__).parents[2] / "examples" / "sweeps"


class Drawn:
    """A figure of the program that is saved like one of matplotlib."""

    def __init__(self, figure: figures.Figure) -> None:
        self.figure = figure

    def savefig(self, path: Path, **_how: Any) -> None:
        """Draw it into a file."""
        figures.save(self.figure, path)


def _table(name: str) -> Any:
    return results(run(read_plan(PLANS / f"{name}.toml").work()))


def lines() -> Drawn:
    """Draw the tolerance field, a line for each drive."""
    found = _table("tolerance-field")
    columns = [column for column in found.columns if column.role != "status"]
    rows = found.sample([column.name for column in columns], 500)
    return Drawn(parallel_figure(columns, rows, goal=Goal(name="speed_fluctuation_percent"), total=found.count()))


def travel() -> Drawn:
    """Draw the speed fluctuation of a truck over travel and engine."""
    found = map_of(_table("truck-suspension"), "travel_mm", "input.point_mm[2]", "speed_fluctuation_percent")
    how = "mean of the points of a cell"
    return Drawn(heat_figure(found.across, found.up, found.value, found.x, found.y, found.values, how=how))


def offers() -> Drawn:
    """Draw the offers of suppliers between price and life."""
    found = _table("supplier-choice")
    goals = (Goal(name="price_eur"), Goal(name="life_h", largest=True))
    return Drawn(pareto_figure(found.columns, goals, found.pareto(goals), found.table()))


def shares() -> Drawn:
    """Draw what the speed fluctuation owes its spread to."""
    plan = read_plan(PLANS / "tolerance-field.toml")
    return Drawn(figures.for_result(design_of(plan, "sensitivity").run())[0])


def tongue() -> Drawn:
    """Draw where a test stand swings itself up."""
    plan = read_plan(PLANS / "stability-boundary.toml")
    return Drawn(figures.for_result(design_of(plan, "boundary").run())[0])


PICTURES: dict[str, Callable[[], Drawn]] = {
    "sweep-lines": lines,
    "sweep-map": travel,
    "sweep-offers": offers,
    "sweep-shares": shares,
    "sweep-tongue": tongue,
}
"""Name of the file -> function that draws it."""
