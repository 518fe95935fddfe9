"""How links of a mechanism move: against closed forms, plain vectors, and differences of what was found."""

from dataclasses import replace

import numpy as np
import pytest

from cardan import InputError
from cardan.maths.kernel import frames
from cardan.mechanism.turning import turned
from cardan.mechanisms import Mechanism, Pair, example_mechanism, mechanism_motion
from cardan.questions.mechanism.motion_answer import answer
from cardan.units import deg

TURN = np.radians(np.arange(0.0, 360.0, 5.0))
Z = (0, 0, 1)
NAMES = (
    "crank-slider",
    "hooke-cured",
    "maize-drive-cured",
    "pin-coupling-apart",
    "reuleaux",
    "slipper-joint",
    "three-joints-c",
    "weiss-straight",
)


def pair(name, kind, links, point, axis, **more):
    where = tuple(float(one) for one in point)
    return Pair(id=name, type=kind, links=links, point=where, axis=axis, **more)


def mechanism(*joints, **more):
    return Mechanism(frame="0", joints=joints, **more)


def link(found, name):
    return next(one for one in found.links if one.link == name)


def fourbar(a=0.05, b=0.14, c=0.12, d=0.15, start=60 * deg):
    """Return a four-bar linkage with crank a, rod b, rocker c and frame d, and the angle of its rocker as drawn."""
    tip = a * np.array([np.cos(start), np.sin(start)])
    to = np.array([d, 0.0]) - tip
    length = np.hypot(*to)
    bend = np.arccos((b**2 + length**2 - c**2) / (2 * b * length)) + np.arctan2(to[1], to[0])
    end = tip + b * np.array([np.cos(bend), np.sin(bend)])
    made = mechanism(
        pair("A", "R", ("0", "crank"), (0, 0, 0), Z),
        pair("B", "R", ("crank", "rod"), (*tip, 0), Z),
        pair("C", "R", ("rod", "rocker"), (*end, 0), Z),
        pair("D", "R", ("rocker", "0"), (d, 0, 0), Z),
        input_link="crank",
        output_link="rocker",
    )
    return made, float(np.arctan2(end[1], end[0] - d))


def test_slider_crank_is_that_of_the_text_books():
    found = mechanism_motion(example_mechanism("crank-slider"), TURN).output
    r, rod, a = 0.05, np.hypot(0.17, 0.04), TURN + np.arctan2(40, 30)
    across = np.sqrt(rod**2 - (r * np.sin(a)) ** 2)
    first = -r * np.sin(a) - r**2 * np.sin(a) * np.cos(a) / across
    second = -r * np.cos(a) - r**2 * np.cos(2 * a) / across - (r**2 * np.sin(a) * np.cos(a)) ** 2 / across**3
    assert found.way == "slides"
    np.testing.assert_allclose(found.path + 0.2, r * np.cos(a) + across, atol=1e-12)
    np.testing.assert_allclose(found.speed, first, atol=1e-12)
    np.testing.assert_allclose(found.curve, second, atol=1e-12)


def test_four_bar_linkage_meets_freudensteins_equation():
    a, b, c, d, start = 0.05, 0.14, 0.12, 0.15, 60 * deg
    made, drawn = fourbar(a, b, c, d, start)
    found = mechanism_motion(made, TURN).output
    phi, psi = TURN + start, drawn + found.angle
    k1, k2, k3 = d / c, d / a, (a**2 - b**2 + c**2 + d**2) / (2 * a * c)
    np.testing.assert_allclose(k3 + k2 * np.cos(psi) - k1 * np.cos(phi), np.cos(phi - psi), atol=1e-12)
    ratio = (np.sin(phi - psi) + k1 * np.sin(phi)) / (np.sin(phi - psi) + k2 * np.sin(psi))
    np.testing.assert_allclose(found.ratio, ratio, atol=1e-12)


def chained(axes, arms, theta):
    """Return how far the last shaft is turned, by plain vectors: arms (k, 2, 3) of each cross as drawn."""
    turned_by = theta
    for k, (own, other) in enumerate(arms):
        arm = frames.rotate(own, axes[k], turned_by)
        driven = frames.cross(arm, axes[k + 1])
        driven = driven / frames.norm(driven) * np.sign(frames.cross(own, axes[k + 1]) @ other)
        across = frames.cross(axes[k + 1], other)
        turned_by = np.arctan2(driven @ across, driven @ other)
    return turned_by


def test_the_maize_drive_turns_by_the_law_of_its_joints():
    made = example_mechanism("maize-drive")
    found = mechanism_motion(made, TURN).output
    named = {one.id: one for one in made.joints}
    shafts = ("input bearing", "telescope", "sleeve bearing", "output bearing")
    axes = [named[one].along for one in shafts]
    arms = [[named[f"cross {k}, {end}"].along for end in ("driving", "driven")] for k in (1, 2, 3)]
    lead = np.array([chained(axes, arms, one) for one in TURN])
    way = np.sign(found.axis @ axes[-1])
    np.testing.assert_allclose(np.exp(1j * way * found.angle), np.exp(1j * lead), atol=2e-10)  # digits of the file


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_speeds_and_accelerations_are_differences_of_where_links_stand(name):
    made = example_mechanism(name)
    step, at = 1e-3, np.array([0.4, 1.9, 3.3, 5.1])
    before, here, after = (turned(made, at + k * step) for k in (-1, 0, 1))
    for k in range(len(made.links)):
        if made.links[k] in here.loose:
            continue
        moved = (after.displacement[:, k] - before.displacement[:, k]) / (2 * step)
        found = moved @ np.linalg.inv(here.displacement[:, k])
        spin = np.stack((found[:, 2, 1], found[:, 0, 2], found[:, 1, 0]), axis=-1)
        np.testing.assert_allclose(here.rates.speed[:, k], np.c_[spin, found[:, :3, 3]], atol=2e-5)  # of order step²
        steep = (after.rates.speed[:, k] - before.rates.speed[:, k]) / (2 * step)
        np.testing.assert_allclose(here.rates.acceleration[:, k], steep, atol=2e-5)


def test_a_parallelogram_goes_through_its_change_points():
    found = mechanism_motion(example_mechanism("parallelogram"), TURN)
    assert [one.way for one in found.links] == ["turns", "shifts", "turns"]
    np.testing.assert_allclose(found.output.angle, TURN, atol=1e-9)


def test_rounding_next_to_a_change_point_is_told_as_none():
    """A tenth of a degree beside it what the pairs hold is a thousandth: both cranks turn alike for all that."""
    found = mechanism_motion(example_mechanism("parallelogram"))
    assert np.abs(found.output.angle - found.position).max() < 1e-12
    assert np.abs(found.output.ratio - 1.0).max() < 1e-9
    assert found.output.constant
    assert not np.any(found.output.slope)
    said = answer(found.mechanism, found)
    assert [one.value.value for one in said.keys if one.name == "speed_fluctuation"] == [0.0]


def test_an_uneven_ratio_stays_told_however_small():
    """A rod longer by a hundredth of a millimetre: the driven crank leads and lags by what plane geometry says."""
    made = example_mechanism("parallelogram")
    shift = 1e-5
    moved = {"driven crank pin": (0.186 + shift, 0.048, 0.0), "driven bearing": (0.150 + shift, 0.0, 0.0)}
    made = replace(made, joints=tuple(replace(one, point=moved.get(one.id, one.point)) for one in made.joints))
    longer = replace(made.joints[3], point=(0.150 + 2.0 * shift, 0.0, 0.0))
    made = replace(made, joints=(*made.joints[:3], longer), input_range=(-0.7, 1.0))
    found = mechanism_motion(made).output
    assert not found.constant
    theta = np.linspace(-0.7, 1.0, 401)
    driven = mechanism_motion(made, theta).output
    pin = 0.06 * np.stack((np.cos(theta + np.arctan2(48, 36)), np.sin(theta + np.arctan2(48, 36))), axis=-1)
    crank = np.hypot(0.036 - shift, 0.048)
    start = np.arctan2(0.048, 0.036 - shift) + driven.angle
    other = np.array([0.150 + 2.0 * shift, 0.0]) + crank * np.stack((np.cos(start), np.sin(start)), axis=-1)
    np.testing.assert_allclose(np.hypot(*(other - pin).T), 0.150 + shift, atol=1e-14)
    np.testing.assert_allclose(np.gradient(driven.angle, theta)[3:-3], driven.ratio[3:-3], atol=1e-6)


def test_speeds_are_not_told_in_a_change_point():
    made = example_mechanism("parallelogram")
    change = np.pi - np.arctan2(48, 36)
    found = mechanism_motion(made, np.array([0.0, change]))
    assert np.isnan(found.output.ratio).tolist() == [False, True]


@pytest.mark.parametrize(
    ("name", "pitch"), [("first follower", 0.03 / np.tan(55 * deg)), ("second follower", -0.03 / np.tan(60 * deg))]
)
def test_a_slot_cam_shifts_by_the_slope_of_its_slots(name, pitch):
    found = link(mechanism_motion(example_mechanism("slot-cam")), name)
    assert found.way == "slides"
    np.testing.assert_allclose(found.path, pitch * np.radians(np.linspace(-90, 90, 181)), atol=1e-11)


@pytest.mark.slow
def test_a_screw_goes_on_over_many_turns():
    made = replace(example_mechanism("slot-cam"), input_range=(0.0, 20.0))
    found = mechanism_motion(made, np.array([0.0, 7.0, 20.0])).output
    np.testing.assert_allclose(found.path, 0.03 / np.tan(55 * deg) * np.array([0.0, 7.0, 20.0]), atol=1e-10)


def test_cones_roll_by_the_sines_of_their_half_angles():
    made = replace(example_mechanism("friction-cones"), input_range=(0.0, 0.3))
    found = mechanism_motion(made).output
    np.testing.assert_allclose(found.ratio, -0.75, atol=1e-13)  # sin δ1/sin δ2 = 60/80, Litvin (7.3)
    np.testing.assert_allclose(found.angle[-1], -0.225, atol=1e-13)


def test_a_disc_integrator_turns_by_the_integral():
    made = replace(example_mechanism("disc-integrator"), input_range=(0.0, 0.6))
    found = mechanism_motion(made).output
    angle = np.linspace(0, 0.6, len(found.angle))
    want = (0.01 * angle + 0.5 * 0.012 / (2 * np.pi) * angle**2) / 0.02  # Litvin (7.4)
    np.testing.assert_allclose(found.angle, want, atol=1e-13)
    np.testing.assert_allclose(found.slope, 0.012 / (2 * np.pi) / 0.02, atol=1e-12)


@pytest.mark.slow
def test_a_disc_integrator_adds_up_what_is_no_polynomial():
    """A crank instead of the screw: ρ runs as a slider-crank does; its integral by Gauss's rule."""
    r, rod, radius = 0.01, 0.04, 0.02
    made = mechanism(
        pair("disc", "R", ("0", "disc"), (0, 0, 0), Z),
        pair("pin", "R", ("disc", "rod"), (r, 0, 0), Z),
        pair("head", "R", ("rod", "carriage"), (r + rod, 0, 0), Z),
        pair("guide", "P", ("0", "carriage"), (r + rod, 0, 0), (1, 0, 0)),
        pair("roller", "R", ("carriage", "roller"), (r + rod, 0, radius), (1, 0, 0)),
        pair("rolls", "RO", ("disc", "roller"), (r + rod, 0, 0), (0, 1, 0), carrier="carriage"),
        input_link="disc",
        output_link="roller",
    )
    found = mechanism_motion(replace(made, input_range=(0.0, 1.2)), np.array([0.0, 0.5, 1.2])).output
    nodes, weights = np.polynomial.legendre.leggauss(20)
    for end, told in zip((0.5, 1.2), found.angle[1:], strict=True):
        phi = 0.5 * end * (nodes + 1.0)
        rho = r * np.cos(phi) + np.sqrt(rod**2 - (r * np.sin(phi)) ** 2)
        assert told == pytest.approx(0.5 * end * float(weights @ rho) / radius, rel=1e-8)  # steps of 2°


# What is refused, in one message.


def message(made):
    with pytest.raises(InputError) as caught:
        mechanism_motion(made)
    (problem,) = caught.value.problems
    return problem


def test_a_link_that_cannot_follow_is_named_with_angle_and_amount():
    made, _drawn = fourbar(
        a=0.1, b=0.08, c=0.09, d=0.15, start=30 * deg
    )  # the crank reaches farther than rod and rocker
    said = message(made)
    assert said.field == "input_link"
    assert "cannot follow: with 'crank' turned by" in said.message
    assert "its pairs lack" in said.message


def test_a_link_that_swings_is_told_over_its_range():
    made, _drawn = fourbar(a=0.14, b=0.12, c=0.05, d=0.15, start=55 * deg)
    assert "input_range_deg" in message(made).message
    found = mechanism_motion(replace(made, input_range=(-0.05, 0.05)))
    assert np.all(np.isfinite(found.output.ratio))


def test_more_than_one_input_is_refused():
    made, _drawn = fourbar()
    joints = (
        *made.joints[:3],
        pair("D", "R", ("rocker", "more"), (0.15, 0, 0), Z),
        pair("E", "R", ("more", "0"), (0.2, 0, 0), Z),
    )
    said = message(replace(made, joints=joints))
    assert "'rocker' is not held: with 'crank' at rest at" in said.message
    assert "motion left; a mechanism has one input" in said.message


def test_rods_that_spin_are_no_second_input():
    found = mechanism_motion(example_mechanism("weiss-straight"), TURN)
    assert found.turned.loose == ("ball 1", "ball 2")
    np.testing.assert_allclose(found.output.ratio, found.output.ratio[0], atol=1e-12)


@pytest.mark.parametrize(
    ("changes", "field", "words"),
    [
        ({"input_link": ""}, "input_link", "missing"),
        ({"input_link": "rod"}, "input_link", "needs a pair of type R or P with the frame"),
        ({"input_range": (1.0, 0.0)}, "input_range", "must lie below the second"),
    ],
)
def test_what_no_input_can_be_is_refused(changes, field, words):
    made, _drawn = fourbar()
    with pytest.raises(InputError) as caught:
        mechanism_motion(replace(made, **changes))
    (problem,) = caught.value.problems
    assert problem.field == field
    assert words in problem.message


def test_keys_of_a_rolling_contact_belong_to_it_alone():
    with pytest.raises(InputError, match="only a rolling contact"):
        mechanism(Pair(id="A", type="R", links=("0", "1"), point=(0, 0, 0), axis=Z, carrier="1"))
