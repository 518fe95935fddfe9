"""The commands of ``cardan``. Nothing heavy is imported on this path: the help must come at once."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any

import typer

from cardan import register
from cardan.answers.question import Question
from cardan.texts import _
from cardan.version import VERSION

from .lazy import Entry, Group

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
            ),
        },
    ),
    "report": Entry(
        "files.report",
        QUESTIONS,
        _("Everything on one page: a self-contained HTML file that prints well."),
        ("cardan report truck.toml", "cardan report truck.toml -o truck.html --open"),
    ),
    "init": Entry("files.init", FILES, _("Write a commented drive file to start from."), ("cardan init my.toml",)),
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


def _entries() -> dict[str, Entry]:
    """Return the commands of all questions of the register, then those that ask none of them."""
    found: dict[str, Entry] = {}
    for question in register.QUESTIONS.values():
        command = question.command or question.name
        name, _blank, second = command.partition(" ")
        if not second:
            found[name] = _entry(question, command, QUESTIONS)
        elif not COMMANDS[name].module:
            group = found.setdefault(name, COMMANDS[name])
            inner = {**group.entries, second: _entry(question, command, _(question.group))}
            found[name] = replace(group, entries=inner)
    return {**found, **{name: entry for name, entry in COMMANDS.items() if name not in found}}


class Commands(Group):
    """All commands."""

    def __init__(self, **settings: Any) -> None:
        self.entries = _entries()
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
    context_settings={"help_option_names": ["-h", "--help"]},
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
