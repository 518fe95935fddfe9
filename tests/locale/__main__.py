"""Keep the catalogues of other languages: ``python -m tests.locale update [--from FILE.json]…`` and ``... missing``."""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from .messages import OTHERS, from_files, merged, untranslated, update


def main() -> None:
    """Update or look."""
    parser = argparse.ArgumentParser(prog="python -m tests.locale", description=__doc__)
    parser.add_argument("action", choices=["update", "missing"], help="write the catalogues, or list what they lack")
    parser.add_argument("--lang", choices=OTHERS, default=OTHERS[0], help="language")
    parser.add_argument("--from", dest="files", type=Path, action="append", default=[], help="JSON of translations")
    given = parser.parse_args()
    more = from_files(given.files)
    catalogue = update(given.lang, more) if given.action == "update" else merged(given.lang, more)
    missing = untranslated(catalogue)
    if given.action == "missing":
        print(json.dumps(dict.fromkeys(missing, ""), ensure_ascii=False, indent=1))
    else:
        print(f"{given.lang}: {len(catalogue)} messages, {len(missing)} of them not translated")


if __name__ == "__main__":
    main()
