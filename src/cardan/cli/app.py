"""The commands of ``cardan``. Nothing heavy is imported on this path: the help must come at once."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any

import typer

from cardan import register
from cardan.texts import _

from .lazy import Entry, Group

QUESTIONS = _("Questions")
FILES = _("Drive files")
FORMULAS = _("Formulas")
DATA = _("Data")
DIAGNOSIS = _("Diagnosis")
ASKED = _("Torsional vibration")
CHOSEN = _("Measures against it")

COMMANDS = {
    "motion": Entry(
        "motion",
        QUESTIONS,
        _("How every shaft turns: angle, speed ratio, acceleration."),
        (
            "cardan motion truck.toml --speed-rpm 3000",
            "cardan motion truck.toml --csv > turn.csv",
            "cardan motion truck.toml --plot motion.svg",
        ),
    ),
    "phasing": Entry(
        "phasing",
        QUESTIONS,
        _("Which yoke angles make the output uniform, or how uniform it can be."),
        (
            "cardan phasing truck.toml --fix 2=90",
            "cardan phasing truck.toml --apply A -o better.toml",
            "cardan phasing boxed.toml --layout -o better.toml",
        ),
        aliases=("phases",),
    ),
    "articulation": Entry(
        "articulation",
        QUESTIONS,
        _("What happens while the drive moves: worst positions, spline strokes."),
        ("cardan articulation tractor.toml", "cardan articulation tractor.toml --csv > history.csv"),
    ),
    "forces": Entry(
        "forces",
        QUESTIONS,
        _("What every shaft, joint and bearing carries over a turn."),
        (
            "cardan forces truck.toml",
            "cardan forces truck.toml --torque-Nm 2000 --csv > turn.csv",
            "cardan forces tractor.toml --movement all",
            "cardan forces truck.toml --plot forces.svg",
        ),
    ),
    "losses": Entry(
        "losses",
        QUESTIONS,
        _("How much of the power is lost, and where."),
        ("cardan losses truck.toml", "cardan losses truck.toml --map --csv > map.csv"),
    ),
    "life": Entry(
        "life",
        QUESTIONS,
        _("How long the joints last, steadily or in a duty cycle."),
        ("cardan life truck.toml", "cardan life truck.toml --torque-Nm 900 --plot life.svg"),
    ),
    "strength": Entry(
        "strength",
        QUESTIONS,
        _("How strong every part is, the torque rating of the drive, and how large a part must be."),
        (
            "cardan strength truck.toml",
            "cardan strength truck.toml --size tube:2 --plot tubes.svg",
            "cardan strength truck.toml --size joint -o better.toml",
        ),
    ),
    "balance": Entry(
        "balance",
        QUESTIONS,
        _("What unbalance each shaft may have, and the masses that cancel what it has."),
        ("cardan balance truck.toml --grade G16",),
    ),
    "select": Entry(
        "select",
        QUESTIONS,
        _("Which types and sizes of joints do a job, and why not the others."),
        (
            "cardan select truck.toml",
            "cardan select --torque-Nm 2500 --joint-angle-deg 12 --speed-rpm 900 --synchronous",
            "cardan select truck.toml --catalogue my-maker.toml",
        ),
    ),
    "joint": Entry(
        "joint",
        QUESTIONS,
        _("How kinds of joints turn by themselves, one or several beside each other."),
        (
            "cardan joint",
            "cardan joint double_cardan centring_ratio=0.5 --joint-angle-deg 30",
            "cardan joint hooke rzeppa tracta --joint-angle-deg 25 --speed-rpm 1000 --plot joints.svg",
        ),
    ),
    "accuracy": Entry(
        "accuracy",
        QUESTIONS,
        _("What errors and tolerances of the joints do to the output, and the cheapest tolerances for a target."),
        (
            "cardan accuracy instrument.toml --method worst",
            "cardan accuracy instrument.toml --allocate 2arcmin -o better.toml",
        ),
        aliases=("tolerance",),
    ),
    "bending": Entry(
        "bending",
        QUESTIONS,
        _("At which speeds the shafts whirl, and how far the drive stays away."),
        (
            "cardan bending truck.toml",
            "cardan bending truck.toml --map",
            "cardan bending truck.toml --plot shapes.svg",
        ),
    ),
    "rotor": Entry(
        "rotor",
        QUESTIONS,
        _("How a shaft whirls with its unbalance and a crack: orders, orbits, running up."),
        (
            "cardan rotor truck.toml",
            "cardan rotor truck.toml --shaft 3 --plot orbits.svg",
            "cardan rotor truck.toml --joint 2 --speed-rpm 1500",
        ),
    ),
    "assembly": Entry(
        "assembly",
        QUESTIONS,
        _("What misalignment loads: support forces of parts that do not fit, and what to release."),
        ("cardan assembly pump.toml", "cardan assembly pump.toml --csv > turn.csv"),
    ),
    "mobility": Entry(
        "mobility",
        QUESTIONS,
        _("Whether a drive or mechanism turns, its redundant constraints, and what to release."),
        ("cardan mobility pump.toml", "cardan mobility slider.toml --turn --plot slider.svg"),
    ),
    "torsion": Entry(
        "",
        QUESTIONS,
        _("Torsional vibration: natural frequencies, steady and in time, stability."),
        ("cardan torsion modes truck.toml", "cardan torsion stability truck.toml --speeds 500:3000"),
        {
            "modes": Entry(
                "torsion_modes",
                ASKED,
                _("Natural frequencies, and the speeds at which something excites them."),
                ("cardan torsion modes truck.toml", "cardan torsion modes truck.toml --plot campbell.svg"),
            ),
            "response": Entry(
                "torsion_response",
                ASKED,
                _("How the shafts vibrate in torsion at a speed or over many."),
                (
                    "cardan torsion response truck.toml",
                    "cardan torsion response truck.toml --speeds 500:3000:200 --csv > sweep.csv",
                ),
            ),
            "simulate": Entry(
                "torsion_simulate",
                ASKED,
                _("Torques and speeds in time: load steps, histories, running up."),
                ("cardan torsion simulate truck.toml", "cardan torsion simulate truck.toml --settled --span-s 2"),
            ),
            "stability": Entry(
                "torsion_stability",
                ASKED,
                _("Whether vibration decays, at a speed or over a map."),
                (
                    "cardan torsion stability truck.toml",
                    "cardan torsion stability truck.toml --speeds 500:3000 --joint-angles 2:25 --plot map.svg",
                ),
            ),
            "absorber": Entry(
                "torsion_absorber",
                CHOSEN,
                _("Which absorber, damper or pendulum reduces it, where, and how it is to be set."),
                (
                    "cardan torsion absorber truck.toml --speeds 300:900",
                    "cardan torsion absorber truck.toml --kind pendulum --radius-mm 120 -o better.toml",
                ),
            ),
            "optimise": Entry(
                "torsion_optimise",
                CHOSEN,
                _("Which yoke angles, stiffnesses, inertias or joint positions make it least."),
                (
                    "cardan torsion optimise truck.toml --speeds 300:900",
                    "cardan torsion optimise truck.toml --free shafts[1].stiffness_Nm_per_rad=2e4:2e5 -o better.toml",
                ),
                aliases=("calm",),
            ),
        },
    ),
    "check": Entry(
        "check",
        QUESTIONS,
        _("Whether the drive keeps its limits, and which changes help where it does not."),
        ("cardan check truck.toml", "cardan check truck.toml --only tube_strength --json", "cardan check --list"),
    ),
    "diagnose": Entry(
        "diagnose",
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
        "simulate_fault",
        DIAGNOSIS,
        _("What a fault of the drive should show, and a recording of it."),
        (
            "cardan simulate-fault truck.toml --list",
            "cardan simulate-fault truck.toml worn_spline",
            "cardan simulate-fault truck.toml unbalance --snr-db 3 -o run.csv",
        ),
    ),
    "sweep": Entry(
        "sweep",
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
                "sweep_show",
                QUESTIONS,
                _("Results of a sweep: the best points, pictures, exports."),
                ("cardan sweep show results", "cardan sweep show results --plot sweep.html"),
            ),
        },
    ),
    "report": Entry(
        "report",
        QUESTIONS,
        _("Everything on one page: a self-contained HTML file that prints well."),
        ("cardan report truck.toml", "cardan report truck.toml -o truck.html --open"),
    ),
    "init": Entry("init", FILES, _("Write a commented drive file to start from."), ("cardan init my.toml",)),
    "example": Entry(
        "example",
        FILES,
        _("List the shipped examples, or copy one."),
        ("cardan example", "cardan example single-20deg"),
    ),
    "app": Entry(
        "browser",
        QUESTIONS,
        _("The drive turning in the browser, every answer beside it."),
        ("cardan app truck.toml", "cardan app truck.toml --port 8080 --no-browser"),
    ),
    "convert": Entry(
        "convert",
        FILES,
        _("Rewrite a drive file: points, angles or slopes; TOML or JSON."),
        ("cardan convert truck.toml truck.json", "cardan convert truck.toml angles.toml --form angles"),
    ),
    "schema": Entry(
        "schema",
        FILES,
        _("Print the JSON Schema of the drive file, for editors."),
        ("cardan schema > drive.schema.json",),
    ),
    "catalogue": Entry(
        "catalogue",
        DATA,
        _("Materials, types and sizes of joints, standards: each row with its source."),
        (
            "cardan catalogue materials C45",
            "cardan catalogue joint_sizes --keys",
            "cardan catalogue --check my-maker.toml",
        ),
    ),
    "calc": Entry(
        "calc",
        FORMULAS,
        _("Evaluate one formula by name."),
        ("cardan calc --list", "cardan calc single_joint_extremes alpha_deg=20"),
    ),
}
"""Name of a command -> what the help says of it; its code is the file of the same name."""


def _registered() -> Iterator[tuple[str, Entry]]:
    """Yield a command for every question of the register that none of the above asks."""
    for question in register.QUESTIONS.values():
        name = question.command or question.name
        if name.split()[0] not in COMMANDS:
            yield (
                name,
                Entry("asked", QUESTIONS, _(question.help), (f"cardan {name} truck.toml",), question=question.name),
            )


class Commands(Group):
    """All commands."""

    def __init__(self, **settings: Any) -> None:
        self.entries = {**COMMANDS, **dict(_registered())}
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
        from cardan import __version__

        typer.echo(f"cardan {__version__}")
        raise typer.Exit


@app.callback()
def _root(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help=_("Print the version and exit."))
    ] = False,
) -> None:
    """Hold what stands before the command."""
