from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive
from cardan.book.comparison import book_series
from cardan.book.mathieu_drive import mathieu_reduction
from cardan.errors import InputError
from cardan.maths.periodic.mathieu import exponents
from cardan.questions.motion.motion import initial_phases
from cardan.units import deg, rpm

JOINT_ANGLES = [11.5 * deg, 15.3 * deg, 15 * deg, 16.5 * deg]
PHASES = [0.0, 88.1 * deg, 20.1 * deg, 16.4 * deg]
SPRINGS = [3000.0, 9000.0, 7000.0, 8000.0, 2500.0]


def reduction(joint_angles=JOINT_ANGLES, phases=PHASES, springs=SPRINGS, first=2.0, last=0.6, speed=860 * rpm):
    return mathieu_reduction(joint_angles, phases, springs, first_inertia=first, last_inertia=last, speed=speed)


def test_phasors_are_the_sums_that_the_book_writes_out():
    """D, F, X, Y and tan 2δ_0 of Book (195), (196), term by term."""
    found = reduction()
    tau = np.tan(np.asarray(JOINT_ANGLES) / 2) ** 2
    bar, turned = [], 0.0
    for t, psi in zip(tau, PHASES, strict=True):
        bar.append(psi - turned)
        turned += t * np.sin(2 * psi)
    cos, sin = tau * np.cos(2 * np.asarray(bar)), tau * np.sin(2 * np.asarray(bar))
    a, b = cos.sum(), sin.sum()
    d = sum(2 / SPRINGS[i] * cos[i:].sum() for i in range(4))
    f = sum(2 / SPRINGS[i] * sin[i:].sum() for i in range(4))
    c, both = 1 / sum(1 / s for s in SPRINGS), 2.6
    x, y = both * c * d - 2 * a * 0.6, both * c * f - 2 * b * 0.6
    assert found.forcing == pytest.approx(a + 1j * b, rel=1e-13)
    assert found.play == pytest.approx(d + 1j * f, rel=1e-13)
    assert found.stiffness == pytest.approx(c, rel=1e-14)
    assert found.a == pytest.approx(c / (found.inertia * (860 * rpm) ** 2), rel=1e-14)
    assert found.q_book == pytest.approx(found.a / (2 * both) * np.hypot(x, y), rel=1e-12)
    assert found.wave_phase == pytest.approx(0.5 * np.arctan2(y, x), abs=1e-12)
    assert found.q == 2 * found.q_book
    assert found.lag == pytest.approx(turned, rel=1e-13)


def test_one_joint_gives_the_short_form():
    """Book (194): q = a c_11 (c/c_1 - J_0/J_1)."""
    found = reduction([20 * deg], [0.0], [1000.0, 4000.0], 1.0, 0.4)
    wanted = found.a * np.tan(10 * deg) ** 2 * (found.stiffness / 1000.0 - found.inertia / 1.0)
    assert found.q_book == pytest.approx(wanted, rel=1e-13)


def test_the_forcing_is_the_first_order_of_the_drives_motion():
    drive = Drive.from_angles(JOINT_ANGLES, yoke_angles=[0.3, 1.2, -0.4], start_phase=0.2)
    found = reduction(phases=initial_phases(drive))
    series = book_series(drive, amplitude="tau")
    assert found.forcing == pytest.approx(complex(series.a1, series.b1), rel=1e-12)
    assert found.amplitude == pytest.approx(float(series.amplitude), rel=1e-12)
    assert found.forcing_phase == pytest.approx(float(series.phase), rel=1e-12)
    assert found.lag == pytest.approx(float(series.constant), rel=1e-12)


def test_a_joint_in_the_node_gives_nothing_to_the_parametric_term():
    """The node parts the springs as the inertias part the twist: c/c_1 = J_2/(J_1 + J_2)."""
    found = reduction([25 * deg], [0.7], [1.0 / 0.3, 1.0 / 0.7], 0.7, 0.3)
    assert found.off_node == pytest.approx([0.0], abs=1e-15)
    assert found.q < 1e-15
    assert found.amplitude > 0.04


def test_a_shift_of_the_start_turns_the_phasors_with_it():
    later = reduction([20 * deg], [0.5], SPRINGS[:2])
    found = reduction([20 * deg], [0.0], SPRINGS[:2])
    assert later.wave == pytest.approx(found.wave * np.exp(1j), rel=1e-13)


@pytest.mark.parametrize("zone", [1, 2])
def test_between_the_speeds_of_a_zone_the_drive_is_unstable(zone):
    found = reduction([25 * deg], [0.3], [1000.0, 4000.0], 1.0, 0.4)
    low, high = found.zone_speeds(zone)
    assert low < found.natural_frequency / zone < high
    wide = high - low
    for speed, stable in ((low - 0.05 * wide, True), (0.5 * (low + high), False), (high + 0.05 * wide, True)):
        there = replace(found, speed=speed)
        assert bool(exponents(there.a, there.q).stable) == stable
    assert replace(found, speed=3.0).zone_speeds(zone) == pytest.approx((low, high), rel=1e-12)


def test_a_straight_drive_has_no_zone():
    found = reduction([0.0], [0.3], [1000.0, 4000.0], 1.0, 0.4)
    assert found.zone_speeds() == pytest.approx([found.natural_frequency] * 2)


def test_what_is_wrong_is_told_all_at_once():
    with pytest.raises(InputError) as caught:
        mathieu_reduction([0.1, 1.6], [0.0], [1.0, -1.0], first_inertia=0.0, last_inertia=np.nan, speed=-1.0)
    fields = ["phase", "springs", "joint_angle[1]", "springs[1]", "first_inertia", "last_inertia", "speed"]
    assert [problem.field for problem in caught.value.problems] == fields
