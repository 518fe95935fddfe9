"""``cardan joint``: how does a type of joint turn by itself, and which of several turns most uniformly?"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from math import isfinite
from typing import Annotated, Any

from cardan.cli.shared.asked import check_options
from cardan.cli.shared.options import argument, option
from cardan.cli.shared.source import AsCsv, AsJson, Plot, value_of
from cardan.cli.shared.tell import tell
from cardan.drive.joints import JOINTS
from cardan.drive.joints.joint import Joint
from cardan.errors import InputError, Problem, check, refuse
from cardan.io.reader import drive_from_tree
from cardan.questions.motion.joint_answer import Named, answer, answer_of_kinds, ask, sentence_of, written
from cardan.reading.fields import spellings_of
from cardan.texts import _
from cardan.units import deg, nearest, rpm

USUAL = 20.0  # joint angle [deg] where none is said


def _words(incomplete: str) -> list[tuple[str, str]]:
    """Complete the name of a kind."""
    return [(name, sentence_of(kind)) for name, kind in JOINTS.items() if name.startswith(incomplete)]


def joint(
    words: Annotated[
        list[str] | None,
        argument(
            "KIND [KEY=VALUE]",
            _("Kinds of joints, each followed by its sizes as a drive file has them; none lists the kinds."),
            autocompletion=_words,
        ),
    ] = None,
    joint_angle_deg: Annotated[
        float, option("--joint-angle-deg --joint-angle", "DEG", _("Joint angle of the joints."))
    ] = USUAL,
    speed_rpm: Annotated[
        float | None, option("--speed-rpm", "RPM", _("Input speed, for accelerations and limits."))
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


# Kinds of joints as the command line names them, read from words.


@dataclass(frozen=True, kw_only=True)
class Asked:
    """One joint as it was asked for."""

    kind: str
    keys: dict[str, Any]  # its sizes as a drive file has them
    label: str  # what it is called beside others


def asked(words: Sequence[str]) -> list[Asked]:
    """Return the joints that words name, each kind followed by its keys."""
    found: list[tuple[str, dict[str, Any], list[str]]] = []
    problems = []
    for word in words:
        key, equals, text = word.partition("=")
        if not equals:
            if word not in JOINTS:
                near = nearest(word, JOINTS)
                hint = _("; did you mean {near}?").format(near=near) if near else _("; cardan joint lists them")
                problems.append(Problem(word, _("there is no such kind of joint") + hint, "out_of_range"))
            found.append((word, {}, []))
        elif not found:
            problems.append(Problem(key, _("name a kind of joint first, then its sizes")))
        elif not _put(found[-1][1], key, text):
            problems.append(Problem(f"{found[-1][0]}.{key}", _("given twice"), "inconsistent"))
        else:
            found[-1][2].append(word)
    check(problems)
    kinds = [kind for kind, _keys, _said in found]
    return [
        Asked(kind=kind, keys=keys, label=" ".join([kind, *said]) if kinds.count(kind) > 1 else kind)
        for kind, keys, said in found
    ]


def _put(table: dict[str, Any], key: str, text: str) -> bool:
    """Put a value under a key with dots and tell whether the place was free."""
    *way, last = key.split(".")
    for step in way:
        inner = table.setdefault(step, {})
        if not isinstance(inner, dict):
            return False
        table = inner
    if last in table:
        return False
    table[last] = value_of(text)
    return True


def made(several: Sequence[Asked]) -> list[Named]:
    """Return the joints with their names and sizes, read as a drive file would be."""
    joints = []
    problems: list[Problem] = []
    for one in several:
        try:
            joints.append(Named(joint=_made(one), name=one.label, sizes=one.keys))
        except InputError as error:
            named = f"{one.kind}."
            problems += [
                Problem(problem.field.replace("joints[0].", named, 1), problem.message, problem.code)
                for problem in error.problems
            ]
    check(problems)
    return joints


def _made(one: Asked) -> Joint:
    kind = JOINTS[one.kind]
    places = {field.name for field in fields(Joint)}
    strange = [key for key in one.keys if _named(key, spellings_of(kind)) in places]
    text = _("means nothing for a joint by itself; its sizes are {keys}")
    known = ", ".join(written(kind)) or _("none")
    check(Problem(f"joints[0].{key}", text.format(keys=known), "unknown_key") for key in strange)
    return drive_from_tree({"format": 1, "joints": [{"kind": one.kind, "joint_angle_deg": 0.0, **one.keys}]}).joints[0]


def _named(key: str, spellings: dict[str, tuple[str, float]]) -> str:
    return spellings[key][0] if key in spellings else ""
