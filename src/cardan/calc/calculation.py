"""What a calculation is: a named question with unit keys, read and answered in SI by the function below it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from cardan.errors import InputError, Problem, check

from .keys import Given, Gives, Values, at_least_zero, given, gives, positive, record, rows
from .reading import read

__all__ = [
    "Calculation",
    "Given",
    "Gives",
    "Values",
    "at_least_zero",
    "given",
    "gives",
    "positive",
    "record",
    "rows",
]

PYTHON = {
    "joint_angle": ("alpha",),
    "plane_twist": ("beta", "beta2"),
    "yoke_angle": ("gamma", "gamma2"),
    "angle": ("phi1",),
    "deviation": ("alpha_std",),
    "times": ("t",),
    "time": ("t",),
    "end": ("t_max",),
    "shafts": ("spline_teeth",),
}
"""What the functions call an input -> its names here, where they differ."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Calculation:
    """A named question: which keys it takes, which it gives, and the function that answers in SI.

    Attributes
    ----------
    name : str
        Name of the capability.
    doc : str
        What it computes, one sentence.
    source : str
        Where the method stands.
    takes : tuple of Given
        Inputs.
    returns : tuple of Gives
        Outputs that may occur.
    answer : function
        From values in SI by name to outputs in SI by key; outputs that are None are left out.
    check : function
        Yields what is wrong with values taken together; sees only inputs that are right by themselves.
    """

    name: str
    doc: str
    source: str
    takes: tuple[Given, ...]
    returns: tuple[Gives, ...]
    answer: Callable[[Values], Values]
    check: Callable[[Values, Callable[[str], str]], Iterable[Problem]] = lambda _values, _key: ()

    def __call__(self, inputs: Mapping[str, Any]) -> Values:
        """Return the outputs for inputs with unit keys.

        Raises
        ------
        InputError
            With everything that is wrong, each problem under the key as it was given.
        """
        values, keys = self.read(inputs)
        try:
            found = self.answer(values)
        except InputError as error:
            raise error.renamed(lambda field: _named(field, keys)) from None
        known = {output.key: output for output in self.returns}
        return {key: _plain(value, known[key].factor) for key, value in found.items() if value is not None}

    def read(self, inputs: Mapping[str, Any]) -> tuple[Values, dict[str, str]]:
        """Return the values in SI by name, and under which key each was given."""
        values, keys, problems = read(self.takes, inputs)
        problems += self.check(values, lambda name: keys[name])
        check(problems)
        return values, keys


def _named(field: str, keys: Mapping[str, str]) -> str:
    """Return a field named in Python as the key it was given under."""
    inside = [name for name in keys if "." in name and (field == name or field.startswith(f"{name}["))]
    if inside:
        return keys[inside[0]] + field.removeprefix(inside[0])
    name, bracket, rest = field.partition("[")
    own = [keys[one] for one in (name, *PYTHON.get(name, ())) if one in keys]
    return (own[0] if own else name) + bracket + rest


def _plain(value: Any, scale: float) -> Any:
    """Return arrays in SI as nested lists of numbers in the output's unit; what is undefined as None."""
    if isinstance(value, dict):
        return {name: _plain(entry, scale) for name, entry in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(entry, scale) for entry in value]
    if isinstance(value, np.ndarray | np.generic):
        return _plain(value.tolist(), scale)
    if isinstance(value, bool | str) or value is None:
        return value
    if isinstance(value, int):
        return value if scale == 1.0 else value / scale
    return None if math.isnan(value) else float(value) / scale
