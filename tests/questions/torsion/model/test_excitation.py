"""Torque of engines against the classical series and plain sums over cylinders; laws of motors and loads."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from cardan.drive.machine import (
    AsynchronousMachine,
    ConstantTorque,
    Engine,
    EngineHarmonic,
    HarmonicTorque,
    LinearTorque,
    SpeedTorque,
    TorqueHistory,
)
from cardan.errors import InputError
from cardan.questions.torsion.model.excitation import AMBIENT, POLYTROPIC, engine_torque, law_of, piston


def curve(engine: Engine, speed: float, angle: np.ndarray) -> np.ndarray:
    """Return the torque of an engine cylinder by cylinder over the angle of its crank, straight from its definition."""
    radius, whole = 0.5 * engine.stroke, 0.0 * angle
    volume = 0.25 * math.pi * engine.bore**2 * engine.stroke
    dead = volume / (engine.compression_ratio - 1.0)
    for cylinder in range(engine.cylinders):
        own = (angle - cylinder * engine.strokes * math.pi / engine.cylinders) % (engine.strokes * math.pi)
        rod = radius / engine.rod_ratio
        height = radius * np.cos(own) + np.sqrt(rod**2 - (radius * np.sin(own)) ** 2)
        way = radius + rod - height
        step = 1e-5
        near = [radius * np.cos(own + h) + np.sqrt(rod**2 - (radius * np.sin(own + h)) ** 2) for h in (-step, 0, step)]
        first, second = (near[0] - near[2]) / (2 * step), -(near[0] - 2 * near[1] + near[2]) / step**2
        space = dead + 0.25 * math.pi * engine.bore**2 * way
        low = AMBIENT * (dead + volume) ** POLYTROPIC
        work = low * (dead ** (1 - POLYTROPIC) - (dead + volume) ** (1 - POLYTROPIC)) / (POLYTROPIC - 1)
        high = low * (1.0 + engine.mean_pressure * volume / work)
        stroke = np.floor(own / math.pi)
        gas = np.where(stroke == 0, high * space**-POLYTROPIC - AMBIENT, 0.0)
        gas = np.where(stroke == engine.strokes - 1, low * space**-POLYTROPIC - AMBIENT, gas)
        whole = whole + gas * 0.25 * math.pi * engine.bore**2 * first
        whole = whole - (engine.piston_mass or 0.0) * first * second * speed**2
    return whole


ENGINE = Engine(cylinders=4, bore=0.085, stroke=0.09, rod_ratio=0.28, mean_pressure=1e6, piston_mass=0.8)


@pytest.mark.parametrize(
    ("strokes", "cylinders", "rpm"), [(4, 4, 1500.0), (4, 3, 3000.0), (4, 1, 700.0), (2, 3, 1200.0)]
)
def test_the_harmonics_add_up_to_the_torque_of_every_cylinder(strokes: int, cylinders: int, rpm: float) -> None:
    engine = replace(ENGINE, strokes=strokes, cylinders=cylinders)
    speed = rpm * math.pi / 30
    found = engine_torque(engine, speed)
    angle = np.linspace(0.0, strokes * math.pi, 4000, endpoint=False) + 1e-3
    whole = curve(engine, speed, angle)
    assert found.mean == pytest.approx(np.mean(whole), rel=1e-4)  # of a mean over points with kinks
    for order, amplitude, phase in zip(found.order, found.amplitude, found.phase, strict=True):
        coefficient = 2.0 * np.mean(whole * np.exp(-1j * order * angle))
        assert amplitude * np.exp(1j * (phase - 0.5 * math.pi)) == pytest.approx(
            coefficient, abs=1e-3 * abs(found.mean)
        )


def test_the_oscillating_masses_swing_as_the_textbook_says() -> None:
    """m r² ω² (λ/4 sin φ - 1/2 sin 2φ - 3λ/4 sin 3φ - λ²/4 sin 4φ), to the first power of λ left out."""
    ratio, radius, mass, speed = 0.05, 0.045, 0.8, 100.0
    single = Engine(cylinders=1, strokes=2, stroke=2 * radius, rod_ratio=ratio, piston_mass=mass)
    found = engine_torque(single, speed)
    scale = mass * radius**2 * speed**2
    printed = {1.0: 0.25 * ratio, 2.0: -0.5, 3.0: -0.75 * ratio, 4.0: -0.25 * ratio**2}
    for order, amplitude, phase in zip(found.order[:3], found.amplitude, found.phase, strict=False):
        sine = amplitude * np.exp(1j * phase)
        assert sine.real == pytest.approx(scale * printed[order], rel=2 * ratio**2)  # the series is cut there
        assert abs(sine.imag) < 1e-12 * scale
    assert found.mean is None


def test_the_piston_is_where_its_rod_holds_it() -> None:
    angle, radius, ratio = np.linspace(0.0, 7.0, 50), 0.05, 0.3
    way, first, second = piston(angle, radius, ratio)
    pin = radius + radius / ratio - way - radius * np.cos(angle)
    np.testing.assert_allclose(np.hypot(pin, radius * np.sin(angle)), radius / ratio, rtol=1e-14)
    step = 1e-4
    ahead, behind = piston(angle + step, radius, ratio), piston(angle - step, radius, ratio)
    np.testing.assert_allclose((ahead[0] - behind[0]) / (2 * step), first, atol=1e-9)
    np.testing.assert_allclose((ahead[1] - behind[1]) / (2 * step), second, atol=1e-9)


@pytest.mark.parametrize(("strokes", "cylinders", "least"), [(4, 6, 3.0), (4, 3, 1.5), (2, 3, 3.0), (4, 1, 0.5)])
def test_evenly_spaced_cylinders_leave_the_main_orders(strokes: int, cylinders: int, least: float) -> None:
    order = engine_torque(
        Engine(strokes=strokes, cylinders=cylinders, bore=0.1, stroke=0.1, mean_pressure=1e6), 100.0
    ).order
    np.testing.assert_allclose(order, least * np.arange(1, len(order) + 1))


def test_a_ratio_passes_the_power() -> None:
    """The input shaft of an engine that turns 1.7 times as fast has 1.7 times its torque, at 1.7 times its orders."""
    plain = engine_torque(ENGINE, 170.0)
    geared = engine_torque(replace(ENGINE, speed_ratio=1.7), 100.0)
    np.testing.assert_allclose(geared.amplitude, 1.7 * plain.amplitude)
    assert geared.mean == pytest.approx(1.7 * plain.mean)
    assert [law.order for law in geared.laws[1:]] == pytest.approx(1.7 * plain.order)


def test_harmonics_as_given_come_back_by_rank() -> None:
    engine = Engine(
        mean_torque=300.0,
        harmonics=(EngineHarmonic(order=4.0, torque=20.0), EngineHarmonic(order=2.0, torque=90.0, phase=0.5)),
    )
    found = engine_torque(engine)
    assert (found.mean, found.order.tolist(), found.amplitude.tolist()) == (300.0, [2.0, 4.0], [90.0, 20.0])
    value = sum(float(law.at(0.0, np.asarray(0.3), np.asarray(0.0))[0]) for law in found.laws)
    assert value == pytest.approx(300.0 + 90.0 * math.sin(0.6 + 0.5) + 20.0 * math.sin(1.2))


def test_many_speeds_at_once_are_as_each_alone() -> None:
    """With the same orders at all of them, though what is small at one need not be so at another."""
    engine = replace(ENGINE, cylinders=1, mean_pressure=2e3)
    speeds = np.asarray([30.0, 150.0, 900.0])
    alone = [engine_torque(engine, speed) for speed in speeds]
    assert len({len(one.order) for one in alone}) > 1
    whole = engine_torque(engine, speeds)
    assert whole.amplitude.shape == (3, len(whole.order))
    assert set(whole.order) == set().union(*(one.order for one in alone))
    for row, one in enumerate(alone):
        at = np.searchsorted(whole.order, one.order)
        np.testing.assert_allclose(whole.amplitude[row, at], one.amplitude)
        np.testing.assert_allclose(whole.phase[row, at], one.phase)
    assert np.shape(whole.laws[1].amplitude) == (3,)


def test_masses_need_a_speed() -> None:
    with pytest.raises(InputError, match=r"duty\.speed"):
        engine_torque(ENGINE)


@pytest.mark.parametrize(
    ("machine", "drives"),
    [
        (ConstantTorque(torque=5.0), 5.0),
        (LinearTorque(standstill=5.0, slope=0.1), 5.0 - 0.1 * 20.0),
        (SpeedTorque(speeds=(10.0, 30.0), torques=(1.0, 3.0)), 2.0),
        (TorqueHistory(file="a.csv", times=(0.0, 4.0), torques=(0.0, 8.0)), 6.0),
        (HarmonicTorque(amplitude=2.0, order=3.0, phase=0.1), 2.0 * math.sin(3.0 * 0.7 + 0.1)),
    ],
)
def test_a_torque_that_drives_is_positive_and_one_that_resists_negative(machine: object, drives: float) -> None:
    where = 3.0, np.asarray(0.7), np.asarray(20.0)
    assert float(law_of(machine).at(*where)[0]) == pytest.approx(drives)
    loads = -drives if not isinstance(machine, LinearTorque) else -(5.0 + 0.1 * 20.0)  # a load rises
    assert float(law_of(machine, resists=True).at(*where)[0]) == pytest.approx(loads)


def test_an_asynchronous_machine_drives_below_and_brakes_above_its_speed_at_either_end() -> None:
    machine = AsynchronousMachine(synchronous_speed=150.0, pullout_torque=80.0, pullout_slip=0.2)
    for resists in (False, True):
        law = law_of(machine, resists=resists)
        below, at, above = (float(law.at(0.0, np.asarray(0.0), np.asarray(w))[0]) for w in (120.0, 150.0, 180.0))
        assert (below, at, above) == pytest.approx((80.0, 0.0, -80.0))
