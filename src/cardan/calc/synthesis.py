"""Calculations: synthesis."""

from .calculation import Calculation

CALCULATIONS: tuple[Calculation, ...] = ()
