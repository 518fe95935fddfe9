"""How options and arguments of the commands are declared: names, what stands for the value, what the help says."""

from __future__ import annotations

from typing import Any

import typer


def option(names: str, metavar: str, help: str, **limits: Any) -> Any:
    """Return an option with a value, its names parted by blanks; limits: ``min`` and ``max`` of it."""
    return typer.Option(*names.split(), metavar=metavar, help=help, **limits)


def flag(names: str, help: str) -> Any:
    """Return an option without a value of its own."""
    return typer.Option(*names.split(), help=help)


def argument(metavar: str | None, help: str, **more: Any) -> Any:
    """Return a word that stands without an option; more: as `typer.Argument` takes it."""
    return typer.Argument(metavar=metavar, help=help, show_default=False, **more)
