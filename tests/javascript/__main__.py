"""Checks the scripts of the app with node: ``python -m tests.javascript``; says so where there is no node."""

from __future__ import annotations

import hashlib
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
APP = ROOT / "src" / "cardan" / "app"
TOOLS = ROOT / "out" / "javascript"  # with a name of what is in it behind


def tools() -> Path | str:
    """Return the folder with the tools, fetched where they are not there yet; a text tells why there is none."""
    npm = shutil.which("npm")
    if shutil.which("node") is None or npm is None:
        return "no node"
    lock = (HERE / "package-lock.json").read_bytes()
    folder = TOOLS / hashlib.sha256(lock).hexdigest()[:12]
    if not (folder / "done").exists():
        folder.mkdir(parents=True, exist_ok=True)
        for name in ("package.json", "package-lock.json"):
            shutil.copy(HERE / name, folder)
        command = [npm, "ci", "--ignore-scripts", "--no-audit", "--no-fund", "--loglevel=error"]
        try:
            subprocess.run(command, cwd=folder, check=True, capture_output=True, timeout=300)
        except (subprocess.SubprocessError, OSError):
            return "npm could not fetch typescript and eslint"
        (folder / "done").touch()
    return folder


def main() -> int:
    """Check types and lint, and say how it went."""
    found = tools()
    if isinstance(found, str):
        print(f"JavaScript: skipped: {found}")
        return 0
    programs = found / "node_modules" / ".bin"
    shutil.copy(HERE / "eslint.config.mjs", found)
    commands = (
        [programs / "tsc", "--project", HERE / "tsconfig.json"],
        [programs / "eslint", "--config", found / "eslint.config.mjs", APP],
    )
    codes = [subprocess.run(list(map(str, command)), cwd=ROOT).returncode for command in commands]
    if not any(codes):
        print(f"JavaScript: no issues found in {len(list(APP.rglob('*.js')))} scripts")
    return max(codes)


if __name__ == "__main__":
    sys.exit(main())
