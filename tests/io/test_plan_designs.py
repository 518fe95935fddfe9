"""Designs of plan files: read whole or refused whole, and run to what is known."""

import numpy as np
import pytest

from cardan.batch.search.boundary import Boundary
from cardan.batch.search.optimise import Optimum
from cardan.batch.search.pareto import ParetoSet
from cardan.batch.search.sobol import Sensitivity
from cardan.errors import InputError
from cardan.io.plan_designs import design_of
from cardan.io.plan_file import plan_of, read_plan
from tests.cli.conftest import EXAMPLES

SWEEPS = EXAMPLES / "sweeps"
HEAD = 'format = 1\ndrive = "single-20deg.toml"\nask = ["speed_fluctuation", "greatest_joint_angle"]\n'


def read(text, name):
    plan = plan_of(HEAD + text, folder=EXAMPLES)
    assert list(plan.parts) == [name]
    return design_of(plan, name)


def test_words_have_no_range_to_search():
    with pytest.raises(InputError) as error:
        read('[search]\ngoals = ["min speed_fluctuation_percent"]\nbetween = { "joints[0].size" = [0, 1] }\n', "search")
    assert [one.field for one in error.value.problems] == ['search.between."joints[0].size"']


def test_a_search_for_one_goal():
    """A single joint is as even as it is straight; the constraint keeps it from that."""
    design = read(
        'constraints = ["greatest_joint_angle_deg >= 5"]\n[search]\ngoals = ["min speed_fluctuation_percent"]\n'
        'between = { "joints[0].joint_angle_deg" = [0, 30] }\n',
        "search",
    )
    assert design.start == (20.0,)
    found = design.run()
    assert isinstance(found, Optimum)
    assert found.point == pytest.approx(5.0, abs=1e-3)
    other = read(
        '[search]\ngoals = ["max speed_fluctuation_percent"]\nmethod = "global"\n'
        "generations = 5\nseed = 4\nlimits = []\n"
        'between = { "joints[0].joint_angle_deg" = [25, 30] }\n',
        "search",
    )
    assert other.run().point == pytest.approx(30.0, abs=1e-4)
    start = read(
        '[search]\ngoals = ["min speed_fluctuation_percent"]\nstart = { "joints[0].joint_angle_deg" = 3 }\n'
        'between = { "joints[0].joint_angle_deg" = [1, 30] }\n',
        "search",
    )
    assert start.start == (3.0,)


def test_a_search_for_several_goals():
    found = read(
        '[search]\ngoals = ["min speed_fluctuation_percent", "max greatest_joint_angle_deg"]\n'
        "population = 8\ngenerations = 3\n"
        'between = { "joints[0].joint_angle_deg" = [0, 30] }\n',
        "search",
    ).run()
    assert isinstance(found, ParetoSet)
    # The more bent, the more uneven: every joint angle is a choice.
    assert len(found.points) == len(np.unique(found.points))


def test_a_boundary_of_a_single_joint():
    """δ = sin α tan α = 0.1 at 18.03°, whatever the speed."""
    found = read(
        '[boundary]\nlimits = ["speed_fluctuation_percent <= 10"]\ncoarse = [4, 2]\nhalvings = 1\n'
        'between = { "joints[0].joint_angle_deg" = [5, 30], "duty.speed_rpm" = [500, 1000] }\n',
        "boundary",
    ).run()
    assert isinstance(found, Boundary)
    (line,) = found.lines
    joint_angle = np.radians(line[:, 0])
    np.testing.assert_allclose(np.sin(joint_angle) * np.tan(joint_angle), 0.1, rtol=2e-3)


def test_a_sensitivity_takes_the_distributions_that_are_drawn():
    design = read(
        '[[vary]]\ndesign = "lhs"\ncount = 10\n'
        'fields = [{ key = "joints[0].joint_angle_deg", distribution = "uniform", '
        'plus_minus = 1 }, { key = "duty.speed_rpm", distribution = "uniform", low = 500, high = 900 }]\n'
        '[sensitivity]\nsamples = 64\nanswers = ["speed_fluctuation_percent"]\n',
        "sensitivity",
    )
    found = design.run()
    assert isinstance(found, Sensitivity)
    np.testing.assert_allclose(found.total[0], [1.0, 0.0], atol=0.2)


@pytest.mark.parametrize(
    ("text", "name", "said"),
    [
        ("[search]\n", "search", ["search.goals: missing", "search.between: missing"]),
        (
            '[search]\ngoals = ["speed_fluctuation"]\nlimits = ["x"]\nmethod = "swarm"\nbetwen = 1\n'
            'between = { "joints[0].joint_angle_deg" = [3, 1] }\n',
            "search",
            [
                "search.goals[0]: not a goal: 'speed_fluctuation'",
                "search.limits[0]: not a limit: 'x'",
                "search.method: 'swarm'",
                "search.betwen: unknown key; the nearest known one is between",
                "two numbers are needed, the lower one first",
            ],
        ),
        (
            '[search]\ngoals = ["min life_h"]\nbetween = { "joints[0].bent_deg" = [1, 3] }\n',
            "search",
            ["joints[0].bent_deg: there is no such field"],
        ),
        (
            '[search]\ngoals = ["min life_h"]\nbetween = { "joints[0].joint_angle_deg" = [1, 3] }\n',
            "search",
            ["search: goals: min life_h: there is no such column"],
        ),
        ("[sensitivity]\n", "sensitivity", ["needs a [[vary]] with design"]),
        (
            '[boundary]\ncoarse = [2]\nbetween = { "joints[0].joint_angle_deg" = [1, 3] }\n',
            "boundary",
            ["boundary.coarse: two whole numbers", "boundary.between: a boundary lies over two fields"],
        ),
    ],
)
def test_everything_wrong_is_told_with_its_path(text, name, said):
    with pytest.raises(InputError) as refused:
        read(text, name)
    for one in said:
        assert one in str(refused.value)


@pytest.mark.parametrize("path", sorted(SWEEPS.glob("*.toml")), ids=lambda path: path.stem)
def test_designs_of_shipped_plans_are_ready_to_run(path):
    plan = read_plan(path)
    for name in plan.parts:
        design = design_of(plan, name)
        assert design.ask.points
        assert design.ask.answers
