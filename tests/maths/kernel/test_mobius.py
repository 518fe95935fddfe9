import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cardan.maths.arrays import unit_complex
from cardan.maths.kernel import mobius
from cardan.units import deg

JOINT_ANGLES = st.floats(0.0, 60 * deg)
ANGLES = st.floats(-10.0, 10.0)

# A pair of a 60° joint has entries below 1.1; three of them below 1.5. A product rounds each entry a few times.
ROUNDING = 2e-15


@st.composite
def pairs(draw):
    joint = mobius.hooke(np.asarray(draw(JOINT_ANGLES)))
    before, after = (mobius.turn(np.asarray(draw(ANGLES))) for _ in range(2))
    return mobius.compose(after, mobius.compose(joint, before))


def near(one, other, tolerance=ROUNDING):
    return all(abs(x - y) <= tolerance for x, y in zip(one, other, strict=True))


@given(pairs(), pairs(), pairs())
def test_maps_in_series_associate(f, g, h):
    assert near(mobius.compose(mobius.compose(f, g), h), mobius.compose(f, mobius.compose(g, h)), 1e-14)


@given(pairs())
def test_a_map_and_its_inverse_make_the_identity(f):
    for product in (mobius.compose(f, mobius.inverse(f)), mobius.compose(mobius.inverse(f), f)):
        assert near(product, (1.0, 0.0), 1e-14)


@given(pairs())
def test_the_identity_changes_nothing_at_all(f):
    one = mobius.compose(mobius.hooke(np.asarray(0.0)), mobius.turn(np.asarray(0.0)))
    assert mobius.compose(f, one) == f
    assert mobius.compose(one, f) == f


@given(pairs(), pairs())
def test_the_determinant_stays_one(f, g):
    a, b = mobius.compose(f, g)
    assert abs(a) ** 2 - abs(b) ** 2 == pytest.approx(1.0, abs=1e-14)


@given(pairs(), pairs(), ANGLES)
def test_composing_pairs_composes_maps(f, g, angle):
    w = unit_complex(np.asarray(angle))
    both = mobius.apply(mobius.compose(g, f), w)
    assert abs(both - mobius.apply(g, mobius.apply(f, w))) <= 1e-14
    assert abs(both) == pytest.approx(1.0, abs=1e-14)


@given(pairs(), pairs(), ANGLES)
def test_ratios_in_series_multiply(f, g, angle):
    w = unit_complex(np.asarray(angle))
    chained = mobius.ratio(g, mobius.apply(f, w)) * mobius.ratio(f, w)
    assert mobius.ratio(mobius.compose(g, f), w) == pytest.approx(chained, rel=1e-13)


@given(pairs(), ANGLES)
def test_the_course_is_lead_ratio_and_slope_and_each_derives_from_the_one_before(f, angle):
    h = 1e-3
    w = [unit_complex(np.asarray(2 * (angle + k * h))) for k in (-2, -1, 0, 1, 2)]
    angle_error, ratio, slope = mobius.course(f, w[2])
    assert angle_error == pytest.approx(mobius.angle_error(f, w[2]), abs=ROUNDING)
    assert ratio == pytest.approx(mobius.ratio(f, w[2]), rel=1e-14)
    assert slope == pytest.approx(mobius.ratio_slope(f, w[2]), rel=1e-13, abs=1e-14)

    def derivative(of):
        far, near, _, near_, far_ = (of(f, x) for x in w)
        return (8 * (near_ - near) - (far_ - far)) / (12 * h)

    # Fourth order: h⁴ f⁽⁵⁾/30 with f⁽⁵⁾ < 1e4 at 60°, and rounding over h.
    assert derivative(mobius.angle_error) == pytest.approx(ratio - 1, abs=1e-9)
    assert derivative(mobius.ratio) == pytest.approx(slope, abs=1e-8)


@given(JOINT_ANGLES, st.floats(-1.5, 1.5))
def test_a_hooke_joint_turns_as_its_tangents_say(joint_angle, theta):
    w = unit_complex(np.asarray(2 * theta))
    image = mobius.apply(mobius.hooke(np.asarray(joint_angle)), w)
    # Within a quarter turn the arctan of Book (18) has no jump.
    assert 0.5 * np.angle(image) == pytest.approx(np.arctan(np.tan(theta) / np.cos(joint_angle)), abs=1e-14)


@given(pairs(), ANGLES)
def test_the_lead_stays_bounded_and_turns_into_the_image(f, angle):
    w = unit_complex(np.asarray(2 * angle))
    angle_error = mobius.angle_error(f, w)
    assert abs(angle_error) <= np.arcsin(mobius.tau(f)) + 1e-15
    constant = f[0] / np.conj(f[0])
    assert abs(constant * w * unit_complex(2 * angle_error) - mobius.apply(f, w)) <= 1e-14


@given(pairs())
def test_quantities_of_the_equivalent_joint_agree(f):
    joint_angle, length = mobius.joint_angle(f), mobius.length(f)
    # cos α near 1 hides angles below √ε; compare where α is computed from, tan² of its half.
    assert np.exp(-length) == pytest.approx(np.cos(joint_angle), abs=1e-15)
    assert mobius.speed_fluctuation(f) == pytest.approx(2 * np.sinh(length), rel=1e-14)
    assert mobius.tau(f) == pytest.approx(np.tanh(length / 2), rel=1e-14, abs=1e-300)


@given(st.lists(JOINT_ANGLES, min_size=1, max_size=6), st.data())
def test_neighbouring_corners_of_the_polygon_are_a_joint_apart(joint_angles, data):
    turns = np.asarray([data.draw(ANGLES) for _ in joint_angles])
    corners = [0.0, *map(mobius.vertex, mobius.partial_products(np.asarray(joint_angles), turns))]
    for joint_angle, p, q in zip(joint_angles, corners[:-1], corners[1:], strict=True):
        # Pseudo-hyperbolic distance of two points of the disk; it loses digits when both lie near the rim.
        apart = abs(p - q) / abs(1 - np.conj(p) * q)
        assert apart == pytest.approx(np.tan(joint_angle / 2) ** 2, abs=1e-12)


@pytest.mark.parametrize("joint_angle", [1e-6, 0.5, 20.0, 60.0, 89.0, 89.9])
def test_a_joint_against_forty_digits(joint_angle):
    """At 89.9° the two parts of the kernel nearly cancel: |k| falls to cos α of |a|, and costs as many digits."""
    w = np.linspace(-3.0, 3.0, 61)
    got = mobius.ratio(mobius.hooke(np.asarray(joint_angle * deg)), unit_complex(2 * w))
    with mpmath.workdps(40):
        alpha = mpmath.mpf(joint_angle * deg)
        want = [mpmath.cos(alpha) / (1 - (mpmath.sin(alpha) * mpmath.cos(mpmath.mpf(x))) ** 2) for x in w]
    worst = max(abs(float(g / v) - 1.0) for g, v in zip(got, want, strict=True))
    assert worst < 2e-15 / np.cos(joint_angle * deg)


def test_small_irregularities_keep_their_digits():
    pair = mobius.hooke(np.asarray(1e-5))
    # δ = sin α tan α = α² (1 + α²/6 …): to 1e-11 the square itself.
    assert mobius.speed_fluctuation(pair) == pytest.approx(1e-10, rel=1e-10)
    assert mobius.joint_angle(pair) == pytest.approx(1e-5, rel=1e-14)
    assert mobius.length(pair) == pytest.approx(0.5e-10, rel=1e-10)
