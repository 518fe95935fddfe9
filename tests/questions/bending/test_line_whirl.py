"""The whole line whirls: against Timoshenko's elements written apart, in both planes, and closed forms of cracks."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import dblquad

from cardan import Drive, InputError
from cardan.drive.cross import Cross
from cardan.drive.duty import Duty
from cardan.drive.material import Material
from cardan.drive.shaft import PointMass, Segment, Shaft, ShaftCrack, Unbalance
from cardan.drive.support import Support
from cardan.formulas.crack_compliance import crack_compliance
from cardan.questions.bending.cracked_rotor import Crack, cracked_rotor
from cardan.questions.bending.line_answer import answer
from cardan.questions.bending.line_whirl import line_whirl
from cardan.questions.bending.rotor import rotor, rotor_response
from cardan.questions.forces.forces import forces
from cardan.units import deg, rpm

E, RHO, NU = 2.1e11, 7850.0, 0.3
OUTER, INNER = 0.07, 0.064
LENGTHS, BEARING = (0.8, 1.3), 0.7
CROSS, YOKE = 1.2, 0.9
DOWN, ASIDE, DAMPER = 2.5e5, 4e5, 300.0
UNBALANCES = {2: ((0.25, 4e-5, 0.3),), 3: ((0.4, 6e-5, -1.0), (1.1, 3e-5, 2.0))}


def drive(*, angle=0.0, torque=None, aside=None, crack=None, gravity=(0.0, 0.0, -9.80665), **support):
    """Two tubes joined in the middle, the first held near its end by a bearing that gives way."""
    steel = {"outer": OUTER, "inner": INNER, "material": Material(youngs=E, density=RHO, poisson=NU)}
    turn = np.cumsum([0.0, angle, -angle, angle])
    steps = np.asarray([0.3, *LENGTHS, 0.3])[:, None] * np.stack([np.cos(turn), 0.0 * turn, np.sin(turn)], axis=-1)
    line = Drive.from_points([tuple(point) for point in np.cumsum([[-0.3, 0, 0], *steps], axis=0).tolist()])
    joints = (line.joints[0], replace(line.joints[1], cross=Cross(mass=CROSS)), line.joints[2])
    shafts = tuple(
        Shaft(
            number=k,
            unbalance=tuple(Unbalance(position=x, amount=u, angle=a) for x, u, a in UNBALANCES[k]),
            masses=(PointMass(position=0.75, mass=YOKE),) if k == 2 else (),
            crack=crack if k == 3 else None,
            **steel,
        )
        for k in (2, 3)
    )
    held = {"stiffness": DOWN, "side_stiffness": aside, "damping": DAMPER} | support
    return replace(
        line,
        joints=joints,
        shafts=(line.shafts[0], *shafts, line.shafts[3]),
        supports=(Support(shaft=2, position=BEARING, **held),),
        duty=Duty(speed_range=(500 * rpm, 4000 * rpm), torque=torque),
        settings=replace(line.settings, gravity=gravity),
    )


class Elements:
    """Timoshenko's elements in both planes: q = (x, slope of x, …) and (y, slope of y, …), the line straightened out.

    Built from the strain energy of the cubic and quadratic shapes by Gauss points, not from tables.
    """

    def __init__(self, cells=30, hinge=None):
        mesh = []
        for k, (length, number) in enumerate(zip(LENGTHS, (2, 3), strict=True)):
            extra = [BEARING, 0.75] if k == 0 else []
            extra += [x for x, _u, _a in UNBALANCES[number]]
            extra += [hinge] if hinge is not None and k == 1 else []
            mesh.append(np.unique(np.round(np.concatenate([np.linspace(0, length, cells + 1), extra]), 12)))
        self.mesh = mesh
        # Unknowns of a plane: deflections, then a slope before and a slope after each node.
        self.at = {}
        count = 0
        for k, places in enumerate(mesh):
            for j, x in enumerate(places):
                joined = k == 1 and j == 0
                cut = hinge is not None and k == 1 and abs(x - hinge) < 1e-12
                w = self.at[0, LENGTHS[0]][0] if joined else count
                count += 0 if joined else 1
                before, count = count, count + 1
                after = before
                if cut:
                    after, count = count, count + 1
                self.at[k, float(x)] = (w, before, after)
        self.size = count
        self.hinge = None if hinge is None else self.at[1, hinge]
        self.k, self.m, self.g = (np.zeros((count, count)) for _ in range(3))
        area, second = np.pi / 4 * (OUTER**2 - INNER**2), np.pi / 64 * (OUTER**4 - INNER**4)
        ratio = (INNER / OUTER) ** 2
        kappa = 6 * (1 + NU) * (1 + ratio) ** 2 / ((7 + 6 * NU) * (1 + ratio) ** 2 + (20 + 12 * NU) * ratio)
        shear = kappa * E / 2 / (1 + NU) * area
        for k, places in enumerate(mesh):
            for a, b in pairwise(places):
                first, last = self.at[k, float(a)], self.at[k, float(b)]
                rows = np.asarray([first[0], first[2], last[0], last[1]])
                self._add(rows, b - a, E * second, shear, RHO * area, RHO * second)
        self.lump(0, LENGTHS[0], CROSS)
        self.lump(0, 0.75, YOKE)
        held = [self.at[0, 0.0][0], self.at[1, LENGTHS[1]][0]]
        self.free = np.setdiff1d(np.arange(count), held)

    def lump(self, k, x, mass):
        self.m[self.at[k, x][0], self.at[k, x][0]] += mass

    def _add(self, rows, h, bending, shear, mass, rotary):
        point, weight = np.polynomial.legendre.leggauss(5)
        phi = 12 * bending / shear / h**2
        for s, dw in zip(0.5 * (1 + point), 0.5 * h * weight, strict=True):
            w = np.array(
                [1 - 3 * s**2 + 2 * s**3 + phi * (1 - s), h * (s - 2 * s**2 + s**3 + phi / 2 * (s - s**2)),
                 3 * s**2 - 2 * s**3 + phi * s, h * (-(s**2) + s**3 + phi / 2 * (s**2 - s))]
            ) / (1 + phi)  # fmt: skip
            t = np.array(
                [6 * (s**2 - s) / h, 1 - 4 * s + 3 * s**2 + phi * (1 - s), 6 * (s - s**2) / h,
                 3 * s**2 - 2 * s + phi * s]
            ) / (1 + phi)  # fmt: skip
            dt = np.array([6 * (2 * s - 1) / h, -4 + 6 * s - phi, 6 * (1 - 2 * s) / h, 6 * s - 2 + phi]) / (1 + phi) / h
            dwx = np.array(
                [(-6 * s + 6 * s**2 - phi) / h, 1 - 4 * s + 3 * s**2 + phi / 2 * (1 - 2 * s),
                 (6 * s - 6 * s**2 + phi) / h, -2 * s + 3 * s**2 + phi / 2 * (2 * s - 1)]
            ) / (1 + phi)  # fmt: skip
            part = np.ix_(rows, rows)
            self.k[part] += dw * (bending * np.outer(dt, dt) + shear * np.outer(dwx - t, dwx - t))
            self.m[part] += dw * (mass * np.outer(w, w) + rotary * np.outer(t, t))
            self.g[part] += dw * 2 * rotary * np.outer(t, t)

    def steady(self, omega, spin, push, *, aside, spring=None):
        """Return x and y (size,) complex under forces Re(push e^(iωt)) (2, size)."""
        n, c = self.size, self.at[0, BEARING][0]
        planes = []
        for stiff in (DOWN, aside):
            k = self.k.astype(complex)
            k[c, c] += stiff + 1j * omega * DAMPER
            if spring is not None:
                before, after = self.hinge[1:]
                for p, q, sign in ((before, before, 1), (after, after, 1), (before, after, -1), (after, before, -1)):
                    k[p, q] += sign * spring
            planes.append(k - omega**2 * self.m)
        turn = 1j * omega * spin * self.g
        matrix = np.block([[planes[0], turn], [-turn, planes[1]]])
        free = np.concatenate([self.free, n + self.free])
        found = np.zeros(2 * n, dtype=complex)
        found[free] = np.linalg.solve(matrix[np.ix_(free, free)], np.concatenate(push)[free])
        return found[:n], found[n:]

    def unbalance(self, speed, marks):
        """Forces of all unbalances, their angles from the marks of their shafts at the start, from X down."""
        push = np.zeros((2, self.size), dtype=complex)
        for number, rows in UNBALANCES.items():
            for x, u, a in rows:
                force = u * speed**2 * np.exp(1j * a) * marks[number]
                at = self.at[number - 2, x][0]
                push[0, at] += force
                push[1, at] += -1j * force
        return push


def compared(found, k, x, y, elements, places, order=1, rtol=3e-4):
    """Compare forward and backward parts at some places with elements apart."""
    for shaft, position in places:
        w = elements.at[shaft, position][0]
        here = position + (LENGTHS[0] if shaft else 0.0)
        p = int(np.argmin(np.abs(found.place - here)))
        assert abs(found.place[p] - here) < 1e-9
        forward, backward = 0.5 * (x[w] + 1j * y[w]), 0.5 * np.conj(x[w] - 1j * y[w])
        size = max(abs(forward), abs(backward))
        one = found.deflection[k, found.order == order, p][0]
        other = found.deflection[k, found.order == -order, p][0]
        assert abs(one - forward) < rtol * size
        assert abs(other - backward) < rtol * size


@pytest.mark.parametrize("aside", [DOWN, ASIDE])
def test_unbalances_of_the_whole_line_as_elements_say(aside):
    """Bounce on the centre bearing, both shafts, dampers, gyroscopic action, unequal supports, in phase and size."""
    speeds = np.asarray([700, 1300, 1900, 2600, 3800]) * rpm
    one = drive(aside=aside)
    found = line_whirl(one, speed=speeds, damping_ratio=0.0)
    elements, marks = Elements(), marks_at_start(one)
    for k, speed in enumerate(speeds):
        x, y = elements.steady(speed, speed, elements.unbalance(speed, marks), aside=aside)
        compared(found, k, x, y, elements, [(0, BEARING), (0, LENGTHS[0])])
    assert found.residual < 1e-4
    w = elements.at[0, BEARING][0]
    force = (DOWN + 1j * speeds[-1] * DAMPER) * x[w], (aside + 1j * speeds[-1] * DAMPER) * y[w]
    forward = 0.5 * (force[0] + 1j * force[1])
    assert found.support_force[-1, found.order == 1, 0] == pytest.approx(forward, rel=1e-3)


def marks_at_start(one):
    """e^(iψ) of the driving yokes of shafts 2 and 3 at the start, from X down to Y ahead."""
    found = forces(replace(one, supports=()), Duty(torque=1.0), [0.0])
    down = np.asarray([0.0, 0.0, -1.0])
    arms = {k: (found.driving_arm[k - 1, 0], found.axis[k - 1, 0]) for k in (2, 3)}
    return {k: complex(arm @ down, arm @ np.cross(axis, down)) for k, (arm, axis) in arms.items()}


def test_the_line_bounces_where_one_shaft_alone_does_not():
    """The bounce on the centre bearing is the largest motion; it grows as its damper is weaker."""
    sizes = []
    for damper in (100.0, 300.0, 900.0):
        found = line_whirl(drive(damping=damper), damping_ratio=0.005)
        size, speed, place = found.peak()
        assert 1000 * rpm < speed < 4000 * rpm
        assert abs(place - LENGTHS[0]) < 0.2
        sizes.append(size)
    assert sizes[0] > 1.5 * sizes[1] > 1.5 * sizes[2]


def test_joint_couples_shake_at_order_two_only_with_angle_and_torque():
    """The couples at the joints, from the forces of the drive, through the elements; half the torque, half of it."""
    speed = np.asarray([900 * rpm])
    none = line_whirl(drive(torque=500.0), speed=speed, damping_ratio=0.0)
    assert none.peak(2)[0] < 1e-9 * none.peak(1)[0]
    one = drive(angle=6 * deg, torque=500.0)
    found = line_whirl(one, speed=speed, damping_ratio=0.0)
    assert found.peak(2)[0] > 1e-3 * found.peak(1)[0]
    half = line_whirl(drive(angle=6 * deg, torque=250.0), speed=speed, damping_ratio=0.0)
    moved = found.order % 2 == 0
    weight = line_whirl(drive(angle=6 * deg), speed=speed, damping_ratio=0.0).deflection[:, moved]
    np.testing.assert_allclose(
        found.deflection[:, moved] - weight, 2.0 * (half.deflection[:, moved] - weight), atol=1e-9 * found.peak(2)[0]
    )
    # Elements: couples of order 2 at the slopes beside all joints.
    turn = np.arange(32) * 2 * np.pi / 32
    pushed = forces(replace(one, supports=()), Duty(torque=500.0), turn)
    elements = Elements()
    first, second = (np.zeros((2, elements.size), dtype=complex) for _ in range(2))
    ends = {0: [(None), ((0, 0.0), 2)], 1: [((0, LENGTHS[0]), 1), ((1, 0.0), 2)], 2: [((1, LENGTHS[1]), 1), None]}
    for joint, (before, after) in ends.items():
        for end, shaft, couple in (
            (before, joint, -pushed.driving_couple[joint]),
            (after, joint + 1, pushed.driven_couple[joint]),
        ):
            if end is None:
                continue
            axis = pushed.axis[shaft, 0]
            down = np.asarray([0.0, 0.0, -1.0]) + axis[2] * axis
            down /= np.linalg.norm(down)
            ahead = np.cross(axis, down)
            row = elements.at[end[0]][end[1]]
            for plane, values in enumerate((couple @ ahead, -(couple @ down))):
                line = np.fft.fft(values)[2] * 2.0 / 32
                (first, second)[0][plane, row] += line
    x, y = elements.steady(2 * speed[0], speed[0], first, aside=DOWN)
    compared(found, 0, x, y, elements, [(0, BEARING), (0, LENGTHS[0])], order=2)


def test_weight_sags_the_line_as_statics_says():
    found = line_whirl(drive(), speed=np.asarray([100.0]))
    elements = Elements()
    push = np.zeros((2, elements.size), dtype=complex)
    field = np.zeros(elements.size)
    field[[w for w, _b, _a in elements.at.values()]] = 9.80665
    area, second = np.pi / 4 * (OUTER**2 - INNER**2), np.pi / 64 * (OUTER**4 - INNER**4)
    assert area > 100 * second
    push[0] = elements.m @ field
    x, _y = elements.steady(0.0, 0.0, push, aside=DOWN)
    mean = found.deflection[0, found.order == 0][0]
    p = int(np.argmin(np.abs(found.place - BEARING)))
    assert mean[p].real == pytest.approx(x[elements.at[0, BEARING][0]].real, rel=1e-3)
    assert abs(mean[p].imag) < 1e-9 * mean[p].real


def test_an_open_crack_is_a_hinge_with_its_compliance():
    """Always open and alike both ways it is a spring in the line; the elements have a hinge there."""
    depth, place = 1.3, 0.65
    crack = ShaftCrack(depth_ratio=depth, breathing=0, position=place)
    one = drive(crack=crack)
    speeds = np.asarray([700, 1900, 3800]) * rpm
    along = float(crack_compliance(OUTER / 2, depth, E, inner=INNER / 2, poisson=NU).along)
    loss = ShaftCrack(losses=(_loss(along),) * 2, breathing=0, position=place)
    found = line_whirl(replace(one, shafts=(*one.shafts[:2], replace(one.shafts[2], crack=loss), one.shafts[3])),
                       speed=speeds, damping_ratio=0.0)  # fmt: skip
    sound = line_whirl(drive(), speed=speeds, damping_ratio=0.0)
    assert abs(found.peak(1)[0] / sound.peak(1)[0] - 1.0) > 0.02
    elements, marks = Elements(hinge=place), marks_at_start(one)
    for k, speed in enumerate(speeds):
        x, y = elements.steady(speed, speed, elements.unbalance(speed, marks), aside=DOWN, spring=1.0 / along)
        compared(found, k, x, y, elements, [(0, BEARING), (0, LENGTHS[0]), (1, place)])


def _loss(compliance):
    """Share of stiffness that a crack amid a shaft between two joints takes: c = Δ/(1-Δ) L/(3EI)."""
    soft = LENGTHS[1] / (3 * E * np.pi / 64 * (OUTER**4 - INNER**4))
    return compliance / (compliance + soft)


def test_a_breathing_crack_swells_as_that_of_one_mass_does():
    """One long thin bar between two joints, its crack amid: orders 2 and 3 and 1 backward of the cracked rotor."""
    line = Drive.from_angles([0.0, 0.0])
    crack = ShaftCrack(losses=(0.08, 0.02))
    bar = Shaft(number=2, length=1.5, outer=0.03, crack=crack, unbalance=(Unbalance(position=0.75, amount=1e-9),))
    one = replace(line, shafts=(bar,), duty=Duty(speed=60.0))
    steel = Material()
    area, second = np.pi / 4 * 0.03**2, np.pi / 64 * 0.03**4
    mass = 0.5 * steel.density * area * 1.5
    stiffness = mass * (np.pi / 1.5) ** 4 * steel.youngs * second / (steel.density * area)
    critical = np.sqrt(stiffness / mass)
    speed = critical * np.asarray([1 / 3, 0.5, 0.8])
    found = line_whirl(one, speed=speed, damping_ratio=0.02)
    # The first mode, sin πx/L, has the moment EI (π/L)² amid: a crack of compliance c takes 2 c EI/L of its stiffness.
    share = [1.0 / (1.0 + 1.5 * (1.0 / loss - 1.0)) for loss in crack.losses]
    alone = cracked_rotor(mass, stiffness, speed, crack=Crack(loss_xi=share[0], loss_eta=share[1]), damping_ratio=0.02,
                          gravity=4.0 / np.pi * 9.80665)  # fmt: skip
    p = int(np.argmin(np.abs(found.place - 0.75)))
    for k, order in ((0, 3), (1, 2), (2, -1)):
        here = abs(found.deflection[k, found.order == order, p][0])
        assert here == pytest.approx(float(alone.order_amplitude(order)[k]), rel=0.08), (k, order)


@pytest.mark.slow
def test_a_breathing_crack_is_followed_in_time_by_elements():
    """The hinge of the crack as a spring that changes over the turn; steps of Newmark until it repeats.

    A closed crack is a stiff spring here and the elements are few, which leaves some 3e-3.
    """
    place, zeta, speed = 0.65, 0.03, 1700 * rpm
    crack = ShaftCrack(depth_ratio=0.8, position=place, angle=0.4)
    one = drive(crack=crack)
    found = line_whirl(one, speed=[speed], damping_ratio=zeta)
    soft = crack_compliance(OUTER / 2, 0.8, E, inner=INNER / 2, poisson=NU)
    elements, marks = Elements(cells=6, hinge=place), marks_at_start(one)
    n, free = elements.size, elements.free
    k, m, g = (part[np.ix_(free, free)] for part in (elements.k, elements.m, elements.g))
    row = {old: new for new, old in enumerate(free)}
    bearing, jump = row[elements.at[0, BEARING][0]], np.zeros(len(free))
    jump[row[elements.hinge[2]]], jump[row[elements.hinge[1]]] = 1.0, -1.0
    k[bearing, bearing] += DOWN
    # Modes of the sound line, whose hinge is stiff.
    stiff = 1e4 / soft.along
    square, modes = np.linalg.eigh(np.linalg.solve(np.linalg.cholesky(m), np.linalg.solve(
        np.linalg.cholesky(m), k + stiff * np.outer(jump, jump)).T))  # fmt: skip
    modes = np.linalg.solve(np.linalg.cholesky(m).T, modes)
    weights = m @ modes
    c = (weights * (2 * zeta * np.sqrt(square))) @ weights.T
    c[bearing, bearing] += DAMPER
    size, none = len(free), np.zeros((len(free), len(free)))
    mass, whirl = np.block([[m, none], [none, m]]), np.block([[c, speed * g], [-speed * g, c]])
    field = np.zeros(n)
    field[[w for w, _b, _a in elements.at.values()]] = 9.80665
    weight = np.concatenate([(elements.m @ field)[free], np.zeros(size)])
    spinning = np.concatenate([part[free] for part in elements.unbalance(speed, marks)])
    jumps = np.zeros((2, 2 * size))
    jumps[0, :size] = jumps[1, size:] = jump
    per_turn, turns = 240, 60
    h = 2 * np.pi / speed / per_turn
    steady = np.block([[k, none], [none, k]])
    matrices = []
    for step in range(per_turn):
        theta = 2 * np.pi * step / per_turn + np.angle(marks[3]) + 0.4
        opened = 0.5 * (1 + np.cos(theta))
        turn = np.array([[np.cos(theta), -np.sin(theta)], [np.sin(theta), np.cos(theta)]])
        flexible = turn @ np.diag([float(soft.along), float(soft.across)]) @ turn.T * opened + np.eye(2) / stiff
        matrices.append(steady + jumps.T @ np.linalg.inv(flexible) @ jumps)
    inverse = [np.linalg.inv(mass * 4 / h**2 + whirl * 2 / h + one) for one in matrices]
    q, v = np.linalg.solve(matrices[0], weight), np.zeros(2 * size)
    a = np.linalg.solve(mass, weight + spinning.real - matrices[0] @ q)
    seen = []
    for step in range(1, per_turn * turns + 1):
        push = weight + (spinning * np.exp(2j * np.pi * step / per_turn)).real
        inert, damped = 4 / h**2 * q + 4 / h * v + a, 2 / h * q + v
        new = inverse[step % per_turn] @ (push + mass @ inert + whirl @ damped)
        a = 4 / h**2 * (new - q) - 4 / h * v - a
        v = 2 / h * (new - q) - v
        q = new
        if step > per_turn * (turns - 1):
            seen.append(complex(q[bearing], q[size + bearing]))
    wave = np.fft.fft(np.roll(seen, 1)) / per_turn
    p = int(np.argmin(np.abs(found.place - BEARING)))
    largest = abs(wave[1])
    assert abs(wave[2]) > 2e-3 * largest
    for order in (-2, -1, 0, 1, 2, 3):
        assert abs(found.deflection[0, found.order == order, p][0] - wave[order]) < 3e-3 * largest, order


@pytest.mark.parametrize("depth", [0.2, 0.5, 0.9])
def test_the_compliance_of_a_solid_shaft_by_another_quadrature(depth):
    r, low = 0.02, 0.02 * (1.0 - depth)

    def factor(share, table):
        lam = np.pi * share / 2
        root = np.sqrt(np.tan(lam) / lam) / np.cos(lam)
        return root * (
            0.923 + 0.199 * (1 - np.sin(lam)) ** 4
            if table == "bending"
            else 0.752 + 2.02 * share + 0.37 * (1 - np.sin(lam)) ** 3
        )

    width = np.sqrt(r**2 - low**2)
    second = np.pi / 4 * r**4

    def along(z, y):
        half, a = np.sqrt(r**2 - y**2), z - low
        top = half - low
        a = top - (half - z)
        return (half / second) ** 2 * np.pi * max(a, 1e-12) * factor(max(a, 1e-12) / (2 * half), "bending") ** 2

    def across(z, y):
        half, a = np.sqrt(r**2 - y**2), max(z - low, 1e-12)
        return (y / second) ** 2 * np.pi * a * factor(a / (2 * half), "tension") ** 2

    found = crack_compliance(r, depth, E, poisson=NU)
    for name, integrand in (("along", along), ("across", across)):
        value, _error = dblquad(integrand, -width, width, low, lambda y: np.sqrt(r**2 - y**2), epsrel=1e-8)
        assert getattr(found, name) == pytest.approx(2 * (1 - NU**2) / E * value, rel=2e-3)


def test_what_the_file_lacks_or_is_out_of_range_is_refused():
    with pytest.raises(InputError, match=r"duty\.speed_range: missing"):
        line_whirl(replace(drive(), duty=Duty()))
    with pytest.raises(InputError, match="damping_ratio"):
        line_whirl(drive(), damping_ratio=1.0)
    with pytest.raises(InputError, match="goes through its wall"):
        crack_compliance(0.035, 0.05, E, inner=0.03)
    with pytest.raises(InputError, match="depth_ratio"):
        crack_compliance(0.035, 1.9, E)
    with pytest.raises(InputError, match="depth_ratio: is more than 1"):
        crack_compliance(0.035, [1.0, 1.01], E)


def overhung(**more):
    """A bar on two bearings that carries the next shaft beyond the second one, cracked above that."""
    line = Drive.from_points([(x, 0.0, 0.0) for x in (-1.0, 0.0, 0.8, 1.0)])
    faint = (Unbalance(position=0.0, amount=1e-12),)
    bar = Shaft(number=1, segments=(Segment(length=0.9, outer=0.04),), **{"unbalance": faint} | more)
    supports = tuple(Support(shaft=1, position=x) for x in (-0.85, -0.3))
    return replace(line, shafts=(bar, Shaft(number=2, outer=0.06, unbalance=faint)), supports=supports)


def test_a_crack_over_a_bearing_opens_where_it_looks_up():
    """The overhang drops by c M l more while the crack looks up, where its weight stretches the bar."""
    found = line_whirl(overhung(crack=ShaftCrack(depth_ratio=0.9, position=-0.3)), speed=[1.0], damping_ratio=0.02)
    angle = 2.0 * np.pi * np.arange(64) / 64
    end = int(np.argmin(np.abs(found.place)))
    drop = np.exp(1j * np.outer(angle, found.order)) @ found.deflection[0, :, end]
    assert abs(angle[np.argmax(drop.real)] - np.pi) < 1e-9  # the mark, and the crack, look down at 0
    weight = 9.80665 * 7850.0 * np.pi / 4.0
    moment = weight * (0.04**2 * 0.3**2 / 2.0 + 0.06**2 * 0.8 / 2.0 * 0.3)
    more = float(crack_compliance(0.02, 0.9, 2.06e11).along) * moment * 0.3
    assert np.ptp(drop.real) == pytest.approx(more, rel=1e-3)


@pytest.mark.parametrize("place", [-0.3, -0.1, -0.6])
def test_one_shaft_and_the_whole_line_open_a_crack_on_the_same_side(place):
    """Up over the bearing, and between the bearings too, where the overhang bends the bar upwards."""
    out = (Unbalance(position=0.0, amount=2e-3),)
    orders = {}
    for angle in (0.0, np.pi):
        drive = overhung(crack=ShaftCrack(depth_ratio=0.9, position=place, angle=angle), unbalance=out)
        speed = [0.3 * rotor(drive, shaft=1).critical]
        alone = rotor_response(drive, shaft=1, speed=speed).steady
        line = line_whirl(drive, speed=speed, damping_ratio=0.02)
        end = int(np.argmin(np.abs(line.place)))
        orders[angle] = [
            (float(alone.order_amplitude(k)[0]), float(abs(line.deflection[0, line.order == k, end][0])))
            for k in (1, 2)
        ]
    for down, up in zip(orders[0.0], orders[np.pi], strict=True):
        assert up[0] > down[0]
        assert up[1] > down[1]
        assert up[0] / down[0] == pytest.approx(up[1] / down[1], rel=0.5)
    assert orders[np.pi][0][0] == pytest.approx(orders[np.pi][0][1], rel=0.1)


def cracked_bar(*segments, place):
    """A stepped bar between two joints, cracked somewhere."""
    parts = tuple(Segment(length=length, outer=outer) for length, outer in segments)
    crack = ShaftCrack(depth_ratio=0.8, position=place)
    out = (Unbalance(position=0.5, amount=1e-5),)
    bar = Shaft(number=2, length=sum(length for length, _outer in segments), segments=parts, crack=crack, unbalance=out)
    return replace(Drive.from_angles([0.0, 0.0]), shafts=(bar,))


def test_a_crack_at_a_shoulder_is_in_the_thinner_piece_from_either_side():
    one = rotor(cracked_bar((0.3, 0.04), (0.7, 0.06), place=0.3), shaft=2)
    other = rotor(cracked_bar((0.7, 0.06), (0.3, 0.04), place=0.7), shaft=2)
    assert one.crack.losses == pytest.approx(other.crack.losses, rel=5e-3)  # the shape bends by a spline
    near = rotor(cracked_bar((0.3, 0.04), (0.7, 0.06), place=0.299), shaft=2)
    assert one.crack.losses == pytest.approx(near.crack.losses, rel=0.02)


@pytest.mark.parametrize("wide", [0.002, 0.004, 0.01])
def test_a_crack_in_a_groove_feels_the_moment_beside_it(wide):
    """A groove of millimetres changes neither mode nor moment; the hinge is that of its section, by d^-3."""
    plain = rotor(cracked_bar((1.0, 0.04), place=0.4), shaft=2).crack.losses
    parts = ((0.4 - 0.5 * wide, 0.04), (wide, 0.036), (0.6 - 0.5 * wide, 0.04))
    grooved = rotor(cracked_bar(*parts, place=0.4), shaft=2).crack.losses
    for one, other in zip(grooved, plain, strict=True):
        assert one / (1.0 - one) == pytest.approx(other / (1.0 - other) * (40.0 / 36.0) ** 3, rel=0.015)


def test_a_crack_at_an_end_takes_nothing_and_one_beside_the_shaft_is_refused():
    for place in (0.0, 1.0):
        whole = cracked_bar((1.0, 0.04), place=place)
        assert max(rotor(whole, shaft=2).crack.losses) < 1e-9
        found = line_whirl(whole, speed=[100.0], damping_ratio=0.02)
        assert np.all(np.isfinite(found.deflection))
    for place in (-0.005, 1.2):
        with pytest.raises(InputError) as caught:
            cracked_bar((1.0, 0.04), place=place)
        assert [one.field for one in caught.value.problems] == ["shafts[1].crack.position"]
    with pytest.raises(InputError, match="outside the body of shaft 1"):
        rotor(overhung(crack=ShaftCrack(depth_ratio=0.9, position=-1.5)), shaft=1)


def test_speeds_of_its_own_find_the_peaks_of_a_crack():
    """Half and a third of the critical speed of the softer line, where no unbalance shakes it twice or three times."""
    line = replace(Drive.from_angles([0.0, 0.0]), duty=Duty(speed_range=(500 * rpm, 4000 * rpm)))
    crack = ShaftCrack(depth_ratio=0.6, position=0.5)
    bar = Shaft(number=2, length=1.0, outer=0.04, crack=crack, unbalance=(Unbalance(position=0.5, amount=1e-5),))
    one = replace(line, shafts=(bar,))
    found = line_whirl(one, damping_ratio=0.002)
    for order in (2, 3):
        size, speed, _place = found.peak(order)
        near = line_whirl(one, speed=speed * np.linspace(0.97, 1.03, 601), damping_ratio=0.002)
        assert size > 0.97 * near.peak(order)[0], order


@pytest.mark.parametrize("torque", [None, 4.0, 200.0])
def test_a_crack_that_other_moments_open_is_told(torque):
    """Couples up to T tan 10° at both ends, opposite, bend a fifth along by 3/5 of that, the weight by μgx(L-x)/2."""
    line = replace(Drive.from_angles([10 * deg, 10 * deg]), duty=Duty(speed=30.0, torque=torque))
    crack = ShaftCrack(depth_ratio=0.6, position=0.2)
    bar = Shaft(number=2, length=1.0, outer=0.04, crack=crack, unbalance=(Unbalance(position=0.5, amount=1e-9),))
    whole = replace(line, shafts=(bar,))
    found = line_whirl(whole, speed=[30.0])
    weight = 7850 * np.pi / 4 * 0.04**2 * 9.80665 * np.cos(10 * deg) * 0.2 * 0.8 / 2
    assert found.beside_weight == pytest.approx(0.6 * (torque or 0.0) * np.tan(10 * deg) / weight, rel=0.05, abs=1e-4)
    assert ("beside_weight" in {one.code for one in answer(whole, found).remarks}) == (torque == 200.0)
