"""Calculations of the strength of shafts: design torque, stress, diameter, twist, fatigue, tubes of composite."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from cardan.calc.bores import bores, segment_bores
from cardan.calc.calculation import Calculation, Values, at_least_zero, given, gives, positive, rows
from cardan.drive.shaft import Layup, Ply
from cardan.errors import Problem
from cardan.formulas.composite_tube import composite_tube
from cardan.formulas.critical_speed import uniform_speed
from cardan.formulas.design_torque import design_torque, wheel_load
from cardan.formulas.fatigue import FINISHES, RELIABILITIES, shaft_fatigue
from cardan.formulas.shaft_strength import RATED_TWIST, shaft_diameter, shaft_stress, shaft_twist
from cardan.texts import _, mark


def _design(values: Values) -> Values:
    torque = values["engine_torque"]
    if torque is None:
        torque = values["engine_power"] / values["engine_speed"]
    names = ("gear_ratio", "axle_ratio", "efficiency", "split_fraction", "dynamic_factor")
    limits = ("wheel_load", "friction", "wheel_radius")
    found = design_torque(
        torque, halfshaft=values["kind"] == "halfshaft", **{name: values[name] for name in names + limits}
    )
    return {
        "torque_drive_Nm": found.drive,
        "torque_adhesion_Nm": found.adhesion,
        "torque_design_Nm": found.design,
        "governed_by": "adhesion" if bool(found.by_adhesion) else "drive",
    }


def _engine(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    """Yield what misses of the engine and of the wheels."""
    names = ("engine_torque", "engine_power", "engine_speed")
    torque, power, speed = (values.get(name, math.nan) for name in names)
    if torque is None:
        for name, value in (("engine_torque", power), ("engine_speed", speed)):
            if value is None:
                yield Problem(key(name), _("missing: give the engine's torque, or its power and speed"), "missing")
    elif power is not None and not any(math.isnan(one) for one in (torque, power)):
        yield Problem(key("engine_power"), _("engine_torque gives the same already"), "inconsistent")
    wheel = {name: values.get(name, math.nan) for name in ("wheel_load", "friction", "wheel_radius")}
    if any(value is not None for value in wheel.values()):
        for name, value in wheel.items():
            if value is None:
                yield Problem(key(name), _("missing: the adhesion limit needs it beside the others"), "missing")


def _stress(values: Values) -> Values:
    found = shaft_stress(values["torque"], values["bending"], values["d_out"], values["d_in"])
    return {
        "tau_torsion_MPa": found.torsion,
        "sigma_bending_MPa": found.bending,
        "tau_resultant_MPa": found.shear,
        "sigma_mises_MPa": found.mises,
    }


def _twist(values: Values) -> Values:
    parts = {name: [row[name] for row in values["segments"]] for name in ("length", "d_out", "d_in")}
    twist = shaft_twist(values["torque"], values["G"], parts["length"], parts["d_out"], parts["d_in"])
    return {"twist_deg": twist, "within_9_deg": bool(np.abs(twist) <= RATED_TWIST)}


def _fatigue(values: Values) -> Values:
    found = shaft_fatigue(
        mean_torque=values["T_mean"],
        swinging_torque=values["T_alt"],
        mean_bending=values["M_mean"],
        swinging_bending=values["M_alt"],
        outer=values["d_out"],
        inner=values["d_in"],
        ultimate=values["Sut"],
        yield_strength=values["Sy"],
        finish=values["finish"],
        bending_notch=values["Kf"],
        torsion_notch=values["Kfs"],
        reliability=values["reliability"],
    )
    return {
        "Se_MPa": found.endurance,
        "sigma_a_eq_MPa": found.alternating,
        "sigma_m_eq_MPa": found.mean,
        "n_goodman": _unless_endless(found.safety),
        "n_yield": _unless_endless(found.yield_safety),
        "life_cycles": _unless_endless(found.cycles),
    }


def _unless_endless(value: Any) -> float:
    """Return a number, nan for none where it is infinite."""
    return math.nan if math.isinf(value) else float(value)


def _fatigue_check(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    yield from bores("d_out", "d_in")(values, key)
    if {"Sut", "Sy"} <= values.keys() and values["Sy"] > values["Sut"]:
        text = _("{yields:.6g} MPa is above the tensile strength, {breaks:.6g} MPa")
        message = text.format(yields=1e-6 * values["Sy"], breaks=1e-6 * values["Sut"])
        yield Problem(key("Sy"), message, "inconsistent")


def _composite(values: Values) -> Values:
    ply = Ply(
        along=values["E1"],
        across=values["E2"],
        shear=values["G12"],
        poisson=values["nu12"],
        density=values["density"],
    )
    layup = Layup(angles=tuple(map(float, values["layup"])), ply_thickness=values["ply_thickness"], ply=ply)
    found = composite_tube(layup, values["mean_d"])
    outer, inner = values["mean_d"] + found.thickness, values["mean_d"] - found.thickness
    speed = uniform_speed(values["length"], outer, inner, found.along, values["density"], modes=1)[0]
    return {
        "E_x_GPa": found.along,
        "E_y_GPa": found.around,
        "G_xy_GPa": found.shear,
        "n_critical_rpm": speed,
        "torque_buckling_Nm": found.buckling_torque,
        "mass_kg": found.mass_per_length * values["length"],
    }


def _plies(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    layup = values.get("layup")
    if layup is not None and not len(layup):
        yield Problem(key("layup"), _("empty; a tube has at least one ply"), "empty")
    elif layup is not None and len(layup) * values.get("ply_thickness", 0.0) >= values.get("mean_d", math.inf):
        yield Problem(key("ply_thickness"), _("the plies are thicker than the tube"), "out_of_range")
    if {"E1", "E2", "nu12"} <= values.keys() and values["nu12"] ** 2 * values["E2"] >= values["E1"]:
        yield Problem(key("nu12"), _("no material has this: ν12² E2 must be less than E1"), "inconsistent")


TORQUE = at_least_zero("torque_Nm", mark("torque"), "torque")
SEGMENT = (
    positive("length_mm", mark("length"), "length"),
    positive("d_out_mm", mark("outer diameter"), "length"),
    at_least_zero("d_in_mm", mark("inner diameter"), "length", default=0.0),
)
OUTER = positive("d_out_mm", mark("outer diameter"), "length")
INNER = at_least_zero("d_in_mm", mark("inner diameter"), "length", default=0.0)

CALCULATIONS = (
    Calculation(
        name="design_torque",
        doc=mark("torque that a vehicle's shaft must carry: what the engine brings, limited by the wheels' adhesion"),
        source=mark("power balance; examples in use, 26.1 and 26.2, corrected"),
        takes=(
            given("kind", mark("which shaft"), kind="word", choices=("propshaft", "halfshaft")),
            at_least_zero("engine_torque_Nm", mark("largest torque of the engine"), "torque", default=None),
            at_least_zero("engine_power_W", mark("power of the engine"), "power", default=None),
            positive("engine_speed_rpm", mark("engine speed at that power"), "angular_speed", default=None),
            positive("gear_ratio", mark("engine speed over shaft speed")),
            positive("axle_ratio", mark("shaft speed over wheel speed")),
            positive("efficiency", mark("efficiency from the engine to the shaft"), default=1.0, high=1.0),
            positive("split_fraction", mark("share of the torque that this shaft carries"), default=1.0, high=1.0),
            positive("dynamic_factor", mark("factor for jerks"), default=1.0),
            at_least_zero("wheel_load_N", mark("load on the wheels that this shaft drives"), "force", default=None),
            at_least_zero("friction", mark("adhesion of these wheels"), default=None),
            positive("wheel_radius_m", mark("their rolling radius"), "length", default=None),
        ),
        returns=(
            gives("torque_drive_Nm", mark("what the engine brings"), "torque"),
            gives("torque_adhesion_Nm", mark("what the wheels can pass on"), "torque"),
            gives("torque_design_Nm", mark("design torque"), "torque"),
            gives("governed_by", mark("drive or adhesion")),
        ),
        answer=_design,
        check=_engine,
    ),
    Calculation(
        name="wheel_load_max",
        doc=mark("load on the wheels above which they pass a torque without slipping"),
        source=mark("adhesion, T = μ W r"),
        takes=(
            TORQUE,
            positive("friction", mark("adhesion of the wheels")),
            positive("wheel_radius_m", mark("their rolling radius"), "length"),
        ),
        returns=(gives("wheel_load_N", mark("load on the wheels"), "force"),),
        answer=lambda values: {
            "wheel_load_N": wheel_load(values["torque"], values["friction"], values["wheel_radius"])
        },
    ),
    Calculation(
        name="shaft_stress",
        doc=mark("stresses of a round shaft under torque and bending"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 261",
        takes=(TORQUE, at_least_zero("bending_Nm", mark("bending moment"), "torque", default=0.0), OUTER, INNER),
        returns=(
            gives("tau_torsion_MPa", mark("shear stress of torsion"), "stress"),
            gives("sigma_bending_MPa", mark("bending stress"), "stress"),
            gives("tau_resultant_MPa", mark("largest shear stress (Tresca)"), "stress"),
            gives("sigma_mises_MPa", mark("equivalent stress by von Mises"), "stress"),
        ),
        answer=_stress,
        check=bores("d_out", "d_in"),
    ),
    Calculation(
        name="shaft_diameter",
        doc=mark("outer diameter of a shaft that carries a torque"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 261",
        takes=(
            TORQUE,
            at_least_zero("bore_ratio", mark("inner over outer diameter"), default=0.0, below=1.0),
            positive("tau_allow_MPa", mark("shear stress allowed"), "stress"),
        ),
        returns=(gives("d_out_mm", mark("outer diameter"), "length"),),
        answer=lambda values: {"d_out_mm": shaft_diameter(values["torque"], values["tau_allow"], values["bore_ratio"])},
    ),
    Calculation(
        name="shaft_twist",
        doc=mark("twist of a stepped shaft under torque"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 262, with the torque alone",
        takes=(
            given("torque_Nm", mark("torque"), "torque"),
            positive("G_GPa", mark("shear modulus"), "stress"),
            rows("segments", mark("segments along the shaft"), *SEGMENT),
        ),
        returns=(
            gives("twist_deg", mark("twist"), "angle"),
            gives("within_9_deg", mark("whether it keeps the book's 9°")),
        ),
        answer=_twist,
        check=segment_bores("d_out", "d_in"),
    ),
    Calculation(
        name="fatigue",
        doc=mark("fatigue of a shaft under swinging torque and turning bending"),
        source=mark("Goodman with Marin's factors, Shigley, chapter 6"),
        takes=(
            at_least_zero("T_mean_Nm", mark("mean torque"), "torque"),
            at_least_zero("T_alt_Nm", mark("amplitude of the torque"), "torque"),
            at_least_zero("M_mean_Nm", mark("mean bending moment"), "torque"),
            at_least_zero("M_alt_Nm", mark("amplitude of the bending moment"), "torque"),
            OUTER,
            INNER,
            positive("Sut_MPa", mark("tensile strength"), "stress"),
            positive("Sy_MPa", mark("yield strength"), "stress"),
            given("finish", mark("surface"), kind="word", choices=tuple(FINISHES)),
            given("Kf", mark("notch factor in bending"), default=1.0, low=1.0),
            given("Kfs", mark("notch factor in torsion"), default=1.0, low=1.0),
            given(
                "reliability_percent",
                mark("share of parts that last"),
                "share",
                low=min(RELIABILITIES),
                high=max(RELIABILITIES),
            ),
        ),
        returns=(
            gives("Se_MPa", mark("fatigue limit of the part"), "stress"),
            gives("sigma_a_eq_MPa", mark("equivalent amplitude"), "stress"),
            gives("sigma_m_eq_MPa", mark("equivalent mean stress"), "stress"),
            gives("n_goodman", mark("safety against fatigue")),
            gives("n_yield", mark("safety against yielding")),
            gives("life_cycles", mark("cycles to failure; none when endless")),
        ),
        answer=_fatigue,
        check=_fatigue_check,
    ),
    Calculation(
        name="composite_tube",
        doc=mark("moduli, critical speed, buckling torque and mass of a tube of fibre composite"),
        source=mark("classical laminate theory"),
        takes=(
            given("layup_deg", mark("angles of the plies from the axis, from the inside out"), "angle", axes=(1,)),
            positive("ply_thickness_mm", mark("thickness of a ply"), "length"),
            positive("mean_d_mm", mark("diameter of the middle of the wall"), "length"),
            positive("length_mm", mark("length between the joints"), "length"),
            positive("E1_GPa", mark("Young's modulus along the fibres"), "stress"),
            positive("E2_GPa", mark("Young's modulus across the fibres"), "stress"),
            positive("G12_GPa", mark("shear modulus"), "stress"),
            given("nu12", mark("Poisson's ratio"), above=-1.0, below=1.0),
            positive("density_kg_m3", mark("density"), "density"),
        ),
        returns=(
            gives("E_x_GPa", mark("modulus along the axis"), "stress"),
            gives("E_y_GPa", mark("modulus around it"), "stress"),
            gives("G_xy_GPa", mark("shear modulus"), "stress"),
            gives("n_critical_rpm", mark("critical speed between two joints"), "angular_speed"),
            gives("torque_buckling_Nm", mark("torque at which the wall buckles"), "torque"),
            gives("mass_kg", mark("mass between the joints"), "mass"),
        ),
        answer=_composite,
        check=_plies,
    ),
)
"""Calculations of this part."""
