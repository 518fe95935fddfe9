"""What ``cardan torsion absorber`` gives to programs: its curves over the speed, and everything it knows."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from cardan.drive.drive import Drive
    from cardan.questions.torsion.absorber.absorber import Absorber
    from cardan.questions.torsion.absorber.absorber_search import Setting

    from .answer import Cell, Table


def rows(found: Absorber) -> Table:
    """Return the curves over the speed."""
    from cardan.units import deg, rpm

    from .answer import Column, Table

    many = range(1, len(found.elements) + 1)
    keys = ["speed_rpm"]
    for word in ("before", "closed_form", "best"):
        keys += [f"{word}_swing_{k}_Nm" for k in many]
    keys += ["absorber_torque_Nm", "absorber_swing_deg", "absorber_heat_W"]
    table: list[list[Cell]] = [
        [
            float(found.speed[s]) / rpm,
            *(float(one) for curve in (found.before, found.closed, found.after) for one in curve[s]),
            float(found.torque[s]),
            float(found.twist[s]) / deg,
            float(found.heat[s]),
        ]
        for s in range(len(found.speed))
    ]
    return Table(columns=tuple(Column(key=key) for key in keys), rows=table)


def content(drive: Drive, file: Path, found: Absorber) -> dict[str, Any]:
    """Return everything that is known, for a program."""
    from cardan.io.stations import station_text
    from cardan.units import deg, rpm

    from .asked import columns_of

    return {
        "question": "torsion absorber",
        "drive": drive.name,
        "file": str(file),
        "kind": found.kind,
        "station": {"number": found.host.station + 1, "name": found.host.name, "shaft": found.host.shaft},
        "mode": found.mode,
        "frequency_Hz": found.omega / 6.283185307179586,
        "order": found.order,
        "inertia_ratio": found.inertia_ratio,
        "tuned_speed_rpm": None if found.tuned_speed is None else found.tuned_speed / rpm,
        "without": {"swing_Nm": found.bare.peak, "at_rpm": found.bare.peak_speed / rpm},
        "closed_form": _setting(found, found.closed_form),
        "best": _setting(found, found.best),
        "stations": [
            {"number": k + 1, "name": host.name, "modal_inertia_kg_m2": float(found.modal_inertia[k])}
            for k, host in enumerate(found.hosts)
        ],
        "elements": list(found.elements),
        "judged": [k + 1 for k in found.judged],
        "largest_twist_deg": float(max(found.twist)) / deg,
        "largest_torque_Nm": float(max(found.torque)),
        "largest_heat_W": float(max(found.heat)),
        "unstable_before_rpm": found.unstable_before / rpm,
        "unstable_after_rpm": found.unstable_after / rpm,
        "evaluations": found.evaluations,
        "converged": found.converged,
        "cancelled": found.cancelled,
        "play_closed": found.play,
        "assumed": found.assumed,
        "station_toml": station_text(found.drive, found.table),
        "curves": columns_of(rows(found)),
    }


def _setting(found: Absorber, setting: Setting) -> dict[str, Any]:
    from cardan.units import mm, rpm

    own: dict[str, Any] = {"inertia_kg_m2": setting.inertia}
    if setting.arm is None:
        own |= {"stiffness_Nm_per_rad": setting.stiffness, "damping_Nms_per_rad": setting.damping}
        own |= {"damping_ratio": found.damping_ratio(setting)}
    else:
        own |= {"arm_mm": setting.arm / mm}
    place = found.elements[setting.peak_element]
    return own | {
        "frequency_ratio": found.frequency_ratio(setting),
        "swing_Nm": setting.peak,
        "at_rpm": setting.peak_speed / rpm,
        "element": place,
    }
