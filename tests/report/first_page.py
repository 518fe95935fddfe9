"""The key figures of the first page that motion, yokes, movement and checks tell, without the rest of the report."""

from cardan.checks import check
from cardan.checks.key_figures import key_figures as verdict_figures
from cardan.drive.drive import Drive
from cardan.report.answers import answered, subject
from cardan.report.block import Cell, key_figures, key_table

PAGES = ("motion", "phasing", "articulation")


def key_rows(drive: Drive) -> list[list[Cell]]:
    """Return the rows of the key figures of a drive."""
    told = [answered(name, subject(drive)).keys for name in PAGES]
    return list(key_table(key_figures([*told, tuple(verdict_figures(drive, check(drive)))])).rows)
