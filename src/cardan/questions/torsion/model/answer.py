"""What there is to say of torsional modes: natural frequencies, what excites them, shapes, Campbell crossings."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Protocol

import numpy as np

from cardan.answers.answer import FILE, Answer, Column, KeyFigure, Remark, Table, Tone, closely, heads
from cardan.answers.quantity import Joined, Quantity, Text, listed, say
from cardan.answers.question import Lacking, absent
from cardan.drive.conditions import used_speeds
from cardan.drive.drive import Drive
from cardan.drive.models.wobble import wobbling
from cardan.drive.torsional_layout import has_torsion
from cardan.formulas.damping import SHAFT_SOURCE
from cardan.later import later
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.ties import alike
from cardan.questions.assumed import yokes_estimated
from cardan.texts import _, plural

from .inputs import base_period
from .torsion import Crossing, Node, TorsionModes, orders
from .torsion import torsion_modes as ask
from .torsional_train import TorsionalTrain

drawn = later("cardan.questions.torsion.model.figure")

__all__ = ["answer", "ask", "lacking"]

SHOWN = 4
"""Modes that people are shown."""

CROSSINGS = 12
"""Crossings that people are shown."""

FAR = 3.0
"""Crossings at speeds so many times above the operating range are left out for people."""

NEAR = 0.1
"""Speeds nearer than this share are too near."""

RANGES = 3
"""So many ranges of speed of which something is not proved are told."""

SECOND = 2.0
"""Order at which cross joints modulate the stiffness of modes."""

ALARMS = 2
"""Crossings on the first page."""

AT = 0.005
"""Share of an element within which a node counts as at its end."""


class Zoned(Protocol):
    """Zones of parametric resonance, as `cardan.questions.torsion.steady.run_stability.Zone`."""

    @property
    def modes(self) -> Array:
        """Numbers of the two modes of each, (k, 2)."""

    def name(self, index: tuple[int, ...]) -> str:
        """Return the name of one of them."""


class Exact(Protocol):
    """What exact equations say of ranges of speed: `cardan.questions.torsion.stability.proved_speeds.ProvedSpeeds`."""

    @property
    def lowest(self) -> Array:
        """Begin of each unstable range, (k,) [rad/s]."""

    @property
    def highest(self) -> Array:
        """End of each, (k,) [rad/s]."""

    @property
    def zone(self) -> Zoned:
        """Zone of each."""

    @property
    def unproved(self) -> Array:
        """Stretches of which nothing was shown, (j, 2) [rad/s]."""

    @property
    def looked_at(self) -> bool:
        """Whether anything was shown."""

    def overlapping(self, low: float, high: float) -> Array:
        """Return the unstable ranges that overlap some speeds [rad/s], those that grow fastest first."""


def lacking(drive: Drive) -> Lacking:
    """Return what the drive file lacks for torsional vibration."""
    return absent((has_torsion(drive), "stations", "shafts[1].stiffness"))


def answer(drive: Drive, result: TorsionModes, *, exact: Exact | None = None) -> Answer:
    """Return what there is to say of the torsional modes of a drive.

    exact: what its exact equations say of the speeds in use and about them: they overrule the zones of first order.
    """
    exact = exact if exact is not None and exact.looked_at else None
    tone, said = modes_said(drive, result, exact=exact)
    return Answer(
        name="torsion-modes",
        title=_("Torsional modes"),
        sentence=Joined([said, "."], between=""),
        tone=tone,
        figures=lambda: drawn().modes_figures(result),
        tables=tuple(_tables(drive, result, exact)),
        remarks=tuple(_remarks(drive, result, exact)),
        keys=tuple(_keys(result)),
        facts=_facts(result, used_speeds(drive.duty), exact),
        full=lambda: _everything(result),
    )


def modes_said(drive: Drive, found: TorsionModes, *, exact: Exact | None = None) -> tuple[Tone, Text]:
    """Return what the modes come to, without the full stop, and how good that is."""
    text = _(
        "the first torsional natural frequency is {frequency}; joints excite it at {main} (order {order}) and at "
        "{principal} (parametric resonance)"
    )
    first = say(
        text,
        frequency=Quantity(float(found.omega[0]), "frequency", 3),
        main=_speed(found.main_speed[0], 3),
        order=_order(found.main),
        principal=_speed(found.parametric_speed[0], 3),
    )
    tone, more = _judged(drive, found, exact)
    return tone, Joined([first, more], between="; ")


def _judged(drive: Drive, found: TorsionModes, exact: Exact | None) -> tuple[Tone, Text]:
    """Return what that means for the operating range, nothing where there is none."""
    used = used_speeds(drive.duty)
    if used is None:
        return "plain", ""
    reach = used[0] * (1.0 - NEAR), used[1] * (1.0 + NEAR)
    told = _by_first_order(found, used, reach) if exact is None else _exactly(exact, used, reach)
    if told is not None:
        return told
    if count := sum(reach[0] <= one.speed <= reach[1] for one in found.crossings):
        text = plural(
            "{count} Campbell crossing in or near the operating range",
            "{count} Campbell crossings in or near the operating range",
            count,
        )
        return "warning", text.format(count=count)
    return "good", _("no Campbell crossing in the operating range")


def _exactly(exact: Exact, used: tuple[float, float], reach: tuple[float, float]) -> tuple[Tone, Text] | None:
    """Return what the exact equations say of parametric resonance, None where they are proved to be stable."""
    inside = exact.overlapping(*used)
    beside = sorted(
        exact.overlapping(*reach).tolist(),
        key=lambda k: max(float(exact.lowest[k]) / used[1], used[0] / float(exact.highest[k])),
    )
    for k in (*inside, *beside)[:1]:
        text = _("parametrically unstable from {low:bare} to {high}, near the operating range ({zone})")
        if len(inside):
            text = _("parametrically unstable in the operating range, from {low:bare} to {high} ({zone})")
        ends = {"low": _speed(exact.lowest[k], 5), "high": _speed(exact.highest[k], 5)}
        return "failed" if len(inside) else "warning", say(text, zone=exact.zone.name((int(k),)), **ends)
    open_: list[tuple[float, float]] = []
    for low, high in sorted((low, high) for low, high in exact.unproved if low < used[1] and used[0] < high):
        joined = bool(open_) and low <= open_[-1][1]
        open_[-1:] = [(open_[-1][0], max(high, open_[-1][1]))] if joined else [*open_[-1:], (low, high)]
    if not open_:
        return None
    ranges = [say(_("{low:bare} to {high}"), low=_speed(low), high=_speed(high)) for low, high in open_[:RANGES]]
    text = _("whether it is parametrically stable from {ranges} is not proved")
    if len(open_) > RANGES:
        text = _("whether it is parametrically stable from {ranges} and in further ranges is not proved")
    return "warning", say(text, ranges=Joined(ranges, last=_(" and ") if len(open_) <= RANGES else ", "))


def _by_first_order(
    found: TorsionModes, used: tuple[float, float], reach: tuple[float, float]
) -> tuple[Tone, Text] | None:
    """Return what zones of first order say of parametric resonance, None where they are not in reach."""
    growing = _unstable(found.zone_surely, used)
    if growing:
        text = _(
            "mode {mode} is parametrically unstable in the operating range, stable from a damping 2ζ of {least} on"
        )
        return "failed", say(text, mode=growing[0] + 1, least=_share(found.least_loss(used)[growing[0]]))
    if open_ := _undecided(found, used):
        text = _(
            "the operating range ends at an edge of the zone of mode {mode}, at most {low:bare} to {high}: whether "
            "it is parametrically unstable the exact equations decide (cardan torsion stability)"
        )
        low, high = (_speed(one) for one in found.zone_perhaps[open_[0]])
        return "warning", say(text, mode=open_[0] + 1, low=low, high=high)
    if near := _unstable(found.zone, reach):
        text = _("mode {mode} is parametrically unstable from {low:bare} to {high}, near the operating range")
        low, high = (_speed(one) for one in found.zone[near[0]])
        return "warning", say(text, mode=near[0] + 1, low=low, high=high)
    return None


def _speed(value: float, digits: int = 4) -> Quantity:
    return Quantity(float(value), "angular_speed", digits)


def _share(value: float) -> Quantity:
    return Quantity(float(value), "share", 2)


def _unstable(zones: Array, used: tuple[float, float]) -> list[int]:
    """Return the modes whose zone of growth (m, 2) overlaps a range of speeds [rad/s]."""
    return [k for k, zone in enumerate(zones) if zone[0] <= used[1] and used[0] <= zone[1]]


def _undecided(found: TorsionModes, used: tuple[float, float]) -> list[int]:
    """Return the modes of which first order leaves open whether they grow at one of some speeds [rad/s]."""
    sure = _unstable(found.zone_surely, used)
    return [k for k in _unstable(found.zone_perhaps, used) if k not in sure]


def _tables(drive: Drive, found: TorsionModes, exact: Exact | None) -> Iterator[Table]:
    yield _mode_table(drive, found, exact)
    yield _joint_table(drive, found)
    yield _shape_table(found)
    if found.crossings:
        yield _crossing_table(found)


def _growing(found: TorsionModes, used: tuple[float, float], exact: Exact | None) -> list[int]:
    """Return the modes that grow at some speeds [rad/s] in a zone of their own."""
    if exact is None:
        return _unstable(found.zone_surely, used)
    pairs = exact.zone.modes[exact.overlapping(*used)].tolist()
    return sorted({one - 1 for one, other in pairs if one == other and one > 0})


def _mode_table(drive: Drive, found: TorsionModes, exact: Exact | None) -> Table:
    count, used = min(SHOWN, len(found.omega)), used_speeds(drive.duty)
    grows = [] if used is None else _growing(found, used, exact)
    open_ = [] if used is None or exact is not None else _undecided(found, used)
    low, high = ([None if one != one else one for one in column] for column in found.zone[:count].T.tolist())
    return Table(
        title=_("Natural frequencies, all joints straight"),
        columns=(
            Column(key="", heading=_("mode"), values=list(range(1, count + 1))),
            Column(key="", heading=_("frequency"), values=found.omega[:count], dimension="frequency"),
            Column(key="", heading=_main(found), values=found.main_speed[:count], dimension="angular_speed"),
            *_order_column(found, count),
            Column(key="", heading=_("parametric"), values=found.parametric_speed[:count], dimension="angular_speed"),
            Column(key="", heading=_("modulation"), values=found.modulation[:count], dimension="share", digits=3),
            Column(key="", heading="2ζ", values=2.0 * found.damping_ratio[:count], dimension="share", digits=3),
            *_least_column(found, used, count),
            Column(key="", heading=_("unstable from"), values=low, dimension="angular_speed"),
            Column(key="", heading=_("to"), values=high, dimension="angular_speed"),
        ),
        tones=["failed" if k in grows else "warning" if k in open_ else "plain" for k in range(count)],
        note=_(
            "Joints modulate the stiffness of a mode twice a turn. About Ω = ω a mode is unstable where the modulation "
            "exceeds the damping 2ζ (parametric resonance)."
        )
        if np.all(found.order == SECOND)
        else _(
            "Joints modulate the stiffness of a mode most at the order ν of the turn. About Ω = 2ω/ν a mode is "
            "unstable where the modulation exceeds the damping 2ζ (parametric resonance)."
        ),
    )


def _main(found: TorsionModes) -> str:
    """Return what the order at which the joints change the speed most is called."""
    return _("order {order:g}").format(order=found.main)


def _order_column(found: TorsionModes, count: int) -> Iterator[Column]:
    """Yield the order at which joints modulate each mode most, where it is not that of cross joints."""
    if np.any(found.order != SECOND):
        yield Column(key="", heading=_("order ν"), values=found.order[:count], decimals=0)


def _least_column(found: TorsionModes, used: tuple[float, float] | None, count: int) -> Iterator[Column]:
    """Yield the damping from which each mode is stable in the operating range, where one would be unstable without."""
    least = None if used is None else found.least_loss(used)[:count]
    if least is not None and np.any(least > 0.0):
        values = [float(one) if one > 0.0 else None for one in least]
        yield Column(key="", heading=_("stable from 2ζ"), values=values, dimension="share", digits=2)


def _mode_columns(values: np.ndarray) -> list[Column]:
    """Return a column for each mode that people are shown, of values (m, ...)."""
    return [
        Column(key="", heading=_("mode {number}").format(number=k), values=row + 0.0, decimals=3)
        for k, row in enumerate(values[:SHOWN], 1)
    ]


def _joint_table(drive: Drive, found: TorsionModes) -> Table:
    names = heads(_("joint"), [joint.name for joint in drive.joints])
    return Table(
        title=_("Distance of each joint from the node of a mode, κ"),
        columns=(names[0], *_mode_columns(found.joint_weight)),
        note=_("A joint in the node of a mode, κ = 0, excites no parametric vibration of it, whatever its angle."),
    )


def _shape_table(found: TorsionModes) -> Table:
    train = found.train
    place = Column(key="", heading=_("at"), values=train.position, dimension="length", decimals=0)
    return Table(
        title=_("Mode shapes, largest amplitude 1"),
        columns=(
            Column(key="", heading=_("station"), values=list(train.station_names), left=True),
            *([place] if train.to_scale else []),
            *_mode_columns(found.shape),
        ),
    )


def _crossing_table(found: TorsionModes) -> Table:
    used = found.speed_range[1] if found.speed_range is not None else found.speed
    near = [one for one in found.crossings if not used or one.speed < FAR * used]
    shown = (near or list(found.crossings))[:CROSSINGS]
    return Table(
        title=_("Campbell crossings: speeds at which an order meets a mode"),
        columns=(
            Column(key="", heading=_("speed"), values=[one.speed for one in shown], dimension="angular_speed"),
            Column(key="", heading=_("order"), values=[_order(one.order) for one in shown]),
            Column(key="", heading=_("mode"), values=[one.mode for one in shown]),
            Column(key="", heading=_("in use"), values=[one.inside for one in shown]),
            *(
                [
                    Column(
                        key="",
                        heading=_("± torque"),
                        values=[one.torque for one in shown],
                        dimension="torque",
                        digits=3,
                    )
                ]
                if any(one.torque is not None for one in shown)
                else []
            ),
            Column(key="", heading=_("excited by"), values=[one.cause for one in shown], left=True, wrap=True),
        ),
        tones=["warning" if one.inside else "plain" for one in shown],
    )


def _order(order: float) -> Quantity:
    return Quantity(order, trim=True)


def _remarks(drive: Drive, found: TorsionModes, exact: Exact | None) -> Iterator[Remark]:
    yield from _alarms(found, exact)
    yield from (Remark(text=_node(found, node)) for node in found.nodes[0])
    if found.joint_weight.shape[-1] > 1:
        nearest = np.flatnonzero(alike(np.abs(found.joint_weight[0]), least=True, scale=1.0)) + 1
        text = _("Joint {number} is nearest to the node of mode 1.")
        if len(nearest) > 1:
            text = _("Joints {number} are equally near to the node of mode 1.")
        yield Remark(text=text.format(number=listed(nearest.tolist())))
    if not found.train.model.free:
        text = _('The input is held at uniform speed, a node of every mode; input = "free" lets it vibrate.')
        yield Remark(text=text)
    yield from assumptions(found.train)
    yield from left_out(drive)
    yield from yokes_estimated(drive)
    yield from _enough(drive, found, exact)
    orders = nonsynchronous(drive)
    if exact is not None and orders is not None:
        text = _(
            "Stability is proved without the orders that do not repeat within two turns ({orders}); they count at "
            "single speeds of the operating range, not between them."
        )
        yield Remark(text=say(text, orders=orders))
    text = _("Checked: the torques of every mode balance {closely}.")
    yield Remark(text=text.format(closely=closely(found.residual)), depth="full", aside=True)
    yield Remark(
        text=_("Alternating torques at a speed:"), command=("cardan", "torsion", "response", FILE), tone="next"
    )


def _enough(drive: Drive, found: TorsionModes, exact: Exact | None) -> Iterator[Remark]:
    """Yield the least damping of modes that it alone keeps stable in the operating range."""
    used = used_speeds(drive.duty)
    if used is None:
        return
    grows, least, own_loss = _growing(found, used, exact), found.least_loss(used), 2.0 * found.damping_ratio
    for k in np.flatnonzero(least[:SHOWN] > 0.0).tolist():
        if k not in grows and (exact is None or least[k] <= own_loss[k]):
            text = _("In the operating range mode {mode} is stable from a damping 2ζ of {least} on; it has {own}.")
            yield Remark(text=say(text, mode=k + 1, least=_share(least[k]), own=_share(own_loss[k])))


def _alarms(found: TorsionModes, exact: Exact | None) -> Iterator[Remark]:
    """Yield what must not be overlooked on the first page; the tables of the answer say it too."""
    if found.speed_range is None:
        return
    if exact is not None:
        text = _(
            "Torsional vibration is parametrically unstable from {low:bare} to {high}, in the operating range: {zone}."
        )
        for k in exact.overlapping(*found.speed_range)[:SHOWN].tolist():
            ends = {"low": _speed(exact.lowest[k]), "high": _speed(exact.highest[k])}
            said = say(text, zone=exact.zone.name((k,)), **ends)
            yield Remark(text=said, tone="failed", depth="data", alarm=True)
    for k in _unstable(found.zone_surely, found.speed_range)[:SHOWN] if exact is None else ():
        text = _("Torsional mode {mode} is parametrically unstable from {low:bare} to {high}, in the operating range.")
        low, high = (_speed(one, 3) for one in found.zone[k])
        yield Remark(text=say(text, mode=k + 1, low=low, high=high), tone="failed", depth="data", alarm=True)
    met = [one for one in found.crossings if one.inside and one.mode <= SHOWN]
    for one in met[:ALARMS]:
        text = _("Order {order} ({cause}) meets torsional mode {mode} at {speed}, in the operating range.")
        said = say(text, order=_order(one.order), cause=one.cause, mode=one.mode, speed=_speed(one.speed, 3))
        yield Remark(text=said, tone="warning", depth="data", alarm=True)


def _node(found: TorsionModes, node: Node) -> Text:
    """Return where mode 1 stands still."""
    names = found.train.station_names
    at = node.before if node.share < AT else node.behind if node.share > 1.0 - AT else None
    if found.train.to_scale:
        text = _("Mode 1 has a node at {place} from the input end, between {one} and {other}.")
        if at is not None:
            text = _("Mode 1 has a node at {place} from the input end, at {one}.")
    else:
        text = _("Mode 1 has a node {share} of the way from {one} to {other}.")
        if at is not None:
            text = _("Mode 1 has a node at {one}.")
    return say(
        text,
        place=Quantity(node.position, "length", 3),
        share=Quantity(node.share, "share", 2),
        one=names[node.before if at is None else at],
        other=names[node.behind],
    )


def _keys(found: TorsionModes) -> Iterator[KeyFigure]:
    first = Quantity(float(found.omega[0]), "frequency")
    yield KeyFigure(name="torsional_frequency", title=_("first torsional natural frequency"), value=first, better="")
    title = _("speed at which order {order:g} meets the first torsional mode").format(order=found.main)
    speed = _speed(found.main_speed[0])
    yield KeyFigure(name=f"torsional_order_{found.main:g}", title=title, value=speed, better="")


def _everything(found: TorsionModes) -> Table:
    """Return the modes, one a row, with their shapes."""
    weight, shape = found.joint_weight.T, found.shape.T
    return Table(
        columns=(
            Column(key="mode", values=np.arange(1, len(found.omega) + 1)),
            Column(key="frequency", values=found.omega, dimension="frequency"),
            Column(key="order_2", values=found.order2_speed, dimension="angular_speed"),
            Column(key="principal", values=found.parametric_speed, dimension="angular_speed"),
            Column(key="modulation", values=found.modulation),
            Column(key="damping_ratio", values=found.damping_ratio),
            Column(key="zone_low", values=found.zone[:, 0], dimension="angular_speed"),
            Column(key="zone_high", values=found.zone[:, 1], dimension="angular_speed"),
            *(Column(key=f"joint_{i}_weight", values=one) for i, one in enumerate(weight, 1)),
            *(Column(key=f"station_{k}", values=one) for k, one in enumerate(shape, 1)),
        )
    )


def _facts(found: TorsionModes, used: tuple[float, float] | None, exact: Exact | None) -> dict[str, Any]:
    train, model = found.train, found.train.model
    stations, springs = train.station_names, np.asarray(model.stiffness)
    return {
        "input": "free" if model.free else "uniform",
        "stations": [
            {
                "name": name,
                "shaft": model.shaft[k] + 1,
                "position": Quantity(float(train.position[k]), "length"),
                "inertia": Quantity(float(model.inertia[k]), "inertia"),
            }
            for k, name in enumerate(stations)
        ],
        "elements": [
            {
                "from": stations[a],
                "to": stations[b],
                "stiffness": Quantity(springs[..., e], "turning_stiffness"),
                "damping": Quantity(float(model.damping[e]), "turning_damping"),
                "loss_factor": float(model.loss_factor[e]),
                "backlash": Quantity(float(model.backlash[e]), "angle"),
            }
            for e, (a, b) in enumerate(model.elements)
        ],
        "modes": [_mode(found, k, used) for k in range(len(found.omega))],
        "crossings": [_crossing(one) for one in found.crossings],
        "unstable": [
            {"speeds": _ends(low, high), "zone": exact.zone.name((k,))}
            for k, (low, high) in enumerate(zip(exact.lowest, exact.highest, strict=True))
        ]
        if exact is not None
        else None,
        "residual": found.residual,
        "assumed": train.assumed,
    }


def _ends(low: float, high: float) -> Quantity:
    return Quantity(np.asarray([low, high]), "angular_speed")


def _mode(found: TorsionModes, k: int, used: tuple[float, float] | None) -> dict[str, Any]:
    least = None if used is None else float(found.least_loss(used)[k])
    return {
        "number": k + 1,
        "frequency": Quantity(float(found.omega[k]), "frequency"),
        "order_2": _speed(found.order2_speed[k]),
        "principal": _speed(found.parametric_speed[k]),
        **({} if found.main == SECOND else {"order": found.main, "order_speed": _speed(found.main_speed[k])}),
        **({} if found.order[k] == SECOND else {"modulation_order": float(found.order[k])}),
        "shape": found.shape[k],
        "joint_weight": found.joint_weight[k],
        "modulation": float(found.modulation[k]),
        "damping_ratio": float(found.damping_ratio[k]),
        "zone": Quantity(found.zone[k], "angular_speed"),
        "least_loss_factor": least,
        "nodes": Quantity([node.position for node in found.nodes[k]], "length"),
    }


def _crossing(one: Crossing) -> dict[str, Any]:
    return {
        "speed": _speed(one.speed),
        "order": one.order,
        "mode": one.mode,
        "cause": one.cause,
        "side_band_torque": None if one.torque is None else Quantity(one.torque, "torque"),
        "in_use": one.inside,
    }


# Words that all answers on torsional vibration share: what the model assumes, and ranges of values.


def left_out(drive: Drive) -> Iterator[Remark]:
    """Yield what of a drive does not act in its torsional vibration although the file gives it."""
    yield from parts_left_out(drive)
    if drive.movements:
        text = _(
            "Movements count instant by instant here, as if the drive stood; along the whole movement it is told by:"
        )
        yield Remark(text=text, command=("cardan", "torsion", "road", FILE))


def torques_left_out(drive: Drive) -> Iterator[Remark]:
    """Yield which torques of a drive do not act in an answer that is of its duty alone, and where they count."""
    duty = drive.duty
    kinds = (
        (_("the torques of the load cases"), bool(duty.cases)),
        (_("the torques of the duty cycle"), bool(duty.blocks)),
        (_("the measured torque"), duty.torque_history is not None),
    )
    parts = [name for name, there in kinds if there]
    if not parts:
        return
    unloaded = duty.torque is None and duty.load is None
    acting: Text = _("No mean torque acts here")
    where = _("torsion response, strength, life and check")
    if duty.load is not None:
        acting = _("Of the mean torques only that of the machine on the output acts here")
        where = _("strength, life and check")
    elif duty.torque is not None:
        text = _("Of the mean torques only that of the duty, {torque}, acts here")
        acting = say(text, torque=Quantity(duty.torque, "torque", 4))
    said = say(
        _("{acting}; left out, but counted in {where}: {parts}."), acting=acting, where=where, parts=Joined(parts)
    )
    yield Remark(text=said, tone="warning" if unloaded else "plain", code="torques_left_out")


def parts_left_out(drive: Drive) -> Iterator[Remark]:
    """Yield what joints and shafts of a drive do that acts in its torsional vibration nearly, or not."""
    if felt := wobbling(drive):
        text = plural(
            "What the wobble of shaft {which} makes of joints excites the drive as on shafts that do not twist.",
            "What the wobbles of shafts {which} make of joints excite the drive as on shafts that do not twist.",
            len(felt),
        )
        yield Remark(text=say(text, which=listed([i + 2 for i in felt])), aside=True, code="wobble")
    yield from friction_left_out(drive)


def friction_left_out(drive: Drive) -> Iterator[Remark]:
    """Yield which friction of a drive does not act in its torsional vibration."""
    splines = [one.spline for one in drive.shafts if one.spline is not None and one.spline.friction]
    rubbing = (
        (_("joints"), any(one.friction or one.material_friction for one in drive.joints)),
        (_("splines"), bool(splines)),
        (_("supports"), any(one.friction for one in drive.supports)),
        (_("seals"), any(one.seal_diameter for one in drive.supports)),
    )
    if any(there for _name, there in rubbing):
        text = _(
            "Friction of {parts} is left out of torsional vibration: it takes more torque at the input, and damps next "
            "to nothing while torques keep their sign; its heat is told by:"
        )
        parts = ", ".join(name for name, there in rubbing if there)
        yield Remark(text=text.format(parts=parts), command=("cardan", "losses", FILE))


def assumptions(train: TorsionalTrain, *, wide: bool = False, sprung: bool = False) -> Iterator[Remark]:
    """Yield what the model assumes, in one line a sort.

    train: whose `assumed` paths are put into words; wide: whether pendulums swing as far as they do, with their stops;
    sprung: whether springs follow their tables, with dry friction.
    """
    if train.pendulums and not wide:
        text = _("Pendulums count with small oscillations; torsion simulate follows wide ones.")
        if any(one.stop_angle is not None for one in train.hung):
            text = _(
                "Pendulums count with small oscillations, without their stops; torsion simulate follows wide ones."
            )
        yield Remark(text=text)
    for e, one in train.springs if not sprung else ():
        text = _("Dry friction in {name} does not count here; it does in torsion response and simulate.")
        if one.twists:
            text = _(
                "The spring in {name} counts with its stiffness at the torque of the duty, {stiffness}, without dry "
                "friction; torsion response and simulate follow its table."
            )
        stiffness = Quantity(float(np.ravel(train.model.stiffness[..., e])[0]), "turning_stiffness", 4)
        yield Remark(text=say(text, name=train.elements[e], stiffness=stiffness))
    kinds = {
        "stiffness": _("rigid, for want of a stiffness or a body of known length: {shafts}"),
        "inertia": _("without inertia: {shafts}"),
        "material": _("of steel: {shafts}"),
        "damping": _("without damping: {shafts}"),
    }
    every = {f"shafts[{k}].{kind}": (kind, k + 1) for k in range(max(train.model.shaft) + 1) for kind in kinds}
    found: dict[str, list[int]] = {}
    for kind, number in (every[path] for path in train.assumed if path in every):
        found.setdefault(kind, []).append(number)
    texts = []
    for kind, numbers in found.items():
        word = _("shaft") if len(numbers) == 1 else _("shafts")
        texts.append(kinds[kind].format(shafts=f"{word} {listed(numbers)}"))
    if train.usual_loss:
        text = _("Without any damping in the file shafts have η = {loss}: {source}; damping or loss_factor changes it.")
        yield Remark(text=say(text, loss=Quantity(train.usual_loss, digits=2, trim=True), source=_(SHAFT_SOURCE)))
    if "duty.motor" in train.assumed:
        texts.append(_("driven by a constant torque that equals what resists at the start"))
    if texts:
        yield Remark(text=_("Assumed: {what}.").format(what="; ".join(texts)))


def nonsynchronous(drive: Drive) -> Joined | None:
    """Return the orders of a drive that no two turns hold a whole number of times, None where there are none."""
    found = [_order(order) for order, _cause in orders(drive, drive.duty) if base_period((order,)) is None]
    return Joined(found) if found else None


def counted(orders: Joined | None, together: ArrayLike, most: int) -> Iterator[Remark]:
    """Yield whether stability counts the orders that no two turns hold a whole number of times.

    together (...): where it does; most: points at which it may.
    """
    if orders is None:
        return
    known = np.asarray(together)
    if np.all(known):
        text = _("Stability is that of the motion with the orders that do not repeat within two turns ({orders}).")
    elif np.any(known):
        text = _(
            "Stability is that of the motion with the orders that do not repeat within two turns ({orders}) at {share} "
            "of the points; elsewhere it is judged without them, as how disturbances grow with them is not known."
        )
    elif known.size > most:
        text = _(
            "Stability is judged without the orders that do not repeat within two turns ({orders}); at up to {most} "
            "points they count."
        )
    else:
        text = _(
            "Stability is judged without the orders that do not repeat within two turns ({orders}): how disturbances "
            "of the motion with them grow is not known here."
        )
    yield Remark(text=say(text, orders=orders, most=most, share=Quantity(float(np.mean(known)), "share", 2)))


def counted_to_first_order(drive: Drive) -> Iterator[Remark]:
    """Yield that the orders that no two turns hold a whole number of times count to first order, if there are any."""
    orders = nonsynchronous(drive)
    if orders is not None:
        text = _(
            "Orders that do not repeat within two turns ({orders}) count to first order here, with their side bands, "
            "and stability is judged without them; cardan torsion response has them exactly."
        )
        yield Remark(text=say(text, orders=orders))


def ranges(values: ArrayLike, mask: ArrayLike, dimension: str = "", unit: str = "") -> Joined:
    """Return the ranges of values in which something holds; told as nothing where there is none.

    values (s,): rising, in SI; mask (s,) of bool: where it holds; dimension, unit: of the values, as of `Quantity`.
    """
    inside = np.asarray(mask, dtype=bool)
    steps = np.flatnonzero(np.diff(np.concatenate([[False], inside, [False]]).astype(int)))
    every = [Quantity(float(one), dimension, unit=unit, trim=True) for one in np.asarray(values, dtype=float)]
    parts: list[Text] = []
    for first, behind in zip(steps[::2].tolist(), steps[1::2].tolist(), strict=True):
        low, high = every[first], every[behind - 1]
        parts.append(low if behind - first == 1 else say(_("{low:bare} to {high}"), low=low, high=high))
    return Joined(parts)
