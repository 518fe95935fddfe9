from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cardan.io import example_mechanism
from cardan.maths.kernel import screws
from cardan.mechanism.constraints import constraints
from cardan.questions.mobility.mobility import mobility, stresses
from tests.builders.mechanisms import anyhow, chain, crank_slider, hooke, row

SEEDS = st.integers(0, 2**32 - 1)


def numbers(mechanism):
    found = mobility(mechanism)
    assert found.agrees
    assert found.mobility - found.redundant == found.formula
    return found.mobility, found.redundant


def on_a_line(kinds, count, *, spline=None, seed=3):
    """A closed chain of joints with axes anyhow."""
    rng = np.random.default_rng(seed)
    ends = [(str(k), str((k + 1) % count)) for k in range(count)]
    return chain(kinds, rng.normal(size=(count, 3)), rng.normal(size=(count, 3)), ends)


# Worked results of the Book p. 13-16 and of the textbook's crank-slider, each W, q.
@pytest.mark.parametrize(
    ("mechanism", "wanted"),
    [
        (hooke(), (1, 3)),
        (hooke(0.0, 0.0), (1, 3)),
        (hooke(np.pi / 2, 0.0), (2, 4)),  # the dead position
        (hooke(kinds="RRRSG"), (1, 0)),
        (hooke(kinds="RRCS"), (2, 1)),  # the Book's first repair fails where the arms are square
        (hooke(kinds="RRCS", cross=np.deg2rad(80)), (1, 0)),  # and works where they are not
        (hooke(kinds="RCRS"), (1, 0)),
        (hooke(0.0, 0.3, kinds="RCRS"), (2, 1)),
        (hooke(0.5, np.pi / 2, kinds="RCRS"), (2, 1)),
        (crank_slider(), (1, 3)),
        (crank_slider("RSCP"), (1, 0)),
        (crank_slider("RSSP"), (2, 0)),
        (crank_slider("RRSC"), (2, 1)),
        (crank_slider("RSRC"), (1, 0)),
        (on_a_line("RRRRRRR", 7), (1, 0)),
        (on_a_line("RRSRR", 5), (1, 0)),
    ],
)
def test_known_mechanisms_move_and_bind_as_they_do(mechanism, wanted):
    assert numbers(mechanism) == wanted


@settings(max_examples=30, deadline=None)
@given(seed=SEEDS)
def test_both_formulations_agree_on_random_mechanisms(seed):
    rng = np.random.default_rng(seed)
    numbers(anyhow(rng, links=int(rng.integers(1, 7)), loops=int(rng.integers(0, 4))))


def told(mechanism):
    found = mobility(mechanism)
    return (
        found.mobility,
        found.redundant,
        found.local,
        found.parasitic,
        set(found.strained),
        {one.id: np.linalg.matrix_rank(one.force, 1e-6) if len(one.force) else 0 for one in found.joints},
    )


KNOWN = [hooke(), hooke(kinds="RRCS"), crank_slider(), crank_slider("RSSP"), crank_slider("RRSC")]


@pytest.mark.parametrize("mechanism", KNOWN)
def test_mobility_does_not_depend_on_where_and_how_large(mechanism):
    rng = np.random.default_rng(7)
    turn = screws.exponential(np.append(rng.normal(size=3), np.zeros(3)), np.asarray(1.0))[:3, :3]
    shift, size = 20.0 * rng.normal(size=3), 30.0
    moved = tuple(
        replace(one, point=row(size * (turn @ one.point) + shift), axis=row(5.0 * (turn @ one.axis)))
        for one in mechanism.joints
    )
    assert told(replace(mechanism, joints=moved)) == told(mechanism)


@pytest.mark.parametrize("mechanism", KNOWN)
def test_names_order_and_sense_of_links_do_not_matter(mechanism):
    names = {"0": "base", "1": "z", "2": "m", "3": "a"}
    turned = tuple(replace(one, links=(names[one.links[1]], names[one.links[0]])) for one in reversed(mechanism.joints))
    other = replace(mechanism, frame="base", joints=turned, input_link="z", output_link="a")
    assert told(other) == told(mechanism)


@pytest.mark.parametrize("mechanism", KNOWN)
def test_which_link_is_held_does_not_matter(mechanism):
    found = mobility(mechanism)
    for frame in "123":
        other = mobility(replace(mechanism, frame=frame, input_link="", output_link=""))
        assert (other.mobility, other.redundant, other.strained) == (found.mobility, found.redundant, found.strained)
        assert (other.driven, other.local, other.parasitic) == (None, None, None)


def test_states_of_stress_balance_every_link():
    system = constraints(hooke())
    found = stresses(system)
    assert found.shape == (3, 4, 6)
    balance = np.zeros((3, 3, 6))
    for j, (a, b) in enumerate(system.ends):
        for link, sign in ((a, -1.0), (b, 1.0)):
            if link >= 0:
                balance[:, link] += sign * found[:, j]
    assert np.max(np.abs(balance)) < 1e-14


def test_the_stress_of_a_hooke_joint_is_any_force_through_its_centre():
    found = mobility(hooke())
    for one in found.joints:
        assert one.sliding == ("strained",) * 3
        assert np.linalg.matrix_rank(one.force, 1e-9) == 3
    pins = [one for one in found.joints if one.id in "BC"]
    assert all(one.couple.size and np.max(np.abs(one.couple)) < 1e-12 for one in pins)
    assert [one.turning for one in pins] == [("free", "needed", "needed")] * 2
    assert [one.turning for one in found.joints if one.id in "AD"] == [("free", "strained", "strained")] * 2


@pytest.mark.parametrize(("bearing", "redundant"), [("R", 3), ("S", 1), ("SG", 0)])
def test_a_cross_between_bearings_is_held_as_the_instrument_joint_of_the_book_counts(bearing, redundant):
    """Book Fig. 8: W_F = -2, q = 3 in plain bearings, 1 with a spherical one; the page on Hooke joints says so."""
    drawn = example_mechanism("hooke-stiff-bearings")
    joints = tuple(
        replace(one, type=bearing, axis=None if bearing == "S" else one.axis) if one.id == "bearing 2" else one
        for one in drawn.joints
    )
    found = mobility(replace(drawn, joints=joints))
    assert (found.mobility, found.redundant) == (1, redundant)
    assert found.formula == 1 - redundant


def test_the_double_joint_without_spline_binds_along_its_shaft_alone():
    first, middle, last = np.eye(3)[0], np.array([0.9, 0.3, 0.2]), np.array([0.8, -0.2, 0.4])
    places = np.cumsum([np.zeros(3), 0.3 * first, 0.5 * middle], axis=0)
    pins = [np.array([0.0, 1, 0.4])]
    pins.append(np.cross(middle, pins[0]))
    pins.append(np.cross(middle, [0.2, 0.5, 1.0]))
    pins.append(np.cross(last, pins[2]))
    points = [places[0], places[1], places[1], places[2], places[2], places[2] + 0.3 * last]
    ends = [(str(k), str((k + 1) % 6)) for k in range(6)]
    found = mobility(chain("RRRRRR", points, [first, *pins, last], ends, taken="5"))
    assert (found.mobility, found.redundant) == (1, 1)
    for one in found.joints[1:5]:  # as a force of the pins it has the direction of the shaft
        force = one.force[0] @ one.axes
        assert np.linalg.norm(np.cross(force, middle)) < 1e-9 * np.linalg.norm(force)
        assert np.max(np.abs(one.couple)) < 1e-9


def test_local_and_parasitic_motions_are_told_apart():
    spin = mobility(crank_slider("RSSP"))
    assert (spin.driven, spin.local, spin.parasitic, spin.adrift) == (1, 1, 0, ("2",))
    drift = mobility(hooke(kinds="RRCS"))
    assert (drift.driven, drift.local, drift.parasitic, drift.adrift) == (1, 0, 1, ("2", "3"))
    assert mobility(hooke()).adrift == ()


def test_misfit_strains_what_it_cannot_move():
    def off(mechanism, joint, **misalignment):
        k = mechanism.index(joint)
        joints = list(mechanism.joints)
        joints[k] = replace(joints[k], **misalignment)
        return mobility(replace(mechanism, joints=tuple(joints)))

    loose = off(hooke(kinds="RRRSG"), "D", misalignment=(1e-3, 2e-3, 0.0))
    assert loose.misalignment == 0.0
    held = off(hooke(), "D", misalignment=(0.0, 1e-3, 0.0))
    assert held.misalignment > 0.0
    assert held.joints[3].misalignment == pytest.approx(held.misalignment)
    # A displacement that the hinge leaves free is no misfit at all.
    turned = off(hooke(), "D", misalignment_turn=row(1e-3 * np.asarray(hooke().joints[3].axis)))
    assert turned.misalignment == 0.0


def test_misfit_is_what_no_small_motion_takes_up():
    rng = np.random.default_rng(5)
    base = hooke()
    joints = tuple(
        replace(one, misalignment=row(1e-3 * rng.normal(size=3)), misalignment_turn=row(1e-3 * rng.normal(size=3)))
        for one in base.joints
    )
    found = mobility(replace(base, joints=joints))
    system = constraints(base)
    gaps = []
    for one, held in zip(joints, system.wrenches, strict=True):
        turn = np.asarray(one.misalignment_turn)
        shift = np.asarray(one.misalignment) / system.size + np.cross(system.place(one.point), turn)
        gaps.append(held @ np.concatenate((turn, shift)))
    gap = np.concatenate(gaps)
    matrix = system.matrix()
    rest = gap - matrix @ np.linalg.lstsq(matrix, gap, rcond=1e-9)[0]
    assert found.misalignment == pytest.approx(np.linalg.norm(rest) * system.size, rel=1e-9)


def test_motions_leave_every_joint_whole():
    mechanism = crank_slider("RSSP")
    found = mobility(mechanism)
    still = {"0": np.zeros((2, 6))} | {link: found.motion[:, k] for k, link in enumerate(mechanism.links)}
    for one in mechanism.joints:
        relative = still[one.links[1]] - still[one.links[0]]
        held = screws.reciprocal(screws.independent(one.freedoms))
        assert np.max(np.abs(relative @ held.T)) < 1e-12


def test_a_position_next_to_a_special_one_is_told():
    assert mobility(hooke()).certain
    assert not mobility(hooke(np.pi / 2 - 1e-12, 1e-6)).certain
