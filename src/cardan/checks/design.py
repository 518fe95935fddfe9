"""What is checked: a drive in its duty, some of its fields varied over many drives."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from typing import Any

import numpy as np

from cardan.catalogue import Catalogue, catalogue, completed
from cardan.catalogue.provenance import rows_behind
from cardan.catalogue.rows import Row
from cardan.drive.conditions import LoadCase, load_cases
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.fields.parts import known_lengths
from cardan.drive.fields.paths import bare_path, place
from cardan.drive.machine import Event
from cardan.drive.models.geometry import geometry, geometry_from_points, points_from_angles
from cardan.drive.models.kinematics_model import Chain, given_chain, turning, unlike_hooke
from cardan.drive.torsional_layout import has_torsion
from cardan.errors import InputError, refuse
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.kernel import frames
from cardan.maths.ties import foremost
from cardan.questions.accuracy.as_made import AsMade, as_made
from cardan.questions.forces.turn_loads import TurnLoads, at_joint_angle
from cardan.questions.motion.turning import Swing, swing
from cardan.texts import _

from .event_loads import event_vibration
from .load_case import Case, Vibration, largest, vibration
from .movement_loads import Moved, largest_joint_angles, largest_of

_STEP = re.compile(r"([a-z_][a-z0-9_]*)((?:\[\d+\])*)$")
_GEOMETRY = re.compile(
    r"joints\[\d+\]\.(centre|joint_angle|plane_twist)|shafts\[\d+\]\.(yoke_angle|side_slope|plan_slope|length)|input\.|output\."
)


@lru_cache(maxsize=4096)
def _steps(path: str) -> tuple[bool, tuple[tuple[str, tuple[int, ...]], ...]]:
    """Return whether a path begins at the duty, and the names behind it, each with its places in lists."""
    words = path.split(".")
    own = words[0] == "duty"
    matches = [_STEP.fullmatch(word) for word in words[own:]]
    assert all(matches), path
    return own, tuple((one[1], tuple(map(int, re.findall(r"\d+", one[2])))) for one in matches if one is not None)


@dataclass(frozen=True, eq=False, kw_only=True)
class Design:
    """A drive in its duty, or many drives that differ in a few fields.

    Attributes
    ----------
    drive : Drive
        With grades and sizes filled in, and with this duty.
    duty : Duty
    known : Catalogue
        Its norms, types and sizes.
    varied : mapping of str to array (...)
        Path without unit, as ``joints[0].cross.span`` or ``duty.torque`` -> values in SI, in place of the drive's.
    drawn : Design, optional
        The drives as drawn, where this is one of its poses: engaged length and gap of a spline hold there.
    pose : str
        Name of that pose.
    vibrates : bool
        Whether what torsional vibration adds to the loads counts.
    event : int, optional
        Which of its `events` it is in, so that the largest torques of that are its only loads; None while it runs.
    tried : bool
        Whether it is one of many that are tried: its torques count as those of steady vibration, stable or not.
    """

    drive: Drive
    duty: Duty
    known: Catalogue = field(default_factory=catalogue)
    varied: Mapping[str, Array] = field(default_factory=dict)
    drawn: Design | None = None
    pose: str = ""
    vibrates: bool = True
    event: int | None = None
    tried: bool = False

    @cached_property
    def shape(self) -> tuple[int, ...]:
        """Leading axes: () for one drive."""
        return np.broadcast_shapes(*(np.shape(one) for one in self.varied.values())) if self.varied else ()

    def value(self, path: str) -> Any:
        """Return what stands at a path without unit: an array where it is varied, None where nothing stands.

        Examples
        --------
        >>> Design(drive=Drive.from_angles([0.1]), duty=Duty()).value("joints[0].joint_angle")
        0.1
        """
        if path in self.varied:
            return self.varied[path]
        own, steps = _steps(path)
        here: Any = self.duty if own else self.drive
        for name, places in steps:
            if here is None:
                return None
            here = getattr(here, name)
            for k in places:
                here = here[k] if here is not None and k < len(here) else None
        return here

    def missing(self, *paths: str) -> tuple[str, ...]:
        """Return those of the paths at which nothing stands."""
        return tuple(path for path in paths if path not in self.varied and self.value(path) in (None, "", ()))

    def design_variables(self, *paths: str) -> tuple[str, ...]:
        """Return those of the paths at which something stands that can be changed."""
        return tuple(dict.fromkeys(path for path in paths if not self.missing(path)))

    def filled_by(self, *paths: str) -> tuple[Row, ...]:
        """Return the rows of the catalogue, sizes of joints and grades of materials, whose figures stand at paths.

        A figure that the drive file gives anew, or that is varied, is the user's own.
        """
        return rows_behind(self.drive, self.known, *(path for path in paths if path not in self.varied))

    @property
    def at_an_instant(self) -> bool:
        """Whether these drives stand as another does at instants of its movements."""
        return self.drawn is not None and bool(self.drawn.drive.movements) and not self.drive.movements

    @property
    def joints(self) -> int:
        """Number of joints."""
        return len(self.drive.joints)

    @cached_property
    def chain(self) -> Chain:
        """Kinematic half of the drives; joints of other kinds as the Hooke joints that turn alike."""
        return turning(self.given, self.drive.joints, near=True)

    @cached_property
    def swing(self) -> Swing | None:
        """How uneven the drive is as seen over a turn, where a joint turns by a law of its own; else None."""
        return swing(self.drive) if unlike_hooke(self.drive) else None

    @cached_property
    def made(self) -> AsMade | None:
        """How one drive turns with the errors of its joints as made; None without errors, or where none is told."""
        if self.varied or not any(joint.error is not None for joint in self.drive.joints):
            return None
        try:
            return as_made(self.drive)
        except InputError:
            return None

    @property
    def made_note(self) -> str:
        """Whether the errors of the joints as made count, in words; nothing without errors."""
        if self.made is not None:
            return _("with the errors as made")
        drawn = bool(self.varied) and any(joint.error is not None for joint in self.drive.joints)
        return _("without the errors as made, which do not count among many drives") if drawn else ""

    @cached_property
    def given(self) -> Chain:
        """Joint angles, planes and yokes of the drives as they are."""
        base, moved = given_chain(self.drive), self.replaced
        if not moved:
            return base
        joint_angle, twist = base.joint_angle, base.plane_twist
        if self.drive.form != "angles":
            found = geometry_from_points(self.points)
            joint_angle, twist = found.joint_angle, found.plane_twist
        return Chain(
            joint_angle=over(self.shape, joint_angle, moved, r"joints\[(\d+)\]\.joint_angle$", 0),
            plane_twist=over(self.shape, twist, moved, r"joints\[(\d+)\]\.plane_twist$", 1),
            yoke_angle=over(self.shape, base.yoke_angle, moved, r"shafts\[(\d+)\]\.yoke_angle$", 1),
            start_phase=np.broadcast_to(np.asarray(moved.get("input.start_phase", base.start_phase)), self.shape),
        )

    @cached_property
    def replaced(self) -> dict[str, Array]:
        """What varies of where joints and yokes are."""
        return {path: values for path, values in self.varied.items() if _GEOMETRY.match(path)}

    @cached_property
    def points(self) -> Array:
        """Points of the axis, array (..., n+2, 3) [m]."""
        angles = self.given if self.drive.form == "angles" else None
        return varied_points(self.drive, self.replaced, self.shape, angles)

    @cached_property
    def moving_joint_angle(self) -> Moved:
        """Largest joint angle of every joint over the movements of the drive, (..., n) [rad]."""
        return largest_joint_angles(self.points, self.drive.movements)

    def while_moving(self, ask: Callable[[Chain], Array], *, mean: bool = False) -> Moved | None:
        """Return the largest or mean answers over the movements of the drive (..., k); None where nothing moves."""
        if not self.drive.movements or self.swing is not None:
            return None
        return largest_of(ask, self.given, self.points, self.drive.movements, self.drive.joints, mean=mean)

    @property
    def joint_angle(self) -> Array:
        """Joint angle of every joint, array (..., n) [rad]."""
        return self.given.joint_angle

    def length(self, k: int) -> Array | float | None:
        """Return the length of a shaft between two joints, counted from 0 [m]; None where the drive does not say it."""
        known = known_lengths(self.drive).get(k + 1)
        given = self.value(f"shafts[{k}].length")
        if self.drive.form != "points":
            return known if given is None else given
        moved = any(row_of(path, self.joints) is not None for path in self.varied)
        if known is None or not moved:
            return known
        found: Array = frames.norm(self.points[..., k + 1, :] - self.points[..., k, :])
        return found

    @cached_property
    def cases(self) -> tuple[Case, ...]:
        """Every way the drive runs in this pose: its duty, then its load cases or the parts of its duty cycle."""
        duty, speed = self.duty, self.value("duty.speed")
        own = [one for one in load_cases(duty) if one.pose in ("", self.pose)]
        torque, unit = self.value("duty.torque"), dict[str, TurnLoads]()
        if not any(one.path == "duty" for one in own) and (torque is not None or speed is not None):
            own.insert(0, LoadCase(speed=duty.speed))  # a speed in use, and a torque only where it is varied
        if self.event is not None:
            return tuple(self._happening(one) for one in own if one.torque is not None)[:1]
        return tuple(self._case(one, unit, 0.0 if torque is None else torque) for one in own)

    def _happening(self, one: LoadCase) -> Case:
        """Return the event that a drive is in; followed in time, its shocks are its own."""
        _k, event, _count = next(its for its in self.events if its[0] == self.event)
        return replace(
            self._case(one, {}, self.duty.torque or 0.0),
            name="",
            severity=1.0 / self.duty.shock_factor,
            vibrating=lambda: event_vibration(self.drive, one, event) if self.vibrates else None,
        )

    @property
    def events(self) -> tuple[tuple[int, Event | None, Array], ...]:
        """What happens again and again with its number and its count in the life asked for; None, -1 for the run-up."""
        starts = self.value("duty.starts")
        own = ((k, one, self.value(f"duty.events[{k}].count")) for k, one in enumerate(self.duty.events))
        return (*(() if starts is None else ((-1, None, starts),)), *own)

    def _case(self, one: LoadCase, unit: dict[str, TurnLoads], scale: Array | float) -> Case:
        """Return a way to run of these drives."""
        part = one.path.startswith("duty.blocks")
        joint_angle = self.value(f"{one.path}.joint_angle") if part else None
        chain = self.chain
        if joint_angle is not None:
            flat = np.asarray(joint_angle, dtype=float)[..., None] + np.zeros(self.joints)
            chain = at_joint_angle(self.given, flat, self.drive.joints)
        history = one.path == "duty.torque_history"
        speed = self.varied.get(f"{one.path}.speed", one.speed)
        if (history or self.value(f"{one.path}.speed") is None) and one.speed_range is None:
            speed = self.value("duty.speed")
        timed = part or (bool(self.duty.cases) and one.share > 0.0)
        return Case(
            chain=chain,
            unit=unit if joint_angle is None else {},
            name=one.name,
            torque=_size(self.varied.get(f"{one.path}.torque", one.torque)),
            speed=_size(speed),
            fastest=self._fastest(one),
            held=one.held or one.speed_range is None,
            share=self.varied.get(f"{one.path}.share", one.share if timed or history else 1.0),
            block=timed,
            severity=one.shock_factor / self.duty.shock_factor,
            torque_at=one.torque_at,
            harmonics=one.harmonics,
            scale=scale,
            history=history,
            vibrating=lambda: None if history else self._vibration(one),
        )

    def _fastest(self, one: LoadCase) -> Array | float | None:
        """Return the highest speed of a way to run over a range of speeds [rad/s]; None where it is at one speed."""
        if one.speed_range is not None and one.path != "duty":
            return one.speed_range[1]
        return self.value("duty.speed_range[1]") if one.ranges and self.duty.speed_range is not None else None

    def _vibration(self, one: LoadCase) -> Vibration | None:
        """Return what torsional vibration adds to the loads in a way to run, of the drive itself."""
        if not self.vibrates or not has_torsion(self.drive):
            return None
        return vibration(replace(self.drive, poses=()) if self.drive.poses else self.drive, one)

    @property
    def loaded(self) -> tuple[Case, ...]:
        """Those of the ways to run that have a torque."""
        return tuple(case for case in self.cases if case.torque is not None)

    @property
    def held_speeds(self) -> list[Array]:
        """Speeds that these drives hold, arrays (...) [rad/s]."""
        return [np.asarray(case.speed, dtype=float) for case in self.cases if case.held and case.speed is not None]

    @cached_property
    def top_speed(self) -> Array | float | None:
        """Highest speed of the input, either way round [rad/s]."""
        speeds = [*(case.speed for case in self.cases if case.speed is not None), *self.range_tops]
        return largest(speeds) if speeds else None

    @property
    def range_tops(self) -> list[Array | float]:
        """Highest speeds of the ranges in which these drives run, arrays (...) [rad/s]."""
        own = [] if self.duty.speed_range is None else [self.value("duty.speed_range[1]")]
        cycle = (one for one in load_cases(self.duty) if one.path != "duty" and one.pose in ("", self.pose))
        return own + [one.speed_range[1] for one in cycle if one.speed_range is not None]

    def _asked(self, ask: Callable[[Case], Array], *, shocks: bool = True) -> list[Array]:
        """Return what every way to run under load asks of a part."""
        size = [one.severity if shocks else 1.0 for one in self.loaded]
        return [more * np.asarray(ask(case), dtype=float) for more, case in zip(size, self.loaded, strict=True)]

    def case_of(self, ask: Callable[[Case], Array]) -> str:
        """Return the name of the way to run that asks most of a part of one drive; empty where there is one only."""
        return self.called(self.loaded[int(foremost([float(one) for one in self._asked(ask)]))])

    def called(self, case: Case) -> str:
        """Return the name of one of the ways to run under load; empty where there is one only."""
        return "" if len(self.loaded) < 2 else case.name or _("the torque of the duty")

    def most(self, ask: Callable[[Case], Array], *, shocks: bool = True) -> tuple[Array, str]:
        """Return the largest answer of all the ways to run under load, and a sentence on which of them it is.

        Parameters
        ----------
        ask : function
            What a way to run asks of a part, without shocks.
        shocks : bool
            Whether shocks count, so that a load case with a factor of its own is larger by as much as that is.
        """
        answers = self._asked(ask, shocks=shocks)
        value = largest(answers)
        if value.ndim or len(answers) == 1:
            return value, ""
        name = self.loaded[int(foremost([float(one) for one in answers]))].name
        return value, _("decided by {case}").format(case=name) if name else ""

    @property
    def unloaded(self) -> tuple[str, ...]:
        """Path of the torque where the duty says none."""
        return () if self.loaded else ("duty.torque",)

    @property
    def unmoved(self) -> tuple[str, ...]:
        """Path of the speed where the duty says none."""
        return () if self.top_speed is not None else ("duty.speed",)

    @property
    def running(self) -> tuple[Case, ...]:
        """Parts that make up the time of the duty under load: its blocks, or the duty itself."""
        parts = [case for case in self.loaded if case.speed is not None]
        blocks = [case for case in parts if case.block]
        return tuple(blocks or [case for case in parts if not case.name])

    def allowed(self, strength: str) -> Array | float:
        """Return the stress allowed by the yield strength at a path: over the safety of the limits [Pa]."""
        return self.value(strength) / self.value("limits.safety")

    @property
    def shock(self) -> Array | float:
        """Factor for shocks on the torque."""
        return self.value("duty.shock_factor")

    @property
    def joint_angle_design_variables(self) -> tuple[str, ...]:
        """Paths that move the joint angles of the joints."""
        return tuple(dict.fromkeys(path for i in range(self.joints) for path in self.joint_angles_of(i)))

    def joint_angles_of(self, i: int) -> tuple[str, ...]:
        """Return the paths that move the joint angle of a joint, counted from 0."""
        if self.drive.form == "angles":
            return (f"joints[{i}].joint_angle",)
        if self.drive.form == "slopes":
            return self.design_variables(
                *(f"shafts[{k}].{name}" for k in (i, i + 1) for name in ("side_slope", "plan_slope"))
            )
        rows = ["input.point", *(f"joints[{k}].centre" for k in range(self.joints)), "output.point"]
        around = [rows[i + 1], rows[i], rows[i + 2]]
        return self.design_variables(*(f"{row}[{axis}]" for row in around for axis in (2, 1)))

    @property
    def yoke_design_variables(self) -> tuple[str, ...]:
        """Paths of the yoke angles that may be changed."""
        return tuple(f"shafts[{k}].yoke_angle" for k in range(1, self.joints) if not self.drive.shafts[k].yoke_fixed)

    @property
    def torque_design_variables(self) -> tuple[str, ...]:
        """Paths of the torques of the duty."""
        return self.design_variables("duty.torque", *(f"{one.path}.torque" for one in self._cycle))

    @property
    def speed_design_variables(self) -> tuple[str, ...]:
        """Paths of the speeds of the duty."""
        top = ("duty.speed_range[1]",) if self.duty.speed_range is not None else ()
        return self.design_variables("duty.speed", *top, *(f"{one.path}.speed" for one in self._cycle))

    @property
    def _cycle(self) -> list[LoadCase]:
        """Load cases and parts of the duty cycle, as the file has them."""
        return [one for one in load_cases(self.duty) if one.path.endswith("]")]


def _size(value: Any) -> Any:
    return None if value is None else np.abs(value)


def design(
    drive: Drive,
    duty: Duty | None = None,
    *,
    vary: Mapping[str, ArrayLike] | None = None,
    known: Catalogue | None = None,
) -> Design:
    """Return what is to be checked.

    Parameters
    ----------
    drive : Drive
        Grades and sizes are filled in from the catalogue.
    duty : Duty, optional
        The drive's own when not given.
    vary : mapping of str to array (...), optional
        Path with unit, as in the drive file: ``shafts[1].outer_mm`` -> values in that unit, over many drives.
    known : Catalogue, optional
        The shipped one when not given.

    Raises
    ------
    InputError
        A path that leads nowhere; names that the catalogue does not have.

    Examples
    --------
    >>> many = design(Drive.from_angles([0.1, 0.2]), vary={"joints[0].joint_angle_deg": [0.0, 10.0, 20.0]})
    >>> many.joint_angle.shape
    (3, 2)
    """
    rows = known or catalogue()
    made = whole(drive, drive.duty if duty is None else duty, rows)
    varied: dict[str, Array] = {}
    for path, values in (vary or {}).items():
        factor, bare = place(made, path).factor, bare_path(made, path)
        given = np.asarray(values, dtype=float)
        if not np.all(np.isfinite(given)):
            raise refuse(path, _("not every value is finite"))
        _variable(made, bare, path)
        varied[bare] = given * factor
    return Design(drive=made, duty=made.duty, known=rows, varied=varied)


def _variable(drive: Drive, bare: str, path: str) -> None:
    """Refuse to vary what is the same in all drives: movements, poses, reliability, laws of joints."""
    if bare.startswith(("movements[", "poses[", "duty.reliability")):
        raise refuse(path, _("is not varied in a batch; judge the drives one by one"))
    if bare in ("shafts[0].yoke_angle", f"shafts[{len(drive.joints)}].yoke_angle"):
        text = _("shaft {number} is an end shaft; only a shaft between two joints has this")
        raise refuse(path, text.format(number=1 if bare.startswith("shafts[0]") else len(drive.joints) + 1))
    match = re.match(r"joints\[(\d+)\]\.(\w+)", bare)
    own = drive.joints[int(match[1])].own_fields() if match else ()
    if match is not None and match[2] in own:
        raise refuse(path, _("is not varied in a batch; the law of motion of the joint depends on it"))


@lru_cache(maxsize=64)
def whole(drive: Drive, duty: Duty, known: Catalogue) -> Drive:
    """Return a drive in a duty with grades and sizes filled in.

    A drive that names catalogue files was filled in from them when it was loaded; what the given one does not know of
    it stays.
    """
    posed = drive if duty is drive.duty else replace(drive, duty=duty)
    try:
        return completed(posed, known)
    except InputError:
        if not drive.settings.catalogues:
            raise
        return posed


# Places and angles of drives that differ in a few of them.


def varied_points(
    drive: Drive, replaced: Mapping[str, Array], shape: tuple[int, ...], given: Chain | None = None
) -> Array:
    """Return the points of the axis of a drive, or of many, array (..., n+2, 3) [m].

    replaced, mapping of str to array (...): path without unit -> values of places and angles that vary.
    shape: leading axes of the drives; given: bends and planes of a drive that is given by angles.
    """
    outer = shape if replaced else ()
    place_of = geometry(drive)
    base = np.asarray(place_of.points, dtype=float)
    if given is not None:
        twist = np.asarray(replaced.get("joints[0].plane_twist", drive.joints[0].plane_twist or 0.0))
        length = over(outer, place_of.length, replaced, r"shafts\[(\d+)\]\.length$", 0)
        return points_from_angles(given.joint_angle, given.plane_twist, length, first_twist=twist)
    if drive.form == "slopes":
        length = over(outer, place_of.length, replaced, r"shafts\[(\d+)\]\.length$", 0)
        slopes = [
            over(
                outer,
                np.asarray([getattr(one, name) or 0.0 for one in drive.shafts]),
                replaced,
                rf"shafts\[(\d+)\]\.{name}$",
                0,
            )
            for name in ("plan_slope", "side_slope")
        ]
        axis = frames.unit(np.stack((np.ones_like(slopes[0]), np.tan(slopes[0]), np.tan(slopes[1])), axis=-1))
        steps = length[..., None] * axis
        after = np.cumsum(steps[..., 1:, :], axis=-2)
        return np.concatenate((-steps[..., :1, :], 0.0 * steps[..., :1, :], after), axis=-2)
    points = np.broadcast_to(base, (*outer, *base.shape)).copy()
    for path, values in replaced.items():
        row = row_of(path, len(drive.joints))
        if row is not None:
            part = re.search(r"\[(\d)\]$", path.partition(".")[2])
            points[..., row, int(part[1]) if part else slice(None)] = values
    return points


def over(shape: tuple[int, ...], values: Array, moved: Mapping[str, Array], pattern: str, first: int) -> Array:
    """Return values (..., k) with the varied ones in their places, whose index after ``first`` the pattern finds.

    One that lies outside them turns or bends nothing, as the plane of the first joint.
    """
    given = np.asarray(values, dtype=float)
    whole = np.broadcast_to(given, (*shape, given.shape[-1])).copy()
    for path, new in moved.items():
        match = re.match(pattern, path)
        if match and 0 <= int(match[1]) - first < whole.shape[-1]:
            whole[..., int(match[1]) - first] = new
    return whole


def row_of(path: str, joints: int) -> int | None:
    """Return which point of the axis a path moves; None where it moves none."""
    if path.startswith("input.point"):
        return 0
    if path.startswith("output.point"):
        return joints + 1
    match = re.match(r"joints\[(\d+)\]\.centre", path)
    return int(match[1]) + 1 if match else None
