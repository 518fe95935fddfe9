"""What ``cardan diagnose`` says: causes by likelihood, what speaks for the first, what to check and to do."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cardan.texts import _

from .answer import Answer, Cell, Column, Remark, Table, Tone

if TYPE_CHECKING:
    from cardan.questions.diagnosis.examination import Examination
    from cardan.questions.diagnosis.findings import Finding
    from cardan.questions.diagnosis.match import Signs
    from cardan.report.block import Page
    from cardan.report.renderer import Renderer

SHOWN = 6
"""Causes in the terminal."""

LINES = 4
"""Orders named of a channel."""


@dataclass(frozen=True, kw_only=True)
class Diagnosed:
    """An answer with the page that a report of it has."""

    answer: Answer
    page: Callable[[], Page]
    title: str

    def written(self, path: Path, form: Renderer) -> Diagnosed:
        """Write the report, and return the answer that says so."""
        from cardan.files import write_bytes
        from cardan.report.content import Excerpt

        page = self.page()
        write_bytes(path, form.excerpt(Excerpt(title=self.title or page.title, page=page)))
        said, content = Remark(text=_("Report written: {path}.").format(path=path)), self.answer.content
        answer = replace(
            self.answer,
            remarks=(*self.answer.remarks, said),
            content=lambda: {**content(), "report": str(path)},
        )
        return replace(self, answer=answer)


def report_form(path: Path) -> Renderer:
    """Return the form of a report, or refuse its file before any work is done."""
    from cardan.report.renderer import form_of

    from .output import check_target

    form = form_of(path, "--report")
    check_target(path, "--report")
    return form


def by_recording(found: Examination, drive_path: Path, again: tuple[str, ...] = ()) -> Diagnosed:
    """Return what a recording tells; ``again`` is the command that asks for it."""
    from cardan.figures import for_result
    from cardan.questions.diagnosis.figures.examination import verdict

    def page() -> Page:
        from cardan.report.diagnosis import diagnosed

        return diagnosed(found)

    text = _("{signal}: {verdict}")
    return Diagnosed(
        answer=Answer(
            sentence=text.format(signal=found.signal.name, verdict=verdict(found.findings)),
            tone=_tone(found.findings),
            tables=lambda: (_causes(found.findings[:SHOWN]), _orders(found)),
            remarks=tuple(_remarks(found, again)),
            content=lambda: _content(found, drive_path),
            csv=lambda: _rows(found.findings),
            figure=lambda: for_result(found),
            code=_code(found.findings),
        ),
        page=page,
        title=found.drive.name,
    )


def by_signs(signs: Signs, catalogues: Sequence[Path]) -> Diagnosed:
    """Return what orders and symptoms alone tell."""
    from cardan.catalogue import catalogue
    from cardan.catalogue.catalogue import with_files
    from cardan.questions.diagnosis.figures.examination import causes_figure, verdict
    from cardan.questions.diagnosis.findings import diagnose

    findings = diagnose(signs, known=with_files(catalogue(), catalogues) if catalogues else None)

    def page() -> Page:
        from cardan.report.diagnosis import diagnosed_by_signs

        return diagnosed_by_signs(findings)

    def content() -> dict[str, Any]:
        return {
            "question": "diagnose",
            "orders": list(signs.orders),
            "torque_sensitive": signs.torque_sensitive,
            "symptom": signs.symptom,
            **_found(findings),
        }

    return Diagnosed(
        answer=Answer(
            sentence=verdict(findings),
            tables=lambda: (_causes(findings[:SHOWN]),),
            remarks=(*_first(findings), *(Remark(text=one, tone="warning") for one in findings[0].cautions)),
            content=content,
            csv=lambda: _rows(findings),
            figure=lambda: causes_figure(findings),
        ),
        page=page,
        title="",
    )


def _tone(findings: Sequence[Finding]) -> Tone:
    from cardan.questions.diagnosis.figures.examination import LIKELY

    first = findings[0]
    if first.score < LIKELY:
        return "warning"
    return "good" if first.cause == "healthy" else "failed"


def _code(findings: Sequence[Finding]) -> int:
    return 1 if _tone(findings) == "failed" else 0


def _causes(findings: Sequence[Finding]) -> Table:
    rows: list[list[Cell]] = [[100.0 * one.score, one.fault] for one in findings]
    columns = (
        Column(key="belief_percent", heading=_("belief"), unit="%", form=".0f"),
        Column(key="fault", heading=_("cause"), left=True, wrap=True),
    )
    return Table(columns=columns, rows=rows, fixed=1)


def _rows(findings: Sequence[Finding]) -> Table:
    keys = ("rank", "cause", "fault", "belief_percent", "confidence_percent", "check", "repair")
    rows: list[list[Cell]] = [
        [k, one.cause, one.fault, 100.0 * one.score, 100.0 * one.confidence, one.check, one.repair]
        for k, one in enumerate(findings, start=1)
    ]
    return Table(columns=tuple(Column(key=key) for key in keys), rows=rows)


def _orders(found: Examination) -> Table:
    """Return the highest orders of every channel that shakes."""
    from cardan.figures.wording import significant
    from cardan.questions.diagnosis.figures.orders import UNITS, order_text
    from cardan.units import spoken

    rows: list[list[Cell]] = []
    for one in found.spectra:
        unit, size = UNITS[one.quantity]
        lines = [f"{order_text(order)}: {significant(high / size, 3)}" for order, high in one.peaks(count=LINES)]
        place = next((own.place for own in found.signal.channels if own.name == one.name), "")
        rows.append([one.name, place or None, spoken(unit), ",  ".join(lines) or _("none")])
    columns = (
        Column(key="channel", heading=_("channel"), left=True),
        Column(key="place", heading=_("sits on"), left=True),
        Column(key="unit", heading=_("unit"), left=True),
        Column(key="orders", heading=_("its highest orders"), left=True, wrap=True),
    )
    return Table(columns=columns, rows=rows)


def _first(findings: Sequence[Finding]) -> Iterator[Remark]:
    """Yield what speaks for and against the first cause, what to check and to do."""
    first = findings[0]
    for text in first.evidence:
        yield Remark(text=_("For it: {text}").format(text=text))
    for text in first.against:
        yield Remark(text=_("Against it: {text}").format(text=text))
    yield Remark(text=_("Check: {text}").format(text=_ended(first.check)))
    yield Remark(text=_("Repair, once that is proved: {text}").format(text=_ended(first.repair)))


def _ended(text: str) -> str:
    return text if text.endswith((".", "?", "!")) else f"{text}."


def _remarks(found: Examination, again: tuple[str, ...]) -> Iterator[Remark]:
    from cardan.units import rpm

    from .answer import significant

    yield from _first(found.findings)
    low, high = (significant(one / rpm, 3) for one in found.rotation.speeds)
    sources = {
        "pulses": _("The shaft made {turns:.0f} turns from {low} to {high} rpm, by the pulses of the tacho."),
        "speed": _("The shaft made {turns:.0f} turns from {low} to {high} rpm, by a channel of the speed."),
        "angle": _("The shaft made {turns:.0f} turns from {low} to {high} rpm, by a channel of the angle."),
        "ridge": _("The shaft made {turns:.0f} turns from {low} to {high} rpm, as far as its vibration tells."),
    }
    yield Remark(text=sources[found.rotation.source].format(turns=found.rotation.turns, low=low, high=high))
    text = _("Confidence in the recording: {share:.0f} %.")
    poor = found.confidence < 0.6
    yield Remark(text=text.format(share=100.0 * found.confidence), tone="warning" if poor else "plain")
    for caution in found.cautions:
        yield Remark(text=caution, tone="warning")
    if again:
        command = (*again, "--report", "diagnosis.html")
        yield Remark(text=_("Everything with its pictures:"), command=command, tone="next")


def _content(found: Examination, drive_path: Path) -> dict[str, Any]:
    from cardan.questions.diagnosis.figures.orders import UNITS
    from cardan.units import rpm

    shaft = found.rotation
    return {
        "question": "diagnose",
        "drive": found.drive.name,
        "file": str(drive_path),
        "signal": found.signal.name,
        **_found(found.findings),
        "rotation": {
            "source": shaft.source,
            "confidence": shaft.confidence,
            "turns": shaft.turns,
            "speeds_rpm": [one / rpm for one in shaft.speeds],
            "alternatives": [{"factor": factor, "share": share} for factor, share in shaft.alternatives],
        },
        "critical_speed_rpm": found.critical / rpm,
        "shown": found.channel.name,
        "channels": [
            {
                "name": one.name,
                "quantity": one.quantity,
                "place": one.place,
                "direction": one.direction,
                "rate_Hz": one.rate,
                "duration_s": one.duration,
                "trust": one.trust,
                "tacho": k == found.signal.tacho,
            }
            for k, one in enumerate(found.signal.channels)
        ],
        "orders": [
            {
                "channel": one.name,
                "unit": UNITS[one.quantity][0],
                "peaks": [{"order": order, "amplitude": high / UNITS[one.quantity][1]} for order, high in one.peaks()],
            }
            for one in found.spectra
        ],
    }


def _found(findings: Sequence[Finding]) -> dict[str, Any]:
    return {
        "confidence": findings[0].confidence,
        "cautions": list(findings[0].cautions),
        "causes": [
            {
                "cause": one.cause,
                "fault": one.fault,
                "score": one.score,
                "evidence": list(one.evidence),
                "against": list(one.against),
                "check": one.check,
                "repair": one.repair,
            }
            for one in findings
        ],
    }
