"""Which cardan this is; the package and `CITATION.cff` take it from here."""

VERSION = "0.1.0"
