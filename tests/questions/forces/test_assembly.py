from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cardan import Drive, InputError, forces
from cardan.drive.accuracy import Error
from cardan.drive.cross import Cross
from cardan.drive.duty import Duty
from cardan.drive.material import Material
from cardan.drive.settings import Settings
from cardan.drive.shaft import Spline
from cardan.drive.support import Support
from cardan.questions.forces.assembly import assembly
from cardan.units import mm
from tests.builders.frame_model import Bearing, Frame

ANGLES = np.asarray([0.0, 0.4, 1.9, 3.3, 5.0])
POINTS = [(-0.4, 0.0, 0.0), (0.0, 0.0, 0.0), (0.7, 0.25, 0.1), (1.3, 0.1, 0.3), (1.7, 0.1, 0.32)]
OUTER, INNER, YOUNGS = 0.04, 0.02, 2.0e11
BODY = (YOUNGS * np.pi * (OUTER**4 - INNER**4) / 64, YOUNGS * np.pi * (OUTER**2 - INNER**2) / 4)


def support(shaft, position, radial=2e8, axial=None, tilt=None, **more):
    return Support(
        shaft=shaft,
        position=position,
        axial=axial is not None,
        tilt=tilt is not None,
        stiffness=radial,
        axial_stiffness=axial,
        tilt_stiffness=tilt,
        **more,
    )


def drive(count, supports, *, elastic=(), slides=None, splines=(), errors=None):
    """A drive of the first joints of the points; what is elastic is a tube."""
    built = Drive.from_points(POINTS[: count + 2], yoke_angles=[0.5, -0.8][: count - 1], start_phase=0.3)
    joints = [
        replace(joint, cross=Cross(slides=(slides or {}).get(i, False)), error=errors[i] if errors else None)
        for i, joint in enumerate(built.joints)
    ]
    shafts = [
        replace(
            shaft,
            outer=OUTER if shaft.number in elastic else None,
            inner=INNER if shaft.number in elastic else None,
            material=Material(youngs=YOUNGS) if shaft.number in elastic else None,
            spline=Spline(position=0.2) if shaft.number in splines else None,
        )
        for shaft in built.shafts
    ]
    return replace(built, joints=tuple(joints), shafts=tuple(shafts), supports=tuple(supports))


def weightless(one):
    return replace(one, settings=Settings(gravity=(0.0, 0.0, 0.0)))


def frame(one):
    """The same drive for the displacement method."""
    points = [one.input.point, *(joint.centre for joint in one.joints), one.output.point]
    first = float(np.linalg.norm(np.subtract(points[1], points[0])))
    words = {False: (), True: ("driving", "driven"), "driving": ("driving",), "driven": ("driven",)}
    return Frame(
        points=points,
        yoke_angles=tuple(shaft.yoke_angle for shaft in one.shafts[1:-1]),
        start_phase=one.input.start_phase,
        bearings=[
            Bearing(
                s.shaft - 1,
                s.position + (first if s.shaft == 1 else 0.0),
                s.stiffness or 0.0,
                s.axial_stiffness or 0.0,
                s.tilt_stiffness or 0.0,
                s.offset,
            )
            for s in one.supports
        ],
        bodies=[BODY if shaft.outer else None for shaft in one.shafts],
        slides={i: words[joint.cross.slides] for i, joint in enumerate(one.joints)},
        splines={shaft.number - 1: shaft.spline.position for shaft in one.shafts if shaft.spline},
    )


THRUST = support(1, -0.35, axial=1e8, offset=(0.02 * mm, 0.03 * mm, -0.05 * mm))
CENTRE = support(2, 0.3, 3e7, offset=(0.0, 0.2 * mm, 0.1 * mm))
FIRST = [THRUST, support(1, -0.05)]
ERRORS = [
    Error(s1=0.02 * mm, a1=0.01 * mm, a2=0.03 * mm, a3=-0.01 * mm, a4=0.05 * mm),
    Error(s1=-0.04 * mm, a1=0.02 * mm, a3=0.01 * mm),
    Error(a2=-0.02 * mm, a4=0.03 * mm),
]
CASES = {
    "three bearings on a rigid shaft": drive(1, [*FIRST, support(1, -0.2, 1e8), support(2, 0.3)]),
    "one joint blocked": drive(1, [*FIRST, support(2, 0.1, 1e8), support(2, 0.5, axial=3e7)], errors=ERRORS),
    "one elastic joint blocked": drive(
        1, [*FIRST, support(2, 0.1, 1e8), support(2, 0.5, axial=3e7)], errors=ERRORS, elastic=(1, 2)
    ),
    "journals that slide": drive(
        1,
        [*FIRST, support(2, 0.1, 1e8), support(2, 0.5, axial=3e7)],
        errors=ERRORS,
        elastic=(2,),
        slides={0: "driving"},
    ),
    "centre bearing": drive(2, [*FIRST, CENTRE, support(3, 0.1), support(3, 0.5, axial=2e7)], errors=ERRORS),
    "elastic with centre bearing and spline": drive(
        2,
        [*FIRST, CENTRE, support(3, 0.1), support(3, 0.5, axial=2e7)],
        errors=ERRORS,
        elastic=(1, 2, 3),
        splines=(2,),
    ),
    "fixed ends, crosses that slide": drive(
        2,
        [
            support(1, -0.1, axial=1e8, tilt=4e5),
            support(1, -0.3, offset=(0.0, 0.1 * mm, 0.0)),
            CENTRE,
            support(3, 0.1, axial=1e8, tilt=1e5),
        ],
        errors=ERRORS,
        elastic=(2, 3),
        slides={0: "driving", 1: "driven"},
    ),
    "three joints, half elastic": drive(
        3,
        [*FIRST, CENTRE, support(3, 0.2, axial=1e7), support(4, 0.1), support(4, 0.4, axial=2e7)],
        errors=ERRORS,
        elastic=(2, 4),
    ),
}


@pytest.mark.parametrize("one", CASES.values(), ids=CASES)
def test_agrees_with_an_elastic_frame(one):
    found, other = assembly(one, angle=ANGLES), frame(one)
    errors = [[e.s1, e.a1, e.a2, e.a3, e.a4] if e else [0.0] * 5 for e in (joint.error for joint in one.joints)]
    for p, angle in enumerate(ANGLES):
        joint, force, couple, energy = other.solve(angle, errors)
        largest = np.max(np.abs(force))
        # The frame's matrix holds beams of 1e9 N/m beside ties of 1: some 1e7 roundings.
        np.testing.assert_allclose(found.joint_force[:, p], joint, atol=1e-8 * largest)
        np.testing.assert_allclose(found.reaction[:, p], force, atol=1e-8 * largest)
        np.testing.assert_allclose(found.couple[:, p], couple, atol=1e-8 * largest)
        assert found.energy[p] == pytest.approx(energy, rel=1e-7)
    assert found.degree > 0


@pytest.mark.parametrize("one", CASES.values(), ids=CASES)
def test_under_torque_the_frame_agrees_too(one):
    found, other = forces(weightless(one), Duty(torque=500.0), ANGLES), frame(one)
    errors = [[e.s1, e.a1, e.a2, e.a3, e.a4] if e else [0.0] * 5 for e in (joint.error for joint in one.joints)]
    assert int(found.status) == 2
    for p, angle in enumerate(ANGLES):
        joint, force, couple, _energy = other.solve(angle, errors, 500.0)
        largest = np.max(np.abs(force))
        np.testing.assert_allclose(found.joint_force[:, p], joint, atol=1e-8 * largest)
        np.testing.assert_allclose(found.reaction[:, p], force, atol=1e-8 * largest)
        np.testing.assert_allclose(found.support_couple[:, p], couple, atol=1e-8 * largest)
    assert np.max(found.force_left) < 1e-10  # thousands of newtons cancel
    assert np.max(found.moment_left) < 1e-10


def test_torque_without_stiffness_names_what_is_missing():
    bare = [replace(s, stiffness=None) for s in (*FIRST, support(1, -0.2), support(2, 0.3))]
    with pytest.raises(InputError, match=r"supports\[2\].stiffness") as caught:
        forces(drive(1, bare), Duty(torque=1.0))
    assert caught.value.field == "supports"


@pytest.mark.parametrize("one", CASES.values(), ids=CASES)
def test_every_shaft_is_in_balance(one):
    assert assembly(one).residual < 1e-11  # forces of kilonewtons cancel: thousands of roundings


@pytest.mark.slow
@pytest.mark.parametrize("one", CASES.values(), ids=CASES)
def test_torque_is_the_slope_of_the_energy(one):
    step = 1e-4
    energy = [assembly(one, angle=ANGLES + k * step).energy for k in (-2, -1, 1, 2)]
    slope = (energy[0] - 8 * energy[1] + 8 * energy[2] - energy[3]) / (12 * step)
    scale = np.max(np.abs(energy[0]))
    # Differences of the fourth order: 1e-16/1e-4 of the energy by rounding.
    np.testing.assert_allclose(assembly(one, angle=ANGLES).torque, slope, atol=1e-9 * scale, rtol=1e-7)


OFFSETS = st.lists(st.floats(-1e-3, 1e-3), min_size=15, max_size=15)
FLEXIBLE = CASES["elastic with centre bearing and spline"]


def moved(one, offsets):
    """The same drive with other offsets of its housings, and joints without errors."""
    rows = np.asarray(offsets, dtype=float).reshape(-1, 3)
    supports = tuple(replace(s, offset=tuple(row.tolist())) for s, row in zip(one.supports, rows, strict=True))
    return replace(one, supports=supports, joints=tuple(replace(joint, error=None) for joint in one.joints))


@pytest.mark.parametrize("name", ["elastic with centre bearing and spline", "centre bearing", "journals that slide"])
def test_forces_are_reciprocal(name):
    # Maxwell and Betti: the force at a by moving the housing at b is that at b by moving a.
    one = CASES[name]
    count = 3 * len(one.supports)
    table = np.stack([assembly(moved(one, 1e-3 * row), angle=[0.7]).reaction[:, 0].ravel() for row in np.eye(count)])
    np.testing.assert_allclose(table, table.T, atol=1e-10 * np.max(np.abs(table)))
    # What moves the housings stores energy, whichever way.
    assert np.min(np.linalg.eigvalsh(table)) > -1e-10 * np.max(np.abs(table))


@pytest.mark.slow
@given(OFFSETS, OFFSETS)
def test_forces_superpose_and_the_slope_of_the_energy_is_the_force(one, other):
    first, second = (assembly(moved(FLEXIBLE, given), angle=[0.7]) for given in (one, other))
    both = assembly(moved(FLEXIBLE, np.add(one, other)), angle=[0.7])
    scale = 2e8 * 1e-3
    np.testing.assert_allclose(both.reaction, first.reaction + second.reaction, atol=1e-10 * scale)
    # Castigliano, for a quadratic: U(a + b) - U(a) - U(b) = force by a times way b.
    work = float(np.sum(first.reaction[:, 0] * np.reshape(other, (-1, 3))))
    assert both.energy[0] - first.energy[0] - second.energy[0] == pytest.approx(work, abs=1e-10 * scale * 1e-3)


def test_moving_all_housings_alike_strains_nothing():
    one = CASES["three joints, half elastic"]
    same = assembly(moved(one, [1e-3, -2e-3, 5e-4] * len(one.supports)))
    assert np.max(np.abs(same.reaction)) < 1e-9 * 2e8 * 1e-3  # of what moving one of them would take


def test_turning_the_whole_drive_turns_the_forces():
    one = CASES["centre bearing"]
    turn = np.linalg.qr(np.random.default_rng(2).normal(size=(3, 3)))[0]
    turn *= np.linalg.det(turn)

    def swung(point):
        return tuple((turn @ np.asarray(point)).tolist())

    other = replace(
        one,
        input=replace(one.input, point=swung(one.input.point)),
        output=replace(one.output, point=swung(one.output.point)),
        joints=tuple(replace(joint, centre=swung(joint.centre)) for joint in one.joints),
        supports=tuple(replace(s, offset=swung(s.offset)) for s in one.supports),
    )
    before, after = assembly(one, angle=ANGLES), assembly(other, angle=ANGLES)
    largest = np.max(np.abs(before.reaction))
    np.testing.assert_allclose(after.reaction, before.reaction @ turn.T, atol=1e-10 * largest)
    np.testing.assert_allclose(after.torque, before.torque, atol=1e-10 * np.max(np.abs(before.torque)))


def test_a_bearing_that_gives_way_is_no_bearing():
    one = CASES["centre bearing"]
    without = replace(one, supports=tuple(s for s in one.supports if s is not CENTRE))
    soft = replace(one, supports=tuple(replace(s, stiffness=1e-3) if s is CENTRE else s for s in one.supports))
    kept = [k for k, s in enumerate(one.supports) if s is not CENTRE]
    found, wanted = assembly(soft, angle=ANGLES), assembly(without, angle=ANGLES)
    # A spring of 1e-3 N/m carries 1e-11 of the force of the others of 1e8 N/m.
    np.testing.assert_allclose(found.reaction[kept], wanted.reaction, atol=1e-9 * np.max(np.abs(wanted.reaction)))
    assert found.degree == wanted.degree + 2


def test_bearings_grow_stiff_towards_a_rigid_limit():
    shafts = CASES["one elastic joint blocked"]

    def force(size):
        supports = tuple(replace(s, stiffness=size, axial_stiffness=size if s.axial else None) for s in shafts.supports)
        return assembly(replace(shafts, supports=supports), angle=ANGLES).joint_force

    # What is left to the limit goes with 1/k: over 1e12 N/m, 99 and 9 parts of it at 1e10 and 1e11.
    limit = force(1e12)
    off = [float(np.max(np.abs(force(size) - limit))) for size in (1e10, 1e11)]
    assert off[0] / off[1] == pytest.approx(11, rel=0.1)
    assert np.max(np.abs(limit)) > 1e3


def test_what_is_determinate_fits_whatever_its_errors():
    found = assembly(drive(1, [*FIRST, support(2, 0.3)], errors=ERRORS))
    assert (found.degree, found.strained, found.spare) == (0, (), ())
    assert not np.any(found.reaction)
    assert np.max(np.abs(found.gap)) > 1e-5


def test_a_joint_alone_is_closed_form():
    # Rigid shafts, one bearing span each: C = c_lat (1 - ee) + c_ax ee for both shafts, F = C⁻¹ D.
    one = CASES["one joint blocked"]
    found = assembly(one, angle=ANGLES)
    points = np.asarray(POINTS[:3])
    e = np.diff(points, axis=0)
    e /= np.linalg.norm(e, axis=1)[:, None]
    soft = np.zeros((3, 3))
    for axis, near, far, k_near, k_far, k_axial in (
        (e[0], 0.05, 0.35, 2e8, 2e8, 1e8),
        (e[1], 0.1, 0.5, 1e8, 2e8, 3e7),
    ):
        span = far - near
        lateral = (far / span) ** 2 / k_near + (near / span) ** 2 / k_far
        soft += lateral * (np.eye(3) - np.outer(axis, axis)) + np.outer(axis, axis) / k_axial
    offset = np.zeros(3)
    far, near = np.asarray(THRUST.offset), np.zeros(3)
    # Shaft 1 is moved by its far housing: across as a lever, along as it is.
    lever = -0.05 / 0.3
    across = far - (far @ e[0]) * e[0]
    offset = lever * across + (far @ e[0]) * e[0] + 0.0 * near
    for p in range(len(ANGLES)):
        wanted = np.linalg.solve(soft, found.gap[0, p] + offset)
        np.testing.assert_allclose(found.joint_force[0, p], wanted, rtol=1e-10, atol=1e-7)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["one elastic joint blocked", "journals that slide", "fixed ends, crosses that slide"])
def test_peaks_are_those_of_dense_samples(name):
    found = assembly(CASES[name])
    dense = assembly(CASES[name], angle=np.linspace(0.0, 2 * np.pi, 7201)[:-1])
    rows = [
        (found.joint_peak, np.linalg.norm(dense.joint_force, axis=-1)),
        (found.radial_peak, dense.radial),
        (found.axial_peak, np.abs(dense.axial)),
        (found.couple_peak, np.linalg.norm(dense.couple, axis=-1)),
        ((found.energy_peak,), dense.energy[None]),
        ((found.torque_peak,), np.abs(dense.torque)[None]),
    ]
    for peaks, curves in rows:
        for peak, curve in zip(peaks, curves, strict=True):
            # A dense sample misses a smooth peak by the square of half a step, 2e-7 times its curvature.
            assert peak.value >= np.max(curve) * (1 - 1e-9) - 1e-12
            assert peak.value == pytest.approx(np.max(curve), rel=1e-5, abs=1e-12)


@pytest.mark.parametrize(
    ("supports", "degree", "spare"),
    [
        ([*FIRST, support(2, 0.3)], 0, ()),
        ([*FIRST, support(1, -0.2, 1e8), support(2, 0.3)], 2, ("supports[2].radial",)),
        ([*FIRST, support(2, 0.3, axial=1e8)], 1, ("supports[2].axial",)),
        ([*FIRST, support(2, 0.1), support(2, 0.5)], 2, None),
    ],
)
def test_what_is_too_many_is_named(supports, degree, spare):
    one = drive(1, supports)
    found = assembly(one)
    assert found.degree == degree
    if spare is not None:
        assert found.spare == spare
    # Letting go of what is named makes the drive determinate.
    for key in found.spare:
        k, hold = int(key.split("[")[1].split("]")[0]), key.split(".")[1]
        name = {"radial": "stiffness", "axial": "axial_stiffness", "tilt": "tilt_stiffness"}[hold]
        supports = [replace(s, **{hold: False, name: None}) if i == k else s for i, s in enumerate(supports)]
    kept = [s for s in supports if s.radial or s.axial or s.tilt]
    assert assembly(drive(1, kept)).degree == 0


def fields(one, **options):
    with pytest.raises(InputError) as caught:
        assembly(one, **options)
    return {problem.field: problem.message for problem in caught.value.problems}


def test_bad_layouts_are_named():
    assert set(fields(drive(1, []))) == {"supports"}
    found = fields(drive(1, [support(1, -0.35), support(1, -0.05), support(2, 0.3)]))
    assert found["supports"].startswith(
        "not held, 1 hold too few: nothing keeps shaft 1 from moving along its axis, shaft 2"
    )
    found = fields(drive(1, [support(1, -0.35), support(2, 0.3)]))
    assert "3 holds too few: nothing keeps shaft 1 from moving sideways" in found["supports"]
    bare = [replace(s, stiffness=None) for s in (*FIRST, support(1, -0.2), support(2, 0.3))]
    assert set(fields(drive(1, bare))) == {f"supports[{k}].stiffness" for k in range(3)}
    assert set(fields(CASES["centre bearing"], errors=[None])) == {"errors"}
    unsized = Drive.from_angles([0.2, 0.2])
    unsized = replace(unsized, supports=(*FIRST, support(3, 0.1), support(3, 0.4)))
    assert set(fields(unsized)) == {"shafts[1].length"}


def test_without_misfit_no_stiffness_is_asked_for():
    bare = [replace(s, stiffness=None, offset=(0.0, 0.0, 0.0)) for s in (*FIRST, support(1, -0.2), support(2, 0.3))]
    bare[0] = replace(bare[0], axial_stiffness=None)
    found = assembly(drive(1, bare))
    assert found.degree == 2
    assert not np.any(found.reaction)


def test_errors_may_be_given_beside_the_drive():
    one = CASES["one joint blocked"]
    clean = replace(one, joints=tuple(replace(joint, error=None) for joint in one.joints))
    np.testing.assert_array_equal(assembly(clean, ERRORS[:1]).reaction, assembly(one).reaction)
    # Errors of angles turn freely.
    turned = [replace(ERRORS[0], alpha1=0.01, alpha2=0.02, alpha3=0.01, alpha4=0.01, phase=0.1)]
    np.testing.assert_array_equal(assembly(clean, turned).reaction, assembly(one).reaction)
