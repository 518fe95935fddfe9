"""The group of commands: each is imported when it is asked for, so that help costs the same for ten as for one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from importlib import import_module
from typing import Any

import typer
from typer.core import TyperCommand, TyperGroup

from cardan.texts import LANGUAGES, _, language

HELP = {"help_option_names": ["-h", "--help"]}


@dataclass(frozen=True, slots=True)
class Entry:
    """What the help says of a command without importing it."""

    # folder and file below this one, ``motion.phasing``; the function named like the file is the command. Empty for a
    # group.
    module: str
    panel: str  # panel, help: where and how the help lists it
    help: str
    examples: tuple[str, ...] = ()  # lines below its own help
    # commands of a group; of a command with a module of its own, what else its first word may ask for
    entries: Mapping[str, Entry] = field(default_factory=dict)
    aliases: tuple[str, ...] = ()  # other names that ask it and that the help does not list
    question: str = ""  # question of the register that it asks, where it has no file of its own


@cache
def _reader_options(_spoken: str) -> list[Any]:
    """Return the options of every command that `cardan.cli.main` obeys before any command is imported."""
    single = typer.Typer(add_completion=False)
    languages = ", ".join(f"{code} ({name})" for code, name in LANGUAGES.items())
    text = _("Language of the answers: {languages}. CARDAN_LANG sets it for good.").format(languages=languages)
    units = _("Unit that a dimension is told in, such as length=in or torque=lbft; may be repeated.")
    sign = _("Sign between whole and part, a point or a comma.")
    unit: str = typer.Option("", "--unit", metavar="DIMENSION=UNIT", show_default=False, help=units)
    decimal: str = typer.Option("", "--decimal", metavar="SIGN", show_default=False, help=sign)
    wanted: str = typer.Option("", "--lang", metavar="|".join(LANGUAGES), show_default=False, help=text)

    @single.command()
    def command(unit: str = unit, decimal: str = decimal, lang: str = wanted) -> None:
        pass

    options = typer.main.get_command(single).params[:3]
    for option in options:
        option.expose_value = False
    return options


def _common(parameters: list[Any]) -> list[Any]:
    """Return the parameters with those of the reader before the help; a flag needs no word for its type."""
    own = {one.name for one in parameters}
    common = [one for one in _reader_options(language()) if one.name not in own]
    parameters = [*parameters[:-1], *common, *parameters[-1:]]
    for parameter in parameters:
        if getattr(parameter, "is_flag", False) and parameter.metavar is None:
            parameter.metavar = ""
        parameter.help = _(parameter.help) if parameter.help else parameter.help
    return parameters


def _usage(command: Any, ctx: Any, formatter: Any) -> None:
    """Write how a command is called."""
    pieces = [_(piece) for piece in command.collect_usage_pieces(ctx)]
    formatter.write_usage(ctx.command_path, " ".join(pieces), prefix=_("Usage:") + " ")


class Command(TyperCommand):
    """A command that takes the options of the reader, and whose help speaks our language, flags without ``<bool>``."""

    def get_params(self, ctx: Any) -> list[Any]:
        """Return the parameters of the command."""
        return _common(super().get_params(ctx))

    def format_usage(self, ctx: Any, formatter: Any) -> None:
        """Write how the command is called."""
        _usage(self, ctx, formatter)


class Group(TyperGroup):
    """Commands by name, imported on use."""

    entries: Mapping[str, Entry] = {}

    def __init__(self, **settings: Any) -> None:
        super().__init__(**settings)
        for name, entry in self.entries.items():
            self.add_command(_listed(name, entry))

    def get_params(self, ctx: Any) -> list[Any]:
        """Return the parameters before the command."""
        return _common(super().get_params(ctx))

    def format_usage(self, ctx: Any, formatter: Any) -> None:
        """Write how a command of the group is called."""
        _usage(self, ctx, formatter)

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        """Return what is listed under a name or an alias of it."""
        own = (name for name, entry in self.entries.items() if cmd_name in entry.aliases)
        return super().get_command(ctx, next(own, cmd_name))

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        """Return the command itself, for a run or for completion."""
        name, listed, rest = super().resolve_command(ctx, args)
        if listed is None or not listed.name or not self.entries[listed.name].module:
            return name, listed, rest
        entry = self.entries[listed.name]
        if rest and rest[0] in entry.entries:
            whole = f"{listed.name} {rest[0]}"
            return whole, load(whole, entry.entries[rest[0]]), rest[1:]
        return name, load(listed.name, entry), rest


def _listed(name: str, entry: Entry) -> Any:
    """Return what stands in a group for a command that is not imported yet, or a group within it."""
    if entry.module or not entry.entries:
        return Command(name, help=entry.help, rich_help_panel=entry.panel)

    class Inner(Group):
        entries = entry.entries

        def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
            return super().parse_args(ctx, args or ["--help"])

    return Inner(
        name=name,
        help=entry.help,
        rich_help_panel=entry.panel,
        rich_markup_mode="rich",
        epilog=_epilog(entry),
        context_settings=HELP,
    )


def _epilog(entry: Entry) -> str | None:
    lines = (("[bold]$[/bold] " + example).replace("…]", "…\\]") for example in entry.examples)
    return "\n\n".join(lines) or None


def load(name: str, entry: Entry) -> Any:
    """Import a command and build it."""
    module = import_module(f".{entry.module}", __package__)
    run = module.command_of(entry.question) if entry.question else getattr(module, entry.module.rpartition(".")[2])
    single = typer.Typer(rich_markup_mode="rich", pretty_exceptions_enable=False, add_completion=False)
    single.command(name, cls=Command, help=entry.help, epilog=_epilog(entry), context_settings=HELP)(run)
    return typer.main.get_command(single)
