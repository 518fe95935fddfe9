"""Pictures of the conventions: what each number of a drive file is measured from, and in which sense."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from cardan import Drive, equivalent_joint, motion
from cardan.drive.models.geometry import Geometry, geometry
from cardan.units import deg

from . import kit
from .kit import ACCENT, DRIVEN, DRIVING, INK, PALE, STEEL, Scene, arc, arrow, bare, note, page, turn, unit

Array = Any


def pins(drive: Drive, angle: float = 0.0) -> tuple[Geometry, Array, Array]:
    """Return the geometry and, at an input angle, the pins u_i of the driving and v_{i+1} of the driven yokes."""
    place = geometry(drive)
    theta = motion(drive, [angle]).yoke_rotation[:, 0]
    u, v = [], []
    for i, t in enumerate(theta):
        in_plane = np.cross(place.normal[i], place.axis[i])
        u.append(np.cos(t) * in_plane + np.sin(t) * place.normal[i])
        v.append(unit(np.cross(place.axis[i + 1], u[-1])))
    return place, np.array(u), np.array(v)


def solids(scene: Scene, drive: Drive, *, angle: float = 0.0, size: float = 0.3, radius: float = 0.045) -> Geometry:
    """Add shafts, yokes and crosses of a drive to a scene."""
    place, u, v = pins(drive, angle)
    gap, joints = 0.55 * size, len(u)
    for k in range(joints + 1):
        start = place.points[k] + (gap * place.axis[k] if k else 0.0)
        end = place.points[k + 1] - (gap * place.axis[k] if k < joints else 0.0)
        scene.tube(start, end, radius)
    for i in range(joints):
        centre = place.points[i + 1]
        scene.yoke(centre, place.axis[i], u[i], DRIVING, size)
        scene.yoke(centre, -place.axis[i + 1], v[i], DRIVEN, size)
        scene.cross(centre, u[i], v[i], size)
    return place


def overview() -> Figure:
    """Draw a three-joint drive with everything numbered."""
    drive = Drive.from_points(
        [[-0.9, 0, 0.05], [0, 0, 0], [1.35, 0.25, -0.5], [2.75, -0.1, -0.55], [3.6, -0.1, -0.2]],
        yoke_angles=[0.2, -0.4],
    )
    figure, axes = page(12.6, 4.4)
    bare(axes)
    scene = Scene(swing=18, rise=24)
    place = solids(scene, drive, size=0.40, radius=0.05)
    scene.draw(axes, 230)
    up = np.array([0, 0, 1])
    names = ("shaft 1", "shaft 2", "shaft 3", "shaft 4")
    for k, name in enumerate(names):
        middle = (place.points[k] + place.points[k + 1]) / 2
        lift = middle + 0.22 * up - (0.16 if k == 3 else 0.0) * place.axis[k]
        scene.arrow(axes, lift - 0.17 * place.axis[k], lift + 0.2 * place.axis[k], color=ACCENT, lw=1.8)
        scene.text(axes, lift + 0.11 * up, rf"$\mathbf{{a}}_{k + 1}$", color=ACCENT, size=15)
        spot = middle - (0.25 if k else 0.14) * up if k < 3 else middle + np.array([0.72, 0, -0.02])
        scene.text(axes, spot, name, size=12)
    scene.line(axes, place.points[0], place.points[0], marker="o", ms=5)
    scene.text(axes, place.points[0] - 0.21 * up - np.array([0.12, 0, 0]), "$B_0$  input.point", size=11)
    scene.line(axes, place.points[4], place.points[4], marker="o", ms=5)
    scene.text(axes, place.points[4] + 0.10 * up + np.array([0.42, 0, 0]), "$B_4$  output.point", size=11)
    for k in (1, 2, 3):
        point, before = place.points[k], place.axis[k - 1]
        scene.text(axes, point - 0.38 * up, f"joint {k}, $B_{k}$", size=12, weight="bold")
        scene.line(axes, point, point + 0.80 * before, color=PALE, lw=1.1, ls=(0, (5, 3)))
        middle = scene.arc(
            axes, point, place.normal[k - 1], before, float(place.joint_angle[k - 1]), 0.66, color=INK, lw=1.3
        )
        scene.text(axes, point + 0.80 * unit(middle - point), rf"$\alpha_{k}$", size=15)
    start = place.points[0] + 0.18 * place.axis[0]
    scene.arc(axes, start, place.axis[0], [0, -0.6, -0.8], np.deg2rad(250), 0.14, color="#a3004f", lw=2.0)
    origin = np.array([-0.95, 0, -0.62])
    for axis, name in zip(np.eye(3), "xyz", strict=True):
        scene.arrow(axes, origin, origin + 0.3 * axis, color=PALE, lw=1.2)
        scene.text(axes, origin + 0.37 * axis, f"${name}$", color=PALE, size=12)
    low, high = scene.flat([-1.25, 0, 0]), scene.flat([4.45, 0, 0])
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(-0.92, 0.66)
    return figure


def towards(angle: float) -> Array:
    """Return a direction across a shaft on paper, as seen along the power flow: clockwise from straight down."""
    return np.array([-np.sin(np.deg2rad(angle)), -np.cos(np.deg2rad(angle))])


def clock(axes: Any, title: str) -> None:
    """Prepare the view along the power flow: z up, y to the left, a positive turn runs with the clock."""
    bare(axes)
    t = np.linspace(0, 2 * np.pi, 200)
    axes.plot(np.cos(t), np.sin(t), color=PALE, lw=0.8, zorder=1)
    axes.set_xlim(-1.55, 1.55)
    axes.set_ylim(-1.55, 1.55)
    axes.set_title(title, size=11.5)


def pin(axes: Any, angle: float, colour: str, words: str) -> None:
    """Draw the pin line of a yoke with its two ears."""
    way = towards(angle)
    across = np.array([-way[1], way[0]])
    axes.plot(*np.array([-0.93 * way, 0.93 * way]).T, color=colour, lw=2.4, zorder=3, solid_capstyle="butt")
    out = 0.76 if colour == DRIVING else 0.46
    for sign in (-1, 1):
        ear = [sign * out * way + a * 0.2 * across + b * 0.13 * way for a, b in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
        axes.fill(*np.array(ear).T, color=colour, alpha=0.9, zorder=4)
    note(axes, 1.28 * way, words, color=colour, size=14)


def hub(axes: Any) -> None:
    """Draw the shaft end on, its arrow flying away from the reader."""
    t = np.linspace(0, 2 * np.pi, 100)
    axes.fill(0.24 * np.cos(t), 0.24 * np.sin(t), color=STEEL, zorder=6, ec=INK, lw=1)
    for sign in (-1, 1):
        axes.plot([-0.12, 0.12], [-0.12 * sign, 0.12 * sign], color=INK, lw=1.6, zorder=7)


def swept(axes: Any, start: float, angle: float, radius: float, words: str, colour: str = "#a3004f") -> None:
    """Draw a clockwise angle from a direction to another, named."""
    t = np.linspace(start, start + angle, 60)
    kit.curve(axes, np.array([radius * towards(a) for a in t]), color=colour, lw=2.0, zorder=8)
    note(axes, (radius + 0.24) * towards(start + angle / 2), words, color=colour, size=15, zorder=9)


def joint_angle() -> Figure:
    """Draw one joint with its plane, normal and in-plane directions, and the joint angle seen end on."""
    figure, (left, right) = page(10.5, 4.6, 1, 2, width_ratios=[1.7, 1])
    bare(left)
    drive = Drive.from_angles([32 * deg], start_phase=35 * deg)
    scene = Scene(swing=28, rise=26)
    place = solids(scene, drive, size=0.62, radius=0.09)
    scene.draw(left, 200)
    centre, normal = place.points[1], place.normal[0]
    before, after = place.axis
    inside = np.cross(normal, before)
    _place, u, v = pins(drive)
    scene.arrow(left, centre, centre + 0.95 * normal, color=ACCENT, lw=2)
    scene.text(left, centre + 1.08 * normal, r"$\mathbf{N}_1$", color=ACCENT, size=16)
    scene.arrow(left, centre, centre + 0.72 * inside, color=ACCENT, lw=2)
    scene.text(left, centre + 0.86 * inside, r"$\mathbf{p}_1^-$", color=ACCENT, size=16)
    scene.line(left, centre, centre + 1.15 * before, color=PALE, ls=(0, (5, 3)))
    middle = scene.arc(left, centre, normal, before, 32 * deg, 0.95, color=INK, lw=1.5)
    scene.text(left, centre + 1.13 * unit(middle - centre), r"$\alpha_1$", size=17)
    scene.line(left, centre - 0.62 * u[0], centre + 0.62 * u[0], color=DRIVING, lw=2.2)
    scene.text(left, centre - 0.78 * u[0], r"$\mathbf{u}_1$", color=DRIVING, size=16)
    scene.line(left, centre - 0.55 * v[0], centre + 0.55 * v[0], color=DRIVEN, lw=2.2)
    scene.text(left, centre + 0.70 * v[0], r"$\mathbf{v}_2$", color=DRIVEN, size=16)
    scene.arrow(left, centre - 0.92 * before + [0, 0, 0.22], centre - 0.55 * before + [0, 0, 0.22], color=ACCENT, lw=2)
    scene.text(left, centre - 0.74 * before + [0, 0, 0.34], r"$\mathbf{a}_1$", color=ACCENT, size=16)
    scene.arrow(left, centre + 0.6 * after + [0, 0, 0.20], centre + 0.95 * after + [0, 0, 0.20], color=ACCENT, lw=2)
    scene.text(left, centre + 0.85 * after + [0, 0, 0.36], r"$\mathbf{a}_2$", color=ACCENT, size=16)
    left.margins(0.03)
    low, high = scene.flat(centre - 1.05 * before), scene.flat(centre + 1.25 * before)
    left.set_xlim(low[0], high[0])
    left.set_ylim(-1.05, 0.75)
    clock(right, "looking along shaft 1")
    hub(right)
    arrow(right, (0, 0), 1.1 * towards(0), color=ACCENT, lw=2, zorder=2)
    note(right, 1.3 * towards(0), r"$\mathbf{p}_1^-$", color=ACCENT, size=15)
    arrow(right, (0, 0), 1.1 * towards(90), color=ACCENT, lw=2, zorder=2)
    note(right, 1.3 * towards(90), r"$\mathbf{N}_1$", color=ACCENT, size=15)
    pin(right, 35, DRIVING, r"$\mathbf{u}_1$")
    swept(right, 0, 35, 0.46, r"$\theta_1$")
    return figure


def plane_twist() -> Figure:
    """Draw the planes of two joints and the angle between them."""
    figure, (left, right) = page(10.5, 4.4, 1, 2, width_ratios=[1.9, 1])
    bare(left)
    drive = Drive.from_angles([35 * deg, 30 * deg], plane_twists=[50 * deg])
    scene = Scene(swing=16, rise=30)
    place = geometry(drive)
    points = place.points.copy()
    points[0] = points[1] - 0.9 * place.axis[0]
    points[2] = points[1] + 1.7 * place.axis[1]
    points[3] = points[2] + 0.9 * place.axis[2]
    for a, b in pairwise(points):
        scene.tube(a, b, 0.05)
    for point in points[1:-1]:
        scene.tube(point - 0.09 * unit([0.2, -1, 0.3]), point + 0.09 * unit([0.2, -1, 0.3]), 0.08, kit.CROSS)
    scene.draw(left, 200)
    for i, colour in ((1, "#6a3d9a"), (2, ACCENT)):
        corner, one, two = points[i], -place.axis[i - 1], place.axis[i]
        sheet = [corner + 0.9 * one, corner + 0.9 * one + 0.9 * two, corner + 0.9 * two, corner]
        left.fill(*np.array([scene.flat(p) for p in sheet]).T, color=colour, alpha=0.16, zorder=2)
        scene.text(
            left,
            corner + (0.62 * one + 0.5 * two if i == 1 else 0.72 * one + 0.9 * two - np.array([0.12, 0, 0.1])),
            f"plane of joint {i}",
            color=colour,
            size=11,
            halo=False,
        )
        scene.arrow(left, corner, corner + 0.66 * place.normal[i - 1], color=colour, lw=2.2)
        scene.text(left, corner + 0.80 * place.normal[i - 1], rf"$\mathbf{{N}}_{i}$", color=colour, size=16)
    at = points[2]
    scene.arrow(left, at, at + 0.66 * place.normal[0], color="#6a3d9a", lw=1.5, ls="--")
    middle = scene.arc(left, at, place.axis[1], place.normal[0], 50 * deg, 0.5, color="#a3004f", lw=2.2)
    scene.text(left, at + 0.66 * unit(middle - at), r"$\beta_2$", color="#a3004f", size=17)
    half = points[1] + 0.9 * place.axis[1]
    scene.arrow(
        left,
        half + np.array([-0.05, 0, 0.2]),
        half + 0.36 * place.axis[1] + np.array([-0.05, 0, 0.2]),
        color=ACCENT,
        lw=2,
    )
    scene.text(left, half + np.array([0.15, 0, 0.26]), r"$\mathbf{a}_2$", color=ACCENT, size=16)
    for k, words in ((0, "shaft 1"), (1, "shaft 2"), (2, "shaft 3")):
        spot = points[k] + (0.12 if k == 0 else 0.62 if k == 1 else 0.82) * (points[k + 1] - points[k])
        scene.text(left, spot - [0, 0, 0.17], words, size=11)
    flat = np.array([scene.flat(p) for p in points])
    left.set_xlim(flat[:, 0].min() - 0.15, flat[:, 0].max() + 0.25)
    left.set_ylim(flat[:, 1].min() - 0.35, flat[:, 1].max() + 0.7)
    clock(right, "looking along shaft 2")
    hub(right)
    for angle, colour, words in ((90, "#6a3d9a", r"$\mathbf{N}_1$"), (140, ACCENT, r"$\mathbf{N}_2$")):
        arrow(right, (0, 0), 1.1 * towards(angle), color=colour, lw=2.4, zorder=2)
        note(right, 1.3 * towards(angle), words, color=colour, size=15)
    swept(right, 90, 50, 0.75, r"$\beta_2$")
    return figure


def yoke_angle() -> Figure:
    """Draw an intermediate shaft with its two yokes, and the angle from the driving to the driven one."""
    figure, axes = page(11.6, 8.4, 2, 3, height_ratios=[1.35, 1])
    grid = axes[0, 0].get_gridspec()
    for each in axes[0]:
        each.remove()
    top = bare(figure.add_subplot(grid[0, :]))
    scene = Scene(swing=38, rise=16)
    gamma = 40 * deg
    start, end, along = np.zeros(3), np.array([2.6, 0, 0]), np.array([1.0, 0, 0])
    driving = np.array([0, 0, 1.0])
    driven = turn(driving, along, gamma)
    scene.tube(start + 0.38 * along, end - 0.38 * along, 0.10)
    scene.yoke(start, -along, driven, DRIVEN, 0.72)
    scene.yoke(end, along, driving, DRIVING, 0.72)
    scene.draw(top, 170)
    scene.line(top, start - 0.62 * driven, start + 0.62 * driven, color=DRIVEN, lw=2.4)
    scene.text(top, start + 0.76 * driven, r"$\mathbf{v}_2$", color=DRIVEN, size=17)
    scene.line(top, end - 0.62 * driving, end + 0.62 * driving, color=DRIVING, lw=2.4)
    scene.text(top, end + 0.74 * driving, r"$\mathbf{u}_2$", color=DRIVING, size=17)
    scene.line(top, start - 0.62 * driving, start + 0.62 * driving, color=DRIVING, lw=1.6, ls=(0, (4, 3)))
    scene.text(top, start + 0.74 * driving, "parallel to $\\mathbf{u}_2$", color=DRIVING, size=11)
    middle = scene.arc(top, start, along, driving, gamma, 0.52, color="#a3004f", lw=2.4)
    scene.text(top, start + 0.66 * unit(middle - start), r"$\gamma_2$", color="#a3004f", size=18)
    scene.arrow(top, 0.85 * along + [0, 0, 0.25], 1.75 * along + [0, 0, 0.25], color=ACCENT, lw=2.2)
    scene.text(top, 1.3 * along + [0, 0, 0.42], r"$\mathbf{a}_2$, power flow", color=ACCENT, size=14)
    note(
        top,
        np.add(scene.flat(start), (-1.15, 0.0)),
        "DRIVEN yoke\nat the START of the shaft,\nturned by joint 1",
        color=DRIVEN,
        size=11.5,
    )
    note(
        top,
        np.add(scene.flat(end), (1.15, 0.0)),
        "DRIVING yoke\nat the END of the shaft,\nturns joint 2",
        color=DRIVING,
        size=11.5,
    )
    top.set_xlim(scene.flat(start)[0] - 1.95, scene.flat(end)[0] + 1.95)
    top.set_ylim(-1.0, 1.12)
    cases = (
        (40, "yoke_angle_deg = 40\nor  yoke_lead_deg = −40"),
        (0, "yoke_angle_deg = 0\nears in line"),
        (90, "yoke_angle_deg = 90\nears crossed"),
    )
    for each, (angle, title) in zip(axes[1], cases, strict=True):
        clock(each, title)
        hub(each)
        pin(each, 180, DRIVING, r"$\mathbf{u}_2$" if angle else r"$\mathbf{u}_2$, $\mathbf{v}_2$")
        pin(each, 180 + angle, DRIVEN, r"$\mathbf{v}_2$" if angle else "")
        if angle:
            swept(each, 180, angle, 1.0, r"$\gamma_2$")
    return figure


def start_phase() -> Figure:
    """Draw the start phase of the input yoke for three values."""
    figure, axes = page(10.5, 4.0, 1, 3)
    for each, angle in zip(axes, (0, 40, 90), strict=True):
        clock(each, f"start_phase_deg = {angle}")
        hub(each)
        arrow(each, (0, 0), 1.08 * towards(0), color=ACCENT, lw=1.8, zorder=2)
        if angle:
            note(each, 1.28 * towards(0), r"$\mathbf{p}_1^-$", color=ACCENT, size=14)
        pin(each, angle, DRIVING, r"$\mathbf{u}_1$" + ("" if angle else r" on $\mathbf{p}_1^-$"))
        if angle:
            swept(each, 0, angle, 0.45, r"$\psi_1$")
        each.plot([0, 0], [-1.1, 1.3], color=ACCENT, lw=0.9, ls=(0, (6, 4)), zorder=0)
    note(axes[0], (0, 1.42), "plane of joint 1", color=ACCENT, size=10.5)
    return figure


def arrangements() -> Figure:
    """Draw the two planar arrangements with right yokes, and one with wrong yokes."""
    figure, axes = page(9.5, 7.6, 3, 1, height_ratios=[0.85, 1, 1])
    cases = (
        ("W:  plane_twist_deg = 0", 0.0, 0.0),
        ("Z:  plane_twist_deg = 180", 180.0, 0.0),
        ("Z with crossed yokes:  plane_twist_deg = 180, yoke_angle_deg = 90", 180.0, 90.0),
    )
    for each, (title, twist, yoke) in zip(axes, cases, strict=True):
        bare(each)
        drive = Drive.from_angles([20 * deg, 20 * deg], plane_twists=[twist * deg], yoke_angles=[yoke * deg])
        points = geometry(drive).points.copy()
        axis = geometry(drive).axis
        points[0] = points[1] - 0.8 * axis[0]
        points[2] = points[1] + 1.8 * axis[1]
        points[3] = points[2] + 0.8 * axis[2]
        tilt = 0.0 if twist else -20 * deg
        points = np.array([turn(point, [0.0, 1.0, 0.0], tilt) for point in points])
        shown = Drive.from_points(points, yoke_angles=[yoke * deg])
        scene = Scene(swing=14, rise=14)
        solids(scene, shown, size=0.42, radius=0.055)
        scene.draw(each, 200)
        delta = float(equivalent_joint(drive).speed_fluctuation)
        verdict = "turns evenly" if delta < 1e-12 else f"speed fluctuation {100 * delta:.1f} %"
        each.set_title(f"{title}   →   {verdict}", size=12, color=INK if delta < 1e-12 else "#b00020", loc="left")
        middle = scene.flat((points[1] + points[2]) / 2)
        each.set_xlim(middle[0] - 1.95, middle[0] + 1.95)
    return figure


def slopes() -> Figure:
    """Draw the senses of side and plan slope."""
    figure, axes = page(10.5, 2.9, 1, 2)
    for each, name, up, words in zip(
        axes,
        ("side_slope", "plan_slope"),
        ("z", "y"),
        ("side view, from the right", "plan view, from above"),
        strict=True,
    ):
        bare(each)
        each.set_title(words, size=12)
        each.plot([0, 2.6], [0, 0], color=PALE, ls=(0, (5, 3)), lw=1.1)
        arrow(each, (0, 0), (2.5, 0.95), color=INK, lw=3)
        arc(each, (0, 0), 1.55, 0, np.rad2deg(np.arctan2(0.95, 2.5)), color="#a3004f", lw=2)
        note(each, (2.05, 0.32), f"+ {name}", color="#a3004f", size=13)
        arrow(each, (-0.45, -0.25), (0.25, -0.25), color=PALE)
        note(each, (0.36, -0.25), "$x$", color=PALE, size=13)
        arrow(each, (-0.45, -0.25), (-0.45, 0.45), color=PALE)
        note(each, (-0.45, 0.57), f"${up}$", color=PALE, size=13)
        each.set_xlim(-0.7, 3.0)
        each.set_ylim(-0.45, 1.15)
    return figure


PICTURES = {
    "overview": overview,
    "joint_angle": joint_angle,
    "plane-twist": plane_twist,
    "yoke-angle": yoke_angle,
    "start-phase": start_phase,
    "arrangements": arrangements,
    "slopes": slopes,
}
