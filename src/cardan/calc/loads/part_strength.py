"""The strength of parts: splines and their thrust, arms of yokes, journals of crosses."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from cardan.calc.bores import bores
from cardan.calc.calculation import Calculation, Formulas, Problems, Values
from cardan.drive.models.train import spline_grip
from cardan.formulas.joint_strength import journal_stress, yoke_stress
from cardan.formulas.spline_strength import spline_stress
from cardan.reading.given import at_least_zero, gives, positive, record, word
from cardan.texts import _

from .joint_forces import SPLINE_THRUST
from .strength import TORQUE

formula = Formulas(__doc__)


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
    "Book p. 228, pressure and shear of the teeth, torsion at the smallest diameter",
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
    "Book (263); Saint-Venant's torsion",
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
    "Book (264), (265), with the grease bore",
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
            source="Book (123)",
            takes=thrust_keys,
            returns=(gives("axial_force_N", "friction thrust"),),
            answer=lambda v: spline_grip(v.friction, v.d_m, v.pressure_angle) * v.torque,
        ),
    ),
    kind=Forms,
)
def _spline_axial_force(v: Values) -> Any:
    return dict(v)
