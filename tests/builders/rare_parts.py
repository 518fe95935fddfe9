"""What few drives carry, put onto a drive by chance: kinds of joints, springs, friction, absorbers, laws of torque."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from cardan import Drive
from cardan.drive.duty import History
from cardan.drive.joints import JOINTS
from cardan.drive.machine import (
    AsynchronousMachine,
    ConstantTorque,
    Engine,
    EngineHarmonic,
    Event,
    HarmonicTorque,
    LinearTorque,
    MachineTorque,
    RunUp,
    SpeedTorque,
)
from cardan.drive.material import Material
from cardan.drive.movement import Hitch
from cardan.drive.shaft import Notch, Segment, Spline
from cardan.drive.station import Absorber, Pendulum, Station, ToNext
from cardan.errors import InputError
from cardan.io.drive_file import loads
from cardan.units import deg, hour, mm
from tests.fixtures.joint_keys import KEYS

Rng = np.random.Generator

KINDS = tuple(kind for kind in JOINTS if kind not in ("hooke", "constant_velocity"))


def with_rare_parts(drive: Drive, seed: int, share: float) -> Drive:
    """Return a drive with each of `RARE` that chance puts on it, at a probability; one that it cannot have is left."""
    rng = np.random.default_rng((seed, 1))
    for part in RARE:
        if rng.random() < share:
            try:
                drive = part(rng, drive)
            except InputError:
                continue
    return drive


def _kind(rng: Rng, drive: Drive) -> Drive:
    """Put a joint of another kind in place of one; its ball, where it has one, at the next point of the line."""
    place, kind = int(rng.integers(len(drive.joints))), str(rng.choice(KINDS))
    points = [np.asarray(joint.centre) for joint in drive.joints] + [np.asarray(drive.output.point)]
    reach = float(np.linalg.norm(points[place + 1] - points[place]))
    keys = KEYS[kind].replace("reach_mm = 400", f"reach_mm = {1e3 * reach!r}")
    text = f'format = 1\n[[joints]]\nkind = "{kind}"\njoint_angle_deg = 1\n{keys}\n'
    made = replace(loads(text).joints[0], centre=drive.joints[place].centre, joint_angle=None)
    joints = list(drive.joints)
    joints[place] = made
    return replace(drive, joints=tuple(joints))


def _ends(rng: Rng, drive: Drive) -> Drive:
    """Return the drive with a mass at its end, so that it vibrates in torsion."""
    last = len(drive.joints) + 1
    if any(one.shaft == last and one.end == "end" for one in drive.stations):
        return drive
    load = Station(shaft=last, end="end", inertia=float(10.0 ** rng.uniform(-1.5, 1.0)))
    return replace(drive, stations=(*drive.stations, load))


def _spring(rng: Rng, drive: Drive) -> Drive:
    """Put a spring that changes its stiffness, rubs or has play, on either end shaft: a clutch or a coupling."""
    drive = _ends(rng, drive)
    stiffness = float(10.0 ** rng.uniform(3.0, 5.0))
    made = ToNext(stiffness=stiffness, loss_factor=float(rng.uniform(0.01, 0.1)))
    what = rng.integers(4)
    if what == 0:
        twist = float(rng.uniform(0.5, 6.0)) * deg
        torque = stiffness * twist
        factor = float(rng.uniform(1.5, 6.0))
        made = ToNext(
            twists=(-2.0 * twist, -twist, twist, 2.0 * twist),
            torques=(-(1.0 + factor) * torque, -torque, torque, (1.0 + factor) * torque),
            damping=float(rng.uniform(0.1, 3.0)),
        )
    elif what == 1:
        made = replace(made, friction=float(rng.uniform(1.0, 150.0)))
    elif what == 2:
        made = replace(made, backlash=float(rng.uniform(0.1, 2.0)) * deg)
    last = len(drive.joints) + 1
    if rng.random() < 0.5:
        others = tuple(one for one in drive.stations if one.shaft != 1)
        hub = Station(shaft=1, end="start", inertia=float(10.0 ** rng.uniform(-2.0, 0.0)), to_next=made)
        return replace(drive, stations=(hub, *others))
    hub = Station(shaft=last, end="start", inertia=float(10.0 ** rng.uniform(-3.0, -1.0)), to_next=made)
    return replace(drive, stations=(*(one for one in drive.stations if one.end != "start" or one.shaft == 1), hub))


def _teeth(rng: Rng, drive: Drive) -> Drive:
    """Put play, a stiffness or both into the spline of a shaft between joints."""
    inside = list(range(1, len(drive.shafts) - 1))
    if not inside:
        return drive
    shafts, place = list(drive.shafts), int(rng.choice(inside))
    spline = shafts[place].spline or Spline(teeth=16, outer=42 * mm, root=36 * mm, engaged=80 * mm)
    if rng.random() < 0.7:
        spline = replace(spline, backlash=float(rng.uniform(0.1, 1.5)) * deg)
    if rng.random() < 0.5 and shafts[place].stiffness is None:
        spline = replace(spline, stiffness=float(10.0 ** rng.uniform(4.0, 6.0)))
    shafts[place] = replace(shafts[place], spline=spline)
    return replace(_ends(rng, drive), shafts=tuple(shafts))


def _on_load(drive: Drive, **parts: Absorber | Pendulum) -> Drive:
    *others, load = sorted(drive.stations, key=lambda one: one.end == "end")
    return replace(drive, stations=(*others, replace(load, **parts)))


def _absorber(rng: Rng, drive: Drive) -> Drive:
    """Hang a mass on a spring, or a viscous damper, on the load."""
    drive = _ends(rng, drive)
    inertia = float(10.0 ** rng.uniform(-2.5, -0.5))
    frequency = float(rng.uniform(30.0, 500.0))
    stiffness = inertia * frequency**2 if rng.random() < 0.8 else 0.0
    damping = float(rng.uniform(0.02, 0.5)) * inertia * frequency
    return _on_load(drive, absorber=Absorber(inertia=inertia, stiffness=stiffness, damping=damping))


def _pendulum(rng: Rng, drive: Drive) -> Drive:
    """Hang pendulums on the load, tuned near to order 2."""
    radius, order = float(rng.uniform(40.0, 120.0)) * mm, float(rng.uniform(1.8, 2.3))
    made = Pendulum(
        mass=float(rng.uniform(0.1, 1.0)),
        radius=radius,
        length=radius / order**2,
        count=int(rng.integers(1, 5)),
        stop_angle=40.0 * deg if rng.random() < 0.3 else None,
    )
    if made.stop_angle is not None:
        made = replace(made, stop_stiffness=500.0, stop_damping=0.5)
    return _on_load(_ends(rng, drive), pendulum=made)


def _law(rng: Rng, torque: float, speed: float) -> MachineTorque:
    """Return a law of a torque that is near to the one of the duty at its speed."""
    what = rng.integers(4)
    if what == 0:
        return ConstantTorque(torque=torque)
    if what == 1:
        return LinearTorque(standstill=0.3 * torque, slope=0.7 * torque / speed)
    if what == 2:
        return SpeedTorque(speeds=(0.0, speed, 2.0 * speed), torques=(0.2 * torque, torque, 4.0 * torque))
    return SpeedTorque(speeds=(-speed, 0.5 * speed, 1.5 * speed), torques=(torque, torque, 1.2 * torque))


def _load(rng: Rng, drive: Drive) -> Drive:
    """Load the output by a law, in place of the torque of the duty or beside it."""
    duty = drive.duty
    if not duty.speed:
        return drive
    law = _law(rng, abs(duty.torque or 200.0), abs(duty.speed))
    return replace(_ends(rng, drive), duty=replace(duty, load=law))


def _motor(rng: Rng, drive: Drive) -> Drive:
    """Drive the input by a motor or an engine, which need not turn it uniformly."""
    duty = drive.duty
    if not duty.speed:
        return drive
    torque, speed = abs(duty.torque or 200.0), abs(duty.speed)
    drive = _ends(rng, drive)
    if not any(one.shaft == 1 for one in drive.stations):
        rotor = Station(shaft=1, end="start", inertia=float(10.0 ** rng.uniform(-1.5, 0.5)))
        drive = replace(drive, stations=(rotor, *drive.stations))
    what = rng.integers(3)
    if what == 0:
        part = float(rng.uniform(0.1, 1.5)) * torque
        engine = Engine(cylinders=4, harmonics=(EngineHarmonic(order=2.0, torque=part, phase=0.3),))
        return replace(drive, duty=replace(duty, engine=engine))
    if what == 1:
        motor: MachineTorque = LinearTorque(standstill=4.0 * torque, slope=3.0 * torque / speed)
    else:
        motor = AsynchronousMachine(synchronous_speed=1.03 * duty.speed, pullout_torque=3.0 * torque, pullout_slip=0.1)
    return replace(drive, duty=replace(duty, motor=motor, input="free"))


def _torques(rng: Rng, drive: Drive) -> Drive:
    """Swing the output, or hold it back, by a torque of its own."""
    size = float(rng.uniform(5.0, 300.0))
    order = float(rng.choice((1.0, 1.5, 2.0, 3.0)))
    one: MachineTorque = HarmonicTorque(station="output", amplitude=size, order=order)
    if rng.random() < 0.3:
        one = ConstantTorque(station="output", torque=-size)
    return replace(_ends(rng, drive), duty=replace(drive.duty, torques=(one,)))


def _events(rng: Rng, drive: Drive) -> Drive:
    """Let the drive start, a clutch close and the load step, again and again."""
    duty = drive.duty
    if not duty.speed:
        return drive
    torque, speed = abs(duty.torque or 200.0), abs(duty.speed)
    made = []
    if rng.random() < 0.6:
        made.append(Event(kind="clutch", count=1e4, torque=2.0 * torque, duration=float(rng.uniform(0.0, 0.3))))
    if rng.random() < 0.6:
        made.append(Event(kind="load_step", count=1e3, torque=float(rng.uniform(0.0, 3.0)) * torque, duration=0.05))
    duty = replace(duty, events=tuple(made), life=duty.life or 2000.0 * hour)
    if rng.random() < 0.6:
        run_up = duty.run_up or RunUp(end=speed, duration=float(rng.uniform(0.3, 3.0)))
        duty = replace(duty, run_up=run_up, starts=float(10.0 ** rng.uniform(2.0, 5.0)))
    return replace(_ends(rng, drive), duty=duty)


def _history(rng: Rng, drive: Drive) -> Drive:
    """Measure the torque at the output."""
    torque = abs(drive.duty.torque or 200.0)
    times = np.linspace(0.0, 10.0, 41)
    torques = torque * (0.5 + rng.uniform(-1.0, 1.0, len(times)))
    history = History(file="torque.csv", times=tuple(times.tolist()), torques=tuple(torques.tolist()))
    duty = replace(drive.duty, torque_history=history, cases=(), blocks=(), life=drive.duty.life or 2000.0 * hour)
    return replace(drive, duty=duty)


def _stepped(rng: Rng, drive: Drive) -> Drive:
    """Step a shaft between joints, with notches."""
    if len(drive.joints) < 2:
        return drive
    shafts, place = list(drive.shafts), int(rng.integers(1, len(drive.joints)))
    length = float(np.linalg.norm(np.subtract(drive.joints[place].centre, drive.joints[place - 1].centre)))
    outer = float(rng.uniform(30.0, 80.0)) * mm
    steps = tuple(
        Segment(length=part * length, outer=size * outer, inner=inner * outer, material=Material(grade="C45"))
        for part, size, inner in ((0.3, 1.0, 0.0), (0.4, 1.5, 1.2), (0.3, 1.1, 0.3))
    )
    plain = {"outer": None, "inner": None, "wall": None, "material": None, "stiffness": None}
    shafts[place] = replace(shafts[place], segments=steps, notch=Notch(bending=1.5, torsion=1.3), **plain)
    return replace(drive, shafts=tuple(shafts))


def _hitched(rng: Rng, drive: Drive) -> Drive:
    """Swing the output about a pin, once in a few seconds."""
    pivot = tuple(np.asarray(drive.joints[-1].centre) + rng.uniform(-0.1, 0.1, 3))
    angles = rng.uniform(1.0, 15.0, 2) * deg
    move = Hitch(moves=("output",), pivot=pivot, yaw=float(angles[0]), pitch=float(0.3 * angles[1]), frequency=0.2)
    return replace(drive, movements=(*drive.movements, move))


def _misfit(rng: Rng, drive: Drive) -> Drive:
    """Set supports off their places, and damp them."""
    supports = tuple(
        replace(one, offset=tuple(rng.uniform(-0.3, 0.3, 3) * mm), damping=500.0 if one.stiffness else one.damping)
        for one in drive.supports
    )
    return replace(drive, supports=supports)


RARE: tuple[Callable[[Rng, Drive], Drive], ...] = (
    _kind,
    _kind,
    _spring,
    _teeth,
    _absorber,
    _pendulum,
    _load,
    _motor,
    _torques,
    _events,
    _history,
    _stepped,
    _hitched,
    _misfit,
)
