"""What there is to say of the classical approximations of a drive's motion: what each makes of its fluctuation."""

from __future__ import annotations

import numpy as np

from cardan.answers.answer import Answer, Cell, Column, Table
from cardan.answers.quantity import Quantity, say
from cardan.answers.question import Lacking
from cardan.drive.drive import Drive
from cardan.drive.models.kinematics_model import unlike_hooke
from cardan.later import later
from cardan.questions.motion.equivalence import SYNCHRONOUS, each_uniform
from cardan.texts import _

from .comparison import BookComparison, book_comparison

drawn = later("cardan.book.figure")

ALIKE = 5e-4
"""Share of the exact value below which an approximation agrees with it to three digits."""


def lacking(drive: Drive) -> Lacking:
    """Return what the drive file lacks: nothing."""
    return ()


def ask(drive: Drive) -> BookComparison | None:
    """Return the exact motion beside the classical approximations; None where there is nothing to compare."""
    if unlike_hooke(drive) or each_uniform(drive):
        return None
    return book_comparison(drive)


def otherwise(drive: Drive) -> str:
    """Return why there is nothing to compare."""
    if unlike_hooke(drive):
        return _("The classical series know no joints that turn by laws of their own, and no shafts that wobble.")
    return _("Every joint turns uniformly by itself: there is nothing to approximate.")


def _approximated(result: BookComparison) -> list[float]:
    """Return the speed fluctuation by the first order: with exact phases, with mean ones, without Θ."""
    told = (result.speed_fluctuation_80, result.speed_fluctuation_mean_phases, result.speed_fluctuation_without_theta)
    return [float(one) for one in told]


def differ(result: BookComparison) -> bool:
    """Tell whether an approximation says something else than the exact motion, in three digits."""
    exact = float(result.speed_fluctuation)
    return any(abs(one - exact) > ALIKE * exact for one in _approximated(result))


def answer(drive: Drive, result: BookComparison) -> Answer:
    """Return what there is to say of the classical approximations."""
    exact = float(result.speed_fluctuation)
    shares = [exact, *_approximated(result)]
    names = [_("exact"), _("series, first order"), _("series, mean phases"), _("series without Θ")]
    sources = [
        _("matrix product"),
        _("Kozhevnikov & Perfil'ev (1978), eq. 80, exact phase angles"),
        _("first order, start position left out"),
        _("as calculated in Kozhevnikov & Perfil'ev (1978), eq. 90"),
    ]
    errors = [None, *(_off(share - exact) for share in shares[1:])]
    joint_angle = 0.0 if exact < SYNCHRONOUS else float(result.joint_angle)
    return Answer(
        name="classical",
        title=_("Classical approximations"),
        sentence=say(
            _("The rule of practice √|Σ ±α²| gives an equivalent joint angle of {rule}, exact is {exact}."),
            rule=Quantity(float(result.rule_of_practice), "angle", decimals=3),
            exact=Quantity(joint_angle, "angle", decimals=3),
        ),
        figures=lambda: (drawn().book_figure(result),),
        tables=(
            Table(
                name="approximations",
                title=_("Speed fluctuation by the classical approximations"),
                records=True,
                columns=(
                    Column(key="method", heading=_("method"), values=names),
                    Column(key="source", heading=_("source"), values=sources),
                    Column(key="speed_fluctuation", heading="δ", values=np.asarray(shares), dimension="share"),
                    Column(key="error", heading=_("error"), values=errors, dimension="share", digits=3),
                ),
            ),
        ),
    )


def _off(difference: float) -> Cell | float:
    return Cell(value=difference, before="+") if difference > 0.0 else difference
