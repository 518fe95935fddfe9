"""Reports and exports, made in the background and given to the browser."""

from __future__ import annotations

from cardan.app.state.jobs import Jobs
from cardan.app.state.session import Session


class ReportMenu:
    """The menu of reports and exports."""

    def __init__(self, session: Session, jobs: Jobs) -> None:
        self.session = session
