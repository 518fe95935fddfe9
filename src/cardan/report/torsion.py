"""How the drive vibrates in torsion: its modes, what excites them, and the steady motion at its speed."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.fields.words import with_key
from cardan.drive.models.chain import given_chain
from cardan.errors import InputError
from cardan.figures.wording import fixed, significant
from cardan.maths.ties import foremost
from cardan.questions.torsion.model.figure import campbell_figure, shapes_figure
from cardan.questions.torsion.model.torsion import TorsionModes, torsion_modes
from cardan.questions.torsion.stability.figure import map_figure
from cardan.questions.torsion.stability.torsion_stability import BEND, Stability, stability
from cardan.questions.torsion.steady.figure import response_figure, sweep_figure, waterfall_figure
from cardan.questions.torsion.steady.run_stability import Verdict
from cardan.questions.torsion.steady.torsion_response import TorsionResponse, torsion_response
from cardan.texts import _
from cardan.units import deg, rpm

from .balance import ROUNDING, checks, refused
from .block import Block, Cell, Column, Page, Picture, Points, Table, Words, key, number, words
from .lacking import of_orders, of_stability, of_torsion
from .subject import Progress, Subject

MODES = 4
"""Modes in the tables."""

SWEEP = 31
"""Speeds of the sweep over those in use."""

ACROSS, UP = 61, 14
"""Speeds and bends of the map of stability."""

COARSE_ACROSS, COARSE_UP = 21, 7
"""The same of a drive with play: a point at which that opens takes a hundred times as long."""

LITTLE, WIDEST = math.radians(0.5), math.radians(45.0)
"""No map of drives bent less; what stands for the bend of one that is bent more."""

SMALL = 1e-6
"""Share of the largest torque that a motion may miss its equations by between the points it was found from."""


def twisting(on: Subject) -> Page | None:
    """Return the page of torsional vibration; None where the file gives neither stations nor stiffnesses."""
    drive = on.drive
    if of_torsion(drive):
        return None
    try:
        modes, runs = torsion_modes(drive), on.swings
        swept = None if of_orders(drive) else _swept(drive)
        mapped = _mapped(drive, modes)
    except InputError as error:
        return refused("torsion", _("Torsional vibration"), error)
    more: list[Block] = []
    if swept is not None:
        more += _sweep(swept)
    if mapped is not None:
        more += _map(mapped, modes)
    return _page(drive, modes, runs, more)


def swinging(on: Subject) -> Page | None:
    """Return the page of the modes and of the motion at the speed of the duty alone; None as of `twisting`."""
    if of_torsion(on.drive):
        return None
    try:
        modes, runs = torsion_modes(on.drive), on.swings
    except InputError as error:
        return refused("torsion", _("Torsional vibration"), error)
    return _page(on.drive, modes, runs, [])


def ordered(on: Subject, progress: Progress | None = None) -> Page | None:
    """Return the page of the orders over the speeds in use; None where the file has no range of them.

    Parameters
    ----------
    on : Subject
        The drive.
    progress : function, optional
        Called with the share done; answering "stop" ends the work.
    """
    if of_orders(on.drive):
        return None
    title = _("Orders over the speeds in use")
    try:
        swept = _swept(on.drive, progress)
    except InputError as error:
        return refused("orders", title, error)
    blocks = _sweep(swept)
    return Page(name="orders", title=title, answer=_said(blocks), blocks=blocks)


def stable(on: Subject, progress: Progress | None = None) -> Page | None:
    """Return the page of where torsional vibration grows; None where the file has no speed, or bends next to nothing.

    Parameters
    ----------
    on : Subject
        The drive.
    progress : function, optional
        Called with the share done; answering "stop" ends the work.
    """
    if of_stability(on.drive):
        return None
    title = _("Where torsional vibration grows")
    try:
        modes = torsion_modes(on.drive)
        mapped = _mapped(on.drive, modes, progress)
    except InputError as error:
        return refused("stability", title, error)
    if mapped is None:
        return None
    blocks = _map(mapped, modes)
    return Page(name="stability", title=title, answer=_said(blocks), blocks=blocks)


def _said(blocks: Sequence[Block]) -> str:
    """Return the sentence under the first figure, or what stands instead of one."""
    for one in blocks:
        if isinstance(one, (Picture, Words)):
            return str(one.figure.sentence if isinstance(one, Picture) else one.text)
    return ""


def _page(drive: Drive, modes: TorsionModes, runs: TorsionResponse | None, more: Sequence[Block]) -> Page:
    """Return the page of modes and motion, with more after these."""
    alarms = list(_alarms(modes, runs))
    blocks: list[Block] = [*alarms, Picture(figure=campbell_figure(modes)), _mode_table(modes)]
    blocks += [Picture(figure=shapes_figure(modes)), _joint_table(drive, modes)]
    if runs is not None and bool(runs.steady.found):
        blocks += [Picture(figure=response_figure(runs)), _torque_table(runs)]
    blocks += more
    if modes.train.assumed:
        blocks.append(Points(title=_("Assumed"), items=list(_assumed(modes))))
    blocks.append(_checks(modes, runs))
    return Page(
        name="torsion",
        title=_("Torsional vibration"),
        answer=_answer(modes, runs),
        blocks=blocks,
        keys=list(_keys(modes, runs)),
        alarms=alarms,
    )


def _sweep(swept: TorsionResponse) -> list[Block]:
    return [Picture(figure=sweep_figure(swept)), Picture(figure=waterfall_figure(swept))]


def _map(mapped: Stability, modes: TorsionModes) -> list[Block]:
    if not np.any(mapped.verdict != Verdict.STABLE):
        (_speed, speeds), (_bend, bends) = mapped.over
        text = _(
            "From {slow} to {fast} rpm and with bends from {low} to {high}° torsional vibration grows nowhere: there "
            "is nothing to draw."
        )
        ends = {"slow": speeds[0], "fast": speeds[-1], "low": bends[0], "high": bends[-1]}
        return [
            Words(text=text.format(**{name: significant(float(end), 3) for name, end in ends.items()}), tone="good")
        ]
    return [Picture(figure=map_figure(mapped)), *([_finer(mapped)] if _plays(modes) else [])]


def _swept(drive: Drive, progress: Progress | None = None) -> TorsionResponse:
    """Return the motions over the speeds in use, of which there is a range."""
    between = drive.duty.speed_range
    assert between is not None
    low, high = max(between[0], 0.05 * between[1]), between[1]
    return torsion_response(drive, speed=np.linspace(low, high, SWEEP), progress=progress)


def _mapped(drive: Drive, modes: TorsionModes, progress: Progress | None = None) -> Stability | None:
    """Return where vibration grows, about the speed and the bends of the drive; None where it has none of them."""
    bend = float(np.max(given_chain(drive).bend))
    if not drive.duty.speed or bend < LITTLE:
        return None
    runs = abs(drive.duty.speed) / rpm
    across, up = (COARSE_ACROSS, COARSE_UP) if _plays(modes) else (ACROSS, UP)
    speeds = np.linspace(0.5 * runs, 1.5 * runs, across)
    bends = np.linspace(0.3, 1.6, up) * min(bend, WIDEST) / deg
    return stability(drive, over={"duty.speed_rpm": speeds, BEND: bends}, progress=progress)


def _plays(modes: TorsionModes) -> bool:
    """Tell whether anything has play that may open."""
    return bool(np.any(modes.train.model.backlash > 0.0))


def _finer(mapped: Stability) -> Words:
    """Return how to get a map in full."""
    (_speed, speeds), (_bend, bends) = mapped.over
    asked = "--speeds {:.4g}:{:.4g}:{} --bends {:.3g}:{:.3g}:{}"
    asked = asked.format(speeds[0], speeds[-1], ACROSS, bends[0], bends[-1], UP)
    text = _("The map is coarse, as motions whose play opens take long; in full: cardan torsion stability FILE {asked}")
    return Words(text=text.format(asked=asked))


def _answer(modes: TorsionModes, runs: TorsionResponse | None) -> str:
    text = _("The slowest mode swings at {hertz} Hz; order 2 of the joints meets it at {speed} rpm")
    text = text.format(
        hertz=significant(float(modes.omega[0]) / (2.0 * math.pi), 3),
        speed=significant(float(modes.order2_speed[0]) / rpm, 3),
    )
    if runs is None or not bool(runs.steady.found):
        return text + "."
    e = int(foremost(runs.swing))
    said = _("; at {speed} rpm the torque in {name} swings by ± {swing} N·m, and small disturbances {fate}.")
    fate = {Verdict.STABLE: _("die out"), Verdict.NEUTRAL: _("stay"), Verdict.UNSTABLE: _("grow")}
    return text + said.format(
        speed=significant(abs(float(runs.speed)) / rpm, 3),
        name=runs.train.element_names[e],
        swing=significant(float(runs.swing[e]), 3),
        fate=fate.get(Verdict(int(runs.floquet.verdict)), _("are not judged")),
    )


def _alarms(modes: TorsionModes, runs: TorsionResponse | None) -> Iterator[Words]:
    """Yield what the reader must not overlook."""
    if runs is not None and int(runs.floquet.verdict) == Verdict.UNSTABLE:
        text = _("Torsional vibration grows at {speed} rpm by itself: {zone}.")
        speed = significant(abs(float(runs.speed)) / rpm, 3)
        yield Words(text=text.format(speed=speed, zone=runs.floquet.zone.name()), tone="failed")
    if runs is not None and not bool(runs.steady.found):
        yield Words(text=_("No steady torsional motion was found at the speed of the duty."), tone="warning")
    used = modes.speed_range
    if used is None:
        return
    for k, zone in enumerate(modes.zone[:MODES]):
        if zone[0] <= used[1] and used[0] <= zone[1]:
            text = _("Torsional mode {mode} grows from {low} to {high} rpm, speeds in use.")
            low, high = (significant(float(one) / rpm, 3) for one in zone)
            yield Words(text=text.format(mode=k + 1, low=low, high=high), tone="failed")
    met = [one for one in modes.crossings if one.inside and one.mode <= MODES]
    for one in met[:2]:
        text = _("Order {order} ({cause}) meets torsional mode {mode} at {speed} rpm, a speed in use.")
        said = {"order": f"{one.order:g}", "cause": one.cause, "mode": one.mode}
        yield Words(text=text.format(speed=significant(one.speed / rpm, 3), **said), tone="warning")


def _mode_table(modes: TorsionModes) -> Table:
    rows = []
    for k, omega in enumerate(modes.omega[:MODES].tolist()):
        pulled, damped = 100.0 * float(modes.modulation[k]), 200.0 * float(modes.damping_ratio[k])
        fate = words(_("grows"), "failed") if pulled > damped else words(_("dies out"), "good")
        rows.append(
            [
                words(str(k + 1)),
                number(significant(omega / (2.0 * math.pi)), omega / (2.0 * math.pi)),
                number(significant(0.5 * omega / rpm), 0.5 * omega / rpm),
                number(significant(omega / rpm), omega / rpm),
                number(significant(pulled, 3), pulled),
                number(significant(damped, 3), damped),
                fate,
            ]
        )
    return Table(
        title=_("Modes with straight joints"),
        columns=(
            Column(heading=_("mode")),
            Column(heading=_("swings"), unit="Hz"),
            Column(heading=_("order 2 meets it at"), unit="rpm"),
            Column(heading=_("parametric resonance at"), unit="rpm"),
            Column(heading=_("joints pull"), unit="%"),
            Column(heading=_("damping takes"), unit="%"),
            Column(heading=_("there it"), left=True),
        ),
        rows=rows,
        note=_("Joints modulate the stiffness of a mode twice a turn; at Ω = ω it grows where they pull more than 2ζ."),
    )


def _joint_table(drive: Drive, modes: TorsionModes) -> Table:
    count = min(MODES, len(modes.omega))
    rows = [
        [
            words(f"{i + 1} {joint.name}".strip()),
            *(number(fixed(float(one), 3), float(one)) for one in modes.joint_weight[:count, i]),
        ]
        for i, joint in enumerate(drive.joints)
    ]
    heads = [Column(heading=_("mode {number}").format(number=k)) for k in range(1, count + 1)]
    return Table(
        title=_("How far each joint is from the node of a mode, κ"),
        columns=(Column(heading=_("joint"), left=True), *heads),
        rows=rows,
        note=_("A joint with κ = 0 stands in the node and excites no parametric vibration of that mode."),
    )


def _torque_table(runs: TorsionResponse) -> Table:
    order = runs.steady.order
    second = int(np.flatnonzero(order == 2.0)[0])
    rows = [
        [
            words(name),
            *_torques(
                runs.steady.torque.mean[e],
                runs.torque_lowest[e],
                runs.torque_highest[e],
                runs.steady.torque.amplitude[e, second],
            ),
        ]
        for e, name in enumerate(runs.train.element_names)
    ]
    return Table(
        title=_("Torques in steady running"),
        columns=(
            Column(heading=_("in"), left=True),
            Column(heading=_("mean"), unit="N·m"),
            Column(heading=_("lowest"), unit="N·m"),
            Column(heading=_("highest"), unit="N·m"),
            Column(heading=_("order 2"), unit="± N·m"),
        ),
        rows=rows,
    )


def _torques(*values: float) -> list[Cell]:
    """Return the cells of a part's torques; what is only rounding beside the greatest of them is nought."""
    least = 1e-9 * max(map(abs, values))
    return [number("0" if abs(one) <= least else significant(float(one), 3), float(one)) for one in values]


def _assumed(modes: TorsionModes) -> Iterator[str]:
    meant = {
        "stiffness": _("rigid: it has neither a stiffness nor a body of known length"),
        "inertia": _("without inertia"),
        "material": _("of steel"),
        "damping": _("without damping"),
    }
    for path in modes.train.assumed:
        yield f"{with_key(path)}: {meant.get(path.rpartition('.')[2], _('as by default'))}"


def _keys(modes: TorsionModes, runs: TorsionResponse | None) -> Iterator[list[Cell]]:
    yield key(_("slowest torsional mode"), float(modes.omega[0]) / (2.0 * math.pi), "Hz")
    yield key(_("speed at which order 2 meets it"), float(modes.order2_speed[0]) / rpm, "rpm")
    if runs is not None and bool(runs.steady.found):
        grows = int(runs.floquet.verdict) == Verdict.UNSTABLE
        verdict = words(_("grows"), "failed") if grows else words(_("stable"), "good")
        yield key(_("largest swing of torque"), float(np.max(runs.swing)), "N·m", verdict)


def _checks(modes: TorsionModes, runs: TorsionResponse | None) -> Table:
    rows = [(_("modes"), _("balance of every mode over its largest torque"), modes.residual, ROUNDING)]
    if runs is not None and bool(runs.steady.found):
        steady = runs.steady
        what = _("equations of motion between the points of the solution, over the largest torque")
        rows.append((_("steady motion"), what, float(steady.residual), SMALL))
        rows.append((_("power"), _("over a period, over the power that flows"), float(steady.power_residual), SMALL))
    return checks(rows)
