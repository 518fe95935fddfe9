"""``cardan keys``: the keys of the drive file with units, allowed values, default, meaning and an example."""

from __future__ import annotations

from typing import Annotated

from cardan.answers.answer import Answer, Column, Remark, Table
from cardan.cli.shared.options import argument
from cardan.cli.shared.output import check_common
from cardan.cli.shared.source import AsCsv, AsJson
from cardan.cli.shared.tell import tell
from cardan.errors import refuse
from cardan.io.keys import FileKey, file_keys, written_in_examples
from cardan.texts import _, plural
from cardan.units import nearest

FEW = 40  # as many keys are told with an example of each


def keys(
    path: Annotated[str | None, argument("PATH", _("Table or key, as duty, joints.cross or shafts.outer_mm."))] = None,
    json: AsJson = False,
    csv: AsCsv = False,
) -> int:
    """List the keys of the drive file: units, allowed values, default, meaning, an example."""
    check_common(json=json, csv=csv)
    return tell(answer(path or ""), json=json, csv=csv)


def answer(path: str) -> Answer:
    """Return what there is to say of the keys at a path or below it.

    Raises InputError: there is no such key; the message names the nearest.
    """
    found = file_keys(path)
    if not found:
        every = {key.name: key for key in file_keys()}
        near = nearest(path.rpartition(".")[2], every)
        text = _("{path}: not a key of the drive file").format(path=repr(path))
        raise refuse("PATH", text + (_("; the nearest is {near}").format(near=every[near].path) if near else ""))
    table = _full(found)
    text = plural("One key.", "{count} keys; any of the units is read.", len(found)).format(count=len(found))
    return Answer(
        name="keys",
        title=_("Keys of the drive file"),
        sentence=text,
        tables=(_few(found) if len(found) <= FEW else _many(found),),
        remarks=(Remark(text=_("One table or key:"), command=("cardan", "keys", "joints.cross"), tone="next"),),
        facts={"keys": [_record(key) for key in found]},
        full=lambda: table,
    )


def _few(found: tuple[FileKey, ...]) -> Table:
    shown = [written_in_examples(key) for key in found]
    return Table(
        fixed=1,
        columns=(
            Column(key="", heading=_("key"), values=[key.path for key in found], left=True, wrap=True),
            Column(key="", heading=_("value"), values=[_value(key) for key in found], left=True, wrap=True),
            *((Column(key="", heading=_("example"), values=shown, left=True, wrap=True),) if any(shown) else ()),
            Column(key="", heading=_("meaning"), values=[_meaning(key) for key in found], left=True, wrap=True),
        ),
    )


def _value(key: FileKey) -> str:
    """Return what a key may hold and what it is when it is not given."""
    usual = _("required") if key.required else _("{value} by default").format(value=key.default) if key.default else ""
    return "; ".join(part for part in (key.value, usual) if part)


def _many(found: tuple[FileKey, ...]) -> Table:
    return Table(
        columns=(
            Column(key="", heading=_("key"), values=[key.path for key in found], left=True),
            Column(key="", heading=_("meaning"), values=[_meaning(key) for key in found], left=True, wrap=True),
        )
    )


def _full(found: tuple[FileKey, ...]) -> Table:
    return Table(
        columns=(
            Column(key="key", values=[key.path for key in found]),
            Column(key="units", values=[" ".join(key.units) for key in found]),
            Column(key="value", values=[key.value for key in found]),
            Column(key="default", values=[_default(key) for key in found]),
            Column(key="kinds", values=[" ".join(key.kinds) for key in found]),
            Column(key="meaning", values=[key.meaning for key in found]),
        )
    )


def _record(key: FileKey) -> dict[str, object]:
    return {
        "key": key.path,
        "units": list(key.units),
        "value": key.value,
        "required": key.required,
        "default": key.default,
        "kinds": list(key.kinds),
        "meaning": key.meaning,
    }


def _default(key: FileKey) -> str:
    return _("required") if key.required else key.default


def _meaning(key: FileKey) -> str:
    return f"{key.meaning} ({', '.join(key.kinds)})" if key.kinds else key.meaning
