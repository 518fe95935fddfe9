"""Commands about drives that a mechanism file may ask too: motion and forces of its links."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from cardan.drive.fields.keys import spelled
from cardan.errors import InputError, Problem, check, refuse
from cardan.later import later
from cardan.maths.arrays import Array
from cardan.mechanism.mechanism import Mechanism
from cardan.register import QUESTIONS
from cardan.texts import _
from cardan.units import deg, rpm

from .failure import about
from .progress import watching
from .source import STDIN
from .tell import tell

turning = later("cardan.mechanism.turning")
"""How mechanisms turn: those who ask about drives need none of it."""

LISTED = 30.0 * deg
"""Step of the printed table."""


def on_duty(mechanism: Mechanism, speed_rpm: float | None, torque: float | None = None) -> Mechanism:
    """Return a mechanism with the input speed [rpm] and the torque at its output [N·m] of the command line."""
    if speed_rpm is not None:
        if mechanism.slides:
            raise refuse("--speed-rpm", _sliding(mechanism))
        mechanism = replace(mechanism, speed=speed_rpm * rpm)
    if torque is not None:
        if torque < 0.0:
            text = _("{value} is below zero; at a mechanism it is what resists the output")
            raise refuse("--torque-Nm", text.format(value=torque))
        mechanism = replace(mechanism, output_torque=torque, output_force=None)
    return mechanism


def angles(mechanism: Mechanism, angle: list[float] | None, step: float | None) -> Array | None:
    """Return the input angles asked for [rad]; None where none were."""
    if mechanism.slides and (angle or step is not None):
        raise refuse("--angle-deg" if angle else "--angle-step-deg", _sliding(mechanism))
    if angle:
        return deg * np.asarray(angle, dtype=float)
    return None if step is None else turning().grid(mechanism, step * deg)


def _sliding(mechanism: Mechanism) -> str:
    text = _("is of an input that turns; {link} slides, over input_stroke_mm of the file at sliding_speed_m_s")
    return text.format(link=repr(mechanism.input_link))


def told(
    name: str,
    mechanism: Mechanism,
    file: Path,
    asked: Array | None,
    *,
    listed: bool,
    json: bool,
    csv: bool,
    plot: Path | None,
) -> int:
    """Answer a question of the register about a mechanism; asked: at which angles; listed: a table of them too."""
    question = QUESTIONS[name].of_mechanism
    with keys_of(file), watching(_("following a turn")):
        needed = _("missing; the question {name} needs it").format(name=name)
        check(Problem(_(" or ").join(map(_key_of, some)), needed, "missing") for some in question.lacking(mechanism))
        ask: Callable[..., Any] = question.home.ask
        found = ask(mechanism)
        rough = turning().grid(mechanism, LISTED) if asked is None else asked
        shown = ask(mechanism, rough) if listed or asked is not None else None
    return tell(question.home.answer(mechanism, found, shown), file, mechanism, json=json, csv=csv, plot=plot)


@contextmanager
def keys_of(file: Path) -> Iterator[None]:
    """Name the file and its keys, with their units, in whatever an answer refuses."""
    with about(_("standard input") if file == STDIN else str(file)):
        try:
            yield
        except InputError as error:
            raise InputError(replace(one, field=_key_of(one.field)) for one in error.problems) from error


def _key_of(field: str) -> str:
    return spelled(field, Mechanism)
