"""Two shafts joined by a joint: point masses with plain angles and another integrator, and what must come out."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from cardan import InputError
from cardan.formulas.unbalance_behind_joint import unbalance_behind_joint
from cardan.questions.bending.cracked_rotor import Crack, cracked_rotor
from cardan.questions.bending.cracked_shafts import WhirlingShaft, cracked_shafts
from cardan.units import deg

CRACK = Crack(loss_xi=0.3, loss_eta=0.1, breathing=2)
FIRST = WhirlingShaft(mass=0.6, stiffness=19e3, inertia=6e-4, damping=4.0, unbalance_mass=0.01, unbalance_radius=0.02)
SECOND = WhirlingShaft(mass=0.5, stiffness=15e3, inertia=5e-4, damping=3.0, unbalance_mass=0.02, unbalance_radius=0.015)
HEAVY = {"mass": 0.6, "stiffness": 19e3, "damping": 40.0}


def behind(angle, joint_angle, phase):
    """Return θ_2 by the plain arctangent, half turns counted."""

    def joint(theta):
        turns = math.floor(theta / math.pi + 0.5)
        inside = theta - math.pi * turns
        return math.pi * turns + math.atan2(math.sin(inside), math.cos(joint_angle) * math.cos(inside))

    return joint(angle + phase) - joint(phase)


def plain(joint_angle, phase, speed, spring, damper):
    """Return the rates by weighted point coordinates: their Jacobian gives the masses, differences all the rest."""

    def points(q):
        theta, *places = q
        other = behind(theta, joint_angle, phase)
        rows, weights = [theta, other], [FIRST.inertia, SECOND.inertia]
        for one, angle, (x, y) in ((FIRST, theta, places[:2]), (SECOND, other, places[2:])):
            e = one.unbalance_radius
            rows += [x, y, x + e * math.cos(angle), y + e * math.sin(angle)]
            weights += [one.mass] * 2 + [one.unbalance_mass] * 2
        return np.asarray(rows), np.asarray(weights)

    def energy(time, q):
        theta, *places = q
        share = math.cos(0.5 * theta) ** (2 * CRACK.breathing)
        turn = np.asarray([[math.cos(theta), -math.sin(theta)], [math.sin(theta), math.cos(theta)]])
        matrix = turn @ np.diag([1.0 - share * CRACK.loss_xi, 1.0 - share * CRACK.loss_eta]) @ turn.T
        z = np.asarray(places)
        rows, _weights = points(q)
        weight = FIRST.mass * rows[2] + FIRST.unbalance_mass * rows[4]
        weight += SECOND.mass * rows[6] + SECOND.unbalance_mass * rows[8]
        elastic = FIRST.stiffness * z[:2] @ matrix @ z[:2] + SECOND.stiffness * z[2:] @ z[2:]
        return 0.5 * elastic + 0.5 * spring * (speed * time - theta) ** 2 - 9.81 * weight

    def rate(time, state):
        q, v = state[:5], state[5:]
        h = 1e-6
        units = h * np.eye(5)
        jacobian = np.stack([(points(q + u)[0] - points(q - u)[0]) / (2 * h) for u in units], axis=1)
        weights = points(q)[1]
        pull = np.asarray([(energy(time, q + u) - energy(time, q - u)) / (2 * h) for u in units])
        step = 1e-4 / abs(v[0])
        bent = (points(q + step * v)[0] - 2 * points(q)[0] + points(q - step * v)[0]) / step**2
        lost = np.asarray([damper * (v[0] - speed), *(FIRST.damping * v[1:3]), *(SECOND.damping * v[3:])])
        mass = jacobian.T @ (weights[:, None] * jacobian)
        return np.concatenate((v, np.linalg.solve(mass, -pull - lost - jacobian.T @ (weights * bent))))

    return rate


@pytest.mark.slow
@pytest.mark.parametrize(("joint_angle", "phase"), [(0.4, 0.6), (1.0, math.pi / 2)])
def test_point_masses_and_another_integrator_give_the_same_motion(joint_angle, phase):
    end = 0.04
    found = cracked_shafts(
        FIRST,
        SECOND,
        joint_angle,
        90.0,
        end,
        phase=phase,
        crack=CRACK,
        drive_stiffness=120.0,
        drive_damping=0.05,
        time=[end],
    )
    sag = [one.whole * 9.81 / one.stiffness for one in (FIRST, SECOND)]
    start = [0.0, sag[0], 0.0, sag[1], 0.0, 90.0, 0.0, 0.0, 0.0, 0.0]
    run = solve_ivp(plain(joint_angle, phase, 90.0, 120.0, 0.05), (0.0, end), start, "RK45", rtol=1e-8, atol=1e-10)
    theta, *places = run.y[:5, -1]
    # Second differences of the plain model leave some 1e-7 of the accelerations.
    assert found.angle[-1] == pytest.approx([theta, behind(theta, joint_angle, phase)], abs=3e-6)
    assert found.rate[-1, 0] == pytest.approx(run.y[5, -1], rel=1e-5)
    got = [found.deflection[-1, 0], found.deflection[-1, 1]]
    np.testing.assert_allclose(got, [places[0] + 1j * places[1], places[2] + 1j * places[3]], atol=2e-5 * sag[0])
    assert found.residual < 1e-9


def test_with_a_heavy_rotor_each_shaft_is_one_by_itself():
    first = WhirlingShaft(**HEAVY, inertia=1e4, unbalance_mass=1e-4, unbalance_radius=0.02)
    second = WhirlingShaft(**HEAVY, inertia=1e-3, unbalance_mass=1e-4, unbalance_radius=0.02)
    joint_angle, phase, speed = 25 * deg, 0.7, 80.0
    found = cracked_shafts(first, second, joint_angle, speed, 1.2, phase=phase, crack=CRACK, drive_stiffness=1.0)
    np.testing.assert_allclose(found.rate[:, 0], speed, rtol=1e-6)
    mass = first.whole
    omega = math.sqrt(first.stiffness / mass)
    zeta = 0.5 * first.damping / (mass * omega)
    given = {"crack": CRACK, "damping_ratio": zeta, "unbalance": first.unbalance}
    alone = cracked_rotor(mass, first.stiffness, speed, **given)
    late = found.time > 0.9  # what was there at the start has died to 1e-13
    np.testing.assert_allclose(found.deflection[late, 0], alone.at(found.angle[late, 0]), atol=2e-8 * 3e-4)

    order, size = found.orders(0, turns=4, reach=8)
    at = np.isin(alone.order, order.astype(int))
    np.testing.assert_allclose(size, alone.amplitude[at], atol=1e-9)

    force = unbalance_behind_joint(joint_angle, phase, reach=15)
    n = force.order
    answer = second.unbalance / mass * speed**2 * force.force
    answer = answer / (omega**2 - (n * speed) ** 2 + 2j * zeta * omega * n * speed)
    whirl = answer @ np.exp(1j * np.outer(n, found.angle[late, 0])) + mass * 9.81 / second.stiffness
    np.testing.assert_allclose(found.deflection[late, 1], whirl, atol=1e-5 * np.abs(answer).max())


def test_nothing_moves_that_nothing_moves():
    quiet = WhirlingShaft(mass=1.0, stiffness=1e4, inertia=1e-3)
    found = cracked_shafts(quiet, quiet, 0.0, 50.0, 0.2, drive_stiffness=100.0, time=[0.1, 0.2])
    np.testing.assert_allclose(found.deflection, 9.81e-4, rtol=1e-12)
    np.testing.assert_allclose(found.rate, 50.0, rtol=1e-12)
    np.testing.assert_allclose(found.torque, 0.0, atol=1e-9)
    np.testing.assert_array_equal(found.time, [0.0, 0.1, 0.2])
    bent = cracked_shafts(quiet, quiet, 20 * deg, 50.0, 0.2, drive_stiffness=100.0, gravity=0.0)
    np.testing.assert_array_equal(bent.deflection, 0.0)
    assert np.ptp(bent.rate[:, 0]) > 0.1  # the joint swings the first disc
    assert bent.residual < 1e-9


def test_a_run_can_be_stopped():
    found = cracked_shafts(
        FIRST, SECOND, 0.3, 90.0, 2.0, drive_stiffness=120.0, progress=lambda share: "stop" if share > 0.05 else None
    )
    assert found.cancelled
    assert 0.05 < found.time[-1] < 1.0


@pytest.mark.parametrize(
    ("changed", "named"),
    [
        ({"speed": 0.0, "end": -1.0, "drive_stiffness": 0.0}, ["speed", "end", "drive_stiffness"]),
        ({"joint_angle": 0.5 * math.pi, "phase": np.nan}, ["joint_angle", "phase"]),
        ({"gravity": -1.0, "drive_damping": np.inf}, ["drive_damping", "gravity"]),
        ({"second": WhirlingShaft(mass=0.0, stiffness=1.0, inertia=0.0, damping=-1.0)},
         ["second.mass", "second.inertia", "second.damping"]),
        ({"time": [2.0]}, ["time"]),
        ({"end": 1e6}, ["end"]),
    ],
)  # fmt: skip
def test_what_makes_no_pair_of_shafts_is_named(changed, named):
    given = {"first": FIRST, "second": SECOND, "joint_angle": 0.1, "speed": 50.0, "end": 0.1, "drive_stiffness": 100.0}
    with pytest.raises(InputError) as caught:
        cracked_shafts(**given | changed)
    assert [problem.field for problem in caught.value.problems] == named


def test_the_driven_shaft_may_be_cracked_and_all_angles_count():
    """Behind a straight joint both discs turn as one: the driven shaft does what the driving one did in its place;
    behind a bent one the account of energy closes with its crack, its angles and those of the unbalances in it."""
    sound = WhirlingShaft(mass=0.617, stiffness=18875.0, inertia=6e-4, damping=4.0)
    bad = replace(
        sound, crack=Crack(loss_xi=0.2, loss_eta=0.05), crack_angle=0.7, unbalance_mass=4e-3, unbalance_radius=0.01,
        unbalance_angle=-1.1,
    )  # fmt: skip
    how = {"speed": 80.0, "end": 0.4, "drive_stiffness": 120.0, "time": np.linspace(0.0, 0.4, 41)}
    first, second = cracked_shafts(bad, sound, 0.0, **how), cracked_shafts(sound, bad, 0.0, **how)
    np.testing.assert_allclose(second.deflection[:, 1], first.deflection[:, 0], atol=1e-9)
    np.testing.assert_allclose(second.deflection[:, 0], first.deflection[:, 1], atol=1e-9)
    aside = cracked_shafts(sound, replace(bad, unbalance_angle=1.0), 0.0, **how)
    assert np.max(np.abs(aside.deflection[:, 1] - second.deflection[:, 1])) > 1e-6
    bent = cracked_shafts(bad, replace(bad, crack_angle=-0.4), 0.3, phase=0.5, **how)
    assert bent.residual < 1e-8
