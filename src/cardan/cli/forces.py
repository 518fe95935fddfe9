"""``cardan forces``: what does every shaft, joint and bearing carry?"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from cardan.errors import refuse
from cardan.texts import _

from .asked import CurveAngle, CurveStep, TorqueNm
from .options import AsCsv, AsJson, DriveFile, Plot, SpeedRpm

if TYPE_CHECKING:
    from cardan.drive.drive import Drive
    from cardan.questions.forces.forces import Forces

    from .answer import Answer, Remark, Table

ORDERS = 7
"""Orders 0 to 6 of the input speed are in the JSON."""


def forces(
    file: DriveFile,
    angle: CurveAngle = None,
    step: CurveStep = None,
    torque: TorqueNm = None,
    speed_rpm: SpeedRpm = None,
    movement: Annotated[
        list[str] | None,
        typer.Option(
            "--movement",
            metavar="NAME",
            help=_("Movement of the file that runs meanwhile: its name or number, or all; may be repeated."),
            show_default=False,
        ),
    ] = None,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell what every shaft, joint and bearing carries over a turn."""
    from .asked import check_torque, keys_of, on_duty
    from .motion import check_positions, positions
    from .output import check_speed
    from .show import check_common, show

    check_common(json=json, csv=csv, plot=plot)
    check_positions(angle, step)
    check_speed(speed_rpm)
    check_torque(torque)
    if movement and (angle or step is not None):
        raise refuse("--movement", _("is followed in time; --angle-deg and --angle-step-deg are of a standing drive"))

    from .source import read

    drive = on_duty(read(file), speed_rpm, torque)
    if movement:
        from .moving_forces import answer as moving

        return show(moving(drive, file, movement), json=json, csv=csv, plot=plot)

    from cardan.questions.forces.forces import forces as question

    with keys_of(file):
        found = question(drive)
    curves = question(drive, angle=positions(angle, step or 1.0)) if angle or step else found
    return show(_answer(drive, file, found, curves), json=json, csv=csv, plot=plot)


def _answer(drive: Drive, file: Path, found: Forces, curves: Forces) -> Answer:
    from .answer import Answer
    from .force_tables import tables

    def drawn() -> Any:
        from cardan.questions.forces.figures.forces import forces_figures

        return forces_figures(found, drive)

    return Answer(
        sentence=_sentence(drive, file, found),
        tables=lambda: tables(drive, found),
        remarks=tuple(_remarks(drive, file, found)),
        content=lambda: _content(drive, file, found, curves),
        csv=lambda: _trace(curves),
        figure=drawn,
    )


def _sentence(drive: Drive, file: Path, found: Forces) -> str:
    from .answer import significant
    from .asked import called, turn
    from .source import title

    drives = turn(found.angle, found.input_torque)
    low, high = significant(float(drives.low)), significant(float(drives.high))
    span = low if low == high else _("{low} to {high}").format(low=low, high=high)
    name, given = title(drive, file), significant(drive.duty.torque or 0.0)
    if drive.duty.torque_at == "input":
        load = turn(found.angle, found.output_torque)
        low, high = significant(float(load.low)), significant(float(load.high))
        span = low if low == high else _("{low} to {high}").format(low=low, high=high)
        text = _("{name}: {given} N·m at the input meet {span} N·m at the output").format(
            name=name, given=given, span=span
        )
    else:
        text = _("{name}: {given} N·m at the output need {span} N·m at the input").format(
            name=name, given=given, span=span
        )
    if found.reaction is None:
        bent = turn(found.angle, found.bending_couple).high
        worst = int(bent.argmax())
        if not bent[worst] > 0.0:
            return text + _("; nothing bends the shafts.")
        more = _("; shaft {shaft} is bent most, by up to {size} N·m.")
        return text + more.format(shaft=worst + 1, size=significant(float(bent[worst])))
    total = _sizes(found)
    worst = int(total.argmax())
    if not total[worst] > 0.0:
        return text + _("; the bearings carry nothing.")
    more = _("; support {support} carries most, up to {size} N.")
    return text + more.format(
        support=called(worst + 1, drive.supports[worst].name), size=significant(float(total[worst]))
    )


def _sizes(found: Forces) -> Any:
    """Return the largest force on each support, array (k,) [N]."""
    import numpy as np

    from .asked import size, turn
    from .force_tables import both

    return np.max([turn(one.angle, size(one.reaction)).high for one in both(found)], axis=0)


def _remarks(drive: Drive, file: Path, found: Forces) -> Iterator[Remark]:
    import numpy as np

    from cardan.answers.quantity import told
    from cardan.answers.reader import USUAL
    from cardan.questions.forces.reactions import Held
    from cardan.questions.forces.solving_order import reaction_groups
    from cardan.questions.motion.kinds import steep_joints
    from cardan.texts import plural

    from .answer import Remark, significant

    yield from (Remark(text=told(one.text, USUAL), tone=one.tone) for one in steep_joints(drive))
    surplus = int(found.status == Held.INDETERMINATE) and found.unknowns - found.equations
    if surplus:
        held = plural("{n} force", "{n} forces", surplus).format(n=surplus)
        text = _("Warning: the bearings hold {held} too many, shared here by stiffness, misfit included.")
        yield Remark(text=text.format(held=held), tone="warning")
    if found.reaction is not None:
        yield Remark(text=_("Axial force is positive along the power flow; all forces act on the shaft."))
        yield from _by_hand(reaction_groups(drive))
    thrust = float(np.max(np.abs(found.spline_thrust), initial=0.0))
    if thrust > 0.0:
        text = _("Friction in the spline thrusts with up to {size} N").format(size=significant(thrust))
        text += _("; loads are the largest of sliding in and out.") if found.reverse is not None else "."
        yield Remark(text=text)
    yield from _without(drive, found)
    text = _("Balances checked: {power:.0e} of the power is left over")
    if found.force_left is not None and found.moment_left is not None:
        text += _(", {force:.0e} of the forces, {moment:.0e} of the moments")
        rest = {"force": float(found.force_left.max()), "moment": float(found.moment_left.max())}
    else:
        rest = {}
    yield Remark(text=text.format(power=float(found.power_left.max()), **rest) + ".")
    if surplus:
        yield Remark(
            text=_("What misfit does alone, and what to let go:"),
            command=("cardan", "assembly", str(file)),
            tone="next",
        )
    elif found.reaction is None:
        text = _("Add [[supports]] to {file} for the loads of bearings and journals.")
        yield Remark(text=text.format(file=file), tone="next")
    elif found.loss.any() and drive.duty.speed:
        yield Remark(text=_("Where the power goes:"), command=("cardan", "losses", str(file)), tone="next")


def _by_hand(groups: Sequence[Sequence[int]]) -> Iterator[Remark]:
    """Yield in which order the balances of the shafts can be solved, where they part."""
    from .answer import Remark

    if len(groups) > 1:
        order = _(", then ").join(_(" and ").join(map(str, group)) for group in groups)
        yield Remark(text=_("By hand the reactions follow from shaft {order}.").format(order=order))


def _without(drive: Drive, found: Forces) -> Iterator[Remark]:
    """Yield what was left out because the file does not say."""
    import numpy as np

    from cardan.texts import plural

    from .answer import Remark
    from .asked import listed
    from .force_tables import rubs

    crossed = [i for i, joint in enumerate(drive.joints) if "cross" not in joint.foreign]
    bare = [i for i in crossed if not np.isfinite(found.journals.size[i]).all()]
    if bare:
        text = plural(
            "Joint {numbers} gives no cross.span_mm: the loads of its journals are not known.",
            "Joints {numbers} give no cross.span_mm: the loads of their journals are not known.",
            len(bare),
        )
        yield Remark(text=text.format(numbers=listed(bare)))
    elif found.joint_force is None:
        yield Remark(
            text=_("Journals carry the couples alone here; supports would tell the forces between the shafts.")
        )
    loose = [
        i for i, joint in enumerate(drive.joints) if not rubs(joint) and (joint.friction or joint.material_friction)
    ]
    if loose:
        text = plural(
            "Warning: friction of joint {numbers} does not count: cross.span_mm or cross.journal_mm is not given.",
            "Warning: friction of joints {numbers} does not count: cross.span_mm or cross.journal_mm is not given.",
            len(loose),
        )
        yield Remark(text=text.format(numbers=listed(loose)), tone="warning")
    if "duty.speed" in found.assumed:
        yield Remark(text=_("Without a speed inertia does not count; --speed-rpm counts it."))
        return
    light = [int(path.split("[")[1].split("]")[0]) for path in found.assumed if path.endswith(".inertia")]
    if light:
        text = plural(
            "Shaft {numbers} counts as without inertia: neither inertia_kg_m2 nor outer_mm is given.",
            "Shafts {numbers} count as without inertia: neither inertia_kg_m2 nor outer_mm is given.",
            len(light),
        )
        yield Remark(text=text.format(numbers=listed(light)))


def _trace(found: Forces) -> Table:
    """Return everything at every position."""
    import numpy as np

    from .answer import Column, Table

    named: list[tuple[str, Any]] = [("angle_deg", np.rad2deg(found.angle))]

    def vector(key: str, table: Any, unit: str) -> None:
        named.extend((f"{key}_{way}_{unit}", table[:, k]) for k, way in enumerate("xyz"))

    for k, torque in enumerate(found.shaft_torque):
        named.append((f"shaft_{k + 1}_torque_Nm", torque))
        named.append((f"shaft_{k + 1}_bending_Nm", found.bending_couple[k]))
        vector(f"shaft_{k + 1}_bending", found.secondary_couple[k], "Nm")
    for i, couple in enumerate(found.joint_torque):
        named.append((f"joint_{i + 1}_torque_Nm", couple))
        for j, side in enumerate(("driving_a", "driving_b", "driven_a", "driven_b")):
            named.append((f"joint_{i + 1}_{side}_journal_N", found.journals.size[i, :, j]))
        named.append((f"joint_{i + 1}_driving_thrust_N", found.journals.thrust[i, :, 0]))
        named.append((f"joint_{i + 1}_driven_thrust_N", found.journals.thrust[i, :, 1]))
        if "duty.speed" not in found.assumed:
            named.append((f"joint_{i + 1}_heat_W", found.loss[i]))
        if found.joint_force is not None:
            vector(f"joint_{i + 1}_force", found.joint_force[i], "N")
    for k, thrust in enumerate(found.spline_thrust):
        named.append((f"spline_{k + 1}_thrust_N", thrust))
    if found.reaction is not None and found.support_couple is not None:
        for k, force in enumerate(found.reaction):
            named.append((f"support_{k + 1}_radial_N", found.radial[k]))
            named.append((f"support_{k + 1}_axial_N", found.axial[k]))
            vector(f"support_{k + 1}", force, "N")
            if found.support_couple[k].any():
                vector(f"support_{k + 1}_couple", found.support_couple[k], "Nm")
    table = np.stack([values for _key, values in named], axis=-1)
    return Table(columns=tuple(Column(key=key) for key, _values in named), rows=table.tolist())


def _content(drive: Drive, file: Path, found: Forces, curves: Forces) -> dict[str, Any]:
    from cardan.maths.curves.over_turn import harmonics
    from cardan.questions.forces.reactions import Held
    from cardan.questions.forces.solving_order import reaction_groups
    from cardan.units import rpm

    from .asked import columns_of, tidy
    from .force_tables import joint_table, shaft_table, support_table
    from .show import records

    torque = harmonics(found.angle, found.shaft_torque, count=ORDERS)
    back = [] if curves.reverse is None else [("forces_sliding_back", columns_of(_trace(curves.reverse)))]
    held = found.reaction is not None
    support_names = [(k, one.name) for k, one in enumerate(drive.supports, 1)]
    return {
        "question": "forces",
        "drive": drive.name,
        "file": str(file),
        "speed_rpm": None if drive.duty.speed is None else drive.duty.speed / rpm,
        "torque_Nm": drive.duty.torque,
        "torque_at": drive.duty.torque_at,
        "status": Held(int(found.status)).name.lower(),
        "equations": found.equations,
        "unknowns": found.unknowns,
        "solving_order": [list(group) for group in reaction_groups(drive)],
        "shafts": records(shaft_table(drive, found), [(one.number, one.name) for one in drive.shafts]),
        "torque_orders_Nm": [tidy(row) for row in torque.amplitude],
        "joints": records(joint_table(drive, found), [(i, one.name) for i, one in enumerate(drive.joints, 1)]),
        "supports": records(support_table(drive, found), support_names) if held else [],
        "power_left": found.power_left.max(),
        "force_left": None if found.force_left is None else found.force_left.max(),
        "moment_left": None if found.moment_left is None else found.moment_left.max(),
        "assumed": found.assumed,
        "forces": columns_of(_trace(curves)),
        **dict(back),
    }
