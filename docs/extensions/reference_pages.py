"""Reference of the drive file's keys, the commands and the public names, written from the program itself."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import joint_pages
import name_pages

import cardan
from cardan.units import DIMENSIONS


def write(folder: Path) -> None:
    """Write all generated pages, touching only those that changed."""
    folder.mkdir(parents=True, exist_ok=True)
    pages = {
        "drive-file.md": drive_file(),
        "mechanism-file.md": mechanism_file(),
        "mechanisms.md": mechanisms(),
        "units.md": units(),
        "commands.md": commands(),
        "formulas.md": formulas(),
        "checks.md": checks(),
        "questions.md": questions(),
        "examples.md": examples(),
        "catalogue.md": rows(),
        "faults.md": faults(),
        "validation.md": validation(),
        "performance.md": performance(),
        **joint_pages.pages(),
    }
    listed, each = name_pages.pages()
    pages |= {"names.md": listed} | each
    (folder / "names").mkdir(exist_ok=True)
    for old in {*(folder / "names").glob("*.md")} - {folder / name for name in each}:
        old.unlink()
    for name, text in pages.items():
        file = folder / name
        if not file.exists() or file.read_text(encoding="utf-8") != text:
            file.write_text(text, encoding="utf-8")


def formulas() -> str:
    """Return the formulas of ``cardan calc``, one table a subject."""
    from cardan.calc.calculations import GROUPS

    parts = []
    for group in GROUPS:
        parts += [
            f"## {group.subject.rstrip('.')}",
            "",
            "| formula | what it answers | takes | gives | source |",
            "|---|---|---|---|---|",
        ]
        for one in group.calculations:
            keys = [", ".join(f"`{key.key}`" for key in some) for some in (one.takes, one.returns)]
            parts.append(
                "| " + " | ".join(_plain(text) for text in (f"`{one.name}`", one.doc, *keys, one.source)) + " |"
            )
        parts.append("")
    return "\n".join(parts)


def units() -> str:
    """Return the table of units each dimension may be written in."""
    rows = ["| dimension | key ends in (the first is what cardan writes) |", "|---|---|"]
    rows += [
        f"| {name.replace('_', ' ')} | {', '.join(f'`_{u}`' for u in given)} |" for name, given in DIMENSIONS.items()
    ]
    return "\n".join(rows) + "\n"


def drive_file() -> str:
    """Return one section for each table of the drive file."""
    from cardan.io import reference

    return reference()


def validation() -> str:
    """Return the table of how far every formula is from its independent computations."""
    from tests.reference.residuals import table

    return table()


def performance() -> str:
    """Return what the benchmarks measured last."""
    from benchmarks.__main__ import table

    return table()


def mechanism_file() -> str:
    """Return one section for each table of the mechanism file."""
    from cardan.io import mechanism_reference

    return mechanism_reference()


SHOWN = {
    "materials": ("id", "european", "american", "yield_strength_MPa", "ultimate_strength_MPa", "source", "confidence"),
    "joint_types": ("id", "name", "synchronous", "max_joint_angle_deg", "min_torque_Nm", "max_torque_Nm", "confidence"),
    "joint_sizes": (
        "id",
        "type",
        "rating.outer_mm",
        "rating.torque_Nm",
        "rating.max_torque_Nm",
        "mass_kg",
        "confidence",
    ),
    "bearings": (
        "id",
        "bore_mm",
        "outer_mm",
        "width_mm",
        "capacity_N",
        "static_capacity_N",
        "max_speed_rpm",
        "confidence",
    ),
    "shaft_seals": ("id", "seal_diameter_mm", "outer_mm", "width_mm", "confidence"),
    "faults": ("id", "fault", "orders", "torque_sensitive", "source", "confidence"),
}
"""Keys of tables that are too wide to show whole."""


def rows() -> str:
    """Return one section for each table of the catalogue, with all its rows."""
    from cardan.catalogue import TABLES, catalogue
    from cardan.catalogue.rows import row_flat

    parts = []
    for name, kind in TABLES.items():
        doc = (kind.__doc__ or "").strip().splitlines()[0]
        flat = [row_flat(row) for row in catalogue().tables.get(name, {}).values()]
        keys = SHOWN.get(name) or tuple(dict.fromkeys(key for one in flat for key in one if key != "note"))
        lines = ["| " + " | ".join(f"`{key}`" for key in keys) + " |", "|" + "---|" * len(keys)]
        lines += ["| " + " | ".join(_cell(one.get(key)) for key in keys) + " |" for one in flat]
        parts.append(f"## {name}\n\n{doc}\n\n" + "\n".join(lines) + "\n")
    return "\n".join(parts)


def faults() -> str:
    """Return the table of all faults by their signs, then how to make sure of each and what to do."""
    from cardan.catalogue import catalogue
    from cardan.catalogue.rows import Fault

    rows = catalogue().rows(Fault).values()
    signs = ["| id | fault | orders | with torque | noticed as | where it appears |", "|---|---|---|---|---|---|"]
    remedies = ["| id | how to make sure | what to do | source |", "|---|---|---|---|"]
    torque = {True: "changes", False: "stays", None: "–"}
    for row in rows:
        orders = ", ".join(f"{one:g}×" for one in row.orders)
        words = [", ".join(f"`{one}`" for one in some) for some in (row.symptoms, row.flags)]
        cells = (row.id, row.fault, orders or "–", torque[row.torque_sensitive], *(one or "–" for one in words))
        signs.append("| " + " | ".join(cells) + " |")
        remedies.append(f"| {row.id} | {_cell(row.inspection)} | {_cell(row.repair)} | {_cell(row.source)} |")
    return "\n".join(["## Signs", "", *signs, "", "## Inspection and repair", "", *remedies]) + "\n"


def _cell(value: Any) -> str:
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    text = f"{value:.10g}" if isinstance(value, float) else str(value)
    return text.replace("|", "\\|")


def examples() -> str:
    """Return one section for each shipped example: its picture, what the program says of it, its text."""
    from cardan.io import example, example_names, example_text
    from cardan.questions.motion.equivalence import SYNCHRONOUS
    from cardan.report.answers import subject

    parts = []
    for name in example_names():
        drive, text = example(name), example_text(name)
        said = f"{len(drive.joints)} joints" if len(drive.joints) > 1 else "one joint"
        share = subject(drive).fluctuation
        turns = (
            "its output is uniform" if share < SYNCHRONOUS else f"{100 * share:.3g} % speed fluctuation of its output"
        )
        turns += " as drawn" if drive.movements else ""
        parts.append(f"## {name}\n\n![{drive.name}](/_build/pictures/example-{name}.svg)\n")
        parts.append(f"{drive.name}: {said}, {turns}.\n")
        parts.append(f"```toml\n{text.strip()}\n```\n")
    return "\n".join(parts) or "\n"


def mechanisms() -> str:
    """Return one section for each shipped mechanism: what the program says of it, its text."""
    from cardan import mobility
    from cardan.io import example_text, mechanism_names
    from cardan.mechanisms import example_mechanism

    parts = []
    for name in mechanism_names():
        found, text = mobility(example_mechanism(name)), example_text(name)
        moves = f"{found.mobility} motions" if found.mobility > 1 else "one motion"
        held = f"{found.redundant} redundant constraints" if found.redundant else "no redundant constraint"
        parts.append(f"## {name}\n\n{found.mechanism.name}: {moves}, {held}.\n")
        parts.append(f"```toml\n{text.strip()}\n```\n")
    return "\n".join(parts) or "\n"


def checks() -> str:
    """Return the table of all checks, in the order in which they are asked."""
    from cardan import CHECKS

    rows = ["| check | judges |", "|---|---|"]
    return "\n".join([*rows, *(f"| `{name}` | {one.doc} |" for name, one in CHECKS.items())]) + "\n"


def questions() -> str:
    """Return the tables of all questions of a sweep with the columns of their answers: of a drive, of a mechanism."""
    from cardan import Drive
    from cardan.batch.answering.questions import questions as known

    drive = Drive.from_points([(0, 0, 0), (0.3, 0, 0), (1, 0.1, 0), (1.5, 0, 0)])
    slider = cardan.mechanisms.example_mechanism("crank-slider")
    parts = []
    for thing, found in ((drive, known()), (slider, known(mechanism=True))):
        rows = ["| question | answers | columns |", "|---|---|---|"]
        for name, one in found.items():
            told = ", ".join(f"`{told.name}`" for told in one.columns(thing))
            rows.append(f"| `{name}` | {one.doc} | {told} |")
        parts.append("\n".join(rows) + "\n")
    return "\nOf a mechanism file:\n\n".join(parts)


def commands() -> str:
    """Return one section for each command."""
    import typer.main

    from cardan.cli.app import app

    return "\n".join(_commands(typer.main.get_command(app), "cardan"))


def _commands(group: Any, path: str) -> Iterator[str]:
    import typer

    context = typer.Context(group, info_name=path)
    for name in group.list_commands(context):
        _name, command, _rest = group.resolve_command(context, [name])
        if command.hidden:
            continue
        if hasattr(command, "list_commands"):
            yield from _commands(command, f"{path} {name}")
            continue
        yield from _command(command, f"{path} {name}")
        for further in group.entries[name].entries:
            whole, inner, _rest = group.resolve_command(context, [name, further])
            yield from _command(inner, f"{path} {whole}")


def _command(command: Any, path: str) -> Iterator[str]:
    import typer

    yield f"## `{path}`\n\n{_plain(command.help)}\n"
    usage = " ".join(command.collect_usage_pieces(typer.Context(command, info_name=path)))
    yield f"```text\n{path} {usage}\n```\n"
    rows = ["| argument or option | meaning | default |", "|---|---|---|"]
    for parameter in command.params:
        if getattr(parameter, "hidden", False) or not getattr(parameter, "help", None):
            continue
        rows.append(f"| {_spelling(parameter)} | {_plain(parameter.help)} | {_given(parameter)} |")
    if len(rows) > 2:
        yield "\n".join(rows) + "\n"
    if command.epilog:
        lines = [line.strip() for line in _plain(command.epilog).splitlines() if line.strip()]
        yield "```text\n" + "\n".join(line for line in lines if line.lstrip("$ ").startswith("cardan")) + "\n```\n"


def _plain(text: str | None) -> str:
    return re.sub(r"\[/?\w+\]", "", text or "").replace("\\]", "]").replace("\b", "").replace("|", "\\|").strip()


def _spelling(parameter: Any) -> str:
    if parameter.param_type_name == "argument":
        return f"`{(parameter.metavar or parameter.name).upper()}`"
    takes = "" if parameter.is_flag or parameter.count else f" {parameter.metavar or parameter.type.name.upper()}"
    return ", ".join(f"`{name}{takes}`".replace("|", "\\|") for name in (*parameter.opts, *parameter.secondary_opts))


def _given(parameter: Any) -> str:
    value = parameter.default
    if value in (None, False, ()) or callable(value) or value == [] or "Sentinel" in type(value).__name__:
        return "**needed**" if parameter.required else "–"
    return f"`{value}`"
