"""Figures of the results made beside this folder."""

from cardan.questions.bending.bending import CriticalSpeedMap, CriticalSpeeds
from cardan.questions.bending.figure import bending_figures, rotor_figures, speed_map_figures
from cardan.questions.bending.rotor import RotorResponse

FIGURES = {CriticalSpeeds: bending_figures, CriticalSpeedMap: speed_map_figures, RotorResponse: rotor_figures}
"""Result -> what makes its figures."""
