"""The whole line while its speed changes: against elements written apart, followed in time by SciPy, and one mass."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import eigh

from cardan import Drive, InputError
from cardan.drive.duty import Duty
from cardan.drive.machine import RunUp
from cardan.drive.material import Material
from cardan.drive.shaft import Shaft, ShaftCrack, Unbalance
from cardan.questions.bending.bending import bending_speeds
from cardan.questions.bending.line_run import line_run
from cardan.questions.bending.line_whirl import line_whirl
from cardan.units import rpm

from .test_line_whirl import BEARING, DAMPER, DOWN, LENGTHS, Elements, drive, marks_at_start


def bar(run, *, zeta=None, **shaft):
    """One long thin bar between two joints with an unbalance amid."""
    line = Drive.from_angles([0.0, 0.0])
    whole = Shaft(number=2, length=1.5, outer=0.03, unbalance=(Unbalance(position=0.75, amount=2e-5),), **shaft)
    return replace(line, shafts=(whole,), duty=Duty(speed_range=(20.0, 300.0), run_up=run))


def one_mass():
    """Mass amid the bar of its first mode, and natural frequency of Euler's beam."""
    steel = Material()
    area, second = np.pi / 4 * 0.03**2, np.pi / 64 * 0.03**4
    return 0.5 * steel.density * area * 1.5, (np.pi / 1.5) ** 2 * np.sqrt(steel.youngs * second / steel.density / area)


@pytest.mark.slow
@pytest.mark.parametrize(("start", "end"), [(40.0, 260.0), (260.0, 40.0)])
def test_a_bar_passes_its_critical_speed_as_one_mass_does(start, end):
    """z̈ + 2ζω ż + ω² z = U/m (Ω² - iΩ̇) e^(iφ) of the first mode, up and down; the higher modes add half a per cent."""
    zeta, span = 0.01, 3.0
    found = line_run(bar(RunUp(start=start, end=end, duration=span)), damping_ratio=zeta)
    mass, omega = one_mass()
    rise = (end - start) / span

    def rate(t, s):
        z, v = s
        speed, angle = start + rise * t, start * t + 0.5 * rise * t * t
        push = 2e-5 / mass * (speed**2 - 1j * rise) * np.exp(1j * angle)
        return [v, push - 2 * zeta * omega * v - omega**2 * z]

    begin = 2e-5 / mass * start**2 / (omega**2 - start**2 + 2j * zeta * omega * start)
    apart = solve_ivp(rate, (0.0, span), [begin, 1j * start * begin], rtol=1e-9, atol=1e-12, max_step=2e-3,
                      dense_output=True)  # fmt: skip
    at = np.linspace(0.0, span, 40_001)
    size = np.abs(apart.sol(at)[0])
    k = int(np.argmax(size))
    assert found.peak == pytest.approx(size[k], rel=8e-3)
    assert found.peak_speed == pytest.approx(start + rise * at[k], rel=4e-3)
    assert found.peak_place == pytest.approx(0.75, abs=0.05)
    # Held, the peak is U/m/(2ζ√(1-ζ²)) of one mass; up it comes behind the critical speed, down before it.
    assert found.steady.peak()[0] == pytest.approx(2e-5 / mass / (2 * zeta), rel=8e-3)
    assert 0.1 < found.share < 0.8
    assert (found.peak_speed > omega) == (end > start)


@pytest.mark.slow
def test_a_slow_run_whirls_as_at_each_speed_held():
    quick, slow = (
        line_run(bar(RunUp(start=120.0, end=200.0, duration=span)), damping_ratio=0.05) for span in (0.1, 30.0)
    )
    assert quick.share < 0.65
    assert slow.share == pytest.approx(1.0, abs=0.01)


@pytest.mark.slow
@pytest.mark.parametrize("aside", [None, 4e5])
def test_two_shafts_on_a_damped_bearing_as_elements_in_time(aside):
    """The elements of the steady tests in their own modes, in both planes, followed in time by SciPy."""
    start, end, span, zeta = 900 * rpm, 3600 * rpm, 1.2, 0.01
    one = drive(aside=aside, gravity=(0.0, 0.0, -1e-9))
    one = replace(one, duty=replace(one.duty, run_up=RunUp(start=start, end=end, duration=span)))
    found = line_run(one, damping_ratio=zeta)
    elements, marks = Elements(cells=10), marks_at_start(one)
    free, n = elements.free, elements.size
    row = int(np.flatnonzero(free == elements.at[0, BEARING][0])[0])
    k, m, g = (part[np.ix_(free, free)] for part in (elements.k, elements.m, elements.g))
    k[row, row] += 0.5 * (DOWN + (aside or DOWN))
    square, modes = eigh(k, m, subset_by_index=[0, 9])
    held = modes[row]
    lost = np.diag(2 * zeta * np.sqrt(square)) + DAMPER * np.outer(held, held)
    apart = 0.5 * (DOWN - (aside or DOWN)) * np.outer(held, held)
    spin = modes.T @ g @ modes
    push = elements.unbalance(1.0, marks)[0][free] @ modes
    rise = (end - start) / span

    def rate(t, s):
        z, v = s[:10], s[10:]
        speed = start + rise * t
        force = push * (speed**2 - 1j * rise) * np.exp(1j * (start * t + 0.5 * rise * t * t))
        return np.concatenate([v, force - lost @ v + 1j * speed * spin @ v - square * z - apart @ np.conj(z)])

    ahead = np.diag(square - start**2) + 1j * start * lost + start**2 * spin
    behind = np.diag(square - start**2) + 1j * start * lost - start**2 * spin
    both = np.linalg.solve(np.block([[ahead, apart], [apart, behind]]), np.concatenate([start**2 * push, 0 * push]))
    forward, backward = both[:10], np.conj(both[10:])
    state = np.concatenate([forward + backward, 1j * start * (forward - backward)])
    done = solve_ivp(rate, (0.0, span), state, rtol=1e-7, atol=1e-11, t_eval=np.linspace(0, span, 8001))
    places = [elements.at[0, float(x)][0] for x in elements.mesh[0]] + [
        elements.at[1, float(x)][0] for x in elements.mesh[1]
    ]
    rows = [np.flatnonzero(free == one)[0] for one in places if one in free]
    size = np.max(np.abs(modes[rows] @ done.y[:10]), axis=0)
    top = int(np.argmax(size))
    assert n > 50
    assert found.peak == pytest.approx(size[top], rel=0.01)
    assert found.peak_speed == pytest.approx(start + rise * done.t[top], rel=0.01)
    assert abs(found.peak_place - LENGTHS[0]) < 0.2


def test_a_worn_spline_lowers_the_critical_speed_as_bending_says():
    one = bar(None, wear_factor=0.8)
    found = line_whirl(one, damping_ratio=0.002)
    assert found.worn == (2,)
    assert found.peak(1)[1] == pytest.approx(float(bending_speeds(one).actual[0]), rel=1e-3)
    assert line_whirl(bar(None), damping_ratio=0.002).worn == ()


def test_no_resonance_is_missed_between_two_speeds():
    """A resonance far narrower than the grid: the speeds about it are found from the modes, its peak is U/m/(2ζ)."""
    zeta = 2e-4
    found = line_whirl(bar(None), damping_ratio=zeta)
    mass, _omega = one_mass()
    assert found.peak()[0] == pytest.approx(2e-5 / mass / (2 * zeta), rel=0.01)


def test_what_a_run_lacks_or_is_too_long_for_is_refused():
    with pytest.raises(InputError, match=r"duty\.run_up: missing"):
        line_run(bar(None))
    with pytest.raises(InputError, match="too many to follow"):
        line_run(bar(RunUp(start=10.0, end=300.0, duration=3600.0)))


def test_cracks_do_not_count_on_the_way_and_are_named():
    cracked = bar(RunUp(start=40.0, end=200.0, duration=0.3), crack=ShaftCrack(losses=(0.1, 0.02)))
    assert line_run(cracked).cracked == (2,)
