"""What there is to say of layouts that hold a drive just enough: which, how many, what may stand for a bearing."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from cardan.answers.answer import FILE, Answer, Column, Remark, Table
from cardan.answers.quantity import Quantity, Say, say
from cardan.answers.question import Lacking
from cardan.drive.drive import Drive
from cardan.drive.models.machine_held import balls_of
from cardan.errors import refuse
from cardan.later import later
from cardan.mechanism.counting import Group, minus_groups
from cardan.mechanism.layouts import BEARINGS
from cardan.mechanism.mechanism import PAIRS
from cardan.questions.assumed import yokes_estimated
from cardan.texts import _, mark

from .bearing_layouts import BearingLayouts, HeldDrive
from .bearing_layouts import bearing_layouts as search

drawn = later("cardan.choices.bearing_layouts_figure")

__all__ = ["answer", "ask", "chosen", "lacking", "otherwise", "spelled"]

MEANING = {
    "SG": mark("one bearing that lets its shaft tilt and slide"),
    "S": mark("one bearing that lets its shaft tilt and locates it along its axis"),
    "C": mark("two bearings in line, both sliding"),
    "R": mark("two bearings in line, one of them locating"),
}
"""What holds a part of a shaft -> what it is, marked for translation."""


def lacking(drive: Drive) -> Lacking:
    """Return what the drive file lacks: nothing, as lengths that it does not say are assumed."""
    return ()


def ask(drive: Drive, *, other_joints: bool = False) -> BearingLayouts | None:
    """Return the layouts of a drive; None where a joint holds its shaft in a bearing of its own."""
    return None if balls_of(drive, pivots=True) else search(drive, other_joints=other_joints)


def otherwise(drive: Drive) -> str:
    """Return why nothing can be told although nothing is missing."""
    return _("A joint of it holds its shaft in a bearing of its own; layouts leave that choice no room.")


def chosen(result: BearingLayouts, number: int) -> HeldDrive:
    """Return a layout by the number under which it is told."""
    if not 1 <= number <= len(result.best):
        text = _("there is no layout {number}; there are 1 to {last}")
        raise refuse("--apply", text.format(number=number, last=len(result.best)), "out_of_range")
    return result.best[number - 1]


def answer(drive: Drive, result: BearingLayouts) -> Answer:
    """Return what there is to say of the layouts of a drive."""
    return Answer(
        name="layouts",
        title=_("Statically determinate layouts"),
        sentence=_sentence(result),
        tone="plain" if result.best else "warning",
        figures=lambda: (drawn().layouts_figure(result),) if result.best else (),
        tables=(*((_layouts(result),) if result.best else ()), _groups()),
        remarks=(*_remarks(result), *yokes_estimated(drive)),
        facts=_facts(result),
        full=lambda: _layouts(result),
    )


def spelled(one: HeldDrive, own: tuple[int, ...]) -> str:
    """Return a layout in signs, along the power flow: bearings, × for a joint, = for a spline, – for no bearing."""
    words: list[str] = []
    for k, parts in enumerate(one.layout.shafts):
        if k:
            joint, free = one.drive.joints[k - 1], one.layout.joints[k - 1]
            words.append("×" if free == own[k - 1] else joint.in_words())
        words.append(" = ".join(part or "–" for part in parts))
    return " ".join(words)


def _sentence(result: BearingLayouts) -> Say:
    values = {"number": result.number, "ranked": result.ranked, "regular": result.regular}
    if result.ranked == result.number:
        text = _(
            "{number} layouts are statically determinate by their graph, {regular} of them by the rank of their "
            "constraints too."
        )
    else:
        text = _(
            "{number} layouts are statically determinate by their graph; of the {ranked} with the fewest parts "
            "{regular} are by the rank of their constraints too."
        )
    return say(text, **values)


def _layouts(result: BearingLayouts) -> Table:
    best = result.best
    known = any(one.force is not None for one in best)
    force = (
        Column(key="bearing_force", heading=_("bearing force"), values=[one.force for one in best], dimension="force"),
    )
    return Table(
        name="layouts",
        columns=(
            Column(key="number", heading=_("layout"), values=list(range(1, len(best) + 1))),
            Column(key="bearings", heading=_("bearings"), values=[one.layout.bearings for one in best]),
            Column(key="splines", heading=_("splines"), values=[one.layout.splines for one in best]),
            Column(
                key="speed_fluctuation", heading="δ", values=[one.speed_fluctuation for one in best], dimension="share"
            ),
            *(force if known else ()),
            Column(
                key="held",
                heading=_("bearings from input to output"),
                values=[spelled(one, result.freedoms) for one in best],
                left=True,
                wrap=True,
            ),
        ),
        note=_meanings(),
    )


def _meanings() -> str:
    signs = _("× joint, = spline, – no bearing")
    return "; ".join([*(f"{code}: {_(MEANING[code])}" for code in BEARINGS), signs]) + "."


def _groups() -> Table:
    """Return the table of the groups of links that impose as much as a bearing, and may stand for it."""
    rows = [(code, group) for code in BEARINGS for links in (1, 2, 3) for group in _minus(code, links)]
    return Table(
        name="groups",
        title=_("Groups of links that may stand for a bearing"),
        columns=(
            Column(key="bearing", heading=_("bearing"), values=[code for code, _group in rows], left=True),
            Column(key="links", heading=_("links"), values=[group.links for _code, group in rows]),
            Column(
                key="constraints",
                heading=_("constraints of its pairs"),
                values=["-".join(map(str, group.constraints)) for _code, group in rows],
                left=True,
            ),
            Column(
                key="example",
                heading=_("for example"),
                values=[_realised(g) for _code, g in rows],
                left=True,
                wrap=True,
            ),
        ),
        note=_(
            "A group of m links holds as much as a bearing with s constraints where 6m less those of its pairs is −s; "
            "one more link on a hinge takes one constraint away."
        ),
        depth="full",
    )


def _minus(code: str, links: int) -> tuple[Group, ...]:
    held = PAIRS[code].constraints
    return minus_groups(held, links) if links <= 5 - held else ()


def _realised(group: Group) -> str:
    """Return what a group of hinges alone is; two hinges that cross are a cardan joint."""
    if set(group.constraints) != {5}:
        return ""
    return {
        1: _("a cross between the bearing and the frame"),
        2: _("a rod with a cross at one end and a hinge at the other"),
        3: _("a rod with a cross at both ends"),
    }[group.links]


def _remarks(result: BearingLayouts) -> Iterator[Remark]:
    asked = ("cardan", "mobility", FILE, "--layouts", *(() if result.own else ("--other-joints",)))
    if result.best:
        yield Remark(
            text=_(
                "Best first: by the fluctuation δ of the output, the largest force on a bearing where torque and "
                "lengths are known, in steps of a tenth, and the number of bearings and splines; all turn all round."
            )
        )
        yield Remark(
            text=_(
                "Bearings stand where the file has some on their shaft, else in the middle of what they hold; two in "
                "line a fifth of it apart."
            ),
            depth="full",
        )
        yield Remark(
            text=_("Write layout 1 into a copy of the file:"),
            command=(*asked, "--apply", "1", "-o", "better.toml"),
            tone="next",
        )
    if result.own:
        yield Remark(
            text=_("Joints of other kinds too:"),
            command=("cardan", "mobility", FILE, "--layouts", "--other-joints"),
            tone="next",
        )


def _facts(result: BearingLayouts) -> dict[str, Any]:
    return {
        "by_graph": result.number,
        "up_to_mirror_images": result.unlike,
        "ranked": result.ranked,
        "regular": result.regular,
        "locked": result.locked,
        "held": [
            {
                "joints": [joint.kind for joint in one.drive.joints],
                "shafts": [list(parts) for parts in one.layout.shafts],
                "bearing_force": Quantity(one.force, "force") if one.force is not None else None,
            }
            for one in result.best
        ],
    }
