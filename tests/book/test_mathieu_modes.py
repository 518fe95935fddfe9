"""Mathieu's equation of a drive file: against the reduction of two inertias, the exact drive, and integration."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from cardan.book.mathieu_answer import answer, ask, lacking
from cardan.book.mathieu_drive import mathieu_reduction
from cardan.book.mathieu_modes import mathieu_modes
from cardan.drive.duty import Duty, Harmonic
from cardan.drive.machine import Engine, EngineHarmonic, HarmonicTorque
from cardan.drive.models.kinematics_model import given_chain
from cardan.io import example
from cardan.maths.periodic.mathieu import exponents
from cardan.questions.torsion.stability.torsion_stability import stability

STAND = example("unstable-drive")


def at(rpm):
    return replace(STAND, duty=replace(STAND.duty, speed=rpm * np.pi / 30))


def test_two_inertias_have_the_parameters_of_the_books_reduction():
    """The motor on shaft 1 and the brake on shaft 2, each with its spring, the joint between: by its own formulas."""
    found = mathieu_modes(STAND)
    inertia, springs = [0.9, 0.4], [6000.0, 60000.0]
    chain = given_chain(STAND)
    apart = mathieu_reduction(chain.joint_angle, [float(chain.start_phase)], springs, first_inertia=inertia[0],
                              last_inertia=inertia[1], speed=STAND.duty.speed)  # fmt: skip
    assert found.number.tolist() == [1]
    assert float(found.a[0]) == pytest.approx(apart.a, rel=1e-12)
    assert float(found.q[0]) == pytest.approx(apart.q, rel=1e-9)
    assert found.zone[0][1:] == pytest.approx(apart.zone_speeds(), rel=1e-9)
    sizing = found.sizing.book
    assert sizing.order2 == pytest.approx(4 * apart.stiffness * apart.amplitude / abs(apart.a - 4), rel=1e-9)
    assert sizing.mean == 60.0


def test_growth_is_that_of_the_equation_integrated():
    """Two solutions over π by SciPy; the larger multiplier of the damped equation."""
    found = mathieu_modes(STAND)
    a, q, n = float(found.a[0]), float(found.q[0]), float(found.damping[0])

    def rate(z, y):
        return [y[1], -2 * n * y[1] - (a - 2 * q * np.cos(2 * z)) * y[0]]

    ends = [solve_ivp(rate, (0, np.pi), start, rtol=1e-11, atol=1e-13).y[:, -1] for start in ([1, 0], [0, 1])]
    multiplier = np.max(np.abs(np.linalg.eigvals(np.asarray(ends).T)))
    assert float(np.asarray(found.exponent.growth)[0]) == pytest.approx(np.log(multiplier) / np.pi, rel=1e-6)


@pytest.mark.parametrize(("rpm", "stable"), [(1250.0, True), (1340.0, False), (1420.0, True)])
def test_the_exact_equations_agree_about_the_zone(rpm, stable):
    found = mathieu_modes(at(rpm))
    assert bool(np.all(np.asarray(found.exponent.growth) <= 0.0)) == stable
    assert bool(np.all(stability(at(rpm)).stable)) == stable


@pytest.mark.slow
def test_the_engineering_method_meets_the_exact_torque_far_from_resonance():
    """Mean and order 2 come at their tops together, once a turn: within what order 4 and the static twist add."""
    found = mathieu_modes(example("pto-flywheel")).sizing
    assert found.most == pytest.approx(found.exact, rel=0.01)


def test_what_neglecting_the_parametric_term_costs_is_told_where_the_motion_is_stable():
    """Within its zone nothing bounds the motion; far from it the costs are those of `validity`."""
    grows = answer(STAND, mathieu_modes(STAND)).remarks[0].text
    assert grows == "The parametric term must not be neglected: without damping the vibration grows."
    found = mathieu_modes(at(900.0))
    worst = float(np.max(found.validity[0].error))
    assert answer(STAND, found).remarks[0].text.values["error"].value == pytest.approx(worst)


HARMONIC = HarmonicTorque(amplitude=30.0, order=3.0)
DRIVEN = {
    "duty": Duty(torque=60.0, torque_at="input", harmonics=(Harmonic(order=3.0, torque=30.0),)),
    "engine": Duty(torque=60.0, engine=Engine(cylinders=6, harmonics=(EngineHarmonic(order=3.0, torque=30.0),))),
    "motor": Duty(torque=60.0, motor=HARMONIC),
    "station": Duty(torque=60.0, torques=(replace(HARMONIC, station="motor"),)),
}
LOADED = {
    "duty": Duty(torque=60.0, harmonics=(Harmonic(order=3.0, torque=30.0),)),
    "load": Duty(torque=60.0, load=HARMONIC),
    "station": Duty(torque=60.0, torques=(replace(HARMONIC, station="brake"),)),
}


@pytest.mark.parametrize(("end", "ways"), [("drive", DRIVEN), ("load", LOADED)])
def test_torques_that_swing_count_alike_whatever_brings_them(end, ways):
    """Book (246): J_0/J_k M a/|a - ν²| of a torque of order ν on the inertia J_k."""
    own = {"drive": 0.9, "load": 0.4}[end]
    for way in ways.values():
        found = mathieu_modes(replace(STAND, duty=replace(way, speed=30.0 * np.pi, input="free")))
        a = float(found.a[0])
        wanted = 0.9 * 0.4 / (0.9 + 0.4) / own * 30.0 * a / abs(a - 9.0)
        assert getattr(found.sizing.book, end) == pytest.approx([wanted])
        other = {"drive": "load", "load": "drive"}[end]
        assert not len(getattr(found.sizing.book, other))


@pytest.mark.slow
def test_many_modes_have_no_engineering_method_and_say_so():
    drive = example("truck-power-unit")
    found = mathieu_modes(drive)
    assert found.sizing is None
    assert "5 modes" in found.without
    np.testing.assert_allclose(found.q, found.a * found.modes.modulation[found.number - 1])
    said = answer(drive, found)
    (figure,) = said.figures()
    assert figure.name == "mathieu-modes"
    k = found.nearest
    assert exponents(found.a[k], found.q[k], found.damping[k]).growth == pytest.approx(found.exponent.growth[k])


def test_what_lacks_and_what_has_nothing_to_tell():
    assert lacking(example("single-20deg"))
    straight = replace(STAND, joints=tuple(replace(one, joint_angle=0.0) for one in STAND.joints))
    assert ask(straight) is None
