"""``cardan joint``: how does a type of joint turn by itself, and which of several turns most uniformly?"""

from __future__ import annotations

from math import isfinite
from typing import Annotated

import typer

from cardan.cli.shared.asked import check_options
from cardan.cli.shared.options import AsCsv, AsJson, Plot
from cardan.cli.shared.tell import tell
from cardan.drive.joints import JOINTS
from cardan.errors import InputError, refuse
from cardan.questions.motion.joint_answer import answer, answer_of_kinds, ask, sentence_of
from cardan.texts import _
from cardan.units import deg, rpm

from .joint_kinds import asked, made

USUAL = 20.0
"""Joint angle [deg] where none is said."""


def _words(incomplete: str) -> list[tuple[str, str]]:
    """Complete the name of a kind."""
    return [(name, sentence_of(kind)) for name, kind in JOINTS.items() if name.startswith(incomplete)]


def joint(
    words: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="KIND [KEY=VALUE]",
            help=_("Kinds of joints, each followed by its sizes as a drive file has them; none lists the kinds."),
            show_default=False,
            autocompletion=_words,
        ),
    ] = None,
    joint_angle_deg: Annotated[
        float, typer.Option("--joint-angle-deg", "--joint-angle", metavar="DEG", help=_("Joint angle of the joints."))
    ] = USUAL,
    speed_rpm: Annotated[
        float | None,
        typer.Option(
            "--speed-rpm", metavar="RPM", help=_("Input speed, for accelerations and limits."), show_default=False
        ),
    ] = None,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell how kinds of joints turn by themselves, over a turn and over their joint angles."""
    check_options(speed_rpm, json=json, csv=csv, plot=plot)
    if not words:
        return tell(answer_of_kinds(), json=json, csv=csv)
    if not isfinite(joint_angle_deg):
        raise refuse("--joint-angle-deg", _("{value} is not a finite number").format(value=joint_angle_deg))
    several = made(asked(words))
    try:
        result = ask(several, joint_angle_deg * deg, speed=None if speed_rpm is None else speed_rpm * rpm)
    except InputError as error:
        raise error.renamed(lambda field: "--joint-angle-deg" if field == "joint_angle" else field) from error
    return tell(answer(result), json=json, csv=csv, plot=plot)
