"""A shaft: the yokes at its ends, its length, its spline, a crack across it."""

from __future__ import annotations

from dataclasses import dataclass

from cardan.errors import refuse
from cardan.maths.linear.laminate import PlyStiffness
from cardan.texts import _
from cardan.units import plain, quantity

from .material import Material
from .profile_tube import Profile


@dataclass(frozen=True, kw_only=True, slots=True)
class ShaftCrack:
    """Crack across a shaft that opens and closes as it turns under its weight."""

    losses: tuple[float, ...] = plain(
        (), doc="shares of its bending stiffness that the shaft loses along the crack and across it while it is open"
    )
    depth_ratio: float | None = plain(
        None,
        doc="depth over the radius, in place of `losses`: at most 1 in a solid shaft, through the wall of a tube",
        above=0.0,
        below=2.0,
    )
    position: float | None = quantity(
        "length",
        None,
        doc="place along the power flow from the joint before, on shaft 1 from joint 1; amid the shaft when not given",
    )
    breathing: int = plain(
        1, doc="power of the law of breathing: 0 is always open, 1 is Mayes' law, more opens for a shorter time", low=0
    )
    angle: float = quantity("angle", 0.0, doc="about the axis along the power flow, from the shaft's driving yoke")


@dataclass(frozen=True, kw_only=True, slots=True)
class Spline:
    """Sliding spline of an intermediate shaft: length compensation, and the steps in which its yokes can be set."""

    teeth: int | None = plain(None, doc="number of teeth; the yoke angle can be set in steps of 360°/teeth", low=1)
    engaged: float | None = quantity("length", None, doc="engaged length in the drawn position", above=0.0)
    gap: float | None = quantity("length", None, doc="way left to bottoming in the drawn position", above=0.0)
    outer: float | None = quantity("length", None, doc="outer diameter of the teeth", above=0.0)
    root: float | None = quantity("length", None, doc="root diameter of the toothed shaft", above=0.0)
    tooth_width: float | None = quantity("length", None, doc="width of a tooth", above=0.0)
    length: float | None = quantity("length", None, doc="length of the teeth that can carry", above=0.0)
    chamfer: float = quantity("length", 0.0, doc="chamfer of the teeth", low=0.0)
    load_share: float = plain(0.75, doc="share of the teeth that carry", above=0.0, high=1.0)
    position: float | None = quantity(
        "length", None, doc="place along the power flow from the joint before; the middle of the shaft when not given"
    )
    mean_diameter: float | None = quantity(
        "length", None, doc="mean diameter of the teeth; that of outer and root when not given", above=0.0
    )
    friction: float | None = plain(None, doc="coefficient of friction of the teeth", low=0.0)
    pressure_angle: float = quantity(
        "angle",
        0.0,
        doc="pressure angle of the teeth where `friction` is that of the materials; 0 where it is a reduced one",
        low=0.0,
        below=1.57,
    )
    backlash: float = quantity("angle", 0.0, doc="whole angular play of the teeth", low=0.0)
    stiffness: float | None = quantity(
        "turning_stiffness", None, doc="torsional stiffness of the teeth; rigid when not given", above=0.0
    )
    sliding: str = plain(
        "both",
        doc="which way the shaft slides under load: it grows longer, shorter, or one and then the other",
        choices=("out", "in", "both"),
    )

    @property
    def pitch_diameter(self) -> float | None:
        """Mean diameter of the teeth [m]: as given, else between outer and root diameter; None where neither is."""
        if self.mean_diameter is not None or self.outer is None or self.root is None:
            return self.mean_diameter
        return 0.5 * (self.outer + self.root)


@dataclass(frozen=True, kw_only=True, slots=True)
class Notch:
    """Fatigue notch factors."""

    bending: float = plain(1.0, doc="notch factor in bending", low=1.0)
    torsion: float = plain(1.0, doc="notch factor in torsion", low=1.0)


@dataclass(frozen=True, kw_only=True, slots=True)
class Ply:
    """One layer of fibre and resin, in its own axes."""

    grade: str = plain("", doc="lamina of the catalogue, whose figures hold where none are given")
    along: float | None = quantity("stress", None, doc="Young's modulus along the fibres", above=0.0)
    across: float | None = quantity("stress", None, doc="Young's modulus across the fibres", above=0.0)
    shear: float | None = quantity("stress", None, doc="shear modulus", above=0.0)
    poisson: float = plain(0.3, doc="Poisson's ratio, contraction across over stretch along", above=-1.0, below=1.0)
    density: float = quantity("density", 1600.0, doc="density", above=0.0)
    tension_along: float | None = quantity("stress", None, doc="tensile strength along the fibres", above=0.0)
    compression_along: float | None = quantity("stress", None, doc="compressive strength along the fibres", above=0.0)
    tension_across: float | None = quantity("stress", None, doc="tensile strength across the fibres", above=0.0)
    compression_across: float | None = quantity("stress", None, doc="compressive strength across the fibres", above=0.0)
    shear_strength: float | None = quantity("stress", None, doc="shear strength in the ply", above=0.0)

    @property
    def stiffness(self) -> PlyStiffness:
        """Its moduli in its own axes."""
        if self.along is None or self.across is None or self.shear is None:
            text = _("missing: the moduli along, across and in shear, or a lamina of the catalogue")
            raise refuse("layup.ply", text, "missing")
        return PlyStiffness(self.along, self.across, self.shear, self.poisson)


@dataclass(frozen=True, kw_only=True, slots=True)
class Bond:
    """Bond by which a metal end is glued into a composite tube, over a length at both ends."""

    length: float = quantity("length", doc="length of the overlap", above=0.0)
    thickness: float = quantity("length", doc="thickness of the adhesive", above=0.0)
    shear: float = quantity("stress", doc="shear modulus of the adhesive", above=0.0)
    strength: float = quantity("stress", doc="shear strength of the adhesive", above=0.0)
    wall: float | None = quantity(
        "length", None, doc="wall of the steel end within the tube; rigid when not given", above=0.0
    )


@dataclass(frozen=True, kw_only=True, slots=True)
class Layup:
    """Plies of a composite tube, from the inside out."""

    angles: tuple[float, ...] = quantity("angle", doc="angle of each ply from the axis of the shaft")
    ply_thickness: float = quantity("length", doc="thickness of a ply", above=0.0)
    ply: Ply = plain(doc="figures of a ply, or the name of a lamina of the catalogue")
    bond: Bond | None = plain(None, doc="bond between the tube and its metal ends")


@dataclass(frozen=True, kw_only=True, slots=True)
class Segment:
    """Stretch of a shaft with one cross section."""

    length: float = quantity("length", doc="length of the stretch", above=0.0)
    outer: float = quantity("length", doc="outer diameter", above=0.0)
    inner: float = quantity("length", 0.0, doc="inner diameter of a tube", low=0.0)
    material: Material | None = plain(None, doc="material; steel when not given")


@dataclass(frozen=True, kw_only=True, slots=True)
class PointMass:
    """Yoke, flange or other part that a shaft carries, beside its body."""

    position: float = quantity(
        "length", doc="place along the power flow from the joint before; on shaft 1 from joint 1, so zero or negative"
    )
    mass: float = quantity("mass", doc="mass", low=0.0)
    polar_inertia: float = quantity("inertia", 0.0, doc="moment of inertia about the shaft's axis", low=0.0)
    diametral_inertia: float = quantity(
        "inertia", 0.0, doc="moment of inertia about an axis across through its own centre of mass", low=0.0
    )


@dataclass(frozen=True, kw_only=True, slots=True)
class Unbalance:
    """Unbalance in a plane of a shaft."""

    position: float = quantity(
        "length", doc="place along the power flow from the joint before; on shaft 1 from joint 1"
    )
    amount: float = quantity("unbalance", doc="mass times its distance from the axis", low=0.0)
    angle: float = quantity("angle", 0.0, doc="about the axis along the power flow, from the shaft's driving yoke")


@dataclass(frozen=True, kw_only=True, slots=True)
class Shaft:
    """Shaft number 1 (input) to n+1 (output) of an n-joint drive."""

    number: int = plain(doc="1 is the input shaft, n+1 the output shaft", low=1)
    name: str = plain("", doc="name of the shaft, for tables and pictures")
    length: float | None = quantity("length", None, doc="length between the joint centres at its ends", above=0.0)
    side_slope: float | None = quantity(
        "angle", None, doc="slope in side view, positive when rising along the power flow", above=-1.57, below=1.57
    )
    plan_slope: float | None = quantity(
        "angle", None, doc="slope in plan view, positive to the left of the power flow", above=-1.57, below=1.57
    )
    yoke_angle: float = quantity(
        "angle",
        0.0,
        doc="angle from the driving yoke to the driven yoke of this shaft, about its axis along the power flow",
        mirror="yoke_lead",
    )
    yoke_fixed: bool = plain(False, doc="true excludes this yoke angle from synthesis")
    weight: float = plain(1.0, doc="weight of this shaft's speed fluctuation as a secondary goal of synthesis", low=0.0)
    outer: float | None = quantity("length", None, doc="outer diameter", above=0.0)
    inner: float | None = quantity("length", None, doc="inner diameter of a tube", low=0.0)
    wall: float | None = quantity("length", None, doc="thickness of the wall of a tube", above=0.0)
    profile: Profile | None = plain(
        None, doc="contour of a tube that is not round, as of a power take-off shaft; `outer` is then over its lobes"
    )
    material: Material | None = plain(None, doc="material; steel when not given")
    segments: tuple[Segment, ...] = plain(
        (), doc="stretches of a stepped body from start to end, in place of `outer`; they add up to the shaft's length"
    )
    masses: tuple[PointMass, ...] = plain((), doc="yokes, flanges and other parts on the shaft, beside its body")
    wear_factor: float | None = plain(
        None,
        doc="critical speed of the real shaft over the computed one; 0.9 with a spline and 1 without when not given",
        above=0.0,
        high=1.0,
    )
    mass: float | None = quantity("mass", None, doc="mass, in place of that of the body", low=0.0)
    centre_of_mass: float | None = quantity(
        "length",
        None,
        doc="place of the centre of mass along the power flow from the joint before; on shaft 1 from joint 1",
    )
    inertia: float | None = quantity(
        "inertia", None, doc="moment of inertia about its axis, in place of that of the body", low=0.0
    )
    transverse_inertia: float | None = quantity(
        "inertia",
        None,
        doc="moment of inertia about an axis across through the centre of mass, in place of that of the body",
        low=0.0,
    )
    stiffness: float | None = quantity(
        "turning_stiffness",
        None,
        doc="torsional stiffness from end to end, its spline included, in place of that of the body",
        above=0.0,
    )
    damping: float | None = quantity("turning_damping", None, doc="torsional damping from end to end", low=0.0)
    loss_factor: float | None = plain(
        None, doc="structural damping η: the energy lost in a radian of vibration over the greatest stored", low=0.0
    )
    resisting_torque: float = quantity(
        "torque", 0.0, doc="torque that resists the turning of this shaft beside the load of the drive"
    )
    spline: Spline | None = plain(None, doc="sliding spline of the shaft")
    finish: str = plain(
        "machined",
        doc="surface of the shaft, for its fatigue strength",
        choices=("ground", "machined", "hot_rolled", "forged"),
    )
    notch: Notch | None = plain(None, doc="notch factors of the shaft's weakest place, for its fatigue strength")
    layup: Layup | None = plain(None, doc="plies of a tube of fibre composite, in place of its material")
    unbalance: tuple[Unbalance, ...] = plain((), doc="unbalances measured or allowed on the shaft")
    runout: float | None = quantity("length", None, doc="run-out of the tube", low=0.0)
    crack: ShaftCrack | None = plain(None, doc="crack across the shaft")

    @property
    def has_body(self) -> bool:
        """Whether the drive says what the shaft looks like between its ends."""
        return self.outer is not None or bool(self.segments)
