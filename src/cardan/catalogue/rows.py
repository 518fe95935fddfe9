"""Rows of the catalogue: what each of its tables says of a thing, with the source of every row."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, is_dataclass, replace
from types import MappingProxyType
from typing import Any, NamedTuple, TypeVar

from cardan.drive.cross import Cross
from cardan.drive.fields.keys import NAMED
from cardan.drive.joint_parts import Needles, Rating, Yoke
from cardan.errors import Problem, check
from cardan.reading.fields import fields_of
from cardan.texts import _, mark
from cardan.units import plain, quantity


def _below(value: float | None, least: float | None, field: str, message: str) -> Iterator[Problem]:
    """Yield that a field is less than what it must at least be, where both are known."""
    if value is not None and least is not None and value < least:
        yield Problem(field, message, "inconsistent")


UNSURE: Mapping[str, str] = MappingProxyType(
    {
        "made_up": mark("made up for examples"),
        "not_confirmed": mark("not confirmed"),
        "recalled": mark("recalled, not looked up"),
        "beyond": mark("usual values of the trade"),
    }
)
"""Confidence of rows whose figures no source confirms that can be looked up, the least sure first, in words."""


def sureness(confidence: str) -> int:
    """Return the place of a confidence in their order, the least sure first."""
    order = list(UNSURE)
    return order.index(confidence) if confidence in order else len(order)


@dataclass(frozen=True, kw_only=True, slots=True)
class Row:
    """What every row has."""

    id: str = plain(doc="name of the row, unique in its table")
    source: str = plain(doc="where its figures come from")
    confidence: str = plain(
        "confirmed",
        doc="how sure the figures are: confirmed by the source, recalled (usual values, look them up), book (as the "
        "book has it), derived from other rows, made_up for examples",
        choices=("confirmed", "recalled", "not_confirmed", "book", "derived", "beyond", "made_up"),
    )
    note: str = plain("", doc="what to know about it")


@dataclass(frozen=True, kw_only=True, slots=True)
class Grade(Row):
    """A material and the state it is delivered in."""

    russian: str = plain("", doc="name in Cyrillic")
    european: str = plain("", doc="the same or the nearest European grade")
    american: str = plain("", doc="the same or the nearest AISI grade")
    names: tuple[str, ...] = plain((), doc="further names")
    parts: tuple[str, ...] = plain((), doc="parts it is used for")
    treatment: str = plain("", doc="heat treatment")
    hardness_brinell: tuple[float, float] | None = plain(None, doc="Brinell hardness, from and to", above=0.0)
    hardness_rockwell: tuple[float, float] | None = plain(None, doc="Rockwell C hardness, from and to", above=0.0)
    density: float = quantity("density", 7850.0, doc="density", above=0.0)
    youngs: float = quantity("stress", 2.06e11, doc="Young's modulus", above=0.0)
    shear: float = quantity("stress", 7.92e10, doc="shear modulus", above=0.0)
    poisson: float = plain(0.3, doc="Poisson's ratio", low=0.0, below=0.5)
    yield_strength: float | None = quantity("stress", None, doc="yield strength or 0.2 % proof stress", above=0.0)
    ultimate_strength: float | None = quantity("stress", None, doc="tensile strength", above=0.0)
    size: tuple[float, float] | None = quantity("length", None, doc="diameter or wall, from and to", low=0.0)
    typical: bool = plain(False, doc="whether the strengths are typical values, not minima")
    bending_fatigue: float | None = quantity(
        "stress", None, doc="fatigue strength in fully reversed rotating bending", above=0.0
    )
    fatigue_cycles: float | None = plain(None, doc="cycles of that fatigue strength", above=0.0)

    def __post_init__(self) -> None:
        check(
            _below(self.ultimate_strength, self.yield_strength, "ultimate_strength", _("is below the yield strength"))
        )

    @property
    def every_name(self) -> tuple[str, ...]:
        """Its names in all standards, its own first."""
        named = (self.id, self.european, self.american, self.russian, *self.names)
        return tuple(dict.fromkeys(name.partition(" (")[0] for name in named if name))


@dataclass(frozen=True, kw_only=True, slots=True)
class Lamina(Row):
    """A ply of fibres in a matrix: along the fibres (1), across them (2)."""

    name: str = plain(doc="what it is called")
    density: float | None = quantity("density", None, doc="density", above=0.0)
    youngs_1: float = quantity("stress", doc="Young's modulus along the fibres", above=0.0)
    youngs_2: float = quantity("stress", doc="Young's modulus across the fibres", above=0.0)
    shear_12: float | None = quantity("stress", None, doc="shear modulus in the ply", above=0.0)
    shear_23: float | None = quantity("stress", None, doc="shear modulus through the ply", above=0.0)
    poisson_12: float | None = plain(None, doc="Poisson's ratio, pulled along the fibres", low=0.0)
    poisson_23: float | None = plain(None, doc="Poisson's ratio through the ply", low=0.0)
    tension_1: float | None = quantity("stress", None, doc="tensile strength along the fibres", above=0.0)
    compression_1: float | None = quantity("stress", None, doc="compressive strength along the fibres", above=0.0)
    tension_2: float | None = quantity("stress", None, doc="tensile strength across the fibres", above=0.0)
    compression_2: float | None = quantity("stress", None, doc="compressive strength across the fibres", above=0.0)
    shear_strength: float | None = quantity("stress", None, doc="shear strength in the ply", above=0.0)


@dataclass(frozen=True, kw_only=True, slots=True)
class JointType(Row):
    """A type of joint and its limits, without sizes."""

    name: str = plain(doc="what it is called")
    family: str = plain(doc="group of joints it belongs to")
    synchronous: str = plain(doc="whether it turns uniformly", choices=("yes", "approx", "no"))
    synchronous_as_pair: bool = plain(False, doc="whether two of them, phased right, turn uniformly")
    pair_mobility: int | None = plain(None, doc="freedoms between its two shafts", low=1)
    max_joint_angle: float | None = quantity("angle", None, doc="largest joint angle", above=0.0)
    min_torque: float | None = quantity("torque", None, doc="smallest torque it is made for", low=0.0)
    max_torque: float | None = quantity("torque", None, doc="largest torque it is made for", above=0.0)
    max_speed_angle: float | None = quantity(
        "speed_angle", None, doc="largest product of speed and joint angle in continuous running", above=0.0
    )
    max_rim_speed: float | None = quantity("speed", None, doc="largest speed of its rim", above=0.0)
    max_windup: float | None = quantity("angle", None, doc="largest angle of twist under torque", above=0.0)
    uses: tuple[str, ...] = plain((), doc="what it is used for")

    def __post_init__(self) -> None:
        check(_below(self.max_torque, self.min_torque, "max_torque", _("is below the smallest torque")))


@dataclass(frozen=True, kw_only=True, slots=True)
class MakerFigures:
    """What a maker's own table says of a size, under the maker's notions."""

    functional_limit: float | None = quantity("torque", None, doc="functional limit torque (GWB)", above=0.0)
    reversing_fatigue: float | None = quantity("torque", None, doc="endurance torque, reversing (GWB)", above=0.0)
    pulsating_fatigue: float | None = quantity("torque", None, doc="endurance torque, pulsating (GWB)", above=0.0)
    elastic_limit: float | None = quantity("torque", None, doc="torque at the elastic limit", above=0.0)
    capacity_factor: float | None = plain(
        None, doc="bearing capacity factor Lc (GWB) [10¹⁰ kN·m^(10/3)·h·rpm·°]", above=0.0
    )
    bearing_torque: float | None = quantity("torque", None, doc="bearing torque (Spicer)", above=0.0)
    industrial: float | None = quantity("torque", None, doc="industrial rating (Spicer)", above=0.0)
    mobile_off_highway: float | None = quantity("torque", None, doc="mobile off-highway rating (Spicer)", above=0.0)
    max_power: float | None = quantity("power", None, doc="greatest net power (Spicer)", above=0.0)
    continuous: float | None = quantity("torque", None, doc="continuous torque (Spicer)", above=0.0)
    short_duration: float | None = quantity("torque", None, doc="short duration torque (Spicer)", above=0.0)
    reference: float | None = quantity("torque", None, doc="reference torque (ML-Tuning)", above=0.0)
    limiting: float | None = quantity("torque", None, doc="limiting torque (ML-Tuning)", above=0.0)
    alternating: float | None = quantity("torque", None, doc="alternating torque (ML-Tuning)", above=0.0)
    power_540: float | None = quantity("power", None, doc="nominal power at 540 rpm", above=0.0)
    nominal_torque_540: float | None = quantity("torque", None, doc="nominal torque at 540 rpm", above=0.0)
    power_1000: float | None = quantity("power", None, doc="nominal power at 1000 rpm", above=0.0)
    nominal_torque_1000: float | None = quantity("torque", None, doc="nominal torque at 1000 rpm", above=0.0)
    cap: float | None = quantity("length", None, doc="diameter of the bearing caps", above=0.0)
    span_over_caps: float | None = quantity("length", None, doc="length of the cross over its caps", above=0.0)
    bearing: float | None = quantity("length", None, doc="diameter of the wing bearings", above=0.0)
    over_keys: float | None = quantity("length", None, doc="length over the keys of the wing bearings", above=0.0)
    flange: float | None = quantity("length", None, doc="flange diameter", above=0.0)
    flange_din: tuple[float, ...] = quantity("length", (), doc="DIN flange diameters")
    flange_sae: tuple[str, ...] = plain((), doc="SAE flanges")
    flange_serrated: tuple[float, ...] = quantity("length", (), doc="serrated flange diameters")
    tube_outer: float | None = quantity("length", None, doc="outer diameter of the usual tube", above=0.0)
    tube_wall: float | None = quantity("length", None, doc="wall of the usual tube", above=0.0)
    bore: float | None = quantity("length", None, doc="bore", above=0.0)
    single_length: float | None = quantity("length", None, doc="length of the single joint", above=0.0)
    double_length: float | None = quantity("length", None, doc="length of the double joint", above=0.0)
    centre_to_end: float | None = quantity("length", None, doc="from the joint centre to the end", above=0.0)
    between_centres: float | None = quantity("length", None, doc="between the centres of the double joint", above=0.0)
    double_mass: float | None = quantity("mass", None, doc="mass of the double joint", above=0.0)


@dataclass(frozen=True, kw_only=True, slots=True)
class JointSize(Row):
    """A size of a maker's series: the dimensions and ratings that a joint of this size has."""

    series: str = plain("", doc="series it is of; sizes of one series are offered together")
    type: str = plain("", doc="type of joint it is of")
    cross: Cross | None = plain(None, doc="its cross")
    needles: Needles | None = plain(None, doc="its needle bearings")
    yoke: Yoke | None = plain(None, doc="its yokes")
    rating: Rating | None = plain(None, doc="what its maker allows")
    mass: float | None = quantity("mass", None, doc="mass of the joint", above=0.0)
    maker: MakerFigures | None = plain(None, doc="what its maker's own table says")
    recalled: tuple[str, ...] = plain((), doc="figures, as rating.outer, that its source does not give: usual values")
    derived: tuple[str, ...] = plain((), doc="figures that are computed from others of the row")

    @property
    def space(self) -> float:
        """Diameter that the joint takes [m]: its outer one, else its cross over the caps; infinite if none is known."""
        outer = self.rating.outer if self.rating is not None else None
        caps = self.maker.span_over_caps or self.maker.over_keys if self.maker is not None else None
        return outer or caps or math.inf

    def sure(self, figure: str) -> JointSize:
        """Return the row with the confidence of one of its figures, as ``rating.outer``."""
        return replace(self, confidence="recalled") if figure in self.recalled else self


@dataclass(frozen=True, kw_only=True, slots=True)
class Bearing(Row):
    """A deep groove ball bearing, as it is sealed."""

    bore: float = quantity("length", doc="bore", above=0.0)
    outer: float = quantity("length", doc="outer diameter", above=0.0)
    width: float = quantity("length", doc="width", above=0.0)
    capacity: float = quantity("force", doc="dynamic capacity C", above=0.0)
    static_capacity: float = quantity("force", doc="static capacity C0", above=0.0)
    max_speed: float | None = quantity("angular_speed", None, doc="limiting speed as it is sealed", above=0.0)
    mass: float | None = quantity("mass", None, doc="mass", above=0.0)

    def __post_init__(self) -> None:
        check(_below(self.outer, self.bore, "outer", _("is below the bore")))


@dataclass(frozen=True, kw_only=True, slots=True)
class ShaftSeal(Row):
    """A rotary shaft lip seal, by the size it is ordered by."""

    seal_diameter: float = quantity("length", doc="diameter of the shaft under its lip", above=0.0)
    outer: float = quantity("length", doc="bore of the housing it sits in", above=0.0)
    width: float = quantity("length", doc="width", above=0.0)
    max_lip_speed: float | None = quantity(
        "speed", None, doc="largest speed of the shaft's surface under its lip", above=0.0
    )

    def __post_init__(self) -> None:
        check(_below(self.outer, self.seal_diameter, "outer", _("is below the diameter of the shaft")))


@dataclass(frozen=True, kw_only=True, slots=True)
class AngleNorm(Row):
    """Largest angular accelerations that unequal joint angles may cause."""

    torsional: float = quantity("angular_acceleration", doc="of the output", above=0.0)
    inertia_drive: float = quantity(
        "angular_acceleration", doc="of an intermediate shaft, the input uniform", above=0.0
    )
    inertia_coast: float = quantity(
        "angular_acceleration", doc="of an intermediate shaft, the output uniform", above=0.0
    )
    application: str = plain("", doc="application it is made for; only on request where none stands here")


@dataclass(frozen=True, kw_only=True, slots=True)
class SpeedAngleLimit(Row):
    """Largest product of speed and joint angle of a joint, and its largest speed."""

    max_speed_angle: float = quantity("speed_angle", doc="largest product of speed and joint angle", above=0.0)
    max_speed: float | None = quantity("angular_speed", None, doc="largest speed", above=0.0)


@dataclass(frozen=True, kw_only=True, slots=True)
class MaxJointAngle(Row):
    """Largest joint angle of one joint at a speed."""

    speed: float = quantity("angular_speed", doc="speed", above=0.0)
    max_joint_angle: float = quantity("angle", doc="largest joint angle", above=0.0)


@dataclass(frozen=True, kw_only=True, slots=True)
class AnglePair(Row):
    """Largest second joint angle beside first ones of 0°, 1°, 2° … at a speed, as printed."""

    speed: float = quantity("angular_speed", doc="speed", above=0.0)
    second_joint_angle: tuple[float, ...] = quantity(
        "angle", doc="largest second joint angle for each first one", above=0.0
    )


@dataclass(frozen=True, kw_only=True, slots=True)
class BalanceNorm(Row):
    """Unbalance that is left in a balanced shaft of a vehicle."""

    max_unbalance: float = quantity("unbalance", doc="largest unbalance", above=0.0)
    min_unbalance: float | None = quantity("unbalance", None, doc="lower end where the source gives a range", above=0.0)


@dataclass(frozen=True, kw_only=True, slots=True)
class BalanceGrade(Row):
    """Balance quality grade: the speed at which the centre of mass may circle the axis."""

    speed: float = quantity("speed", doc="eccentricity times angular speed", above=0.0)


@dataclass(frozen=True, kw_only=True, slots=True)
class PartLimit(Row):
    """Largest deviation of a measure on a part."""

    part: str = plain(doc="part it is measured on")
    limit: float = quantity("length", doc="largest deviation", above=0.0)


@dataclass(frozen=True, kw_only=True, slots=True)
class Lubrication(Row):
    """What to lubricate with, and when again."""

    lubricant: str = plain(doc="lubricant")
    hours: float | None = quantity("time", None, doc="interval in running time", above=0.0)
    distance: float | None = quantity("length", None, doc="interval in distance run", above=0.0)
    years: float | None = plain(None, doc="interval in years", above=0.0)


@dataclass(frozen=True, kw_only=True, slots=True)
class LifeFactor(Row):
    """A point of a printed table of factors."""

    at: float = plain(doc="where it stands in the table", above=0.0)
    printed: float = plain(doc="factor as printed", above=0.0)
    factor: float = plain(doc="factor, misprints put right", above=0.0)


@dataclass(frozen=True, kw_only=True, slots=True)
class GuideValue(Row):
    """A limit or factor of practice that no check uses by itself; two numbers are from and to, else as `note` says."""

    name: str = plain(doc="what it is")
    uses: tuple[str, ...] = plain((), doc="what it is for")
    lubricant: str = plain("", doc="lubricant")
    formula: str = plain("", doc="formula, in the units it names")
    value: tuple[float, ...] = plain((), doc="factor, ratio, coefficient or share", low=0.0)
    avoid: tuple[float, ...] = plain((), doc="range to keep out of, of the same", low=0.0)
    bending: tuple[float, ...] = plain((), doc="factor in bending", low=0.0)
    torsion: tuple[float, ...] = plain((), doc="factor in torsion", low=0.0)
    axial: tuple[float, ...] = plain((), doc="factor under axial load", low=0.0)
    slope: float | None = plain(None, doc="slope of the S-N curve", above=0.0)
    cycles: tuple[float, ...] = plain((), doc="cycles", low=0.0)
    teeth: int | None = plain(None, doc="teeth of the spline", low=1)
    years: tuple[float, ...] = plain((), doc="years", low=0.0)
    angular_acceleration: tuple[float, ...] = quantity("angular_acceleration", (), doc="angular acceleration", low=0.0)
    speed_angle: tuple[float, ...] = quantity("speed_angle", (), doc="product of speed and joint angle", low=0.0)
    joint_angle: tuple[float, ...] = quantity("angle", (), doc="joint angle", low=0.0)
    speed: tuple[float, ...] = quantity("angular_speed", (), doc="speed", low=0.0)
    torque: tuple[float, ...] = quantity("torque", (), doc="torque", low=0.0)
    power: tuple[float, ...] = quantity("power", (), doc="power", low=0.0)
    time: tuple[float, ...] = quantity("time", (), doc="time", low=0.0)
    distance: tuple[float, ...] = quantity("length", (), doc="distance run", low=0.0)
    diameter: tuple[float, ...] = quantity("length", (), doc="diameter", low=0.0)
    length: tuple[float, ...] = quantity("length", (), doc="length", low=0.0)
    flange: tuple[float, ...] = quantity("length", (), doc="flange diameter", low=0.0)
    stress: tuple[float, ...] = quantity("stress", (), doc="range of stress at 2 million cycles", low=0.0)
    pressure: float | None = quantity("stress", None, doc="largest pressure", above=0.0)
    inertia: tuple[float, ...] = quantity("inertia", (), doc="moment of inertia", low=0.0)
    stiffness: tuple[float, ...] = quantity("stiffness", (), doc="stiffness across", low=0.0)
    turning_stiffness: tuple[float, ...] = quantity("turning_stiffness", (), doc="torsional stiffness", low=0.0)


FLAGS = ("resonance_at_half_critical", "at_critical", "transient_at_critical", "wheel_order")
"""Circumstances in which a vibration appears and by which faults are told apart."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Fault(Row):
    """A fault of a drive shaft, or of what is mistaken for it: its signs, how to make sure, and what to do."""

    fault: str = plain(doc="what is wrong")
    orders: tuple[float, ...] = plain((), doc="orders of the vibration, in multiples of the shaft's speed", above=0.0)
    torque_sensitive: bool | None = plain(None, doc="whether its signs change with the torque; not known without")
    symptoms: tuple[str, ...] = plain((), doc="what a driver or fitter notices")
    flags: tuple[str, ...] = plain((), doc="circumstances in which it appears", choices=FLAGS)
    inspection: str = plain(doc="how to make sure")
    repair: str = plain(doc="what to do")


TABLES: dict[str, type[Row]] = {
    "materials": Grade,
    "laminae": Lamina,
    "joint_types": JointType,
    "joint_sizes": JointSize,
    "bearings": Bearing,
    "shaft_seals": ShaftSeal,
    "angle_norms": AngleNorm,
    "speed_angle_limits": SpeedAngleLimit,
    "max_joint_angles": MaxJointAngle,
    "angle_pairs": AnglePair,
    "balance_norms": BalanceNorm,
    "balance_grades": BalanceGrade,
    "part_limits": PartLimit,
    "lubrication": Lubrication,
    "life_factors": LifeFactor,
    "speed_angle_factors": LifeFactor,
    "limits": GuideValue,
    "factors": GuideValue,
    "faults": Fault,
}
"""Table of a catalogue file -> what its rows are."""


# Rows as a catalogue file has them and in the language spoken here, and the keys that a row can have.

R = TypeVar("R", bound=Row)

SENTENCES = ("source", "note", "name", "family", "treatment", "lubricant", "fault", "inspection", "repair")
"""Fields of rows that people read and no program compares."""

WORDS = ("parts", "uses")  # fields of rows with a list of such words; rows keep them as they are, for they are compared


USUAL: Mapping[str, str] = MappingProxyType({})  # no other units than those we write


class RowKey(NamedTuple):
    """A key of a row."""

    key: str
    """With its unit; inside an inner table after a point."""
    needed: bool
    meaning: str
    dimension: str = ""
    """Of its unit; empty where it has none."""


def row_keys(table: str) -> Iterator[RowKey]:
    """Yield the keys that a row of a table can have, those of inner tables after their own."""
    yield from _of_class(TABLES[table], "")


def _of_class(cls: Any, before: str) -> Iterator[RowKey]:
    for one in fields_of(cls).values():
        yield RowKey(before + one.spelling, one.required, _(one.key.doc), one.key.dimension or "")
        if is_dataclass(one.type) and one.type not in NAMED:
            yield from _of_class(one.type, f"{before}{one.spelling}.")


def told(row: R) -> R:
    """Return a row with its sentences in the language spoken here; those of a user's file stay as they are."""
    own = {name: getattr(row, name, "") for name in SENTENCES}
    said = {name: _(text) for name, text in own.items() if text}
    return row if all(said[name] == own[name] for name in said) else replace(row, **said)


def row_tree(row: Any, units: Mapping[str, str] = USUAL) -> dict[str, Any]:
    """Return a row as a catalogue file has it: keys with units, nothing that is not said.

    units: dimension -> unit, where it is not the usual one.
    """
    found: dict[str, Any] = {}
    for name, one in fields_of(type(row)).items():
        value = getattr(row, name)
        if value is None or value in ((), ""):
            continue
        if is_dataclass(value) and not isinstance(value, type):
            named = getattr(value, NAMED[type(value)]) if type(value) in NAMED else ""
            found[one.spelling] = named or row_tree(value, units)
        else:
            dimension = one.key.dimension or ""
            spelling = f"{name}_{units[dimension]}" if dimension in units else one.spelling
            found[spelling] = _in_unit(value, one.spellings[spelling])
    return found


def row_flat(row: Row, units: Mapping[str, str] = USUAL) -> dict[str, Any]:
    """Return a row with its inner tables spread out, as ``rating.torque_Nm``; lists as text.

    units: as of `row_tree`.
    """
    return dict(_spread(row_tree(row, units), ""))


def _spread(tree: Mapping[str, Any], before: str) -> Iterator[tuple[str, Any]]:
    for key, value in tree.items():
        if isinstance(value, Mapping):
            yield from _spread(value, f"{before}{key}.")
        else:
            said = _ if key in WORDS else _said
            yield before + key, ", ".join(map(said, value)) if isinstance(value, list) else value


def _said(value: Any) -> str:
    return f"{value:.10g}" if isinstance(value, float) else str(value)


def _in_unit(value: Any, factor: float) -> Any:
    if isinstance(value, tuple):
        return [_in_unit(item, factor) for item in value]
    if isinstance(value, float):
        return float(f"{value / factor:.12g}")
    return value
