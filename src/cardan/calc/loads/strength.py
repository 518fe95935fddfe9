"""Strength of shafts, splines, yokes and crosses: design torque, stress, twist, fatigue, composite tubes."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from cardan.calc.bores import bores, segment_bores
from cardan.calc.calculation import Calculation, Formulas, Problems, Values
from cardan.drive.models.dynamics_model import spline_grip
from cardan.drive.shaft import Layup, Ply
from cardan.formulas.critical_speed import uniform_speed
from cardan.formulas.part_strength import journal_stress, spline_stress, yoke_stress
from cardan.formulas.shaft_strength import (
    FINISHES,
    RATED_TWIST,
    RELIABILITIES,
    composite_tube,
    design_torque,
    shaft_diameter,
    shaft_fatigue,
    shaft_stress,
    shaft_twist,
    wheel_load,
)
from cardan.reading.given import at_least_zero, given, gives, positive, record, rows, word
from cardan.texts import _

from .forces import SPLINE_THRUST

formula = Formulas(__doc__)


def _engine(v: Values) -> Problems:
    """Yield what misses of the engine and of the wheels."""
    names = ("engine_torque", "engine_power", "engine_speed")
    torque, power, speed = (v.get(name, math.nan) for name in names)
    if torque is None:
        for name, value in (("engine_torque", power), ("engine_speed", speed)):
            if value is None:
                yield v.wrong(name, _("missing: give the engine's torque, or its power and speed"), "missing")
    elif power is not None and not any(math.isnan(one) for one in (torque, power)):
        yield v.wrong("engine_power", _("engine_torque gives the same already"), "inconsistent")
    wheel = {name: v.get(name, math.nan) for name in ("wheel_load", "friction", "wheel_radius")}
    if any(value is not None for value in wheel.values()):
        for name, value in wheel.items():
            if value is None:
                yield v.wrong(name, _("missing: the adhesion limit needs it beside the others"), "missing")


def _unless_endless(value: Any) -> float:
    """Return a number, nan for none where it is infinite."""
    return math.nan if math.isinf(value) else float(value)


def _fatigue_check(v: Values) -> Problems:
    yield from bores("d_out", "d_in")(v)
    if {"Sut", "Sy"} <= v.keys() and v.Sy > v.Sut:
        text = _("{yields:.6g} MPa is above the tensile strength, {breaks:.6g} MPa")
        message = text.format(yields=1e-6 * v.Sy, breaks=1e-6 * v.Sut)
        yield v.wrong("Sy", message, "inconsistent")


def _plies(v: Values) -> Problems:
    layup = v.get("layup")
    if layup is not None and not len(layup):
        yield v.wrong("layup", _("empty; a tube has at least one ply"), "empty")
    elif layup is not None and len(layup) * v.get("ply_thickness", 0.0) >= v.get("mean_d", math.inf):
        yield v.wrong("ply_thickness", _("the plies are thicker than the tube"), "out_of_range")
    if {"E1", "E2", "nu12"} <= v.keys() and v.nu12**2 * v.E2 >= v.E1:
        yield v.wrong("nu12", _("no material has this: ν12² E2 must be less than E1"), "inconsistent")


TORQUE = at_least_zero("torque_Nm", "torque")
SEGMENT = (
    positive("length_mm", "length"),
    positive("d_out_mm", "outer diameter"),
    at_least_zero("d_in_mm", "inner diameter", default=0.0),
)
OUTER = positive("d_out_mm", "outer diameter")
INNER = at_least_zero("d_in_mm", "inner diameter", default=0.0)


@formula(
    "torque that a vehicle's shaft must carry: what the engine brings, limited by the wheels' adhesion",
    "power balance; web articles on drive shafts, examples 26.1 and 26.2, corrected",
    word("kind", "which shaft", "propshaft", "halfshaft"),
    at_least_zero("engine_torque_Nm", "largest torque of the engine", default=None),
    at_least_zero("engine_power_W", "power of the engine", default=None),
    positive("engine_speed_rpm", "engine speed at that power", default=None),
    positive("gear_ratio", "engine speed over shaft speed"),
    positive("axle_ratio", "shaft speed over wheel speed"),
    positive("efficiency", "efficiency from the engine to the shaft", default=1.0, high=1.0),
    positive("split_fraction", "share of the torque that this shaft carries", None, default=1.0, high=1.0),
    positive("dynamic_factor", "factor for jerks", default=1.0),
    at_least_zero("wheel_load_N", "load on the wheels that this shaft drives", default=None),
    at_least_zero("friction", "adhesion of these wheels", default=None),
    positive("wheel_radius_m", "their rolling radius", default=None),
    "torque_drive_Nm: what the engine brings",
    "torque_adhesion_Nm: what the wheels can pass on",
    "torque_design_Nm: design torque",
    "governed_by: drive or adhesion",
    check=_engine,
)
def _design_torque(v: Values) -> Any:
    torque = v.engine_torque
    if torque is None:
        torque = v.engine_power / v.engine_speed
    names = ("gear_ratio", "axle_ratio", "efficiency", "split_fraction", "dynamic_factor")
    limits = ("wheel_load", "friction", "wheel_radius")
    found = design_torque(torque, halfshaft=v.kind == "halfshaft", **{name: v[name] for name in names + limits})
    return found.drive, found.adhesion, found.design, "adhesion" if bool(found.by_adhesion) else "drive"


@formula(
    "load on the wheels above which they pass a torque without slipping",
    "adhesion, T = μ W r",
    TORQUE,
    positive("friction", "adhesion of the wheels"),
    positive("wheel_radius_m", "their rolling radius"),
    "wheel_load_N: load on the wheels",
)
def _wheel_load_max(v: Values) -> Any:
    return wheel_load(v.torque, v.friction, v.wheel_radius)


@formula(
    "stresses of a round shaft under torque and bending",
    "Kozhevnikov & Perfil'ev (1978), eq. 261",
    TORQUE,
    at_least_zero("bending_Nm", "bending moment", default=0.0),
    (OUTER, INNER),
    "tau_torsion_MPa: shear stress of torsion",
    "sigma_bending_MPa: bending stress",
    "tau_resultant_MPa: largest shear stress (Tresca)",
    "sigma_mises_MPa: equivalent stress by von Mises",
    check=bores("d_out", "d_in"),
)
def _shaft_stress(v: Values) -> Any:
    found = shaft_stress(v.torque, v.bending, v.d_out, v.d_in)
    return found.torsion, found.bending, found.shear, found.mises


@formula(
    "outer diameter of a shaft that carries a torque",
    "Kozhevnikov & Perfil'ev (1978), eq. 261",
    TORQUE,
    at_least_zero("bore_ratio", "inner over outer diameter", default=0.0, below=1.0),
    positive("tau_allow_MPa", "shear stress allowed"),
    "d_out_mm: outer diameter",
)
def _shaft_diameter(v: Values) -> Any:
    return shaft_diameter(v.torque, v.tau_allow, v.bore_ratio)


@formula(
    "twist of a stepped shaft under torque",
    "Kozhevnikov & Perfil'ev (1978), eq. 262, with the torque alone",
    given("torque_Nm", "torque"),
    positive("G_GPa", "shear modulus"),
    rows("segments", "segments along the shaft", *SEGMENT),
    "twist_deg: twist",
    gives("within_9_deg", "whether it keeps the book's 9°", None),
    check=segment_bores("d_out", "d_in"),
)
def _shaft_twist(v: Values) -> Any:
    parts = {name: [row[name] for row in v.segments] for name in ("length", "d_out", "d_in")}
    twist = shaft_twist(v.torque, v.G, parts["length"], parts["d_out"], parts["d_in"])
    return twist, bool(np.abs(twist) <= RATED_TWIST)


@formula(
    "fatigue of a shaft under swinging torque and turning bending",
    "Goodman with Marin's factors, Shigley, chapter 6",
    at_least_zero("T_mean_Nm", "mean torque"),
    at_least_zero("T_alt_Nm", "amplitude of the torque"),
    at_least_zero("M_mean_Nm", "mean bending moment"),
    at_least_zero("M_alt_Nm", "amplitude of the bending moment"),
    (OUTER, INNER),
    positive("Sut_MPa", "tensile strength"),
    positive("Sy_MPa", "yield strength"),
    word("finish", "surface", *FINISHES),
    given("Kf", "notch factor in bending", default=1.0, low=1.0),
    given("Kfs", "notch factor in torsion", default=1.0, low=1.0),
    given("reliability_percent", "share of parts that last", low=min(RELIABILITIES), high=max(RELIABILITIES)),
    "Se_MPa = endurance: fatigue limit of the part",
    "sigma_a_eq_MPa = alternating: equivalent amplitude",
    "sigma_m_eq_MPa = mean: equivalent mean stress",
    "n_goodman: safety against fatigue",
    "n_yield: safety against yielding",
    "life_cycles: cycles to failure; none when endless",
    check=_fatigue_check,
)
def _fatigue(v: Values) -> Any:
    found = shaft_fatigue(
        **v.of(
            "finish",
            "reliability",
            mean_torque="T_mean",
            swinging_torque="T_alt",
            mean_bending="M_mean",
            swinging_bending="M_alt",
            outer="d_out",
            inner="d_in",
            ultimate="Sut",
            yield_strength="Sy",
            bending_notch="Kf",
            torsion_notch="Kfs",
        )
    )
    return found, {
        "n_goodman": _unless_endless(found.safety),
        "n_yield": _unless_endless(found.yield_safety),
        "life_cycles": _unless_endless(found.cycles),
    }


@formula(
    "moduli, critical speed, buckling torque and mass of a tube of fibre composite",
    "classical laminate theory",
    given("layup_deg", "angles of the plies from the axis, from the inside out", axes=1),
    positive("ply_thickness_mm", "thickness of a ply"),
    positive("mean_d_mm", "diameter of the middle of the wall"),
    positive("length_mm", "length between the joints"),
    positive("E1_GPa", "Young's modulus along the fibres"),
    positive("E2_GPa", "Young's modulus across the fibres"),
    positive("G12_GPa", "shear modulus"),
    given("nu12", "Poisson's ratio", above=-1.0, below=1.0),
    positive("density_kg_m3", "density"),
    "E_x_GPa: modulus along the axis",
    "E_y_GPa: modulus around it",
    "G_xy_GPa: shear modulus",
    "n_critical_rpm: critical speed between two joints",
    "torque_buckling_Nm: torque at which the wall buckles",
    "mass_kg: mass between the joints",
    check=_plies,
)
def _composite_tube(v: Values) -> Any:
    ply = Ply(**v.of("density", along="E1", across="E2", shear="G12", poisson="nu12"))
    layup = Layup(angles=tuple(map(float, v.layup)), ply_thickness=v.ply_thickness, ply=ply)
    found = composite_tube(layup, v.mean_d)
    outer, inner = v.mean_d + found.thickness, v.mean_d - found.thickness
    speed = uniform_speed(v.length, outer, inner, found.along, v.density, modes=1)[0]
    return found.along, found.around, found.shear, speed, found.buckling_torque, found.mass_per_length * v.length


@dataclass(frozen=True, kw_only=True, slots=True)
class Forms(Calculation):
    """A calculation that is asked in several ways, told apart by the keys given."""

    forms: tuple[Calculation, ...]

    def __call__(self, inputs: Mapping[str, Any]) -> dict[str, Any]:
        """Return the answer of the form that knows most of the keys, the first one of equals."""
        known = [sum(item.key in inputs for item in form.takes) for form in self.forms]
        return self.forms[known.index(max(known))](inputs)


def _flanks(v: Values) -> Problems:
    wrong = list(bores("D", "d")(v))
    yield from wrong
    if wrong or not {"D", "d", "chamfer"} <= v.keys():
        return
    if 0.5 * (v.D - v.d) <= 2.0 * v.chamfer:
        text = _("{chamfer:.6g} mm leaves no height of the flanks: (D - d)/2 - 2c must be more than 0")
        yield v.wrong("chamfer", text.format(chamfer=1e3 * v.chamfer), "out_of_range")


SHAPES = {"rect": "rectangle", "ellipse": "ellipse"}

FORCE = at_least_zero("journal_force_N", "force on a journal")


@formula(
    "stresses of a straight-sided spline",
    "Kozhevnikov & Perfil'ev (1978), p. 228, pressure and shear of the teeth, torsion at the smallest diameter",
    positive("D_mm", "outer diameter"),
    positive("d_mm", "root diameter"),
    positive("teeth", "number of teeth", kind="whole"),
    positive("tooth_width_mm", "width of a tooth"),
    positive("length_mm", "length of the teeth"),
    TORQUE,
    at_least_zero("chamfer_mm", "chamfer", default=0.0),
    positive("load_share", "share of the teeth that carry", default=0.75, high=1.0),
    "d_m_mm: mean diameter",
    "h_mm: height of the flanks that bear",
    "sigma_crush_MPa: pressure on the flanks",
    "tau_tooth_MPa: shear at the roots of the teeth",
    "tau_core_MPa: torsion at the root diameter",
    check=_flanks,
)
def _spline(v: Values) -> Any:
    found = spline_stress(
        v.torque, outer=v.D, root=v.d, **v.of("teeth", "tooth_width", "length", "chamfer", "load_share")
    )
    return found.mean_diameter, found.height, found.pressure, found.tooth_shear, found.core_shear


@formula(
    "stresses of the arm of a yoke",
    "Kozhevnikov & Perfil'ev (1978), eq. 263; Saint-Venant's torsion",
    FORCE,
    at_least_zero("bending_arm_mm", "arm of the force for bending"),
    at_least_zero("torsion_arm_mm", "arm of the force for torsion"),
    record(
        "section",
        "weakest section",
        word("shape", "shape of the section", *SHAPES),
        positive("height_mm", "height along the force"),
        positive("width_mm", "width across the force"),
    ),
    "sigma_bending_MPa: bending stress",
    "tau_torsion_MPa: shear stress of torsion",
    "sigma_mises_MPa: equivalent stress by von Mises",
)
def _yoke(v: Values) -> Any:
    section = v.section
    found = yoke_stress(
        v.journal_force,
        bending_arm=v.bending_arm,
        torsion_arm=v.torsion_arm,
        height=section.height,
        width=section.width,
        shape=SHAPES[section.shape],
    )
    return found.bending, found.shear, found.mises


@formula(
    "stresses at the root of a journal of the cross",
    "Kozhevnikov & Perfil'ev (1978), eq. 264, 265, with the grease bore",
    FORCE,
    positive("length_mm", "length of the journal"),
    positive("d_mm", "diameter"),
    at_least_zero("bore_mm", "diameter of the grease bore", default=0.0),
    at_least_zero("arm_mm", "arm of the force; half the length when not given", default=None),
    "sigma_bending_MPa: bending stress",
    "tau_mean_MPa: mean shear stress",
    "tau_max_MPa: largest shear stress",
    check=bores("d", "bore"),
)
def _journal(v: Values) -> Any:
    arm = 0.5 * v.length if v.arm is None else v.arm
    found = journal_stress(v.journal_force, diameter=v.d, arm=arm, bore=v.bore)
    return found.bending, found.mean_shear, found.shear


@formula(
    "friction thrust of a spline: its parts in the joint, or the thrust alone",
    SPLINE_THRUST.source,
    *SPLINE_THRUST.takes,
    *(
        thrust_keys := (
            at_least_zero("torque_Nm", "torque at the spline, for the thrust alone"),
            positive("d_m_mm", "its mean diameter"),
            at_least_zero("friction", "its coefficient of friction"),
            at_least_zero("pressure_angle_deg", "pressure angle of its teeth", default=0.0, below=0.5 * math.pi),
        )
    ),
    *SPLINE_THRUST.returns,
    "axial_force_N: friction thrust",
    forms=(
        SPLINE_THRUST,
        Calculation(
            name="spline_axial_force",
            doc="friction thrust of a spline",
            source="Kozhevnikov & Perfil'ev (1978), eq. 123",
            takes=thrust_keys,
            returns=(gives("axial_force_N", "friction thrust"),),
            answer=lambda v: spline_grip(v.friction, v.d_m, v.pressure_angle) * v.torque,
        ),
    ),
    kind=Forms,
)
def _spline_axial_force(v: Values) -> Any:
    return dict(v)
