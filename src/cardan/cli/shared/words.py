"""Commands, kinds of joints, checks, keys and formulas by the words of the trade and their synonyms."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from cardan.calc import CALCULATIONS
from cardan.checks import CHECKS
from cardan.cli.app import commands
from cardan.drive.joints import JOINTS
from cardan.io.keys import file_keys
from cardan.texts import _
from cardan.units import nearest

SYNONYMS = (
    ("joint angle", "operating angle", "deflection angle", "working angle"),
    ("speed fluctuation", "non-uniformity", "nonuniformity", "irregularity", "velocity fluctuation", "unevenness"),
    ("phasing", "phase", "clocking", "in phase", "out of phase", "yoke angle", "phases"),
    ("uniform", "homokinetic", "constant velocity", "constant-velocity", "synchronous"),
    ("strength", "stress", "safety", "fatigue", "rating", "overload"),
    ("life", "wear", "bearing life", "l10", "durability", "hours"),
    ("bending", "critical speed", "critical", "whirl", "whirling", "whipping", "resonance"),
    ("torsion", "torsional vibration", "natural frequency", "campbell", "resonance", "nvh", "vibration", "order"),
    ("stability", "parametric", "floquet", "mathieu", "instability"),
    ("absorber", "damper", "pendulum", "tmd"),
    ("balance", "unbalance", "imbalance", "g16", "iso 21940"),
    ("losses", "power loss", "efficiency", "friction", "heat"),
    ("forces", "bearing load", "support", "reaction", "secondary couple", "secondary moment", "centre bearing"),
    ("assembly", "misalignment", "overconstrained", "redundant", "statically indeterminate", "constraint"),
    ("mobility", "degree of freedom", "dof", "gruebler", "grubler", "kinematic pair"),
    ("articulation", "suspension travel", "steering", "hitch", "spline travel", "plunge", "movement"),
    ("accuracy", "tolerance", "runout", "manufacturing error", "backlash", "play", "clearance"),
    ("hooke", "u-joint", "universal joint", "cardan joint", "uj"),
    ("cross", "spider", "trunnion", "journal cross"),
    ("flexible coupling", "giubo", "flex disc", "rubber coupling", "elastic_half_cardan"),
    ("rzeppa", "cv joint", "ball joint", "constant velocity joint"),
    ("spline", "slip yoke", "length compensation", "slip"),
    ("diagnose", "shake", "noise", "symptom", "fault", "vibration"),
    ("remedy", "cure", "corrective", "fix", "improve"),
    ("select", "choose", "joint type", "size", "catalogue"),
)
"""Words that mean the same, the word of the program first."""


class Find(NamedTuple):
    """Something that a word leads to."""

    sort: str  # ``command``, ``kind``, ``check``, ``key`` or ``formula``
    name: str
    meaning: str


def finds(word: str) -> list[Find]:
    """Return what a word leads to, names that it is first, then names it is in, then meanings.

    >>> [one.name for one in finds("stress") if one.sort == "command"]
    ['strength']
    """
    wanted = word.strip().casefold()
    words = [wanted, *(other for same in SYNONYMS if wanted in same for other in same)]
    scored = [(min(_rank(term, one) for term in words), k, one) for k, one in enumerate(_everything())]
    return [one for rank, _k, one in sorted(scored, key=lambda entry: entry[:2]) if rank < MISSED]


def commands_for(word: str) -> list[str]:
    """Return the commands that a word of the trade, or the word nearest to a misspelt one, leads to: at most three."""
    found = [one.name for one in finds(word) if one.sort == "command"][:3]
    near = "" if found else nearest(word.casefold(), [*commands(), *(term for same in SYNONYMS for term in same)])
    return commands_for(near) if near else found


MISSED = 4


def _rank(term: str, one: Find) -> int:
    """Return how near a term is to a name or its meaning: 0 it is the name, to `MISSED`."""
    name = one.name.casefold().replace("_", " ")
    if term in (name, one.name.casefold()):
        return 0
    if term in name.split() or term in name.split("."):
        return 1
    if term in name:
        return 2
    return 3 if term in one.meaning.casefold() else MISSED


def _everything() -> Iterator[Find]:
    """Yield all that can be found."""
    yield from _commands()
    yield from (Find("kind", name, _((kind.__doc__ or "").strip().splitlines()[0])) for name, kind in JOINTS.items())
    yield from (Find("check", one.name, _(one.doc)) for one in CHECKS.values())
    yield from (Find("key", one.path, one.meaning) for one in file_keys())
    yield from (Find("formula", one.name, _(one.doc)) for one in CALCULATIONS.values())


def _commands() -> Iterator[Find]:
    """Yield the commands, those of groups by both words."""
    for name, entry in commands().items():
        if entry.module:
            yield Find("command", name, entry.help)
        yield from (Find("command", f"{name} {second}", inner.help) for second, inner in entry.entries.items())
