"""Release notes are the section of one version, and a tag must be the version of the package."""

import pytest
from tools.release_notes import checked_version, cut_notes

LOG = """# Changelog

The format.

## [Unreleased]

### Added
- Not yet.

## [0.2.0] - 2026-12-01

### Added
- `## [0.1.0]` inside a line is text.
- Second, see [the format].

### Fixed
- Third.

## [0.1.0] - 2026-11-22
- First.

[the format]: https://example.org/format
[0.1.0]: https://example.org/0.1.0
"""
SOURCE = '"""Doc."""\n\n__version__ = "0.2.0"\nOTHER = "0.3.0"\n'


def test_a_section_ends_where_the_next_begins() -> None:
    assert cut_notes(LOG, "0.2.0") == (
        "### Added\n- `## [0.1.0]` inside a line is text.\n- Second, see [the format].\n\n"
        "### Fixed\n- Third.\n"
    )
    assert cut_notes(LOG, "Unreleased") == "### Added\n- Not yet.\n"


def test_a_tag_is_v_and_the_version() -> None:
    assert checked_version("v0.2.0", SOURCE) == "0.2.0"
    for tag in ("0.2.0", "v0.2", "v0.3.0", "v0.2.0rc1", ""):
        with pytest.raises(ValueError, match=r"_version\.py says 0\.2\.0; tag v0\.2\.0"):
            checked_version(tag, SOURCE)
    with pytest.raises(ValueError, match="no line"):
        checked_version("v0.2.0", "version = 1\n")
