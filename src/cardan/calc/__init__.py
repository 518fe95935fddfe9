"""Every capability by name, with unit keys: one file for each part, the names in `CALCULATIONS`.

An entry translates names, units, signs and origins; the formula is in the function it calls.
"""

from .calculation import Calculation, Given, Gives
from .calculations import CALCULATIONS, calc, find

__all__ = ["CALCULATIONS", "Calculation", "Given", "Gives", "calc", "find"]
