"""Several drives side by side: key figures, verdicts, and how their outputs turn."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from itertools import takewhile
from typing import Literal, TypeAlias

import numpy as np

from cardan.catalogue import Catalogue
from cardan.checks import Verdict, check
from cardan.drive.drive import Drive
from cardan.errors import InputError, refuse
from cardan.figures.wording import percent, used
from cardan.io.differences import differences
from cardan.questions.motion.figures.variants import variants_figure
from cardan.questions.motion.motion import motion
from cardan.texts import _, plural

from .answers import answered, subject
from .block import Block, Cell, Column, Page, Picture, Table, Tone, Words, number, words
from .followed import Followed, figures_by_laws
from .key_figures import key_figures
from .subject import Progress, Subject
from .verdicts import TONES

Sense: TypeAlias = Literal["less", "more", ""]
"""Whether a smaller or a greater figure is better; empty where neither is."""

PAGES = ("forces", "losses", "accuracy", "torsion", "bending", "life", "strength", "mobility", "assembly")
"""Parts of the report whose key figures are compared."""

ALIKE = 1e-9
"""Relative difference below which two figures are the same."""

MOST = 40
"""Verdicts listed."""

LONG = 28
"""Letters by which names of one figure may differ; more are left out."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Variant:
    """A drive to be compared.

    Parameters
    ----------
    name : str
        What it is called.
    drive : Drive
        What it is.
    known : Catalogue, optional
        Norms, types and sizes that it is judged by; the shipped ones when not given.
    """

    name: str
    drive: Drive
    known: Catalogue | None = None

    @cached_property
    def subject(self) -> Subject:
        """The drive, to be asked about."""
        return subject(self.drive, known=self.known)

    @cached_property
    def verdicts(self) -> tuple[Verdict, ...]:
        """What could be judged of it, but for rules of thumb; none where it cannot be judged."""
        try:
            return tuple(one for one in check(self.drive, known=self.known) if one.run and not one.advice)
        except InputError:
            return ()

    @property
    def failed(self) -> int:
        """How many limits it does not keep."""
        return sum(one.state == "failed" for one in self.verdicts)


def compared(variants: Sequence[Variant], progress: Progress | None = None) -> Page:
    """Return several drives side by side.

    Parameters
    ----------
    variants : sequence of Variant
        At least one.
    progress : function, optional
        Called with the share done; answering "stop" ends the work with what there is by then.

    Raises
    ------
    InputError
        There is none, or two have the same name.

    Examples
    --------
    >>> from cardan.units import deg
    >>> plain, better = Drive.from_angles([20 * deg]), Drive.from_angles([20 * deg, 20 * deg])
    >>> compared([Variant(name="one", drive=plain), Variant(name="two", drive=better)]).answer
    'two turns most evenly: 0 % irregular, one 12.5 %.'
    """
    names = [one.name for one in variants]
    if not variants or len(set(names)) < len(names):
        raise refuse("variants", _("at least one is needed, each with a name of its own"))
    rows: list[list[list[Cell]]] = []
    for k, one in enumerate(variants):
        rows.append(_keys(one, partial(_told, progress, k, len(variants))))
        if progress is not None and progress((k + 1) / len(variants)) == "stop":
            break
    seen = variants[: len(rows)]
    blocks: list[Block] = []
    if len(seen) < len(variants):
        left = ", ".join(one.name for one in variants[len(seen) :])
        blocks.append(Words(text=_("Stopped by the reader; left out: {names}.").format(names=left), tone="warning"))
    figure = variants_figure([motion(one.drive) for one in seen], [one.name for one in seen])
    blocks += [_figures(seen, rows), Picture(figure=figure)]
    if any(one.verdicts for one in seen):
        blocks.append(_verdicts(seen))
    blocks.append(differences_table([one.name for one in seen], [one.drive for one in seen]))
    return Page(name="variants", title=_("Variants side by side"), answer=_answer(seen), blocks=blocks)


def differences_table(names: Sequence[str], drives: Sequence[Drive]) -> Table:
    """Return the keys that do not say the same in all drives, a column for each drive.

    Parameters
    ----------
    names : sequence of str
        What the drives are called.
    drives : sequence of Drive
        As many.
    """
    found = differences(drives)
    rows = [[words(one.path), *(words(value or "–") for value in one.values), words(one.doc)] for one in found]
    columns = (
        Column(heading=_("key"), left=True),
        *(Column(heading=name) for name in names),
        Column(heading=_("meaning"), left=True),
    )
    note = "" if rows else _("The files say the same.")
    return Table(columns=columns, rows=rows, title=_("What differs in the files"), note=note)


def _told(progress: Progress | None, k: int, count: int, share: float) -> object:
    return None if progress is None else progress((k + share) / count)


def _keys(one: Variant, progress: Callable[[float], object]) -> list[list[Cell]]:
    """Return the rows of key figures of a drive."""
    on: object = one.subject
    pages = []
    for k, name in enumerate(PAGES):
        pages.append(answered(name, one.subject))
        if progress((k + 1) / (len(PAGES) + 1)) == "stop":
            break
    table = figures_by_laws(on, pages) if isinstance(on, Followed) else key_figures(one.subject, pages)
    return [list(row) for row in table.rows]


def _known() -> tuple[tuple[str, Sense], ...]:
    """Return what key figures are called, where their names tell more than digits, and which way they are better."""
    return (
        (_("torque rating of the whole drive, ended by {title}"), "more"),
        (_("life of joint {number}, the first to fail"), "more"),
        (_("critical speed, {part}"), "more"),
        (_("efficiency"), "more"),
        (_("shortest engaged length of the spline of shaft {k}"), "more"),
        (_("least way left to bottoming of shaft {k}"), "more"),
        (_("slowest torsional mode"), ""),
        (_("speed at which order 2 meets it"), ""),
        (_("largest force on a support, {name}"), "less"),
        (_("largest acceleration of the output at {speed} rpm"), "less"),
        (_("largest acceleration of the output over ω₁²"), "less"),
    )


def _figures(variants: Sequence[Variant], found: Sequence[Sequence[Sequence[Cell]]]) -> Table:
    """Return the key figures side by side, the best of each named."""
    grouped: dict[tuple[str, str, str], dict[int, Sequence[Cell]]] = {}
    senses: dict[tuple[str, str, str], Sense] = {}
    for k, rows in enumerate(found):
        count: dict[str, int] = {}
        for row in rows:
            head, sense = _head(row[0].text)
            count[head] = count.get(head, 0) + 1
            key = (head, row[2].text, str(count[head]))
            grouped.setdefault(key, {})[k] = row
            senses[key] = sense
    lines = []
    if any(one.verdicts for one in variants):
        lines.append(_kept(variants))
    lines += [_line(rows, unit, senses[head, unit, nth], variants) for (head, unit, nth), rows in grouped.items()]
    return Table(
        columns=(Column(heading=_("what"), left=True), Column(heading="", left=True), *_columns(variants), _best()),
        rows=lines,
        title=_("Key figures"),
        note=_("✓ is the best of them; figures that are as good stand together."),
    )


def _columns(variants: Sequence[Variant]) -> Iterator[Column]:
    return (Column(heading=one.name) for one in variants)


def _best() -> Column:
    return Column(heading=_("best"), left=True)


def _head(name: str) -> tuple[str, Sense]:
    """Return what is the same in the names of a figure of several drives, and which way it is better."""
    for text, sense in _known():
        pattern = "(.*)".join(re.escape(part) for part in re.split(r"\{\w+\}", text))
        if re.fullmatch(pattern, name):
            return text, sense
    return re.sub(r"\d[\d\u202f.]*", "{}", name), "less"


def _kept(variants: Sequence[Variant]) -> list[Cell]:
    values = [float(one.failed) if one.verdicts else None for one in variants]
    cells = [
        words("–")
        if not one.verdicts
        else number(str(one.failed), float(one.failed), "good" if not one.failed else "failed")
        for one in variants
    ]
    return [words(_("limits not kept")), words(""), *cells, _winner(values, "less", variants)]


def _line(rows: dict[int, Sequence[Cell]], unit: str, sense: Sense, variants: Sequence[Variant]) -> list[Cell]:
    values = [_value(rows[k][1]) if k in rows else None for k in range(len(variants))]
    best = _bests(values, sense)
    cells = []
    for k in range(len(variants)):
        if k not in rows:
            cells.append(words("–"))
            continue
        cell = rows[k][1]
        verdict = rows[k][5].tone if len(rows[k]) > 5 else "plain"
        tone: Tone = "failed" if verdict == "failed" else "good" if k in best else "plain"
        cells.append(Cell(text=cell.text, full=cell.full, tone=tone))
    return [
        words(_merged([row[0].text for row in rows.values()])),
        words(unit),
        *cells,
        _winner(values, sense, variants),
    ]


def _value(cell: Cell) -> float | None:
    try:
        value = float(cell.full)
    except ValueError:
        return math.inf if cell.text == "∞" else None
    return None if math.isnan(value) else value


def _bests(values: Sequence[float | None], sense: Sense) -> set[int]:
    """Return which are best; none where there is nothing to choose."""
    known = [one for one in values if one is not None]
    if not sense or len(known) < 2:
        return set()
    top = min(known) if sense == "less" else max(known)
    size = max((abs(one) for one in known if math.isfinite(one)), default=0.0)
    best = {k for k, one in enumerate(values) if one is not None and _same(one, top, size)}
    return set() if len(best) == len(known) else best


def _same(one: float, other: float, size: float) -> bool:
    return one == other or abs(one - other) <= ALIKE * max(size, 1e-6)


def _winner(values: Sequence[float | None], sense: Sense, variants: Sequence[Variant]) -> Cell:
    best = _bests(values, sense)
    if best:
        return words(", ".join(variants[k].name for k in sorted(best)))
    known = [one for one in values if one is not None]
    alike = sense and len(known) > 1
    return words(_("all alike") if alike else "–")


def _merged(names: Sequence[str]) -> str:
    """Return the name of a figure that several drives call by numbers or parts of their own.

    Examples
    --------
    >>> _merged(["largest bend, joint 2", "largest bend, joint 1"])
    'largest bend, joint 2 / 1'
    """
    different = list(dict.fromkeys(names))
    if len(different) == 1:
        return different[0]
    parts = [re.findall(r"[\w.]+|\W", one) for one in different]
    front = _shared(parts)
    tails = [row[front:] for row in parts]
    back = _shared([tail[::-1] for tail in tails])
    middles = ["".join(tail[: len(tail) - back]).strip() for tail in tails]
    begin, end = "".join(parts[0][:front]), "".join(tails[0][len(tails[0]) - back :])
    return f"{begin}…" if max(map(len, middles)) > LONG else f"{begin}{' / '.join(middles)}{end}"


def _shared(rows: Sequence[Sequence[str]]) -> int:
    """Return in how many words rows begin alike."""
    alike = (len(set(words)) == 1 for words in zip(*rows, strict=False))
    return sum(takewhile(bool, alike))


def _verdicts(variants: Sequence[Variant]) -> Table:
    """Return how the limits are kept, the most used first: utilisation with its sign, a column for each drive."""
    used: dict[tuple[str, str, str], dict[int, Verdict]] = {}
    for k, variant in enumerate(variants):
        for one in variant.verdicts:
            used.setdefault((one.check, one.subject, one.title), {})[k] = one
    order = sorted(used, key=lambda key: -max(float(one.utilisation) for one in used[key].values()))
    rows = []
    for key in order[:MOST]:
        cells = [_used(used[key][k]) if k in used[key] else words("–") for k in range(len(variants))]
        values = [float(used[key][k].utilisation) if k in used[key] else None for k in range(len(variants))]
        rows.append([words(key[2]), *cells, _winner(values, "less", variants)])
    left = len(order) - len(rows)
    note = _("Share of the limit that is used: ✓ kept, ▲ nearly used up, ✖ not kept.")
    if left:
        note += " " + plural("One more limit is used less.", "{count} more limits are used less.", left).format(
            count=left
        )
    return Table(
        columns=(Column(heading=_("limit"), left=True), *_columns(variants), _best()),
        rows=rows,
        title=_("Limits"),
        note=note,
    )


def _used(one: Verdict) -> Cell:
    share = float(one.utilisation)
    return Cell(text=used(share), full=repr(share), tone=TONES[one.state])


def _answer(variants: Sequence[Variant]) -> str:
    """Return which of them keeps its limits, else which one turns most evenly."""
    judged = [one for one in variants if one.verdicts]
    if len(judged) == len(variants) > 1 and len({one.failed for one in variants}) > 1:
        least = min(one.failed for one in variants)
        good = ", ".join(one.name for one in variants if one.failed == least)
        bad = ", ".join(f"{one.name} {one.failed}" for one in variants if one.failed > least)
        text = _("{good}: all limits are kept. Limits not kept: {bad}.")
        if least:
            text = _("{good}: fewest limits are not kept, {least}. The others: {bad}.")
        return text.format(good=good, least=least, bad=bad)
    return _evenness(variants)


def _evenness(variants: Sequence[Variant]) -> str:
    shares = [float(np.ravel(one.subject.whole.irregularity)[-1]) for one in variants]
    told = [percent(share) for share in shares]
    best = shares.index(min(shares))
    if len(variants) == 1:
        return _("{name} is {share} irregular.").format(name=variants[0].name, share=told[0])
    if len(set(told)) == 1:
        return _("All of them are {share} irregular.").format(share=told[0])
    rest = ", ".join(
        f"{one.name} {share}" for k, (one, share) in enumerate(zip(variants, told, strict=True)) if k != best
    )
    return _("{name} turns most evenly: {share} irregular, {others}.").format(
        name=variants[best].name, share=told[best], others=rest
    )
