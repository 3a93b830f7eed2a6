"""The MIME bundle of a value: its `repr` as text, and HTML where it can be shown."""

from __future__ import annotations

import html
import sys
from collections.abc import Callable, Collection, Mapping
from typing import Any

from texvent.view.drawing.palettes import DEFAULT_PALETTE, get_palette
from texvent.view.page.html_parts import palette_properties, viewer_file

DARK_HOSTS = (
    'body[data-jp-theme-light="false"]',
    "body.vscode-dark",
    "body.vscode-high-contrast:not(.vscode-high-contrast-light)",
    'html[theme="dark"]',
    'html[data-theme="dark"]',
    'body[data-theme="dark"]',
)
"""Selectors of the dark theme in JupyterLab, nbconvert, VS Code, Colab and documentation sites."""
AUTO_HOSTS = ('html[data-theme="auto"]', 'body[data-theme="auto"]')
"""Those that follow the system."""


def mime_bundle(
    shown: object,
    make_html: Callable[[], str],
    include: Collection[str] | None = None,
    exclude: Collection[str] | None = None,
) -> dict[str, str]:
    """Result of `_repr_mimebundle_`: text always, HTML where it can be seen.

    Args:
        shown: the value.
        make_html: makes its HTML; not called in a terminal, which shows text alone.
        include: types that are wanted; None: all.
        exclude: types that are not.
    """
    bundle = {"text/plain": repr(shown)}
    is_wanted = include is None or "text/html" in include
    if is_wanted and "text/html" not in (exclude or ()) and not _is_terminal():
        bundle["text/html"] = make_html()
    return bundle


def _is_terminal() -> bool:
    """Whether this is IPython in a terminal."""
    ipython = sys.modules.get("IPython")
    shell = None if ipython is None else ipython.get_ipython()
    return shell is not None and "text/html" not in shell.display_formatter.active_types


def framed(*parts: str) -> str:
    """HTML parts with the style they need; nothing outside of them changes."""
    return f'<div class="texvent-view"><style>{_style()}</style>{"".join(parts)}</div>'


def heading(title: str, summary: str) -> str:
    """A title and a line below it, both escaped."""
    bold = f"<b>{html.escape(title)}</b><br>" if title else ""
    return f'<p class="head">{bold}{html.escape(summary)}</p>'


def facts_grid(facts: Mapping[str, Any]) -> str:
    """Names and values, escaped; those that are None or empty are left out."""
    cells = [
        f"<div><span>{html.escape(name)} </span>{html.escape(str(value))}</div>"
        for name, value in facts.items()
        if value not in (None, "")
    ]
    return f'<div class="facts">{"".join(cells)}</div>' if cells else ""


def note(text: str) -> str:
    """A line of explanation, escaped."""
    return f'<p class="note">{html.escape(text)}</p>'


def _style() -> str:
    palette = get_palette(DEFAULT_PALETTE)
    light = f"color-scheme: light; --line: #d9dde4; {palette_properties(palette)}"
    dark = f"color-scheme: dark; --line: #434955; {palette_properties(palette.dark)}"
    switch = (
        "SCOPE {%s} SCOPE .light {display: none !important} SCOPE .dark {display: block !important}"
    )
    rules = [f".texvent-view {{{light}}}", viewer_file("notebook.css")]
    rules += [(switch % dark).replace("SCOPE", f"{host} .texvent-view") for host in DARK_HOSTS]
    automatic = [(switch % dark).replace("SCOPE", f"{host} .texvent-view") for host in AUTO_HOSTS]
    rules.append(f"@media (prefers-color-scheme: dark) {{{' '.join(automatic)}}}")
    return "\n".join(rules)
