"""``cardan rotor``: how does a shaft whirl with its unbalance and a crack: steadily, running up, beside a joint?"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from cardan.texts import _

from .options import AsCsv, AsJson, DriveFile, Plot
from .torsion_parts import Speeds

if TYPE_CHECKING:
    from cardan.drive.drive import Drive
    from cardan.questions.bending.cracked_run import CrackedRun
    from cardan.questions.bending.cracked_shafts import CrackedShafts
    from cardan.questions.bending.rotor import Rotor
    from cardan.questions.bending.rotor_response import RotorResponse

    from .answer import Answer, Cell, Remark, Table

MICRO = 1e-6

ROUNDING = 1e-9
"""Share of the largest order below which one is none."""

SHOWN = 12
"""Windows of a run in the terminal."""


def rotor(
    file: DriveFile,
    shaft: Annotated[
        int | None,
        typer.Option(
            "--shaft",
            metavar="N",
            help=_("Number of the shaft; the cracked one otherwise, else the one with most unbalance."),
            show_default=False,
        ),
    ] = None,
    damping: Annotated[
        float, typer.Option("--damping", metavar="ζ", help=_("Damping ratio of the bending of the shaft."))
    ] = 0.02,
    speeds: Speeds = None,
    run_up: Annotated[
        bool,
        typer.Option(
            "--run-up", help=_("In time, while the speed changes as the run_up of the duty."), show_default=False
        ),
    ] = False,
    joint: Annotated[
        int | None,
        typer.Option(
            "--joint", metavar="N", help=_("In time, both shafts beside this joint, at one speed."), show_default=False
        ),
    ] = None,
    speed_rpm: Annotated[
        float | None,
        typer.Option(
            "--speed-rpm",
            metavar="RPM",
            help=_("With --joint: the speed, instead of the one in the file."),
            show_default=False,
        ),
    ] = None,
    turns: Annotated[float, typer.Option("--turns", metavar="N", help=_("With --joint: how long, in turns."))] = 40.0,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell how a shaft whirls with its unbalance and a crack: orders over the speed, orbits, where it grows."""
    from cardan.errors import InputError, Problem

    from .asked import check_options, keys_of
    from .show import show

    check_options(speed_rpm, json=json, csv=csv, plot=plot)
    problems = []
    if run_up and joint is not None:
        problems.append(Problem("--joint", _("choose --run-up or --joint, not both")))
    if joint is None and speed_rpm is not None:
        problems.append(Problem("--speed-rpm", _("belongs to --joint; --speeds says a range")))
    if not 1.0 <= turns <= 10_000.0:
        problems.append(Problem("--turns", _("{value} is not allowed; allowed is 1 to 10000").format(value=turns)))
    if problems:
        raise InputError(problems)

    from cardan.questions.bending.rotor_response import joined_rotors, rotor_response, rotor_run
    from cardan.units import rpm

    from .progress import watching
    from .source import read
    from .torsion_parts import values

    at = None if speeds is None else values(speeds, "--speeds", low=0.0) * rpm
    drive = read(file)
    names = {"shaft": "--shaft", "joint": "--joint", "damping_ratio": "--damping", "speed": "--speeds"}
    with keys_of(file), watching(_("following the shaft")) as progress:
        try:
            if joint is not None:
                speed = None if speed_rpm is None else speed_rpm * rpm
                pair = joined_rotors(drive, joint, speed=speed, turns=turns, damping_ratio=damping, progress=progress)
                said = _joined(drive, file, *pair)
            elif run_up:
                said = _run(drive, file, *rotor_run(drive, shaft=shaft, damping_ratio=damping, progress=progress))
            else:
                found = rotor_response(drive, shaft=shaft, speed=at, damping_ratio=damping, progress=progress)
                said = _steady(drive, file, found)
        except InputError as error:
            raise error.renamed(lambda field: names.get(field, field)) from error
    return show(said, json=json, csv=csv, plot=plot)


def _steady(drive: Drive, file: Path, found: RotorResponse) -> Answer:
    from cardan.figures import for_result
    from cardan.questions.bending.figures.rotor import sentence

    from .answer import Answer
    from .source import title

    inside = [one for one in found.unstable if found.used and one[1] >= found.used[0] and one[0] <= found.used[1]]
    text = _("{name}: {sentence}")
    return Answer(
        sentence=text.format(name=title(drive, file), sentence=sentence(found)),
        tone="failed" if inside else "plain",
        tables=lambda: (_peaks(found),),
        remarks=tuple(_remarks(file, found)),
        content=lambda: _content(drive, file, found),
        csv=lambda: _rows(found),
        figure=lambda: for_result(found),
        code=1 if inside else 0,
    )


def _peaks(found: RotorResponse) -> Table:
    """Return the orders with where they are largest."""
    from cardan.questions.bending.figures.rotor import ORDERS, order_name
    from cardan.units import rpm

    from .answer import Column, Table

    peaks = {order: found.peak(order) for order in ORDERS}
    least = ROUNDING * max(size for _speed, size in peaks.values())
    rows: list[list[Cell]] = []
    for order, (speed, size) in peaks.items():
        where: list[Cell] = [speed / rpm, speed / found.rotor.critical] if size > least else [None, None]
        rows.append([order_name(order), size / MICRO if size > least else 0.0, *where])
    columns = (
        Column(key="order", heading=_("order"), left=True),
        Column(key="amplitude_um", heading=_("largest"), unit="µm", form="3"),
        Column(key="speed_rpm", heading=_("at"), unit="rpm"),
        Column(key="share", heading=_("over the"), unit=_("critical"), form=".2f"),
    )
    return Table(columns=columns, rows=rows)


def _rows(found: RotorResponse) -> Table:
    from cardan.units import rpm

    from .answer import Column, Table

    orders = [int(one) for one in found.steady.order if abs(one) <= 4]
    keys = ["speed_rpm", *(f"order_{one}_um".replace("-", "minus_") for one in orders), "spectral_radius", "stable"]
    rows: list[list[Cell]] = [
        [
            float(speed) / rpm,
            *(float(found.steady.order_amplitude(one)[k]) / MICRO for one in orders),
            float(found.steady.spectral_radius[k]),
            bool(found.steady.stable[k]),
        ]
        for k, speed in enumerate(found.steady.speed)
    ]
    return Table(columns=tuple(Column(key=key) for key in keys), rows=rows)


def _shaft(one: Rotor) -> Iterator[Remark]:
    """Yield what the shaft is taken for."""
    from cardan.units import rpm

    from .answer import Remark, significant

    text = _("Shaft {number} counts as {mass} kg on {stiffness} N/mm: critical at {speed} rpm, sagging by {sag} µm.")
    yield Remark(
        text=text.format(
            number=one.shaft,
            mass=significant(one.mass, 3),
            stiffness=significant(1e-3 * one.stiffness, 3),
            speed=significant(one.critical / rpm),
            sag=significant(one.sag / MICRO, 3),
        )
    )
    said = _("Its unbalance counts as {amount} g·mm there")
    said += _(", as large as its balance grade allows.") if _guessed(one) else "."
    yield Remark(text=said.format(amount=significant(1e6 * one.unbalance, 3)))
    if one.cracked:
        text = _("Its crack takes {xi} % of its stiffness along it and {eta} % across it while it is open.")
        xi, eta = (significant(100.0 * loss, 3) for loss in one.crack.losses)
        yield Remark(text=text.format(xi=xi, eta=eta))
    else:
        yield Remark(text=_("It has no crack; shafts[{k}].crack in the file gives it one.").format(k=one.shaft - 1))


def _guessed(one: Rotor) -> bool:
    return any(path.endswith(".unbalance") for path in one.assumed)


def _remarks(file: Path, found: RotorResponse) -> Iterator[Remark]:
    from cardan.figures.wording import closely
    from cardan.units import rpm

    from .answer import Remark, significant

    yield from _shaft(found.rotor)
    for low, high in found.unstable:
        text = _("Warning: from {low} to {high} rpm whirling grows by itself, whatever the unbalance.")
        speeds = {"low": significant(low / rpm), "high": significant(high / rpm)}
        yield Remark(text=text.format(**speeds), tone="failed")
    half = found.steady.speed[found.steady.half_order]
    if half.size:
        text = _("About {speed} rpm it grows with half orders.")
        yield Remark(text=text.format(speed=significant(float(half[0]) / rpm)), tone="warning")
    if found.behind is not None:
        sizes = dict(zip(found.behind.order.tolist(), found.behind.size.tolist(), strict=True))
        text = _("The joints before it add {three} % of its force at order 3 and {back} % backward.")
        share = {"three": significant(100.0 * sizes[3], 2), "back": significant(100.0 * sizes[-1], 2)}
        yield Remark(text=text.format(**share))
    largest = float(found.steady.vibration_share[~_nan(found)].max(initial=0.0))
    if found.rotor.cracked and largest > 1.0:
        text = _("At some speeds it vibrates more than it hangs down: there the crack opens otherwise than by weight.")
        yield Remark(text=text, tone="warning")
    text = _("Checked: power and multipliers agree {closely}.")
    yield Remark(text=text.format(closely=closely(_left(found))))
    command = ("cardan", "rotor", str(file), "--plot", "rotor.svg")
    yield Remark(text=_("Orders over the speed, and orbits:"), command=command, tone="next")


def _left(found: RotorResponse) -> float:
    """Return what power and multipliers differ by at most."""
    return float(found.steady.residual[~_nan(found)].max(initial=0.0))


def _nan(found: RotorResponse) -> Any:
    import numpy as np

    return np.isnan(found.steady.residual) | np.isnan(found.steady.vibration_share)


def _described(one: Rotor) -> dict[str, Any]:
    from cardan.units import deg, rpm

    return {
        "shaft": one.shaft,
        "mass_kg": one.mass,
        "stiffness_N_per_m": one.stiffness,
        "critical_rpm": one.critical / rpm,
        "sag_um": one.sag / MICRO,
        "unbalance_g_mm": 1e6 * one.unbalance,
        "unbalance_angle_deg": one.unbalance_angle / deg,
        "crack_losses": list(one.crack.losses),
        "crack_angle_deg": one.crack_angle / deg,
        "breathing": one.crack.breathing,
        "damping_ratio": one.damping_ratio,
        "assumed": list(one.assumed),
    }


def _content(drive: Drive, file: Path, found: RotorResponse) -> dict[str, Any]:
    from cardan.units import rpm

    from .asked import columns_of

    return {
        "question": "rotor",
        "drive": drive.name,
        "file": str(file),
        "rotor": _described(found.rotor),
        "unstable_rpm": [[low / rpm, high / rpm] for low, high in found.unstable],
        "residual": _left(found),
        "half_order_rpm": found.steady.speed[found.steady.half_order] / rpm,
        "behind_joint": None
        if found.behind is None
        else {"order": found.behind.order, "force_share": found.behind.size},
        "response": columns_of(_rows(found)),
    }


def _run(drive: Drive, file: Path, one: Rotor, found: CrackedRun) -> Answer:
    from cardan.questions.bending.figures.rotor import run_figure
    from cardan.units import rpm

    from .answer import Answer, Column, Table
    from .asked import columns_of
    from .source import title

    speed, order, size = found.orders()
    shown = [k for k, number in enumerate(order) if number in (1, 2, 3, -1)]
    keys = [f"order_{order[k]:g}_um".replace("-", "minus_") for k in shown]
    table = Table(
        columns=(
            Column(key="speed_rpm", heading=_("speed"), unit="rpm"),
            *(
                Column(key=key, heading=f"{order[k]:g}×", unit="µm", form="3")
                for key, k in zip(keys, shown, strict=True)
            ),
        ),
        rows=[[float(speed[w]) / rpm, *(float(abs(size[w, k])) / MICRO for k in shown)] for w in range(len(speed))],
    )
    step = max(1, len(table.rows) // SHOWN)
    short = Table(columns=table.columns, rows=table.rows[::step])
    text = _("{name}: {sentence}")
    return Answer(
        sentence=text.format(name=title(drive, file), sentence=run_figure(one.shaft, found).sentence),
        tables=lambda: (short,),
        remarks=tuple(_shaft(one)),
        content=lambda: {
            "question": "rotor",
            "drive": drive.name,
            "file": str(file),
            "rotor": _described(one),
            "peak_um": found.peak / MICRO,
            "peak_rpm": found.peak_speed / rpm,
            "orders": columns_of(table),
        },
        csv=lambda: table,
        figure=lambda: run_figure(one.shaft, found),
    )


def _joined(drive: Drive, file: Path, first: Rotor, second: Rotor, found: CrackedShafts) -> Answer:
    from cardan.figures.wording import closely
    from cardan.questions.bending.figures.rotor import joined_figure
    from cardan.units import rpm

    from .answer import Answer, Column, Remark, Table
    from .asked import columns_of
    from .source import title

    fits = [found.orders(k, turns=8, reach=4) for k in (0, 1)]
    rows: list[list[Cell]] = [
        [int(order), *(float(abs(size[fits[k][0] == order][0])) / MICRO for k, (_o, size) in enumerate(fits))]
        for order in sorted(fits[0][0], key=lambda one: (abs(one), one < 0))
    ]
    table = Table(
        columns=(
            Column(key="order", heading=_("order")),
            Column(key="first_um", heading=_("shaft {number}").format(number=first.shaft), unit="µm", form="3"),
            Column(key="second_um", heading=_("shaft {number}").format(number=second.shaft), unit="µm", form="3"),
        ),
        rows=rows,
    )
    numbers = (first.shaft, second.shaft)
    text = _("{name}: {sentence}")
    remarks = (
        *_shaft(first),
        *_shaft(second),
        Remark(text=_("Orders are of each shaft's own turns, over the last eight; order 0 is where it hangs.")),
        Remark(text=_("Checked: the account of energy closes {closely}.").format(closely=closely(found.residual))),
    )
    return Answer(
        sentence=text.format(name=title(drive, file), sentence=joined_figure(numbers, found).sentence),
        tables=lambda: (table,),
        remarks=remarks,
        content=lambda: {
            "question": "rotor",
            "drive": drive.name,
            "file": str(file),
            "speed_rpm": found.speed / rpm,
            "first": _described(first),
            "second": _described(second),
            "orders": columns_of(table),
            "residual": found.residual,
        },
        csv=lambda: table,
        figure=lambda: joined_figure(numbers, found),
    )
