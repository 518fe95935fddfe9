"""Writes the yoke angles of a setting into a drive file, its comments kept."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cardan.errors import refuse
from cardan.texts import _

from .convert import SUFFIXES

if TYPE_CHECKING:
    from cardan.drive.drive import Drive
    from cardan.questions.phases.phases import Phasing, YokeSetting

    from .answer import Answer


def applied(
    answer: Answer,
    found: Phasing,
    drive: Drive,
    text: str,
    *,
    label: str | None,
    out: Path,
    also: Mapping[str, Any],
) -> Answer:
    """Write a setting and return the answer with a word on it.

    Parameters
    ----------
    answer : Answer
        What `cardan phases` found.
    found : Phasing
        What it found.
    drive : Drive
        The drive as it stands in the file.
    text : str
        The file.
    label : str or None
        Which setting to write; the first suggested one by default.
    out : path
        Where to write it, TOML or JSON.
    also : mapping of str to value
        What else changes in the file, by paths with units.
    """
    from cardan.drive.fields.paths import with_values
    from cardan.io import dumps, edit
    from cardan.questions.phases.setting import values_of

    from .answer import Remark, percent
    from .output import write_text
    from .phasing import every_setting

    best = (*found.pose_settings, *found.settings, found.as_built)[0]
    chosen = best if label is None else named(every_setting(found), label)
    values = dict(also) | values_of(chosen, drive)
    if out.suffix.lower() == ".json" or text.lstrip().startswith("{"):
        form = "json" if out.suffix.lower() == ".json" else "toml"
        written = dumps(with_values(drive, values), form=form)
    else:
        written = edit(text, values) if values else text
    write_text(out, written, "--out")
    done = _("{path}: setting {label} written, {share} irregular.").format(
        path=out, label=chosen.label, share=percent(chosen.irregularity)
    )
    kept = [remark for remark in answer.remarks if remark.tone != "next"]
    step = Remark(text=_("Look at the new drive:"), command=("cardan", "report", str(out)), tone="next")
    said = {"applied": {"setting": chosen.label, "file": str(out), "values": values}}
    return replace(
        answer, remarks=(*kept, Remark(text=done, tone="good"), step), content=lambda: {**answer.content(), **said}
    )


def check_copy(out: Path, file: Path, *, force: bool) -> None:
    """Refuse to write over another file unless told to, and what is neither TOML nor JSON, before any work is done."""
    from .output import check_new, check_target
    from .source import STDIN

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

    Raises
    ------
    InputError
        There is none.
    """
    wanted = label.casefold()
    exact = [one for one in settings if one.label.casefold() == wanted]
    near = exact or [one for one in settings if len(wanted) > 2 and wanted in one.label.casefold()]
    if not near:
        labels = "; ".join(one.label for one in settings)
        raise refuse("--apply", _("there is no setting {label}; there are {labels}").format(label=label, labels=labels))
    return near[0]
