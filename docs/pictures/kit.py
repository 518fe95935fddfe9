"""Small drawing kit of these pages: solids with hidden surfaces, drawn by a depth buffer, and drawing-office marks."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

import matplotlib
import matplotlib.patheffects
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

Array = Any

INK, PALE, ACCENT = "#1f2933", "#8a94a0", "#00796b"
DRIVING, DRIVEN, STEEL, CROSS = "#d55e00", "#0072b2", "#c3cad1", "#4b5560"
"""A yoke that gives the turn is orange, one that takes it is blue, in every picture."""

STYLE = {
    "font.family": "DejaVu Sans",
    "font.size": 11,
    "mathtext.fontset": "stix",
    "svg.fonttype": "path",
    "svg.hashsalt": "cardan",
    "axes.edgecolor": PALE,
    "axes.labelcolor": INK,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "xtick.color": INK,
    "ytick.color": INK,
    "text.color": INK,
    "legend.frameon": False,
    "path.simplify": True,
    "image.composite_image": False,
}
SERIES = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9")


def page(width: float, height: float, rows: int = 1, columns: int = 1, **options: Any) -> tuple[Figure, Any]:
    """Return a figure without any window behind it, and its axes."""
    with matplotlib.rc_context(STYLE):
        figure = Figure(figsize=(0.82 * width, 0.82 * height), layout="constrained")
        FigureCanvasAgg(figure)
        return figure, figure.subplots(rows, columns, **options)


def bare(axes: Axes) -> Axes:
    """Return axes without frame, equal scales: a drawing, not a diagram."""
    axes.set_aspect("equal")
    axes.axis("off")
    return axes


def unit(v: Array) -> Array:
    """Return a vector of length one."""
    v = np.asarray(v, dtype=float)
    return v / np.linalg.norm(v)


def turn(v: Array, axis: Array, angle: float) -> Array:
    """Turn a vector about a unit axis by the right-hand rule."""
    v, axis = np.asarray(v, dtype=float), np.asarray(axis, dtype=float)
    return np.cos(angle) * v + np.sin(angle) * np.cross(axis, v) + (1 - np.cos(angle)) * (axis @ v) * axis


@dataclass
class Scene:
    """Solids, seen without perspective by an eye at the right of the drive (from -y), swung and raised."""

    swing: float = 25.0
    rise: float = 20.0
    triangles: list[Array] = field(default_factory=list)
    colours: list[Any] = field(default_factory=list)
    parts: list[int] = field(default_factory=list)

    @property
    def basis(self) -> Array:
        """Rows: right, up, towards the eye."""
        s, r = np.deg2rad(self.swing), np.deg2rad(self.rise)
        eye = np.array([-np.sin(s) * np.cos(r), -np.cos(s) * np.cos(r), np.sin(r)])
        right = unit(np.cross([0, 0, 1], eye)) if abs(eye[2]) < 0.999 else np.array([1.0, 0, 0])
        return np.array([right, np.cross(eye, right), eye])

    def flat(self, point: Array) -> Array:
        """Return where a point of space stands on paper."""
        return np.asarray(point, dtype=float) @ self.basis[:2].T

    def add(self, triangles: Iterable[Array], colour: str) -> None:
        """Add one part."""
        part = (self.parts[-1] + 1) if self.parts else 1
        rgb = matplotlib.colors.to_rgb(colour)
        for triangle in triangles:
            self.triangles.append(np.asarray(triangle, dtype=float))
            self.colours.append(rgb)
            self.parts.append(part)

    def extrude(self, outline: Array, way: Array, colour: str) -> None:
        """Add a prism over a flat outline (m, 3), which must be star-shaped from its middle."""
        low = np.asarray(outline, dtype=float)
        high, n = low + way, len(outline)
        tris = []
        for k in range(n):
            j = (k + 1) % n
            tris += [(low[k], low[j], high[j]), (low[k], high[j], high[k])]
            tris += [(low.mean(0), low[j], low[k]), (high.mean(0), high[k], high[j])]
        self.add(tris, colour)

    def tube(self, start: Array, end: Array, radius: float, colour: str = STEEL, sides: int = 40) -> None:
        """Add a round bar."""
        axis = unit(np.subtract(end, start))
        across = unit(np.cross(axis, [0.3, 0.5, 1.0]))
        other = np.cross(axis, across)
        t = np.linspace(0, 2 * np.pi, sides, endpoint=False)[:, None]
        self.extrude(
            np.asarray(start) + radius * (np.cos(t) * across + np.sin(t) * other), np.subtract(end, start), colour
        )

    def yoke(self, centre: Array, inward: Array, pin: Array, colour: str, size: float = 1.0) -> None:
        """Add a fork whose two tines hold the cross along ``pin``; ``inward`` points from its shaft to the joint."""
        centre, inward, pin = np.asarray(centre, dtype=float), unit(inward), unit(pin)
        side = np.cross(inward, pin)
        half, thick, foot = 0.30 * size, 0.11 * size, 0.44 * size
        t = np.linspace(-np.pi / 2, np.pi / 2, 15)[:, None]
        tip = half * 0.62 * (np.cos(t) * inward + np.sin(t) * side)
        back = np.array([-foot * inward + half * 0.72 * side, -foot * inward - half * 0.72 * side])
        for sign in (1, -1):
            inner = centre + sign * half * pin
            self.extrude(inner + np.vstack([tip, back]), sign * thick * pin, colour)
        reach, deep = half + thick, 0.16 * size
        corner = centre - foot * inward
        box = [corner + a * reach * pin + b * half * 0.72 * side for a, b in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
        self.extrude(np.array(box), -deep * inward, colour)

    def cross(self, centre: Array, one: Array, other: Array, size: float = 1.0) -> None:
        """Add the cross with its two arms."""
        for arm in (unit(one), unit(other)):
            self.tube(centre - 0.425 * size * arm, centre + 0.425 * size * arm, 0.085 * size, CROSS, 20)

    def draw(self, axes: Axes, resolution: float = 90.0, outline: bool = True) -> None:
        """Draw all solids, hidden surfaces hidden, as one picture."""
        step = 1.0 / (2 * resolution)
        tris = np.asarray(self.triangles) @ self.basis.T
        low = tris[..., :2].min((0, 1)) - 6 * step
        cells = np.ceil((tris[..., :2].max((0, 1)) + 6 * step - low) / step).astype(int)
        width, height = (int(c) + int(c) % 2 for c in cells)
        depth = np.full((height, width), -np.inf)
        part = np.zeros((height, width), int)
        face = np.zeros((height, width, 3))
        shade = np.ones((height, width, 3))
        lamp = unit([-0.35, 0.55, 0.75])
        for tri, colour, number in zip(tris, self.colours, self.parts, strict=True):
            normal = np.cross(tri[1] - tri[0], tri[2] - tri[0])
            length = np.linalg.norm(normal)
            if length < 1e-12 or abs(normal[2]) < 1e-9 * length:
                continue
            normal = normal / length * np.sign(normal[2])
            xy = (tri[:, :2] - low) / step
            x0, y0 = np.floor(xy.min(0)).astype(int)
            x1, y1 = np.ceil(xy.max(0)).astype(int) + 1
            gx, gy = np.meshgrid(np.arange(x0, x1) + 0.5, np.arange(y0, y1) + 0.5)
            (ax, ay), (bx, by), (cx, cy) = xy
            area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
            if abs(area) < 1e-9:
                continue
            b = ((gx - ax) * (cy - ay) - (gy - ay) * (cx - ax)) / area
            c = ((bx - ax) * (gy - ay) - (by - ay) * (gx - ax)) / area
            inside = (b >= -1e-6) & (c >= -1e-6) & (b + c <= 1 + 1e-6)
            z = tri[0, 2] + b * (tri[1, 2] - tri[0, 2]) + c * (tri[2, 2] - tri[0, 2])
            window = (slice(y0, y1), slice(x0, x1))
            seen = inside & (z > depth[window])
            depth[window][seen] = z[seen]
            part[window][seen] = number
            face[window][seen] = normal
            shade[window][seen] = np.clip(np.asarray(colour) * (0.55 + 0.5 * max(normal @ lamp, 0.0)), 0, 1)
        alpha = (part > 0).astype(float)
        if outline:
            edge = np.zeros_like(part, bool)
            for rows, columns in ((1, 0), (0, 1)):
                a = (slice(rows, None), slice(columns, None))
                b_ = (slice(None, height - rows), slice(None, width - columns))
                with np.errstate(invalid="ignore"):
                    jump = np.abs(depth[a] - depth[b_]) > 12 * step
                crease = (face[a] * face[b_]).sum(-1) < 0.75
                differs = (part[a] != part[b_]) | jump | (crease & (part[a] > 0) & (part[b_] > 0))
                edge[a] |= differs
                edge[b_] |= differs
            shade[edge], alpha[edge] = matplotlib.colors.to_rgb(INK), 1.0
        image = np.dstack([shade * alpha[..., None], alpha])
        image = image.reshape(height // 2, 2, width // 2, 2, 4).mean((1, 3))
        with np.errstate(invalid="ignore", divide="ignore"):
            image[..., :3] = np.where(image[..., 3:] > 0, image[..., :3] / image[..., 3:], 1.0)
        high = low + np.array([width, height]) * step
        axes.imshow(
            np.clip(image, 0, 1),
            origin="lower",
            extent=(low[0], high[0], low[1], high[1]),
            zorder=1,
            interpolation="bilinear",
        )
        axes.set_xlim(low[0], high[0])
        axes.set_ylim(low[1], high[1])

    def line(self, axes: Axes, *points: Array, **style: Any) -> None:
        """Draw a line in space over the solids."""
        flat = np.array([self.flat(p) for p in points])
        axes.plot(*flat.T, **{"color": INK, "lw": 1.0, "zorder": 4, "solid_capstyle": "round"} | style)

    def arrow(self, axes: Axes, start: Array, end: Array, **style: Any) -> None:
        """Draw an arrow in space."""
        arrow(axes, self.flat(start), self.flat(end), **style)

    def arc(
        self, axes: Axes, centre: Array, axis: Array, start: Array, angle: float, radius: float, **style: Any
    ) -> Array:
        """Draw an arc arrow about an axis, from ``start`` on; return the point in its middle, in space."""
        t = np.linspace(0, angle, 60)
        ring = np.array([np.asarray(centre) + radius * turn(unit(start), unit(axis), a) for a in t])
        curve(axes, np.array([self.flat(p) for p in ring]), **style)
        return ring[30]

    def text(self, axes: Axes, point: Array, words: str, **style: Any) -> None:
        """Write at a point in space."""
        note(axes, self.flat(point), words, **style)


def note(axes: Axes, point: Sequence[float], words: str, **style: Any) -> None:
    """Write at a point of the paper, legible over lines."""
    options = {"ha": "center", "va": "center", "zorder": 8, "color": INK} | style
    halo = options.pop("halo", True)
    item = axes.text(point[0], point[1], words, **options)
    if halo:
        item.set_path_effects([matplotlib.patheffects.withStroke(linewidth=3.0, foreground="white", alpha=0.9)])


def arrow(axes: Axes, start: Array, end: Array, **style: Any) -> None:
    """Draw a straight arrow on paper."""
    options = {"color": INK, "lw": 1.4, "zorder": 5} | style
    head = options.pop("head", "-|>")
    axes.annotate(
        "",
        xy=end,
        xytext=start,
        zorder=options.pop("zorder"),
        arrowprops=dict(arrowstyle=head, shrinkA=0, shrinkB=0, mutation_scale=12, **options),
    )


def curve(axes: Axes, points: Array, **style: Any) -> None:
    """Draw a curve with an arrow head at its end."""
    options = {"color": ACCENT, "lw": 1.8, "zorder": 6} | style
    head = options.pop("head", True)
    axes.plot(*points.T, **options, solid_capstyle="butt")
    if head:
        at = max(len(points) - 8, 0)
        arrow(axes, points[at], points[-1], color=options["color"], lw=options["lw"] * 0.6, zorder=options["zorder"])


def arc(axes: Axes, centre: Sequence[float], radius: float, start: float, angle: float, **style: Any) -> Array:
    """Draw an arc arrow on paper, angles in degrees against the clock; return the point in its middle."""
    t = np.deg2rad(np.linspace(start, start + angle, 60))
    points = np.asarray(centre) + radius * np.stack([np.cos(t), np.sin(t)], -1)
    curve(axes, points, **style)
    return points[30]
