"""Kinds of joints: one file each, and its name in `JOINTS`."""

from .hooke import Hooke
from .joint import Joint

JOINTS: dict[str, type[Joint]] = {kind.kind: kind for kind in (Hooke,)}
"""Value of the file key ``kind`` -> class."""

__all__ = ["JOINTS", "Hooke", "Joint"]
