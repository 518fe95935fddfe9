"""Data with their sources: materials, types and sizes of joints, norms, faults."""

from .catalogue import Catalogue, catalogue, known_to, material, with_files
from .completion import completed, filled, shortened
from .rows import TABLES

__all__ = ["TABLES", "Catalogue", "catalogue", "completed", "filled", "known_to", "material", "shortened", "with_files"]
