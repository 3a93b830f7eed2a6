"""What the benchmark's SVG charts share."""

from __future__ import annotations

from html import escape

COLOURS = {
    "frames": "#4c78a8",
    "true frames": "#59a14f",
    "frames, sensor known": "#9ab8dc",
    "true frames, sensor known": "#a8d3a2",
    "recorded": "#8c8c96",
}
"""Track → colour of its entries."""
STYLE = "font-family='sans-serif' font-size='11' fill='#26262e'"


def svg_document(width: float, height: float, parts: list[str]) -> str:
    """An SVG document on white, of a width and height in px."""
    return (
        f"<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {width:g} {height:g}' {STYLE}>"
        f"<rect width='100%' height='100%' fill='#ffffff'/>{''.join(parts)}</svg>\n"
    )


def svg_text(text: str, x: float, y: float, attributes: str = "") -> str:
    """A line of text, its baseline at y."""
    return f"<text x='{x:.1f}' y='{y:.1f}' {attributes}>{escape(text)}</text>"


def placed(parts: str, x: float, y: float) -> str:
    """A group moved to a place."""
    return f"<g transform='translate({x:.1f},{y:.1f})'>{parts}</g>"
