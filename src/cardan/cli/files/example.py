"""``cardan example``: the shipped drives, mechanisms and recordings, to look at and to start from."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cardan.answers.answer import Answer, Column, Remark, Table
from cardan.cli.shared.options import argument, flag
from cardan.cli.shared.output import check_common, check_new, print_text, write_text
from cardan.cli.shared.source import STDIN, AsCsv, AsJson
from cardan.cli.shared.tell import tell
from cardan.io import example_names, example_text, mechanism_names, recording_names
from cardan.io.examples import example_file
from cardan.texts import _


def _names(incomplete: str) -> list[str]:
    """Complete the name of an example."""
    return [name for name in (*example_names(), *mechanism_names(), *recording_names()) if name.startswith(incomplete)]


def example(
    name: Annotated[str | None, argument(None, _("Example to copy."), autocompletion=_names)] = None,
    out: Annotated[Path | None, argument("OUT", _("File to write; its own name here by default, - prints it."))] = None,
    force: Annotated[bool, flag("--force", _("Overwrite OUT."))] = False,
    json: AsJson = False,
    csv: AsCsv = False,
) -> int:
    """List the shipped examples, or copy one."""
    check_common(json=json, csv=csv)
    if name is None:
        return tell(_list(), json=json, csv=csv)
    text = example_text(name)
    if out == STDIN:
        print_text(text)
        return 0
    place = out or Path(example_file(name).name)
    check_new(place, force=force, field="OUT")
    write_text(place, text, "OUT")
    return tell(_copied(name, text, place), json=json, csv=csv)


def _list() -> Answer:
    names = (*example_names(), *mechanism_names(), *recording_names())
    shows = [about(example_text(name)) for name in names]
    brief = [text.partition(". ")[0].partition(": ")[0].rstrip(".") for text in shows]
    return Answer(
        name="example",
        title=_("Examples"),
        sentence=_("{count} examples to look at and to start from.").format(count=len(names)),
        tables=(
            Table(
                name="examples",
                records=True,
                fixed=0,
                columns=(
                    Column(key="name", heading=_("example"), values=names),
                    Column(key="", heading=_("what it shows"), values=brief, wrap=True),
                    Column(key="shows", values=shows, depth="data"),
                ),
            ),
        ),
        remarks=(
            Remark(
                text=_("Copy one into this folder:"),
                command=("cardan", "example", names[0] if names else ""),
                tone="next",
            ),
        ),
    )


def _copied(name: str, text: str, place: Path) -> Answer:
    command = ["cardan", "mobility" if name in mechanism_names() else "report", str(place)]
    first = []
    if name in recording_names():
        command = ["cardan", "diagnose", str(place), "truck-supports.toml"]
        needed = ("cardan", "example", "truck-supports")
        first = [Remark(text=_("The drive that it is of:"), command=needed, tone="next")]
    return Answer(
        name="example",
        title=_("Examples"),
        sentence=_("{path}: example {name} copied.").format(path=place, name=name),
        tone="good",
        remarks=(Remark(text=about(text)), *first, Remark(text=_("Look at it:"), command=tuple(command), tone="next")),
        facts={"example": name, "file": str(place), "shows": about(text)},
    )


def about(text: str) -> str:
    """Return what the comment at the head of a drive file says; of a shipped one in the language spoken here."""
    lines = []
    for line in text.splitlines():
        if not line.startswith("#"):
            break
        lines.append(line.lstrip("# ").strip())
    return _(" ".join(line for line in lines if line))
