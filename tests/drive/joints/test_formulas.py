"""What formulas of joints give, by examples."""

import math

import pytest

from cardan.drive.joints import double_cardan, half_cardan, offset_cross, pin_coupling, rzeppa, tracta, tripod, weiss
from cardan.drive.joints.common import laws
from cardan.units import deg, mm


def test_laws_ball_demands():
    found = laws.ball_demands(20 * deg, 30 * deg, 0.2 * deg)
    assert f"{found.mean:.6e} {found.spread:.6e} {found.largest:.6e}" == "-2.362077e-10 1.521747e-03 9.209634e-04"


def test_laws_tau():
    assert f"{laws.tau(40 * deg, 0.5 * deg):.8f}" == "-0.00317632"


def test_double_cardan_unevenness():
    assert f"{double_cardan.unevenness(15 * deg, 14 * deg):.9f}" == "0.009027732"


def test_double_cardan_even_share():
    assert f"{double_cardan.even_share(math.pi / 6):.6f}" == "0.517638"


def test_double_cardan_split():
    first, second = double_cardan.split(30 * deg, 0.5)
    assert f"{first:.8f} {second:.8f}" == "0.27091852 0.25268026"


def test_double_cardan_lag_book():
    assert double_cardan.lag_book([10 * deg, 50 * deg], 0.5) / deg == pytest.approx(
        [-0.01907468, -2.48053593], rel=1e-6
    )


def test_double_cardan_lag():
    assert double_cardan.lag([10 * deg, 50 * deg], 0.5) / deg == pytest.approx([-0.01907468, -2.47898788], rel=1e-6)


def test_half_cardan_play():
    assert f"{half_cardan.play(math.radians(5.0), 2):.6f}" == "0.003813"


def test_half_cardan_deviation():
    assert f"{half_cardan.deviation(math.pi / 8, math.radians(10.0), 2):.2e}" == "2.93e-05"


def test_offset_cross_shaking_force():
    assert f"{offset_cross.shaking_force(0.4, 0.02, 1.5, 100.0):.1f}" == "233.7"


def test_offset_cross_tilt():
    assert f"{offset_cross.tilt(0.0, math.radians(25), 0.02, 0.5):.9f}" == "0.017538820"


def test_pin_coupling_pin_contact():
    found = pin_coupling.pin_contact(100 * deg, 30 * deg, 0.05, 0.052, 40 * deg, 42 * deg)
    assert f"{found.deviation:.9f} {found.ratio:.9f} {found.first:.9f}" == "0.030906552 0.982785566 0.071884882"


def test_rzeppa_even_length():
    assert str(rzeppa.even_length([0.0, 5 * deg, 35 * deg], 0.35)) == "[0.72692308 0.72464236 0.63764452]"


def test_rzeppa_plane_error():
    assert str(rzeppa.plane_error([5 * deg, 35 * deg], 0.35, 0.72) / deg) == "[-0.00525327  0.83640544]"


def test_tracta_speed_fluctuation():
    assert f"{tracta.speed_fluctuation(30 * deg, 0.020, 0.021):.8f}" == "0.00700458"


def test_tripod_orbit_radius():
    assert f"{tripod.orbit_radius(20 * deg, 20 * mm) / mm:.8f}" == "0.64177772"


def test_weiss_deviation():
    assert (
        str(weiss.deviation(50 * deg, 30 * deg, 3.0 * mm, [3.0 * mm, 3.3 * mm], 30.0 * mm) + 0.0)
        == "[ 0.         -0.00131156]"
    )


def test_weiss_plane_tilt():
    assert str(weiss.plane_tilt(30 * deg, 3.0e-3, [3.0e-3, 3.3e-3]) / deg) == "[0.         0.73102499]"
