"""All calculations by name, and the way in."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from cardan.errors import refuse
from cardan.reading.given import word
from cardan.texts import _
from cardan.units import nearest

from .calculation import Calculation, Formulas, Values
from .loads import assembly, forces, life, losses, strength
from .motion import accuracy, book, constant_velocity, couplings, instruments, kinematics, moving, practice, structure
from .vibration import bending, cracks, diagnosis, mathieu, simulation, straight_line, torsion

MOTION = (kinematics, moving, accuracy, couplings, constant_velocity, instruments, structure, book)
LOADS = (forces, losses, life, strength, assembly, practice)
VIBRATION = (torsion, simulation, straight_line, bending, cracks, diagnosis, mathieu)


@dataclass(frozen=True, kw_only=True, slots=True)
class Call(Calculation):
    """The calculation named under ``call`` with the rest of the inputs; the cases for bad input are written so."""

    def __call__(self, inputs: Mapping[str, Any]) -> dict[str, Any]:
        """Return the answer of the named calculation."""
        rest = {key: value for key, value in inputs.items() if key != "call"}
        return find(str(inputs.get("call", "")), field="call")(rest)


SUBJECTS = tuple(part.formula for part in (*MOTION, *LOADS, *VIBRATION))

other = Formulas("Any formula by its name.")


@other(
    "any other formula, by its name under call; its answer, or what is wrong with its inputs",
    "see the formula named",
    word("call", "name of the formula; its own keys follow"),
    kind=Call,
)
def _errors(v: Values) -> Any:
    return dict(v)


GROUPS = (*SUBJECTS, other)
"""The formulas by subject."""

CALCULATIONS: dict[str, Calculation] = {one.name: one for group in GROUPS for one in group.calculations}
"""Name of the capability -> its calculation."""


def find(capability: str, *, field: str = "capability") -> Calculation:
    """Return a calculation by its name.

    Raises
    ------
    InputError
        No calculation has this name; the message names the nearest.
    """
    if capability in CALCULATIONS:
        return CALCULATIONS[capability]
    near = nearest(str(capability), CALCULATIONS)
    text = _("there is no calculation named {given}; did you mean {near}?")
    if not near:
        text = _("there is no calculation named {given}; there are {names}")
    raise refuse(field, text.format(given=repr(capability), near=near, names=", ".join(sorted(CALCULATIONS))))


def calc(capability: str, inputs: Mapping[str, Any]) -> dict[str, Any]:
    """Return one calculation for inputs with unit keys.

    Parameters
    ----------
    capability : str
        A name of `CALCULATIONS`.
    inputs : mapping
        Key with unit -> number, list or table. Any unit of a key's dimension is read.

    Returns
    -------
    dict
        Key with unit -> number or list; what is undefined is None.

    Raises
    ------
    InputError
        With everything that is wrong, each under the key as it was given.

    See Also
    --------
    motion, forces, life

    Examples
    --------
    >>> from cardan import calc
    >>> calc("single_joint_extremes", {"alpha_deg": 20})["delta"]
    0.12448515
    """
    return find(capability)(inputs)
