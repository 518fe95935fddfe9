"""Figures of the results made beside this folder."""

from cardan.formulas.absorbers import AbsorberResponse, Variants
from cardan.formulas.figure import joint_run_up_figures, response_figures, run_up_figures, variants_figures
from cardan.formulas.run_up import JointRunUp, RunUp

FIGURES = {
    AbsorberResponse: response_figures,
    Variants: variants_figures,
    RunUp: run_up_figures,
    JointRunUp: joint_run_up_figures,
}
"""Result -> what makes its figures."""
