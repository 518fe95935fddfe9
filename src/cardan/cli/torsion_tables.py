"""The tables of ``cardan torsion response``: torques, speeds, and a sweep."""

from __future__ import annotations

from typing import TYPE_CHECKING

from cardan.texts import _

if TYPE_CHECKING:
    from cardan.questions.torsion.steady.torsion_response import TorsionResponse

    from .answer import Cell, Table

SHOWN = 12
"""Speeds of a sweep in the terminal."""

STATES = (_("stable"), _("neutral"), _("unstable"), _("unknown"))
"""What becomes of a small disturbance, by `cardan.questions.torsion.steady.run_stability.Verdict`."""


def element_table(found: TorsionResponse) -> Table:
    """Return mean, extremes and orders of the torque of every element."""
    import numpy as np

    from cardan.maths.ties import foremost
    from cardan.questions.torsion.steady.torsion_response import level

    from .answer import Column, Table, significant
    from .torsion_parts import short

    torque, order = found.steady.torque, found.steady.order
    largest = float(np.max(np.abs(torque.mean)) + np.max(torque.amplitude))
    rows: list[list[Cell]] = []
    for e, name in enumerate(found.train.element_names):
        amplitude = np.where(torque.amplitude[e] > 1e-12 * largest, torque.amplitude[e], 0.0)
        others = np.where((order == 2.0) | (order == 4.0), 0.0, amplitude)
        k = int(foremost(others))
        there = others[k] > 1e-9 * largest
        rows.append(
            [
                short(name, 28),
                level(float(torque.mean[e]), float(np.max(torque.amplitude))),
                float(found.torque_lowest[e]),
                float(found.torque_highest[e]),
                float(amplitude[np.flatnonzero(order == 2.0)[0]]),
                float(amplitude[np.flatnonzero(order == 4.0)[0]]),
                f"{significant(float(others[k]), 3)} ({order[k]:g})" if there else None,
            ]
        )
    columns = (
        Column(key="element", heading=_("torque in"), left=True),
        Column(key="mean_Nm", heading=_("mean"), unit="N·m", form="3"),
        Column(key="min_Nm", heading=_("min"), unit="N·m", form="3"),
        Column(key="max_Nm", heading=_("max"), unit="N·m", form="3"),
        Column(key="order_2_Nm", heading=_("order 2"), unit="± N·m", form="3"),
        Column(key="order_4_Nm", heading=_("order 4"), unit="± N·m", form="3"),
        Column(key="other_Nm", heading=_("other"), unit=_("± (order)")),
    )
    return Table(columns=columns, rows=rows)


def station_table(found: TorsionResponse) -> Table:
    """Return how speed and angle of every station swing."""
    import numpy as np

    from cardan.maths.ties import foremost

    from .answer import Column, Table
    from .torsion_parts import short

    speed, order = found.steady.station_speed, found.steady.order
    mean = abs(float(found.speed))
    rows: list[list[Cell]] = []
    for k, name in enumerate(found.train.model.names):
        amplitude = speed.amplitude[k]
        angle = np.degrees(found.steady.angle_amplitude[k])
        second = int(np.flatnonzero(order == 2.0)[0])
        top = int(foremost(amplitude))
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


def sweep_table(found: TorsionResponse) -> Table:
    """Return the worst torque at some speeds."""
    import numpy as np

    from cardan.maths.ties import foremost
    from cardan.units import rpm

    from .answer import Column, Table
    from .torsion_parts import short

    count = len(found.speed)
    worst = foremost(np.where(np.isfinite(found.swing), found.swing, -1.0))
    chosen = np.unique(np.linspace(0, count - 1, min(count, SHOWN)).round().astype(int))
    peak = int(foremost(np.nan_to_num(found.swing[np.arange(count), worst])))
    names = found.train.element_names
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
        Column(key="element", heading=_("worst in"), left=True),
    )
    return Table(columns=columns, rows=rows)
