"""Which cardan this is; the package and `CITATION.cff` take it from here."""

VERSION = "1.0.0"
