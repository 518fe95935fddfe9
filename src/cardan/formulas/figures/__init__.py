"""Figures of the results made beside this folder."""

from cardan.formulas.absorber_tuning import Variants
from cardan.formulas.absorbers import AbsorberResponse
from cardan.formulas.joint_run_up import JointRunUp
from cardan.formulas.run_up import RunUp

from .absorbers import response_figures, variants_figures
from .run_up import joint_run_up_figures, run_up_figures

FIGURES = {
    AbsorberResponse: response_figures,
    Variants: variants_figures,
    RunUp: run_up_figures,
    JointRunUp: joint_run_up_figures,
}
"""Result -> what makes its figures."""
