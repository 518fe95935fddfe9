import numpy as np
import pytest

from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.drive.duty import Limits
from cardan.drive.shaft import Spline
from cardan.errors import InputError
from cardan.questions.motion.length import length_compensation


def sway(t):
    """A length with several turning points a period, and its derivatives."""
    x = 1.2 + 0.02 * np.sin(3.0 * t) + 0.015 * np.cos(7.0 * t + 0.4)
    v = 0.06 * np.cos(3.0 * t) - 0.105 * np.sin(7.0 * t + 0.4)
    a = -0.18 * np.sin(3.0 * t) - 0.735 * np.cos(7.0 * t + 0.4)
    return x, v, a


def test_coarse_series_gives_what_fine_sampling_gives():
    coarse = np.linspace(0.0, 2.0 * np.pi, 121)
    found = length_compensation(coarse, *sway(coarse))
    fine = np.linspace(0.0, 2.0 * np.pi, 400_001)
    x, v, _a = sway(fine)
    # The quintic errs by h^6 x^(6)/46080 ~ 8e-10 m an extreme; the fine trapezoids by about 1e-9 m.
    assert found.length_min == pytest.approx(x.min(), abs=3e-9)
    assert found.length_max == pytest.approx(x.max(), abs=3e-9)
    assert found.slip_path == pytest.approx(np.trapezoid(np.abs(v), fine), abs=3e-8)
    assert found.time_max == pytest.approx(fine[x.argmax()], abs=2e-5)
    # The time of the largest speed is interpolated linearly: second order in h times second order in the error.
    assert found.max_rate == pytest.approx(np.abs(v).max(), rel=1e-5)


def test_slip_path_of_a_monotone_slide_is_its_stroke():
    t = np.linspace(0.0, 1.0, 11)
    found = length_compensation(t, 1.0 + 0.1 * t**2, 0.2 * t, 0.2 + 0.0 * t)
    assert found.slip_path == pytest.approx(0.1, abs=1e-15)
    assert found.stroke == pytest.approx(found.slip_path, abs=1e-15)
    assert found.max_acceleration == pytest.approx(0.2)


def test_engaged_length_below_the_stated_overlap_is_flagged_with_time_and_span():
    t = np.linspace(0.0, 2.0 * np.pi, 61)
    x, v, a = 1.0 + 0.03 * np.sin(t), 0.03 * np.cos(t), -0.03 * np.sin(t)
    found = length_compensation(t, x, v, a, spline=Spline(engaged=0.08, gap=0.04), limits=Limits(spline_overlap=0.065))
    assert found.engaged_min == pytest.approx(0.05, abs=1e-9)
    assert found.gap_min == pytest.approx(0.01, abs=1e-9)
    (flag,) = found.flags
    assert flag.field == "shafts[1].spline.engaged"
    assert flag.time == pytest.approx(np.pi / 2.0, abs=1e-6)
    ((start, end),) = flag.spans
    # 0.08 - 0.03 sin t < 0.065 from 30 to 150 degrees; the quintic is good to about 1e-9.
    assert (start, end) == pytest.approx((np.pi / 6.0, 5.0 * np.pi / 6.0), abs=1e-7)
    assert "50.0 mm" in told(flag.message, USUAL)
    assert "65 mm" in told(flag.message, USUAL)


def test_spline_that_comes_apart_and_bottoms():
    t = np.linspace(0.0, 2.0 * np.pi, 61)
    x, v, a = 1.0 + 0.03 * np.sin(t), 0.03 * np.cos(t), -0.03 * np.sin(t)
    found = length_compensation(t, x, v, a, spline=Spline(engaged=0.02, gap=0.03), shaft=3)
    apart, bottom = found.flags
    assert apart.field == "shafts[2].spline.engaged"
    assert apart.value == pytest.approx(-0.01, abs=1e-9)
    assert bottom.field == "shafts[2].spline.gap"
    assert bottom.time == pytest.approx(1.5 * np.pi, abs=1e-6)
    assert bottom.value == pytest.approx(0.0, abs=1e-9)


def test_gap_and_overlap_that_suffice_are_not_flagged():
    t = np.linspace(0.0, 2.0 * np.pi, 61)
    x, v, a = 1.0 + 0.03 * np.sin(t), 0.03 * np.cos(t), -0.03 * np.sin(t)
    assert not length_compensation(t, x, v, a, spline=Spline(engaged=0.0301, gap=0.0301)).flags


def test_drawn_length_is_the_base_of_engagement():
    found = length_compensation([0.0], [1.1], [0.0], [0.0], spline=Spline(engaged=0.08, gap=0.05), drawn=1.0)
    assert found.engaged_min == pytest.approx(-0.02)
    assert found.gap_min == pytest.approx(0.15)
    assert found.flags[0].spans == ((0.0, 0.0),)


def test_resting_shaft_does_not_slide():
    t = np.linspace(0.0, 1.0, 5)
    still = length_compensation(t, 0.0 * t + 1.0, 0.0 * t, 0.0 * t)
    assert not still.slides
    assert still.slip_path == 0.0


def test_refuses_times_that_do_not_rise_and_arrays_of_other_lengths():
    with pytest.raises(InputError, match="rise"):
        length_compensation([0.0, 0.0], [1.0, 1.0], [0.0, 0.0], [0.0, 0.0])
    with pytest.raises(InputError, match="2 needed"):
        length_compensation([0.0, 1.0], [1.0], [0.0, 0.0], [0.0, 0.0])
