"""Pages from the files in viewer/, as one file each."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from importlib import resources

from texvent.view.drawing.palettes import Palette

SCRIPTS = ("state.js", "cloud.js", "plane.js", "rate.js", "controls.js")
"""Parts of the viewer, in the order in which they build on one another."""
PALETTE_PARTS = ("on", "off", "background", "ink")
DARK_BY_SYSTEM = "@media (prefers-color-scheme: dark) {\n  :root { %s }\n}"
DARK_BY_CLASS = ":root.dark { %s }"
"""Rules for the colours of dark mode: where the system asks for it, or the page around this one."""


def fill_template(
    name: str,
    parts: Mapping[str, str],
    *,
    palette: Palette,
    style: str = "page.css",
    scripts: Sequence[str] = SCRIPTS,
    dark: str = DARK_BY_SYSTEM,
) -> str:
    """The page with every `{{name}}` replaced, in one pass: inserted text is never read again.

    Args:
        name: file in viewer/.
        parts: what to insert, as HTML.
        palette: the colours; in dark mode those of its dark twin.
        style: file in viewer/, for `{{style}}`.
        scripts: files in viewer/, for `{{script}}`.
        dark: the rule for dark mode.
    """
    known = {
        "style": f"{viewer_file(style)}\n{_palette_css(palette, dark)}",
        "script": "\n".join(map(viewer_file, scripts)),
        **parts,
    }
    return re.sub(r"\{\{(\w+)\}\}", lambda match: known[match[1]], viewer_file(name))


def viewer_file(name: str) -> str:
    """The text of a file in viewer/."""
    return resources.files("texvent.view.page").joinpath("viewer", name).read_text("utf-8")


def _palette_css(palette: Palette, dark: str) -> str:
    return f":root {{ {palette_properties(palette)} }}\n{dark % palette_properties(palette.dark)}"


def palette_properties(palette: Palette) -> str:
    """The colours as CSS properties: `--on: rgb(0 0 255);` and its like."""
    colours = {name: getattr(palette, name) for name in PALETTE_PARTS}
    return " ".join(
        f"--{name}: rgb({red} {green} {blue});" for name, (red, green, blue) in colours.items()
    )
