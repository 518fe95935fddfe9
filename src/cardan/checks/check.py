"""What a check is: a name, a sentence, and a function from a design to verdicts."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from .design import Design
from .verdict import Verdict


@dataclass(frozen=True, kw_only=True)
class Check:
    """A check.

    Attributes
    ----------
    name : str
        Its name in `CHECKS`.
    doc : str
        One sentence on what it judges.
    judge : function
        From a design to its verdicts; a verdict that lacks data names the paths that are missing.
    """

    name: str
    doc: str
    judge: Callable[[Design], Iterable[Verdict]]
