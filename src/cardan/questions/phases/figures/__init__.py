"""Figures of the results made beside this folder."""

from cardan.questions.phases.figure import layout_figures, phasing_figures
from cardan.questions.phases.layout import Layout
from cardan.questions.phases.phases import Phasing

FIGURES = {Phasing: phasing_figures, Layout: layout_figures}
"""Result -> what makes its figures."""
