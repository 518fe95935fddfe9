"""Figures: a library-neutral description made from a result, and renderers that draw any of them."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from pathlib import Path
from typing import Any

from .figure import Figure

_MAKERS = {
    "drive.drive.Drive": "figures.drive.drive_figures",
    "questions.motion.motion.Motion": "questions.motion.figures.motion.motion_figures",
    "questions.motion.equivalence.EquivalentJoint": "questions.motion.figures.equivalence.equivalence_figures",
    "questions.forces.drive_forces.Forces": "questions.forces.figures.forces.forces_figures",
    "questions.forces.moving_forces.MovingForces": "questions.forces.figures.moving_forces.moving_forces_figures",
    "questions.forces.assembly.AssemblyForces": "questions.forces.figures.assembly.misalignment_figures",
    "questions.mobility.mobility.Mobility": "questions.mobility.figure.mobility_figures",
    "questions.mobility.mobility_turn.MobilityTurn": "questions.mobility.figure.turn_figures",
    "questions.mobility.finite_mobility.FiniteMobility": "questions.mobility.figure.closure_figures",
    "questions.losses.losses.Losses": "questions.losses.figure.losses_figures",
    "questions.losses.losses.LossMap": "questions.losses.figure.map_figures",
    "questions.life.life.Life": "questions.life.figure.life_figures",
    "checks.strength.strength.Strength": "checks.strength.figure.strength_figures",
    "choices.sized.Sizing": "choices.figure.sizing_figures",
    "choices.trade_off.TradeOff": "choices.figure.trade_off_figures",
    "questions.accuracy.tolerance.ToleranceBand": "questions.accuracy.figure.tolerance_figures",
    "questions.accuracy.accuracy.TransmissionError": "questions.accuracy.figure.error_figures",
    "book.comparison.BookComparison": "book.figures.comparison.book_figures",
    "book.mathieu_reduction.MathieuReduction": "book.figures.mathieu.reduction_figures",
    "formulas.absorbers.AbsorberResponse": "formulas.figures.absorbers.response_figures",
    "formulas.absorber_tuning.Variants": "formulas.figures.absorbers.variants_figures",
    "formulas.run_up.RunUp": "formulas.figures.run_up.run_up_figures",
    "formulas.joint_run_up.JointRunUp": "formulas.figures.run_up.joint_run_up_figures",
    "questions.torsion.model.torsion.TorsionModes": "questions.torsion.model.figure.modes_figures",
    "questions.torsion.steady.torsion_response.TorsionResponse": "questions.torsion.steady.figure.response_figures",
    "questions.torsion.stability.torsion_stability.Stability": "questions.torsion.stability.figure.stability_figures",
    "questions.torsion.transient.torsion_transient.Transient": "questions.torsion.transient.figure.transient_figures",
    "questions.bending.bending.CriticalSpeeds": "questions.bending.figures.bending.bending_figures",
    "questions.bending.speed_map.CriticalSpeedMap": "questions.bending.figures.bending.speed_map_figures",
    "questions.bending.rotor_response.RotorResponse": "questions.bending.figures.rotor.rotor_figures",
    "questions.phases.phases.Phasing": "questions.phases.figures.phases.phasing_figures",
    "questions.phases.layout.Layout": "questions.phases.figures.layout.layout_figures",
    "questions.torsion.absorber.absorber.Absorber": "questions.torsion.absorber.figure.absorber_figures",
    "questions.torsion.calm.calm.Calm": "questions.torsion.calm.figure.calm_figures",
    "questions.motion.articulation.Articulation": "questions.motion.figures.articulation.articulation_figures",
    "questions.diagnosis.signals.orders.OrderSpectrum": "questions.diagnosis.figures.orders.spectrum_figures",
    "questions.diagnosis.signals.orders.OrderMap": "questions.diagnosis.figures.orders.map_figures",
    "questions.diagnosis.signals.order_tracks.TrackedOrders": "questions.diagnosis.figures.orders.tracks_figures",
    "questions.diagnosis.signals.turning.Rotation": "questions.diagnosis.figures.motion.rotation_figures",
    "questions.diagnosis.signals.orbit.Orbit": "questions.diagnosis.figures.motion.orbit_figures",
    "questions.diagnosis.signals.torsional.TorsionalVibration": "questions.diagnosis.figures.motion.torsional_figures",
    "questions.diagnosis.examination.Examination": "questions.diagnosis.figures.examination.examination_figures",
    "questions.diagnosis.expected.Expected": "questions.diagnosis.figures.expected.expected_figures",
    "batch.search.sobol.Sensitivity": "batch.figures.designs.sensitivity_figures",
    "batch.search.sobol.Swings": "batch.figures.designs.swings_figures",
    "batch.table.views.Ranks": "batch.figures.designs.ranks_figure",
    "batch.search.boundary.Boundary": "batch.figures.designs.boundary_figure",
    "batch.search.pareto.ParetoSet": "batch.figures.designs.pareto_set_figure",
    "batch.search.optimise.Optimum": "batch.figures.designs.optimum_figure",
}
"""Result -> module and function that make its figures."""

SUFFIXES = (".svg", ".png", ".pdf", ".html")
"""Kinds of picture that `save` writes."""

__all__ = ["SUFFIXES", "Figure", "drawn", "for_result", "save"]


def for_result(result: Any) -> tuple[Figure, ...]:
    """Return the figures of a result.

    Parameters
    ----------
    result : object
        A drive, or the result of a question.

    Raises
    ------
    TypeError
        There is no figure for such a thing.

    Examples
    --------
    >>> from cardan.drive.drive import Drive
    >>> [figure.name for figure in for_result(Drive.from_angles([0.2, 0.2]))]
    ['views', 'space', 'yokes']
    """
    for kind in type(result).__mro__:
        maker = _MAKERS.get(f"{kind.__module__}.{kind.__qualname__}".removeprefix("cardan."))
        if maker:
            module, _dot, function = maker.rpartition(".")
            made = getattr(import_module(f"cardan.{module}"), function)(result)
            return (made,) if isinstance(made, Figure) else tuple(made)
    raise TypeError(f"no figure shows a {type(result).__name__}")


def save(figures: Figure | Sequence[Figure], path: Path | str) -> Path:
    """Draw figures into a file, whole or not at all.

    Parameters
    ----------
    figures : Figure or sequence of Figure
        What to draw, from the top; in a PDF one a page.
    path : path
        Its suffix says how: .svg, .png, .pdf, or .html to turn and measure it in a browser.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    InputError
        The suffix is none of these, or the file cannot be written.
    """
    from cardan.files import write_bytes

    place = Path(path)
    write_bytes(place, drawn(figures, place.suffix.lower(), str(path)))
    return place


def drawn(figures: Figure | Sequence[Figure], suffix: str, name: str = "") -> bytes:
    """Return the file of a picture of figures.

    Parameters
    ----------
    figures : Figure or sequence of Figure
        What to draw, from the top; in a PDF one a page.
    suffix : str
        One of `SUFFIXES`.
    name : str
        What messages call the file.

    Raises
    ------
    InputError
        The suffix is none of these.
    """
    from cardan.errors import refuse
    from cardan.texts import _

    if suffix not in SUFFIXES:
        known = ", ".join(SUFFIXES)
        raise refuse("path", _("{path} should end in one of {known}").format(path=name or suffix, known=known))
    from cardan.answers.reader import reader

    from .for_reader import for_reader

    given = (figures,) if isinstance(figures, Figure) else tuple(figures)
    several = tuple(for_reader(one, reader()) for one in given)
    if suffix == ".html":
        from .render_plotly import render as page

        return page(several).encode("utf-8")
    if suffix == ".svg":
        from .render_svg import document

        return document(several).encode("utf-8")
    import io

    from .render_matplotlib import render

    stream = io.BytesIO()
    render(several, stream, suffix[1:])  # type: ignore[arg-type]
    return stream.getvalue()
