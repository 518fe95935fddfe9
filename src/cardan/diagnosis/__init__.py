"""From what is measured and noticed on a running drive to what may be wrong with it."""

from .match import Cause, Signs, likely_causes

__all__ = ["Cause", "Signs", "likely_causes"]
