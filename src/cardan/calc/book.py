"""Calculations: book."""

from .calculation import Calculation

CALCULATIONS: tuple[Calculation, ...] = ()
