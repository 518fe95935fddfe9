"""Figures of the results made beside this folder."""

from cardan.questions.diagnosis.examination import Examination
from cardan.questions.diagnosis.expected import Expected
from cardan.questions.diagnosis.signals.orbit import Orbit
from cardan.questions.diagnosis.signals.order_tracks import TrackedOrders
from cardan.questions.diagnosis.signals.orders import OrderMap, OrderSpectrum
from cardan.questions.diagnosis.signals.rotation import Rotation
from cardan.questions.diagnosis.signals.torsional import TorsionalVibration

from .examination import examination_figures
from .expected import expected_figures
from .motion import orbit_figures, rotation_figures, torsional_figures
from .orders import map_figures, spectrum_figures, tracks_figures

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
