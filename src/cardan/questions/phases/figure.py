"""What the yoke angles can do: the phase polygon before and after, what each setting leaves, how exact it must be."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from cardan.answers.palette import dash_of, shaft
from cardan.answers.quantity import Quantity, say
from cardan.catalogue.completion import sized
from cardan.drive.bodies.solids import solids
from cardan.figures.axes import axis, clear_way, steps, written
from cardan.figures.drive import views_figure
from cardan.figures.figure import Axis, Band, Bars, Curve, Figure, Note, Panel, Row, Rule, Series
from cardan.maths.arrays import Array
from cardan.maths.kernel import mobius
from cardan.maths.ties import foremost
from cardan.questions.motion.equivalence import SPECK, SYNCHRONOUS
from cardan.texts import _
from cardan.units import deg

from .layout import Layout
from .phases import Phasing, YokeSetting

FLAT = 1e-6
"""Below this growth of δ a yoke that stands a degree off costs next to nothing."""


def phasing_figures(found: Phasing) -> tuple[Figure, ...]:
    """Return the figures of a phasing."""
    made = [] if found.followed else [polygon_figure(found)]
    made += [steering_figure(found)] if found.steering else []
    if not found.settings:
        return tuple(made)
    if max(one.speed_fluctuation for one in _compared(found)) > SYNCHRONOUS:
        made.append(settings_figure(found))
    if len(found.settings[0].one_off) > 1 and float(np.max(found.settings[0].one_off)) > FLAT:
        made.append(sensitivity_figure(found))
    return tuple(made)


def _compared(found: Phasing) -> list[YokeSetting]:
    return [found.as_built, *found.settings[:4], *found.spline_settings[:3]]


def polygon_figure(found: Phasing) -> Figure:
    """Return the phase polygon as built and with the best yoke angles, in the Poincaré disk."""
    shown = [found.as_built, *found.settings[:1]]
    if len(found.settings) > 1 and len(found.as_built.vertex) > 3:
        shown = [*shown, found.settings[1]]
    reach = max(float(np.max(np.abs(one.vertex))) for one in shown)
    reach = 1.1 * max(reach, 1e-4)
    panels = tuple(_disk(one, reach, named=k == 0, best=k > 0) for k, one in enumerate(shown))
    while len(panels) < 3:
        panels = (*panels, Panel(series=(), bare=True))
    best = found.settings[0].speed_fluctuation if found.settings else found.as_built.speed_fluctuation
    if best < SPECK:
        text = _("As specified the path ends {start} from the middle; with the yokes phased it comes back to it.")
    else:
        text = _(
            "As specified the path ends {start} from the middle, with the best yokes {end}: one side is too long for "
            "the others to close."
        )
    if best < SYNCHRONOUS and found.as_built.speed_fluctuation < SYNCHRONOUS:
        text = _("The path comes back to the middle as specified.")
    elif found.as_built.speed_fluctuation < SPECK < found.speed_fluctuation_max:
        text = _("But for the rounding of the drive's figures the path comes back to the middle as specified.")
    elif found.as_built.speed_fluctuation - best < SYNCHRONOUS:
        text = _(
            "The path ends {start} from the middle and no yokes bring it nearer: one side is too long for the others."
        )
    if not found.settings:
        text = _("One joint is one side: its path cannot come back to the middle.")
    return Figure(
        name="polygon",
        title=_("Phase polygon"),
        sentence=say(
            text, start=Quantity(found.as_built.speed_fluctuation, "share", 3), end=Quantity(best, "share", 3)
        ),
        source=_(
            "Poincaré disk: side k is joint k, length −ln cos α, turned by the yoke angles; corners −b/a of the matrix "
            "product; rings of equal δ"
        ),
        rows=(Row(panels=panels, height=2.15),),
        aside=True,
    )


def _disk(one: YokeSetting, reach: float, *, named: bool, best: bool) -> Panel:
    rings: list[Series] = []
    top = _share(reach)
    shares = steps(0.0, 100.0 * top, 3)[1:]
    radii = [math.tanh(0.5 * math.asinh(0.005 * share)) for share in shares]
    pairs = zip(one.vertex, one.vertex[1:], strict=False)
    drawn = np.concatenate([[0.0], *(_side(complex(start), complex(end)) for start, end in pairs)])
    way = clear_way(drawn, radii, 0.5**0.5 * (1.0 + 1.0j))
    for share, radius in zip(shares, radii, strict=True):
        turn = np.linspace(0.0, 2.0 * math.pi, 91)
        rings.append(Curve(x=radius * np.cos(turn), y=radius * np.sin(turn), role="faint", width=0.8))
        rings.append(
            Note(
                text=Quantity(share / 100.0, "share", trim=True),
                x=radius * way.real,
                y=radius * way.imag,
                role="muted",
                size=6.8,
            )
        )
    middle = Curve(x=np.asarray([0.0]), y=np.asarray([0.0]), role="ink", width=0.0, marker=5.0)
    sides: list[Series] = []
    count = len(one.vertex) - 1
    for k, (start, end) in enumerate(zip(one.vertex, one.vertex[1:], strict=False), start=1):
        path = _side(complex(start), complex(end))
        sides.append(
            Curve(
                x=path.real,
                y=path.imag,
                role=shaft(k + 1),
                dash=dash_of(k + 1),
                width=4.4 - 2.6 * k / count,  # later sides narrower: one that runs back over another hides nothing
                label=_("joint {number}").format(number=k) if named else "",
            )
        )
        last = k + 1 == len(one.vertex)
        sides.append(
            Curve(
                x=np.asarray([end.real]),
                y=np.asarray([end.imag]),
                role=shaft(k + 1),
                width=0.0,
                marker=7.0 if last else 4.5,
            )
        )
    name = _("setting {label}").format(label=one.label) if best else one.label
    span = Axis(low=-reach, high=reach)
    title = say(_("{name}: {share}"), name=name, share=Quantity(one.speed_fluctuation, "share", 3))
    return Panel(series=(*rings, *sides, middle), x=span, y=span, title=title, equal=True, bare=True)


def _share(radius: float) -> float:
    """Return the speed fluctuation of a corner so far from the middle."""
    return 4.0 * radius / (1.0 - radius * radius) if radius < 1.0 else 1e3


def _side(start: complex, end: complex) -> Array:
    """Return points of the hyperbolic line between two corners."""
    root = math.sqrt(max(1.0 - abs(start) ** 2, 1e-300))
    to_origin = (np.asarray(1.0 / root + 0j), np.asarray(-start / root))
    tip = complex(mobius.apply(to_origin, np.asarray(end)))
    points: Array = mobius.apply(mobius.inverse(to_origin), np.linspace(0.0, 1.0, 17) * tip)
    return points


def settings_figure(found: Phasing) -> Figure:
    """Return what is left by each setting of the yokes."""
    shown = _compared(found)
    share = 100.0 * np.asarray([one.speed_fluctuation for one in shown])
    at = np.arange(len(shown), 0, -1, dtype=float)
    low, high = 100.0 * found.speed_fluctuation_min, 100.0 * found.speed_fluctuation_max
    # The widest reach is beside the point when it dwarfs what is compared.
    top = max(float(np.max(share)), min(high, 2.0 * float(np.max(share))), 1e-3)
    ticks = steps(0.0, 1.16 * top, 5)
    across = Axis(low=0.0, high=1.16 * top, ticks=ticks, texts=written(ticks))
    upright = Axis(low=0.4, high=len(shown) + 0.6, ticks=tuple(at), texts=tuple(one.label for one in shown), grid=False)
    roles = tuple("muted" if one is found.as_built else "accent" for one in shown)
    bars = Bars(
        at=at,
        size=share,
        texts=tuple(Quantity(s / 100.0, "share", 3) for s in share.tolist()),
        roles=roles,
        thick=0.62,
        lying=True,
    )
    band = Band(low=low, high=min(high, 1.16 * top), upright=True, role="accent", opacity=0.07)
    text = _("The free yokes can reach every value in the shaded range, from {low:bare} to {high}.")
    if high > across.high:
        text = _(
            "The free yokes can reach every value from {low:bare} to {high}; the shaded range goes on to the right."
        )
    return Figure(
        name="settings",
        aside=True,  # the table of settings tells the same
        title=_("What each setting of the yokes leaves"),
        sentence=say(
            text,
            low=Quantity(found.speed_fluctuation_min, "share", 3),
            high=Quantity(found.speed_fluctuation_max, "share", 3),
        ),
        source=_(
            "bounds: δ = 2 sinh L, L from max(0, 2L_max − ΣL) to ΣL, L = −ln cos α; exact, in place of "
            "Kozhevnikov & Perfil'ev (1978), eq. 86"
        ),
        rows=(
            Row(
                panels=(
                    Panel(
                        series=(band, bars),
                        x=across,
                        y=upright,
                        title=_("Speed fluctuation δ left at the output"),
                        dimension="share",
                        unit="percent",
                    ),
                ),
                height=0.3 * len(shown) + 0.2,
            ),
        ),
        legend=False,
    )


def steering_figure(found: Phasing) -> Figure:
    """Return the speed ratio of a steering column from lock to lock, as specified and in its best setting."""
    shown = found.steering[:2]
    looks = (("muted", "dashed", 1.4), ("accent", "solid", 2.0))
    turn = shown[0].angle / deg
    curves = tuple(
        Curve(x=turn, y=one.ratio, role=role, dash=dash, width=width, label=one.setting.label)
        for one, (role, dash, width) in zip(shown, looks, strict=False)
    )
    across = axis(_("Turn of the wheel from straight ahead"), "deg", [turn], dimension="angle", margin=0.0)
    upright = axis(_("Speed ratio, output to wheel"), "", [one.ratio for one in shown], include=(1.0,), least=1e-3)
    best = shown[-1]
    return Figure(
        name="steering",
        title=_("Speed ratio of the steering column from lock to lock"),
        sentence=say(
            _("In setting {label} the ratio is {ratio} straight ahead, and the same to both sides."),
            label=best.setting.label,
            ratio=Quantity(best.centre_ratio, decimals=4),
        ),
        source=_("i = cos α/(1 − sin² α cos²(φ + ψ)) of the joint that turns like the column; exact"),
        rows=(
            Row(
                panels=(Panel(series=(Rule(value=0.0, upright=True, role="faint"), *curves), x=across, y=upright),),
                height=1.8,
            ),
        ),
    )


def sensitivity_figure(found: Phasing) -> Figure:
    """Return what one degree of error of each yoke costs at the best setting."""
    best = found.settings[0]
    cost = 100.0 * np.maximum(best.one_off, 0.0)
    number = np.arange(2, len(cost) + 2)
    upright = axis(
        _("Fluctuation δ by one degree of yoke error"),
        "percent",
        [cost],
        dimension="share",
        include=(0.0,),
        least=1e-3,
        count=3,
    )
    ticks = tuple(float(k) for k in number)
    across = Axis(
        label=_("shaft"), low=1.4, high=float(number[-1]) + 0.6, ticks=ticks, texts=written(ticks), grid=False
    )
    kept = tuple(t for t in upright.ticks if t >= 0.0)
    upright = replace(upright, low=0.0, high=1.1 * upright.high, ticks=kept, texts=written(kept))
    worst = int(foremost(cost))
    return Figure(
        name="sensitivity",
        aside=True,  # the table of what a degree costs tells the same
        title=_("How exactly the yokes must stand"),
        sentence=say(
            _("Shaft {number} asks for most care: one degree off adds {cost}."),
            number=worst + 2,
            cost=Quantity(float(cost[worst]) / 100.0, "share", 3),
        ),
        source=_("δ(γ ± 1°) − δ(γ) at setting {label}, to the worse side; exact, δ = 4|a||b|").format(label=best.label),
        rows=(
            Row(
                panels=(
                    Panel(
                        series=(
                            Bars(
                                at=number,
                                size=cost,
                                texts=tuple(Quantity(float(c) / 100.0, "share", 3) for c in cost),
                                roles=tuple(shaft(int(k)) for k in number),
                                thick=0.5,
                            ),
                        ),
                        x=across,
                        y=upright,
                    ),
                ),
                height=1.3,
            ),
        ),
        legend=False,
    )


# A drive whose joints were moved: what became of its joint angles, and how it looks now.


def layout_figures(found: Layout) -> tuple[Figure, ...]:
    """Return the figures of a layout."""
    return (joint_angles_figure(found), views_figure(found.drive, solids(sized(found.drive))))


def joint_angles_figure(found: Layout) -> Figure:
    """Return the joint angles before and after."""
    before, after = np.asarray(found.joint_angle_before) / deg, np.asarray(found.joint_angle) / deg
    number = np.arange(1, len(after) + 1)
    upright = axis(_("Joint angle"), "deg", [before, after], dimension="angle", include=(0.0,), least=1.0, count=4)
    ticks = tuple(float(k) for k in number)
    across = Axis(
        label=_("joint"), low=0.4, high=float(number[-1]) + 0.6, ticks=ticks, texts=written(ticks), grid=False
    )
    bars = (
        Bars(
            at=number - 0.2,
            size=before,
            texts=tuple(Quantity(float(b) * deg, "angle", decimals=1) for b in before),
            roles=("faint",),
            thick=0.36,
            label=_("as described"),
        ),
        Bars(
            at=number + 0.2,
            size=after,
            texts=tuple(Quantity(float(b) * deg, "angle", decimals=1) for b in after),
            roles=tuple(shaft(int(k) + 1) for k in number),
            thick=0.36,
            label=_("moved, in the colour of the driven shaft"),
        ),
    )
    return Figure(
        name="layout",
        title=_("Joint angles before and after the joints were moved"),
        sentence=say(_("The joints move by up to {way}."), way=Quantity(float(np.max(found.moved)), "length", 3)),
        source=_("cos α_max ≥ Π cos α of the other joints lets the yokes make a drive uniform; exact"),
        rows=(Row(panels=(Panel(series=bars, x=across, y=upright),), height=1.7),),
    )
