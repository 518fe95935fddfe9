"""Calculation of a run-up through resonance: of an oscillator, or behind a joint."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from cardan.calc.calculation import Calculation, Values, given, gives
from cardan.calc.motion.kinematics import RIGHT
from cardan.errors import Problem
from cardan.formulas.joint_run_up import joint_run_up
from cardan.formulas.run_up import run_up
from cardan.texts import _, mark

EQUATION = "y''+2 z w0 y'+w0^2 y = w0^2 cos(al t^2/2), rest at t=0"

_SWEEP = ("natural_frequency", "damping_ratio", "sweep_acceleration")
_JOINT = ("alpha", "stiffness", "inertia", "input_acceleration")


def _forms(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    """Yield what misses of the form that was begun, and keys of the other one."""
    begun = [name for name in _SWEEP if values.get(name) is not None or name not in values]
    other = [name for name in _JOINT if values.get(name) is not None or name not in values]
    if not begun and not other:
        text = _("missing; give it for a run-up behind a joint, or {other} for an oscillator")
        yield Problem(key("alpha"), text.format(other=key("natural_frequency")))
        return
    wanted = _SWEEP if begun and not other else _JOINT if other and not begun else ()
    for name in wanted:
        if name in values and values[name] is None:
            yield Problem(key(name), _("missing; {other} needs it").format(other=key((begun or other)[0])))
    if begun and other:
        text = _("not together with {other}: a run-up is that of an oscillator or that behind a joint")
        yield Problem(key(other[0]), text.format(other=key(begun[0])))
    time, end = values.get("t"), values.get("t_max")
    if other and time is not None and end is not None and (time > end).any():
        yield Problem(key("t"), _("later than {end}").format(end=key("t_max")))


def _answer(values: Values) -> Values:
    time, end = values["t"], values["t_max"]
    if values["natural_frequency"] is not None:
        omega, zeta, rate = (values[name] for name in _SWEEP)
        found = run_up(omega, zeta, rate, end, time=time)
        return {
            "y": found.response if time is not None else None,
            "peak_abs": found.peak,
            "peak_time_s": found.peak_time,
            "passing_time_s": found.passing_time,
            "steady_peak_abs": found.steady_peak,
        }
    joint_angle, stiffness, inertia, rise = (values[name] for name in _JOINT)
    joint = joint_run_up(joint_angle, stiffness, inertia, rise, end, damping=values["damping"], time=time)
    return {
        "torque_Nm": joint.torque if time is not None else None,
        "peak_torque_Nm": joint.peak_torque,
        "peak_time_s": joint.peak_time,
        "peak_input_speed_rad_s": joint.peak_speed,
        "critical_speed_order2_rad_s": joint.order2_speed,
    }


CALCULATIONS = (
    Calculation(
        name="run_up",
        doc=mark("peak while running up through resonance: an oscillator under a rising frequency, or behind a joint"),
        source=mark("exact in complex error functions; behind a joint by impulse responses"),
        takes=(
            given(
                "natural_frequency_rad_s",
                mark("natural frequency of the oscillator"),
                "frequency",
                above=0.0,
                default=None,
            ),
            given("damping_ratio", mark("its damping ratio"), above=0.0, below=1.0, default=None),
            given(
                "sweep_acceleration_rad_s2",
                mark("rise of the frequency of its force"),
                "angular_acceleration",
                above=0.0,
                default=None,
            ),
            given("equation", mark("the oscillator's equation"), kind="word", choices=(EQUATION,), default=EQUATION),
            given("alpha_deg", mark("joint angle of the joint"), "angle", low=0.0, below=RIGHT, default=None),
            given(
                "stiffness_Nm_per_rad",
                mark("stiffness of the driven shaft"),
                "turning_stiffness",
                above=0.0,
                default=None,
            ),
            given("inertia_kgm2", mark("inertia at its end"), "inertia", above=0.0, default=None),
            given("damping_Nms_per_rad", mark("damping of the driven shaft"), "turning_damping", low=0.0, default=0.0),
            given(
                "input_acceleration_rad_s2",
                mark("acceleration of the driving shaft"),
                "angular_acceleration",
                above=0.0,
                default=None,
            ),
            given("t_s", mark("instants of the curve"), "time", axes=(1,), low=0.0, default=None),
            given("t_max_s", mark("end of the run"), "time", above=0.0),
        ),
        returns=(
            gives("y", mark("response at the instants, over the static one")),
            gives("torque_Nm", mark("torque at the instants"), "torque"),
            gives("peak_abs", mark("largest response")),
            gives("peak_torque_Nm", mark("largest torque"), "torque"),
            gives("peak_time_s", mark("when"), "time"),
            gives("peak_input_speed_rad_s", mark("input speed then"), "angular_speed"),
            gives("passing_time_s", mark("when the frequency of the force passes the natural one"), "time"),
            gives("steady_peak_abs", mark("largest steady response: the limit of a slow run-up")),
            gives(
                "critical_speed_order2_rad_s",
                mark("speed at which order 2 meets the natural frequency"),
                "angular_speed",
            ),
        ),
        answer=_answer,
        check=_forms,
    ),
)
