"""Figures: a library-neutral description made from a result, and renderers that draw any of them."""

from cardan.drive.drive import Drive
from cardan.later import later

drives = later("cardan.figures.drive")

FIGURES = {Drive: lambda drive: drives().drive_figures(drive)}
"""Sort of result -> what makes its figures; a folder of results has such a table in `figure` or `figures` beside it."""
