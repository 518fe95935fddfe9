"""Pictures of the kinds of joints: what each looks like, and how its output runs ahead over a turn."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cardan.drive.joints import clemens as profile_coupling
from cardan.drive.joints import pin_coupling
from cardan.drive.joints import weiss as offset_grooves
from cardan.joints import (
    Clemens,
    ClemensProfile,
    DoubleCardan,
    ElasticHalfCardan,
    HalfCardan,
    Hooke,
    Joint,
    OffsetCross,
    PinCoupling,
    Rzeppa,
    Tracta,
    Tripod,
    Weiss,
)
from cardan.questions.motion.joint_law import joint_turn
from cardan.units import deg, mm

from .kit import ACCENT, CROSS, DRIVEN, DRIVING, INK, PALE, STEEL, Scene, bare, note, page, turn, unit

Array = Any

X, Y, Z = np.eye(3)


def way(joint_angle: float) -> Array:
    """Return the direction of the output shaft of a joint whose input shaft comes along x, bent downwards."""
    return np.array([np.cos(joint_angle), 0.0, -np.sin(joint_angle)])


def arms(joint_angle: float, angle: float) -> tuple[Array, Array, Array]:
    """Return driving pin, driven pin and output direction of a Hooke joint at the origin."""
    out = way(joint_angle)
    one = turn(Z, X, angle)
    return one, unit(np.cross(out, one)), out


def beside(joint: Joint, joint_angle: float, draw: Callable[[Axes], None], least: float = 0.1) -> Figure:
    """Draw a joint, and beside it how its output runs ahead over a turn [°]."""
    figure, (left, right) = page(9.6, 2.9, 1, 2, width_ratios=(1.15, 1.0))
    bare(left)
    draw(left)
    found = joint_turn(joint, joint_angle)
    right.axhline(0, color=PALE, lw=0.8)
    right.plot(found.angle / deg, found.angle_error / deg, color=ACCENT, lw=2.2)
    reach = max(1.15 * float(np.max(np.abs(found.angle_error))) / deg, least)
    right.set_ylim(-reach, reach)
    right.set_xlim(0, 360)
    right.set_xticks(range(0, 361, 90))
    right.set_xlabel("input angle [°]")
    right.set_ylabel(f"output ahead at {joint_angle / deg:g}° [°]")
    return figure


def solid(build: Callable[[Scene], None], swing: float = 22.0) -> Callable[[Axes], None]:
    """Return a drawing of solids."""

    def draw(axes: Axes) -> None:
        scene = Scene(swing=swing, rise=20)
        build(scene)
        scene.draw(axes, 150.0)

    return draw


def hooke() -> Figure:
    """Draw a Hooke joint."""

    def build(scene: Scene) -> None:
        one, other, out = arms(28 * deg, 20 * deg)
        scene.tube(-1.25 * X, -0.5 * X, 0.09)
        scene.tube(0.5 * out, 1.25 * out, 0.09)
        scene.yoke(0 * X, X, one, DRIVING, 0.95)
        scene.yoke(0 * X, -out, other, DRIVEN, 0.95)
        scene.cross(0 * X, one, other, 0.95)

    return beside(Hooke(), 28 * deg, solid(build))


def offset_cross() -> Figure:
    """Draw a cross whose pins stand apart, and the ball through which the output shaft slides."""

    def build(scene: Scene) -> None:
        joint_angle, e, reach = 28 * deg, 0.3, 1.35
        one, other, out = arms(joint_angle, 35 * deg)
        foot = e * unit(np.cross(one, other))
        shaft = unit(reach * out - foot)
        scene.tube(-1.3 * X, -0.5 * X, 0.09)
        scene.yoke(0 * X, X, one, DRIVING, 0.9)
        scene.tube(-0.4 * one, 0.4 * one, 0.075, CROSS, 20)
        scene.tube(0 * X, foot, 0.06, CROSS, 20)
        scene.tube(foot - 0.4 * other, foot + 0.4 * other, 0.075, CROSS, 20)
        scene.yoke(foot, -shaft, other, DRIVEN, 0.9)
        scene.tube(foot + 0.48 * shaft, foot + 1.45 * shaft, 0.07)
        scene.tube(reach * out - 0.09 * shaft, reach * out + 0.09 * shaft, 0.2, ACCENT)

    return beside(OffsetCross(offset=20 * mm, reach=0.5), 28 * deg, solid(build))


def double_cardan() -> Figure:
    """Draw two joints with a short middle."""

    def build(scene: Scene) -> None:
        half, gap = 18 * deg, 0.9
        middle, out = way(half), way(2 * half)
        end = gap * middle
        one = turn(Z, X, 15 * deg)
        other = unit(np.cross(middle, one))
        last = unit(np.cross(out, other))
        scene.tube(-1.2 * X, -0.4 * X, 0.08)
        scene.tube(end + 0.4 * out, end + 1.2 * out, 0.08)
        scene.yoke(0 * X, X, one, DRIVING, 0.75)
        scene.yoke(0 * X, -middle, other, DRIVEN, 0.75)
        scene.yoke(end, middle, other, DRIVING, 0.75)
        scene.yoke(end, -out, last, DRIVEN, 0.75)
        scene.cross(0 * X, one, other, 0.75)
        scene.cross(end, other, last, 0.75)

    return beside(DoubleCardan(centring_ratio=0.5), 36 * deg, solid(build))


def shafts(axes: Axes, joint_angle: float, size: float = 2.0) -> tuple[Array, Array]:
    """Draw two shafts in their plane and return their directions from the crossing, away from the joint."""
    ways = np.array([-1.0, 0.0]), np.array([np.cos(joint_angle), -np.sin(joint_angle)])
    for one, colour in zip(ways, (DRIVING, DRIVEN), strict=True):
        axes.plot(*np.outer(one, [0.75 * size, 1.25 * size]), color=colour, lw=7, solid_capstyle="butt")
        axes.plot(*np.outer(one, [-0.2 * size, 1.35 * size]), color=PALE, lw=0.8, ls=(0, (8, 3, 2, 3)))
    half = unit(ways[0] - ways[1])
    across = np.array([-half[1], half[0]])
    axes.plot(*np.outer(across, [-1.25, 1.25]), color=ACCENT, lw=1.2, ls=(0, (5, 3)))
    return ways


def tracta() -> Figure:
    """Draw the two forks of a Tracta joint and the plane of its tongue through their centres."""

    def draw(axes: Axes) -> None:
        one, two = shafts(axes, 40 * deg)
        near, far = 0.8 * one, 0.84 * two
        for end, toward, colour in ((near, one, DRIVING), (far, two, DRIVEN)):
            side = np.array([-toward[1], toward[0]])
            for sign in (1, -1):
                ends = np.stack([1.55 * toward + 0.3 * sign * side, end + 0.42 * sign * side], -1)
                axes.plot(*ends, color=colour, lw=6, solid_capstyle="round")
            circle = 0.34 * np.exp(1j * np.linspace(0, 2 * np.pi, 80))
            axes.fill(end[0] + circle.real, end[1] + circle.imag, color=STEEL, ec=INK, lw=1.2, zorder=3)
        axes.plot(
            *np.stack([near + 0.55 * unit(near - far), far + 0.55 * unit(far - near)], -1), color=INK, lw=2.5, zorder=4
        )
        note(axes, np.add(near, [0, -0.6]), "A", size=12)
        note(axes, np.add(far, [-0.25, -0.55]), "B", size=12)
        note(axes, (0.05, 0.2), "tongue", size=11)

    return beside(Tracta(driving_distance=20 * mm, driven_distance=21 * mm), 40 * deg, draw)


def rzeppa() -> Figure:
    """Draw a Rzeppa joint cut along the plane of its shafts: two races with grooves, balls in the bisecting plane."""

    def draw(axes: Axes) -> None:
        one, two = shafts(axes, 36 * deg)
        t = np.linspace(-np.pi, np.pi, 400)
        ring = np.stack([np.cos(t), np.sin(t)])
        for toward, radius, reach, colour in ((one, 0.85, 0.75, DRIVING), (two, 1.25, 0.55, DRIVEN)):
            part = radius * ring
            part[:, np.abs(toward @ ring) > reach] = np.nan
            axes.plot(*part, color=colour, lw=5)
        axes.plot(*np.outer(one, [0.6, 1.6]), color=DRIVING, lw=7, solid_capstyle="butt")
        across = unit(np.array([one[1] - two[1], two[0] - one[0]]))
        for sign in (1, -1):
            axes.fill(*((1.05 * sign * across)[:, None] + 0.19 * ring), color=STEEL, ec=INK, lw=1.2, zorder=4)

    return beside(Rzeppa(lever_b=0.35, lever_c=0.65), 36 * deg, draw, 1e-7)


def weiss() -> Figure:
    """Draw the grooves of a Weiss joint crossing in its balls."""

    def draw(axes: Axes) -> None:
        joint_angle, c, radius = 36 * deg, 0.45, 1.15
        one, two = shafts(axes, joint_angle)
        t = np.linspace(-np.pi, np.pi, 400)
        for toward, colour in ((one, DRIVING), (two, DRIVEN)):
            ring = (c * toward)[:, None] + radius * np.stack([np.cos(t), np.sin(t)])
            away = toward @ ring < 0.72
            ring[:, ~away] = np.nan
            axes.plot(*ring, color=colour, lw=3)
            axes.plot(*(c * toward), "+", color=colour, ms=10, mew=2)
        for angle in (0.0, np.pi):
            height, out = (float(v) for v in offset_grooves.ball_centre(angle, joint_angle, c, c, radius))
            ball = height * one + out * np.array([0.0, -np.cos(angle)])
            axes.fill(*(ball[:, None] + 0.2 * np.stack([np.cos(t), np.sin(t)])), color=STEEL, ec=INK, lw=1.2, zorder=4)

    return beside(Weiss(driving_offset=6 * mm, driven_offset=5.5 * mm, groove_radius=30 * mm), 36 * deg, draw)


def tripod() -> Figure:
    """Draw a tripod: three rollers of the spider in the tracks of the housing."""

    def build(scene: Scene) -> None:
        joint_angle, radius = 22 * deg, 0.55
        out = way(joint_angle)
        for k in range(3):
            arm = turn(Z, X, 30 * deg + k * 120 * deg)
            track = radius * arm
            side = np.cross(X, arm)
            for sign in (1, -1):
                bar = track + 0.16 * sign * side
                scene.tube(bar - 0.35 * X, bar + 0.3 * X, 0.045, DRIVING, 16)
            place = track + (track @ out) * -X / (X @ out)
            scene.tube(0 * X, place * 1.15, 0.06, DRIVEN, 20)
            scene.tube(place - 0.07 * unit(place), place + 0.07 * unit(place), 0.13, STEEL)
        scene.tube(-0.42 * X, -0.34 * X, 0.75, DRIVING)
        scene.tube(-1.2 * X, -0.42 * X, 0.09)
        scene.tube(0 * X, 1.3 * out, 0.09)

    return beside(Tripod(track_radius=20 * mm), 22 * deg, solid(build, -28.0))


def half_cardan() -> Figure:
    """Draw a square tongue in a square bell."""

    def build(scene: Scene) -> None:
        out = way(7 * deg)
        up = unit(np.cross(out, np.cross(Z, out)))
        side = np.cross(out, up)
        square = 0.3 * np.array([up + side, side - up, -up - side, up - side])
        scene.tube(-1.2 * X, -0.35 * X, 0.1)
        scene.tube(-0.45 * X, -0.36 * X, 0.5, DRIVING)
        for across in (Z, -Z, Y):
            other = np.cross(X, across)
            plate = np.array(
                [0.36 * across + a * 0.42 * other for a in (1, -1)]
                + [0.46 * across - 0.42 * other, 0.46 * across + 0.42 * other]
            )
            scene.extrude(plate - 0.36 * X, 0.72 * X, DRIVING)
        scene.extrude(square - 0.3 * out, 0.62 * out, DRIVEN)
        scene.tube(0.3 * out, 1.3 * out, 0.1)

    return beside(HalfCardan(pairs=2), 5 * deg, solid(build), 0.12)


def elastic_half_cardan() -> Figure:
    """Draw a disc of rubber between two flanges with three arms each."""

    def build(scene: Scene) -> None:
        out = way(6 * deg)
        t = np.linspace(0, 2 * np.pi, 60, endpoint=False)[:, None]
        middle = unit(X + out)
        up = unit(np.cross(middle, np.cross(Z, middle)))
        ring = 0.62 * (np.cos(t) * up + np.sin(t) * np.cross(middle, up))
        scene.extrude(ring - 0.09 * middle, 0.18 * middle, "#3f4a55")
        for axis, colour, sign, shift in ((X, DRIVING, -1.0, 0.0), (out, DRIVEN, 1.0, 60 * deg)):
            for k in range(3):
                arm = turn(unit(np.cross(axis, np.cross(Z, axis))), axis, shift + k * 120 * deg)
                foot = 0.19 * sign * axis
                scene.tube(foot, foot + 0.5 * arm, 0.1, colour, 20)
                scene.tube(
                    foot + 0.45 * arm - 0.04 * sign * axis, foot + 0.45 * arm - 0.34 * sign * axis, 0.055, STEEL, 16
                )
            scene.tube(0.1 * sign * axis, 0.28 * sign * axis, 0.2, colour)
            scene.tube(0.28 * sign * axis, 1.2 * sign * axis, 0.09)

    return beside(ElasticHalfCardan(pairs=3), 6 * deg, solid(build), 1e-6)


def pins() -> Figure:
    """Draw two slanting pins that touch in the bisecting plane."""

    def build(scene: Scene) -> None:
        joint_angle, slant, a = 40 * deg, 42 * deg, 0.62
        phi = 115 * deg
        away = np.array([-1.0, 0, 0]), way(joint_angle)
        found = pin_coupling.pin_contact(phi, joint_angle, a, a, slant, slant)
        inner = np.array([0.0, 0, -1]), -np.array([np.sin(joint_angle), 0, np.cos(joint_angle)])
        for axis, low, about, colour in zip(away, inner, (away[0], -away[1]), (DRIVING, DRIVEN), strict=True):
            pin = turn(-np.cos(slant) * axis + np.sin(slant) * low, about, phi)
            scene.tube(a * axis - 0.04 * axis, 1.9 * axis, 0.1, STEEL)
            scene.tube(a * axis, a * axis + (float(found.first) + 0.3) * pin, 0.065, colour, 24)

    return beside(
        PinCoupling(driving_slant=42 * deg, driven_slant=43 * deg, driving_distance=50 * mm, driven_distance=51 * mm),
        40 * deg,
        solid(build),
    )


def clemens() -> Figure:
    """Draw the hinged arms of a Clemens coupling and the ball in which they meet."""

    def build(scene: Scene) -> None:
        joint_angle, phi = 36 * deg, 110 * deg
        circle = profile_coupling.Circle(axial=0.85, radial=0.2, radius=1.05)
        found = profile_coupling.profile_contact(phi, joint_angle, circle, circle)
        away = np.array([-1.0, 0, 0]), way(joint_angle)
        inner = np.array([0.0, 0, -1]), -np.array([np.sin(joint_angle), 0, np.cos(joint_angle)])
        for axis, low, about, colour in zip(away, inner, (away[0], -away[1]), (DRIVING, DRIVEN), strict=True):
            out = turn(low, about, phi)
            hinge = 0.85 * axis + 0.2 * out
            side = np.cross(axis, out)
            end = float(found.height1) * axis + float(found.radius1) * out
            scene.tube(0.7 * axis, 1.9 * axis, 0.1, STEEL)
            scene.tube(hinge - 0.16 * side, hinge + 0.16 * side, 0.09, colour, 24)
            scene.tube(hinge, end, 0.055, colour, 24)
            scene.tube(end - 0.06 * unit(end - hinge), end + 0.06 * unit(end - hinge), 0.12, ACCENT, 30)

    return beside(
        Clemens(
            driving=ClemensProfile(axial=60 * mm, radial=10 * mm, radius=75 * mm),
            driven=ClemensProfile(axial=61 * mm, radial=10 * mm, radius=75 * mm),
        ),
        36 * deg,
        solid(build),
    )


PICTURES = {
    "joint-hooke": hooke,
    "joint-offset-cross": offset_cross,
    "joint-double-cardan": double_cardan,
    "joint-tracta": tracta,
    "joint-rzeppa": rzeppa,
    "joint-weiss": weiss,
    "joint-tripod": tripod,
    "joint-half-cardan": half_cardan,
    "joint-elastic-half-cardan": elastic_half_cardan,
    "joint-pin-coupling": pins,
    "joint-clemens": clemens,
}
