"""The notes of one release, cut from CHANGELOG.md, once its tag and the version agree.

Example:
    python -m tools.release_notes v0.1.0 > notes.md
"""

from __future__ import annotations

import re
import sys
from collections.abc import Sequence
from pathlib import Path

ROOT = Path(__file__).parent.parent
CHANGELOG = ROOT / "CHANGELOG.md"
VERSION = ROOT / "src" / "texvent" / "_version.py"
UNRELEASED = "Unreleased"


def cut_notes(changelog: str, version: str) -> str:
    """The section of one version, without its heading.

    Args:
        changelog: the text of CHANGELOG.md, with headings such as "## [0.1.0] - 2026-11-22".
        version: such as "0.1.0", or "Unreleased".

    Raises:
        ValueError: there is no such section, more than one, or it is empty.
    """
    parts = re.split(r"^## \[([^\]]+)\](?:[ \t].*)?$", changelog, flags=re.MULTILINE)
    sections = [
        text.strip() for name, text in zip(parts[1::2], parts[2::2], strict=True) if name == version
    ]
    if len(sections) != 1 or not sections[0]:
        names = ", ".join(parts[1::2]) or "none"
        raise ValueError(
            f"CHANGELOG.md must have one section for {version}, with a text; its sections: {names}"
        )
    # Definitions of links at the end belong to the whole file.
    return re.sub(r"(\n\[[^\]]+\]: \S+)+\Z", "", sections[0]).strip() + "\n"


def package_version(source: str) -> str:
    """The version that `_version.py` defines.

    Raises:
        ValueError: it defines none.
    """
    found = re.search(r'^__version__ = "([^"]+)"$', source, flags=re.MULTILINE)
    if found is None:
        raise ValueError('_version.py has no line __version__ = "..."')
    return found[1]


def checked_version(tag: str, source: str) -> str:
    """The version of a tag such as "v0.1.0".

    Raises:
        ValueError: the package has another version.
    """
    version = package_version(source)
    if tag != f"v{version}":
        raise ValueError(
            f"the tag is {tag!r}, and _version.py says {version}; tag v{version}, or change "
            "_version.py first"
        )
    return version


def main(words: Sequence[str]) -> int:
    """Print the notes of a tag; without one, those not released yet."""
    try:
        version = (
            checked_version(words[0], VERSION.read_text(encoding="utf-8")) if words else UNRELEASED
        )
        notes = cut_notes(CHANGELOG.read_text(encoding="utf-8"), version)
    except ValueError as error:
        sys.stderr.write(f"error: {error}\n")
        return 2
    sys.stdout.write(notes)
    return 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
