"""What a calculation is: a named question with unit keys, read and answered in SI by the formula below it.

One line a key: inputs are declared by `given` and its kin, outputs as ``"key: what it means"``, the unit in the key.

>>> from cardan.reading.given import given, positive
>>> formula = Formulas("levers")
>>> @formula("torque of a force on a lever", "statics", positive("F_N", "force"), given("r_mm", "arm"), "M_Nm: torque")
... def _lever(v: Values) -> Any:
...     return v.F * v.r
>>> formula.calculations[0]({"F_kN": 2, "r_mm": 300})
{'M_Nm': 600.0}
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, TypeAlias

import numpy as np

from cardan.errors import InputError, Problem, check
from cardan.reading.given import Given, Gives, gives
from cardan.reading.values import Values, read
from cardan.texts import _

__all__ = ["Calculation", "Formulas", "Problems", "Values"]

Problems: TypeAlias = Iterator[Problem]
"""What a check yields."""

PYTHON = {
    "joint_angle": ("alpha",),
    "plane_twist": ("beta", "beta2"),
    "yoke_angle": ("gamma", "gamma2"),
    "angle": ("phi1", "drive"),
    "deviation": ("alpha_std",),
    "times": ("t",),
    "time": ("t",),
    "end": ("t_max", "t_end"),
    "tolerance": ("closure_tolerance",),
    "constraints": ("pair_constraints",),
    "speed": ("mean_speed",),
    "torque": ("drive_torque",),
    "order": ("forcing_orders",),
    "shafts": ("spline_teeth",),
}
"""What the functions call an input -> its names here, where they differ."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Calculation:
    """A named question: which keys it takes, which it gives, and the formula that answers in SI.

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
        From values in SI by name to the outputs in SI: one value, all in their order, those that there are by key, or
        a thing that has them by the names declared, with the others by key; outputs that are None are left out.
    check : function
        Yields what is wrong with values taken together; sees only inputs that are right by themselves.
    module : str
        Where it is declared.
    """

    name: str
    doc: str
    source: str
    takes: tuple[Given, ...]
    returns: tuple[Gives, ...]
    answer: Callable[[Values], Any]
    check: Callable[[Values], Iterable[Problem]] = lambda _values: ()
    module: str = ""

    def __call__(self, inputs: Mapping[str, Any]) -> dict[str, Any]:
        """Return the outputs for inputs with unit keys."""
        values, problems = read(self.takes, inputs)
        check([*problems, *self.check(values)])
        try:
            found = self._by_key(self.answer(values))
        except InputError as error:
            raise error.renamed(lambda name: _named(name, values.spelled)) from None
        there = [one for one in self.returns if found.get(one.key) is not None]
        return {one.key: _plain(found[one.key], one.factor) for one in there}

    def meaning(self, key: str) -> str:
        """Return what an output means, in the language spoken; nothing of one that is not declared."""
        return next((_(one.doc) for one in self.returns if one.key == key), "")

    def _by_key(self, found: Any) -> Any:
        """Return what the formula found by the keys of the outputs."""
        keys = [one.key for one in self.returns]
        if isinstance(found, dict) and found.keys() <= set(keys):
            return found
        if any(one.of for one in self.returns):
            found, more = found if isinstance(found, tuple) and isinstance(found[-1], dict) else (found, {})
            assert more.keys() <= set(keys)
            own = [one for one in self.returns if one.of or hasattr(found, one.key)]
            return {one.key: getattr(found, one.of or one.key) for one in own} | more
        return dict(zip(keys, (found,) if len(keys) == 1 else found, strict=True))


@dataclass(frozen=True, slots=True)
class Formulas:
    """The formulas of one subject; called, it declares another one: what it answers, its source, one line a key."""

    subject: str
    calculations: list[Calculation] = field(default_factory=list)

    @property
    def title(self) -> str:
        """What it is about, in a few words; the subject is the first line of a module."""
        return self.subject.partition(":")[0].removesuffix(".")

    def __call__(
        self, doc: str, source: str, *keys: Given | Gives | str | tuple[Any, ...], kind: Any = Calculation, **more: Any
    ) -> Callable[[Callable[[Values], Any]], Callable[[Values], Any]]:
        """Return what declares the function below it, which has the name of the formula behind an underscore."""
        every = [one if isinstance(one, Given | Gives) else gives(*one.split(": ", 1)) for one in _flat(keys)]
        takes = tuple(one for one in every if isinstance(one, Given))
        returns = tuple(one for one in every if isinstance(one, Gives))

        def declare(answer: Callable[[Values], Any]) -> Callable[[Values], Any]:
            name, module = answer.__name__.removeprefix("_"), answer.__module__
            about = {"name": name, "doc": doc, "source": source, "module": module}
            self.calculations.append(kind(**about, takes=takes, returns=returns, answer=answer, **more))
            return answer

        return declare


def _flat(keys: Iterable[Any]) -> Iterator[Any]:
    for one in keys:
        yield from _flat(one) if isinstance(one, tuple) else (one,)


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
