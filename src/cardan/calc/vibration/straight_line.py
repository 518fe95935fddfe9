"""Straight lines of shafts: natural frequencies and forced torsional vibration."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from cardan.book.straight_line import line_modes, line_response
from cardan.calc.calculation import Formulas, Problems, Values
from cardan.errors import Problem, check
from cardan.reading.given import at_least_zero, given, gives, positive, whole
from cardan.texts import _

formula = Formulas(__doc__)


INERTIA = at_least_zero("inertia_kgm2", "inertia of each station", axes=1)
STIFFNESS = positive("stiffness_Nm_per_rad", "stiffness of each element between neighbouring stations", axes=1)


def fitting(*names: str) -> Callable[[Values], Problems]:
    """Return a check that a line has inertia, and a value of each named list for each of its elements."""

    def problems(v: Values) -> Problems:
        inertia = v.get("inertia")
        if inertia is None:
            return
        if not inertia.size or not np.any(inertia):
            yield v.wrong("inertia", _("no station has inertia"))
            return
        for name in ("stiffness", *names):
            listed = v.get(name)
            if listed is not None and listed.size != inertia.size - 1:
                text = _("{given} values given, {wanted} needed")
                yield v.wrong(name, text.format(given=listed.size, wanted=inertia.size - 1))
        station = v.get("torque_station")
        if station is not None and station > inertia.size:
            text = _("station {given} of {count}")
            yield v.wrong("torque_station", text.format(given=station, count=inertia.size))

    return problems


@formula(
    "torsional natural frequencies of a straight free line of shafts, and the speeds that meet them",
    "(K - ω²J) x = 0 with ratio 1 at every joint",
    (INERTIA, STIFFNESS),
    gives("omega_rad_s", "natural frequencies, 0 for the free turning", "frequency"),
    "order2_critical_speed_rpm: speeds at which order 2 meets them",
    "parametric_principal_speed_rpm: speeds of the principal parametric zones",
    "mode_shape: angle of each station in each mode, the largest 1",
    check=fitting(),
)
def _torsional_natural_frequencies(v: Values) -> Any:
    found = line_modes(v.inertia, v.stiffness)
    there = np.isfinite(found.omega)
    swinging = there & (found.omega > 0.0)
    return found.omega[there], found.order2_speed[swinging], found.parametric_speed[swinging], found.shape[there]


@formula(
    "steady torsional vibration of a straight line of shafts under a harmonic torque at one station",
    "complex stiffness c(1 + iη) + iωb of each element",
    (INERTIA, STIFFNESS),
    at_least_zero("damping_Nms_per_rad", "viscous damping of each element", axes=1, default=None),
    at_least_zero("loss_factor", "structural damping of each element", axes=1, default=None),
    whole("torque_station", "station of the torque, counted from 1", low=1),
    given("torque_amplitude_Nm", "amplitude of the torque", default=1.0),
    at_least_zero("omega_rad_s", "frequency of the torque", "frequency", axes=(0, 1)),
    "station_amplitude_rad: amplitude of each station",
    "element_torque_Nm: amplitude of the torque in each element",
    check=fitting("damping", "loss_factor"),
)
def _linear_forced_response(v: Values) -> Any:
    inertia, omega = v.inertia, v.omega
    torque = np.zeros(inertia.size)
    torque[v.torque_station - 1] = v.torque_amplitude
    found = line_response(
        inertia,
        v.stiffness,
        np.atleast_1d(omega),
        torque,
        damping=v.damping if v.damping is not None else 0.0,
        loss_factor=v.loss_factor if v.loss_factor is not None else 0.0,
    )
    text = _("{omega:.9g} rad/s is a natural frequency and nothing damps it: the vibration grows without end")
    at = np.flatnonzero(found.resonant)
    check([Problem("omega", text.format(omega=found.omega[at[0]]))] if at.size else [])
    single = np.ndim(omega) == 0
    return {
        "station_amplitude_rad": np.abs(found.angle[:, 0] if single else found.angle),
        "element_torque_Nm": np.abs(found.torque[:, 0] if single else found.torque),
    }
