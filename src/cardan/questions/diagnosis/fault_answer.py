"""What there is to say of a simulated fault: the orders it should show, how they follow speed and torque."""

from __future__ import annotations

from collections.abc import Iterator
from math import hypot, isfinite
from pathlib import Path

from cardan.answers.answer import FILE, Answer, Column, Remark, Table
from cardan.answers.quantity import Quantity, Text, say
from cardan.catalogue import catalogue
from cardan.catalogue.rows import Fault
from cardan.texts import _

from .expected import FAULTS, Expected, ExpectedOrder
from .figures.orders import expected_figure, largest_order
from .signals.signal import Signal

__all__ = ["answer", "answer_of_list", "by_torque", "grows"]


def answer(found: Expected, made: Signal | None = None, path: Path | None = None) -> Answer:
    """Return what there is to say of a fault of a drive. made: a recording of it; path: where that was written."""
    channels = [] if made is None else [one.name for one in made.channels]
    span = Quantity(0.0 if made is None else made.duration, "time")
    written = {} if made is None else {"recording": {"path": str(path), "duration": span, "channels": channels}}
    return Answer(
        name="simulate-fault",
        title=_("What the fault should show"),
        sentence=_sentence(found),
        tables=(_largest(found),),
        remarks=(*_remarks(found), *_recording(found, made, path)),
        figures=lambda: (expected_figure(found),),
        facts={
            "fault": found.fault,
            "cause": found.cause,
            "critical_speed": Quantity(found.critical, "angular_speed"),
            "speed_range": Quantity(list(found.speed), "angular_speed"),
            "torque": Quantity(found.reference, "torque"),
            "orders": [
                {
                    "order": one.order,
                    "place": one.place,
                    "direction": one.direction,
                    "amplitude": _quantity(one, _size(found, one)),
                    "speed_power": one.speed_power,
                    "torque": list(one.torque),
                    "amplified": one.amplified,
                    "source": one.source,
                }
                for one in found.orders
            ],
            "knocks": [
                {"per_turn": one.per_turn, "at": one.kind, "amplitude": Quantity(one.size, "acceleration")}
                for one in found.bursts
            ],
            "assumed": list(found.assumed),
            **written,
        },
        full=lambda: _everything(found),
    )


def answer_of_list() -> Answer:
    """Return what there is to say of the faults that can be simulated."""
    words = [fault_words(name) for name in FAULTS]
    table = Table(
        name="faults",
        records=True,
        columns=(
            Column(key="fault", heading=_("fault"), values=list(FAULTS), left=True),
            Column(key="cause", heading=_("cause"), values=list(FAULTS.values()), left=True),
            Column(key="words", heading=_("what is wrong"), values=words, left=True, wrap=True),
        ),
    )
    text = _("{count} faults can be simulated.")
    return Answer(name="simulate-fault", title=_("Faults"), sentence=say(text, count=len(FAULTS)), tables=(table,))


def fault_words(fault: str) -> str:
    """Return what a fault is, in words."""
    own = {"unbalance": _("unbalance of a shaft"), "lost_weight": _("balance weight lost")}
    if fault in own:
        return own[fault]
    row = catalogue().rows(Fault).get(FAULTS[fault])
    return _("nothing wrong") if row is None else _(row.fault)


def grows(power: float, *, amplified: bool) -> str:
    """Return how an order follows the speed, in words."""
    plain = {0.0: _("stays the same"), 1.0: _("in proportion"), 2.0: _("square")}
    said = plain.get(power, _("power {power:g}").format(power=power))
    return _("{said}, amplified near the critical speed").format(said=said) if amplified else said


def by_torque(share: tuple[float, float, float]) -> str:
    """Return how an order follows the torque, in words. share: a, b, c of the factor |a + bτ + c|τ||."""
    still, signed, sized = share
    if signed:
        return _("changes with its sense")
    if not sized:
        return _("stays the same")
    if not still:
        return _("in proportion")
    return _("grows") if sized > 0.0 else _("falls")


def _size(found: Expected, one: ExpectedOrder) -> float:
    """Return the amplitude of a part of an order at top speed and the torque of the duty."""
    return float(abs(found.value(one, found.speed[1], found.reference)))


def _quantity(one: ExpectedOrder, size: float) -> Quantity:
    """Return an amplitude: of an acceleration, or of the speed of the output."""
    if one.direction == "torsion":
        return Quantity(size, "angular_speed", unit="rad_s")
    return Quantity(size, "acceleration")


def _sentence(found: Expected) -> Text:
    largest = largest_order(found)
    if largest is None:
        return _("{fault}: no order across the shaft.").format(fault=fault_words(found.fault))
    order, place, size = largest
    return say(
        _("{fault}: at {speed} order {order} is the largest at {place}, about {size}."),
        fault=fault_words(found.fault),
        speed=Quantity(found.speed[1], "angular_speed"),
        order=f"{order:g}",
        place=place,
        size=Quantity(size, "acceleration", 2),
    )


def _largest(found: Expected) -> Table:
    """Return the orders across the shaft: at each sensor one line an order, by its largest part."""
    radial = [one for one in found.orders if one.direction == "radial"]
    rows: list[tuple[ExpectedOrder, float]] = []
    for place in sorted({one.place for one in radial}):
        for order in sorted({one.order for one in radial}):
            own = [one for one in radial if (one.place, one.order) == (place, order)]
            if own:
                sizes = [_size(found, one) for one in own]
                rows.append((own[sizes.index(max(sizes))], hypot(*sizes)))
    most = [one for one, _level in rows]
    return Table(
        columns=(
            Column(key="place", heading=_("sits on"), values=[one.place for one in most], left=True),
            Column(key="order", heading=_("order"), values=[Quantity(one.order, trim=True) for one in most]),
            Column(
                key="amplitude",
                heading=_("amplitude"),
                values=[level for _one, level in rows],
                dimension="acceleration",
                digits=3,
            ),
            Column(
                key="with_speed",
                heading=_("with the speed"),
                values=[grows(one.speed_power, amplified=False) for one in most],
                left=True,
            ),
            Column(
                key="with_torque",
                heading=_("with the torque"),
                values=[by_torque(one.torque) for one in most],
                left=True,
            ),
        )
    )


def _everything(found: Expected) -> Table:
    """Return every part of every order."""
    every = found.orders
    torsion = [one.direction == "torsion" for one in every]
    sizes = [_size(found, one) for one in every]
    parts = ("torque_still", "torque_signed", "torque_sized")
    return Table(
        columns=(
            Column(key="place", values=[one.place for one in every]),
            Column(key="direction", values=[one.direction for one in every]),
            Column(key="order", values=[one.order for one in every]),
            Column(
                key="amplitude",
                values=[None if turns else size for turns, size in zip(torsion, sizes, strict=True)],
                dimension="acceleration",
            ),
            Column(
                key="speed_amplitude",
                values=[size if turns else None for turns, size in zip(torsion, sizes, strict=True)],
                dimension="angular_speed",
                unit="rad_s",
            ),
            Column(key="speed_power", values=[one.speed_power for one in every]),
            *(Column(key=key, values=[one.torque[k] for one in every]) for k, key in enumerate(parts)),
            Column(key="amplified", values=[one.amplified for one in every]),
            Column(key="source", values=[one.source for one in every]),
        )
    )


def _remarks(found: Expected) -> Iterator[Remark]:
    text = _("Amplitudes at {speed} and {torque}; order-of-magnitude, trends are more reliable.")
    speed, torque = Quantity(found.speed[1], "angular_speed"), Quantity(found.reference, "torque")
    yield Remark(text=say(text, speed=speed, torque=torque))
    torsion = [_size(found, one) for one in found.orders if one.direction == "torsion"]
    if torsion:
        text = _("The output speed fluctuates by ±{size}, 2nd order.")
        yield Remark(text=say(text, size=Quantity(max(torsion), "angular_speed", 2)))
    kinds = {"input": _("input"), "centre": _("centre bearing"), "output": _("output")}
    for one in found.bursts:
        text = _("Knocks {count} times a turn, loudest at the {kind}, {size} at light torque.")
        if one.per_turn == 1:
            text = _("Knocks once a turn, loudest at the {kind}, {size} at light torque.")
        size = Quantity(one.size, "acceleration", 2)
        yield Remark(text=say(text, count=one.per_turn, kind=kinds[one.kind], size=size))
    if isfinite(found.critical):
        text = _("Amplified orders peak where order times speed meets the critical speed, {speed}.")
        yield Remark(text=say(text, speed=Quantity(found.critical, "angular_speed")))
    if found.assumed:
        text = _("The drive does not say {names}; the sizes to be expected are assumed.")
        yield Remark(text=text.format(names=", ".join(found.assumed)), tone="warning")


def _recording(found: Expected, made: Signal | None, path: Path | None) -> Iterator[Remark]:
    """Yield where its recording is, or how to make one."""
    if made is None or path is None:
        again = ("cardan", "simulate-fault", FILE, found.fault, "-o", f"{found.fault}.csv")
        yield Remark(text=_("A recording of it:"), command=again, tone="next")
        return
    text = _("Recording written: {path}, {count} channels, {span}.")
    span = Quantity(made.duration, "time", 3)
    yield Remark(text=say(text, path=str(path), count=len(made.channels), span=span))
    if path.suffix.lower() != ".wav":
        command = ("cardan", "diagnose", str(path), FILE)
        yield Remark(text=_("What is wrong with it:"), command=command, tone="next")
