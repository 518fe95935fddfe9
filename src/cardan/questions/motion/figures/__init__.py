"""Figures of the results made beside this folder."""

from cardan.questions.motion.articulation import Articulation
from cardan.questions.motion.equivalence import EquivalentJoint
from cardan.questions.motion.motion import Motion

from .articulation import articulation_figures
from .motion import equivalence_figures, motion_figures

FIGURES = {Motion: motion_figures, EquivalentJoint: equivalence_figures, Articulation: articulation_figures}
"""Result -> what makes its figures."""
