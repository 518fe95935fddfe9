"""What there is to say of a sized part: the smallest size, what decides it, what the sizes of the catalogue use."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from cardan.answers.answer import FILE, Answer, Cell, Column, Remark, Table, Tone
from cardan.answers.quantity import Joined, Quantity, Text, Unit, say
from cardan.catalogue import Catalogue
from cardan.checks.verdict import Verdict
from cardan.checks.verdict_table import MOST, amount, limit, share, unconfirmed_remark
from cardan.drive.drive import Drive
from cardan.drive.fields.keys import key_of
from cardan.errors import refuse
from cardan.figures.figure import Figure
from cardan.questions.torsion.stability.in_use import larger_in_use
from cardan.texts import _
from cardan.units import factor

from .figure import sizing_figures, trade_off_figures
from .size_search import Sizing, Tried, used
from .trade_off import trade_off

AT_LIMIT = 0.999
"""Share of a limit from which a part is said to be at it; less where it passes by a jump."""


def answer(
    drive: Drive, result: Sizing, *, known: Catalogue | None = None, progress: Callable[[float], object] | None = None
) -> Answer:
    """Return what there is to say of a sized part."""
    return Answer(
        name="size",
        title=_("Size of a part"),
        sentence=_sentence(result),
        tone="plain" if result.found else "failed",
        tables=tuple(_tables(result)),
        remarks=tuple(_remarks(result)),
        figures=lambda: _figures(drive, result, known, progress),
        facts=_facts(result),
        full=lambda: _rows(result),
        code=0 if result.found else 1,
    )


def _figures(
    drive: Drive, found: Sizing, known: Catalogue | None, progress: Callable[[float], object] | None
) -> tuple[Figure, ...]:
    """Return the figures: of a tube those it is compared with, of anything else its limits."""
    if found.part not in ("tube", "shaft") or _stepped(found):
        return sizing_figures(found)
    number = _number(found)
    if not 1 < number <= len(drive.joints):
        raise refuse("--plot", _("only shafts between two joints are compared with other tubes"))
    compared = found.drive if drive.shafts[number - 1].outer is None else drive  # with the tube as it stands, if any
    return trade_off_figures(trade_off(compared, None, number, known=known, progress=progress))


def _sentence(found: Sizing) -> Text:
    if not found.found:
        return _("no size of the catalogue carries it.")
    if found.tried:
        return say(_("{sizes} is the smallest size that passes."), sizes=sizes(found))
    first = found.governing
    title = "" if first is None else first.title
    if first is not None and used(first) < AT_LIMIT:
        return say(_("{sizes} is the smallest size found that passes."), sizes=sizes(found))
    return say(_("{sizes}, where {title} is just at its limit."), sizes=sizes(found), title=title)


def sizes(found: Sizing) -> Text:
    """Return the sizes found, in words."""
    if found.tried:
        return str(next(iter(found.values.values())))
    if _stepped(found):
        path, value = next(iter(found.exact.items()))
        grown = Quantity(value / float(found.before[path] or value))
        return say(_("all diameters times {factor}"), factor=grown)
    words = {
        "outer": (_("outer diameter {value}"), "length", "mm"),
        "wall": (_("wall {value}"), "length", "mm"),
        "ply_thickness": (_("plies of {value}"), "length", "mm"),
        "journal": (_("journal {value}"), "length", "mm"),
        "capacity": (_("dynamic capacity {value}"), "force", "N"),
        "static_capacity": (_("static capacity {value}"), "force", "N"),
    }
    said: list[Text] = []
    for path, value in found.exact.items():
        name, _sign, _unit = path.rpartition(".")[2].rpartition("_")
        text, dimension, unit = words[name]
        said.append(say(text, value=Quantity(value * factor(dimension, unit), dimension)))
    return Joined(said)


def _tables(found: Sizing) -> Iterator[Table]:
    yield _records("limits", found.limits)
    yield _records("limits_as_made", found.made)
    if found.tried:
        yield _catalogued(found.tried)
        return
    paths = list(found.values)
    yield Table(
        columns=(
            Column(key="", heading=_("key"), values=paths, left=True),
            Column(key="", heading=_("now"), values=[found.before.get(path) for path in paths]),
            Column(key="", heading=_("at the limit"), values=[found.exact.get(path) for path in paths]),
            Column(key="", heading=_("as made"), values=[_value(one) for one in found.values.values()]),
        )
    )
    yield _verdicts(found)


def _value(value: float | str | None) -> str:
    if value is None:
        return _("left out")
    return value if isinstance(value, str) else f"{value:.10g}"


def _stepped(found: Sizing) -> bool:
    """Tell whether it is the stretches of a stepped shaft that were sized."""
    return any(".segments[" in path for path in found.exact)


def _verdicts(found: Sizing) -> Table:
    made = {(one.check, one.title): float(one.utilisation) for one in found.made}
    order = sorted(found.limits, key=lambda one: -float(one.utilisation))
    return Table(
        columns=(
            Column(
                key="",
                heading=_("utilisation"),
                values=[float(one.utilisation) for one in order],
                decimals=3,
                most=MOST,
            ),
            Column(
                key="",
                heading=_("as made"),
                values=[made.get((one.check, one.title)) for one in order],
                decimals=3,
                most=MOST,
            ),
            Column(
                key="", heading=_("value"), values=[Cell(value=amount(one, one.value), unit=False) for one in order]
            ),
            Column(key="", heading=_("limit"), values=[limit(one) for one in order], left=True),
            Column(key="", heading=_("what"), values=[one.title for one in order], left=True, wrap=True),
        )
    )


def _records(name: str, verdicts: Sequence[Verdict]) -> Table:
    """Return verdicts for programs."""
    value, bound = (
        [Quantity(float(number), one.dimension, unit=one.unit) for one, number in zip(verdicts, numbers, strict=True)]
        for numbers in ([one.value for one in verdicts], [one.bound for one in verdicts])
    )
    columns: Mapping[str, Any] = {
        "check": [one.check for one in verdicts],
        "title": [one.title for one in verdicts],
        "value": value,
        "limit": bound,
        "unit": [Unit(one.dimension, one.unit) for one in verdicts],
        "utilisation": [float(one.utilisation) for one in verdicts],
        "source": [one.source for one in verdicts],
    }
    return Table(
        name=name, records=True, depth="data", columns=[Column(key=key, values=one) for key, one in columns.items()]
    )


def _catalogued(tried: Sequence[Tried]) -> Table:
    states = [_tone(one) for one in tried]
    worst = [_governing(one) for one in tried]
    missing = [[key_of(path) for path in one.missing] for one in tried]
    return Table(
        name="tried",
        records=True,
        columns=(
            Column(
                key="",
                heading=_("size"),
                values=[Cell(value=one.id, tone=tone) for one, tone in zip(tried, states, strict=True)],
                left=True,
            ),
            Column(key="size", values=[one.id for one in tried], depth="data"),
            Column(key="outer", heading=_("outer diameter"), values=[one.outer for one in tried], dimension="length"),
            Column(key="mass", heading=_("mass"), values=[one.mass for one in tried], dimension="mass"),
            Column(
                key="utilisation",
                heading=_("utilisation"),
                values=[one.utilisation for one in tried],
                decimals=2,
                most=MOST,
            ),
            Column(key="passed", values=[one.passed for one in tried], depth="data"),
            Column(key="missing", values=missing, depth="data"),
            Column(key="worst", heading=_("governing"), values=worst, left=True, wrap=True),
        ),
    )


def _tone(tried: Tried) -> Tone:
    """Return how a size stands: one of which too little is known neither passes nor fails."""
    if tried.utilisation > 1.0:
        return "failed"
    return "good" if tried.passed else "plain"


def _governing(tried: Tried) -> str:
    """Return what decides on a size, or what is not known of it."""
    if tried.worst is None:
        return _("nothing could be judged")
    if tried.utilisation <= 1.0 and tried.unknown:
        return {"torque": _("not judged: no torque rating"), "life": _("not judged: no rating of its life")}[
            tried.unknown
        ]
    return tried.worst.title


def _remarks(found: Sizing) -> Iterator[Remark]:
    yield from larger_in_use(found.drive)
    if not found.found:
        failed = [one for one in found.tried if one.utilisation > 1.0]
        for last in failed[-1:]:
            assert last.worst is not None
            text = _("Failed: even {size} is at {used} of its limit: {title}.")
            said = say(text, size=last.id, used=share(last.utilisation), title=last.worst.title)
            yield Remark(text=said, tone="failed")
        yield Remark(text=_("Rows of a maker's own are added with --catalogue FILE."))
        return
    if found.skipped:
        keys = ", ".join(dict.fromkeys(key_of(path) for path in found.skipped))
        text = _("Some checks do not count in this size; the file lacks {keys}.")
        yield Remark(text=text.format(keys=keys), tone="warning")
    if found.governing is not None:
        yield from unconfirmed_remark([found.governing])
    text = _("Write it into a copy of the file, and look again:")
    part = found.part + (f":{_number(found)}" if found.subject else "")
    command = ("cardan", "strength", FILE, "--size", part, "-o", "sized.toml")
    yield Remark(text=text, command=command, tone="next")


def _number(found: Sizing) -> int:
    return int(found.subject.partition("[")[2].rstrip("]")) + 1


def _rows(found: Sizing) -> Table:
    if found.tried:
        table = _catalogued(found.tried)
        return replace(table, name="", columns=[one for one in table.columns if one.key not in ("passed", "missing")])
    paths = list(found.values)
    return Table(
        columns=(
            Column(key="path", values=paths),
            Column(key="now", values=[found.before.get(path) for path in paths]),
            Column(key="at_limit", values=[found.exact.get(path) for path in paths]),
            Column(key="as_made", values=list(found.values.values())),
        )
    )


def _facts(found: Sizing) -> dict[str, Any]:
    first = found.governing
    return {
        "part": found.part,
        "subject": found.subject,
        "found": found.found,
        "at_limit": dict(found.exact),
        "as_made": dict(found.values),
        "now": dict(found.before),
        "series": found.series,
        "governing": None if first is None else first.check,
        "not_counted": [key_of(path) for path in found.skipped],
    }


def written(said: Answer, found: Sizing, path: str) -> Answer:
    """Return the answer with a word on the file that the size was written into."""
    values = dict(found.values)
    kept = [remark for remark in said.remarks if remark.tone != "next"]
    listed = ", ".join(f"{key} = {_value(value)}" for key, value in values.items())
    done = Remark(text=_("{path}: {sizes} written.").format(path=path, sizes=listed), tone="good")
    step = Remark(text=_("Judge the new drive:"), command=("cardan", "check", path), tone="next")
    return replace(said, remarks=(*kept, done, step), facts={**said.facts, "written": {"file": path, "values": values}})
