"""Values that show themselves in notebooks."""

from __future__ import annotations

from collections.abc import Collection

from texvent._registry import load_object


class NotebookValue:
    """Base of events, frames and streams: IPython asks for what to show in place of their text."""

    def _repr_mimebundle_(
        self, include: Collection[str] | None = None, exclude: Collection[str] | None = None
    ) -> dict[str, str]:
        """Text and HTML of the value; the room of views makes the HTML, loaded when it is asked."""
        bundle: dict[str, str] = load_object("texvent.view.notebook:mime_bundle")(
            self, include, exclude
        )
        return bundle
