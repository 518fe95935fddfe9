"""Writes changed values, or the yoke angles of a setting, into a drive file, its comments kept."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from cardan.cli.shared.output import SUFFIXES, check_new, check_target, write_text
from cardan.cli.shared.source import STDIN
from cardan.drive.drive import Drive
from cardan.drive.fields.paths import with_values
from cardan.errors import refuse
from cardan.io import dumps
from cardan.io.edit import edit
from cardan.questions.phases.answer import advised, every_setting
from cardan.questions.phases.phases import Phasing
from cardan.questions.phases.setting import YokeSetting, values_of
from cardan.texts import _


def written(
    found: Phasing, drive: Drive, text: str, *, label: str | None, out: Path, also: Mapping[str, Any]
) -> tuple[YokeSetting, dict[str, Any]]:
    """Write a setting into a file and return it with what changed there, by paths with units.

    label: which setting to write; the first suggested one by default.
    out: where to write it, TOML or JSON; also: what else changes in the file, by paths with units.
    """
    best = (*advised(found), found.as_built)[0]
    chosen = best if label is None else named(every_setting(found), label)
    values = dict(also) | values_of(chosen, drive)
    write_changed(drive, text, values, out)
    return chosen, values


def check_copy(out: Path, file: Path, *, force: bool) -> None:
    """Refuse to write over another file unless told to, and what is neither TOML nor JSON, before any work is done."""
    if file != STDIN and out.exists() and file.exists() and out.samefile(file):
        check_target(out, "--out")
        return
    if out.suffix.lower() not in SUFFIXES:
        known = ", ".join(SUFFIXES)
        raise refuse("--out", _("{path} should end in one of {known}").format(path=out, known=known))
    check_new(out, force=force, field="--out")


def named(settings: Sequence[YokeSetting], label: str) -> YokeSetting:
    """Return the setting of a name, or of a word or more of one; the best comes first.

    A letter names a setting and is no part of a name: whoever asks for a setting E does not mean "16-tooth splines".
    """
    wanted = label.casefold()
    exact = [one for one in settings if one.label.casefold() == wanted]
    near = exact or [one for one in settings if len(wanted) > 2 and wanted in one.label.casefold()]
    if not near:
        labels = "; ".join(one.label for one in settings)
        raise refuse("--apply", _("there is no setting {label}; there are {labels}").format(label=label, labels=labels))
    return near[0]


def write_changed(drive: Drive, text: str, values: Mapping[str, Any], out: Path) -> None:
    """Write a drive file with other values.

    drive: the drive as it stands in the file; values: path with unit -> value; out: where to, TOML or JSON.
    """
    if is_json(out, text):
        form = "json" if out.suffix.lower() == ".json" else "toml"
        written = dumps(with_values(drive, values), form=form)
    else:
        written = edit(text, values) if values else text
    write_text(out, written, "--out")


def is_json(out: Path, text: str) -> bool:
    """Return whether a file is written or was read as JSON, so that there are no comments to keep."""
    return out.suffix.lower() == ".json" or text.lstrip().startswith("{")
