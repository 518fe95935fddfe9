import numpy as np
import pytest
from scipy.integrate import solve_ivp

from cardan.book.dynamic_book import engineering_torque, torque_course
from cardan.book.mathieu_drive import mathieu_reduction, steady_twist
from cardan.errors import InputError
from cardan.units import deg

MACHINE = {"stiffness": 900.0, "first_inertia": 2.0, "last_inertia": 0.64, "mean": -150.0}


def two_masses(force, swing, order, speed):
    """Return the amplitude of the spring's torque of two inertias under torques and a swing forced between them."""
    w2 = (order * speed) ** 2
    c, one, two = MACHINE["stiffness"], MACHINE["first_inertia"], MACHINE["last_inertia"]
    matrix = np.asarray([[c - one * w2, -c], [-c, c - two * w2]])
    first, last = np.linalg.solve(matrix, np.asarray(force) + c * swing * np.asarray([-1.0, 1.0]))
    return abs(c * (first + swing - last))


@pytest.mark.parametrize("a", [0.774, 2.5, 6.3])
def test_amplitudes_are_those_of_two_masses_and_a_spring(a):
    harmonics = {"drive_order": [0.5, 6.8], "drive_torque": [30.0, -72.0], "load_order": [1.0], "load_torque": [9.0]}
    found = engineering_torque(**MACHINE, **harmonics, amplitude=0.05, a=a)
    assert found.mean == 150.0
    assert found.speed == pytest.approx(np.sqrt(900.0 / (2.0 * 0.64 / 2.64) / a), rel=1e-14)
    assert found.order2 == pytest.approx(two_masses([0.0, 0.0], 0.05, 2.0, found.speed), rel=1e-12)
    wanted = [two_masses([m, 0.0], 0.0, k, found.speed) for k, m in ((0.5, 30.0), (6.8, 72.0))]
    assert found.drive == pytest.approx(wanted, rel=1e-12)
    assert found.load == pytest.approx([two_masses([0.0, 9.0], 0.0, 1.0, found.speed)], rel=1e-12)


def test_resonances_and_wrong_values_are_named():
    with pytest.raises(InputError) as caught:
        engineering_torque(**MACHINE, amplitude=0.05, a=4.0, load_order=[1.0, 2.0], load_torque=[1.0, 1.0])
    assert [problem.field for problem in caught.value.problems] == ["a", "load_order[1]"]
    with pytest.raises(InputError) as caught:
        engineering_torque(**MACHINE | {"stiffness": 0.0, "last_inertia": -1.0}, amplitude=0.05, a=0.0)
    assert [problem.field for problem in caught.value.problems] == ["a", "stiffness", "last_inertia"]
    assert engineering_torque(**MACHINE, amplitude=0.0, a=4.0).order2 == 0.0


def exact_torque(red, mean, places):
    """Return the torque in the last spring of the exact drive, and by how much the inertias' centre is ahead of Ωt."""
    found = steady_twist(red, mean)
    drive = found.drive

    def rate(_phi, y):
        held = drive.balance(y[0], y[1])
        square = red.speed**2
        one = (mean - held.torques[0]) / (red.first_inertia * square)
        return [y[2], y[3], one, (held.torques[-1] - mean) / (red.last_inertia * square)]

    ends = solve_ivp(rate, (0, np.pi), found.start, method="DOP853", rtol=1e-10, atol=1e-12, t_eval=places).y[:2]
    centre = (red.first_inertia * ends[0] + red.last_inertia * (ends[1] + red.lag)) / (
        red.first_inertia + red.last_inertia
    )
    return np.asarray([drive.balance(*pair).torques[-1] for pair in ends.T]), float(np.mean(centre - places))


@pytest.mark.parametrize(("a", "mean"), [(1.6, 40.0), (6.3, 40.0), (0.6, 100.0)])
def test_the_solved_torque_comes_nearest_to_the_exact_drive(a, mean):
    red = mathieu_reduction(
        [10 * deg], [1.0], [1000.0, 4000.0], first_inertia=1.0, last_inertia=0.4, speed=np.sqrt(2800 / a)
    )
    places = np.linspace(0.0, np.pi, 40, endpoint=False)
    exact, ahead = exact_torque(red, mean, places)
    course = torque_course(red, places + ahead, mean)
    simple, book, solved = (np.max(np.abs(row - exact)) for row in (course.simple, course.book, course.solved))
    assert solved < 0.3 * book
    assert solved < 0.15 * simple
    assert np.mean(exact) == pytest.approx(mean, rel=1e-9)
    assert course.worst == pytest.approx(simple / np.max(exact), rel=0.2)
    assert course.too_far == (course.worst > 0.05)


def test_simple_torque_is_the_sum_of_mean_and_second_order():
    red = mathieu_reduction(
        [10 * deg, 14 * deg], [0.3, 1.0], [1e3, 2e3, 4e3], first_inertia=1.0, last_inertia=0.4, speed=40.0
    )
    course = torque_course(red, np.linspace(0.0, np.pi, 64, endpoint=False), 30.0)
    found = engineering_torque(
        stiffness=red.stiffness, amplitude=red.amplitude, a=red.a, first_inertia=1.0, last_inertia=0.4, mean=30.0
    )
    orders = np.fft.rfft(course.simple) / 64
    assert orders[0].real == pytest.approx(30.0, rel=1e-13)
    assert 2 * abs(orders[1]) == pytest.approx(found.order2, rel=1e-12)
    assert found.speed == pytest.approx(40.0, rel=1e-13)
