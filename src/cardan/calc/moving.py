"""Calculations: moving."""

from .calculation import Calculation

CALCULATIONS: tuple[Calculation, ...] = ()
