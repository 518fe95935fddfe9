"""From what is measured and noticed on a running drive to what may be wrong with it."""

from .match import Cause, Signs, likely_causes
from .signals.signal import Channel, Signal

__all__ = ["Cause", "Channel", "Signal", "Signs", "likely_causes"]
