"""Several drives side by side: key figures, verdicts, and how their outputs turn."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import Literal, TypeAlias

from cardan.answers.answer import KeyFigure
from cardan.answers.printed import number
from cardan.answers.quantity import Joined, Quantity
from cardan.answers.reader import reader
from cardan.catalogue import Catalogue
from cardan.checks import Verdict, check
from cardan.checks.key_figures import key_figures as verdict_figures
from cardan.checks.verdict_table import TONES
from cardan.drive.drive import Drive
from cardan.errors import InputError, refuse
from cardan.io.differences import differences
from cardan.questions.motion.figure import variants_figure
from cardan.questions.motion.motion import motion
from cardan.register import QUESTIONS
from cardan.texts import _, plural

from .answers import answered, subject
from .block import Block, Cell, Column, Page, Picture, Table, Tone, Words, key_figures, shown, words
from .subject import Progress, Subject

Sense: TypeAlias = Literal["less", "more", ""]
"""Whether a smaller or a greater figure is better; empty where neither is."""

ALIKE = 1e-3  # relative difference below which two figures are as good as each other
MOST = 40  # verdicts listed
MOST_USED = 1000.0  # a limit that is exceeded more often is told as exceeded beyond that


@dataclass(frozen=True, eq=False, kw_only=True)
class Variant:
    """A drive to be compared."""

    name: str  # what it is called
    drive: Drive
    known: Catalogue | None = None  # norms, types and sizes that it is judged by; the shipped ones when not given

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
    """Return several drives side by side."""
    names = [one.name for one in variants]
    if not variants or len(set(names)) < len(names):
        raise refuse("variants", _("at least one is needed, each with a name of its own"))
    rows: list[list[KeyFigure]] = []
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
    """Return the keys that do not say the same in all drives, a column for each drive."""
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


def _keys(one: Variant, progress: Callable[[float], object]) -> list[KeyFigure]:
    """Return the key figures of a drive."""
    told, names = [], [name for name, question in QUESTIONS.items() if question.place.part != "nowhere"]
    for k, name in enumerate(names):
        told.append(answered(name, one.subject).keys)
        if progress((k + 1) / (len(names) + 1)) == "stop":
            break
    return key_figures([*told, tuple(verdict_figures(one.drive, one.verdicts))])


def _figures(variants: Sequence[Variant], found: Sequence[Sequence[KeyFigure]]) -> Table:
    """Return the key figures side by side, the best of each named."""
    grouped: dict[tuple[str, int], dict[int, KeyFigure]] = {}
    for k, keys in enumerate(found):
        count: Counter[str] = Counter()
        for key in keys:
            grouped.setdefault((key.name, count[key.name]), {})[k] = key
            count[key.name] += 1
    lines = [_kept(variants)] if any(one.verdicts for one in variants) else []
    lines += [_line(keys, variants) for keys in grouped.values()]
    columns = (Column(heading=_("what"), left=True), Column(heading="", left=True), *_columns(variants), _best())
    note = _("✓ is the best of them; those within 0.1 % of it are as good.")
    return Table(columns=columns, rows=lines, title=_("Key figures"), note=note)


def _columns(variants: Sequence[Variant]) -> Iterator[Column]:
    return (Column(heading=one.name) for one in variants)


def _best() -> Column:
    return Column(heading=_("best"), left=True)


def _kept(variants: Sequence[Variant]) -> list[Cell]:
    values = [float(one.failed) if one.verdicts else None for one in variants]
    cells = [
        words("–")
        if not one.verdicts
        else Cell(text=str(one.failed), amount=one.failed, form="0", tone="good" if not one.failed else "failed")
        for one in variants
    ]
    return [words(_("limits not kept")), words(""), *cells, _winner(values, "less", variants)]


def _line(keys: Mapping[int, KeyFigure], variants: Sequence[Variant]) -> list[Cell]:
    """Return the row of a key figure: what it is, its unit, its value in each drive, and which is best."""
    one = next(iter(keys.values()))
    values = [_value(keys[k]) if k in keys else None for k in range(len(variants))]
    best = _bests(values, one.better)
    cells = []
    for k in range(len(variants)):
        if k not in keys:
            cells.append(words("–"))
            continue
        tone: Tone = "failed" if keys[k].tone == "failed" else "good" if k in best else "plain"
        cells.append(replace(number(keys[k].value, reader(), unit=False), tone=tone))
    unit = reader().label(one.value.dimension, one.value.unit)
    return [words(_named(list(keys.values()))), words(unit), *cells, _winner(values, one.better, variants)]


def _named(keys: Sequence[KeyFigure]) -> str:
    """Return what a key figure is called, with every place where one of the drives has it."""
    places = dict.fromkeys(shown(key.place) for key in keys)
    return shown(Joined([keys[0].title, " / ".join(place or "–" for place in places) if any(places) else ""]))


def _value(key: KeyFigure) -> float | None:
    value = float(key.value.value)
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
    columns = (Column(heading=_("limit"), left=True), *_columns(variants), _best())
    return Table(columns=columns, rows=rows, title=_("Limits"), note=note)


def _used(one: Verdict) -> Cell:
    share = float(one.utilisation)
    return replace(number(Quantity(share, decimals=2, most=MOST_USED), reader()), tone=TONES[one.state])


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
    shares = [one.subject.fluctuation for one in variants]
    told = [shown(Quantity(share, "share", 3)) for share in shares]
    best = shares.index(min(shares))
    if len(variants) == 1:
        return _("{name} has {share} speed fluctuation.").format(name=variants[0].name, share=told[0])
    if len(set(told)) == 1:
        return _("All of them have {share} speed fluctuation.").format(share=told[0])
    rest = ", ".join(
        f"{one.name} {share}" for k, (one, share) in enumerate(zip(variants, told, strict=True)) if k != best
    )
    return _("{name} is the most uniform: {share} speed fluctuation, {others}.").format(
        name=variants[best].name, share=told[best], others=rest
    )
