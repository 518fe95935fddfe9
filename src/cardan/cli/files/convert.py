"""``cardan convert``: the same drive in another form or file, or as bodies that turn."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from cardan import io
from cardan.answers.answer import Answer
from cardan.cli.shared.failure import about
from cardan.cli.shared.options import argument, flag, option
from cardan.cli.shared.output import SUFFIXES, check_new, print_text
from cardan.cli.shared.source import STDIN, AsJson, EitherFile, read_either
from cardan.cli.shared.tell import tell
from cardan.drive.drive import Drive
from cardan.drive.models.geometry import in_form
from cardan.errors import refuse
from cardan.files import write_bytes
from cardan.io.saving import save
from cardan.mechanism.mechanism import Mechanism
from cardan.scene.gltf import render
from cardan.scene.mechanism import mechanism_scene
from cardan.scene.scene import scene
from cardan.texts import _

BODIES = ".glb"


def convert(
    file: EitherFile,
    out: Annotated[
        Path, argument("OUT", _("File to write: .toml or .json, or .glb for a turning model in space; - prints TOML."))
    ],
    form: Annotated[
        Literal["points", "angles", "slopes"] | None,
        option(
            "--form",
            "FORM",
            _("points (joint centres), angles (joint angles and plane twists) or slopes; that of FILE by default."),
        ),
    ] = None,
    force: Annotated[bool, flag("--force", _("Overwrite OUT."))] = False,
    json: AsJson = False,
) -> int:
    """Rewrite a drive file in another form or format."""
    if out != STDIN:
        if out.suffix.lower() not in SUFFIXES:
            known = ", ".join(SUFFIXES)
            raise refuse("OUT", _("{path} should end in one of {known}").format(path=out, known=known))
        check_new(out, force=force, field="OUT")
    drive = read_either(file)
    if isinstance(drive, Mechanism) and form is not None:
        raise refuse("--form", _("a mechanism has none of these forms; leave this out"))
    if out.suffix.lower() == BODIES:
        if form is not None:
            raise refuse("--form", _("bodies have none of these forms; leave this out"))
        return tell(_bodies(file, drive, out), json=json)
    moved = drive if form is None or isinstance(drive, Mechanism) else in_form(drive, form)
    if out == STDIN:
        print_text(io.dumps(moved))
        return 0
    save(moved, out)
    if isinstance(moved, Mechanism):
        said = _("{out}: the mechanism of {file} written.").format(out=out, file=file)
        facts = {"file": str(file), "out": str(out)}
        title = _("Converted mechanism file")
        return tell(Answer(name="convert", title=title, sentence=said, tone="good", facts=facts), json=json)
    return tell(
        Answer(
            name="convert",
            title=_("Converted drive file"),
            sentence=_("{out}: the drive of {file} written, given by {form}.").format(
                out=out, file=file, form=moved.form
            ),
            tone="good",
            facts={"file": str(file), "out": str(out), "form": moved.form},
        ),
        json=json,
    )


def _bodies(file: Path, drive: Drive | Mechanism, out: Path) -> Answer:
    """Write a drive or mechanism as bodies that turn, and return what is said of it."""
    with about(_("standard input") if file == STDIN else str(file)):
        shown = mechanism_scene(drive) if isinstance(drive, Mechanism) else scene(drive)
    write_bytes(out, render(shown))
    triangles = sum(len(one.indices) for one in shown.bodies)
    return Answer(
        name="convert",
        title=_("Converted drive file"),
        sentence=_("{out}: {file} as {bodies} bodies that turn.").format(out=out, file=file, bodies=len(shown.bodies)),
        tone="good",
        facts={"file": str(file), "out": str(out), "bodies": len(shown.bodies), "triangles": triangles},
    )
