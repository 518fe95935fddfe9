"""``cardan init``: a commented drive file to start from."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cardan.answers.answer import Answer, Remark
from cardan.cli.shared.options import argument, flag, option
from cardan.cli.shared.output import check_new, print_text, write_text
from cardan.cli.shared.source import STDIN, AsJson
from cardan.cli.shared.tell import tell
from cardan.errors import Problem, check, refuse
from cardan.io import dumps, loads, starter
from cardan.io.examples import LAYOUT, TEMPLATES, from_points, from_slopes, template
from cardan.reading.scalar import nearest_of
from cardan.texts import _, plural


def init(
    file: Annotated[Path, argument("FILE", _("File to write, TOML; - prints it."))],
    use: Annotated[
        str | None, option("--for", "USE", _("What the drive is for: {uses}.").format(uses=", ".join(TEMPLATES)))
    ] = None,
    points: Annotated[
        Path | None,
        option(
            "--from-points",
            "CSV",
            _("Points of its axis: x_mm, y_mm, z_mm; first a point of the input, last of the output, joints between."),
        ),
    ] = None,
    slopes: Annotated[
        Path | None,
        option("--from-slopes", "CSV", _("A row for each shaft: length_mm, side_slope_deg, plan_slope_deg.")),
    ] = None,
    force: Annotated[bool, flag("--force", _("Overwrite FILE."))] = False,
    json: AsJson = False,
) -> int:
    """Write a commented drive file to start from."""
    given = {"--for": use, "--from-points": points, "--from-slopes": slopes}
    chosen = [name for name, value in given.items() if value is not None]
    several = _("excludes {other}: a drive starts from one of them")
    check(Problem(name, several.format(other=chosen[0])) for name in chosen[1:])
    if use is not None and use not in TEMPLATES:
        known = ", ".join(TEMPLATES)
        text = _("{value} is none of {choices}").format(value=repr(use), choices=known)
        raise refuse("--for", text + nearest_of(use, TEMPLATES))
    if file != STDIN:
        check_new(file, force=force)
    name = "" if file == STDIN else file.stem
    if use is not None:
        text = template(use, name)
    elif points is not None:
        text = f"{_(LAYOUT)}\n{dumps(from_points(points, name))}"
    elif slopes is not None:
        text = f"{_(LAYOUT)}\n{dumps(from_slopes(slopes, name))}"
    else:
        text = starter()
    if file == STDIN:
        print_text(text)
        return 0
    write_text(file, text, "FILE")
    joints = len(loads(text).joints)
    begun = _("Put your numbers in, then:") if points is None and slopes is None else _("Add speed and torque, then:")
    return tell(
        Answer(
            name="init",
            title=_("Drive file to start from"),
            sentence=plural(
                "{file}: a drive of {n} joint written.", "{file}: a drive of {n} joints written.", joints
            ).format(file=file, n=joints),
            tone="good",
            remarks=(
                Remark(text=begun, command=("cardan", "report", str(file)), tone="next"),
                Remark(text=_("Other starting points:"), command=("cardan", "example"), tone="next"),
            ),
            facts={"file": str(file)},
        ),
        json=json,
    )
