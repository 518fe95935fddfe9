"""Last page: how it was calculated, and why to believe it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.answers import answer
from cardan.answers.answer import Cell, Column
from cardan.answers.quantity import Quantity, Text, say
from cardan.answers.reader import half_turn
from cardan.book.evidence import SelfCheck
from cardan.questions.motion.kinds import kind_name
from cardan.texts import _
from cardan.units import deg
from cardan.version import VERSION

from .block import Block, Listing, Page, Table, Words, table
from .description import signs
from .subject import Subject


def method(on: Subject, source_text: str | None) -> Page:
    """Return the page of the method and the evidence."""
    blocks: list[Block] = [
        signs(),
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
    text = (
        _("Calculated by cardan {version}; all self-checks pass at round-off level.")
        if passed
        else _("Calculated by cardan {version}; a self-check leaves more than rounding.")
    )
    said = text.format(version=VERSION)
    return Page(name="method", title=_("Method and evidence"), answer=said, blocks=blocks)


def _kinds(on: Subject) -> Iterator[Block]:
    """Yield how joints of other kinds count; nothing where there are none."""
    if not on.mixed:
        return
    yield Words(
        text=_(
            "A joint of another kind with tan θ′ = κ tan θ turns exactly like a Hooke joint with cos α = 1/κ, or with "
            "cos α = κ and its yoke a quarter turn ahead where κ is below 1. With these in place of the joints the "
            "drive is a chain of Hooke joints; their joint angles stand in the equations."
        )
    )
    joints = on.drive.joints
    yield table(
        answer.Table(
            title=_("Joints and the Hooke joints that turn alike"),
            columns=(
                Column(key="joint", heading=_("joint"), values=list(range(1, on.joints + 1))),
                Column(key="kind", heading=_("kind"), values=[kind_name(joint) for joint in joints]),
                Column(
                    key="joint_angle", heading=_("joint angle α"), values=on.joint_angle, dimension="angle", decimals=2
                ),
                Column(
                    key="hooke",
                    heading=_("of the Hooke joint"),
                    values=on.train.joint_angle,
                    dimension="angle",
                    decimals=3,
                ),
            ),
        )
    )


def _equations(on: Subject) -> Table:
    lines = list(_lines(on))
    return table(
        answer.Table(
            title=_("Equations used"),
            columns=(
                Column(key="what", heading=_("what"), values=[name for name, *_rest in lines]),
                Column(key="equation", heading=_("equation"), values=[line for _n, line, *_rest in lines], left=True),
                Column(
                    key="numbers",
                    heading=_("with the numbers of this drive"),
                    values=[put for _n, _l, put, _s in lines],
                    left=True,
                ),
                Column(key="source", heading=_("source"), values=[source for *_rest, source in lines]),
            ),
        )
    )


def _lines(on: Subject) -> Iterator[tuple[str, Cell, Text, str]]:
    """Yield what is calculated, its equation, the same with numbers, and its source."""
    a, b = (float(abs(part)) for part in on.whole.pair)
    if on.even:
        b = 0.0
    pair = {"a": Quantity(a, decimals=6), "b": Quantity(b, decimals=6)}
    half = 0.5 * float(on.train.joint_angle[0])
    yield (
        _("joint 1"),
        Cell(value="τ = tan²(α/2)", formula="tau = tan^2 alpha/2"),
        say("tan²({half}) = {tau}", half=_angle(half, 3), tau=Quantity(float(np.tan(half)) ** 2)),
        _("Kozhevnikov & Perfil'ev (1978), eq. 18, as a map of the circle"),
    )
    if on.joints > 1:
        turn = np.asarray(on.train.turn_before)[1]
        gamma, beta = (_angle(float(part[0])) for part in (on.train.yoke_angle, on.train.plane_twist))
        yield (
            _("between joints 1 and 2"),
            Cell(value="μ = 90° − γ − β", formula="mu = 90° - gamma - beta"),
            say("90° − ({gamma}) − ({beta}) = {turn}", gamma=gamma, beta=beta, turn=_as_line(float(turn))),
            _("Kozhevnikov & Perfil'ev (1978), eq. 31, 38"),
        )
    yield (
        _("whole drive"),
        Cell(
            value="G = J R … J R = [[a, b], [b̄, ā]]",
            formula='G = J R dots.h.c J R = mat(a, b; macron(b), macron(a); delim: "[")',
        ),
        say("|a| = {a}, |b| = {b}", **pair),
        _("matrix product"),
    )
    yield (
        _("speed fluctuation"),
        Cell(value="δ = 4|a||b|", formula="delta = 4 abs(a) abs(b)"),
        say("4 · {a} · {b} = {delta}", **pair, delta=Quantity(4.0 * a * b)),
        _("Kozhevnikov & Perfil'ev (1978), eq. 79, exact"),
    )
    yield (
        _("equivalent joint"),
        Cell(value="cos α = (|a| − |b|)²", formula="cos alpha = (abs(a) - abs(b))^2"),
        say("({a} − {b})² = {cosine}", **pair, cosine=Quantity((a - b) ** 2, digits=6)),
        _("matrix product"),
    )
    yield (
        _("angle error"),
        Cell(value="arcsin τ, τ = |b|/|a|", formula="arcsin tau, quad tau = abs(b)/abs(a)"),
        say("arcsin {tau} = {error}", tau=Quantity(b / a), error=Quantity(float(np.arcsin(b / a)), "angle")),
        _("extreme of Kozhevnikov & Perfil'ev (1978), eq. 19"),
    )
    closing = on.closing
    if on.joints > 1:
        sign = "≤" if closing.closes else ">"
        if not closing.closes and on.rounding(on.phasing.speed_fluctuation_min):
            sign = "≈"
        yield (
            _("can be uniform"),
            Cell(
                value=_("L_max ≤ Σ of the others, L = −ln cos α"),
                formula="L_max <= sum L - L_max, quad L = -ln cos alpha",
            ),
            say(
                "{longest} {sign} {others}",
                longest=Quantity(float(closing.length[closing.longest - 1]), decimals=5),
                sign=sign,
                others=Quantity(float(closing.others), decimals=5),
            ),
            _("in place of Kozhevnikov & Perfil'ev (1978), eq. 77, 86"),
        )


def _angle(value: float, decimals: int = 2) -> Quantity:
    return Quantity(value, "angle", decimals=decimals)


def _as_line(angle: float) -> Text:
    """Return an angle [rad], and where it is another that in (-90°, 90°] which means the same: yokes are lines."""
    line = half_turn(angle / deg) * deg
    if round(angle / deg, 2) == round(line / deg, 2):
        return _angle(angle)
    return say("{own} ≡ {line} (mod 180°)", own=_angle(angle), line=_angle(line))


def _checks(on: Subject) -> Table:
    every = list(on.checks)
    if on.replayed is not None and on.best is not None:
        # Sampled at whole steps: the swing seen can fall short of the true one by the curvature of the peak.
        every.append(
            SelfCheck(
                name=_("speed fluctuation at setting {label}").format(label=on.best.label),
                way=_("output speed by plain vectors, sampled over a turn"),
                residual=abs(on.replayed - on.best.speed_fluctuation),
                allowed=1e-12 + 0.001 * on.best.speed_fluctuation,
            )
        )
    verdicts = [
        Cell(value=_("passed"), tone="good") if one.passed else Cell(value=_("failed"), tone="failed") for one in every
    ]
    return table(
        answer.Table(
            title=_("Self-checks on this drive"),
            columns=(
                Column(key="what", heading=_("what"), values=[one.name for one in every]),
                Column(key="way", heading=_("compared with"), values=[one.way for one in every]),
                Column(key="residual", heading=_("residual"), values=[float(one.residual) for one in every], digits=2),
                Column(key="allowed", heading=_("allowed"), values=[float(one.allowed) for one in every], digits=2),
                Column(key="verdict", heading=_("verdict"), values=verdicts, left=True),
            ),
        )
    )
