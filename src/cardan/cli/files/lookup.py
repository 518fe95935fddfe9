"""``cardan help``: commands, checks, keys, formulas and examples by the words of the trade and their synonyms."""

from __future__ import annotations

from typing import Annotated

from cardan.answers.answer import Answer, Column, Remark, Table
from cardan.cli.shared.options import argument
from cardan.cli.shared.output import check_common
from cardan.cli.shared.source import AsJson
from cardan.cli.shared.tell import tell
from cardan.cli.shared.words import finds
from cardan.texts import _, plural

SHOWN = 12  # finds of each sort that are told


def lookup(
    word: Annotated[str, argument("WORD", _("Word of the trade, as stress or phasing."))], json: AsJson = False
) -> int:
    """Find commands, checks, keys, formulas and examples by a word of the trade."""
    check_common(json=json, csv=False)
    return tell(answer(word), json=json)


def answer(word: str) -> Answer:
    """Return what a word of the trade leads to."""
    found = finds(word)
    heads = {
        "command": _("Commands"),
        "kind": _("Kinds of joints"),
        "check": _("Checks"),
        "key": _("Keys of the drive file"),
        "formula": _("Formulas"),
        "example": _("Examples"),
    }
    own = {sort: [one for one in found if one.sort == sort] for sort in heads}
    several = plural("{word} leads to {count} place.", "{word} leads to {count} places.", len(found))
    text = several if found else _("Nothing is found for {word}.")
    return Answer(
        name="help",
        title=_("Help"),
        sentence=text.format(word=word, count=len(found)),
        tone="plain" if found else "warning",
        tables=tuple(
            Table(
                title=heads[sort],
                columns=(
                    Column(key="", heading=_("name"), values=[one.name for one in some[:SHOWN]], left=True, wrap=True),
                    Column(
                        key="", heading=_("meaning"), values=[one.meaning for one in some[:SHOWN]], left=True, wrap=True
                    ),
                ),
                note=_("{count} more").format(count=len(some) - SHOWN) if len(some) > SHOWN else "",
            )
            for sort, some in own.items()
            if some
        ),
        remarks=(
            Remark(text=_("Rows of the catalogue:"), command=("cardan", "catalogue", word), tone="next"),
            Remark(text=_("Every command:"), command=("cardan", "--help"), tone="next"),
            Remark(text=_("Every key of the drive file:"), command=("cardan", "keys"), tone="next"),
        ),
        facts={"word": word, "finds": [{"sort": one.sort, "name": one.name, "meaning": one.meaning} for one in found]},
        code=0 if found else 2,
    )
