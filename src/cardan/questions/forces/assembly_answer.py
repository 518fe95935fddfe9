"""What there is to say of assembly: what misalignment loads where a drive is overconstrained, and what to release."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from cardan.answers.answer import FILE, Answer, Column, KeyFigure, Remark, Table, closely
from cardan.answers.quantity import Joined, Quantity, Say, Written, listed, say
from cardan.answers.question import Lacking, absent
from cardan.answers.sweepable import OutputColumn, SweepQuestion
from cardan.drive.drive import Drive
from cardan.drive.fields.wording import key_text
from cardan.drive.models.machine_held import machine_held, machines_of
from cardan.errors import InputError
from cardan.figures.figure import Figure
from cardan.later import later
from cardan.maths.ties import foremost, largest
from cardan.questions.assumed import centred_by_housings, held_by_machines
from cardan.questions.motion.kinds import made_true
from cardan.texts import _, mark, plural

from .assembly import AssemblyForces, Peak, assembly
from .force_tables import (
    ROUNDING,
    curve,
    from_start,
    joint_heads,
    size,
    support_heads,
    support_names,
    together,
    vector,
)

drawn = later("cardan.questions.forces.figures.assembly")

__all__ = ["COLUMNS", "answer", "ask", "lacking", "otherwise"]

SMALL = 1e-6
"""Forces below this [N] are nothing but rounding."""

CLOSED = 1e-12
"""Gaps below this [m] are nothing but rounding."""

EVEN_WORK = 1e-6
"""Share of the largest torque that its mean over a turn may keep: the curve is a sum of low orders, well sampled."""

HOLDS = ("radial", "axial", "tilt")
"""What a support may hold."""


def lacking(drive: Drive) -> Lacking:
    """Return what the drive file lacks for the forces of assembly."""
    some = any(any(one.offset) or one.stiffness or one.axial_stiffness for one in drive.supports)
    return absent((some, "supports[0].offset", "supports[0].stiffness", "supports[0].axial_stiffness"))


def ask(drive: Drive) -> AssemblyForces | None:
    """Return the forces of assembly; None where a stiffness is there for other questions alone.

    Raises InputError: what they lack, where the file tells a misalignment.
    """
    try:
        return assembly(drive)
    except InputError:
        if any(any(one.offset) for one in drive.supports):
            raise
        return None  # a stiffness may be there for the bending of the shafts, in a file that leaves bearings out


def otherwise(drive: Drive) -> str:
    """Return why nothing can be told although nothing is missing."""
    return _("The bearings that have a stiffness do not hold the whole drive; forces of assembly cannot be told.")


def answer(drive: Drive, result: AssemblyForces, curves: AssemblyForces | None = None) -> Answer:
    """Return what there is to say of the forces of assembly. curves: at the positions whose curves are asked for."""
    shown = result if curves is None else curves
    machines, drive = machines_of(drive), machine_held(drive)
    return Answer(
        name="assembly",
        title=_("Assembly"),
        sentence=_sentence(drive, result),
        tone="warning" if result.degree else "good",
        figures=lambda: _figures(drive, result),
        tables=tuple(_tables(drive, result)),
        remarks=(*held_by_machines(machines), *made_true(drive), *_remarks(drive, result)),
        keys=tuple(_keys(result)),
        facts=_facts(result),
        full=lambda: _trace(shown),
    )


def _figures(drive: Drive, result: AssemblyForces) -> tuple[Figure, ...]:
    return drawn().misalignment_figures(result, support_names(drive)) if _top(result) > SMALL else ()


def _top(result: AssemblyForces) -> float:
    return max(one.value for one in (*result.radial_peak, *result.axial_peak, *result.joint_peak))


def _sentence(drive: Drive, result: AssemblyForces) -> Say | str:
    if not result.degree:
        return _("statically determinate: no misalignment can load it.")
    loads = [max(pair) for pair in zip(_values(result.radial_peak), _values(result.axial_peak), strict=True)]
    places = largest(loads)
    most = loads[places[0]]
    if not most > SMALL:
        text = _("statically indeterminate, degree {degree}; as drawn all parts fit, and nothing is loaded.")
        return say(text, degree=result.degree)
    text = _("statically indeterminate, degree {degree}; misalignment loads support {which} with up to {most}.")
    if len(places) > 1:
        text = _(
            "statically indeterminate, degree {degree}; misalignment loads supports {which} with up to {most} each."
        )
    which = together(support_names(drive), places)
    return say(text, degree=result.degree, which=which, most=Quantity(most, "force"))


def _values(peaks: Sequence[Peak]) -> list[float]:
    return [one.value for one in peaks]


def _tables(drive: Drive, result: AssemblyForces) -> Iterator[Table]:
    loaded = bool(result.degree)
    yield _supports(drive, result, loaded=loaded)
    yield _joints(drive, result, loaded=loaded)


def _peaks(key: str, heading: str, dimension: str, peaks: Sequence[Peak | None]) -> tuple[Column, Column]:
    """Return the columns of a largest value and of where it occurs; of what is rounding nothing is told."""
    values = [None if one is None else one.value if one.value > SMALL else 0.0 for one in peaks]
    places = [None if one is None or one.value <= SMALL else from_start(one.angle) for one in peaks]
    return (
        Column(key=f"{key}_max", heading=heading, values=values, dimension=dimension),
        Column(key=f"{key}_max_at", heading=_("at"), values=places, dimension="angle", decimals=1),
    )


def _supports(drive: Drive, result: AssemblyForces, *, loaded: bool) -> Table:
    def where(hold: str, peaks: Sequence[Peak]) -> list[Peak | None]:
        return [one if getattr(support, hold) else None for one, support in zip(peaks, drive.supports, strict=True)]

    tilted = any(one.tilt for one in drive.supports)
    words = {"radial": _("radial"), "axial": _("axial"), "tilt": _("tilt")}
    holds = [_holds(result.spare, k) for k in range(len(drive.supports))]
    strained = [_holds(result.strained, k) for k in range(len(drive.supports))]
    return Table(
        name="supports",
        title=_("Largest forces over a turn, without load"),
        records=True,
        depth="brief" if loaded else "data",
        columns=(
            *support_heads(drive),
            *_peaks("radial", _("radial"), "force", where("radial", result.radial_peak)),
            *_peaks("axial", _("axial"), "force", where("axial", result.axial_peak)),
            *(_peaks("couple", _("couple"), "torque", where("tilt", result.couple_peak)) if tilted else ()),
            Column(key="", heading=_("release"), values=[", ".join(words[one] for one in row) for row in holds]),
            Column(key="release", values=[", ".join(row) or None for row in holds], depth="data"),
            Column(key="strained", values=[", ".join(row) or None for row in strained], depth="data"),
        ),
    )


def _holds(keys: Sequence[str], support: int) -> list[str]:
    """Return what of a support is among keys."""
    return [hold for hold in HOLDS if f"supports[{support}].{hold}" in keys]


def _joints(drive: Drive, result: AssemblyForces, *, loaded: bool) -> Table:
    gap = np.max(size(result.gap), axis=-1)
    return Table(
        name="joints",
        records=True,
        depth="brief" if loaded else "data",
        columns=(
            *joint_heads(drive),
            *_peaks("force", _("force"), "force", result.joint_peak),
            Column(
                key="gap_max", heading=_("own gap"), values=np.where(gap > CLOSED, gap, 0.0), dimension="displacement"
            ),
        ),
    )


def _remarks(drive: Drive, result: AssemblyForces) -> Iterator[Remark]:
    if result.degree:
        yield _strain(result)
        yield from centred_by_housings(drive)
        if result.rigid:
            text = plural(
                "Shaft {numbers} counts as rigid, as {key} is not given: real forces are smaller.",
                "Shafts {numbers} count as rigid, as {key} is not given: real forces are smaller.",
                len(result.rigid),
            )
            yield Remark(text=say(text, numbers=listed(result.rigid), key=Written("outer_mm", _("the outer diameter"))))
        yield _release(drive, result)
        yield from _checked(result)
    if drive.duty.torque:
        text = _("What the torque itself loads:")
        yield Remark(text=text, command=("cardan", "forces", FILE), tone="next")


def _strain(result: AssemblyForces) -> Remark:
    """Return what the strain stores, and what turning against it takes."""
    if not result.energy_peak.value > 0.0:
        return Remark(
            text=_("Give offset_mm of supports or error of joints to see what misalignment does."), tone="next"
        )
    text = _("Misalignment strains the drive without any torque; the strain stores up to {energy}.")
    if result.torque_peak.value > ROUNDING * result.energy_peak.value:
        text = _(
            "Misalignment strains the drive without any torque; the strain stores up to {energy}, and turning against "
            "it takes up to {torque}, at {angle}."
        )
    said = say(
        text,
        energy=Quantity(result.energy_peak.value, "work", 3),
        torque=Quantity(result.torque_peak.value, "torque", 3),
        angle=Quantity(from_start(result.torque_peak.angle), "angle", decimals=1),
    )
    return Remark(text=said, tone="warning", alarm=_top(result) > SMALL)


def _release(drive: Drive, result: AssemblyForces) -> Remark:
    """Return what to release, or that nothing can be."""
    keys = Joined(list(_changes(drive, result.spare)), last=_(" and "))
    if not result.kept:
        return Remark(text=say(_("Statically determinate with {keys}."), keys=keys))
    if not result.spare:
        text = _(
            "No support can be released without freeing a shaft; another joint, or parts that fit closer, would help."
        )
        return Remark(text=text)
    text = _("With {keys} degree {kept} is left, and no other support can be released without freeing a shaft.")
    return Remark(text=say(text, keys=keys, kept=result.kept))


def _changes(drive: Drive, spare: Sequence[str]) -> Iterator[Written]:
    """Yield what to write for holds to release; a support that then holds nothing is omitted."""
    words = {
        "radial": _("support {number} free across"),
        "axial": _("support {number} free along its axis"),
        "tilt": _("support {number} free to tilt"),
    }
    omitted = _("{support} omitted")
    for k, support in enumerate(drive.supports):
        own = [hold for hold in HOLDS if getattr(support, hold)]
        gone = [hold for hold in own if f"supports[{k}].{hold}" in spare]
        if gone and gone == own:
            name = omitted.format(support=_("support {number}").format(number=k + 1))
            yield key_text(f"supports[{k}]", name, omitted.format(support="{key}"))
        else:
            yield from (
                key_text(f"supports[{k}].{hold}", words[hold].format(number=k + 1), "{key} = false") for hold in gone
            )


def _checked(result: AssemblyForces) -> Iterator[Remark]:
    """Yield how closely the balances hold, where there are forces."""
    if not _top(result) > SMALL:
        return
    good = result.residual <= ROUNDING
    text = _("Balances checked: forces and moments on every shaft and on the whole drive close {closely}.")
    yield Remark(text=say(text, closely=closely(result.residual)), tone="plain" if good else "failed", aside=good)
    turn, most = np.asarray(result.angle), result.torque_peak.value
    whole = turn.size > 2 and abs(float(turn[-1] - turn[0]) - 2.0 * np.pi) < 1e-9
    work = abs(float(np.mean(np.asarray(result.torque)[:-1])))
    if whole and work > EVEN_WORK * most:
        text = _("Failed: over a turn the torque against the stored energy does not come to zero work.")
        yield Remark(text=text, tone="failed")


def _keys(result: AssemblyForces) -> Iterator[KeyFigure]:
    if not _top(result) > SMALL:
        return
    joint = int(foremost(_values(result.joint_peak)))
    yield KeyFigure(
        name="misalignment_force",
        title=say(_("force of misalignment without load, joint {number}"), number=joint + 1),
        value=Quantity(result.joint_peak[joint].value, "force"),
        verdict=_("binds"),
        tone="warning",
    )


def _facts(result: AssemblyForces) -> dict[str, Any]:
    return {
        "degree": result.degree,
        "strained": result.strained,
        "release": result.spare,
        "degree_left": result.kept,
        "energy_max": Quantity(result.energy_peak.value, "work"),
        "torque_max": Quantity(result.torque_peak.value, "torque"),
        "rigid_shafts": result.rigid,
        "residual": result.residual,
    }


def _trace(result: AssemblyForces) -> Table:
    """Return everything at every position."""
    return Table(name="forces", columns=tuple(_columns(result)))


def _columns(result: AssemblyForces) -> Iterator[Column]:
    yield curve("angle", result.angle, "angle")
    for k in range(len(result.reaction)):
        yield curve(f"support_{k + 1}_radial", result.radial[k], "force")
        yield curve(f"support_{k + 1}_axial", result.axial[k], "force")
        yield from vector(f"support_{k + 1}", result.reaction[k], "force")
        if result.couple[k].any():
            yield from vector(f"support_{k + 1}_couple", result.couple[k], "torque")
    for i, force in enumerate(result.joint_force):
        yield from vector(f"joint_{i + 1}_force", force, "force")
        yield from vector(f"joint_{i + 1}_gap", result.gap[i], "displacement")
    yield curve("energy", result.energy, "work")
    yield curve("torque", result.torque, "torque")


def _column_values(found: AssemblyForces) -> tuple[float, float, float]:
    supports = (*found.radial_peak, *found.axial_peak)
    loads = [max((one.value for one in some), default=0.0) for some in (supports, found.joint_peak)]
    return (loads[0], loads[1], float(found.degree))


COLUMNS = (
    SweepQuestion(
        name="assembly",
        doc=mark("largest forces that misalignment makes over a turn, and the degree of static indeterminacy"),
        told=(
            OutputColumn.of("misalignment_support_N", mark("largest force of misalignment on a support")),
            OutputColumn.of("misalignment_joint_N", mark("largest force of misalignment in a joint")),
            OutputColumn(name="indeterminacy", text=mark("degree of static indeterminacy")),
        ),
        of_result=_column_values,
    ),
)
"""What a sweep may ask of assembly."""
