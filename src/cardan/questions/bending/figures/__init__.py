"""Figures of the results made beside this folder."""

from cardan.questions.bending.bending import CriticalSpeeds
from cardan.questions.bending.rotor_response import RotorResponse
from cardan.questions.bending.speed_map import CriticalSpeedMap

from .bending import bending_figures, speed_map_figures
from .rotor import rotor_figures

FIGURES = {CriticalSpeeds: bending_figures, CriticalSpeedMap: speed_map_figures, RotorResponse: rotor_figures}
"""Result -> what makes its figures."""
