"""Figures: a library-neutral description made from a result, and renderers that draw any of them."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from pathlib import Path
from typing import Any

from .figure import Figure

_MAKERS = {
    "cardan.drive.drive.Drive": "drive.drive_figures",
    "cardan.analysis.motion.Motion": "motion.motion_figures",
    "cardan.analysis.equivalence.EquivalentJoint": "equivalence.equivalence_figures",
    "cardan.analysis.drive_forces.Forces": "forces.forces_figures",
    "cardan.analysis.moving_forces.MovingForces": "moving_forces.moving_forces_figures",
    "cardan.analysis.assembly.AssemblyForces": "assembly.assembly_figures",
    "cardan.analysis.mobility.Mobility": "mobility.mobility_figures",
    "cardan.analysis.mobility_turn.MobilityTurn": "mobility.turn_figures",
    "cardan.analysis.finite_mobility.FiniteMobility": "mobility.closure_figures",
    "cardan.analysis.losses.Losses": "losses.losses_figures",
    "cardan.analysis.losses.LossMap": "losses.map_figures",
    "cardan.analysis.life.Life": "life.life_figures",
    "cardan.analysis.strength.Strength": "strength.strength_figures",
    "cardan.synthesis.sized.Sizing": "sizing.sizing_figures",
    "cardan.synthesis.trade_off.TradeOff": "sizing.trade_off_figures",
    "cardan.analysis.tolerance.ToleranceBand": "tolerance.tolerance_figures",
    "cardan.analysis.accuracy.TransmissionError": "tolerance.error_figures",
    "cardan.analysis.book.BookComparison": "book.book_figures",
    "cardan.analysis.mathieu_reduction.MathieuReduction": "mathieu.reduction_figures",
    "cardan.analysis.absorbers.AbsorberResponse": "absorbers.response_figures",
    "cardan.analysis.absorber_tuning.Variants": "absorbers.variants_figures",
    "cardan.analysis.run_up.RunUp": "run_up.run_up_figures",
    "cardan.analysis.joint_run_up.JointRunUp": "run_up.joint_run_up_figures",
    "cardan.analysis.torsion.TorsionModes": "torsion.modes_figures",
    "cardan.analysis.torsion_response.TorsionResponse": "torsion_running.response_figures",
    "cardan.analysis.torsion_stability.Stability": "torsion_map.stability_figures",
    "cardan.analysis.torsion_transient.Transient": "torsion_transient.transient_figures",
    "cardan.analysis.bending.CriticalSpeeds": "bending.bending_figures",
    "cardan.analysis.speed_map.CriticalSpeedMap": "bending.speed_map_figures",
    "cardan.analysis.rotor_response.RotorResponse": "rotor.rotor_figures",
    "cardan.synthesis.phases.Phasing": "phases.phasing_figures",
    "cardan.synthesis.layout.Layout": "layout.layout_figures",
    "cardan.synthesis.absorber.Absorber": "calm.absorber_figures",
    "cardan.synthesis.calm.Calm": "calm.calm_figures",
    "cardan.analysis.articulation.Articulation": "articulation.articulation_figures",
    "cardan.diagnosis.orders.OrderSpectrum": "diagnosis.spectrum_figures",
    "cardan.diagnosis.orders.OrderMap": "diagnosis.map_figures",
    "cardan.diagnosis.order_tracks.TrackedOrders": "diagnosis.tracks_figures",
    "cardan.diagnosis.turning.Rotation": "diagnosis_motion.rotation_figures",
    "cardan.diagnosis.orbit.Orbit": "diagnosis_motion.orbit_figures",
    "cardan.diagnosis.torsional.TorsionalVibration": "diagnosis_motion.torsional_figures",
    "cardan.diagnosis.examination.Examination": "examination.examination_figures",
    "cardan.diagnosis.expected.Expected": "expected.expected_figures",
    "cardan.batch.sobol.Sensitivity": "sweep_designs.sensitivity_figures",
    "cardan.batch.sobol.Swings": "sweep_designs.swings_figures",
    "cardan.batch.views.Ranks": "sweep_designs.ranks_figure",
    "cardan.batch.boundary.Boundary": "sweep_designs.boundary_figure",
    "cardan.batch.pareto.ParetoSet": "sweep_designs.pareto_set_figure",
    "cardan.batch.optimise.Optimum": "sweep_designs.optimum_figure",
}
"""Result -> file and function of this folder that make its figures."""

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
        maker = _MAKERS.get(f"{kind.__module__}.{kind.__qualname__}")
        if maker:
            module, _dot, function = maker.partition(".")
            made = getattr(import_module(f".{module}", __name__), function)(result)
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
