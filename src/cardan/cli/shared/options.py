"""Options that mean the same in every command."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, TypeAlias

import typer

from cardan.texts import _

DriveFile: TypeAlias = Annotated[
    Path,
    typer.Argument(metavar="FILE", help=_("Drive file, TOML or JSON; - reads standard input."), show_default=False),
]
AsJson: TypeAlias = Annotated[
    bool, typer.Option("--json", help=_("Print everything as JSON, errors (on stderr) too."), show_default=False)
]
AsCsv: TypeAlias = Annotated[bool, typer.Option("--csv", help=_("Print the full table as CSV."), show_default=False)]
Plot: TypeAlias = Annotated[
    Path | None,
    typer.Option(
        "--plot",
        metavar="PATH",
        help=_("Draw the figure into PATH: .svg, .png, .pdf or .html."),
        show_default=False,
    ),
]
SpeedRpm: TypeAlias = Annotated[
    float | None,
    typer.Option(
        "--speed-rpm",
        metavar="RPM",
        help=_("Input speed, instead of the one in the file."),
        show_default=False,
    ),
]
MoreRows: TypeAlias = Annotated[
    list[Path] | None,
    typer.Option(
        "--catalogue",
        metavar="FILE",
        help=_("Catalogue file with more sizes, types, grades or standards; may be repeated."),
        show_default=False,
    ),
]
Force: TypeAlias = Annotated[
    bool, typer.Option("--force", help=_("Overwrite PATH where it is not FILE itself."), show_default=False)
]
