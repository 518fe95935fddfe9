"""Drives at random, with most of what a file may say: for tests that hold of every drive."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from cardan import Drive
from cardan.drive.cross import Cross
from cardan.drive.duty import Block, Case, Duty, Harmonic, Limits
from cardan.drive.joint_parts import Needles
from cardan.drive.machine import RunUp
from cardan.drive.material import Material
from cardan.drive.movement import Body, Random, Spectrum
from cardan.drive.shaft import PointMass, Shaft, Spline, Unbalance
from cardan.drive.station import Station
from cardan.drive.support import Support
from cardan.joints import ConstantVelocity
from cardan.units import deg, hour, mm, rpm

from .rare_parts import with_rare_parts

Rng = np.random.Generator

NEVER, OFTEN = 0.0, 0.1
"""Probabilities of each of the rare parts: where drives are to be quick to judge, and where many are to have some."""


def any_drive(seed: int, rare: float = NEVER) -> Drive:
    """Return the drive of a seed: one to five joints in space, bodies, supports, masses, duty as chance has it.

    rare: probability of each part that few drives carry; without them it is the same drive.
    """
    rng = np.random.default_rng(seed)
    joints = int(rng.integers(1, 6))
    points = [np.asarray((-rng.uniform(0.1, 0.5), 0.0, 0.0)), np.zeros(3)]
    for _k in range(joints):
        rise = np.tan(rng.uniform(-18.0, 18.0, 2) * deg) * (rng.random(2) < 0.8)
        step = rng.uniform(0.2, 1.6) * np.asarray((1.0, *rise))
        points.append(points[-1] + step)
    bare = Drive.from_points(points, yoke_angles=rng.uniform(-np.pi, np.pi, max(joints - 1, 0)).tolist())
    drive = replace(
        bare,
        input=replace(bare.input, start_phase=float(rng.uniform(-3.0, 3.0))),
        joints=tuple(_joint(rng, one) for one in bare.joints),
        shafts=tuple(_shaft(rng, one, joints) for one in bare.shafts),
        duty=_duty(rng),
        limits=_limits(rng),
    )
    if rng.random() < 0.6:
        drive = replace(drive, supports=tuple(_supports(rng, drive)))
    if rng.random() < 0.4:
        drive = replace(drive, stations=_stations(rng, joints))
    if rng.random() < 0.25:
        drive = replace(drive, movements=(_movement(rng, joints),))
    return with_rare_parts(drive, seed, rare)


def _joint(rng: Rng, joint: Any) -> Any:
    if rng.random() < 0.07:
        return ConstantVelocity(centre=joint.centre)
    if rng.random() < 0.4:
        return joint
    span = rng.uniform(50.0, 160.0) * mm
    cross = Cross(span=span, journal=0.25 * span, material=Material(grade="C45") if rng.random() < 0.3 else None)
    if rng.random() < 0.3:
        cross = replace(cross, mass=float(rng.uniform(0.2, 2.0)), inertia=tuple(rng.uniform(1e-4, 1e-3, 3).tolist()))
    return replace(
        joint,
        cross=cross,
        friction=float(rng.uniform(0.002, 0.06)) if rng.random() < 0.5 else None,
        needles=Needles(capacity=float(rng.uniform(5e3, 6e4))) if rng.random() < 0.5 else None,
    )


def _shaft(rng: Rng, shaft: Shaft, joints: int) -> Shaft:
    inside = 1 < shaft.number <= joints
    made: dict[str, Any] = {}
    if rng.random() < (0.7 if inside else 0.3):
        outer = float(rng.uniform(30.0, 120.0) * mm)
        made |= {"outer": outer, "wall": outer * float(rng.uniform(0.03, 0.45))}
        if rng.random() < 0.6:
            made["material"] = Material(grade="C45")
    elif rng.random() < 0.3:
        made |= {"mass": float(rng.uniform(1.0, 30.0)), "inertia": float(rng.uniform(1e-3, 0.05))}
        made["stiffness"] = float(10.0 ** rng.uniform(3.5, 5.5)) if inside else None
    if inside and rng.random() < 0.3:
        spline = Spline(teeth=16, outer=42 * mm, root=36 * mm, tooth_width=4 * mm, length=80 * mm, engaged=80 * mm)
        friction = float(rng.uniform(0.02, 0.15)) if rng.random() < 0.5 else None
        made["spline"] = replace(spline, gap=40 * mm, friction=friction)
    if inside and ("outer" in made or made.get("stiffness")) and rng.random() < 0.4:
        made["loss_factor"] = float(rng.uniform(0.002, 0.08))
    if inside and rng.random() < 0.2:
        made["masses"] = (PointMass(position=0.1, mass=float(rng.uniform(0.1, 3.0)), polar_inertia=1e-3),)
    if inside and rng.random() < 0.2:
        made["unbalance"] = (Unbalance(position=0.1, amount=float(rng.uniform(1e-5, 1e-3))),)
    if rng.random() < 0.1:
        made["resisting_torque"] = float(rng.uniform(0.1, 5.0))
    return replace(shaft, **made)


def _limits(rng: Rng) -> Limits:
    if rng.random() < 0.5:
        return Limits()
    return Limits(speed_fluctuation=0.05, output_error=1.0 * deg, joint_angle=25.0 * deg)


def _duty(rng: Rng) -> Duty:
    speed = float(rng.uniform(100.0, 4000.0) * rpm * rng.choice((1.0, 1.0, 1.0, -1.0)))
    made: dict[str, Any] = {"speed": speed if rng.random() < 0.85 else None}
    if rng.random() < 0.85:
        made["torque"] = float(rng.uniform(10.0, 2000.0) * rng.choice((1.0, 1.0, 1.0, -1.0)))
    if rng.random() < 0.3:
        made["speed_range"] = (0.5 * abs(speed), 1.2 * abs(speed))
    if rng.random() < 0.5:
        made["life"] = float(rng.uniform(500.0, 20e3)) * hour
    if rng.random() < 0.3:
        made["shock_factor"] = float(rng.uniform(1.0, 2.0))
    if rng.random() < 0.25 and "torque" in made:
        made["torque_at"] = "input"
    if rng.random() < 0.25 and "torque" in made:
        part = float(rng.uniform(0.02, 0.6)) * abs(made["torque"])
        made["harmonics"] = (Harmonic(order=float(rng.choice((0.5, 1.0, 2.0, 3.0))), torque=part, phase=1.0),)
    if rng.random() < 0.15:
        made["cases"] = (Case(name="peak", torque=float(rng.uniform(100.0, 3000.0))),)
    elif rng.random() < 0.15:
        made["blocks"] = (
            Block(torque=600.0, speed=abs(speed), share=0.7),
            Block(torque=1100.0, speed=0.5 * abs(speed), share=0.3),
        )
    if rng.random() < 0.3:
        made["balance_grade"] = "G16"
    if rng.random() < 0.2:
        made["application"] = "industrial"
    if rng.random() < 0.1:
        made["run_up"] = RunUp(start=0.2 * abs(speed), end=abs(speed), duration=1.0)
    return Duty(**made)


def _supports(rng: Rng, drive: Drive) -> Any:
    """Yield two bearings of each end shaft, the first of them held along, and one of some shafts between."""
    joints = len(drive.joints)
    soft = {"stiffness": 5e6} if rng.random() < 0.5 else {}
    along = {"axial": True, "axial_stiffness": 5e7} if soft else {"axial": True}
    more = {"bore": 0.05, "friction": float(rng.uniform(0.001, 0.02))} if rng.random() < 0.4 else {}
    yield Support(shaft=1, position=-0.05, **soft, **along, **more)
    yield Support(shaft=1, position=-0.25, **soft)
    for number in range(2, joints + 1):
        if rng.random() < 0.6:
            yield Support(shaft=number, position=0.15, stiffness=2e5 if soft else None)
    yield Support(shaft=joints + 1, position=0.05, **soft, **(along if rng.random() < 0.6 else {}), **more)
    yield Support(shaft=joints + 1, position=0.2, **soft)


def _stations(rng: Rng, joints: int) -> tuple[Station, ...]:
    load = Station(shaft=joints + 1, end="end", inertia=float(10.0 ** rng.uniform(-1.5, 1.0)))
    if rng.random() < 0.5:
        return (load,)
    drag = float(rng.uniform(0.0, 0.05)) if rng.random() < 0.4 else 0.0
    return (Station(shaft=1, end="start", inertia=float(10.0 ** rng.uniform(-1.5, 1.0)), ground_damping=drag), load)


def _movement(rng: Rng, joints: int) -> Any:
    moves = ("output",) if joints == 1 else (f"joints[{joints - 1}]", "output")
    if rng.random() < 0.3:
        rough = Spectrum(frequency=(1.0, 4.0), density=(1.0, 0.2))
        return Random(moves=moves, axis=(0.0, 0.0, 1.0), deviation=5 * mm, spectrum=rough, duration=60.0)
    size = float(rng.uniform(5.0, 60.0)) * mm
    return Body(moves=moves, pivot=(0.0, 0.0, 0.0), amplitude=(0.0, 0.0, size), frequency=float(rng.uniform(0.5, 6.0)))
