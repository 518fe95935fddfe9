"""Figures of the results made beside this folder."""

from cardan.questions.diagnosis.examination import Examination
from cardan.questions.diagnosis.expected import Expected
from cardan.questions.diagnosis.signals.orbit import Orbit
from cardan.questions.diagnosis.signals.orders import OrderMap, OrderSpectrum, TrackedOrders
from cardan.questions.diagnosis.signals.rotation import Rotation
from cardan.questions.diagnosis.signals.torsional import TorsionalVibration

from .orders import expected_figure, map_figure, spectrum_figure, tracks_figure
from .signals import examination_figures, orbit_figure, rotation_figure, torsional_figure

FIGURES = {
    OrderSpectrum: spectrum_figure,
    OrderMap: map_figure,
    TrackedOrders: tracks_figure,
    Rotation: rotation_figure,
    Orbit: orbit_figure,
    TorsionalVibration: torsional_figure,
    Examination: examination_figures,
    Expected: expected_figure,
}
"""Result -> what makes its figures."""
