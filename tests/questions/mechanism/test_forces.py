"""What drives a mechanism and what its pairs carry: against an own balance, virtual work and the kinetic energy."""

from dataclasses import replace

import numpy as np
import pytest

from cardan import InputError
from cardan.mechanisms import LinkMass, Load, example_mechanism, mechanism_forces

TURN = np.radians(np.arange(0.0, 360.0, 5.0))
SPEED = 1500 * np.pi / 30


def own_slider_crank(angle):
    """Return input torque and reactions of the crank-slider by plane equations of each body, solved at once."""
    r, rod = 0.05, np.hypot(0.17, 0.04)
    a = angle + np.arctan2(40, 30)
    down = -np.arcsin(r * np.sin(a) / rod)
    spin = -r * np.cos(a) * SPEED / (rod * np.cos(down))
    steep = (r * np.sin(a) * SPEED**2 + rod * np.sin(down) * spin**2) / (rod * np.cos(down))
    pin = r * np.array([np.cos(a), np.sin(a)])
    head = pin + rod * np.array([np.cos(down), np.sin(down)])
    along, aside = np.array([np.cos(down), np.sin(down)]), np.array([-np.sin(down), np.cos(down)])
    drawn = np.array([0.17, -0.04]) / rod
    centre = np.array([0.05, -0.012])
    lengthwise, across = centre @ drawn, centre @ np.array([-drawn[1], drawn[0]])
    arm = lengthwise * along + across * aside
    swept = -(SPEED**2) * pin + steep * np.array([-arm[1], arm[0]]) - spin**2 * arm
    slid = (-(SPEED**2) * pin + steep * rod * aside - spin**2 * rod * along)[0]
    pace = (SPEED * np.array([-pin[1], pin[0]]) + spin * rod * aside)[0]
    push = -800 * np.sign(pace)
    # unknown: bearing x y on the frame, crank pin x y on the rod, piston pin x y on the piston, guide y, torque
    rows, right = np.zeros((8, 8)), np.zeros(8)
    rows[0, [0, 2]], rows[1, [1, 3]] = -1, -1  # crank without mass
    rows[2, [2, 3, 7]] = pin[1], -pin[0], 1
    rows[3, [2, 4]], rows[4, [3, 5]] = (1, -1), (1, -1)
    right[3:5] = 0.5 * swept
    lever, other = -arm, head - pin - arm
    rows[5, [2, 3, 4, 5]] = -lever[1], lever[0], other[1], -other[0]
    right[5] = 0.00129 * steep
    rows[6, 4], right[6] = 1, 0.6 * slid - push
    rows[7, [5, 6]] = 1, 1
    return np.linalg.solve(rows, right)


def test_slider_crank_carries_what_its_plane_equations_say():
    found = mechanism_forces(example_mechanism("crank-slider"), TURN)
    want = np.array([own_slider_crank(one) for one in TURN])
    np.testing.assert_allclose(found.input_torque, want[:, 7], atol=1e-9)
    for k, columns in ((0, [0, 1]), (1, [2, 3]), (2, [4, 5])):
        np.testing.assert_allclose(found.reaction[:, k, 3:5], want[:, columns], atol=1e-8)
    np.testing.assert_allclose(-found.reaction[:, 3, 4], want[:, 6], atol=1e-8)


def test_a_rod_that_only_swings_round_needs_no_torque_and_loads_all_pins_alike():
    """Its inertia m ω² r turns with the cranks: half on each, also a tenth of a degree beside a change point."""
    found = mechanism_forces(example_mechanism("parallelogram"))
    assert not np.any(found.input_torque)
    assert found.unbalanced < 1e-12
    np.testing.assert_allclose(found.largest, 0.5 * 0.8 * (10 * np.pi) ** 2 * 0.06, rtol=1e-12)
    assert not np.any(found.most)


@pytest.mark.slow
def test_input_does_the_work_of_the_loads():
    found = mechanism_forces(replace(example_mechanism("crank-slider"), masses=()), TURN)
    travel = found.motion.output
    np.testing.assert_allclose(found.input_torque, 800 * np.abs(travel.speed), atol=1e-10)
    maize = mechanism_forces(example_mechanism("maize-drive"), TURN)
    np.testing.assert_allclose(maize.input_torque, 200 * np.abs(maize.motion.output.ratio), atol=1e-9)


@pytest.mark.slow
def test_inertia_in_space_is_the_slope_of_the_kinetic_energy():
    made = example_mechanism("maize-drive-cured")
    rng = np.random.default_rng(3)
    masses = []
    for link in made.links:
        half = rng.normal(size=(3, 3))
        tensor = 0.01 * (half @ half.T)
        tensor = np.trace(tensor) * np.eye(3) - tensor
        masses.append(
            LinkMass(
                link=link,
                mass=float(rng.uniform(1, 5)),
                mass_centre=tuple(rng.uniform(-0.5, 0.5, 3)),
                inertia=tuple(np.diag(tensor)),
                inertia_products=(tensor[0, 1], tensor[0, 2], tensor[1, 2]),
            )
        )
    made = replace(made, masses=tuple(masses), speed=20.0, gravity=(0.0, 0.0, -9.81))
    angle = np.arange(128) * (2 * np.pi / 128)
    found = mechanism_forces(made, angle)
    energy = np.zeros(128)
    for one in masses:
        k = made.links.index(one.link)
        pose, twist = found.motion.turned.displacement[:, k], 20.0 * found.motion.turned.rates.speed[:, k]
        point = pose[:, :3, :3] @ one.mass_centre + pose[:, :3, 3]
        pace = twist[:, 3:] + np.cross(twist[:, :3], point)
        own = np.einsum("pji,pj->pi", pose[:, :3, :3], twist[:, :3])
        energy += 0.5 * one.mass * np.sum(pace**2, axis=1) + 0.5 * np.einsum("pi,ij,pj->p", own, one.tensor, own)
        energy += one.mass * 9.81 * point[:, 2]
    waves = np.fft.rfft(energy)
    slope = np.fft.irfft(1j * np.arange(65) * waves, 128)
    np.testing.assert_allclose(found.input_torque, slope, atol=1e-8 * np.max(np.abs(energy)))
    assert found.unbalanced < 1e-10


def test_helical_slots_carry_their_followers():
    found = mechanism_forces(example_mechanism("slot-cam"), np.array([-1.0, 0.0, 1.2]))
    want = 0.03 * (20 / np.tan(np.radians(55)) - 35 / np.tan(np.radians(60)))  # Q cot β, Litvin without friction
    np.testing.assert_allclose(found.input_torque, want, atol=1e-9)


def test_a_load_turns_with_its_link_where_it_is_told_to():
    made = example_mechanism("parallelogram")
    for turns in (False, True):
        push = Load(link="driven crank", force=(10.0, 0.0, 0.0), point=(0.186, 0.048, 0.0), turns_with_link=turns)
        found = mechanism_forces(replace(made, masses=(), loads=(push,)), TURN)
        arm = 0.06 * np.sin(TURN + np.arctan2(48, 36))
        np.testing.assert_allclose(found.input_torque, 10 * (arm[0] if turns else arm), atol=1e-7)


def test_traction_of_a_rolling_contact():
    made = replace(example_mechanism("friction-cones"), input_range=(0.0, 0.1))
    found = mechanism_forces(made)
    np.testing.assert_allclose(found.input_torque, 3.0, atol=1e-12)
    np.testing.assert_allclose(found.force[:, 2], 4.0 / 0.08, atol=1e-10)


@pytest.mark.parametrize(
    ("name", "changes", "field"),
    [
        ("crank-slider", {"output_force": None, "output_torque": 5.0}, "output_torque"),
        ("maize-drive", {"output_torque": None, "output_force": 5.0}, "output_force"),
    ],
)
def test_an_output_resists_as_it_moves(name, changes, field):
    with pytest.raises(InputError) as caught:
        mechanism_forces(replace(example_mechanism(name), **changes), np.zeros(1))
    assert [one.field for one in caught.value.problems] == [field]


@pytest.mark.parametrize(
    ("changes", "path"),
    [
        ({"loads": (Load(link="rod", force=(1.0, 0.0, 0.0)),)}, "loads[0].point"),
        ({"loads": (Load(link="rode", torque=(1.0, 0.0, 0.0)),)}, "loads[0].link"),
        ({"loads": (Load(link="rod"),)}, "loads[0].force"),
        ({"masses": (LinkMass(link="rod", inertia=(1.0, 1.0, 3.0)),)}, "masses[0].inertia"),
        ({"masses": (LinkMass(link="rod"), LinkMass(link="rod"))}, "masses[1].link"),
        ({"output_link": ""}, "output_link"),
        ({"output_torque": 1.0}, "output_force"),
        ({"gravity": (0.0, 0.0, float("nan"))}, "gravity"),
    ],
)
def test_what_contradicts_itself_is_refused(changes, path):
    with pytest.raises(InputError) as caught:
        replace(example_mechanism("crank-slider"), **changes)
    assert [one.field for one in caught.value.problems] == [path]
