"""Figures of the results made beside this folder."""

from cardan.questions.forces.assembly import AssemblyForces
from cardan.questions.forces.forces import Forces
from cardan.questions.forces.moving_forces import MovingForces

from .assembly import misalignment_figures
from .forces import forces_figures
from .moving_forces import moving_forces_figures

FIGURES = {Forces: forces_figures, MovingForces: moving_forces_figures, AssemblyForces: misalignment_figures}
"""Result -> what makes its figures."""
