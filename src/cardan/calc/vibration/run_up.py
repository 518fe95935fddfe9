"""Run-up through resonance: of an oscillator, or behind a joint."""

from __future__ import annotations

from typing import Any

from cardan.calc.calculation import Formulas, Problems, Values
from cardan.formulas.joint_run_up import joint_run_up
from cardan.formulas.run_up import run_up
from cardan.reading.given import at_least_zero, positive, word, yoke_rotation
from cardan.texts import _

formula = Formulas(__doc__)


EQUATION = "y''+2 z w0 y'+w0^2 y = w0^2 cos(al t^2/2), rest at t=0"

_SWEEP = ("natural_frequency", "damping_ratio", "sweep_acceleration")
_JOINT = ("alpha", "stiffness", "inertia", "input_acceleration")


def _forms(v: Values) -> Problems:
    """Yield what misses of the form that was begun, and keys of the other one."""
    begun = [name for name in _SWEEP if v.get(name) is not None or name not in v]
    other = [name for name in _JOINT if v.get(name) is not None or name not in v]
    if not begun and not other:
        text = _("missing; give it for a run-up behind a joint, or {other} for an oscillator")
        yield v.wrong("alpha", text.format(other=v.key("natural_frequency")))
        return
    wanted = _SWEEP if begun and not other else _JOINT if other and not begun else ()
    for name in wanted:
        if name in v and v[name] is None:
            yield v.wrong(name, _("missing; {other} needs it").format(other=v.key((begun or other)[0])))
    if begun and other:
        text = _("not together with {other}: a run-up is that of an oscillator or that behind a joint")
        yield v.wrong(other[0], text.format(other=v.key(begun[0])))
    time, end = v.get("t"), v.get("t_max")
    if other and time is not None and end is not None and (time > end).any():
        yield v.wrong("t", _("later than {end}").format(end=v.key("t_max")))


@formula(
    "peak while running up through resonance: an oscillator under a rising frequency, or behind a joint",
    "exact in complex error functions; behind a joint by impulse responses",
    positive("natural_frequency_rad_s", "natural frequency of the oscillator", "frequency", default=None),
    positive("damping_ratio", "its damping ratio", below=1.0, default=None),
    positive("sweep_acceleration_rad_s2", "rise of the frequency of its force", default=None),
    word("equation", "the oscillator's equation", EQUATION, default=EQUATION),
    yoke_rotation("alpha_deg", "joint angle of the joint", default=None),
    positive("stiffness_Nm_per_rad", "stiffness of the driven shaft", default=None),
    positive("inertia_kgm2", "inertia at its end", default=None),
    at_least_zero("damping_Nms_per_rad", "damping of the driven shaft", default=0.0),
    positive("input_acceleration_rad_s2", "acceleration of the driving shaft", default=None),
    at_least_zero("t_s", "instants of the curve", axes=1, default=None),
    positive("t_max_s", "end of the run"),
    "y: response at the instants, over the static one",
    "torque_Nm: torque at the instants",
    "peak_abs: largest response",
    "peak_torque_Nm: largest torque",
    "peak_time_s: when",
    "peak_input_speed_rad_s: input speed then",
    "passing_time_s: when the frequency of the force passes the natural one",
    "steady_peak_abs: largest steady response: the limit of a slow run-up",
    "critical_speed_order2_rad_s: speed at which order 2 meets the natural frequency",
    check=_forms,
)
def _run_up(v: Values) -> Any:
    time, end = v.t, v.t_max
    if v.natural_frequency is not None:
        omega, zeta, rate = (v[name] for name in _SWEEP)
        found = run_up(omega, zeta, rate, end, time=time)
        return {
            "y": found.response if time is not None else None,
            "peak_abs": found.peak,
            "peak_time_s": found.peak_time,
            "passing_time_s": found.passing_time,
            "steady_peak_abs": found.steady_peak,
        }
    joint_angle, stiffness, inertia, rise = (v[name] for name in _JOINT)
    joint = joint_run_up(joint_angle, stiffness, inertia, rise, end, damping=v.damping, time=time)
    return {
        "torque_Nm": joint.torque if time is not None else None,
        "peak_torque_Nm": joint.peak_torque,
        "peak_time_s": joint.peak_time,
        "peak_input_speed_rad_s": joint.peak_speed,
        "critical_speed_order2_rad_s": joint.order2_speed,
    }
