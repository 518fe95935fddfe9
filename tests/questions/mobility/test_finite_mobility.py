import numpy as np
import pytest

from cardan import InputError
from cardan.questions.mobility.finite_mobility import finite_mobility
from cardan.questions.mobility.mobility import mobility
from cardan.units import deg
from tests.builders.mechanisms import chain, crank_slider, hooke


def test_a_hooke_joint_turns_by_its_law():
    joint_angle, phase = 0.5, 0.3
    found = finite_mobility(hooke(joint_angle, phase), driven_joint="A", angle=2.0)
    assert found.closes
    assert np.max(found.residual) < 1e-12
    # tan φ2 = tan φ1 / cos α, angles of the driving yoke from the plane of the shafts.
    second = np.array([np.sin(joint_angle), 0.0, np.cos(joint_angle)])
    last = found.displacement[-1, 2, :3, :3]
    start = np.cross(second, [0.0, 1.0, 0.0])
    end = last @ start
    turned = np.arctan2(second @ np.cross(start, end), start @ end)

    def law(angle):
        return np.arctan2(np.sin(angle), np.cos(angle) * np.cos(joint_angle))

    wanted = law(phase + 2.0) - law(phase)
    assert np.angle(np.exp(1j * (turned - wanted))) == pytest.approx(0.0, abs=1e-9)


def test_a_crank_turns_its_slider_by_the_formula():
    found = finite_mobility(crank_slider(), driven_joint="0-1", angle=1.0)
    assert found.closes
    start = np.arctan2(0.04, 0.03)
    rod = np.hypot(0.17, 0.04)

    def place(angle):
        return 0.05 * np.cos(angle) + np.sqrt(rod**2 - (0.05 * np.sin(angle)) ** 2)

    shift = found.displacement[-1, 2, :3, 3]
    assert shift == pytest.approx([place(start + 1.0) - place(start), 0.0, 0.0], abs=1e-12)


def test_a_bearing_that_also_slides_is_turned_not_slid():
    # A crank in a cylinder that may float, a rod with balls: the crank turns, and the piston goes its way.
    found = finite_mobility(crank_slider("CRRP"), driven_joint="0-1", angle=1.0)
    assert found.closes
    assert found.displacement[-1, 0, :3, :3] == pytest.approx(turned(1.0), abs=1e-12)


def turned(angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.asarray([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def parallelogram(wrong=0.0):
    z = (0, 0, 1)
    c, s = np.cos(1.0), np.sin(1.0)
    points = [(0, 0, 0), (0.1 * c, 0.1 * s, 0), (0.3 + 0.1 * c, 0.1 * s, 0), (0.3, 0, 0)]
    points += [(0.05 * c, 0.05 * s, 0), (0.3 + (0.05 + wrong) * c, (0.05 + wrong) * s, 0)]
    ends = [("0", "1"), ("1", "3"), ("3", "2"), ("2", "0"), ("1", "4"), ("4", "2")]
    return chain("RRRRRR", points, [z] * 6, ends, taken="2")


def test_a_third_rod_of_the_right_length_turns_and_a_wrong_one_locks():
    right, wrong = parallelogram(), parallelogram(0.01)
    assert (mobility(right).mobility, mobility(right).redundant) == (1, 7)
    assert (mobility(wrong).mobility, mobility(wrong).redundant) == (0, 6)
    whole = finite_mobility(right, driven_joint="0-1")  # through both dead centres, where it could fold
    assert whole.closes
    assert whole.displacement[-1] == pytest.approx(np.broadcast_to(np.eye(4), (4, 4, 4)), abs=1e-9)
    locked = finite_mobility(wrong, driven_joint="0-1", angle=5 * deg)
    assert not locked.closes
    assert locked.residual[locked.worst] > 1e-6


def test_a_small_motion_that_does_not_go_on_is_found_out():
    # Two rods in one line with a third one between the same points: free to first order only.
    z = (0, 0, 1)
    points = [(0, 0, 0), (0.1, 0, 0), (0.3, 0, 0)]
    ends = [("0", "1"), ("1", "2"), ("2", "0")]
    flat = chain("RRR", points, [z] * 3, ends)
    assert mobility(flat).mobility == 1
    assert not finite_mobility(flat, driven_joint="0-1", angle=5 * deg).closes


def test_the_mechanism_moves_along():
    found = finite_mobility(hooke(), driven_joint="A", angle=1.0)
    there = found.at(-1)
    assert (mobility(there).mobility, mobility(there).redundant) == (1, 3)
    b, c = (np.asarray(there.joints[k].axis) for k in (1, 2))
    assert abs(b @ c) < 1e-12  # the arms stay square
    assert b @ [0, 0, 1] == pytest.approx(0.0, abs=1e-12)


def test_it_can_be_stopped():
    found = finite_mobility(hooke(), driven_joint="A", angle=1.0, steps=10, progress=lambda share: "stop")
    assert found.cancelled
    assert len(found.position) == len(found.residual) == 2


@pytest.mark.parametrize(
    ("mechanism", "changed", "field"),
    [
        (hooke(), {"driven_joint": "X"}, "driven_joint"),
        (crank_slider(), {"driven_joint": "3-0"}, "angle"),
        (hooke(), {"angle": 0.0}, "angle"),
        (hooke(), {"angle": float("nan")}, "angle"),
        (hooke(), {"tolerance": 0.0}, "tolerance"),
        (hooke(), {"steps": 0}, "steps"),
        (hooke(), {"steps": 10_001}, "steps"),
        (hooke(), {"angle": 1e6}, "angle"),
    ],
)
def test_what_drives_nothing_is_named(mechanism, changed, field):
    with pytest.raises(InputError) as caught:
        finite_mobility(mechanism, **changed)
    assert caught.value.field == field
