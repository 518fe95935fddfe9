"""What ``cardan strength --size`` says: the smallest size, what decides it, and how it is written into a file."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cardan.texts import _

from .answer import Answer, Column, Remark, Table, significant

if TYPE_CHECKING:
    from cardan.catalogue import Catalogue
    from cardan.choices.sized import Sizing
    from cardan.drive.drive import Drive

    from .answer import Cell, Tone


def answer(drive: Drive, file: Path, found: Sizing, known: Catalogue) -> Answer:
    """Return what to say of a sized part."""
    return Answer(
        sentence=_sentence(drive, file, found),
        tone="plain" if found.found else "failed",
        tables=lambda: list(_tables(found)),
        remarks=tuple(_remarks(file, found)),
        content=lambda: _content(drive, file, found),
        csv=lambda: _rows(found),
        figure=lambda: _figure(drive, found, known),
        code=0 if found.found else 1,
    )


def _figure(drive: Drive, found: Sizing, known: Catalogue) -> Any:
    from cardan.errors import refuse

    from .asked import figures

    if found.part not in ("tube", "shaft") or _stepped(found):
        return figures(found)
    from cardan.choices.trade_off import trade_off

    from .progress import watching

    number = _number(found)
    if not 1 < number <= len(drive.joints):
        raise refuse("--plot", _("only shafts between two joints are compared with other tubes"))
    compared = found.drive if drive.shafts[number - 1].outer is None else drive  # with the tube as it stands, if any
    with watching(_("comparing tubes")) as progress:
        return figures(trade_off(compared, None, number, known=known, progress=progress))


def _sentence(drive: Drive, file: Path, found: Sizing) -> str:
    from .source import title

    name = title(drive, file)
    if not found.found:
        return _("{name}: no size of the catalogue carries it.").format(name=name)
    first = found.governing
    said = {"name": name, "sizes": sizes(found), "title": "" if first is None else first.title}
    if found.tried:
        return _("{name}: {sizes} is the smallest size that passes.").format(**said)
    return _("{name}: {sizes}, where {title} is just at its limit.").format(**said)


def sizes(found: Sizing) -> str:
    """Return the sizes found, in words."""
    if found.tried:
        return str(next(iter(found.values.values())))
    if _stepped(found):
        path, value = next(iter(found.exact.items()))
        factor = significant(value / float(found.before[path] or value))
        return _("all diameters times {factor}").format(factor=factor)
    words = {
        "outer_mm": _("outer diameter {value} mm"),
        "wall_mm": _("wall {value} mm"),
        "ply_thickness_mm": _("plies of {value} mm"),
        "journal_mm": _("journal {value} mm"),
        "capacity_N": _("dynamic capacity {value} N"),
        "static_capacity_N": _("static capacity {value} N"),
    }
    return ", ".join(
        words[path.rpartition(".")[2]].format(value=significant(value)) for path, value in found.exact.items()
    )


def _tables(found: Sizing) -> Iterator[Table]:
    if found.tried:
        yield _catalogued(found)
        return
    columns = (
        Column(key="path", heading=_("key"), left=True),
        Column(key="before", heading=_("now")),
        Column(key="exact", heading=_("at the limit")),
        Column(key="value", heading=_("as made")),
    )
    rows: list[list[Cell]] = [
        [path, found.before.get(path), found.exact.get(path), _value(made)] for path, made in found.values.items()
    ]
    yield Table(columns=columns, rows=rows)
    yield _verdicts(found)


def _value(value: float | str | None) -> str:
    if value is None:
        return _("left out")
    return value if isinstance(value, str) else f"{value:.10g}"


def _stepped(found: Sizing) -> bool:
    """Tell whether it is the stretches of a stepped shaft that were sized."""
    return any(".segments[" in path for path in found.exact)


def _verdicts(found: Sizing) -> Table:
    from .check_answer import limit, shown

    made = {(one.check, one.title): float(one.utilisation) for one in found.made}
    order = sorted(found.limits, key=lambda one: -float(one.utilisation))
    columns = (
        Column(key="utilisation", heading=_("used"), unit=_("at limit"), form=".3f"),
        Column(key="made", heading=_("used"), unit=_("as made"), form=".3f"),
        Column(key="value", heading=_("value"), unit=_("at limit")),
        Column(key="limit", heading=_("limit"), left=True),
        Column(key="title", heading=_("what"), left=True, wrap=True),
    )
    rows: list[list[Cell]] = [
        [
            float(one.utilisation),
            made.get((one.check, one.title)),
            shown(one, one.value),
            limit(one),
            one.title,
        ]
        for one in order
    ]
    return Table(columns=columns, rows=rows)


def _catalogued(found: Sizing) -> Table:
    from .check_answer import SIGNS, TONES

    columns = (
        Column(key="size", heading=_("size"), left=True),
        Column(key="outer_mm", heading=_("outer"), unit="mm"),
        Column(key="mass_kg", heading=_("mass"), unit="kg"),
        Column(key="utilisation", heading=_("used"), form=".2f"),
        Column(key="worst", heading=_("what uses most"), left=True, wrap=True),
    )
    rows: list[list[Cell]] = []
    tones: list[Tone] = []
    for one in found.tried:
        state = "not_run" if one.worst is None else "passed" if one.passed else "failed"
        rows.append(
            [
                f"{SIGNS.get(state, '○')} {one.id}",
                1e3 * one.outer,
                one.mass,
                one.utilisation,
                _("nothing could be judged") if one.worst is None else one.worst.title,
            ]
        )
        tones.append(TONES[state])
    return Table(columns=columns, rows=rows, tones=tones)


def _remarks(file: Path, found: Sizing) -> Iterator[Remark]:
    from cardan.choices.lever import key_of

    if not found.found:
        last = found.tried[-1]
        if last.worst is not None:
            text = _("Failed: even {size} uses {used:.2f} of what it has: {title}.")
            yield Remark(text=text.format(size=last.id, used=last.utilisation, title=last.worst.title), tone="failed")
        yield Remark(text=_("Rows of a maker's own are added with --catalogue FILE."))
        return
    if found.skipped:
        keys = ", ".join(dict.fromkeys(key_of(path) for path in found.skipped))
        text = _("Warning: some checks do not count in this size; the file lacks {keys}.")
        yield Remark(text=text.format(keys=keys), tone="warning")
    text = _("Write it into a copy of the file, and look again:")
    part = found.part + (f":{_number(found)}" if found.subject else "")
    command = ("cardan", "strength", str(file), "--size", part, "-o", "sized.toml")
    yield Remark(text=text, command=command, tone="next")


def _number(found: Sizing) -> int:
    return int(found.subject.partition("[")[2].rstrip("]")) + 1


def _rows(found: Sizing) -> Table:
    if found.tried:
        return replace(
            _catalogued(found),
            rows=[[one.id, *row[1:]] for one, row in zip(found.tried, _catalogued(found).rows, strict=True)],
        )
    rows: list[list[Cell]] = [
        [path, found.before.get(path), found.exact.get(path), made] for path, made in found.values.items()
    ]
    return Table(columns=tuple(Column(key=key) for key in ("path", "now", "at_limit", "as_made")), rows=rows)


def _content(drive: Drive, file: Path, found: Sizing) -> dict[str, Any]:
    from cardan.choices.lever import key_of

    from .check_answer import unit_factor

    def told(verdicts: Any) -> list[dict[str, Any]]:
        return [
            {
                "check": one.check,
                "title": one.title,
                "value": float(one.value) / unit_factor(one),
                "limit": float(one.limit) / unit_factor(one),
                "unit": one.unit,
                "utilisation": float(one.utilisation),
                "source": one.source,
            }
            for one in verdicts
        ]

    first = found.governing
    return {
        "question": "size",
        "drive": drive.name,
        "file": str(file),
        "part": found.part,
        "subject": found.subject,
        "found": found.found,
        "at_limit": dict(found.exact),
        "as_made": dict(found.values),
        "now": dict(found.before),
        "series": found.series,
        "governing": None if first is None else first.check,
        "limits": told(found.limits),
        "limits_as_made": told(found.made),
        "tried": [
            {
                "size": one.id,
                "outer_mm": 1e3 * one.outer,
                "mass_kg": one.mass,
                "utilisation": one.utilisation,
                "passed": one.passed,
                "worst": None if one.worst is None else one.worst.title,
                "missing": [key_of(path) for path in one.missing],
            }
            for one in found.tried
        ],
        "not_counted": [key_of(path) for path in found.skipped],
    }


def written(
    answer: Answer, found: Sizing, drive: Drive, text: str, out: Path, *, folder: Path, catalogues: Sequence[Path]
) -> Answer:
    """Write the size into a drive file, its comments kept, and return the answer with a word on it.

    Parameters
    ----------
    answer : Answer
    found : Sizing
    drive : Drive
        As it stands in the file.
    text : str
        The file.
    out : path
        Where to write, TOML or JSON.
    folder : path
        Where files are looked for that the file names.
    catalogues : sequence of path
        Catalogue files beside those that it names.
    """
    from cardan.drive.fields.paths import with_values
    from cardan.errors import refuse
    from cardan.io import dumps, edit

    from .output import write_text

    if not found.found:
        raise refuse("--out", _("no size passes; nothing is written"))
    values = dict(found.values)
    if out.suffix.lower() == ".json" or text.lstrip().startswith("{"):
        form = "json" if out.suffix.lower() == ".json" else "toml"
        whole = dumps(with_values(drive, values), form=form)
    else:
        whole = edit(text, values, folder=folder, catalogues=catalogues)
    write_text(out, whole, "--out")
    kept = [remark for remark in answer.remarks if remark.tone != "next"]
    done = Remark(text=_("{path}: {sizes} written.").format(path=out, sizes=_listed(values)), tone="good")
    step = Remark(text=_("Judge the new drive:"), command=("cardan", "check", str(out)), tone="next")
    said = {"written": {"file": str(out), "values": values}}
    return replace(answer, remarks=(*kept, done, step), content=lambda: {**answer.content(), **said})


def _listed(values: dict[str, Any]) -> str:
    return ", ".join(f"{path} = {_value(value)}" for path, value in values.items())
