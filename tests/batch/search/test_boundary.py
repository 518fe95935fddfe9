"""Boundaries followed: circles, rings, what the first grid sees too little of, Mathieu's equation, a drive."""

import math

import numpy as np
import pytest
from scipy.special import mathieu_a, mathieu_b

from cardan.batch.answering.asking import Formula, evaluator
from cardan.batch.search.boundary import boundary
from cardan.batch.search.goals import Limit
from cardan.drive.fields.paths import with_values
from cardan.errors import InputError
from cardan.io import example
from cardan.maths.periodic.stability_map import stability_map
from cardan.questions.torsion.stability.torsion_stability import stability
from cardan.questions.torsion.steady.run_stability import Verdict

LIMIT = [Limit(name="growth_rate", high=0.0)]
BOX = [(-2.0, 2.0), (-2.0, 2.0)]
DISC = Formula.of(["x", "y"], {"r2": lambda x, y: x * x + y * y, "x": lambda x, y: x})
HOLE = Formula.of(["x", "y"], {"r": lambda x, y: np.where(x * x + y * y < 1.0, 0.5, np.nan)})


def closed(line):
    return bool(np.all(line[0] == line[-1]))


def test_a_circle_with_a_tenth_of_the_points_of_a_grid():
    """Crossings are found to a hundredth of a cell of 4/256, most of them much closer."""
    asked = []

    def ask(points):
        asked.append(len(points))
        return DISC(points)

    ask.points, ask.answers = DISC.points, DISC.answers
    found = boundary(ask, BOX, [Limit(name="r2", high=1.0)])
    (line,) = found.lines
    assert closed(line)
    np.testing.assert_allclose(np.hypot(*line.T), 1.0, atol=2e-4)
    assert found.grid == 257**2
    assert sum(asked) == found.evaluations < found.grid / 10
    # The line is a polygon of more than a point for every cell of its length.
    length = np.sum(np.hypot(*np.diff(line, axis=0).T))
    assert length == pytest.approx(2.0 * math.pi, rel=1e-3)
    np.testing.assert_array_equal(found.kept, np.hypot(*found.places.T) <= 1.0)


def test_work_grows_with_the_length_of_the_line_not_with_the_area():
    """Each halving doubles what is asked, but for the first grid; a plain grid asks four times as much."""
    counts = [boundary(DISC, BOX, [Limit(name="r2", high=1.0)], halvings=k).evaluations for k in (3, 4, 5)]
    assert counts[2] < 2.3 * counts[1] < 2.3**2 * counts[0]


def test_two_limits_make_the_boundary_of_what_keeps_both():
    """A disc cut at x = 0.5: every point lies on the circle or on the chord."""
    found = boundary(DISC, BOX, [Limit(name="r2", high=1.0), Limit(name="x", high=0.5)])
    (line,) = found.lines
    radius = np.hypot(*line.T)
    assert np.all((np.abs(radius - 1.0) < 1e-3) | (np.abs(line[:, 0] - 0.5) < 1e-3))
    assert np.all((radius < 1.001) & (line[:, 0] < 0.501))


def test_a_ring_has_two_lines_and_a_line_may_leave_the_box():
    ring = boundary(DISC, BOX, [Limit(name="r2", low=0.5, high=1.5)])
    assert sorted(round(float(np.mean(np.hypot(*line.T) ** 2)), 2) for line in ring.lines) == [0.5, 1.5]
    arcs = boundary(DISC, BOX, [Limit(name="r2", high=5.0)])
    assert len(arcs.lines) == 4
    assert not any(closed(line) for line in arcs.lines)
    np.testing.assert_allclose([np.abs(line[[0, -1]]).max(axis=1) for line in arcs.lines], 2.0)


def test_where_there_is_no_answer_the_boundary_is_found_by_halves():
    found = boundary(HOLE, BOX, [Limit(name="r", high=1.0)])
    (line,) = found.lines
    np.testing.assert_allclose(np.hypot(*line.T), 1.0, atol=2e-4)


def test_a_line_is_followed_beyond_what_the_first_grid_saw():
    """A thin strip through cells of which no corner lies in it is found from the one cell it is wide in."""
    strip = Formula.of(["x", "y"], {"d": lambda x, y: np.abs(y - 0.13) - np.where(x > 1.6, 0.4, 0.02)})
    found = boundary(strip, BOX, [Limit(name="d", high=0.0)], coarse=(8, 8), halvings=5)
    assert len(found.lines) == 2  # its upper and its lower side, from end to end
    assert all(line[:, 0].min() == -2.0 and line[:, 0].max() == 2.0 for line in found.lines)


@pytest.mark.parametrize("accuracy", [1.0, 0.01])
def test_the_zones_of_mathieus_equation(accuracy):
    """The lines are the characteristic values a_r(q), b_r(q), to the share of a cell that was asked for."""
    ask = Formula.of(["a", "q"], {"over": lambda a, q: np.abs(stability_map(a, q).half_trace) - 1.0})
    found = boundary(ask, [(-1.0, 5.0), (0.05, 3.0)], [Limit(name="over", high=0.0)], halvings=3, accuracy=accuracy)
    points = np.concatenate(found.lines)
    a, q = points.T
    curves = np.stack([*(mathieu_a(r, q) for r in range(4)), *(mathieu_b(r, q) for r in range(1, 4))])
    cell = 6.0 / 128
    # Both directions of an edge count, so that a share of a cell in q moves a by its slope, of the order of one.
    assert np.max(np.min(np.abs(curves - a), axis=0)) < (0.05 if accuracy < 1.0 else 0.6) * cell
    # All four boundaries inside of the box are there along their whole length.
    for curve in (mathieu_a(0, 1.0), mathieu_b(1, 1.0), mathieu_a(1, 1.0), mathieu_b(2, 1.0), mathieu_a(2, 1.0)):
        near = np.abs(q - 1.0) < 0.05
        assert np.min(np.abs(a[near] - curve)) < cell
    assert found.evaluations < found.grid / 2


@pytest.mark.slow
def test_a_drive_that_swings_itself_up():
    """The places asked and those of the map of stability agree; the line lies between them."""
    drive = example("unstable-drive")
    fields = "duty.speed_rpm", "joints[0].joint_angle_deg"
    box = [(1280.0, 1400.0), (10.0, 26.0)]
    found = boundary(evaluator(drive, fields, ["stability"]), box, LIMIT, coarse=(6, 2), halvings=0, accuracy=0.1)
    speeds, joint_angles = np.linspace(*box[0], 7), np.linspace(*box[1], 3)
    verdict = stability(drive, over=dict(zip(fields, (speeds, joint_angles), strict=True))).verdict
    np.testing.assert_array_equal(found.kept, (verdict == Verdict.STABLE).ravel())
    edge = np.concatenate(found.lines)[1:-1]
    rates = [float(stability(with_values(drive, dict(zip(fields, one, strict=True)))).growth_rate) for one in edge]
    # The rate rises to 3/s within the zone; a tenth of a cell of 20 rpm is left of it.
    assert np.max(np.abs(rates)) < 0.5


def test_it_may_be_stopped_and_gives_what_it_has():
    told = []

    def progress(share):
        told.append(share)
        return "stop" if len(told) > 12 else None

    found = boundary(DISC, BOX, [Limit(name="r2", high=1.0)], progress=progress)
    assert found.status == "cancelled"
    assert told == sorted(told)
    for line in found.lines:
        np.testing.assert_allclose(np.hypot(*line.T), 1.0, atol=0.1)
    first = boundary(DISC, BOX, [Limit(name="r2", high=1.0)], progress=lambda share: "stop")
    assert (first.status, first.lines) == ("cancelled", ())
    whole = []
    boundary(DISC, BOX, [Limit(name="r2", high=1.0)], progress=whole.append)
    assert 0.9 < whole[-1] <= 1.0


def test_without_a_boundary_there_is_no_line():
    assert boundary(DISC, BOX, [Limit(name="r2", high=100.0)]).lines == ()


def test_everything_wrong_is_told_at_once():
    with pytest.raises(InputError, match="no such column"):
        boundary(DISC, BOX, [Limit(name="z", high=1.0)])
    with pytest.raises(InputError) as refused:
        boundary(Formula.of(["x"], {"x": lambda x: x}), BOX[:1], [], halvings=20, accuracy=0.0)
    assert len(refused.value.problems) == 4
