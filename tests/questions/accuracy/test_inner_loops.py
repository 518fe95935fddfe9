"""Sizes of Rzeppa and Weiss joints that are off: their law against the pairs of their balls, cage and lever."""

from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive
from cardan.joints import Rzeppa, Weiss
from cardan.mechanism.closing import CLOSED, Linkage
from cardan.mechanism.mechanism import Pair
from cardan.questions.accuracy.accuracy import one_turn, transmission_error
from cardan.questions.accuracy.own_laws import WEIGHTS, influence, seats, table_of
from cardan.questions.motion.joint_mechanism import joint_carried
from cardan.units import deg, mm

BEND = 22 * deg
PLACE = {"joint_angle": BEND, "plane_twist": 0.0}
LEVERED = Rzeppa(lever_b=0.35, lever_c=0.7, balls=3, **PLACE)
GROOVED = [
    Rzeppa(driving_offset=3 * mm, driven_offset=3.2 * mm, groove_radius=30 * mm, balls=3, **PLACE),
    Weiss(driving_offset=12 * mm, driven_offset=12.5 * mm, groove_radius=40 * mm, **PLACE),
    Weiss(driving_offset=12 * mm, driven_offset=12.5 * mm, groove_radius=40 * mm, balls=1, **PLACE),
]


@pytest.mark.slow
@pytest.mark.parametrize("joint", GROOVED, ids=["rzeppa", "weiss", "one ball"])
def test_balls_between_grooves_that_are_off_turn_as_the_error_says(joint):
    """Each ball by itself, by the screws of its pairs, which know no law; a joint turns as its balls in the mean."""
    phi = one_turn(256)

    def ratio(one):
        places = np.arange(joint.balls) * (2.0 * np.pi / joint.balls)
        sizes = {key: size for key, size in one.sizes().items() if size is not None}
        alone = Weiss(balls=1, **sizes, **PLACE)  # both its shafts in bearings, as one ball does not hold them
        return np.mean([joint_carried(alone, BEND, phi + turn).ratio for turn in places], axis=0)

    for key, size in joint.sizes().items():
        if size is None:
            continue
        error = transmission_error(
            Drive(joints=(joint,)), phi, errors=[table_of(joint, "error")(**{key: 0.005 * size})]
        ).error
        wave = np.fft.rfft(error)
        slope = np.fft.irfft(1j * np.arange(wave.size) * wave, phi.size)
        assert np.max(np.abs(ratio(joint.sized({key: 1.005 * size})) - ratio(joint) - slope)) < 1e-9
        assert np.max(np.abs(slope)) > 1e-8


def row(vector):
    return tuple(float(x) for x in vector)


def levered(joint, theta, errors):
    """Return by how much the driven shaft turns on where the pairs of a ball, cage and lever with errors close [rad].

    A slides on the driving axis, B stands at c on the driven one, C between them on the axis of the cage: AC = a = 1.
    """
    e, f = np.eye(3)[0], np.asarray([np.cos(BEND), np.sin(BEND), 0.0])
    b, c = joint.lever_b, joint.lever_c
    end = c * f
    start = end + np.asarray([np.sqrt((1.0 + b) ** 2 - end[1] ** 2), -end[1], 0.0])
    middle = start + (end - start) / (1.0 + b)
    normal = middle / np.linalg.norm(middle)
    lead = float(joint.deviation(np.asarray([theta]), np.asarray(BEND))[0][0])
    marks = [
        np.cos(turn) * across + np.sin(turn) * np.eye(3)[2]
        for across, turn in ((np.eye(3)[1], theta), (np.cross(np.eye(3)[2], f), theta + lead))
    ]
    planes = [np.cross(axis, mark) for axis, mark in zip((e, f), marks, strict=True)]
    ball = np.cross(planes[0], normal)
    ball *= np.sign(ball @ marks[0]) / np.linalg.norm(ball)
    along = (end - start) / (1.0 + b)
    still = np.zeros(3)
    # the point of a pair goes with its second link: c is a size of the driven shaft, b one of the lever
    bearing, way = ("driven", "lever"), errors.get("lever_b", 0.0) * along
    if "lever_c" in errors:
        bearing, way = ("lever", "driven"), errors["lever_c"] * f
    pairs = [
        ("R", ("frame", "driving"), np.zeros(3), e, still),
        ("R", ("frame", "driven"), np.zeros(3), f, still),
        ("S", ("driving", "cage"), np.zeros(3), e, still),
        ("SG", ("driving", "lever"), start, e, still),
        ("S", bearing, end, e, way),
        ("SG", ("cage", "lever"), middle, normal, still),
        ("PT", ("driving", "ball"), ball, planes[0], still),
        ("PT", ("driven", "ball"), ball, planes[1], still),
        ("PT", ("cage", "ball"), ball, normal, still),
    ]
    linkage = Linkage(
        [
            Pair(id=str(k), type=kind, links=links, point=row(point), axis=row(axis), misalignment=row(way))
            for k, (kind, links, point, axis, way) in enumerate(pairs)
        ]
    )
    index = linkage.links.index
    moving = [k for k, link in enumerate(linkage.links) if link not in ("frame", "driving")]
    drawn = linkage.settled(linkage.drawn(), [])[1]
    assert np.max(drawn) < 1e-12 or any(errors.values())
    poses, misfit = linkage.settled(linkage.drawn(), moving)
    assert np.max(misfit) < CLOSED
    turned = poses[index("driven"), :3, :3] @ marks[1]
    return float(np.arctan2(np.cross(marks[1], turned) @ f, marks[1] @ turned))


@pytest.mark.parametrize("key", ["lever_b", "lever_c"])
@pytest.mark.parametrize("theta", one_turn(7).tolist())
def test_a_lever_that_is_off_turns_a_rzeppa_joint_as_its_loops_close(key, theta):
    ball, step, slope = replace(LEVERED, balls=1), 1e-3, 0.0
    for place, weight in WEIGHTS:
        exact = levered(ball, theta, {key: place * step})
        made = ball.sized({key: getattr(ball, key) + place * step})
        lead, drawn = (one.deviation(np.asarray([theta]), np.asarray(BEND))[0][0] for one in (made, ball))
        assert exact == pytest.approx(lead - drawn, abs=1e-10)
        slope += weight / step * exact
    names = seats([ball])[0]
    told = influence(ball, BEND, np.asarray([theta]), len(names))[0, names.index(key)]
    assert slope == pytest.approx(told, abs=1e-7)
