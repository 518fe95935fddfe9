"""``cardan torsion response``: how do the shafts vibrate in torsion, at a speed or over many?"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cardan.texts import _

from .asked import TorqueNm
from .options import AsCsv, AsJson, DriveFile, Plot, SpeedRpm
from .torsion_parts import Pieces, Speeds

if TYPE_CHECKING:
    from cardan.analysis.torsion_response import TorsionResponse
    from cardan.drive.drive import Drive

    from .answer import Answer, Cell, Remark, Table, Tone

SHOWN = 12
"""Speeds of a sweep in the terminal."""

STATES = (_("stable"), _("neutral"), _("unstable"), _("unknown"))
"""What becomes of a small disturbance, by `cardan.analysis.stability.Verdict`."""


def torsion_response(
    file: DriveFile,
    speed_rpm: SpeedRpm = None,
    speeds: Speeds = None,
    torque: TorqueNm = None,
    pieces: Pieces = 1,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell how the shafts vibrate in torsion while the drive runs steadily."""
    from .asked import check_torque, keys_of, on_duty
    from .output import check_speed
    from .show import check_common, show
    from .torsion_parts import ended, keeping, values

    check_common(json=json, csv=csv, plot=plot)
    check_speed(speed_rpm)
    check_torque(torque)
    asked = None if speeds is None else values(speeds, "--speeds", low=0.0)

    from cardan.analysis.torsion_response import torsion_response as question
    from cardan.units import rpm

    from .source import read

    drive = on_duty(read(file), speed_rpm, torque)
    with keys_of(file), keeping(_("finding steady motions")) as progress:
        found = question(drive, speed=None if asked is None else asked * rpm, pieces=pieces, progress=progress)
    return ended(show(_answer(drive, file, found), json=json, csv=csv, plot=plot), progress)


def _answer(drive: Drive, file: Path, found: TorsionResponse) -> Answer:
    from .answer import Answer
    from .asked import figures

    swept = bool(found.speed.ndim)
    tone, sentence = _swept(drive, file, found) if swept else _sentence(drive, file, found)
    return Answer(
        sentence=sentence,
        tone=tone,
        tables=lambda: [_sweep_table(found)] if swept else _tables(found),
        remarks=tuple(_remarks(file, found)),
        content=lambda: _content(drive, file, found),
        csv=lambda: _rows(found),
        figure=lambda: figures(found),
        code=1 if tone == "failed" and not swept else 0,
    )


def _sentence(drive: Drive, file: Path, found: TorsionResponse) -> tuple[Tone, str]:
    import numpy as np

    from cardan.analysis.stability import Verdict
    from cardan.units import rpm

    from .answer import significant
    from .source import title
    from .torsion_parts import element_names

    at = {"name": title(drive, file), "speed": significant(abs(float(found.speed)) / rpm)}
    if not bool(found.steady.found):
        return "failed", _("{name}: no steady motion was found at {speed} rpm.").format(**at)
    e = int(np.argmax(found.swing))
    mean, swing = float(found.steady.torque.mean[e]), float(found.swing[e])
    text = _("{name}: at {speed} rpm {element} carries {mean} ± {swing} N·m").format(
        element=element_names(found.train)[e], mean=significant(mean), swing=significant(swing, 3), **at
    )
    verdict = int(found.floquet.verdict)
    if verdict == Verdict.UNSTABLE:
        said = _("; the motion is unstable and grows by {rate} 1/s: {zone}.")
        rate = significant(float(found.floquet.growth_rate), 3)
        return "failed", text + said.format(rate=rate, zone=found.floquet.zone.name())
    if verdict == Verdict.NEUTRAL:
        return "warning", text + _("; a small disturbance neither grows nor dies out.")
    lifts = np.sign(found.torque_lowest) * np.sign(found.torque_highest) < 0.0
    if np.any(lifts & (np.abs(found.steady.torque.mean) > 1e-6 * np.max(np.abs(found.torque_highest)))):
        return "warning", text + _("; stable, but the torque changes its sign: joints and splines with play rattle.")
    return "good", text + _("; stable.")


def _tables(found: TorsionResponse) -> list[Table]:
    return [_element_table(found), _station_table(found)] if bool(found.steady.found) else []


def _element_table(found: TorsionResponse) -> Table:
    import numpy as np

    from .answer import Column, Table, significant
    from .torsion_parts import element_names, short

    torque, order = found.steady.torque, found.steady.order
    rows: list[list[Cell]] = []
    for e, name in enumerate(element_names(found.train)):
        amplitude = torque.amplitude[e]
        others = np.where((order == 2.0) | (order == 4.0), 0.0, amplitude)
        k = int(np.argmax(others))
        largest = float(np.max(np.abs(torque.mean)) + np.max(torque.amplitude))
        there = others[k] > 1e-9 * largest
        rows.append(
            [
                short(name, 28),
                float(torque.mean[e]),
                float(found.torque_lowest[e]),
                float(found.torque_highest[e]),
                float(amplitude[np.flatnonzero(order == 2.0)[0]]),
                float(amplitude[np.flatnonzero(order == 4.0)[0]]),
                f"{significant(float(others[k]), 3)} ({order[k]:g})" if there else None,
            ]
        )
    columns = (
        Column(key="element", heading=_("torque between"), left=True),
        Column(key="mean_Nm", heading=_("mean"), unit="N·m", form="3"),
        Column(key="min_Nm", heading=_("min"), unit="N·m", form="3"),
        Column(key="max_Nm", heading=_("max"), unit="N·m", form="3"),
        Column(key="order_2_Nm", heading=_("order 2"), unit="± N·m", form="3"),
        Column(key="order_4_Nm", heading=_("order 4"), unit="± N·m", form="3"),
        Column(key="other_Nm", heading=_("other"), unit=_("± (order)")),
    )
    return Table(columns=columns, rows=rows)


def _station_table(found: TorsionResponse) -> Table:
    import numpy as np

    from .answer import Column, Table
    from .torsion_parts import short

    speed, order = found.steady.station_speed, found.steady.order
    mean = abs(float(found.speed))
    rows: list[list[Cell]] = []
    for k, name in enumerate(found.train.model.names):
        amplitude = speed.amplitude[k]
        angle = np.degrees(found.steady.angle_amplitude[k])
        second = int(np.flatnonzero(order == 2.0)[0])
        top = int(np.argmax(amplitude))
        there = bool(amplitude[top] > 1e-12 * mean)
        rows.append(
            [
                short(name, 34),
                100.0 * float(np.sum(amplitude)) / mean if there else 0.0,
                float(angle[second]) if there else 0.0,
                float(order[top]) if there else None,
            ]
        )
    columns = (
        Column(key="station", heading=_("station"), left=True),
        Column(key="speed_swing_percent", heading=_("speed swings"), unit="± %", form="3"),
        Column(key="angle_order_2_deg", heading=_("angle, order 2"), unit="± °", form="3"),
        Column(key="largest_order", heading=_("strongest"), unit=_("order"), form="g"),
    )
    return Table(columns=columns, rows=rows)


def _swept(drive: Drive, file: Path, found: TorsionResponse) -> tuple[Tone, str]:
    import numpy as np

    from cardan.analysis.stability import Verdict
    from cardan.units import rpm

    from .answer import significant
    from .source import title
    from .torsion_parts import element_names

    name = title(drive, file)
    swing = np.where(np.isfinite(found.swing), found.swing, -1.0)
    k, e = (int(one) for one in np.unravel_index(int(np.argmax(swing)), swing.shape))
    if swing[k, e] < 0.0:
        return "failed", _("{name}: no steady motion was found.").format(name=name)
    text = _("{name}: the torque swings most at {speed} rpm, ± {swing} N·m in {element}")
    text = text.format(
        name=name,
        speed=significant(abs(float(found.speed[k])) / rpm),
        swing=significant(float(swing[k, e]), 3),
        element=element_names(found.train)[e],
    )
    unstable = intervals(np.abs(found.speed) / rpm, found.floquet.verdict == Verdict.UNSTABLE)
    if unstable:
        return "failed", text + _("; unstable at {where} rpm.").format(where=unstable)
    return "plain", text + _("; stable throughout.")


def intervals(speed: Any, mask: Any) -> str:
    """Return the ranges of speeds at which something holds, "" where there is none.

    Examples
    --------
    >>> intervals([10.0, 20.0, 30.0, 40.0], [True, True, False, True])
    '10 to 20, 40'
    """
    import numpy as np

    from .answer import significant

    parts = np.split(np.arange(len(mask)), np.flatnonzero(np.diff(np.asarray(mask, dtype=int))) + 1)
    words = []
    for part in parts:
        if len(part) and mask[part[0]]:
            ends = [significant(float(speed[k])).rstrip("0").rstrip(".") for k in (part[0], part[-1])]
            words.append(ends[0] if len(part) == 1 else _("{one} to {two}").format(one=ends[0], two=ends[1]))
    return ", ".join(words)


def _sweep_table(found: TorsionResponse) -> Table:
    import numpy as np

    from cardan.units import rpm

    from .answer import Column, Table
    from .torsion_parts import element_names, short

    count = len(found.speed)
    worst = np.nanargmax(np.where(np.isfinite(found.swing), found.swing, -1.0), axis=-1)
    chosen = np.unique(np.linspace(0, count - 1, min(count, SHOWN)).round().astype(int))
    peak = int(np.argmax(np.nan_to_num(found.swing[np.arange(count), worst])))
    names = element_names(found.train)
    second = int(np.flatnonzero(found.steady.order == 2.0)[0])
    rows: list[list[Cell]] = []
    for k in np.unique(np.append(chosen, peak)):
        e = int(worst[k])
        rows.append(
            [
                abs(float(found.speed[k])) / rpm,
                float(found.torque_lowest[k, e]),
                float(found.torque_highest[k, e]),
                float(found.steady.torque.amplitude[k, e, second]),
                STATES[int(found.floquet.verdict[k])],
                short(names[e], 40),
            ]
        )
    columns = (
        Column(key="speed_rpm", heading=_("speed"), unit="rpm"),
        Column(key="min_Nm", heading=_("min"), unit="N·m", form="3"),
        Column(key="max_Nm", heading=_("max"), unit="N·m", form="3"),
        Column(key="order_2_Nm", heading=_("order 2"), unit="± N·m", form="3"),
        Column(key="state", heading=_("motion"), left=True),
        Column(key="element", heading=_("worst between"), left=True),
    )
    return Table(columns=columns, rows=rows)


def _remarks(file: Path, found: TorsionResponse) -> Iterator[Remark]:
    import numpy as np

    from .answer import Remark, significant
    from .torsion_parts import assumptions

    steady = found.steady
    lost = int(np.sum(~np.asarray(steady.found) & (np.asarray(steady.status) != 3)))
    if lost and found.speed.ndim:
        yield Remark(
            text=_("Warning: no steady motion was found at {count} speeds.").format(count=lost), tone="warning"
        )
    if np.any(np.asarray(steady.status) == 3):
        done = int(np.sum(np.asarray(steady.status) != 3))
        text = _("Warning: stopped; {done} of {all} speeds are done.")
        yield Remark(text=text.format(done=done, all=steady.status.size), tone="warning")
    for one in found.apart:
        text = _(
            "Order {order} does not repeat within two turns: answered by the straight line, ± {torque} N·m at most, "
            "and added to the extremes."
        )
        yield Remark(text=text.format(order=f"{one.order:g}", torque=significant(float(np.max(np.abs(one.torque))), 3)))
    if found.train.model.free and not found.speed.ndim and bool(steady.found):
        text = _("Beside the torques of the duty the input needs {torque} N·m to keep its speed.")
        yield Remark(text=text.format(torque=significant(float(steady.drive_torque.mean[0]))))
    if np.any(found.train.model.loss_factor):
        yield Remark(text=_("Structural damping counts as viscous, equal at order 2 of the speed."))
    yield from assumptions(found.train)
    if np.any(steady.found):
        text = _(
            "Equations of motion checked between the points of the solution: {rest:.0e} of the torque is left over."
        )
        yield Remark(text=text.format(rest=float(np.nanmax(steady.residual))))
    if found.speed.ndim:
        return
    yield Remark(
        text=_("The same over speeds [rpm]:"),
        command=("cardan", "torsion", "response", str(file), "--speeds", "LOW:HIGH"),
        tone="next",
    )


def _rows(found: TorsionResponse) -> Table:
    """Return torques of every element, one speed a row."""
    import numpy as np

    from cardan.units import rpm

    from .answer import Column, Table

    one = not found.speed.ndim

    def wide(values: Any) -> Any:
        return np.asarray(values)[None] if one else np.asarray(values)

    keys = ["speed_rpm", "status", "verdict", "growth_rate_1_per_s"]
    named = [
        wide(found.speed) / rpm,
        wide(found.steady.status),
        wide(found.floquet.verdict),
        wide(found.floquet.growth_rate),
    ]
    torque = found.steady.torque
    for e in range(len(found.train.model.elements)):
        parts = [("mean", torque.mean), ("min", found.torque_lowest), ("max", found.torque_highest)]
        keys += [f"element_{e + 1}_{word}_Nm" for word, _values in parts]
        named += [wide(part)[..., e] for _word, part in parts]
        for k, order in enumerate(found.steady.order):
            keys.append(f"element_{e + 1}_order_{order:g}_Nm")
            named.append(wide(torque.amplitude)[..., e, k])
    rows = np.stack([np.asarray(part, dtype=float) for part in named], axis=-1).tolist()
    return Table(columns=tuple(Column(key=key) for key in keys), rows=rows)


def _content(drive: Drive, file: Path, found: TorsionResponse) -> dict[str, Any]:
    from cardan.units import rpm

    from .torsion_parts import element_names

    steady = found.steady
    return {
        "question": "torsion response",
        "drive": drive.name,
        "file": str(file),
        "speed_rpm": abs(found.speed) / rpm,
        "input": "free" if found.train.model.free else "uniform",
        "elements": element_names(found.train),
        "stations": found.train.model.names,
        "orders": steady.order,
        "mean_Nm": steady.torque.mean,
        "min_Nm": found.torque_lowest,
        "max_Nm": found.torque_highest,
        "order_amplitude_Nm": steady.torque.amplitude,
        "station_speed_amplitude_rad_s": steady.station_speed.amplitude,
        "drive_torque_Nm": steady.drive_torque.mean[..., 0],
        "status": steady.status,
        "verdict": [STATES[int(one)] for one in found.floquet.verdict.reshape(-1)],
        "growth_rate_1_per_s": found.floquet.growth_rate,
        "spectral_radius": found.floquet.spectral_radius,
        "apart": [{"order": one.order, "torque_Nm": abs(one.torque)} for one in found.apart],
        "residual": steady.residual,
        "power_residual": steady.power_residual,
        "assumed": found.assumed,
    }
