"""Variants of the drive, kept side by side."""

from __future__ import annotations

from cardan.app.state.session import Session


class VariantsMenu:
    """The menu of the variants."""

    def __init__(self, session: Session) -> None:
        self.session = session
