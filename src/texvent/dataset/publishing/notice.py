"""What the author of a data set says of it, which no shard tells."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from texvent.dataset.contents.made_set import MadeSet


@dataclass(frozen=True, kw_only=True)
class Notice:
    """Who publishes the data set, where, under which licence."""

    MARK: ClassVar[str] = "<!-- written by texvent dataset publish -->"
    """In cards of ours, which may be replaced."""

    license: str | None = None
    """Such as "cc-by-4.0"; None: that of the specification."""
    url: str | None = None
    """Its page."""
    creator: str | None = None
    """Person or organisation."""
    date: str | None = None
    """When it was published, such as "2026-11-21"."""
    notes: str = ""
    """Markdown for the card."""

    def license_of(self, made: MadeSet) -> str:
        """The licence, or nothing."""
        return self.license or str(made.specification.get("license") or "")
