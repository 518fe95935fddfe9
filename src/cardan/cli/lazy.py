"""The group of commands: each is imported when it is asked for, so that help costs the same for ten as for one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from importlib import import_module
from typing import Any

import typer
from typer.core import TyperCommand, TyperGroup


@dataclass(frozen=True, slots=True)
class Entry:
    """What the help says of a command without importing it.

    Parameters
    ----------
    module : str
        File in this folder; its function of the same name is the command.
    panel, help : str
        Where and how the help lists it.
    examples : tuple of str
        Lines below its own help.
    """

    module: str
    panel: str
    help: str
    examples: tuple[str, ...] = ()


def _plain(parameters: list[Any]) -> list[Any]:
    """Return the parameters; a flag is a flag and needs no word for its type."""
    for parameter in parameters:
        if getattr(parameter, "is_flag", False) and parameter.metavar is None:
            parameter.metavar = ""
    return parameters


class Command(TyperCommand):
    """A command whose help shows flags without ``<bool>``."""

    def get_params(self, ctx: Any) -> list[Any]:
        """Return the parameters of the command."""
        return _plain(super().get_params(ctx))


class Group(TyperGroup):
    """Commands by name, imported on use."""

    entries: Mapping[str, Entry] = {}

    def __init__(self, **settings: Any) -> None:
        super().__init__(**settings)
        for name, entry in self.entries.items():
            self.add_command(Command(name, help=entry.help, rich_help_panel=entry.panel))

    def get_params(self, ctx: Any) -> list[Any]:
        """Return the parameters before the command."""
        return _plain(super().get_params(ctx))

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        """Return the command itself, for a run or for completion."""
        name, listed, rest = super().resolve_command(ctx, args)
        return name, load(listed.name, self.entries[listed.name]) if listed and listed.name else listed, rest


def load(name: str, entry: Entry) -> Any:
    """Import a command and build it."""
    module = import_module(f".{entry.module}", __package__)
    run = getattr(module, entry.module)
    epilog = "\n\n".join(("[bold]$[/bold] " + example).replace("…]", "…\\]") for example in entry.examples)
    single = typer.Typer(rich_markup_mode="rich", pretty_exceptions_enable=False, add_completion=False)
    settings = {"help_option_names": ["-h", "--help"]}
    single.command(name, cls=Command, help=entry.help, epilog=epilog or None, context_settings=settings)(run)
    return typer.main.get_command(single)
