"""Pages from the files in viewer/, as one file each."""

from __future__ import annotations

import re
from collections.abc import Mapping
from importlib import resources

from texvent.view.drawing.palettes import Palette

SCRIPTS = ("state.js", "cloud.js", "plane.js", "rate.js", "controls.js")
"""Parts of the viewer, in the order in which they build on one another."""
PALETTE_PARTS = ("on", "off", "background", "ink")


def fill_template(name: str, parts: Mapping[str, str], *, palette: Palette) -> str:
    """The page with every `{{name}}` replaced, in one pass: inserted text is never read again.

    Args:
        name: file in viewer/.
        parts: what to insert, as HTML.
        palette: the colours; in dark mode those of its dark twin.
    """
    known = {
        "style": f"{viewer_file('page.css')}\n{_palette_css(palette)}",
        "script": "\n".join(map(viewer_file, SCRIPTS)),
        **parts,
    }
    return re.sub(r"\{\{(\w+)\}\}", lambda match: known[match[1]], viewer_file(name))


def viewer_file(name: str) -> str:
    """The text of a file in viewer/."""
    return resources.files("texvent.view.page").joinpath("viewer", name).read_text("utf-8")


def _palette_css(palette: Palette) -> str:
    light, dark = map(palette_properties, (palette, palette.dark))
    return f":root {{ {light} }}\n@media (prefers-color-scheme: dark) {{\n  :root {{ {dark} }}\n}}"


def palette_properties(palette: Palette) -> str:
    """The colours as CSS properties: `--on: rgb(0 0 255);` and its like."""
    colours = {name: getattr(palette, name) for name in PALETTE_PARTS}
    return " ".join(
        f"--{name}: rgb({red} {green} {blue});" for name, (red, green, blue) in colours.items()
    )
