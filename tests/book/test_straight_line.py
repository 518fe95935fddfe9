"""Straight lines: Holzer's table in many digits, closed forms of two and three inertias, energy."""

import mpmath
import numpy as np
import pytest

from cardan import InputError
from cardan.book.straight_line import line_modes, line_response
from cardan.maths.compiled.method import Compiled

LINE = [1.5, 0.02, 0.05, 0.02, 0.8]
SPRINGS = [8000.0, 9000.0, 9000.0, 4000.0]


@mpmath.workdps(40)
def residual_torque(inertia, stiffness, omega):
    """Return the torque left over at the end of Holzer's table."""
    angle, torque, square = mpmath.mpf(1), mpmath.mpf(0), mpmath.mpf(omega) ** 2
    for j, c in zip(inertia, [*stiffness, None], strict=True):
        torque += square * j * angle
        if c is not None:
            angle -= torque / c
    return torque


def test_frequencies_are_the_roots_of_holzers_residual():
    found = line_modes(LINE, SPRINGS)
    assert found.omega[0] == 0.0
    assert found.residual < 1e-13
    for omega in found.omega[1:]:
        with mpmath.workdps(40):
            root = mpmath.findroot(lambda w: residual_torque(LINE, SPRINGS, w), mpmath.mpf(float(omega)))
        assert omega == pytest.approx(float(root), rel=1e-13)


def test_two_inertias_in_closed_form():
    found = line_modes([2.0, 0.6], [900.0])
    omega = np.sqrt(900.0 * (1 / 2.0 + 1 / 0.6))
    assert found.omega[1] == pytest.approx(omega, rel=1e-15)
    assert found.order2_speed[1] == pytest.approx(omega / 2, rel=1e-15)
    assert found.parametric_speed[1] == pytest.approx(omega, rel=1e-15)
    np.testing.assert_allclose(found.shape[1], [-0.3, 1.0], rtol=1e-14)
    # Of unit angle at the second station: 0.6 + 2.0·0.3².
    assert found.modal_inertia[1, 1] == pytest.approx(0.78, rel=1e-14)
    assert found.modal_inertia[0].tolist() == pytest.approx([2.6, 2.6])


def test_modal_inertia_is_infinite_at_a_node():
    found = line_modes([1.0, 0.5, 1.0], [100.0, 100.0])
    assert found.modal_inertia[1, 1] > 1e28
    assert found.modal_inertia[1, 0] == pytest.approx(2.0)


def test_a_line_held_at_one_end():
    """With a stiff spring to the ground at one end the slow frequency is that of the clamped line, to c over it."""
    found = line_modes([1.0, 0.5], [300.0], ground=[1e8, 0.0])
    assert found.omega[0] == pytest.approx(np.sqrt(300.0 / 0.5), rel=3e-6)
    # In the fast mode the spring's torque less that of the inertia is a difference of numbers of 1e8.
    assert found.residual < 1e-9


def test_a_line_of_one_station_only_turns():
    found = line_modes([2.0], [])
    assert found.omega.tolist() == [0.0]
    assert found.shape.tolist() == [[1.0]]


def test_lines_in_batches_are_those_by_themselves():
    many = line_modes([LINE, LINE[::-1]], [SPRINGS, SPRINGS[::-1]])
    np.testing.assert_allclose(many.omega[0], many.omega[1], rtol=1e-13, atol=1e-12)
    assert many.residual.shape == (2,)
    omega = np.linspace(10.0, 900.0, 20)
    both = line_response([LINE] * 2, SPRINGS, omega, np.eye(5)[[0, 4]], damping=0.3)
    one = line_response(LINE, SPRINGS, omega, np.eye(5)[4], damping=0.3)
    np.testing.assert_allclose(both.angle[1], one.angle, rtol=1e-13)
    # A torque here moves the station there as one there moves the station here.
    np.testing.assert_allclose(both.angle[0, 4], both.angle[1, 0], rtol=1e-10)


def test_power_put_in_is_lost_in_the_dampers():
    omega = np.linspace(1.0, 1200.0, 400)
    for method in (None, Compiled()):
        found = line_response(
            LINE,
            SPRINGS,
            omega,
            [1.0, 0.0, 2j, 0.0, -1.0],
            damping=[0.1, 0.0, 0.2, 0.3],
            loss_factor=[0.0, 0.02, 0.01, 0.0],
            ground=[0.0, 0.0, 100.0, 0.0, 0.0],
            ground_damping=0.01,
            method=method,
        )
        assert found.residual.max() < 1e-12
        assert not found.resonant.any()


def test_loss_and_viscous_damping_are_the_same_at_one_frequency():
    one = line_response(LINE, SPRINGS, [70.0], np.eye(5)[0], loss_factor=0.05)
    other = line_response(LINE, SPRINGS, [70.0], np.eye(5)[0], damping=0.05 * np.asarray(SPRINGS) / 70.0)
    np.testing.assert_allclose(one.angle, other.angle, rtol=1e-12)


def test_the_torque_grows_to_the_loss_at_resonance():
    """Two inertias driven at their frequency: the spring's torque is what both inertias share, over η."""
    j1, j2, c, eta = 2.0, 0.6, 900.0, 0.04
    omega = line_modes([j1, j2], [c]).omega[1]
    found = line_response([j1, j2], [c], [omega], [1.0, 0.0], loss_factor=eta)
    # t/M = (J2/(J1+J2)) (1+iη)/(iη) at ω² = c(J1+J2)/(J1 J2).
    assert found.torque[0, 0] == pytest.approx(j2 / (j1 + j2) * (1 + 1j * eta) / (1j * eta), rel=1e-10)


def test_without_damping_a_natural_frequency_has_no_answer():
    found = line_response([1.0, 1.0], [50.0], [0.0, 9.0, 10.0], [1.0, 0.0])
    assert found.resonant.tolist() == [True, False, True]
    assert np.isnan(found.residual[[0, 2]]).all()


@pytest.mark.parametrize(
    ("ask", "named"),
    [
        (lambda: line_modes([1.0, -1.0], [0.0]), ["inertia", "stiffness"]),
        (lambda: line_modes([0.0, 0.0], [1.0]), ["inertia"]),
        (lambda: line_modes([], []), ["inertia"]),
        (lambda: line_modes([1.0, 1.0], [1.0, 1.0]), ["stiffness"]),
        (lambda: line_modes([1.0, 1.0], [1.0], ground=[1.0, 2.0, 3.0]), ["ground"]),
        (lambda: line_modes([1.0, np.inf], [1.0], ground=-1.0), ["inertia", "ground"]),
        (
            lambda: line_response([1.0, 1.0], [1.0], [-1.0], [1.0], damping=[-1.0], loss_factor=[0.1, 0.1]),
            ["damping", "loss_factor", "torque", "omega"],
        ),
        (lambda: line_response([1.0, 1.0], [1.0], 3.0, [np.nan, 0.0]), ["torque", "omega"]),
    ],
)
def test_what_makes_no_line_is_named_all_at_once(ask, named):
    with pytest.raises(InputError) as caught:
        ask()
    assert [problem.field for problem in caught.value.problems] == named
