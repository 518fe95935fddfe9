"""The shipped examples."""

from __future__ import annotations

import json
import re
from pathlib import Path

from cardan.drive.drive import Drive
from cardan.drive.joints import Hooke
from cardan.drive.shaft import Shaft
from cardan.errors import refuse
from cardan.mechanism.mechanism import Mechanism
from cardan.texts import _, mark
from cardan.units import nearest

from .drive_file import load, load_mechanism
from .shifts import read_rows
from .shipped import examples_folder, mechanism_names


def example_names() -> tuple[str, ...]:
    """Return the names of the shipped examples.

    Examples
    --------
    >>> "single-20deg" in example_names()
    True
    """
    return tuple(sorted(path.stem for path in examples_folder().glob("*.toml")))


def recording_names() -> tuple[str, ...]:
    """Return the names of the shipped recordings.

    Examples
    --------
    >>> "truck-worn-spline" in recording_names()
    True
    """
    return tuple(sorted(path.stem for path in (examples_folder() / "recordings").glob("*.csv")))


def example_file(name: str) -> Path:
    """Return the file of a shipped example: a drive, a mechanism or a recording."""
    if name in mechanism_names():
        return examples_folder() / "mechanisms" / f"{name}.toml"
    if name in recording_names():
        return examples_folder() / "recordings" / f"{name}.csv"
    if name not in example_names():
        near = nearest(name, (*example_names(), *mechanism_names(), *recording_names()))
        hint = _("; the nearest is {near}").format(near=near) if near else ""
        raise refuse(
            "example",
            _("{name} is not a shipped example{hint}; there are {names}").format(
                name=repr(name), hint=hint, names=", ".join(example_names())
            ),
        )
    return examples_folder() / f"{name}.toml"


def example_text(name: str) -> str:
    """Return the text of a shipped example, with its comments."""
    return example_file(name).read_text("utf-8")


def example(name: str) -> Drive:
    """Return a shipped example.

    Parameters
    ----------
    name : str
        One of `example_names`.

    Returns
    -------
    Drive

    Raises
    ------
    InputError
        There is no example of that name.

    See Also
    --------
    load, example_mechanism

    Examples
    --------
    >>> from cardan import example
    >>> example("single-20deg").name
    'single joint at 20 degrees'
    """
    return load(example_file(name))


def example_mechanism(name: str) -> Mechanism:
    """Return a shipped example of a mechanism.

    Parameters
    ----------
    name : str
        One of `mechanism_names`.

    Returns
    -------
    Mechanism

    Raises
    ------
    InputError
        There is no example of that name, or it is a drive.

    See Also
    --------
    load_mechanism, example

    Examples
    --------
    >>> from cardan.mechanisms import example_mechanism
    >>> example_mechanism("hooke-stiff-bearings").links
    ('shaft 1', 'cross', 'shaft 2')
    """
    return load_mechanism(example_file(name))


# What the examples show, in a line each, for those who choose.

ABOUT = {
    "car-propshaft": mark("One-piece propeller shaft of a rear-wheel-drive car that passes every check."),
    "composite-propshaft": mark("Propeller shaft of carbon and glass fibre: one long piece without a centre bearing."),
    "cured-drive": mark("The unstable test stand made stable: its joint stands in the node of the mode."),
    "double-cardan-propshaft": mark("Front propeller shaft of an off-road car with a double cardan joint."),
    "front-halfshaft": mark("Half shaft of a front-wheel drive: tripod at the gearbox, Rzeppa joint at the wheel."),
    "instrument-joint": mark("Joint of an instrument: tolerances and the error of its output angle."),
    "mill-spindle": mark("Spindle of a rolling mill: high torque at low speed, life decides."),
    "overconstrained-pump": mark("Motor and pump, each shaft in two bearings: statically indeterminate, it binds."),
    "propshaft-with-rzeppa": mark("Two-piece propeller shaft with a Rzeppa joint beside the centre bearing."),
    "pickup-two-piece": mark("Two-piece propeller shaft of a pick-up: mean torque, hill with a trailer, pulling away."),
    "pto-baler": mark("Power take-off shaft of a baler with a flywheel in a turn: torsional vibration on the move."),
    "pto-drive": mark("Power take-off shaft of a tractor at 540 rpm with large joint angles."),
    "pto-flywheel": mark("Power take-off shaft with a flywheel: backlash, torque reversal, run-up."),
    "pto-flywheel-absorber": mark("The same shaft with a torsional vibration absorber on its flywheel."),
    "pto-hitch": mark("Power take-off shaft between tractor and trailer that steer and pitch: it moves."),
    "pto-spline-thrust": mark("Power take-off shaft drawn out under full torque: axial thrust by spline friction."),
    "rolling-mill-lower-spindle": mark("Lower spindle of a rolling mill: joint angles follow the wear of the roll."),
    "rolling-mill-upper-spindle": mark("Upper spindle of a rolling mill: poses with their shares of the running time."),
    "single-20deg": mark("The smallest drive: a single joint at 20°."),
    "six-joints": mark("Long chain of six joints in space, with yoke angles that make it uniform."),
    "steering-column": mark("Steering column of a van: two unequal joint angles, ratio over the steering angle."),
    "three-joints-unequal": mark("Three joints, one too steep: no yoke angles make it uniform."),
    "thompson-drive": mark("Machine drive with a Thompson coupling, a joint told by a mechanism file."),
    "tracta-steered-axle": mark("Steered axle of a lorry with a Tracta joint off its centre."),
    "truck-duty-cycle": mark("Rear drive of a heavy truck with a duty cycle: which joint is too small."),
    "truck-exact-yokes": mark("Four-joint truck unit with yoke angles that make it exactly uniform."),
    "truck-power-unit": mark("Engine and generator through four joints: torsional vibration of the whole unit."),
    "truck-printed-angles": mark("Four-joint truck unit by joint angles and planes, splines of 16 teeth."),
    "truck-printed-coordinates": mark("Four-joint truck unit by joint centres: every joint bends in its own plane."),
    "truck-rear-axle": mark(
        "Propeller shaft to a sprung rear axle: three poses and an axle that moves on its springs."
    ),
    "truck-supports": mark("Two-piece propeller shaft with all its supports: forces of bearings and joints."),
    "truck-wrong-yokes": mark("Four-joint truck unit with yoke angles from a slip of calculation."),
    "two-piece-rear-drive": mark("Two-piece propeller shaft of a van by the joint centres of its drawing."),
    "two-piece-rubber-bearing": mark("Two-piece propeller shaft with a centre bearing in rubber: critical speeds."),
    "unstable-drive": mark("Test stand in its principal zone of parametric resonance."),
    "w-arrangement": mark("Two joints in W: both joint angles the same way, given by slopes."),
    "z-arrangement": mark("Two joints in Z: parallel shafts with an offset."),
}


def about(name: str) -> str:
    """Return in a line what a shipped example shows; nothing for one of no line."""
    return _(ABOUT[name]) if name in ABOUT else ""


# The file that ``cardan init`` writes.

STARTER = mark("""\
# A drive file of cardan. Every key carries its unit; any usual one will do (_mm, _m, _in; _deg, _rad; _rpm, _rad_s).
# Lengths along x run with the power flow, y to the left, z up. Shaft 1 is the input shaft, joints are numbered along
# the power flow; shaft k lies between joint k-1 and joint k.

format = 1
name = "my drive"

# --- Geometry by joint centres -------------------------------------------------------------------------------------
input.point_mm = [-300, 0, 0]       # any point of the input axis before joint 1
# input.start_phase_deg = 0         # driving yoke of joint 1 from the plane of its two shafts at the start
output.point_mm = [1900, 40, -260]  # any point of the output axis behind the last joint

[[joints]]
name = "gearbox"
centre_mm = [0, 0, 0]

[[joints]]
name = "axle"
centre_mm = [1200, 0, -160]
# move_within_mm = [[1150, 1250], [0, 0], [-180, -120]]   # box in which `cardan phasing --layout` may put this centre

# --- Yokes and splines ---------------------------------------------------------------------------------------------
[[shafts]]
number = 2
yoke_angle_deg = 0                  # FROM the driving TO the driven yoke, about the shaft along the power flow
# yoke_fixed = true                 # not to be turned by synthesis
# spline = { teeth = 16, engaged_mm = 90, gap_mm = 40 }

[duty]
speed_rpm = 3000

# --- Instead of centres: bends and plane twists --------------------------------------------------------------------
# [[joints]]
# joint_angle_deg = 7.6                    # angle between the joint's two shafts
# [[joints]]
# joint_angle_deg = 5.2
# plane_twist_deg = 35              # from the plane of the joint before to this one, about the shaft between them
# [[shafts]]
# number = 2
# length_mm = 1200

# --- Or: slopes and lengths, as measured under the vehicle ---------------------------------------------------------
# [[joints]]
# [[joints]]
# [[shafts]]
# number = 1
# side_slope_deg = 0                # rising along the power flow is positive
# plan_slope_deg = 0                # to the left is positive
# [[shafts]]
# number = 2
# side_slope_deg = -7.6
# length_mm = 1210
# [[shafts]]
# number = 3
# side_slope_deg = -8.1
# plan_slope_deg = 3.3

# --- How the drive moves, and standing variants --------------------------------------------------------------------
# [[movements]]
# kind = "harmonic"                 # hitch, arm, parallel, harmonic, body, table, random
# moves = ["joints[1]", "output"]
# amplitude_mm = [0, 0, 60]
# frequency_Hz = 1.5
#
# [[poses]]
# name = "full load"
# share_percent = 30
# set = { "joints[1].centre_mm" = [1200, 0, -110], "output.point_mm" = [1900, 40, -210] }
""")


def starter() -> str:
    """Return a drive file to start from, with comments in the language spoken here; it loads as it is.

    Examples
    --------
    >>> from cardan.io import loads
    >>> loads(starter()).name
    'my drive'
    """
    return _(STARTER)


TEMPLATES = {
    "truck": "truck-duty-cycle",
    "car": "car-propshaft",
    "half-shaft": "front-halfshaft",
    "pto": "pto-drive",
    "mill": "mill-spindle",
    "steering": "steering-column",
    "instrument": "instrument-joint",
}
"""What a drive is for -> the shipped drive to start from."""

USES = {
    "truck": mark("truck"),
    "car": mark("car"),
    "half-shaft": mark("half shaft"),
    "pto": mark("power take-off"),
    "mill": mark("rolling mill"),
    "steering": mark("steering"),
    "instrument": mark("instrument"),
}
"""The same in words."""


def template(use: str, name: str) -> str:
    """Return a drive file to start from, for one of `TEMPLATES`, with a name of its own if there is one.

    >>> from cardan.io import loads
    >>> loads(template("mill", "stand 4")).name
    'stand 4'
    """
    text = example_text(TEMPLATES[use])
    body = text[text.index("\nformat") :].lstrip("\n")
    if name:
        line = f"name = {json.dumps(name, ensure_ascii=False)}"
        body = re.sub(r'^name = ".*"$', lambda _found: line, body, count=1, flags=re.MULTILINE)
    return f"{_(STARTED)}\n{body}"


STARTED = mark("""\
# Put your own numbers in: `cardan keys duty` tells the keys of a table, any usual unit will do; `cardan select` finds
# sizes of joints, and those of the series `example` that stand here are made up. Lengths along x run with the power
# flow, y to the left, z up. Shaft 1 is the input shaft; shaft k lies between joint k-1 and joint k. What belongs to the
# head of the file, as name, input and output, stands above the first table.
""")


LAYOUT = mark("""\
# The layout alone: `cardan keys duty` tells the keys of speed, torque and running time, in any usual unit; then
# `cardan select` finds sizes of joints. Shaft 1 is the input shaft; shaft k lies between joint k-1 and joint k.
""")


def from_points(path: Path, name: str) -> Drive:
    """Return a drive through the points of a CSV file with the columns x, y, z, each with its unit.

    The first row is a point of the input axis, the last one of the output axis, those between are joint centres.
    """
    return Drive.from_points(read_rows(path, [(word, "length") for word in "xyz"], least=3, rising=False), name=name)


def from_slopes(path: Path, name: str) -> Drive:
    """Return a drive by a CSV file with length, side_slope and plan_slope of every shaft, each with its unit."""
    columns = (("length", "length"), ("side_slope", "angle"), ("plan_slope", "angle"))
    rows = read_rows(path, columns, least=2, rising=False)
    shafts = [
        Shaft(number=k, length=length, side_slope=side, plan_slope=plan)
        for k, (length, side, plan) in enumerate(rows, start=1)
    ]
    return Drive(name=name, joints=tuple(Hooke() for _row in rows[1:]), shafts=tuple(shafts))
