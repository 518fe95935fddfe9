"""Commands, kinds of joints, checks, keys, formulas and examples by the words of the trade and their synonyms."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from cardan.calc import CALCULATIONS
from cardan.checks import CHECKS
from cardan.cli.app import commands
from cardan.drive.joints import JOINTS
from cardan.io.examples import about, example_names
from cardan.io.keys import file_keys
from cardan.texts import _
from cardan.units import nearest

SYNONYMS = (
    ("joint angle", "operating angle", "deflection angle", "working angle", "bend", "bend angle"),
    (
        "speed fluctuation",
        "non-uniformity",
        "nonuniformity",
        "irregularity",
        "velocity fluctuation",
        "unevenness",
        "non-uniformity U",
    ),
    ("phasing", "phase", "clocking", "in phase", "out of phase", "yoke angle", "yoke lead", "phases"),
    ("uniform", "homokinetic", "constant velocity", "constant-velocity", "synchronous"),
    ("strength", "stress", "safety", "fatigue", "rating", "overload"),
    ("life", "wear", "bearing life", "l10", "durability", "hours", "equivalent torque"),
    (
        "bending",
        "critical speed",
        "critical",
        "whirl",
        "whirling",
        "whipping",
        "resonance",
        "bending mode",
        "bounce mode",
    ),
    (
        "torsion",
        "torsional vibration",
        "natural frequency",
        "campbell",
        "campbell diagram",
        "modal inertia",
        "resonance",
        "nvh",
        "vibration",
        "order",
        "1×",
        "2×",
    ),
    ("stability", "parametric", "floquet", "mathieu", "instability", "parametric instability"),
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
    ("double_cardan", "wide angle", "wide angle joint", "double joint"),
    ("pto", "power take off", "pto shaft", "tractor", "sprayer", "implement", "baler"),
    ("profile", "profile tube", "star tube", "lemon tube", "triangle tube"),
    ("flexible coupling", "giubo", "flex disc", "rubber coupling", "elastic_half_cardan"),
    ("rzeppa", "cv joint", "ball joint", "constant velocity joint", "ball track", "track offset"),
    ("spline", "slip yoke", "length compensation", "slip", "telescope", "telescopic shaft", "sliding shaft"),
    (
        "shafts",
        "propshaft",
        "driveshaft",
        "drive shaft",
        "propeller shaft",
        "cardan shaft",
        "driveline",
        "intermediate shaft",
    ),
    ("diagnose", "shake", "noise", "symptom", "fault", "vibration"),
    ("plane_twist", "spatial offset angle", "compound angle"),
    ("start_phase", "initial yoke position", "yoke rotation angle"),
    ("shock_factor", "service factor", "application factor"),
    ("static_capacity", "static safety"),
    ("check", "verdict", "utilisation", "governing", "margin", "limit"),
    ("remedy", "cure", "corrective", "fix", "improve"),
    ("select", "choose", "joint type", "size", "catalogue"),
)
"""Words that mean the same, the word of the program first."""


class Find(NamedTuple):
    """Something that a word leads to."""

    sort: str  # ``command``, ``kind``, ``check``, ``key``, ``formula`` or ``example``
    name: str
    meaning: str


def finds(word: str) -> list[Find]:
    """Return what a word leads to, names that it is first, then names it is in, then meanings.

    Where several words lead nowhere together, what has all of them does.

    >>> [one.name for one in finds("stress") if one.sort == "command"]
    ['strength']
    >>> [one.name for one in finds("wide-angle joint") if one.sort == "kind"]
    ['double_cardan']
    """
    wanted = _plain(word)
    words = [wanted, *(_plain(other) for same in SYNONYMS if wanted in map(_plain, same) for other in same)]
    every = list(_everything())
    scored = [(min(_rank(term, one) for term in words), k, one) for k, one in enumerate(every)]
    found = [one for rank, _k, one in sorted(scored, key=lambda entry: entry[:2]) if rank < MISSED]
    return found or [
        one for one in every if all(part in _plain(f"{one.name} {one.meaning}") for part in wanted.split())
    ]


def _plain(text: str) -> str:
    """Return a word or a text as it is looked for: small letters, and no hyphens."""
    return text.strip().casefold().replace("-", " ").replace("_", " ")


def commands_for(word: str) -> list[str]:
    """Return the commands that a word of the trade, or the word nearest to a misspelt one, leads to: at most three."""
    found = [one.name for one in finds(word) if one.sort == "command"][:3]
    near = "" if found else nearest(word.casefold(), [*commands(), *(term for same in SYNONYMS for term in same)])
    return commands_for(near) if near else found


MISSED = 4


def _rank(term: str, one: Find) -> int:
    """Return how near a term is to a name or its meaning: 0 it is the name, to `MISSED`."""
    name = _plain(one.name)
    if term == name:
        return 0
    if term in name.split() or term in name.split("."):
        return 1
    if term in name:
        return 2
    return 3 if term in _plain(one.meaning) else MISSED


def _everything() -> Iterator[Find]:
    """Yield all that can be found."""
    yield from _commands()
    yield from (Find("kind", name, _((kind.__doc__ or "").strip().splitlines()[0])) for name, kind in JOINTS.items())
    yield from (Find("check", one.name, _(one.doc)) for one in CHECKS.values())
    yield from (Find("key", one.path, one.meaning) for one in file_keys())
    yield from (Find("formula", one.name, _(one.doc)) for one in CALCULATIONS.values())
    yield from (Find("example", name, about(name)) for name in example_names())


def _commands() -> Iterator[Find]:
    """Yield the commands, those of groups by both words."""
    for name, entry in commands().items():
        if entry.module:
            yield Find("command", name, entry.help)
        yield from (Find("command", f"{name} {second}", inner.help) for second, inner in entry.entries.items())
