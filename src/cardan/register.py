"""The register of questions: what can be asked of a drive, once for commands, report, app, sweeps and Python.

Adding a question is one folder in `cardan.questions` and one entry here. Entries are light; the module of a question is
imported when it is asked, see `cardan.answers.question`.
"""

from __future__ import annotations

from cardan.answers.question import ASIDE, NOWHERE, Place, Question
from cardan.texts import mark

MOTION, PHASING, FORCES, LOSSES = mark("Motion"), mark("Phasing"), mark("Forces"), mark("Power loss")
ACCURACY, TORSION, BENDING, LIFE = mark("Accuracy"), mark("Torsion"), mark("Bending"), mark("Life")
MEASURES = mark("Measures against torsional vibration")
STRENGTH, CHECKS, SUPPORTS, CHOICE = mark("Strength"), mark("Checks"), mark("Mobility"), mark("Selection")

DRAWN = mark("The classical approximations are judged here, for the drive as drawn, and not the drive itself.")
GEOMETRY = mark("Torque does not count here: this follows from geometry alone.")
MINUTES = mark("Errors of the joints as made do not count here: they move shafts by minutes of arc; see the accuracy.")
YOKES = mark("Yoke angles do not depend on the torque.")
TURNS = mark("The movement does not count here: yokes are phased for the drive as drawn and for its poses.")
RUNS = mark("The run-up is that of the drive as drawn: it passes too quickly for poses and movements to change.")
DESIGNED = mark(
    "This is designed for the drive as drawn at its duty; how it behaves in other conditions the other questions about "
    "torsion tell."
)
ANGLES = mark("The movement does not count here: the map runs over joint angles, those that it passes among them.")
WHIRLS = mark("Poses and movements do not count here: the shaft whirls at the length that it is drawn with.")
HELD = mark("Layouts are made for the drive as drawn at its duty.")
CHOSEN = mark("Errors of the joints as made do not count here: types and sizes are chosen by loads and angles.")

QUESTIONS: dict[str, Question] = {
    question.name: question
    for question in (
        Question(
            name="motion",
            module="cardan.questions.motion.answer",
            title=mark("Motion"),
            group=MOTION,
            help=mark("How every shaft turns: angle, speed ratio, acceleration."),
            mechanism="cardan.questions.mechanism.motion_answer",
            place=Place(order=-1),
            examples=(
                "cardan motion truck.toml --speed-rpm 3000",
                "cardan motion truck.toml --csv > turn.csv",
                "cardan motion truck.toml --plot motion.svg",
                "cardan motion slider.toml --table",
            ),
        ),
        Question(
            name="classical",
            module="cardan.book.answer",
            title=mark("Classical approximations"),
            group=MOTION,
            help=mark("How near the series of the handbooks and the rule of practice come to the exact motion."),
            place=ASIDE,
            command="calc book_comparison",
            without={"pose": DRAWN, "movement": DRAWN, "case": GEOMETRY, "error": MINUTES},
        ),
        Question(
            name="articulation",
            module="cardan.questions.motion.articulation_answer",
            title=mark("Articulation"),
            group=MOTION,
            help=mark("What happens while the drive moves: worst positions, spline travel."),
            quick=False,
            gathered=("movement",),
            without={"error": MINUTES},
            examples=(
                "cardan articulation tractor.toml",
                "cardan articulation tractor.toml --csv > history.csv",
            ),
        ),
        Question(
            name="phasing",
            module="cardan.questions.phases.answer",
            title=mark("Phasing of the yokes"),
            group=PHASING,
            help=mark("Which yoke angles make the output uniform, or how uniform it can be."),
            place=Place(order=-1),
            gathered=("pose",),
            without={"movement": TURNS, "case": YOKES},
            examples=(
                "cardan phasing truck.toml --fix 2=90",
                "cardan phasing truck.toml --apply A -o better.toml",
                "cardan phasing boxed.toml --layout -o better.toml",
            ),
            aliases=("phases",),
        ),
        Question(
            name="accuracy",
            module="cardan.questions.accuracy.answer",
            title=mark("Accuracy"),
            group=ACCURACY,
            help=mark(
                "What errors and tolerances of the joints do to the output, and the cheapest tolerances for a target."
            ),
            gathered=("error",),
            without={"case": GEOMETRY},
            examples=(
                "cardan accuracy instrument.toml --method worst",
                "cardan accuracy instrument.toml --allocate 2arcmin -o better.toml",
            ),
            aliases=("tolerance",),
        ),
        Question(
            name="forces",
            module="cardan.questions.forces.answer",
            title=mark("Forces"),
            group=FORCES,
            help=mark("Torque, bending and bearing loads of every shaft over a turn."),
            gathered=("error",),
            mechanism="cardan.questions.mechanism.forces_answer",
            examples=(
                "cardan forces truck.toml",
                "cardan forces truck.toml --torque-Nm 2000 --csv > turn.csv",
                "cardan forces tractor.toml --movement all",
                "cardan forces truck.toml --plot forces.svg",
                "cardan forces slider.toml --speed-rpm 1500",
            ),
        ),
        Question(
            name="losses",
            module="cardan.questions.losses.answer",
            title=mark("Power loss"),
            group=LOSSES,
            help=mark("How much of the power is lost, and where."),
            gathers="mean",
            gathered=("pose", "movement", "case"),
            without={"error": MINUTES},
            examples=(
                "cardan losses truck.toml",
                "cardan losses truck.toml --map --csv > map.csv",
            ),
        ),
        Question(
            name="torsion",
            module="cardan.questions.torsion.answer",
            title=mark("Torsional vibration"),
            group=TORSION,
            help=mark("Natural frequencies, and the speeds at which something excites them."),
            quick=False,
            command="torsion modes",
            without={"error": MINUTES},
            examples=(
                "cardan torsion modes truck.toml",
                "cardan torsion modes truck.toml --plot campbell.svg",
            ),
        ),
        Question(
            name="orders",
            module="cardan.questions.torsion.steady.answer",
            title=mark("Orders over speed"),
            group=TORSION,
            help=mark("How the shafts vibrate in torsion at a speed or over many."),
            quick=False,
            loaded=True,
            takes=("progress",),
            command="torsion response",
            without={"error": MINUTES},
            examples=(
                "cardan torsion response truck.toml",
                "cardan torsion response truck.toml --speeds 500:3000:200 --csv > sweep.csv",
            ),
        ),
        Question(
            name="stability",
            module="cardan.questions.torsion.stability.answer",
            title=mark("Parametric stability"),
            group=TORSION,
            help=mark("Whether torsional vibration decays, at a speed or over a map."),
            quick=False,
            loaded=True,
            takes=("progress",),
            command="torsion stability",
            without={"movement": ANGLES, "error": MINUTES},
            examples=(
                "cardan torsion stability truck.toml",
                "cardan torsion stability truck.toml --speeds 500:3000 --joint-angles 2:25 --plot map.svg",
            ),
        ),
        Question(
            name="road",
            module="cardan.checks.torsion.road",
            title=mark("Torsion along the movement"),
            group=TORSION,
            help=mark("How a drive vibrates in torsion while it moves: resonance, growth, reversals, damage."),
            quick=False,
            loaded=True,
            takes=("progress",),
            command="torsion road",
            gathered=("movement",),
            without={"error": MINUTES},
            examples=(
                "cardan torsion road truck.toml",
                "cardan torsion road truck.toml --plot road.svg",
            ),
        ),
        Question(
            name="mathieu",
            module="cardan.book.mathieu_answer",
            title=mark("Mathieu's equation"),
            group=TORSION,
            help=mark("Where the modes stand in the chart of Mathieu's equation, and the book's method for sizing."),
            quick=False,
            place=NOWHERE,
            command="torsion mathieu",
            without={"error": MINUTES},
            examples=("cardan torsion mathieu truck.toml --plot chart.svg",),
        ),
        Question(
            name="run-up",
            module="cardan.questions.torsion.transient.run_up_answer",
            title=mark("Run-up"),
            group=TORSION,
            help=mark("Torques and speeds in time: load steps, histories, run-up."),
            quick=False,
            takes=("progress",),
            command="torsion simulate",
            without={"pose": RUNS, "movement": RUNS, "case": DESIGNED, "error": MINUTES},
            examples=(
                "cardan torsion simulate truck.toml",
                "cardan torsion simulate truck.toml --settled --span-s 2",
            ),
        ),
        Question(
            name="absorber",
            module="cardan.questions.torsion.absorber.answer",
            title=mark("Absorber"),
            group=TORSION,
            help=mark("Which absorber, damper or pendulum reduces torsional vibration, where, and how it is set."),
            quick=False,
            place=NOWHERE,
            takes=("progress",),
            command="torsion absorber",
            without={"pose": DESIGNED, "movement": DESIGNED, "case": DESIGNED, "error": MINUTES},
            examples=(
                "cardan torsion absorber truck.toml --speeds 300:900",
                "cardan torsion absorber truck.toml --kind pendulum --radius-mm 120 -o better.toml",
            ),
            panel=MEASURES,
        ),
        Question(
            name="optimise",
            module="cardan.choices.torsion_design",
            title=mark("Torsional optimisation"),
            group=TORSION,
            help=mark("Which yoke angles, stiffnesses, inertias or joint positions make torsional vibration least."),
            quick=False,
            place=NOWHERE,
            takes=("known", "progress"),
            command="torsion optimise",
            gathered=("pose", "movement", "error"),  # by the limits of the file
            without={"case": DESIGNED},
            examples=(
                "cardan torsion optimise truck.toml --speeds 300:900",
                "cardan torsion optimise truck.toml --free shafts[1].stiffness_Nm_per_rad=2e4:2e5 -o better.toml",
            ),
            aliases=("calm",),
            panel=MEASURES,
        ),
        Question(
            name="bending",
            module="cardan.questions.bending.answer",
            title=mark("Bending critical speeds"),
            group=BENDING,
            help=mark("At which speeds the shafts whirl, and how far the drive stays away."),
            quick=False,
            gathered=("case",),
            without={"error": MINUTES},
            examples=(
                "cardan bending truck.toml",
                "cardan bending truck.toml --map",
                "cardan bending truck.toml --plot shapes.svg",
            ),
        ),
        Question(
            name="rotor",
            module="cardan.questions.bending.rotor_answer",
            title=mark("Whirl of a shaft"),
            group=BENDING,
            help=mark("How a shaft whirls with its unbalance and a crack: orders, orbits, run-up."),
            quick=False,
            takes=("progress",),
            without={"pose": WHIRLS, "movement": WHIRLS, "error": MINUTES},
            place=Place(beside="line"),
            examples=(
                "cardan rotor truck.toml",
                "cardan rotor truck.toml --shaft 3 --plot orbits.svg",
                "cardan rotor truck.toml --joint 2 --speed-rpm 1500",
            ),
        ),
        Question(
            name="line",
            module="cardan.questions.bending.line_answer",
            title=mark("Whirl of the whole line"),
            group=BENDING,
            help=mark("How far the whole line whirls over the speed: unbalances, joint couples, weight, its supports."),
            quick=False,
            takes=("progress",),
            command="rotor --line",
            without={"error": MINUTES},
            examples=(
                "cardan rotor truck.toml --line",
                "cardan rotor truck.toml --line --run-up --plot run.svg",
            ),
        ),
        Question(
            name="balance",
            module="cardan.questions.bending.balance_answer",
            title=mark("Balance"),
            group=BENDING,
            help=mark("What unbalance each shaft may have, and the masses that cancel what it has."),
            gathered=("case",),
            without={"error": MINUTES},
            examples=("cardan balance truck.toml --grade G16",),
        ),
        Question(
            name="life",
            module="cardan.questions.life.answer",
            title=mark("Life"),
            group=LIFE,
            help=mark("How long joints and bearings of supports last, steadily or in a duty cycle."),
            gathers="sum",
            gathered=("pose", "movement", "case"),
            without={"error": MINUTES},
            examples=(
                "cardan life truck.toml",
                "cardan life truck.toml --torque-Nm 900 --plot life.svg",
            ),
        ),
        Question(
            name="strength",
            module="cardan.checks.strength.answer",
            title=mark("Strength"),
            group=STRENGTH,
            help=mark("How strong every part is, the torque rating of the drive, and how large a part must be."),
            takes=("known",),
            gathers="worst",
            gathered=("pose", "movement", "case"),
            without={"error": MINUTES},
            examples=(
                "cardan strength truck.toml",
                "cardan strength truck.toml --size tube:2 --plot tubes.svg",
                "cardan strength truck.toml --size joint -o better.toml",
            ),
        ),
        Question(
            name="check",
            module="cardan.choices.check_answer",
            title=mark("Checks"),
            group=CHECKS,
            help=mark("Whether the drive keeps its limits, and which changes help where it does not."),
            place=Place(order=1),
            takes=("known",),
            gathers="worst",
            quick=False,
            gathered=("pose", "movement", "case", "error"),
            examples=(
                "cardan check truck.toml",
                "cardan check truck.toml --only tube_strength --json",
                "cardan check --list",
            ),
        ),
        Question(
            name="mobility",
            module="cardan.questions.mobility.answer",
            title=mark("Mobility"),
            group=SUPPORTS,
            help=mark("Whether a drive or mechanism turns, its redundant constraints, and what to release."),
            without={"case": GEOMETRY, "error": MINUTES},
            mechanism="cardan.questions.mobility.answer",
            place=Place(calm=True),
            examples=(
                "cardan mobility pump.toml",
                "cardan mobility slider.toml --turn --plot slider.svg",
            ),
        ),
        Question(
            name="layouts",
            module="cardan.choices.bearing_layouts_answer",
            title=mark("Statically determinate layouts"),
            group=SUPPORTS,
            help=mark("Which bearings, splines and joints make a drive statically determinate, best first."),
            quick=False,
            place=NOWHERE,
            takes=("other_joints",),
            command="mobility --layouts",
            without={"pose": HELD, "movement": HELD, "case": HELD, "error": MINUTES},
            examples=(
                "cardan mobility truck.toml --layouts",
                "cardan mobility truck.toml --layouts --apply 1 -o better.toml",
            ),
        ),
        Question(
            name="assembly",
            module="cardan.questions.forces.assembly_answer",
            title=mark("Assembly"),
            group=SUPPORTS,
            help=mark("What misalignment loads: support forces of parts that do not fit, and what to release."),
            gathered=("error",),
            without={"case": GEOMETRY},
            place=Place(calm=True),
            examples=(
                "cardan assembly pump.toml",
                "cardan assembly pump.toml --csv > turn.csv",
            ),
        ),
        Question(
            name="selection",
            module="cardan.choices.selection_answer",
            title=mark("Selection of joints"),
            group=CHOICE,
            help=mark("Which types and sizes of joints do a job, and why not the others."),
            takes=("known", "joint"),
            command="select",
            place=NOWHERE,
            gathered=("pose", "movement", "case"),
            without={"error": CHOSEN},
            examples=(
                "cardan select truck.toml",
                "cardan select --torque-Nm 2500 --joint-angle-deg 12 --speed-rpm 900 --synchronous",
                "cardan select truck.toml --catalogue my-maker.toml",
            ),
        ),
    )
}
"""Every question by its name, in the order in which one asks them."""


def groups() -> dict[str, tuple[str, ...]]:
    """Return the tabs, by their headings marked for translation, with the names of the questions on each."""
    found: dict[str, tuple[str, ...]] = {}
    for question in QUESTIONS.values():
        found[question.group] = (*found.get(question.group, ()), question.name)
    return found
