"""Lines of beams: finite elements, transfer matrices and closed forms must say the same."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import eigvals, expm

from cardan.maths.linear import transfer
from cardan.maths.linear.modes import lowest, synchronous
from cardan.maths.linear.rotor_beams import divided, layout, line, matrices, rigid_motions, round_section
from cardan.maths.linear.transfer import dynamic_stiffness, modes_below, speeds

STEEL = {"youngs": 2.1e11, "density": 7850.0}
TUBE = round_section(0.076, 0.072, **STEEL, poisson=0.3)
THIN = round_section(0.076, 0.072, **STEEL)


def of(section, length, **keys):
    return line(length, section.bending, section.mass, shear=section.shear, rotary=section.rotary, **keys)


def some_line(seed, *, angle_error=()):
    """Return a stepped Timoshenko line with everything a line can have, hinge included."""
    rng = np.random.default_rng(seed)
    outer = rng.uniform(0.04, 0.09, (*angle_error, 5))
    section = round_section(outer, outer * rng.uniform(0.0, 0.9, (*angle_error, 5)), **STEEL, poisson=0.3)
    return of(
        section,
        rng.uniform(0.1, 0.6, (*angle_error, 5)),
        spring=np.asarray([0.0, 1e6, 0.0, 0.0, 3e5, 0.0]) * rng.uniform(0.5, 2.0, (*angle_error, 6)),
        lump=rng.uniform(0.0, 3.0, (*angle_error, 6)),
        tilt_spring=np.asarray([0.0, 0.0, 2e3, 0.0, 0.0, 0.0, 5e2]),
        diametral=rng.uniform(0.0, 0.004, (*angle_error, 7)),
        polar=rng.uniform(0.0, 0.004, (*angle_error, 7)),
        hinged=(3,),
        held=(0,),
    )


ENDS = {
    "pinned-pinned": ((0, 1), (), np.pi * np.arange(1, 4)),
    "fixed-fixed": ((0, 1), (0, 1), [4.730040744862704, 7.853204624095838, 10.995607838001671]),
    "fixed-pinned": ((0, 1), (0,), [3.926602312047919, 7.068582745628732, 10.21017612281303]),
    "fixed-free": ((0,), (0,), [1.8751040687119611, 4.694091132974175, 7.854757438237613]),
    "fixed-guided": ((0,), (0, 1), [2.365020372431352, 5.497803919000836, 8.639379828699740]),
}


@pytest.mark.parametrize("ends", ENDS)
def test_euler_and_bernoullis_beam_has_the_classical_roots(ends):
    held, clamped, root = ENDS[ends]
    beam = of(THIN, 1.5, held=held, clamped=clamped)
    want = (np.asarray(root) / 1.5) ** 2 * np.sqrt(THIN.bending / THIN.mass)
    # The roots are printed with 16 digits; determinants of a few pieces lose three or four.
    np.testing.assert_allclose(speeds(beam, 3), want, rtol=1e-12)
    # The element's error is (kh)⁴/1440 or so, kh up to 11/40.
    np.testing.assert_allclose(synchronous(divided(beam, [40]), 3).speed, want, rtol=1e-5)


def pinned_timoshenko(section, length, order, spin):
    """Return the lowest ω > 0 with (κGAk² - ρAω²)(EIk² + κGA + ρI(2Ωω - ω²)) = (κGAk)² by its polynomial in ω."""
    k, stiff = order * np.pi / length, 1.0 / section.shear
    first = np.poly1d([-section.mass, 0.0, stiff * k**2])
    if spin is None:
        turning = np.poly1d([section.rotary, 0.0, section.bending * k**2 + stiff])
    else:
        turning = np.poly1d([-section.rotary, 2.0 * section.rotary * spin, section.bending * k**2 + stiff])
    roots = (first * turning - (stiff * k) ** 2).roots
    real = roots[np.abs(roots.imag) < 1e-6].real
    return real[real > 0.0].min()


@pytest.mark.parametrize("spin", [None, 0.0, 700.0, -700.0])
def test_a_pinned_timoshenko_beam_whirls_in_sines(spin):
    thick = round_section(0.2, 0.1, **STEEL, poisson=0.3)
    want = [pinned_timoshenko(thick, 1.5, order, spin) for order in (1, 2, 3)]
    np.testing.assert_allclose(speeds(of(thick, 1.5, held=(0, 1)), 3, spin=spin), want, rtol=1e-11)


def test_with_rotary_inertia_alone_the_critical_speed_rises_by_the_closed_form():
    """Hinged ends, no shear: Ω² = EIk⁴/(ρA(1 - k²r²)), r² = (D² + d²)/16."""
    section = round_section(0.2, 0.1, **STEEL, poisson=0.3)
    k, r2 = np.pi / 1.5, (0.2**2 + 0.1**2) / 16
    want = np.sqrt(section.bending * k**4 / (section.mass * (1 - k**2 * r2)))
    stiff = line(1.5, section.bending, section.mass, rotary=section.rotary, held=(0, 1))
    np.testing.assert_allclose(speeds(stiff, 1), want, rtol=1e-12)


def test_a_slender_timoshenko_beam_is_euler_and_bernoullis():
    """Shear and rotary inertia count with (r/L)²: a hundred times the length, a ten-thousandth of the difference."""
    off = [
        speeds(of(TUBE, length, held=(0, 1)), 1)[0] / speeds(of(THIN, length, held=(0, 1)), 1)[0] - 1.0
        for length in (1.5, 15.0, 150.0)
    ]
    assert -0.01 < off[0] < -0.005
    assert off[1] / off[0] == pytest.approx(0.01, rel=0.02)
    assert off[2] / off[0] == pytest.approx(1e-4, rel=0.02)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("spinning", [True, False])
def test_elements_find_what_transfer_matrices_find(seed, spinning):
    whole = some_line(seed)
    exact = speeds(whole, 4, spin=None if spinning else 0.0)
    errors = [
        np.abs(synchronous(divided(whole, [parts] * 5), 4, spinning=spinning).speed / exact - 1.0).max()
        for parts in (8, 16)
    ]
    assert errors[0] < 1e-3
    # Shear is constant along an element, so its error falls with the square of the length.
    assert errors[1] < 0.3 * errors[0]


@pytest.mark.parametrize("spin", [250.0, -250.0, 2500.0])
def test_elements_whirl_at_a_given_spin_as_transfer_matrices_do(spin):
    whole = divided(some_line(7), [8] * 5)
    found = matrices(whole)
    size = len(found.stiffness)
    inverse = np.linalg.inv(found.inertia)
    companion = np.block(
        [[np.zeros((size, size)), np.eye(size)], [inverse @ found.stiffness, spin * inverse @ found.gyroscopic]]
    )
    roots = eigvals(companion)
    forward = np.sort(roots[roots.real > 0.0].real)[:4]
    np.testing.assert_allclose(speeds(some_line(7), 4, spin=spin), forward, rtol=1e-3)


def test_no_root_of_the_boundary_determinant_is_missed():
    """The determinant of the plain product of transfer matrices, over the speed: a sign change for each root."""
    whole = of(TUBE, [0.5, 0.7], held=(0, 2), spring=[0.0, 1e6, 0.0], lump=[0.0, 4.0, 0.0])

    def determinants(speed):
        zero, one = np.zeros_like(speed), np.ones_like(speed)
        section = np.asarray(
            [
                [zero, one, zero, TUBE.shear * one],
                [zero, zero, one / TUBE.bending, zero],
                [zero, TUBE.rotary * speed**2, zero, -one],
                [-TUBE.mass * speed**2, zero, zero, zero],
            ]
        ).transpose(2, 0, 1)
        rates, shapes = np.linalg.eig(section)  # four different ones: exp(section) = shapes exp(rates) shapes⁻¹
        total = np.broadcast_to(np.eye(4), section.shape)
        for k in range(2):
            node = np.tile(np.eye(4), (len(speed), 1, 1))
            node[:, 3, 0] = whole.spring[k] - whole.lump[k] * speed**2
            along = shapes * np.exp(rates * whole.length[k])[:, None, :] @ np.linalg.inv(shapes)
            np.testing.assert_allclose(along[::300], expm(section[::300] * whole.length[k]), rtol=1e-7, atol=1e-12)
            total = along.real @ node @ total
        return np.linalg.det(total[:, [[0], [2]], [1, 3]])

    grid = np.linspace(50.0, 20000.0, 1201)
    sign = np.sign(determinants(grid))
    at = np.flatnonzero(np.diff(sign))
    found = speeds(whole, len(at) + 1)
    assert np.all(grid[at] < found[:-1])
    assert np.all(found[:-1] < grid[at + 1])
    assert found[-1] > grid[-1]
    assert modes_below(whole, grid[-1]) == len(at)


def test_two_beams_between_four_pins_have_every_root_twice():
    """A hinge over a pin parts the line: roots of alike halves coincide, and both are found."""
    pair = of(TUBE, [1.2, 1.2], held=(0, 1, 2), hinged=(1,))
    alone = speeds(of(TUBE, 1.2, held=(0, 1)), 2)
    np.testing.assert_allclose(speeds(pair, 4), np.repeat(alone, 2), rtol=1e-10)


def test_pieces_may_be_taken_together_or_not(monkeypatch):
    """All of a line between its hinges in one transfer matrix each: roots within it are counted, none is lost."""
    whole = some_line(3)
    apart = speeds(whole, 8)
    monkeypatch.setattr(transfer, "SHORT", 2.0)
    np.testing.assert_allclose(speeds(whole, 8), apart, rtol=1e-9)
    assert modes_below(whole, 1.001 * apart[-1]) == 8


@pytest.mark.parametrize("count", [150, 400])
def test_a_line_of_many_waves_is_counted_to_the_last(count):
    """A pinned beam of Euler and Bernoulli: root n is (nπ/L)² √(EI/m), far more of them than it has hundredths."""
    whole = line([1000.0], 1.0e5, 6.0, held=(0, 1))
    middle = ((count + 0.5) * np.pi / 1000.0) ** 2 * np.sqrt(1.0e5 / 6.0)
    assert modes_below(whole, middle, spin=0.0) == count


@pytest.mark.parametrize("short", [1e-3, 1e-5, 1e-7])
def test_short_beams_cost_no_digits(short):
    """A mass just in front of a free tip, and one just before a hinge: as at the tip and at the hinge."""
    tip = of(THIN, 1.5, held=(0,), clamped=(0,), lump=[0, 3.0])
    near = of(THIN, [1.5 - short, short], held=(0,), clamped=(0,), lump=[0, 3.0, 0])
    hinge = of(THIN, [0.5, 0.7], held=(0, 2), hinged=(1,), diametral=[0, 0.02, 0, 0], spring=[0, 1e5, 0])
    before = of(
        THIN,
        [0.5 - short, short, 0.7],
        held=(0, 3),
        hinged=(2,),
        diametral=[0, 0.02, 0, 0, 0],
        spring=[0, 0, 1e5, 0],
    )
    for one, other in ((tip, near), (hinge, before)):
        # What moved by a share of the length changes the speed by some of it; rounding has no part in that.
        np.testing.assert_allclose(speeds(other, 3), speeds(one, 3), rtol=20 * short)


def test_guesses_only_save_time():
    whole = some_line(3)
    exact = speeds(whole, 3)
    np.testing.assert_allclose(speeds(whole, 3, near=exact * (1 + 5e-4)), exact, rtol=1e-11)
    np.testing.assert_allclose(speeds(whole, 3, near=[7.0, np.nan, exact[0]]), exact, rtol=1e-11)


def test_what_can_move_without_bending_has_speed_zero():
    free = of(THIN, 1.5)
    found = speeds(free, 4)
    assert found[:2].tolist() == [0.0, 0.0]
    want = (np.asarray([4.730040744862704, 7.853204624095838]) / 1.5) ** 2 * np.sqrt(THIN.bending / THIN.mass)
    # As for the beams that are held. At the first of these roots the stiffnesses on the diagonal pass through zero.
    np.testing.assert_allclose(found[2:], want, rtol=1e-12)
    # Pinned, hinged amid, pinned: the hinge drops; each half then is a beam with one end pinned and one on nothing.
    swing = of(THIN, [0.7, 0.9], held=(0, 2), hinged=(1,))
    assert rigid_motions(swing).shape[-1] == 1
    assert speeds(swing, 2)[0] == 0.0
    assert speeds(swing, 2)[1] > 0.0
    assert rigid_motions(of(THIN, [0.7, 0.9], held=(0, 2), spring=[0, 1.0, 0], hinged=(1,))).shape[-1] == 0
    assert rigid_motions(of(THIN, [0.7, 0.9], held=(0,), clamped=(0, 3), hinged=(1,))).shape[-1] == 0


def test_a_stiff_free_body_nutates_with_the_ratio_of_its_inertias():
    """ω = (I_p/I_d) Ω, beside two zeros; so stiff that bending comes far above."""
    body = line([0.1, 0.1], 1e9, 1e-3, lump=[0, 5.0, 0], diametral=[0, 0.05, 0], polar=[0, 0.08, 0])
    found = speeds(body, 3, spin=100.0)
    assert found[:2].tolist() == [0.0, 0.0]
    assert found[2] == pytest.approx(160.0, rel=1e-4)


def test_a_disc_with_more_inertia_about_the_line_takes_a_mode_away():
    """An overhung disc on a beam next to no mass: two modes with I_d > I_p, one with I_p > I_d, each by its 2 × 2."""
    stiff, long, m = 2e4, 0.5, 8.0

    def found(diametral, polar):
        disc = line(long, stiff, 1e-6, lump=[0, m], diametral=[0, diametral], polar=[0, polar], held=(0,), clamped=(0,))
        return synchronous(divided(disc, [2]), 3).speed

    flexible = np.asarray([[long**3 / 3, long**2 / 2], [long**2 / 2, long]]) / stiff
    two = np.linalg.eigvals(flexible @ np.diag([m, 0.3])) ** -0.5
    np.testing.assert_allclose(found(0.4, 0.1)[:2], np.sort(two), rtol=1e-5)
    inverse = np.linalg.eigvals(flexible @ np.diag([m, -0.3]))
    one = inverse[inverse > 0.0] ** -0.5
    assert len(one) == 1
    assert found(0.1, 0.4)[0] == pytest.approx(one[0], rel=1e-5)
    assert found(0.1, 0.4)[1] > 1e3 * one[0], "what comes next is the mass of the beam itself"


def test_fewer_modes_than_asked_for_are_nan():
    roots, shapes = lowest(np.eye(3), np.diag([1.0, -2.0, 0.0]), 5)
    np.testing.assert_array_equal(roots, [1.0, np.nan, np.nan, np.nan, np.nan])
    assert np.isnan(shapes[:, 1:]).all()


def test_modes_of_a_pinned_beam_are_sines_and_part_from_each_other():
    beam = divided(of(TUBE, 1.5, held=(0, 1)), [30])
    found = synchronous(beam, 3)
    at = np.linspace(0.0, np.pi, 31)
    for order, shape in enumerate(found.deflection, start=1):
        want = np.sin(order * at)
        np.testing.assert_allclose(np.abs(shape), np.abs(want) / np.abs(want).max(), atol=1e-4)
    assert found.deflection.max(axis=-1) == pytest.approx(1.0)
    parts, where = matrices(beam), layout(beam)
    full = np.zeros((3, 62))
    full[:, where.deflection], full[:, where.slope] = found.deflection, found.slope
    shape = full[:, where.free]
    for part in (parts.stiffness, parts.inertia - parts.gyroscopic):
        product = shape @ part @ shape.T
        assert np.abs(product - np.diag(np.diag(product))).max() < 1e-9 * np.abs(product).max()


def test_many_lines_at_once_are_as_each_alone():
    many = divided(some_line(5, angle_error=(2, 3)), [4] * 5)
    found = synchronous(many, 3)
    assert found.speed.shape == (2, 3, 3)
    assert found.deflection.shape == (2, 3, 3, 21)
    alone = {
        name: getattr(many, name)[1, 2] if getattr(many, name).ndim > 1 else getattr(many, name)
        for name in (
            "length",
            "bending",
            "mass",
            "shear",
            "rotary",
            "spring",
            "lump",
            "tilt_spring",
            "diametral",
            "polar",
        )
    }
    single = synchronous(line(**alone, hinged=many.hinged, held=many.held, clamped=many.clamped), 3)
    np.testing.assert_allclose(found.speed[1, 2], single.speed, rtol=1e-12)
    np.testing.assert_allclose(found.slope[1, 2], single.slope, rtol=1e-8, atol=1e-10)


def test_cutting_beams_changes_nothing_exact():
    whole = some_line(2)
    fine = divided(whole, [1, 3, 2, 2, 1])
    assert [fine.slope_before(6), fine.slope_after(6)] == [6, 7]
    np.testing.assert_allclose(speeds(fine, 3), speeds(whole, 3), rtol=1e-11)
    want = dynamic_stiffness(whole, 30.0)
    assert np.linalg.det(dynamic_stiffness(fine, 30.0)) * np.linalg.det(want) > 0.0
    assert fine.place[-1] == pytest.approx(whole.place[-1], rel=1e-15)


def test_at_low_speed_the_dynamic_stiffness_is_that_of_the_elements():
    whole = some_line(1)
    found, static = dynamic_stiffness(whole, 1.0), matrices(whole)
    want = static.stiffness - (static.inertia - static.gyroscopic)
    np.testing.assert_allclose(found, want, atol=1e-9 * np.abs(want).max())


def test_cowpers_coefficient():
    """A full circle: 6(1+ν)/(7+6ν); a thin tube: 2(1+ν)/(4+3ν)."""
    full = round_section(0.1, 0.0, 1.0, 1.0, poisson=0.3)
    area, g = np.pi * 0.1**2 / 4, 1 / 2.6
    assert 1 / (full.shear * area * g) == pytest.approx(6 * 1.3 / 8.8)
    thin = round_section(0.1, 0.0999999, 1.0, 1.0, poisson=0.3)
    area = np.pi * (0.1**2 - 0.0999999**2) / 4
    assert 1 / (thin.shear * area * g) == pytest.approx(2 * 1.3 / 4.9, rel=1e-5)
    assert round_section(0.1, 0.0, 1.0, 1.0, poisson=0.3, shear_modulus=2 * g).shear == pytest.approx(full.shear / 2)
