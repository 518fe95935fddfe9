"""Figures of the results made beside this folder."""

from cardan.book.comparison import BookComparison
from cardan.book.figure import book_figures, reduction_figures
from cardan.book.mathieu_drive import MathieuReduction

FIGURES = {BookComparison: book_figures, MathieuReduction: reduction_figures}
"""Result -> what makes its figures."""
