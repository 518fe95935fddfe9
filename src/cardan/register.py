"""The register of questions: what can be asked of a drive, once for commands, report, app, sweeps and Python.

Adding a question is one folder in `cardan.questions` and one entry here. Entries are light; the module of a question is
imported when it is asked, see `cardan.answers.question`.
"""

from __future__ import annotations

from cardan.answers.question import Question
from cardan.texts import mark

MOTION, PHASING, FORCES, LOSSES = mark("Motion"), mark("Phasing"), mark("Forces"), mark("Power loss")
ACCURACY, TORSION, BENDING, LIFE = mark("Accuracy"), mark("Torsion"), mark("Bending"), mark("Life")
STRENGTH, CHECKS, SUPPORTS, CHOICE = mark("Strength"), mark("Checks"), mark("Mobility"), mark("Selection")

QUESTIONS: dict[str, Question] = {
    question.name: question
    for question in (
        Question(
            name="motion",
            module="cardan.questions.motion.answer",
            title=mark("Motion"),
            group=MOTION,
            help=mark("How every shaft turns: angle, speed ratio, acceleration."),
        ),
        Question(
            name="classical",
            module="cardan.book.answer",
            title=mark("Classical approximations"),
            group=MOTION,
            help=mark("How near the series of the handbooks and the rule of practice come to the exact motion."),
            command="calc book_comparison",
        ),
        Question(
            name="articulation",
            module="cardan.questions.motion.articulation_answer",
            title=mark("Articulation"),
            group=MOTION,
            help=mark("What happens while the drive moves: worst positions, spline travel."),
            quick=False,
        ),
        Question(
            name="phasing",
            module="cardan.questions.phases.answer",
            title=mark("Phasing of the yokes"),
            group=PHASING,
            help=mark("Which yoke angles make the output uniform, or how uniform it can be."),
        ),
        Question(
            name="accuracy",
            module="cardan.questions.accuracy.answer",
            title=mark("Accuracy"),
            group=ACCURACY,
            help=mark(
                "What errors and tolerances of the joints do to the output, and the cheapest tolerances for a target."
            ),
        ),
        Question(
            name="forces",
            module="cardan.questions.forces.answer",
            title=mark("Forces"),
            group=FORCES,
            help=mark("What every shaft, joint and bearing carries over a turn."),
        ),
        Question(
            name="losses",
            module="cardan.questions.losses.answer",
            title=mark("Power loss"),
            group=LOSSES,
            help=mark("How much of the power is lost, and where."),
        ),
        Question(
            name="torsion",
            module="cardan.questions.torsion.answer",
            title=mark("Torsional vibration"),
            group=TORSION,
            help=mark("Natural frequencies, what excites them, and alternating torque at the speed of the duty."),
            quick=False,
            command="torsion modes",
        ),
        Question(
            name="orders",
            module="cardan.questions.torsion.steady.answer",
            title=mark("Orders over speed"),
            group=TORSION,
            help=mark("Alternating torque over the speeds in use, order by order."),
            quick=False,
            takes=("progress",),
            command="torsion response",
        ),
        Question(
            name="stability",
            module="cardan.questions.torsion.stability.answer",
            title=mark("Parametric stability"),
            group=TORSION,
            help=mark("Where torsional vibration is stable, over speed and joint angle."),
            quick=False,
            takes=("progress",),
            command="torsion stability",
        ),
        Question(
            name="run-up",
            module="cardan.questions.torsion.transient.run_up_answer",
            title=mark("Run-up"),
            group=TORSION,
            help=mark("Torques in time while the drive runs up."),
            quick=False,
            takes=("progress",),
            command="torsion simulate",
        ),
        Question(
            name="absorber",
            module="cardan.questions.torsion.absorber.answer",
            title=mark("Absorber"),
            group=TORSION,
            help=mark("Which absorber or damper reduces torsional vibration, where, and how it is to be set."),
            quick=False,
            report=False,
            takes=("progress",),
            command="torsion absorber",
        ),
        Question(
            name="optimise",
            module="cardan.questions.torsion.calm.answer",
            title=mark("Torsional optimisation"),
            group=TORSION,
            help=mark("Which yoke angles make torsional vibration least over the speeds in use."),
            quick=False,
            report=False,
            takes=("progress",),
            command="torsion optimise",
        ),
        Question(
            name="bending",
            module="cardan.questions.bending.answer",
            title=mark("Bending critical speeds"),
            group=BENDING,
            help=mark("At which speeds the shafts whirl, and how far the drive stays away."),
            quick=False,
        ),
        Question(
            name="rotor",
            module="cardan.questions.bending.rotor_answer",
            title=mark("Whirl of a shaft"),
            group=BENDING,
            help=mark("How a shaft whirls with its unbalance and a crack: orders, orbits, run-up."),
            quick=False,
            takes=("progress",),
        ),
        Question(
            name="balance",
            module="cardan.questions.bending.balance_answer",
            title=mark("Balance"),
            group=BENDING,
            help=mark("What unbalance each shaft may have, and the masses that cancel what it has."),
        ),
        Question(
            name="life",
            module="cardan.questions.life.answer",
            title=mark("Life"),
            group=LIFE,
            help=mark("How long the joints last, steadily or in a duty cycle."),
            gathers="sum",
        ),
        Question(
            name="strength",
            module="cardan.checks.strength.answer",
            title=mark("Strength"),
            group=STRENGTH,
            help=mark("How strong every part is, and the torque rating of the drive."),
            takes=("known",),
            gathers="worst",
        ),
        Question(
            name="check",
            module="cardan.choices.check_answer",
            title=mark("Checks"),
            group=CHECKS,
            help=mark("Whether the drive keeps its limits, and which changes help where it does not."),
            takes=("known",),
            gathers="worst",
            quick=False,
        ),
        Question(
            name="mobility",
            module="cardan.questions.mobility.answer",
            title=mark("Mobility"),
            group=SUPPORTS,
            help=mark("Whether a drive or mechanism turns, its redundant constraints, and what to release."),
        ),
        Question(
            name="assembly",
            module="cardan.questions.forces.assembly_answer",
            title=mark("Assembly"),
            group=SUPPORTS,
            help=mark("What misalignment loads: support forces of parts that do not fit, and what to release."),
        ),
        Question(
            name="selection",
            module="cardan.choices.selection_answer",
            title=mark("Selection of joints"),
            group=CHOICE,
            help=mark("Which types and sizes of joints do a job, and why not the others."),
            takes=("known", "joint"),
            command="select",
            report=False,
        ),
    )
}
"""Every question by its name, in the order in which one asks them."""


def groups() -> dict[str, tuple[str, ...]]:
    """Return the tabs, by their headings marked for translation, with the names of the questions on each.

    Examples
    --------
    >>> groups()["Bending"]
    ('bending', 'rotor', 'balance')
    """
    found: dict[str, tuple[str, ...]] = {}
    for question in QUESTIONS.values():
        found[question.group] = (*found.get(question.group, ()), question.name)
    return found
