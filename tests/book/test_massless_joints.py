import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import minimize

from cardan.book import mathieu_drive
from cardan.book.mathieu_drive import MasslessDrive, mathieu_reduction, steady_twist
from cardan.errors import InputError
from cardan.maths.periodic.mathieu import exponents
from cardan.units import deg

SPRINGS = [3000.0, 9000.0, 7000.0, 8000.0, 2500.0]


def four_joints(**options):
    values = {"first_inertia": 2.0, "last_inertia": 0.6, "speed": 50.0} | options
    return mathieu_reduction(
        np.asarray([11.5, 25.0, 15.0, 16.5]) * deg, np.asarray([0.0, 88.1, 20.1, 16.4]) * deg, SPRINGS, **values
    )


def one_joint(joint_angle, a, psi=0.0):
    values = {"first_inertia": 1.0, "last_inertia": 0.4, "speed": np.sqrt(2800.0 / a)}
    return mathieu_reduction([joint_angle], [psi], [1000.0, 4000.0], **values)


def driven(theta, alpha):
    return theta + np.arctan2(np.sin(theta) * np.cos(theta) * (1 - np.cos(alpha)),
                              np.cos(theta) ** 2 * np.cos(alpha) + np.sin(theta) ** 2)  # fmt: skip


def energy(yokes, first, last, found):
    """Return what the springs hold, by tan T = tan θ/cos α of each joint."""
    ends = [first, *yokes, last]
    total, out = 0.0, first
    for k, spring in enumerate(found.springs):
        total += 0.5 * spring * (out - ends[k + 1]) ** 2
        if k < len(yokes):
            psi, alpha = found.phase[k], found.joint_angle[k]
            theta = yokes[k] + psi
            out = driven(theta, alpha) - driven(psi, alpha)
    return total


def test_joints_rest_where_the_springs_hold_least():
    found = four_joints()
    drive = MasslessDrive(reduction=found)
    held = drive.balance(0.4, 0.32)
    free = minimize(energy, held.yokes, args=(0.4, 0.32, found), method="BFGS", options={"gtol": 1e-9})
    assert energy(held.yokes, 0.4, 0.32, found) <= free.fun * (1 + 1e-12)
    # The energy is flat at its least: angles are good to the root of its rounding.
    assert held.yokes == pytest.approx(free.x, abs=1e-6)


def test_torques_and_stiffness_are_derivatives_of_the_energy():
    found = four_joints()
    drive, h = MasslessDrive(reduction=found), 1e-4

    def total(first, last):
        return energy(drive.balance(first, last).yokes, first, last, found)

    held = drive.balance(0.4, 0.32)
    by_first = (total(0.4 + h, 0.32) - total(0.4 - h, 0.32)) / (2 * h)
    by_last = (total(0.4, 0.32 + h) - total(0.4, 0.32 - h)) / (2 * h)
    # Central differences leave h² of the next derivatives.
    assert held.torques[0] == pytest.approx(by_first, rel=1e-6)
    assert held.torques[-1] == pytest.approx(-by_last, rel=1e-6)
    ends = [drive.balance(0.4 + s * h, 0.32).torques for s in (1, -1)]
    lasts = [drive.balance(0.4, 0.32 + s * h).torques for s in (1, -1)]
    k11, k12, k22 = held.stiffness
    assert k11 == pytest.approx((ends[0][0] - ends[1][0]) / (2 * h), rel=1e-6)
    assert k12 == pytest.approx(-(ends[0][-1] - ends[1][-1]) / (2 * h), rel=1e-6)
    assert k22 == pytest.approx(-(lasts[0][-1] - lasts[1][-1]) / (2 * h), rel=1e-6)


@pytest.mark.parametrize(
    ("joint_angle", "torque", "half_trace"), [(0.3, 0.0, -1.0006807319800233), (0.3, 40.0, -1.000681182608514)]
)
def test_half_trace_is_that_of_the_reference(joint_angle, torque, half_trace):
    found = steady_twist(one_joint(joint_angle, 1.0), torque)
    # The reference integrates to about 1e-11.
    assert found.half_trace == pytest.approx(half_trace, abs=1e-10)


def test_the_motion_closes_and_keeps_its_volume():
    found = steady_twist(four_joints(), 80.0)
    assert found.gap < 1e-11
    assert found.residual < 1e-11
    values = np.linalg.eigvals(found.monodromy)
    near_one = np.sort(np.abs(values - 1.0))
    # A double multiplier is known to the root of the rounding only.
    assert np.all(near_one[:2] < 1e-4)
    elastic = values[np.argsort(np.abs(values - 1.0))[2:]]
    assert found.half_trace == pytest.approx(float(np.mean(elastic).real), abs=1e-9)


@pytest.mark.slow
def test_a_joint_before_a_rigid_shaft_is_a_spring_by_the_square_of_its_ratio():
    """Heavy, even input and a stiff driven shaft leave J x'' = c_1 (φ - S(x)) S'(x), tan S = cos α tan x."""
    alpha, a = 25 * deg, 1.3
    found = steady_twist(
        mathieu_reduction([alpha], [0.0], [1000.0, 1e9], first_inertia=1e7, last_inertia=0.4, speed=np.sqrt(2500 / a))
    )

    def rate(phi, y):
        x, speed = y
        s = driven(x + np.pi / 2, alpha) - np.pi / 2  # the inverse law is the law a quarter turn on
        slope = np.cos(alpha) / (1 - np.sin(alpha) ** 2 * np.sin(x) ** 2)
        return [speed, a * (phi - s) * slope]

    def half_turn(start):
        return solve_ivp(rate, (0, np.pi), start, method="DOP853", rtol=1e-12, atol=1e-13).y[:, -1]

    start, h = np.asarray([0.0, 1.0]), 1e-5
    for _round in range(8):
        change = np.asarray([(half_turn(start + h * e) - half_turn(start - h * e)) / (2 * h) for e in np.eye(2)]).T
        start = start - np.linalg.solve(change - np.eye(2), half_turn(start) - start - [np.pi, 0.0])
    # Input and shaft are stiff and heavy to 1e-6.
    assert found.half_trace == pytest.approx(0.5 * np.trace(change), abs=1e-5)


@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_the_zone_is_twice_as_wide_as_the_book_has_it(side):
    """Between q and 2q of the book from a = 1 the exact drive is unstable, beyond 2q stable."""
    q = one_joint(10 * deg, 1.0).q
    assert steady_twist(one_joint(10 * deg, 1.0 + 0.75 * side * q)).half_trace < -1.0
    assert steady_twist(one_joint(10 * deg, 1.0 + 1.25 * side * q)).half_trace > -1.0


@pytest.mark.parametrize("torque", [0.0, 60.0])
def test_at_the_middle_of_the_zone_mathieu_with_the_right_q_says_the_same(torque):
    """½ tr = -1 - (πq)²/8 there, an eighth of which the book's q would give too little by three quarters."""
    for joint_angle, psi in ((10 * deg, 0.0), (15 * deg, 0.9)):
        red = one_joint(joint_angle, 1.0, psi)
        over = -1.0 - steady_twist(red, torque).half_trace
        right, book = (-1.0 - float(exponents(1.0, q).half_trace) for q in (red.q, red.q_book))
        # Left out: the static twist and the next order of tan²(α/2).
        assert over == pytest.approx(right, rel=5e-3)
        assert over == pytest.approx(4 * book, rel=5e-3)


def test_a_joint_in_the_node_does_not_excite():
    red = mathieu_reduction(
        [15 * deg], [0.4], [1.0 / 0.3, 1.0 / 0.7], first_inertia=0.7, last_inertia=0.3, speed=np.sqrt(1.0 / 0.21)
    )
    over = -1.0 - steady_twist(red).half_trace
    assert abs(over) < 0.02 * (np.pi * np.tan(7.5 * deg) ** 2) ** 2 / 8  # were the joint elsewhere, κ of order one


@pytest.mark.slow
def test_a_motion_that_the_first_guess_misses_is_followed_up():
    """Beside order-2 resonance the twist swings by half a radian; the motion closes all the same."""
    found = steady_twist(four_joints(speed=0.51 * four_joints().natural_frequency))
    assert abs(found.start[1]) > 0.5
    assert found.gap < 1e-10
    assert found.residual < 1e-10


@pytest.mark.slow
def test_a_resonance_has_no_steady_motion(monkeypatch):
    monkeypatch.setattr(mathieu_drive, "LEAST_STEP", 1.0)
    with pytest.raises(InputError, match="no steady motion") as caught:
        steady_twist(four_joints(speed=0.5 * four_joints().natural_frequency))
    assert caught.value.field == "speed"


def test_too_much_torque_snaps_a_joint_through():
    with pytest.raises(InputError, match="snaps") as caught:
        MasslessDrive(reduction=one_joint(80 * deg, 1.0)).balance(2.0, -0.6)
    assert caught.value.field == "torque"
    with pytest.raises(InputError, match="not a finite number"):
        steady_twist(one_joint(0.3, 1.0), np.inf)
