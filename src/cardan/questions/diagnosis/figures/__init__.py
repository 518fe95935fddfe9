"""Figures of the results made beside this folder."""

from cardan.questions.diagnosis.examination import Examination
from cardan.questions.diagnosis.expected import Expected
from cardan.questions.diagnosis.signals.orbit import Orbit
from cardan.questions.diagnosis.signals.orders import OrderMap, OrderSpectrum, TrackedOrders
from cardan.questions.diagnosis.signals.rotation import Rotation
from cardan.questions.diagnosis.signals.torsional import TorsionalVibration

from .orders import expected_figures, map_figures, spectrum_figures, tracks_figures
from .signals import examination_figures, orbit_figures, rotation_figures, torsional_figures

FIGURES = {
    OrderSpectrum: spectrum_figures,
    OrderMap: map_figures,
    TrackedOrders: tracks_figures,
    Rotation: rotation_figures,
    Orbit: orbit_figures,
    TorsionalVibration: torsional_figures,
    Examination: examination_figures,
    Expected: expected_figures,
}
"""Result -> what makes its figures."""
