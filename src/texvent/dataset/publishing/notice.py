"""What the author of a data set says of it, which no shard tells."""

from __future__ import annotations

import datetime
from dataclasses import dataclass
from typing import ClassVar

from texvent.dataset.contents.made_set import MadeSet
from texvent.errors import ConfigError, shown


@dataclass(frozen=True, kw_only=True)
class Notice:
    """Who publishes the data set, where, under which licence.

    Raises:
        ConfigError: the date is none.
    """

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

    def __post_init__(self) -> None:
        try:
            datetime.date.fromisoformat(self.date or "2000-01-01")
        except ValueError as error:
            raise ConfigError(
                f"date is {shown(self.date)}; it must be a day, such as 2026-11-21"
            ) from error

    def license_of(self, made: MadeSet) -> str:
        """The licence, or nothing."""
        return self.license or str(made.specification.get("license") or "")
