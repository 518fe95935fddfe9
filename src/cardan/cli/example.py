"""``cardan example``: the shipped drives, mechanisms and recordings, to look at and to start from."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from cardan.texts import _

from .options import AsCsv, AsJson

if TYPE_CHECKING:
    from .answer import Answer


def _names(incomplete: str) -> list[str]:
    """Complete the name of an example."""
    from cardan.io import example_names, mechanism_names, recording_names

    return [name for name in (*example_names(), *mechanism_names(), *recording_names()) if name.startswith(incomplete)]


def example(
    name: Annotated[
        str | None, typer.Argument(help=_("Example to copy."), show_default=False, autocompletion=_names)
    ] = None,
    out: Annotated[
        Path | None,
        typer.Argument(
            metavar="OUT", help=_("File to write; its own name here by default, - prints it."), show_default=False
        ),
    ] = None,
    force: Annotated[bool, typer.Option("--force", help=_("Overwrite OUT."), show_default=False)] = False,
    json: AsJson = False,
    csv: AsCsv = False,
) -> int:
    """List the shipped examples, or copy one."""
    from .output import check_new, write_text
    from .show import check_common, print_text, show
    from .source import STDIN

    check_common(json=json, csv=csv)

    from cardan.io import example_text
    from cardan.io.examples import example_file

    if name is None:
        return show(_list(), json=json, csv=csv)
    text = example_text(name)
    if out == STDIN:
        print_text(text)
        return 0
    place = out or Path(example_file(name).name)
    check_new(place, force=force, field="OUT")
    write_text(place, text, "OUT")
    return show(_copied(name, text, place), json=json, csv=csv)


def _list() -> Answer:
    from cardan.io import example_names, example_text, mechanism_names, recording_names

    from .answer import Answer, Column, Remark, Table

    names = (*example_names(), *mechanism_names(), *recording_names())
    rows = [(name, about(example_text(name))) for name in names]
    return Answer(
        sentence=_("{count} examples to look at and to start from.").format(count=len(rows)),
        tables=lambda: (
            Table(
                columns=(
                    Column(key="name", heading=_("example"), left=True),
                    Column(key="shows", heading=_("what it shows"), left=True, wrap=True),
                ),
                rows=[(name, text.partition(". ")[0].partition(": ")[0].rstrip(".")) for name, text in rows],
            ),
        ),
        csv=lambda: Table(columns=(Column(key="name"), Column(key="shows")), rows=rows),
        remarks=(
            Remark(
                text=_("Copy one into this folder:"),
                command=("cardan", "example", rows[0][0] if rows else ""),
                tone="next",
            ),
        ),
        content=lambda: {"examples": [{"name": name, "shows": text} for name, text in rows]},
    )


def _copied(name: str, text: str, place: Path) -> Answer:
    from cardan.io import mechanism_names, recording_names

    from .answer import Answer, Remark

    command = ["cardan", "mobility" if name in mechanism_names() else "report", str(place)]
    first = []
    if name in recording_names():
        command = ["cardan", "diagnose", str(place), "truck-supports.toml"]
        needed = ("cardan", "example", "truck-supports")
        first = [Remark(text=_("The drive that it is of:"), command=needed, tone="next")]
    return Answer(
        sentence=_("{path}: example {name} copied.").format(path=place, name=name),
        tone="good",
        remarks=(
            Remark(text=about(text)),
            *first,
            Remark(text=_("Look at it:"), command=tuple(command), tone="next"),
        ),
        content=lambda: {"example": name, "file": str(place), "shows": about(text)},
    )


def about(text: str) -> str:
    """Return what the comment at the head of a drive file says; of a shipped one in the language spoken here.

    Examples
    --------
    >>> about("# One joint\\n# at 20°.\\n\\nformat = 1")
    'One joint at 20°.'
    """
    lines = []
    for line in text.splitlines():
        if not line.startswith("#"):
            break
        lines.append(line.lstrip("# ").strip())
    return _(" ".join(line for line in lines if line))
