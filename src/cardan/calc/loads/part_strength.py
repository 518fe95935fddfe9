"""Calculations of the strength of parts: splines and their thrust, arms of yokes, journals of crosses."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from cardan.calc.bores import bores
from cardan.calc.calculation import Calculation, Values, at_least_zero, given, gives, positive, record
from cardan.drive.models.train import spline_grip
from cardan.errors import Problem
from cardan.formulas.joint_strength import journal_stress, yoke_stress
from cardan.formulas.spline_strength import spline_stress
from cardan.texts import _, mark

from .joint_forces import SPLINE_THRUST
from .strength import TORQUE


@dataclass(frozen=True, kw_only=True, slots=True)
class Forms(Calculation):
    """A calculation that is asked in several ways, told apart by the keys given."""

    forms: tuple[Calculation, ...]

    def __call__(self, inputs: Mapping[str, Any]) -> dict[str, Any]:
        """Return the answer of the form that knows most of the keys, the first one of equals."""
        known = [sum(item.key in inputs for item in form.takes) for form in self.forms]
        return self.forms[known.index(max(known))](inputs)


def _spline(values: Values) -> Values:
    found = spline_stress(
        values["torque"],
        outer=values["D"],
        root=values["d"],
        teeth=values["teeth"],
        tooth_width=values["tooth_width"],
        length=values["length"],
        chamfer=values["chamfer"],
        load_share=values["load_share"],
    )
    return {
        "d_m_mm": found.mean_diameter,
        "h_mm": found.height,
        "sigma_crush_MPa": found.pressure,
        "tau_tooth_MPa": found.tooth_shear,
        "tau_core_MPa": found.core_shear,
    }


def _flanks(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    wrong = list(bores("D", "d")(values, key))
    yield from wrong
    if wrong or not {"D", "d", "chamfer"} <= values.keys():
        return
    if 0.5 * (values["D"] - values["d"]) <= 2.0 * values["chamfer"]:
        text = _("{chamfer:.6g} mm leaves no height of the flanks: (D - d)/2 - 2c must be more than 0")
        yield Problem(key("chamfer"), text.format(chamfer=1e3 * values["chamfer"]), "out_of_range")


def _thrust(values: Values) -> Values:
    return {
        "axial_force_N": spline_grip(values["friction"], values["d_m"], values["pressure_angle"]) * values["torque"]
    }


SHAPES = {"rect": "rectangle", "ellipse": "ellipse"}


def _yoke(values: Values) -> Values:
    section = values["section"]
    found = yoke_stress(
        values["journal_force"],
        bending_arm=values["bending_arm"],
        torsion_arm=values["torsion_arm"],
        height=section["height"],
        width=section["width"],
        shape=SHAPES[section["shape"]],
    )
    return {"sigma_bending_MPa": found.bending, "tau_torsion_MPa": found.shear, "sigma_mises_MPa": found.mises}


def _journal(values: Values) -> Values:
    arm = 0.5 * values["length"] if values["arm"] is None else values["arm"]
    found = journal_stress(values["journal_force"], diameter=values["d"], arm=arm, bore=values["bore"])
    return {"sigma_bending_MPa": found.bending, "tau_mean_MPa": found.mean_shear, "tau_max_MPa": found.shear}


FORCE = at_least_zero("journal_force_N", mark("force on a journal"), "force")

CALCULATIONS = (
    Calculation(
        name="spline",
        doc=mark("stresses of a straight-sided spline"),
        source=mark(
            "Kozhevnikov & Perfil'ev (1978), p. 228, pressure and shear of the teeth, torsion at the smallest diameter"
        ),
        takes=(
            positive("D_mm", mark("outer diameter"), "length"),
            positive("d_mm", mark("root diameter"), "length"),
            positive("teeth", mark("number of teeth"), kind="whole"),
            positive("tooth_width_mm", mark("width of a tooth"), "length"),
            positive("length_mm", mark("length of the teeth"), "length"),
            TORQUE,
            at_least_zero("chamfer_mm", mark("chamfer"), "length", default=0.0),
            positive("load_share", mark("share of the teeth that carry"), default=0.75, high=1.0),
        ),
        returns=(
            gives("d_m_mm", mark("mean diameter"), "length"),
            gives("h_mm", mark("height of the flanks that bear"), "length"),
            gives("sigma_crush_MPa", mark("pressure on the flanks"), "stress"),
            gives("tau_tooth_MPa", mark("shear at the roots of the teeth"), "stress"),
            gives("tau_core_MPa", mark("torsion at the root diameter"), "stress"),
        ),
        answer=_spline,
        check=_flanks,
    ),
    Calculation(
        name="yoke",
        doc=mark("stresses of the arm of a yoke"),
        source=mark("Kozhevnikov & Perfil'ev (1978), eq. 263; Saint-Venant's torsion"),
        takes=(
            FORCE,
            at_least_zero("bending_arm_mm", mark("arm of the force for bending"), "length"),
            at_least_zero("torsion_arm_mm", mark("arm of the force for torsion"), "length"),
            record(
                "section",
                mark("weakest section"),
                given("shape", mark("shape of the section"), kind="word", choices=tuple(SHAPES)),
                positive("height_mm", mark("height along the force"), "length"),
                positive("width_mm", mark("width across the force"), "length"),
            ),
        ),
        returns=(
            gives("sigma_bending_MPa", mark("bending stress"), "stress"),
            gives("tau_torsion_MPa", mark("shear stress of torsion"), "stress"),
            gives("sigma_mises_MPa", mark("equivalent stress by von Mises"), "stress"),
        ),
        answer=_yoke,
    ),
    Calculation(
        name="journal",
        doc=mark("stresses at the root of a journal of the cross"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 264, 265, with the grease bore",
        takes=(
            FORCE,
            positive("length_mm", mark("length of the journal"), "length"),
            positive("d_mm", mark("diameter"), "length"),
            at_least_zero("bore_mm", mark("diameter of the grease bore"), "length", default=0.0),
            at_least_zero("arm_mm", mark("arm of the force; half the length when not given"), "length", default=None),
        ),
        returns=(
            gives("sigma_bending_MPa", mark("bending stress"), "stress"),
            gives("tau_mean_MPa", mark("mean shear stress"), "stress"),
            gives("tau_max_MPa", mark("largest shear stress"), "stress"),
        ),
        answer=_journal,
        check=bores("d", "bore"),
    ),
    Forms(
        name="spline_axial_force",
        doc=mark("friction thrust of a spline: its parts in the joint, or the thrust alone"),
        source=SPLINE_THRUST.source,
        takes=(
            *SPLINE_THRUST.takes,
            *(
                thrust_keys := (
                    at_least_zero("torque_Nm", mark("torque at the spline, for the thrust alone"), "torque"),
                    positive("d_m_mm", mark("its mean diameter"), "length"),
                    at_least_zero("friction", mark("its coefficient of friction")),
                    given(
                        "pressure_angle_deg",
                        mark("pressure angle of its teeth"),
                        "angle",
                        default=0.0,
                        low=0.0,
                        below=0.5 * math.pi,
                    ),
                )
            ),
        ),
        returns=(*SPLINE_THRUST.returns, gives("axial_force_N", mark("friction thrust"), "force")),
        answer=dict,
        forms=(
            SPLINE_THRUST,
            Calculation(
                name="spline_axial_force",
                doc=mark("friction thrust of a spline"),
                source="Kozhevnikov & Perfil'ev (1978), eq. 123",
                takes=thrust_keys,
                returns=(gives("axial_force_N", mark("friction thrust"), "force"),),
                answer=_thrust,
            ),
        ),
    ),
)
"""Calculations of this part."""
