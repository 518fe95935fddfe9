"""The commands of ``cardan``. Nothing heavy is imported on this path: the help must come at once."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Annotated, Any

import typer
from typer.core import TyperCommand, TyperGroup

from cardan import register
from cardan.answers.question import Question
from cardan.texts import LANGUAGES, _, language
from cardan.version import VERSION

# The group of commands: each is imported when it is asked for, so that help costs the same for ten as for one.

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
    lifted = _("Read files however large or deep they are; so does CARDAN_NO_LIMITS=1.")
    no_limits: bool = typer.Option(False, "--no-limits", show_default=False, help=lifted)
    wanted: str = typer.Option("", "--lang", metavar="|".join(LANGUAGES), show_default=False, help=text)

    @single.command()
    def command(unit: str = unit, decimal: str = decimal, no_limits: bool = no_limits, lang: str = wanted) -> None:
        pass

    options = typer.main.get_command(single).params[:4]
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


QUESTIONS = _("Questions")
FILES = _("Drive files")
FORMULAS = _("Formulas")
DATA = _("Data")
DIAGNOSIS = _("Diagnosis")

HERE = {path.stem: f"{path.parent.name}.{path.stem}" for path in Path(__file__).parent.glob("*/*.py")}
"""File of a command -> where it is among the folders here."""

COMMANDS = {
    "joint": Entry(
        "motion.joint",
        QUESTIONS,
        _("How kinds of joints turn by themselves, one or several beside each other."),
        (
            "cardan joint",
            "cardan joint double_cardan centring_ratio=0.5 --joint-angle-deg 30",
            "cardan joint hooke rzeppa tracta --joint-angle-deg 25 --speed-rpm 1000 --plot joints.svg",
        ),
    ),
    "torsion": Entry(
        "",
        QUESTIONS,
        _("Torsional vibration: natural frequencies, steady and in time, stability."),
        ("cardan torsion modes truck.toml", "cardan torsion stability truck.toml --speeds 500:3000"),
    ),
    "diagnose": Entry(
        "diagnosis.diagnose",
        DIAGNOSIS,
        _("What is likely wrong with a drive that shakes, by a recording of it."),
        (
            "cardan diagnose run.csv truck.toml",
            "cardan diagnose run.wav truck.toml --title left=tacho --title right=acceleration_front_z_g",
            "cardan diagnose run.csv truck.toml --report diagnosis.html",
            "cardan diagnose --orders 2 --with-torque",
        ),
    ),
    "simulate-fault": Entry(
        "diagnosis.simulate_fault",
        DIAGNOSIS,
        _("What a fault of the drive should show, and a recording of it."),
        (
            "cardan simulate-fault truck.toml --list",
            "cardan simulate-fault truck.toml worn_spline",
            "cardan simulate-fault truck.toml unbalance --snr-db 3 -o run.csv",
        ),
    ),
    "field-balance": Entry(
        "diagnosis.field_balance",
        DIAGNOSIS,
        _("Which masses balance a shaft in its drive, by runs with trial masses."),
        ("cardan field-balance run0.csv --trial run1.csv=60,250,0 --trial run2.csv=1090,250,0 --radius-mm 38",),
    ),
    "sweep": Entry(
        "sweep.sweep",
        QUESTIONS,
        _("Parameter sweep over grids, lists and random samples."),
        (
            "cardan sweep plan.toml",
            "cardan sweep plan.toml --into results --engine processes",
            "cardan sweep plan.toml --into results --scheduler tcp://head:8786",
            "cardan sweep show results",
        ),
        {
            "show": Entry(
                "sweep.sweep_show",
                QUESTIONS,
                _("Results of a sweep: the best points, pictures, exports."),
                ("cardan sweep show results", "cardan sweep show results --plot sweep.html"),
            )
        },
    ),
    "report": Entry(
        "files.report",
        QUESTIONS,
        _("Everything on one page: a self-contained HTML file that prints well."),
        (
            "cardan report truck.toml",
            "cardan report truck.toml -o truck.pdf --full",
            "cardan report truck.toml other.toml -o compared.html",
        ),
    ),
    "init": Entry(
        "files.init",
        FILES,
        _("Write a commented drive file to start from."),
        (
            "cardan init my.toml",
            "cardan init my.toml --for pto",
            "cardan init my.toml --from-points centres.csv",
            "cardan init my.toml --from-slopes slopes.csv",
        ),
    ),
    "example": Entry(
        "files.example",
        FILES,
        _("List the shipped examples, or copy one."),
        ("cardan example", "cardan example single-20deg"),
    ),
    "app": Entry(
        "files.browser",
        QUESTIONS,
        _("The drive turning in the browser, every answer beside it."),
        ("cardan app truck.toml", "cardan app truck.toml --port 8080 --no-browser"),
    ),
    "convert": Entry(
        "files.convert",
        FILES,
        _("Rewrite a drive file: points, angles or slopes; TOML or JSON."),
        ("cardan convert truck.toml truck.json", "cardan convert truck.toml angles.toml --form angles"),
    ),
    "schema": Entry(
        "files.schema",
        FILES,
        _("Print the JSON Schema of the drive file, for editors."),
        ("cardan schema > drive.schema.json",),
    ),
    "keys": Entry(
        "files.keys",
        FILES,
        _("Keys of the drive file: units, allowed values, default, meaning, an example."),
        ("cardan keys duty", "cardan keys joints.cross", "cardan keys --csv"),
    ),
    "help": Entry(
        "files.lookup",
        FORMULAS,
        _("Find commands, checks, keys, formulas and examples by a word of the trade."),
        ("cardan help stress", "cardan help u-joint"),
    ),
    "catalogue": Entry(
        "files.catalogue",
        DATA,
        _("Materials, types and sizes of joints, standards: each row with its source."),
        (
            "cardan catalogue materials C45",
            "cardan catalogue joint_sizes --keys",
            "cardan catalogue --check my-maker.toml",
        ),
    ),
    "calc": Entry(
        "files.calc",
        FORMULAS,
        _("Evaluate one formula by name."),
        ("cardan calc --list", "cardan calc single_joint_extremes alpha_deg=20"),
    ),
}
"""What is no question of the register: name of a command -> what the help says of it, and the file of its code."""


def _entry(question: Question, command: str, panel: str) -> Entry:
    """Return the command of a question: its file here, where there is one, else that of all questions."""
    module = re.sub(r"\W", "_", command)
    own = module in HERE
    return Entry(
        HERE[module] if own else "shared.asked",
        _(question.panel) if question.panel else panel,
        _(question.help),
        question.examples or (f"cardan {command} truck.toml",),
        aliases=question.aliases,
        question="" if own else question.name,
    )


def commands() -> dict[str, Entry]:
    """Return the commands of all questions of the register, then those that ask none of them."""
    found: dict[str, Entry] = {}
    for question in register.QUESTIONS.values():
        command = question.command or question.name
        name, _blank, second = command.partition(" ")
        if not second:
            found[name] = _entry(question, command, QUESTIONS)
        elif name in COMMANDS and not COMMANDS[name].module:
            group = found.setdefault(name, COMMANDS[name])
            inner = {**group.entries, second: _entry(question, command, _(question.group))}
            found[name] = replace(group, entries=inner)
    return {**found, **{name: entry for name, entry in COMMANDS.items() if name not in found}}


class Commands(Group):
    """All commands."""

    def __init__(self, **settings: Any) -> None:
        self.entries = commands()
        super().__init__(**settings)


app = typer.Typer(
    name="cardan",
    cls=Commands,
    help=_("Analyse and design universal-joint drivelines."),
    epilog=_("New here? cardan init my.toml, then cardan report my.toml")
    + "\n\n"
    + _("Exit codes: 0 done, 1 a check failed, 2 bad input, 130 interrupted."),
    rich_markup_mode="rich",
    pretty_exceptions_enable=False,
    context_settings=HELP,
)


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"cardan {VERSION}")
        raise typer.Exit


@app.callback()
def _root(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help=_("Print the version and exit."))
    ] = False,
) -> None:
    """Hold what stands before the command."""
