"""Another program's straight line: openTorsion, modes by a state matrix, response by an inverse at each frequency."""

import numpy as np
import pytest

from cardan.book.straight_line import line_modes, line_response

opentorsion = pytest.importorskip("opentorsion")

RNG = np.random.default_rng(3)
INERTIA, STIFFNESS, DAMPING = RNG.uniform(0.05, 2.0, 12), RNG.uniform(2e3, 3e4, 11), RNG.uniform(0.1, 2.0, 11)


def assembly(inertia, stiffness, damping):
    shafts = [opentorsion.Shaft(k, k + 1, k=c, c=b) for k, (c, b) in enumerate(zip(stiffness, damping, strict=True))]
    disks = [opentorsion.Disk(k, I=j) for k, j in enumerate(inertia)]
    return opentorsion.Assembly(shafts, disk_elements=disks)


def test_natural_frequencies_and_modes():
    found = line_modes(INERTIA, STIFFNESS)
    theirs = assembly(INERTIA, STIFFNESS, 0 * DAMPING)
    omega, *_damping = theirs.modal_analysis()
    slowest = np.sort(np.abs(omega))[::2]
    # Eigenvalues of the state matrix: the slowest one, 0, to the root of rounding.
    np.testing.assert_allclose(found.omega[1:], slowest[1:], rtol=1e-10)
    assert slowest[0] < 1e-4
    for w, shape in zip(found.omega, found.shape, strict=True):
        np.testing.assert_allclose(theirs.K @ shape, w**2 * (theirs.M @ shape), atol=1e-9)


def test_forced_response():
    omega = np.linspace(5.0, 400.0, 60)
    load = np.zeros(12, dtype=complex)
    load[[0, 7]] = 1.0, 0.3j
    found = line_response(INERTIA, STIFFNESS, omega, load, damping=DAMPING)
    theirs = assembly(INERTIA, STIFFNESS, DAMPING)
    angle, _speed = theirs.ss_response(load[:, None] * np.ones(omega.size), omega)
    # Their inverse is exact to rounding times its condition number, 1e5 here.
    np.testing.assert_allclose(found.angle, angle, rtol=1e-9)
    carried = STIFFNESS[:, None] + 1j * omega * DAMPING[:, None]
    np.testing.assert_allclose(found.torque, -carried * np.diff(angle, axis=0), atol=1e-9)
