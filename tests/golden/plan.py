"""Which commands are asked of which examples: every command that answers in JSON, and every form of its answer.

A command line is one string without ``--json``; it is the key of its numbers in ``answers.json.xz``. It runs in a
folder that holds the shipped ``examples``, the ``cases`` of `tests.reference`, and whatever ``PREPARED`` puts there.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[2]
EXAMPLES = ROOT / "examples"
REFERENCE = ROOT / "tests" / "reference"

LOAD = "--torque-Nm 900 --speed-rpm 1000"
"""For examples that state no torque or speed, so that they answer too."""

SWEEP = "--speed-rpm 600 --torque-Nm 400"

EVERY = (
    "motion {drive}",
    "phases {drive}",
    "articulation {drive}",
    "forces {drive}",
    f"forces {{drive}} {LOAD}",
    "losses {drive}",
    f"losses {{drive}} {LOAD}",
    "life {drive}",
    f"life {{drive}} {LOAD}",
    "strength {drive}",
    f"strength {{drive}} {LOAD}",
    f"strength {{drive}} --size tube {LOAD}",
    f"strength {{drive}} --size shaft:2 {LOAD}",
    f"strength {{drive}} --size joint {LOAD}",
    "balance {drive}",
    "balance {drive} --grade G16 --speed-rpm 1000",
    "select {drive}",
    f"select {{drive}} {LOAD} --modern",
    "tolerance {drive}",
    "tolerance {drive} --method worst",
    "bending {drive}",
    "bending {drive} --map",
    "rotor {drive}",
    "assembly {drive}",
    "mobility {drive}",
    "mobility {drive} --turn",
    "torsion modes {drive}",
    f"torsion modes {{drive}} {'--speed-rpm 1000'} --pieces 2",
    "torsion response {drive}",
    f"torsion response {{drive}} {SWEEP}",
    f"torsion response {{drive}} --speeds 300:1200:12 {'--torque-Nm 400'}",
    f"torsion simulate {{drive}} --span-s 0.2 --samples 101 {SWEEP}",
    "torsion stability {drive}",
    f"torsion absorber {{drive}} --speeds 300:900 {'--torque-Nm 400'}",
    "check {drive}",
    f"check {{drive}} {LOAD}",
)
"""Asked of every shipped drive."""

SOME: dict[str, tuple[str, ...]] = {
    "motion {drive} --angle-deg 10 --angle-deg 200 --speed-rpm 1000": ("truck-printed-angles", "six-joints"),
    "motion {drive} --angle-step-deg 30": ("pto-drive", "tracta-steered-axle"),
    "phases {drive} --fix 2=90": ("truck-printed-angles", "truck-wrong-yokes", "six-joints"),
    "phases {drive} --goal nearest": ("truck-printed-angles", "truck-wrong-yokes", "w-arrangement"),
    "phases {drive} --layout": ("truck-supports",),
    "articulation {drive} --until-s 1 --step-s 0.05 --speed-rpm 700": ("pto-hitch", "truck-rear-axle"),
    f"forces {{drive}} --movement all {LOAD}": ("pto-hitch", "truck-rear-axle"),
    f"forces {{drive}} --movement 1 {LOAD}": ("pto-hitch", "truck-rear-axle"),
    f"forces {{drive}} --angle-deg 30 --angle-deg 100 {LOAD}": ("truck-supports", "pto-hitch", "z-arrangement"),
    f"losses {{drive}} --map {LOAD}": (
        "truck-supports",
        "overconstrained-pump",
        "pto-spline-thrust",
        "instrument-joint",
    ),
    "life {drive} --method simple": ("truck-duty-cycle", "car-propshaft"),
    "life {drive} --method maker": ("truck-duty-cycle", "car-propshaft"),
    "life {drive} --method book": ("truck-duty-cycle", "car-propshaft"),
    "life {drive} --reliability-percent 95": ("truck-duty-cycle", "car-propshaft", "rolling-mill-lower-spindle"),
    f"strength {{drive}} --size tube:2 --hold wall --series R20 {LOAD}": ("car-propshaft", "truck-supports"),
    f"strength {{drive}} --size tube:2 --hold outer --series R40 {LOAD}": ("car-propshaft", "composite-propshaft"),
    f"strength {{drive}} --size journal:1 {LOAD}": ("car-propshaft", "truck-duty-cycle", "mill-spindle"),
    f"strength {{drive}} --size needles:1 {LOAD}": ("car-propshaft", "truck-duty-cycle", "mill-spindle"),
    f"strength {{drive}} --size joint:1 {LOAD}": ("car-propshaft", "truck-duty-cycle", "mill-spindle"),
    f"select {{drive}} --joint 1 {LOAD} --continuous --service-factor 1.5": ("truck-supports", "front-halfshaft"),
    "tolerance {drive} --method samples --samples 2048": ("instrument-joint",),
    "tolerance {drive} --allocate 2arcmin": ("instrument-joint",),
    "tolerance {drive} --allocate 0.01mm": ("instrument-joint",),
    "tolerance {drive} --allocate 2arcmin --of change --keep alpha4 --method worst": ("instrument-joint",),
    "bending {drive} --modes 5": ("truck-supports", "composite-propshaft", "two-piece-rubber-bearing"),
    "rotor {drive} --shaft 2 --speeds 500:3000:20": ("car-propshaft", "truck-supports", "composite-propshaft"),
    "rotor {drive} --shaft 2 --damping 0.05 --run-up": ("pto-flywheel", "pto-flywheel-absorber"),
    "rotor {drive} --joint 2 --speed-rpm 1000 --turns 5": ("truck-supports",),
    "assembly {drive} --angle-deg 30 --angle-deg 100": ("overconstrained-pump", "truck-supports"),
    f"torsion simulate {{drive}} --settled --span-s 0.2 --samples 101 {SWEEP}": ("truck-supports", "unstable-drive"),
    "torsion simulate {drive} --samples 101": ("pto-flywheel", "pto-flywheel-absorber"),
    "torsion road {drive}": ("pto-baler",),
    "torsion stability {drive} --speeds 300:1500:6 --bends 2:20:4": ("unstable-drive", "pto-flywheel"),
    "torsion stability {drive} --speeds 1200:1460:8": ("unstable-drive", "truck-power-unit"),
    "torsion stability {drive} --over shafts[1].inertia_kg_m2=0.01:0.2:4 --speeds 300:900:4": ("unstable-drive",),
    "torsion absorber {drive} --kind den_hartog --ratio 0.2 --speeds 300:700 --torque-Nm 400": ("pto-flywheel",),
    "torsion absorber {drive} --kind viscous --speeds 300:700 --torque-Nm 400": ("pto-flywheel", "truck-power-unit"),
    "torsion absorber {drive} --kind tuned --speeds 300:700 --torque-Nm 400": ("pto-flywheel", "truck-power-unit"),
    "torsion absorber {drive} --kind pendulum --radius-mm 120 --speeds 300:700 --torque-Nm 400": ("pto-flywheel",),
    "torsion calm {drive} --rounds 2 --speeds 300:700 --torque-Nm 400": ("pto-flywheel", "truck-power-unit"),
    "torsion calm {drive} --grid 3 --speeds 300:700 --torque-Nm 400": ("pto-flywheel",),
    f"check {{drive}} --only tube_strength --only bend --sources {LOAD}": ("car-propshaft", "truck-supports"),
    "simulate-fault {drive} --list": ("truck-supports", "car-propshaft"),
    "convert {drive} out.json --force": ("truck-supports",),
    "convert {drive} out.toml --form angles --force": ("truck-supports",),
}
"""Asked of some drives only: further forms of an answer, or what takes long."""

KINDS = {
    "hooke": "",
    "offset_cross": "offset_mm=20 reach_mm=60",
    "double_cardan": "centring_ratio=0.5",
    "constant_velocity": "",
    "tracta": "",
    "rzeppa": "",
    "weiss": "",
    "tripod": "",
    "half_cardan": "",
    "elastic_half_cardan": "",
    "pin_coupling": "",
    "clemens": "",
}

FAULTS = [
    "healthy",
    "unbalance",
    "lost_weight",
    "bent",
    "bends",
    "phase",
    "half_critical",
    "tight_joint",
    "critical",
    "crack",
    "worn_joint",
    "worn_spline",
    "centre_bearing",
]

SYMPTOMS = [
    "vibration_in_motion",
    "noise",
    "clunk_on_load_reversal",
    "shudder_on_take_off",
    "boom",
    "squeak",
    "knock",
    "howl",
    "grease_leak",
    "heating",
    "needle_marks",
    "spalling",
    "journal_end_galled",
    "no_drive",
    "fracture",
    "vibration_at_standstill",
]

TABLES = [
    "materials",
    "joint_types",
    "joint_sizes",
    "angle_norms",
    "speed_angle_limits",
    "max_bends",
    "angle_pairs",
    "balance_norms",
    "balance_grades",
    "part_limits",
    "lubrication",
    "life_factors",
    "speed_angle_factors",
    "faults",
]

BOXED = (
    "examples/truck-printed-coordinates.toml",
    "boxed.toml",
    "centre_mm = [707, -57, 27]",
    """\
centre_mm = [707, -57, 27]
move_within_mm = [[650, 760], [-100, 50], [0, 60]]""",
)
"""A drive whose joints may be moved, of which none is shipped: example, copy, what stands in it, what shall instead."""

ALONE = (
    "phases boxed.toml --layout",
    "phases boxed.toml --layout --goal nearest",
    "select --torque-Nm 2500 --bend-deg 12 --speed-rpm 900 --synchronous",
    "select --torque-Nm 300 --bend-deg 30 --speed-rpm 1500 --outer-mm 120 --short --modern",
    "joint",
    *(f"joint {kind} {sizes} --bend-deg 25 --speed-rpm 1000".replace("  ", " ") for kind, sizes in KINDS.items()),
    "joint hooke rzeppa tracta --bend-deg 15",
    "check --list",
    "diagnose --orders 2 --with-torque",
    "diagnose --orders 1=3.2,2=5",
    "diagnose --orders 1,4 --no-torque",
    *(f"diagnose --symptom {symptom}" for symptom in SYMPTOMS),
    *(f"simulate-fault examples/truck-supports.toml {fault} --run-up-s 2 --hold-s 1" for fault in FAULTS),
    "simulate-fault examples/car-propshaft.toml unbalance --steady-rpm 1200 --hold-s 1 --severity 2 --shaft 2",
    "catalogue",
    *(f"catalogue {table}" for table in TABLES),
    "catalogue joint_sizes --keys",
    "catalogue materials C45",
    "catalogue joint_sizes example-75",
    "calc --list",
    "calc --list chain",
    "example",
    "motion examples/no-such-file.toml",
    "motion examples/truck-printed-angles.toml --speed-rpm nan",
    "forces examples/truck-printed-angles.toml --angle-step-deg 0",
    "life examples/truck-duty-cycle.toml --reliability-percent 101",
    "report examples/truck-supports.toml -o report.html",
    "report examples/truck-supports.toml -o report.html --unit length=in --decimal ,",
)
"""Asked of no drive, or of one."""

PREPARED = {"offers": "sweep examples/sweeps/supplier-choice.toml --into offers"}
"""Folder -> the command line that fills it."""

SWEEPS = (
    *(f"sweep examples/sweeps/{name}.toml" for name in ("supplier-choice", "truck-suspension", "tolerance-field")),
    "sweep examples/sweeps/stability-boundary.toml --design boundary",
    "sweep examples/sweeps/tolerance-field.toml --design sensitivity",
    "sweep show offers",
    "sweep show offers --best 'min mass_kg' --limit 'strength_used <= 1' --count 3",
    "sweep show offers --pareto 'min price_eur' --pareto 'max life_h' --limit 'strength_used <= 1'",
    "sweep show offers --query 'SELECT supplier, mass_kg, life_h FROM sweep ORDER BY mass_kg, supplier'",
)

BY_HAND = {
    "blokh": "alpha_deg=[10,15,12] beta_deg=[30,-40] gamma_deg=[80,20] phi1_deg=[0,25,50,100,170]",
    "book_comparison": "alpha_deg=[10,15,12] beta_deg=[30,-40] gamma_deg=[80,20]",
    "book_series": "alpha_deg=[10,15,12] beta_deg=[30,-40] gamma_deg=[80,20] phi1_deg=[0,25,50,100,170] order=2",
    "collinear_joints": "alpha_deg=[10,15,12] sign=[1,1,-1]",
    "double_joint": "alpha12_deg=12 alpha23_deg=9 arrangement=d beta2_deg=20 gamma2_deg=70 phi1_deg=[0,25,50,100,170]",
    "groove_offset": "alpha_deg=40 plane_tilt_deg=0.5 axial_play_m=1e-4",
    "length_compensation": "points0_m=[[-0.3,0,0],[0,0,0],[1.2,0,-0.2],[1.5,0,-0.25]] "
    "amplitude_m=[[0,0,0],[0,0,0.01],[0,0.01,0.05],[0,0.01,0.05]] omega_motion_rad_s=12 "
    "t_s=[0,0.1,0.2,0.3,0.4,0.5] shaft=2 overlap0_m=0.08",
    "pin_geometry": "alpha_max_deg=30 radius_m=0.08",
    "rule_of_practice": "alpha_deg=[10,15,12] beta_deg=[30,-40] gamma_deg=[80,20]",
}
"""Calculations without a case of reference -> their inputs."""


def drives() -> list[str]:
    """Return the names of the shipped drives."""
    return sorted(path.stem for path in EXAMPLES.glob("*.toml"))


def plan() -> Iterator[str]:
    """Yield every command line, in a fixed order."""
    for drive in drives():
        for line in EVERY:
            yield line.format(drive=f"examples/{drive}.toml")
        for line, wanted in SOME.items():
            if drive in wanted:
                yield line.format(drive=f"examples/{drive}.toml")
    for path in sorted((EXAMPLES / "mechanisms").glob("*.toml")):
        yield f"mobility examples/mechanisms/{path.name}"
        yield f"mobility examples/mechanisms/{path.name} --turn"
    for path in sorted((EXAMPLES / "recordings").glob("*.csv")):
        yield f"diagnose examples/recordings/{path.name} examples/truck-supports.toml"
    yield "diagnose examples/recordings/truck-unbalance.csv"
    yield from ALONE
    yield from SWEEPS
    for name, values in BY_HAND.items():
        yield f"calc {name} {values}"
    for name, case in sorted(cases().items()):
        yield f"calc {case['capability']} --input cases/{name}.json"


def cases() -> dict[str, dict]:
    """Return the cases of reference by name."""
    read = (json.loads(path.read_text("utf8"))["cases"] for path in sorted(REFERENCE.glob("*.json")))
    return {case["id"]: case for group in read for case in group}
