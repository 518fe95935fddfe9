"""The drive in space, for an eye that moves: bodies with their motion over one turn, and what is drawn round them.

Lengths in m, turns in rad; a renderer only interpolates between frames and draws, it needs no kinematics.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence

import numpy as np

from cardan.answers import palette
from cardan.answers.quantity import Quantity, told
from cardan.answers.reader import reader
from cardan.catalogue.completion import sized
from cardan.checks.verdict import AMBER, Verdict
from cardan.checks.verdict_table import share as used_share
from cardan.drive.bodies.assembly import FRAMES, assembled, extent, turns
from cardan.drive.bodies.build import Build, Solid
from cardan.drive.drive import Drive
from cardan.drive.fields.paths import pose_drives
from cardan.drive.models.geometry import geometry
from cardan.drive.models.kinematics_model import mixed
from cardan.drive.models.machine_held import machine_held
from cardan.drive.shapes import floor_frame
from cardan.errors import InputError, refuse
from cardan.figures.axes import shaft_name
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.questions.bending.bending import CriticalSpeeds, bending_speeds
from cardan.questions.bending.figure import mode_name
from cardan.questions.forces.forces import Forces, forces
from cardan.questions.motion.moving_points import moving_points
from cardan.questions.torsion.model.torsion import TorsionModes, torsion_modes
from cardan.texts import _
from cardan.units import label as printed

from .lines import drawn_round
from .parts import Scene, SceneArrow, SceneBody, SceneCurve, SceneGroup, SceneMode

__all__ = ["Scene", "scene"]


def scene(
    drive: Drive,
    *,
    verdicts: Sequence[Verdict] = (),
    pose: int | None = None,
    time: float | None = None,
    with_forces: bool = False,
    with_modes: bool = False,
    frames: int = FRAMES,
) -> Scene:
    """Return a drive in space over one turn of its input, with real proportions where its file gives them.

    Parameters
    ----------
    drive : Drive
        Any drive.
    verdicts : sequence of Verdict
        Of `check` on it; bodies are then coloured by how far they use their limits.
    pose : int, optional
        Index of the pose it stands in; as drawn when not given.
    time : float, optional [s]
        At which its movements have brought it; standing there it turns once.
    with_forces : bool
        Also arrows of forces and couples over the turn, where the drive says what they follow from.
    with_modes : bool
        Also the shapes in which it whirls and swings in torsion.
    frames : int
        Places of the turn, evenly by the input angle.

    Returns
    -------
    Scene

    Raises
    ------
    InputError
        A pose that is not there, a time that its movements do not know.

    See Also
    --------
    report

    Notes
    -----
    Every place is exact: shafts and crosses stand by their arm directions (page *Conventions*), other
    kinds by their own law. Rigid parts keep their lengths in a pose; slip splines take up the difference.

    Examples
    --------
    >>> from cardan import Drive, scene
    >>> shown = scene(Drive.from_angles([0.2, 0.2]), frames=24)
    >>> len(shown.bodies), shown.angle.size, [group.name for group in shown.groups][:3]
    (15, 24, ['names', 'axes', 'planes'])
    """
    whole = sized(drive)
    build = _built(whole, pose, time, frames)
    centre, size = _extent(build)
    lines, areas, labels, groups = drawn_round(build, size)
    missing = _stuck(whole, build)
    arrows: tuple[SceneArrow, ...] = ()
    modes: tuple[SceneMode, ...] = ()
    facts = _joint_angles(build)
    if with_forces:
        arrows, more, lacking, borne = loads(build.drive, build, size)
        groups, missing = (*groups, *more), {**missing, **lacking}
        facts = {path: "; ".join(filter(None, (facts.get(path), borne.get(path)))) for path in facts | borne}
    if with_modes:
        modes, lacking = shapes(build.drive, build, size)
        missing = {**missing, **lacking}
    uses = used(verdicts)
    return Scene(
        name=drive.name,
        centre=centre,
        size=size,
        angle=np.arange(frames) * (2.0 * np.pi / frames),
        tracks=tuple(build.tracks),
        bodies=tuple(_body(solid, k, uses, facts) for k, solid in enumerate(build.solids)),
        lines=lines,
        areas=areas,
        labels=labels,
        arrows=arrows,
        modes=modes,
        groups=groups,
        scale=scale() if verdicts else (),
        missing=missing,
    )


def _built(drive: Drive, pose: int | None, time: float | None, frames: int) -> Build:
    """Return the bodies of a drive in a pose, at a time of its movements, or as drawn."""
    stood = drive
    if pose is not None:
        if not 0 <= pose < len(drive.poses):
            text = _("there is no pose {number}; the drive has {count}")
            raise refuse("pose", text.format(number=pose, count=len(drive.poses)))
        stood = pose_drives(drive)[pose]
    drawn = geometry(drive)
    here = drawn if stood is drive else geometry(stood)
    points = None
    if time is not None and stood.movements:
        points = moving_points(here.points, stood.movements, [time])[0][0]
    same = len(drawn.length) == len(here.length)
    return assembled(stood, count=frames, points=points, drawn=drawn if same else None)


def _extent(build: Build) -> tuple[Array, float]:
    """Return middle and size of all bodies; those that turn count round their axis x."""
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    for solid in build.solids:
        track, corners = build.tracks[solid.track], solid.surface.positions
        least, most = np.min(corners, axis=0), np.max(corners, axis=0)
        reach = 0.0
        if solid.track:
            reach = float(max(np.max(np.abs(least[1:])), np.max(np.abs(most[1:]))))
            origin = track.origin if track.origin.ndim == 1 else track.origin[0]
            x, y, z, w = track.turn[0]
            axis = np.asarray([1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)])
            ends = origin + least[0] * axis, origin + most[0] * axis
            least, most = np.minimum(*ends), np.maximum(*ends)
        low, high = np.minimum(low, least - reach), np.maximum(high, most + reach)
    return 0.5 * (low + high), float(np.linalg.norm(high - low))


def _stuck(drive: Drive, build: Build) -> dict[str, str]:
    """Return that joints do not turn at their joint angle, where any does not."""
    if not mixed(drive.joints):
        return {}
    numbers = [str(i + 1) for i in turns(drive, build)]
    if not numbers:
        return {}
    text = _("joint {number} does not turn at its joint angle with these sizes; it is shown turning uniformly")
    return {"motion": text.format(number=", ".join(numbers))}


def _joint_angles(build: Build) -> dict[str, str]:
    """Return path of each joint -> its joint angle in words."""
    angles = (Quantity(float(one), "angle", decimals=2).told(reader()) for one in build.place.joint_angle)
    return {f"joints[{i}]": _("joint angle {angle}").format(angle=angle) for i, angle in enumerate(angles)}


def _body(solid: Solid, k: int, uses: Callable[[Solid], Use | None], facts: Mapping[str, str]) -> SceneBody:
    """facts: path of a joint, shaft or support -> what it bears, in words."""
    found = uses(solid)
    share, words = found or (None, "")
    borne = facts.get(solid.path.partition(".")[0], "")
    text = "\n".join(filter(None, (told(solid.text, reader()), borne, words)))
    return SceneBody(
        name=f"{solid.part} {solid.number}-{k}",
        part=solid.part,
        number=solid.number,
        path=solid.path,
        text=text,
        track=solid.track,
        positions=solid.surface.positions,
        indices=solid.surface.indices,
        smooth=True,
        colour=palette.mixed(palette.colour(solid.role), "#ffffff", solid.shade),
        metal=solid.metal,
        utilisation=share,
        utilisation_colour=use_colour(share),
    )


# How far the bodies of a scene use their limits, and the colours that say so to every reader.

PARTS: dict[str, tuple[str, ...]] = {
    "bearing_life": ("bearing cap",),
    "needle_static": ("bearing cap",),
    "small_oscillation": ("bearing cap",),
    "lubrication": ("bearing cap",),
    "contact_pressure": ("bearing cap", "cross"),
    "inner_pressure": ("ball", "roller"),
    "journal_strength": ("cross",),
    "yoke_strength": ("driving yoke", "driven yoke"),
    "spline_strength": ("spline sleeve", "spline shaft"),
    "spline_pressure": ("spline sleeve", "spline shaft"),
    "spline_overlap": ("spline sleeve", "spline shaft"),
    "acceleration": (),
    "speed_fluctuation": (),
    "output_error": (),
}
"""Check -> parts of the joint or shaft that it judges; all of a joint, the tube of a shaft where it is not here."""

Use = tuple[float, str]


def used(verdicts: Sequence[Verdict]) -> Callable[[Solid], Use | None]:
    """Return a function from a body to the largest share of a limit it uses, and that in words.

    verdicts: of one drive; rules of thumb and what could not be judged are left out.
    """
    worst: dict[tuple[str, str], Use] = {}
    for one in verdicts:
        if one.advice or not one.run or not one.subject:
            continue
        share = float(np.max(one.utilisation))
        if math.isnan(share):
            continue
        parts = PARTS.get(one.check)
        if parts is None:
            parts = ("tube",) if one.subject.startswith("shafts") else ("",)
        for part in parts:
            key = one.subject.partition(".")[0], part
            if key not in worst or share > worst[key][0]:
                text = _("{share} of the limit of {check}")
                worst[key] = share, text.format(share=used_share(share).told(reader()), check=one.title)

    def of(solid: Solid) -> Use | None:
        path = solid.path.partition(".")[0]
        found = [worst[key] for key in ((path, solid.part), (path, "")) if key in worst]
        return max(found) if found else None

    return of


def scale() -> tuple[tuple[float, str, str], ...]:
    """Return the colours of utilisation: value, colour and what it means; darker the nearer to the limit."""
    return (
        (0.0, use_colour(0.0), _("unused")),
        (0.5, use_colour(0.5), _("half of the limit")),
        (AMBER, use_colour(AMBER), _("close to the limit")),
        (1.0, use_colour(1.0001), _("over the limit")),
    )


def use_colour(share: float | None) -> str:
    """Return the colour of a share of a limit: pale to blue, amber close to the limit, red beyond it."""
    if share is None:
        return palette.ROLES["grid"]
    if share > 1.0:
        return palette.ROLES["failed"]
    if share >= AMBER:
        return palette.ROLES["warning"]
    pale, blue = palette.mixed(palette.SHAFTS[5], "#ffffff", 0.72), palette.SHAFTS[1]
    return palette.mixed(pale, blue, share / AMBER)


# Mode shapes in space: shafts that whirl, and shafts that swing in torsion, enlarged to be seen.

MODE_FRAMES = 48
"""Places of one swing."""

POINTS = 25
"""Places along a shaft."""

BOW = 0.045
"""Largest deflection over the size of the whole."""

SWING = math.radians(28.0)
"""Largest turn of a torsional mode."""

MOST = 5
"""Torsional modes shown."""


def shapes(drive: Drive, build: Build, size: float) -> tuple[tuple[SceneMode, ...], dict[str, str]]:
    """Return the mode shapes of a drive, and which keys would allow those that are missing. size [m]."""
    modes: list[SceneMode] = []
    missing: dict[str, str] = {}
    try:
        modes += _whirls(bending_speeds(drive), build, size)
    except InputError as error:
        missing["whirl"] = sentence(error)
    try:
        modes += _torsions(torsion_modes(drive), build)
    except InputError as error:
        missing["torsion"] = sentence(error)
    if not modes:
        missing["modes"] = "; ".join(dict.fromkeys(missing.values()))
    return tuple(modes), missing


def _swing() -> Array:
    return np.arange(MODE_FRAMES) * (2.0 * np.pi / MODE_FRAMES)


def _whirls(found: CriticalSpeeds, build: Build, size: float) -> Iterator[SceneMode]:
    """Yield the shapes in which shafts whirl: every point of a shaft runs round its axis."""
    turn = _swing()
    gravity = np.asarray(build.drive.settings.gravity)
    for number, speed in enumerate(found.actual, start=1):
        curves = []
        for k, (first, last) in enumerate(found.shaft_span, start=1):
            if math.isnan(first) or not last > first:
                continue
            along = np.linspace(first, last, POINTS)
            off = BOW * size * np.interp(along, found.place, found.deflection[number - 1])
            _x, side, up = floor_frame(build.axis(k), gravity)
            start = build.centre(k - 2) if k > 1 else build.centre(0) - (last - first) * build.axis(1)
            share = (along - first) / (last - first)
            reach = float(build.place.length[k - 1]) if 1 < k <= build.count else float(last - first)
            axis = start + share[:, None] * reach * build.axis(k)
            way = np.cos(turn)[:, None] * up + np.sin(turn)[:, None] * side
            points = axis + off[:, None] * way[:, None, :]
            radius = 0.55 * build.body_radius(k)
            curves.append(SceneCurve(points=points, colour=palette.colour(f"shaft {k}"), radius=radius))
        said = Quantity(float(speed), "angular_speed").told(reader())
        text = _("critical speed {number}: {speed}").format(number=number, speed=said)
        yield SceneMode(
            name=text, text=mode_name(found.part[number - 1]), kind="whirl", frames=MODE_FRAMES, curves=tuple(curves)
        )


def _torsions(found: TorsionModes, build: Build) -> Iterator[SceneMode]:
    """Yield the shapes in which the drive swings in torsion: yokes and masses turn, lines along the shafts twist."""
    train, swing = found.train, np.sin(_swing())
    for number, (omega, shape) in enumerate(zip(found.omega[:MOST], found.shape[:MOST], strict=True), start=1):
        angle = dict(_ends(build, train.joints, shape))
        line = list(train.line)
        for k, own in build.free.items():
            angle[own] = k, float(shape[line[0] if k == 1 else line[-1]])
        for station, own in build.stations.items():
            k = build.drive.stations[station].shaft
            angle[own] = k, float(shape[line[0] if k == 1 else line[-1] if k > build.count else line[0]])
            place = _station_of(found, build, station)
            if place is not None:
                angle[own] = k, float(shape[place])
        turns = {track: _turn(build.axis(k), SWING * value * swing) for track, (k, value) in angle.items()}
        node = "; ".join(_node_texts(found, number - 1))
        said = Quantity(float(omega), "frequency", 3).told(reader())
        name = _("torsional mode {number}: {frequency}").format(number=number, frequency=said)
        curves = tuple(_lines(found, build, shape, swing))
        yield SceneMode(name=name, text=node, kind="torsion", frames=MODE_FRAMES, turns=turns, curves=curves)


def _ends(build: Build, joints: tuple[tuple[int, int], ...], shape: Array) -> Iterator[tuple[int, tuple[int, float]]]:
    """Yield the tracks at the joints with their shaft and how far they turn."""
    for i, (driving, driven) in enumerate(joints):
        yield build.ends[i + 1], (i + 1, float(shape[driving]))
        yield build.starts[i + 2], (i + 2, float(shape[driven]))


def _station_of(found: TorsionModes, build: Build, number: int) -> int | None:
    """Return the station of the model that carries a station of the file; None where it is not told apart."""
    name = build.drive.stations[number].name
    names = found.train.model.names
    hits = [k for k in found.train.line if name and names[k] == name]
    return hits[0] if len(hits) == 1 else None


def _node_texts(found: TorsionModes, mode: int) -> Iterator[str]:
    damping = float(found.damping_ratio[mode])
    names = found.train.model.names
    for node in found.nodes[mode][:3]:
        if node.before == node.behind:
            yield _("{place} stands still").format(place=names[node.before])
        else:
            yield _("stands still between {one} and {other}").format(one=names[node.before], other=names[node.behind])
    if damping > 0.0:
        yield _("damping ratio {ratio}").format(ratio=reader().number(damping, 2))


def _turn(axis: Array, angle: Array) -> Array:
    """Return turns about an axis as quaternions x y z w, array (p, 4)."""
    half = 0.5 * angle[:, None]
    return np.concatenate((np.sin(half) * axis, np.cos(half)), axis=-1)


def _lines(found: TorsionModes, build: Build, shape: Array, swing: Array) -> Iterator[SceneCurve]:
    """Yield lines along the shafts that twist with the mode, four round each."""
    train = found.train
    for k in range(2, build.count + 1):
        own = [s for s in train.line if train.model.shaft[s] == k - 1]
        if len(own) < 2:
            continue
        place = np.asarray(train.position)[own] - float(train.position[own[0]])
        whole = float(place[-1])
        if not whole > 0.0:
            continue
        length = float(build.place.length[k - 1])
        low, high = build.reach(k - 2, driving=False), length - build.reach(k - 1, driving=True)
        along = np.linspace(low, high, POINTS // 2)
        twist = np.interp(along / length, place / whole, shape[own] - shape[own[0]])
        angle = SWING * swing[:, None] * twist
        radius = 1.02 * build.body_radius(k)
        for quarter in range(4):
            at = angle + 0.5 * np.pi * quarter
            points = np.stack((np.broadcast_to(along, at.shape), radius * np.cos(at), radius * np.sin(at)), axis=-1)
            yield SceneCurve(
                points=points, colour=palette.ROLES["warning"], radius=0.05 * radius, track=build.starts[k]
            )


# Forces and couples of a drive as arrows over the turn.

LONGEST = 0.16
"""Length of the largest arrow over the size of the whole."""

LEAST = 1e-9
"""Forces and couples below this share of the largest are none."""

Loads = tuple[tuple[SceneArrow, ...], tuple[SceneGroup, ...], dict[str, str], dict[str, str]]


def loads(drive: Drive, build: Build, size: float) -> Loads:
    """Return arrows of the forces and couples of a drive as drawn, their switches, why there are none, what parts bear.

    build: its bodies; in a pose or while it moves no arrows are drawn that belong to another place.
    size [m].
    """
    if not np.allclose(build.place.points, geometry(drive).points, rtol=0.0, atol=1e-9 * size):
        return (), (), _both(_("Forces are shown for the drive as drawn and in its poses, not while it moves.")), {}
    angle = np.arange(build.frames) * (2.0 * np.pi / build.frames)
    try:
        found = forces(drive, angle=angle)
    except InputError as error:
        return (), (), _both(sentence(error)), {}
    missing: dict[str, str] = {}
    arrows: list[SceneArrow] = []
    groups: list[SceneGroup] = []
    pushes: list[tuple[str, Array, Array, str]] = []
    if found.reaction is None:
        missing["forces"] = _("supports: missing; forces of bearings and joints need [[supports]] that hold the shafts")
    else:
        for number, one in enumerate(machine_held(drive).supports):
            foot = build.centre(max(one.shaft - 2, 0)) + one.position * build.axis(one.shaft)
            name = one.name or _("support {number}").format(number=number + 1)
            pushes.append((name, foot, np.asarray(found.reaction)[number], "accent"))
        assert found.joint_force is not None
        for i in range(build.count):
            text = _("joint {number}, on the driven shaft").format(number=i + 1)
            pushes.append((text, build.centre(i), np.asarray(found.joint_force)[i], "second order"))
    whole, text = _scaled(pushes, "forces", "N", LONGEST * size, curl=False)
    if whole:
        arrows += whole
        groups.append(SceneGroup(name="forces", title=_("Forces"), on=True, text=text))
    turning = _torques(build, np.asarray(found.shaft_torque), np.asarray(found.output_torque))
    for k, couple in enumerate(np.asarray(found.secondary_couple), start=1):
        name = _("secondary couple of {shaft}").format(shaft=shaft_name(k, build.count + 1))
        turning.append((name, _middle(build, k), couple, "first order"))
    whole, text = _scaled(turning, "couples", "Nm", LONGEST * size, curl=True)
    if whole:
        arrows += whole
        groups.append(SceneGroup(name="couples", title=_("Couples"), on=False, text=text))
    return tuple(arrows), tuple(groups), missing, _borne(found)


def _borne(found: Forces) -> dict[str, str]:
    """Return path of each shaft, joint and support -> the torque or force that it bears over the turn, in words."""
    told = {}
    for k, torque in enumerate(np.abs(found.shaft_torque)):
        told[f"shafts[{k}]"] = _("torque {amount}").format(amount=_over_turn(torque, "Nm"))
    for name, pressed in (("joints", found.joint_force), ("supports", found.reaction)):
        for k, force in enumerate(() if pressed is None else frames.norm(np.asarray(pressed))):
            told[f"{name}[{k}]"] = _("force {amount}").format(amount=_over_turn(force, "N"))
    return told


def _over_turn(sizes: Array, unit: str) -> str:
    """Return the range of sizes over a turn in words."""
    low, high = float(np.min(sizes)), float(np.max(sizes))
    if high - low <= 1e-3 * high:
        return amount(high, unit)
    return _("{low} to {high}").format(low=amount(low, unit), high=amount(high, unit))


def _both(text: str) -> dict[str, str]:
    return {"forces": text, "couples": text}


def sentence(error: InputError) -> str:
    """Return what is missing, with the keys that would allow the answer."""
    return "; ".join(f"{one.field}: {one.message}" if one.field else one.message for one in error.problems)


def _middle(build: Build, k: int) -> Array:
    low, high = extent(build, k)
    found: Array = build.centre(max(k - 2, 0)) + 0.5 * (low + high) * build.axis(k)
    return found


def _torques(build: Build, torque: Array, output: Array) -> list[tuple[str, Array, Array, str]]:
    """Return the torque that drives the input, and the one that resists the output."""
    last = build.count + 1
    low, high = extent(build, 1)[0], extent(build, last)[1]
    first, behind = build.axis(1), build.axis(last)
    driven, held = torque[0][:, None] * first, -np.broadcast_to(output, torque[0].shape)[:, None] * behind
    return [
        (_("torque that drives the input"), build.centre(0) + 1.08 * low * first, driven, "good"),
        (_("torque that resists the output"), build.centre(build.count - 1) + 1.08 * high * behind, held, "failed"),
    ]


def _scaled(
    rows: Sequence[tuple[str, Array, Array, str]], group: str, unit: str, longest: float, *, curl: bool
) -> tuple[list[SceneArrow], str]:
    """Return rows of (name, foot, vector over the turn, role) as arrows to one scale, and that scale in words."""
    sizes = [frames.norm(vector) for _name, _foot, vector, _role in rows]
    most = max((float(np.max(one)) for one in sizes), default=0.0)
    if not most > 0.0 or not math.isfinite(most):
        return [], ""
    made = []
    for (name, foot, vector, role), one in zip(rows, sizes, strict=True):
        high = float(np.max(one))
        if high <= LEAST * most:
            continue
        text = f"{name}: {_over_turn(np.where(one > LEAST * high, one, 0.0), unit)}"
        own, factor = reader().unit(*_unit(high, unit))
        made.append(
            SceneArrow(
                group=group,
                text=text,
                colour=palette.colour(role),
                curl=curl,
                start=foot,
                vector=longest / most * vector,
                scale=most / longest / factor,
                unit=printed(own),
                decimal=reader().sign,
            )
        )
    return made, _("The longest arrow is {size}; all are drawn to one scale.").format(size=amount(most, unit))


def amount(value: float, unit: str) -> str:
    """Return a force [N] or couple [N·m] as who reads here is told it.

    >>> amount(2314.0, "N"), amount(0.04, "Nm")
    ('2.31 kN', '0.0400 N·m')
    """
    dimension, usual = _unit(value, unit)
    return Quantity(value, dimension, 3, unit=usual).told(reader())


def _unit(value: float, unit: str) -> tuple[str, str]:
    """Return the dimension of forces in N or couples in N·m, and the unit that a value is usually told in."""
    return "force" if unit == "N" else "torque", f"k{unit}" if abs(value) >= 1e3 else unit
