"""Figures of the results made beside this folder, but for the motion itself."""

from cardan.questions.motion.articulation import Articulation

from .articulation import articulation_figures

FIGURES = {Articulation: articulation_figures}
"""Result -> what makes its figures."""
