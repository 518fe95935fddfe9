"""Figures of the results made beside this folder."""

from cardan.batch.search.boundary import Boundary
from cardan.batch.search.optimise import Optimum
from cardan.batch.search.pareto import ParetoSet
from cardan.batch.search.sobol import OneAtATime, Sensitivity
from cardan.batch.table.views import Ranks

from .designs import (
    boundary_figure,
    one_at_a_time_figures,
    optimum_figure,
    pareto_set_figure,
    ranks_figure,
    sensitivity_figures,
)

FIGURES = {
    Sensitivity: sensitivity_figures,
    OneAtATime: one_at_a_time_figures,
    Ranks: ranks_figure,
    Boundary: boundary_figure,
    ParetoSet: pareto_set_figure,
    Optimum: optimum_figure,
}
"""Result -> what makes its figures."""
