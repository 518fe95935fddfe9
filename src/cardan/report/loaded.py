"""The parts of the report about a drive under load and as made: each only where the drive file says enough."""

from __future__ import annotations

from collections.abc import Iterator

from .accuracy import erring
from .assembly import straining
from .bending import whirling
from .block import Page
from .forces import carrying
from .life import lasting
from .losses import rubbing
from .mobility import binding
from .rotor import whirling_cracked
from .run_up import running_up
from .strength import bearing_up
from .subject import Subject
from .torsion import twisting

PAGES = (
    carrying,
    rubbing,
    bearing_up,
    lasting,
    erring,
    binding,
    straining,
    twisting,
    running_up,
    whirling,
    whirling_cracked,
)
"""What makes each part, in the order of the report; None where the drive file does not ask for it."""


def loaded(on: Subject) -> Iterator[Page]:
    """Yield the parts that the drive file asks for; none once the reader stopped the work."""
    for made in PAGES if on.complete else ():
        page = made(on)
        if page is not None:
            yield page
