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
    from cardan.drive.drive import Drive
    from cardan.questions.torsion.steady.torsion_response import TorsionResponse

    from .answer import Answer, Remark, Table, Tone

EVEN = 1e-3
"""An irregularity below which yoke angles have little left to take away."""


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

    from cardan.questions.torsion.steady.torsion_response import torsion_response as question
    from cardan.units import rpm

    from .source import read

    drive = on_duty(read(file), speed_rpm, torque)
    with keys_of(file), keeping(_("finding steady motions")) as progress:
        found = question(drive, speed=None if asked is None else asked * rpm, pieces=pieces, progress=progress)
    return ended(show(_answer(drive, file, found), json=json, csv=csv, plot=plot), progress)


def _answer(drive: Drive, file: Path, found: TorsionResponse) -> Answer:
    import numpy as np

    from .answer import Answer
    from .asked import figures
    from .torsion_tables import sweep_table

    swept = bool(found.speed.ndim)
    tone, sentence = _swept(drive, file, found) if swept else _sentence(drive, file, found)
    return Answer(
        sentence=sentence,
        tone=tone,
        tables=lambda: [sweep_table(found)] if swept else _tables(found),
        remarks=tuple(_remarks(drive, file, found)),
        content=lambda: _content(drive, file, found),
        csv=lambda: _rows(found),
        figure=(lambda: figures(found)) if np.any(found.steady.found) else None,
        code=1 if tone == "failed" and not swept else 0,
    )


def _sentence(drive: Drive, file: Path, found: TorsionResponse) -> tuple[Tone, str]:
    import numpy as np

    from cardan.maths.ties import foremost
    from cardan.questions.torsion.steady.run_stability import Verdict
    from cardan.questions.torsion.steady.torsion_response import level
    from cardan.units import rpm

    from .answer import significant
    from .source import title

    at = {"name": title(drive, file), "speed": significant(abs(float(found.speed)) / rpm)}
    if not bool(found.steady.found):
        return "failed", _("{name}: no steady motion was found at {speed} rpm.").format(**at)
    e = int(foremost(found.swing))
    swing = float(found.swing[e])
    mean = level(float(found.steady.torque.mean[e]), swing)
    text = _("{name}: at {speed} rpm {element} carries {mean} ± {swing} N·m").format(
        element=found.train.element_names[e], mean=significant(mean), swing=significant(swing, 3), **at
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
    from .torsion_tables import element_table, station_table

    return [element_table(found), station_table(found)] if bool(found.steady.found) else []


def _swept(drive: Drive, file: Path, found: TorsionResponse) -> tuple[Tone, str]:
    import numpy as np

    from cardan.maths.ties import foremost
    from cardan.questions.torsion.steady.run_stability import Verdict
    from cardan.units import rpm

    from .answer import significant
    from .source import title

    name = title(drive, file)
    swing = np.where(np.isfinite(found.swing), found.swing, -1.0)
    k, e = (int(one) for one in np.unravel_index(int(foremost(swing.ravel())), swing.shape))
    if swing[k, e] < 0.0:
        return "failed", _("{name}: no steady motion was found.").format(name=name)
    text = _("{name}: the torque swings most at {speed} rpm, ± {swing} N·m in {element}")
    text = text.format(
        name=name,
        speed=significant(abs(float(found.speed[k])) / rpm),
        swing=significant(float(swing[k, e]), 3),
        element=found.train.element_names[e],
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


def _remarks(drive: Drive, file: Path, found: TorsionResponse) -> Iterator[Remark]:
    import numpy as np

    from cardan.answers.checks import closely

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
    if drive.duty.engine is not None and drive.duty.engine.mean_pressure is not None:
        yield _engine(drive, found)
    if found.train.model.free and not found.speed.ndim and bool(steady.found):
        text = _("Beside the torques of the duty the input needs {torque} N·m to keep its speed.")
        yield Remark(text=text.format(torque=significant(float(steady.drive_torque.mean[0]))))
    if np.any(found.train.model.loss_factor):
        yield Remark(text=_("Structural damping counts as viscous, equal at order 2 of the speed."))
    yield from assumptions(found.train)
    if np.any(steady.found):
        text = _("Equations of motion checked between the points of the solution: the torques balance {closely}.")
        yield Remark(text=text.format(closely=closely(float(np.nanmax(steady.residual)))))
    if _from_yokes(drive, found):
        text = _("Most of it is order 2 of the joints; other yoke angles may take that away:")
        yield Remark(text=text, command=("cardan", "phases", str(file)), tone="next")
    if found.speed.ndim:
        return
    yield Remark(
        text=_("The same over speeds [rpm]:"),
        command=("cardan", "torsion", "response", str(file), "--speeds", "LOW:HIGH"),
        tone="next",
    )


def _engine(drive: Drive, found: TorsionResponse) -> Remark:
    """Return mean and strongest harmonics of the torque of an engine's crank drive."""
    import numpy as np

    from cardan.questions.torsion.model.excitation import engine_torque

    from .answer import Remark, significant

    assert drive.duty.engine is not None
    torque = engine_torque(drive.duty.engine, float(np.max(np.abs(found.speed))))
    strongest = np.argsort(-torque.amplitude)[:3]
    said = ", ".join(
        _("order {order} ± {torque}").format(
            order=f"{torque.order[k]:g}", torque=significant(float(torque.amplitude[k]), 3)
        )
        for k in strongest
    )
    text = _("The engine brings {mean} N·m to the input shaft and swings it by {orders} N·m, in orders of its crank.")
    return Remark(text=text.format(mean=significant(float(torque.mean or 0.0), 3), orders=said))


def _from_yokes(drive: Drive, found: TorsionResponse) -> bool:
    """Tell whether most of the swing is order 2 of joints that are not set to cancel each other."""
    import numpy as np

    from cardan.maths.ties import foremost
    from cardan.questions.motion.equivalence import equivalent_joint

    if len(drive.joints) < 2 or not np.any(found.steady.found):
        return False
    swing = np.nan_to_num(found.swing)
    at = np.unravel_index(int(foremost(swing.ravel())), swing.shape)
    second = found.steady.torque.amplitude[at][np.flatnonzero(found.steady.order == 2.0)[0]]
    uneven = float(equivalent_joint(drive).irregularity)
    return bool(second > 0.5 * swing[at]) and uneven > EVEN


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

    from .torsion_tables import STATES

    steady = found.steady
    return {
        "question": "torsion response",
        "drive": drive.name,
        "file": str(file),
        "speed_rpm": abs(found.speed) / rpm,
        "input": "free" if found.train.model.free else "uniform",
        "elements": found.train.element_names,
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
