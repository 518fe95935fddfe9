"""``cardan mobility``: will it turn, which constraints are redundant, and what to release?"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

from cardan.choices import bearing_layouts_answer
from cardan.choices.bearing_layouts import KEPT
from cardan.cli.shared import mechanisms
from cardan.cli.shared.apply import check_copy, is_json
from cardan.cli.shared.asked import keys_of
from cardan.cli.shared.options import flag, option
from cardan.cli.shared.output import check_common, write_text
from cardan.cli.shared.progress import watching
from cardan.cli.shared.source import AsCsv, AsJson, EitherFile, Force, Plot, read_either, read_with_text
from cardan.cli.shared.tell import tell
from cardan.drive.drive import Drive
from cardan.drive.duty import Limits
from cardan.errors import Problem, check, refuse
from cardan.io import dumps
from cardan.io.amend import amend, insert
from cardan.mechanism.mechanism import Mechanism
from cardan.questions.mobility.answer import answer, turned
from cardan.questions.mobility.mobility import mobility as question
from cardan.reading.fields import spellings_of
from cardan.register import QUESTIONS
from cardan.texts import _
from cardan.units import mm


def mobility(
    file: EitherFile,
    turn: Annotated[bool, flag("--turn", _("Follow it over a turn of the input."))] = False,
    layouts: Annotated[
        bool,
        flag("--layouts", _("Tell instead which bearings and splines would make the drive statically determinate.")),
    ] = False,
    other_joints: Annotated[
        bool, flag("--other-joints", _("With --layouts: the joints too may be of other kinds."))
    ] = False,
    apply: Annotated[
        int | None, option("--apply", "LAYOUT", _("Which layout -o writes; the first by default."))
    ] = None,
    out: Annotated[
        Path | None, option("--out -o", "PATH", _("Write a layout into a copy of FILE, comments kept; may be FILE."))
    ] = None,
    force: Force = False,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell whether a drive or mechanism turns, and its redundant constraints."""
    check_common(json=json, csv=csv, plot=plot)
    if not layouts:
        given = {"--other-joints": other_joints, "--apply": apply is not None, "--out": out is not None}
        check(Problem(name, _("belongs to --layouts")) for name, used in given.items() if used)
        thing = read_either(file)
        return _told(thing, file, turn=turn, json=json, csv=csv, plot=plot)
    if turn:
        raise refuse("--turn", _("layouts are turned anyway; omit it"))
    if apply is not None and out is None:
        raise refuse("--apply", _("needs -o PATH; -o with the name of FILE overwrites it"))
    if out is not None:
        check_copy(out, file, force=force)
    drive, text = read_with_text(file)
    with watching(_("looking for layouts")):
        found = QUESTIONS["layouts"].ask(drive, other_joints=other_joints)
    if found is None:
        raise refuse("layouts", bearing_layouts_answer.otherwise(drive))
    if out is not None:
        held = bearing_layouts_answer.chosen(found, apply or 1)
        write_text(out, _written(drive, held.drive, text, out), "--out")
    said = bearing_layouts_answer.answer(drive, found)
    return tell(said, file, drive, json=json, csv=csv, plot=plot)


def _told(thing: Drive | Mechanism, file: Path, *, turn: bool, json: bool, csv: bool, plot: Path | None) -> int:
    keys = mechanisms.keys_of if isinstance(thing, Mechanism) else keys_of
    with keys(file), watching(_("following a turn")) as progress:
        found = question(thing)
        around = turned(thing, progress) if turn else None
    return tell(answer(thing, found, around), file, thing, json=json, csv=csv, plot=plot)


def _written(drive: Drive, held: Drive, text: str, out: Path) -> str:
    """Return a drive file with the bearings, splines and joints of another drive, all else as it is."""
    if is_json(out, text):
        return dumps(held, form="json" if out.suffix.lower() == ".json" else "toml")
    values: dict[str, Any] = {"supports": None}
    if held.limits != drive.limits:  # one of splines, where none is left
        values |= {
            f"limits.{key}": None for key, (name, _f) in spellings_of(Limits).items() if name == "spline_overlap"
        }
    for k, (was, joint) in enumerate(zip(drive.joints, held.joints, strict=True)):
        if joint is not was:
            own = [key for key, (name, _factor) in spellings_of(type(was)).items() if name not in KEPT]
            values |= {f"joints[{k}].{key}": None for key in own} | {f"joints[{k}].kind": joint.kind}
    for k, (before, shaft) in enumerate(zip(drive.shafts, held.shafts, strict=True)):
        if shaft.spline is None:
            values[f"shafts[{k}].spline"] = None
        elif before.spline is None:
            values[f"shafts[{k}].spline.position_mm"] = _mm(shaft.spline.position or 0.0)
    text = amend(text, values)
    for k, one in enumerate(held.supports):
        table = {"shaft": one.shaft, "position_mm": _mm(one.position)} | ({"axial": True} if one.axial else {})
        text = insert(text, f"supports[{k}]", table)
    return text


def _mm(length: float) -> float:
    return round(length / mm, 6)
