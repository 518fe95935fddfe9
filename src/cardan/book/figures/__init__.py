"""Figures of the results made beside this folder."""

from cardan.book.comparison import BookComparison
from cardan.book.mathieu_reduction import MathieuReduction

from .comparison import book_figures
from .mathieu import reduction_figures

FIGURES = {BookComparison: book_figures, MathieuReduction: reduction_figures}
"""Result -> what makes its figures."""
