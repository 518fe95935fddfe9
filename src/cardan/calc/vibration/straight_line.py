"""Calculations of straight lines of shafts: natural frequencies and forced torsional vibration."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from cardan.book.straight_line import line_modes, line_response
from cardan.calc.calculation import Calculation, Values, given, gives
from cardan.errors import Problem, check
from cardan.texts import _, mark

INERTIA = given("inertia_kgm2", mark("inertia of each station"), "inertia", axes=(1,), low=0.0)
STIFFNESS = given(
    "stiffness_Nm_per_rad",
    mark("stiffness of each element between neighbouring stations"),
    "turning_stiffness",
    axes=(1,),
    above=0.0,
)


def fitting(*names: str) -> Callable[[Values, Callable[[str], str]], Iterator[Problem]]:
    """Return a check that a line has inertia, and a value of each named list for each of its elements."""

    def problems(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
        inertia = values.get("inertia")
        if inertia is None:
            return
        if not inertia.size or not np.any(inertia):
            yield Problem(key("inertia"), _("no station has inertia"))
            return
        for name in ("stiffness", *names):
            listed = values.get(name)
            if listed is not None and listed.size != inertia.size - 1:
                text = _("{given} values given, {wanted} needed")
                yield Problem(key(name), text.format(given=listed.size, wanted=inertia.size - 1))
        station = values.get("torque_station")
        if station is not None and station > inertia.size:
            text = _("station {given} of {count}")
            yield Problem(key("torque_station"), text.format(given=station, count=inertia.size))

    return problems


def _modes(values: Values) -> Values:
    found = line_modes(values["inertia"], values["stiffness"])
    there = np.isfinite(found.omega)
    swinging = there & (found.omega > 0.0)
    return {
        "omega_rad_s": found.omega[there],
        "order2_critical_speed_rpm": found.order2_speed[swinging],
        "parametric_principal_speed_rpm": found.parametric_speed[swinging],
        "mode_shape": found.shape[there],
    }


def _forced(values: Values) -> Values:
    inertia, omega = values["inertia"], values["omega"]
    torque = np.zeros(inertia.size)
    torque[values["torque_station"] - 1] = values["torque_amplitude"]
    found = line_response(
        inertia,
        values["stiffness"],
        np.atleast_1d(omega),
        torque,
        damping=values["damping"] if values["damping"] is not None else 0.0,
        loss_factor=values["loss_factor"] if values["loss_factor"] is not None else 0.0,
    )
    text = _("{omega:.9g} rad/s is a natural frequency and nothing damps it: the vibration grows without end")
    at = np.flatnonzero(found.resonant)
    check([Problem("omega", text.format(omega=found.omega[at[0]]))] if at.size else [])
    single = np.ndim(omega) == 0
    return {
        "station_amplitude_rad": np.abs(found.angle[:, 0] if single else found.angle),
        "element_torque_Nm": np.abs(found.torque[:, 0] if single else found.torque),
    }


CALCULATIONS = (
    Calculation(
        name="torsional_natural_frequencies",
        doc=mark("torsional natural frequencies of a straight free line of shafts, and the speeds that meet them"),
        source=mark("(K - ω²J) x = 0 with ratio 1 at every joint"),
        takes=(INERTIA, STIFFNESS),
        returns=(
            gives("omega_rad_s", mark("natural frequencies, 0 for the free turning"), "frequency"),
            gives("order2_critical_speed_rpm", mark("speeds at which order 2 meets them"), "angular_speed"),
            gives("parametric_principal_speed_rpm", mark("speeds of the principal parametric zones"), "angular_speed"),
            gives("mode_shape", mark("angle of each station in each mode, the largest 1")),
        ),
        answer=_modes,
        check=fitting(),
    ),
    Calculation(
        name="linear_forced_response",
        doc=mark("steady torsional vibration of a straight line of shafts under a harmonic torque at one station"),
        source=mark("complex stiffness c(1 + iη) + iωb of each element"),
        takes=(
            INERTIA,
            STIFFNESS,
            given(
                "damping_Nms_per_rad",
                mark("viscous damping of each element"),
                "turning_damping",
                axes=(1,),
                low=0.0,
                default=None,
            ),
            given("loss_factor", mark("structural damping of each element"), axes=(1,), low=0.0, default=None),
            given("torque_station", mark("station of the torque, counted from 1"), kind="whole", low=1),
            given("torque_amplitude_Nm", mark("amplitude of the torque"), "torque", default=1.0),
            given("omega_rad_s", mark("frequency of the torque"), "frequency", axes=(0, 1), low=0.0),
        ),
        returns=(
            gives("station_amplitude_rad", mark("amplitude of each station"), "angle"),
            gives("element_torque_Nm", mark("amplitude of the torque in each element"), "torque"),
        ),
        answer=_forced,
        check=fitting("damping", "loss_factor"),
    ),
)
