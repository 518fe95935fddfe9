"""What the writer writes the reader reads, field by field, for whatever the model holds."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import is_dataclass, replace
from typing import Any, get_args, get_origin

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cardan import Drive
from cardan.catalogue import completed, material
from cardan.drive.cross import Cross
from cardan.drive.duty import Block, Case, Duty, Limits, Vehicle
from cardan.drive.fields.keys import spelled
from cardan.drive.joint_parts import Rating
from cardan.drive.joints import Hooke
from cardan.drive.machine import (
    LAWS,
    AsynchronousMachine,
    Engine,
    EngineHarmonic,
    Event,
    RunUp,
    SpeedTorque,
    TorqueHistory,
)
from cardan.drive.material import Material
from cardan.drive.movement import MOVEMENTS, Random, Spectrum, Table
from cardan.drive.profile_tube import Profile
from cardan.drive.settings import Settings
from cardan.drive.shaft import PointMass, Shaft, ShaftCrack, Spline
from cardan.drive.station import Absorber, Pendulum, Station, ToNext
from cardan.drive.support import Support
from cardan.io import dumps, loads
from cardan.reading.fields import WORD_OR_FLAG, Field, fields_of, in_unit
from cardan.units import DIMENSIONS

DRIVE = Drive.from_angles([0.2, 0.3, 0.1], yoke_angles=[0.4, -0.3])

printable = st.characters(exclude_categories=["Cs", "Cc"])
words = st.text(printable, max_size=12)
notes = st.text(printable | st.sampled_from("\n\t"), max_size=12)


def inside(one: Field) -> st.SearchStrategy[float]:
    """Return numbers in the range of a field."""
    key = one.key
    low, high = max(key.low, key.above, -1e6), min(key.high, key.below, 1e6)
    return st.floats(
        low,
        high,
        exclude_min=key.above == low,
        exclude_max=key.below == high,
        allow_subnormal=False,
    ).filter(key.allows)


def holding(kind: Any, one: Field) -> st.SearchStrategy[Any]:
    """Return values of the type of a field."""
    if get_origin(kind) is tuple:
        parts = get_args(kind)
        if parts[-1] is Ellipsis:
            return st.lists(holding(parts[0], one), min_size=2, max_size=4).map(tuple)
        return st.tuples(*(holding(part, one) for part in parts))
    if is_dataclass(kind):
        return WAYS.get(kind, things)(kind)
    if kind is float:
        return inside(one)
    if kind is int:
        return st.integers(int(max(one.key.low, 0)), int(min(one.key.high, 1000)))
    if kind == WORD_OR_FLAG:
        return st.booleans() | st.sampled_from(one.key.choices)
    if one.key.choices:
        return st.sampled_from(one.key.choices)
    return st.booleans() if kind is bool else words


NAMES: dict[tuple[type, str], st.SearchStrategy[Any]] = {
    (Hooke, "size"): st.just(""),
    (Hooke, "type"): st.just("") | st.just("medium"),
    (Material, "grade"): st.just(""),
    (Material, "yield_strength"): st.none(),
    (Settings, "catalogues"): st.just(()),
    (Support, "bearing"): st.just(""),
    (Support, "seal"): st.just(""),
    (Shaft, "finish"): st.just("machined"),
    (Shaft, "notch"): st.none(),
    (Shaft, "layup"): st.none(),
    (Cross, "journal_bore"): st.just(0.0) | st.just(0.004),
    (Hooke, "needles"): st.none(),
}
"""Fields that name a row or a file, and names that are there."""


WAYS: dict[Any, Callable[[type], st.SearchStrategy[Any]]] = {
    Absorber: lambda cls: (
        things(cls, stiffness=st.just(0.0), damping=st.floats(0.1, 1e3)) | things(cls, stiffness=st.floats(1.0, 1e6))
    ),
    Rating: lambda cls: (
        things(cls, torque=st.none(), convention=st.just("Tc")) | things(cls, torque=st.floats(1.0, 1e5))
    ),
    ShaftCrack: lambda cls: things(cls, losses=st.tuples(*[st.floats(0.0, 0.9)] * 2), depth_ratio=st.none()),
    Vehicle: lambda cls: (
        things(cls, engine_torque=st.none()) | things(cls, engine_power=st.none(), engine_speed=st.none())
    ),
}
"""Tables of which some keys rule out others: every way to give them."""


def things(cls: type, **known: st.SearchStrategy[Any]) -> st.SearchStrategy[Any]:
    """Return instances of a class of the model with any of its fields given."""
    known = {name: one for (kind, name), one in NAMES.items() if kind is cls} | known
    given_fields = {
        name: known.get(name, holding(one.type, one) if one.required else st.just(one.default) | holding(one.type, one))
        for name, one in fields_of(cls).items()
    }
    return st.builds(cls, **given_fields)


def spectra() -> st.SearchStrategy[Spectrum]:
    rising = st.lists(st.floats(0.0, 1e3, allow_subnormal=False), min_size=2, max_size=4, unique=True).map(sorted)
    return rising.map(lambda f: Spectrum(frequency=tuple(f), density=tuple(1.0 + k for k in range(len(f)))))


@pytest.mark.slow
@pytest.mark.parametrize("kind", [cls for cls in MOVEMENTS.values() if cls is not Table])
@given(data=st.data())
@settings(max_examples=30, deadline=None)
def test_movements(kind: type, data: st.DataObject) -> None:
    known = {"moves": st.just(("joints[1]", "output"))}
    if "axis" in fields_of(kind):
        known["axis"] = st.just((0.0, 0.6, 0.8))
    if kind is Random:
        known["spectrum"] = spectra()
    drive = replace(DRIVE, movements=(data.draw(things(kind, **known)),))
    for form in ("toml", "json"):
        assert loads(dumps(drive, form=form), form=form) == drive


TUBE = {"outer": 0.07, "wall": 0.002}
bodies = st.sampled_from(
    [
        {},
        {"outer": 0.07},
        TUBE,
        TUBE | {"profile": Profile(form="lemon", inscribed=0.06)},
        TUBE | {"profile": Profile(form="star", inscribed=0.05, lobes=4)},
        {"outer": 1 / 3, "inner": 0.1},
    ]
)
spline_parts = {
    "mean_diameter": st.just(0.04),
    "friction": st.floats(0.0, 0.3),
    "position": st.just(0.25),
    "stiffness": st.none(),
}
splines = things(Spline, outer=st.none(), **spline_parts) | things(
    Spline, outer=st.just(0.043), root=st.none() | st.just(0.037), chamfer=st.floats(0.0, 1e-3), **spline_parts
)
ends = st.lists(st.floats(0.0, 1e4, allow_subnormal=False), min_size=2, max_size=2, unique=True)
ranges = ends.map(lambda two: tuple(sorted(two)))
run_ups = things(RunUp, start=st.just(0.0), end=st.floats(1.0, 1e3))
vehicles = things(Vehicle, engine_torque=st.none()) | things(Vehicle, engine_power=st.none(), engine_speed=st.none())
EVENTS = (
    Event(kind="clutch", name="start", count=1 / 3, torque=0.1, duration=1e-3, start=7.0),
    Event(kind="load_step", count=1e6, torque=1e4),
)
duties = things(
    Duty,
    torque=st.floats(-1e5, 1e5, allow_subnormal=False),
    speed_range=st.none() | ranges,
    run_up=st.none() | run_ups,
    **dict.fromkeys(("engine", "motor", "load"), st.none()),
    torques=st.just(()),
    cases=st.just(()),  # they contradict parts
    blocks=st.just(())
    | st.just((Block(torque=1 / 3, speed=100.0, share=0.3), Block(torque=0.0, speed=1e-3, share=0.7))),
    torque_history=st.none(),
    events=st.just(()) | st.just(EVENTS),
    vehicle=st.none() | vehicles,
).map(
    lambda duty: replace(
        duty,
        starts=duty.starts if duty.run_up is not None else None,  # starts are run-ups
        events=duty.events if duty.speed is not None else (),
    )
)


@st.composite
def shafts(draw: st.DrawFn) -> Shaft:
    none = dict.fromkeys(
        ("outer", "wall", "inner", "profile", "material", "centre_of_mass", "side_slope", "plan_slope")
    )
    shaft = draw(
        things(
            Shaft,
            number=st.just(2),
            stiffness=st.floats(1.0, 1e6),
            spline=st.none() | splines,
            segments=st.just(()),
            masses=st.lists(things(PointMass, position=st.just(0.0)), max_size=2).map(tuple),
            wear_factor=st.none(),
            **{name: st.none() for name in none},
        )
    )
    body = draw(bodies)
    graded = st.sampled_from([material("C45"), replace(material("C45"), density=1.0)])
    made_of = draw(st.none() | things(Material) | graded) if body else None
    crack = None if "profile" in body else shaft.crack  # none grows in a tube with a profile
    return replace(shaft, **body, material=made_of, crack=crack)


@pytest.mark.slow
@given(duties, shafts(), things(Limits), things(Settings), words, notes)
@settings(max_examples=100, deadline=None)
def test_all_other_tables(
    duty: Duty, shaft: Shaft, limits: Limits, surroundings: Settings, name: str, note: str
) -> None:
    if shaft.spline is None:
        limits = Limits()
    if shaft.length is not None and shaft.spline is not None:
        shaft = replace(shaft, spline=replace(shaft.spline, position=0.5 * shaft.length))
    drive = replace(DRIVE, duty=duty, shafts=(shaft,), limits=limits, settings=surroundings, name=name, note=note)
    for form in ("toml", "json"):
        assert loads(dumps(drive, form=form), form=form) == drive


crosses = things(Cross, span=st.just(0.08), journal=st.just(0.018))
ratings = things(Rating, torque=st.floats(1.0, 1e5)) | things(Rating, torque=st.none(), convention=st.just("Tc"))
hookes = things(
    Hooke,
    joint_angle=st.just(0.2),
    plane_twist=st.none(),
    centre=st.none(),
    move_within=st.none(),
    material_friction=st.none(),
    fit=st.just("new"),
    cross=st.none() | crosses,
    rating=st.none() | ratings,
)
fixed = {"shaft": 2, "position": 0.5, "bore": 0.06, "seal_diameter": 0.04, "radial": True}
places = things(Support, **{name: st.just(value) for name, value in fixed.items()})


@pytest.mark.slow
@given(hookes, st.lists(places, max_size=3))
@settings(max_examples=100, deadline=None)
def test_joints_and_supports(joint: Hooke, supports: list[Support]) -> None:
    held = tuple(
        replace(
            one,
            axial_stiffness=one.axial_stiffness if one.axial else None,
            tilt_stiffness=one.tilt_stiffness if one.tilt else None,
        )
        for one in supports
    )
    elastic = (Shaft(number=1, stiffness=1e4),)
    drive = replace(DRIVE, joints=(joint, *DRIVE.joints[1:]), supports=held, shafts=elastic)
    for form in ("toml", "json"):
        assert loads(dumps(drive, form=form), form=form) == drive


rising = st.lists(st.floats(-1e4, 1e4, allow_subnormal=False), min_size=2, max_size=4, unique=True).map(
    lambda row: tuple(sorted(row))
)


@pytest.mark.slow
@pytest.mark.parametrize("kind", [cls for cls in LAWS.values() if cls is not TorqueHistory])
@given(data=st.data())
@settings(max_examples=30, deadline=None)
def test_torques(kind: type, data: st.DataObject) -> None:
    """A torque of every kind, as motor, as load and on a station."""
    known = {"station": st.just("disc")}
    if kind is SpeedTorque:
        speeds = data.draw(rising)
        size = len(speeds)
        known |= {
            "speeds": st.just(speeds),
            "torques": st.lists(st.floats(-1e4, 1e4), min_size=size, max_size=size).map(tuple),
        }
    if kind is AsynchronousMachine:
        known["synchronous_speed"] = st.floats(1.0, 1e3)
    law = data.draw(things(kind, **known))
    disc = Station(name="disc", shaft=1, end="start", inertia=1.0)
    drive = replace(DRIVE, stations=(disc,), duty=Duty(motor=law, load=law, torques=(law, law)))
    for form in ("toml", "json"):
        assert loads(dumps(drive, form=form), form=form) == drive


TABLE = {"twists": st.just((-0.1, 0.0, 1 / 3)), "torques": st.just((-1e3, 0.1, 700.0))}
elements = (
    st.none()
    | things(ToNext, **dict.fromkeys(TABLE, st.just(())))
    | things(ToNext, stiffness=st.none(), backlash=st.just(0.0), **TABLE)
)
STOP = {"stop_angle": st.floats(0.1, 1.0), "stop_stiffness": st.floats(1.0, 1e4)}
NO_STOP = dict.fromkeys(STOP, st.none()) | {"stop_damping": st.just(0.0)}
pendulums = st.none() | things(Pendulum, **STOP) | things(Pendulum, **NO_STOP)
hung = st.tuples(st.none() | WAYS[Absorber](Absorber), st.none()) | st.tuples(st.none(), pendulums)


@pytest.mark.slow
@given(st.data(), elements, hung)
@settings(max_examples=50, deadline=None)
def test_stations(data: st.DataObject, element: ToNext | None, parts: tuple[Absorber | None, Pendulum | None]) -> None:
    known = {"shaft": st.just(1), "end": st.just("start"), "position": st.none(), "name": st.just("disc")}
    known |= {"to_next": st.just(element), "absorber": st.just(parts[0]), "pendulum": st.just(parts[1])}
    drive = replace(DRIVE, stations=(data.draw(things(Station, **known)),))
    for form in ("toml", "json"):
        assert loads(dumps(drive, form=form), form=form) == drive


@pytest.mark.parametrize(
    "engine",
    [
        Engine(cylinders=6, speed_ratio=1.7),
        Engine(mean_torque=300.0, harmonics=(EngineHarmonic(order=1.5, torque=90.0, phase=0.3),)),
        Engine(strokes=2, cylinders=3, bore=0.1, stroke=0.12, mean_pressure=1e6, piston_mass=1.4),
    ],
)
def test_engines(engine: Engine) -> None:
    drive = replace(DRIVE, duty=Duty(engine=engine))
    for form in ("toml", "json"):
        assert loads(dumps(drive, form=form), form=form) == drive


def test_a_joint_of_a_size_is_written_as_its_size_and_what_differs() -> None:
    own = replace(DRIVE.joints[0], size="example-90", cross=Cross(journal=0.025))
    drive = completed(replace(DRIVE, joints=(own, *DRIVE.joints[1:])))
    assert drive.joints[0].cross is not None
    assert (drive.joints[0].cross.span, drive.joints[0].cross.journal) == (0.07, 0.025)
    assert drive.joints[0].yoke is not None
    assert drive.joints[0].yoke.material == material("40KhNMA")
    text = dumps(drive)
    assert "journal_mm = 25" in text
    assert "span" not in text
    assert "yoke =" not in text
    assert loads(text) == drive


def test_a_note_of_several_lines_stands_in_several_lines() -> None:
    drive = replace(DRIVE, note='first\n  "second" \\ \n\nlast')
    assert '"""\nfirst\n' in dumps(drive)
    assert loads(dumps(drive)) == drive


def test_an_empty_spline_is_kept() -> None:
    drive = replace(DRIVE, shafts=(Shaft(number=3, spline=Spline()),))
    assert loads(dumps(drive)) == drive


@given(st.floats(-1e9, 1e9, allow_subnormal=False), st.sampled_from(sorted(DIMENSIONS)))
def test_the_nearest_decimal_is_one_rounding_away_at_most(value: float, dimension: str) -> None:
    for factor in DIMENSIONS[dimension].values():
        assert abs(in_unit(value, factor) * factor - value) <= math.ulp(value)


@pytest.mark.parametrize(
    ("path", "file"),
    [
        ("input.point", "input.point_mm"),
        ("joints[3].centre[2]", "joints[3].centre_mm[2]"),
        ("shafts[1].spline.engaged", "shafts[1].spline.engaged_mm"),
        ("movements[0].spectrum.frequency[1]", "movements[0].spectrum.frequency_Hz[1]"),
        ("poses[0].share", "poses[0].share_percent"),
        ("joints", "joints"),
        ("points[2]", "points[2]"),
    ],
)
def test_paths_are_spelled_as_in_a_file(path: str, file: str) -> None:
    assert spelled(path) == file


def test_load_cases() -> None:
    first = Case(name="first gear", torque=1 / 3, speed_range=(10.0, 20.0), share=0.3, flow="coast", shock_factor=1.5)
    cases = (first, Case(name="starts", torque=0.1, cycles=1e6))
    drive = replace(DRIVE, duty=Duty(torque=9.0, speed=100.0, life=1e8, cases=cases))
    for form in ("toml", "json"):
        assert loads(dumps(drive, form=form), form=form) == drive
