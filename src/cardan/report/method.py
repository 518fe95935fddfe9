"""Last page: how it was calculated, and why to believe it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan import __version__
from cardan.figures.wording import angular, fixed, half_turn, significant
from cardan.questions.motion.kinds import kind_name
from cardan.texts import _
from cardan.units import deg

from .block import Block, Cell, Column, Listing, Page, Table, Words, number, words
from .subject import Subject


def method(on: Subject, source_text: str | None) -> Page:
    """Return the page of the method and the evidence."""
    blocks: list[Block] = [
        Words(
            text=_(
                "A universal joint is a Möbius map of the unit circle: with w = e^(2iθ), θ the angle of the driving "
                "yoke, it maps w to (w − τ)/(1 − τw), τ = tan²(α/2). A chain of joints is a product of 2×2 matrices, "
                "so it moves exactly like one joint. Nothing here is a small-angle approximation unless it says so."
            )
        ),
        *_kinds(on),
        _equations(on),
        _checks(on),
    ]
    if source_text is not None:
        blocks.append(Listing(title=_("Input file"), text=source_text))
    passed = all(check.passed for check in on.checks)
    answer = (
        _("Calculated by cardan {version}; all self-checks leave nothing but rounding.")
        if passed
        else _("Calculated by cardan {version}; a self-check leaves more than rounding.")
    )
    return Page(name="method", title=_("Method and evidence"), answer=answer.format(version=__version__), blocks=blocks)


def _kinds(on: Subject) -> Iterator[Block]:
    """Yield how joints of other kinds count; nothing where there are none."""
    if not on.mixed:
        return
    yield Words(
        text=_(
            "A joint of another kind with tan θ′ = κ tan θ turns exactly like a Hooke joint with cos α = 1/κ, or with "
            "cos α = κ and its yoke a quarter turn ahead where κ is below 1. With these in place of the joints the "
            "drive is a chain of Hooke joints; their bends stand in the equations."
        )
    )
    rows = [
        [words(str(k)), words(kind_name(joint)), number(fixed(float(own) / deg), float(own) / deg), _equal(float(bend))]
        for k, (joint, own, bend) in enumerate(zip(on.drive.joints, on.bend, on.train.bend, strict=True), start=1)
    ]
    yield Table(
        title=_("Joints and the Hooke joints that turn alike"),
        columns=(
            Column(heading=_("joint")),
            Column(heading=_("kind"), left=True),
            Column(heading=_("bend α"), unit="°"),
            Column(heading=_("of the Hooke joint"), unit="°"),
        ),
        rows=rows,
    )


def _equal(bend: float) -> Cell:
    return number(fixed(bend / deg, 3), bend / deg)


def _equations(on: Subject) -> Table:
    rows = [[words(name), line, words(put), words(source)] for name, line, put, source in _lines(on)]
    return Table(
        title=_("Equations used"),
        columns=(
            Column(heading=_("what"), left=True),
            Column(heading=_("equation"), left=True),
            Column(heading=_("with the numbers of this drive"), left=True),
            Column(heading=_("source"), left=True),
        ),
        rows=rows,
    )


def _lines(on: Subject) -> Iterator[tuple[str, Cell, str, str]]:
    """Yield what is calculated, its equation, the same with numbers, and its source."""
    a, b = (float(abs(part)) for part in on.whole.pair)
    if on.even:
        b = 0.0
    half = 0.5 * float(on.train.bend[0])
    yield (
        _("joint 1"),
        Cell(text="τ = tan²(α/2)", formula="tau = tan^2 alpha/2"),
        f"tan²({fixed(half / deg, 3)}°) = {significant(float(np.tan(half)) ** 2)}",
        _("Book (18), as a map of the circle"),
    )
    if on.joints > 1:
        turn = np.asarray(on.train.turn_before)[1]
        gamma, beta = (fixed(float(part[0]) / deg) for part in (on.train.yoke_angle, on.train.plane_twist))
        yield (
            _("between joints 1 and 2"),
            Cell(text="μ = 90° − γ − β", formula="mu = 90° - gamma - beta"),
            f"90° − ({gamma}°) − ({beta}°) = {_as_line(float(turn) / deg)}",
            _("Book (31), (38)"),
        )
    yield (
        _("whole drive"),
        Cell(
            text="G = J R … J R = [[a, b], [b̄, ā]]",
            formula='G = J R dots.h.c J R = mat(a, b; macron(b), macron(a); delim: "[")',
        ),
        f"|a| = {fixed(a, 6)}, |b| = {fixed(b, 6)}",
        _("matrix product"),
    )
    yield (
        _("irregularity"),
        Cell(text="δ = 4|a||b|", formula="delta = 4 abs(a) abs(b)"),
        f"4 · {fixed(a, 6)} · {fixed(b, 6)} = {significant(4.0 * a * b)}",
        _("Book (79), exact"),
    )
    yield (
        _("equivalent joint"),
        Cell(text="cos α = (|a| − |b|)²", formula="cos alpha = (abs(a) - abs(b))^2"),
        f"({fixed(a, 6)} − {fixed(b, 6)})² = {significant((a - b) ** 2, 6)}",
        _("matrix product"),
    )
    yield (
        _("ahead and back"),
        Cell(text="arcsin τ, τ = |b|/|a|", formula="arcsin tau, quad tau = abs(b)/abs(a)"),
        f"arcsin {significant(b / a)} = {angular(float(np.arcsin(b / a)) / deg)}°",
        _("extreme of Book (19)"),
    )
    closing = on.closing
    if on.joints > 1:
        sign = "≤" if closing.closes else ">"
        if not closing.closes and on.rounding(on.phasing.irregularity_min):
            sign = "≈"
        yield (
            _("can be even"),
            Cell(
                text=_("L_max ≤ Σ of the others, L = −ln cos α"),
                formula="L_max <= sum L - L_max, quad L = -ln cos alpha",
            ),
            f"{fixed(float(closing.length[closing.longest - 1]), 5)} {sign} {fixed(closing.others, 5)}",
            _("in place of Book (77), (86)"),
        )


def _as_line(angle: float) -> str:
    """Return an angle [°], and where it is another the one in (-90, 90] that means the same: yokes are lines."""
    own, line = fixed(angle), fixed(half_turn(angle))
    return f"{own}°" if own == line else f"{own}° ≡ {line}° (mod 180°)"


def _checks(on: Subject) -> Table:
    rows: list[list[Cell]] = [
        [
            words(check.name),
            words(check.way),
            number(_small(check.residual), check.residual),
            number(_small(check.allowed), check.allowed),
            words(_("passed") if check.passed else _("failed"), "good" if check.passed else "failed"),
        ]
        for check in on.checks
    ]
    if on.replayed is not None and on.best is not None:
        miss = abs(on.replayed - on.best.irregularity)
        # Sampled at whole steps: the swing seen can fall short of the true one by the curvature of the peak.
        allowed = 1e-12 + 0.001 * on.best.irregularity
        good = miss <= allowed
        rows.append(
            [
                words(_("irregularity at setting {label}").format(label=on.best.label)),
                words(_("swing of the output by plain vectors, sampled over a turn")),
                number(_small(miss), miss),
                number(_small(allowed), allowed),
                words(_("passed") if good else _("failed"), "good" if good else "failed"),
            ]
        )
    return Table(
        title=_("Self-checks on this drive"),
        columns=(
            Column(heading=_("what"), left=True),
            Column(heading=_("compared with"), left=True),
            Column(heading=_("residual")),
            Column(heading=_("allowed")),
            Column(heading=_("verdict"), left=True),
        ),
        rows=rows,
    )


def _small(value: float) -> str:
    return "0" if value == 0.0 else significant(value, 2)
