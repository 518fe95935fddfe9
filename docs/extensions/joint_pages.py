"""What the pages of the kinds of joints show of the program itself, and the table that compares them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from cardan.units import deg, rpm

FOLDER = Path(__file__).parents[1] / "joints"

GROOVES = "driving_offset_mm = 4\ndriven_offset_mm = 4\ngroove_radius_mm = 30"
"""Sizes of a Rzeppa joint of which loads are told; with its lever alone they are not."""

NAMED = {
    "hooke": "its journals in both yokes, with the needles of the most loaded one; `friction` and `cross` tell its "
    "losses, `needles` or `size` its life",
    "half_cardan": "its faces, of the one pair that carries or of all pairs that share the torque",
    "elastic_half_cardan": "couple and forces by its stiffness against joint angle and shifts, and its wind-up",
    "mechanism": "every pair of its file",
}
"""What is loaded in kinds that are not told by the pairs of their own."""

RIGHT = 89.9 * deg
"""Joint angle [rad] beyond which a kind has no limit of its own."""

TELL = (
    "With `friction`, its losses follow from",
    "Its contact pressure by Hertz is a check with",
    "Its life by ISO 281 follows from",
)
"""What sizes of a joint tell: what rubs in it, the pressure of its balls or rollers, the life of its bearings."""


def pages() -> dict[str, str]:
    """Return what is shown of each kind, and the table of all of them, by the name of the file."""
    from cardan.drive.joints import JOINTS
    from cardan.io.drive_file import loads
    from tests.fixtures.joint_keys import KEYS

    keys = KEYS | {"rzeppa": GROOVES}
    text = "format = 1\n[[joints]]\njoint_angle_deg = 10\n"
    made = {kind: loads(f'{text}kind = "{kind}"\n{keys[kind]}\n').joints[0] for kind in JOINTS}
    found = {"joint-kinds.md": kinds(made)}
    for kind, joint in made.items():
        for what, told in (("keys", _keys(kind)), ("loads", _loads(kind, joint)), ("limits", _limits(kind, joint))):
            found[f"joint-{hyphened(kind)}-{what}.md"] = told + "\n"
    return found


def hyphened(kind: str) -> str:
    """Return the name of the page of a kind."""
    return kind.replace("_", "-")


def kinds(made: dict[str, Any]) -> str:
    """Return the table that compares the kinds, with what each page says of its own at its head."""
    lines = ["| joint | `kind` | turns by | its keys say | joint angle to |", "|---|---|---|---|---|"]
    for kind, joint in made.items():
        name = f"{hyphened(kind)}.md"
        text = (FOLDER / name).read_text(encoding="utf-8")
        turns, sizes = (re.search(rf'^{word}: "(.*)"$', text, re.M)[1] for word in ("turns", "sizes"))  # type: ignore
        title, picture = (re.search(rf"^{sign}(.*)$", text, re.M)[1] for sign in ("# ", "!"))  # type: ignore
        cells = (f"[!{picture}](joints/{name}) [{title}](joints/{name})", f"`{kind}`", turns, sizes, _steepest(joint))
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def _steepest(joint: Any) -> str:
    return f"{joint.steepest / deg:.3g}°" if joint.steepest < RIGHT else "by its sizes"


def _keys(kind: str) -> str:
    """Return where the keys of a kind stand."""
    return f'In a [drive file](../reference/drive-file.md#joints-with-kind-{hyphened(kind)}): `kind = "{kind}"`.'


def _loads(kind: str, joint: Any) -> str:
    """Return what a joint of a kind carries, and which sizes tell it."""
    import numpy as np

    from cardan.questions.motion.joint_mechanism import joint_carried

    carried = joint_carried(joint, 0.1, np.asarray([0.3])).pairs
    told = [one.name for one in carried if "{number}" in one.name and one.name != "joint {number}"]
    parts = dict.fromkeys(name.replace(" of joint {number}", "").replace(" {count}", "") for name in told)
    named = NAMED.get(kind, ", ".join(parts) or "its couple alone")
    lines = [f"`cardan forces` tells: {named}."]
    sizes = zip(TELL, (joint.rubbing, joint.pressed, joint.rated), strict=True)
    lines += [f"{what} {', '.join(f'`{one}`' for one in names)}." for what, names in sizes if names]
    for answer, why in (("No losses are told", joint.refusal("losses")), ("No life is told", joint.refusal("life"))):
        lines += [f"{answer}: {why}."] if why else []
    return " ".join(lines)


def _limits(kind: str, joint: Any) -> str:
    """Return how far a kind bends, and its types in the catalogue with their limits."""
    steep = f"Above {joint.steepest / deg:.3g}° none of the kind works, which is checked whatever its type."
    if joint.steepest >= RIGHT:
        steep = "It bends as far as its sizes let it turn."
    rows = list(_types(kind))
    head = [
        "| type of the catalogue | uniform | joint angle to | torque to | speed times joint angle |",
        "|---|---|---|---|---|",
    ]
    return "\n".join([steep, "", *head, *rows]) if rows else steep


def _types(kind: str) -> Iterator[str]:
    """Yield the types of joints that turn by the law of a kind, a row each; a dash where their source says nothing."""
    from cardan.questions.motion.joint_law import types_of

    for row in types_of(kind):
        torque = "–" if row.max_torque is None else f"{row.max_torque:,.10g} N·m".replace(",", "\u202f")
        joint_angle = "–" if row.max_joint_angle is None else f"{row.max_joint_angle / deg:.3g}°"
        fast = "–" if row.max_speed_angle is None else f"{row.max_speed_angle / (rpm * deg):,.0f} rpm·°"
        even = "as a pair" if row.synchronous_as_pair else row.synchronous
        yield "| " + " | ".join((row.name, even, joint_angle, torque, fast.replace(",", "\u202f"))) + " |"
