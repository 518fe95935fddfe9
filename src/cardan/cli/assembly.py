"""``cardan assembly``: do parts that do not fit strain the drive?"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cardan.texts import _, plural

from .asked import CurveAngle, CurveStep
from .options import AsCsv, AsJson, DriveFile, Plot

if TYPE_CHECKING:
    from cardan.drive.drive import Drive
    from cardan.questions.forces.assembly import AssemblyForces, Peak

    from .answer import Answer, Cell, Remark, Table

SMALL = 1e-6
"""Forces below this [N] are nothing but rounding."""


def assembly(
    file: DriveFile,
    angle: CurveAngle = None,
    step: CurveStep = None,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell whether parts that do not fit strain the drive."""
    from .asked import keys_of
    from .motion import check_positions, positions
    from .show import check_common, show

    check_common(json=json, csv=csv, plot=plot)
    check_positions(angle, step)

    from cardan.questions.forces.assembly import assembly as question

    from .source import read

    drive = read(file)
    with keys_of(file):
        found = question(drive)
    curves = question(drive, angle=positions(angle, step or 1.0)) if angle or step else found
    return show(_answer(drive, file, found, curves), json=json, csv=csv, plot=plot)


def _answer(drive: Drive, file: Path, found: AssemblyForces, curves: AssemblyForces) -> Answer:
    from .answer import Answer

    def drawn() -> Any:
        from cardan.questions.forces.figures.assembly import assembly_figures

        return assembly_figures(found, [one.name for one in drive.supports])

    return Answer(
        sentence=_sentence(drive, file, found),
        tone="warning" if found.degree else "good",
        tables=lambda: (_support_table(drive, found), _joint_table(drive, found)) if found.degree else (),
        remarks=tuple(_remarks(drive, file, found)),
        content=lambda: _content(drive, file, found, curves),
        csv=lambda: _trace(curves),
        figure=drawn,
    )


def _sentence(drive: Drive, file: Path, found: AssemblyForces) -> str:
    from cardan.figures.wording import together
    from cardan.maths.ties import largest

    from .answer import significant
    from .asked import called
    from .source import title

    name = title(drive, file)
    if not found.degree:
        return _("{name}: held just enough; it does not bind, however far its parts are off.").format(name=name)
    many = plural("{n} force", "{n} forces", found.degree).format(n=found.degree)
    pressed = [
        max(pair)
        for pair in zip(*([one.value for one in row] for row in (found.radial_peak, found.axial_peak)), strict=True)
    ]
    places = largest(pressed)
    size = pressed[places[0]]
    if not size > SMALL:
        text = _("{name}: held by {many} too many; as drawn all parts fit and nothing binds.")
        return text.format(name=name, many=many)
    text = _("{name}: held by {many} too many; misfit presses support {support} with up to {size} N.")
    if len(places) > 1:
        text = _("{name}: held by {many} too many; misfit presses supports {support} with up to {size} N each.")
    where = together(called(k + 1, drive.supports[k].name) for k in places)
    return text.format(name=name, many=many, support=where, size=significant(size))


def _support_table(drive: Drive, found: AssemblyForces) -> Table:
    from .answer import Column, Table, named

    tilted = any(one.tilt for one in drive.supports)
    rows = []
    for k, support in enumerate(drive.supports):
        row: list[Cell] = [
            named(k + 1, support.name),
            support.shaft,
            *(_shown(found.radial_peak[k]) if support.radial else (None, None)),
            *(_shown(found.axial_peak[k]) if support.axial else (None, None)),
        ]
        if tilted:
            row += _shown(found.couple_peak[k]) if support.tilt else (None, None)
        rows.append([*row, _holds(found.spare, k)])
    columns = [
        Column(key="support", heading=_("support"), left=True),
        Column(key="shaft", heading=_("shaft")),
        Column(key="radial_max_N", heading=_("radial"), unit=_("max N")),
        Column(key="radial_max_at_deg", unit=_("at °"), form=".1f"),
        Column(key="axial_max_N", heading=_("axial"), unit=_("max N")),
        Column(key="axial_max_at_deg", unit=_("at °"), form=".1f"),
    ]
    if tilted:
        columns += [
            Column(key="couple_max_Nm", heading=_("couple"), unit=_("max N·m")),
            Column(key="couple_max_at_deg", unit=_("at °"), form=".1f"),
        ]
    columns.append(Column(key="let_go", heading=_("let go"), left=True))
    return Table(columns=tuple(columns), rows=rows)


def _shown(peak: Peak) -> tuple[float, float | None]:
    from .asked import degrees

    return (peak.value, degrees(peak.angle)) if peak.value > SMALL else (0.0, None)


def _holds(keys: Sequence[str], support: int) -> str:
    """Return what of a support is among keys."""
    words = {"radial": _("radial"), "axial": _("axial"), "tilt": _("tilt")}
    start = f"supports[{support}]."
    return ", ".join(words[key.removeprefix(start)] for key in keys if key.startswith(start))


def _joint_table(drive: Drive, found: AssemblyForces) -> Table:
    from .answer import Column, Table, named
    from .asked import size

    gap = size(found.gap).max(axis=-1) / 1e-6
    rows = [
        (named(i, joint.name), *_shown(peak), float(gap[i - 1]) if gap[i - 1] > SMALL else 0.0)
        for i, (joint, peak) in enumerate(zip(drive.joints, found.joint_peak, strict=True), 1)
    ]
    columns = (
        Column(key="joint", heading=_("joint"), left=True),
        Column(key="force_max_N", heading=_("force"), unit=_("max N")),
        Column(key="force_max_at_deg", unit=_("at °"), form=".1f"),
        Column(key="gap_max_um", heading=_("own gap"), unit=_("max µm")),
    )
    return Table(columns=columns, rows=rows)


def _remarks(drive: Drive, file: Path, found: AssemblyForces) -> Iterator[Remark]:
    from .answer import Remark, significant
    from .asked import degrees, listed

    if found.degree:
        strained = found.energy_peak.value > 0.0
        if strained:
            text = _("These forces are there without any torque. The strain stores up to {energy} J")
            text = text.format(energy=significant(found.energy_peak.value, 3))
            if found.torque_peak.value > 1e-9 * found.energy_peak.value:
                text += _("; turning against it takes up to {torque} N·m, at {angle:.1f}°").format(
                    torque=significant(found.torque_peak.value, 3), angle=degrees(found.torque_peak.angle)
                )
            yield Remark(text=text + ".")
        else:
            text = _("Give offset_mm of supports or error of joints to see what misfit does.")
            yield Remark(text=text, tone="next")
        if found.rigid:
            text = plural(
                "Shaft {numbers} counts as rigid, as outer_mm is not given: real forces are smaller.",
                "Shafts {numbers} count as rigid, as outer_mm is not given: real forces are smaller.",
                len(found.rigid),
            )
            yield Remark(text=text.format(numbers=listed([number - 1 for number in found.rigid])))
        yield _let_go(drive, found)
    if drive.duty.torque:
        yield Remark(text=_("What the torque itself loads:"), command=("cardan", "forces", str(file)), tone="next")


def _let_go(drive: Drive, found: AssemblyForces) -> Remark:
    """Return what to let go, or that nothing can be."""
    from .answer import Remark

    keys = _(" and ").join(_changes(drive, found.spare))
    if not found.kept:
        return Remark(text=_("Nothing can bind with {keys}.").format(keys=keys), tone="next")
    if not found.spare:
        text = _(
            "No support can be let go without freeing a shaft; another joint, or parts that fit closer, would help."
        )
        return Remark(text=text)
    many = plural("{n} force", "{n} forces", found.kept).format(n=found.kept)
    text = _("With {keys} there are {many} too many still, and no other support can be let go without freeing a shaft.")
    return Remark(text=text.format(keys=keys, many=many), tone="next")


def _changes(drive: Drive, spare: Sequence[str]) -> Iterator[str]:
    """Yield what to write for holds to let go; a support that then holds nothing is taken away."""
    for k, support in enumerate(drive.supports):
        own = [hold for hold in ("radial", "axial", "tilt") if getattr(support, hold)]
        gone = [hold for hold in own if f"supports[{k}].{hold}" in spare]
        if gone and gone == own:
            yield _("{support} taken away").format(support=f"supports[{k}]")
        else:
            yield from (f"supports[{k}].{hold} = false" for hold in gone)


def _trace(found: AssemblyForces) -> Table:
    """Return everything at every position."""
    import numpy as np

    from .answer import Column, Table

    named: list[tuple[str, Any]] = [("angle_deg", np.rad2deg(found.angle))]

    def vector(key: str, table: Any, unit: str, scale: float = 1.0) -> None:
        named.extend((f"{key}_{way}_{unit}", table[:, k] / scale) for k, way in enumerate("xyz"))

    for k in range(len(found.reaction)):
        named.append((f"support_{k + 1}_radial_N", found.radial[k]))
        named.append((f"support_{k + 1}_axial_N", found.axial[k]))
        vector(f"support_{k + 1}", found.reaction[k], "N")
        if found.couple[k].any():
            vector(f"support_{k + 1}_couple", found.couple[k], "Nm")
    for i, force in enumerate(found.joint_force):
        vector(f"joint_{i + 1}_force", force, "N")
        vector(f"joint_{i + 1}_gap", found.gap[i], "um", 1e-6)
    named += [("energy_J", found.energy), ("torque_Nm", found.torque)]
    table = np.stack([values for _key, values in named], axis=-1)
    return Table(columns=tuple(Column(key=key) for key, _values in named), rows=table.tolist())


def _content(drive: Drive, file: Path, found: AssemblyForces, curves: AssemblyForces) -> dict[str, Any]:
    from .asked import columns_of
    from .show import records

    supports = records(_support_table(drive, found), [(k, one.name) for k, one in enumerate(drive.supports, 1)])
    for k, row in enumerate(supports):
        row["let_go"] = _holds(found.spare, k) or None
        row["strained"] = _holds(found.strained, k) or None
    return {
        "question": "assembly",
        "drive": drive.name,
        "file": str(file),
        "degree": found.degree,
        "strained": found.strained,
        "let_go": found.spare,
        "degree_left": found.kept,
        "supports": supports,
        "joints": records(_joint_table(drive, found), [(i, one.name) for i, one in enumerate(drive.joints, 1)]),
        "energy_max_J": found.energy_peak.value,
        "torque_max_Nm": found.torque_peak.value,
        "rigid_shafts": found.rigid,
        "residual": found.residual,
        "forces": columns_of(_trace(curves)),
    }
