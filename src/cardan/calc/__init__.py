"""Every capability by name, with unit keys: one file for each part, the names in `CALCULATIONS`.

An entry translates names, units, signs and origins; the formula is in the function it calls.
"""

from cardan.reading.given import Given, Gives

from .calculation import Calculation
from .calculations import CALCULATIONS, GROUPS, calc, find

__all__ = ["CALCULATIONS", "GROUPS", "Calculation", "Given", "Gives", "calc", "find"]
