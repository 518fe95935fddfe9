"""Values that stand behind ``key=`` on the command line."""

from __future__ import annotations

import json
import re
from typing import Any

PLAIN = r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?"
"""Numbers as people write them; JSON takes no leading point or plus, no point at the end."""


def value_of(text: str) -> Any:
    """Return a value: JSON, any usual number, or else the word as it stands.

    >>> value_of("[1, 2]"), value_of("true"), value_of(".35"), value_of("+3."), value_of("exact")
    ([1, 2], True, 0.35, 3.0, 'exact')
    """
    try:
        return json.loads(text)
    except ValueError:
        return float(text) if re.fullmatch(PLAIN, text) else text
