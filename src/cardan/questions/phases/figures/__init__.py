"""Figures of the results made beside this folder."""

from cardan.questions.phases.layout import Layout
from cardan.questions.phases.phases import Phasing

from .layout import layout_figures
from .phases import phasing_figures

FIGURES = {Phasing: phasing_figures, Layout: layout_figures}
"""Result -> what makes its figures."""
