"""Pictures of steady running: where it is unstable over speed and bend, and how orders swell over the speed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from matplotlib.figure import Figure

from cardan.questions.torsion.model.inputs import Constant, Swinging
from cardan.questions.torsion.model.torsional_layouts import chosen
from cardan.questions.torsion.model.torsional_model import Torque, TorsionalModel, torsional_line
from cardan.questions.torsion.stability.floquet_map import floquet_map, speed_sweep
from cardan.questions.torsion.steady.orbit import straight_frequencies
from cardan.units import deg, rpm

from .kit import INK, PALE, SERIES, page


def line(damping: float = 0.05) -> TorsionalModel:
    """Return a drive of one joint with two low natural frequencies."""
    return torsional_line(
        [[1.0, 0.02], [0.02, 0.3, 0.2]],
        stiffness=[[1500.0], [2500.0, 1200.0]],
        damping=[[damping], [damping, damping]],
        joint_angle=[0.0],
        torques=[Torque(station=4, law=Constant(value=-20.0))],
        input_speed=1.0,
    )


def tongues() -> Figure:
    """Draw the zones of a drive over speed and bend, by how fast vibration grows, with the names of the zones."""
    figure, axes = page(10.0, 4.8)
    speeds, joint_angles = np.linspace(25.0, 125.0, 321), np.linspace(0.0, 40.0, 81)
    model = replace(line(), joint_angle=(joint_angles * deg)[:, None, None], input_speed=speeds)
    growth = floquet_map(model).floquet.growth_rate
    shown = np.where(growth > 0.0, growth, np.nan)
    drawn = axes.pcolormesh(
        speeds / rpm, joint_angles, shown, cmap="YlOrRd", vmin=0.0, shading="nearest", rasterized=True
    )
    axes.contour(speeds / rpm, joint_angles, growth, levels=[0.0], colors=INK, linewidths=0.8)
    figure.colorbar(drawn, ax=axes, label="growth [1/s]", pad=0.01)
    outer = len(joint_angles), len(speeds)
    one, two, three = straight_frequencies(chosen(model, outer, np.zeros(1, dtype=int)))[0]
    for where, name, side in (
        (one, r"$\omega_1$", "left"),
        (two, r"$\omega_2$", "center"),
        (0.5 * two, r"$\omega_2/2$", "center"),
        (0.5 * (one + two), r"$(\omega_1+\omega_2)/2$", "center"),
        (0.25 * (one + two), r"$(\omega_1+\omega_2)/4$", "right"),
        (0.25 * (one + three), r"$(\omega_1+\omega_3)/4$", "center"),
    ):
        axes.axvline(where / rpm, color=PALE, lw=0.8, ls=(0, (2, 3)), zorder=0)
        axes.annotate(name, (where / rpm, 40.0), xytext=(0, 3), textcoords="offset points", ha=side, va="bottom")
    axes.set_xlabel("speed [rpm]")
    axes.set_ylabel("joint angle [°]")
    axes.set_xlim(speeds[0] / rpm, speeds[-1] / rpm)
    return figure


def swelling() -> Figure:
    """Draw the amplitude of the orders of a torque over the speed, with their resonances."""
    figure, axes = page(10.0, 3.8)
    speeds = np.linspace(12.0, 125.0, 400)
    push = Torque(station=1, law=Swinging(amplitude=4.0, frequency=1.0))
    model = line(damping=0.6)
    model = replace(model, joint_angle=np.asarray([18.0 * deg]), torques=(*model.torques, push))
    found = speed_sweep(model, speeds)
    for order, colour in zip((1, 2, 3, 4), SERIES, strict=False):
        axes.semilogy(
            speeds / rpm, found.torque.amplitude[:, 1, order - 1], color=colour, lw=1.3, label=f"order {order}"
        )
    axes.set_xlabel("speed [rpm]")
    axes.set_ylabel("torque behind the joint [N·m]")
    axes.set_ylim(1e-3, 1e3)
    axes.set_xlim(speeds[0] / rpm, speeds[-1] / rpm)
    axes.legend(ncols=4, loc="lower center", bbox_to_anchor=(0.5, 1.0))
    return figure


PICTURES = {"stability-tongues": tongues, "orders-over-speed": swelling}
"""Name of the file -> function that draws it."""
