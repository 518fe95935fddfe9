"""Kinds of joints as the command line names them: read from words, listed with their keys."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from cardan.errors import InputError, Problem, check
from cardan.texts import _, plural

from .values import value_of

if TYPE_CHECKING:
    from cardan.drive.joints import Joint

    from .answer import Answer


@dataclass(frozen=True, kw_only=True)
class Asked:
    """One joint as it was asked for.

    Attributes
    ----------
    kind : str
    keys : dict
        Its sizes as a drive file has them.
    label : str
        What it is called beside others.
    """

    kind: str
    keys: dict[str, Any]
    label: str


def asked(words: Sequence[str]) -> list[Asked]:
    """Return the joints that words name, each kind followed by its keys.

    Raises
    ------
    InputError
        A kind that there is not, a key before any kind, a key given twice.

    Examples
    --------
    >>> [one.label for one in asked(["rzeppa", "hooke"])]
    ['rzeppa', 'hooke']
    >>> asked(["clemens", "driving.radius_mm=75"])[0].keys
    {'driving': {'radius_mm': 75}}
    """
    from cardan.drive.joints import JOINTS
    from cardan.units import nearest

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


def made(several: Sequence[Asked]) -> list[Joint]:
    """Return the joints, read as a drive file would be.

    Raises
    ------
    InputError
        Everything that is wrong with their keys, each as ``kind.key``.
    """
    joints = []
    problems: list[Problem] = []
    for one in several:
        try:
            joints.append(_made(one))
        except InputError as error:
            named = f"{one.kind}."
            problems += [
                Problem(problem.field.replace("joints[0].", named, 1), problem.message, problem.code)
                for problem in error.problems
            ]
    check(problems)
    return joints


def _made(one: Asked) -> Joint:
    from dataclasses import fields

    from cardan.drive.fields.keys import spellings_of
    from cardan.drive.joints import JOINTS
    from cardan.drive.joints.joint import Joint
    from cardan.io.reader import drive_from_tree

    kind = JOINTS[one.kind]
    places = {field.name for field in fields(Joint)}
    strange = [key for key in one.keys if _named(key, spellings_of(kind)) in places]
    text = _("means nothing for a joint by itself; its sizes are {keys}")
    known = ", ".join(_written(kind)) or _("none")
    check(Problem(f"joints[0].{key}", text.format(keys=known), "unknown_key") for key in strange)
    return drive_from_tree({"format": 1, "joints": [{"kind": one.kind, "bend_deg": 0.0, **one.keys}]}).joints[0]


def _named(key: str, spellings: dict[str, tuple[str, float]]) -> str:
    return spellings[key][0] if key in spellings else ""


def _written(kind: type[Joint]) -> list[str]:
    """Return the keys of a kind's own sizes as we write them."""
    from cardan.drive.fields.keys import fields_of

    return [one.spelling for name, one in fields_of(kind).items() if name in kind.own_fields()]


def kinds_answer() -> Answer:
    """Return the list of all kinds, with their sizes."""
    from math import degrees

    from cardan.drive.fields.keys import fields_of
    from cardan.drive.joints import JOINTS
    from cardan.questions.motion.joint_law import types_of

    from .answer import Answer, Column, Remark, Table

    rows = [
        (name, degrees(kind.steepest), sentence_of(kind), ", ".join(_written(kind))) for name, kind in JOINTS.items()
    ]
    columns = (
        Column(key="kind", heading=_("kind"), left=True),
        Column(key="steepest_deg", heading=_("works to"), unit="°", form="3"),
        Column(key="doc", left=True, wrap=True),
    )
    return Answer(
        sentence=plural("{count} kind of joint.", "{count} kinds of joints.", len(rows)).format(count=len(rows)),
        tables=lambda: (
            Table(
                columns=columns,
                rows=[(name, bend, f"{doc} [{keys}]" if keys else doc) for name, bend, doc, keys in rows],
            ),
        ),
        remarks=(
            Remark(
                text=_("Several at once are compared; sizes are the keys of the drive file:"),
                command=("cardan", "joint", "hooke", "double_cardan", "centring_ratio=0.5", "--bend-deg", "30"),
                tone="next",
            ),
        ),
        content=lambda: {
            "question": "joint",
            "kinds": [
                {
                    "kind": name,
                    "doc": sentence_of(kind),
                    "steepest_deg": degrees(kind.steepest),
                    "types": [row.id for row in types_of(name)],
                    "keys": [
                        {"key": one.spelling, "required": one.required, "doc": _(one.key.doc)}
                        for field, one in fields_of(kind).items()
                        if field in kind.own_fields()
                    ],
                }
                for name, kind in JOINTS.items()
            ],
        },
        csv=lambda: Table(columns=(*columns, Column(key="keys")), rows=rows),
    )


def sentence_of(kind: type[Joint]) -> str:
    """Return the one sentence that says what a kind is."""
    return _((kind.__doc__ or "").strip().splitlines()[0])
