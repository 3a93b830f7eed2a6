"""HTML pages from templates, and the parts they share: tables, facts, rate curves, cloud data."""

from __future__ import annotations

import base64
import html
import json
import re
from collections.abc import Mapping
from importlib import resources
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.events import EventStream
from texvent.frames import MICROSECONDS
from texvent.options.values import plain
from texvent.view.drawing.palettes import Colour, Palette
from texvent.view.sample import FrameStrip, RateCurve

SCRIPTS = ("state.js", "cloud.js", "plane.js", "rate.js", "controls.js")
"""Parts of the viewer, in the order in which they build on one another."""
PALETTE_PARTS = ("on", "off", "both", "background", "ink")


def fill_template(name: str, parts: Mapping[str, str], *, palette: Palette) -> str:
    """The page with every `{{name}}` replaced, in one pass: inserted text is never read again.

    Args:
        name: file in viewer/.
        parts: HTML to insert.
        palette: the colours; in dark mode those of its dark twin.
    """
    dark = palette_properties(palette.dark)
    style = (
        f"{viewer_file('page.css')}\n:root {{ {palette_properties(palette)} }}\n"
        f"@media (prefers-color-scheme: dark) {{\n  :root {{ {dark} }}\n}}"
    )
    known = {"style": style, "script": "\n".join(map(viewer_file, SCRIPTS)), **parts}
    return re.sub(r"\{\{(\w+)\}\}", lambda match: known[match[1]], viewer_file(name))


def viewer_file(name: str) -> str:
    """The text of a file in viewer/."""
    return resources.files("texvent.view.page").joinpath("viewer", name).read_text("utf-8")


def palette_properties(palette: Palette) -> str:
    """The colours as CSS properties: `--on: rgb(0 0 255);` and its like."""
    colours = {name: getattr(palette, name) for name in PALETTE_PARTS}
    return " ".join(
        f"--{name}: rgb({red} {green} {blue});" for name, (red, green, blue) in colours.items()
    )


LABELS = {
    "ON": "ON",
    "texvent_version": "texvent version",
}
"""Labels of facts where the capitalised name is not enough."""
CURVE_WIDTH = 1000
CURVE_HEIGHT = 200


def count_text(count: float) -> str:
    """A count with three digits and k, M or G.

    Example:
        >>> count_text(1_234_567), count_text(950)
        ('1.23 M', '950')
    """
    rounded = float(f"{count:.3g}")  # 999 999 is 1 M
    for size, letter in ((1e9, "G"), (1e6, "M"), (1e3, "k")):
        if rounded >= size:
            return f"{rounded / size:.3g} {letter}" if rounded < 1000 * size else f"{count:.2g}"
    return f"{count:.0f}"


def rate_curve_html(curve: RateCurve) -> str:
    """The event rate over time, over which the viewer's script marks the window and the region."""
    if curve.counts.shape[1] == 0:
        return '<div class="panel rate"><p>No events.</p></div>'
    marks = (
        f'<rect id="rate-window" class="window" x="0" y="0" width="0" height="{CURVE_HEIGHT}"/>'
        '<path id="rate-region" class="region-line" d=""/>'
    )
    figure = rate_figure(
        curve.counts, start_us=curve.start_us, bin_us=curve.bin_us, marks=marks, name="rate-curve"
    )
    return (
        f'{figure}<p class="note">Drag over the curve to choose a time, click to go there. '
        '<span id="rate-region-note" hidden>The line is the region alone, estimated from the '
        "events of the cloud.</span></p>"
    )


def rate_figure(
    counts: NDArray[np.int64],
    *,
    start_us: int,
    bin_us: float,
    marks: str = "",
    name: str = "",
) -> str:
    """The event rate over time: ON above the line, OFF below it, as SVG that needs no script.

    Args:
        counts: OFF and ON events per bin, [2, bins].
        start_us: where the first bin begins, µs.
        bin_us: width of a bin, µs.
        marks: SVG drawn over the areas.
        name: id of the SVG element, if any.
    """
    per_second = MICROSECONDS / bin_us
    full = max(1, int(counts.max()))
    most = int(counts.sum(axis=0).max())
    middle = CURVE_HEIGHT / 2
    on_area, off_area = (
        _steps(counts[row], scale=direction * 0.96 * middle / full)
        for row, direction in ((1, -1), (0, 1))
    )
    stop_us = start_us + bin_us * counts.shape[1]
    label = f"ON and OFF events per second over time; peak {count_text(most * per_second)}"
    identity = f' id="{name}"' if name else ""
    return (
        f'<figure class="panel rate"><svg{identity} '
        f'viewBox="0 0 {CURVE_WIDTH} {CURVE_HEIGHT}" '
        f'preserveAspectRatio="none" role="img" aria-label="{label}">'
        f'<path class="on-area" d="{on_area}"/><path class="off-area" d="{off_area}"/>{marks}'
        f'<path class="zero" d="M0 {middle:g}H{CURVE_WIDTH}"/></svg>'
        f'<div class="scale"><span>{start_us / MICROSECONDS:.3f} s</span> '
        f"<span>ON above, OFF below the line · peak {count_text(most * per_second)} events/s · "
        f"bins of {bin_us / 1000:.3g} ms</span> "
        f"<span>{stop_us / MICROSECONDS:.3f} s</span></div></figure>"
    )


def facts_html(facts: Mapping[str, Any]) -> str:
    """Rows of a table; names and values are escaped."""
    rows = []
    for name, value in facts.items():
        label = LABELS.get(name, name.replace("_", " ").capitalize())
        rows.append(
            f'<tr><th scope="row">{html.escape(label)}</th><td>{html.escape(str(value))}</td></tr>'
        )
    return "\n".join(rows)


def details_html(metadata: Mapping[str, Any]) -> str:
    """All settings of the run, folded."""
    if not metadata:
        return ""
    text = json.dumps(plain(metadata), indent=2, ensure_ascii=False, default=str)
    return (
        "<details><summary>All settings of the run</summary>"
        f"<pre>{html.escape(text)}</pre></details>"
    )


def still_html(png: bytes | None) -> str:
    """The still image, inside the page itself."""
    if png is None:
        return ""
    return (
        '<section aria-labelledby="still-heading"><h2 id="still-heading">The busiest moment</h2>'
        '<figure class="still"><img alt="The moment of the recording with the most events" '
        f'src="data:image/png;base64,{base64.b64encode(png).decode("ascii")}"></figure></section>'
    )


def video_html(strip: FrameStrip) -> str:
    """The source video's frame beside the cloud; nothing without frames."""
    if not strip.images:
        return ""
    return (
        '<figure class="plane"><div class="panel">'
        '<canvas id="video-canvas" role="img" aria-label="The video at the start of the chosen '
        'time"></canvas><div class="region-mark" hidden></div></div>'
        f"<figcaption>The source video; {len(strip.images)} of its frames are in this page"
        "</figcaption></figure>"
    )


def viewer_json(
    sample: EventStream,
    curve: RateCurve,
    strip: FrameStrip,
    *,
    palette: Palette,
    seen: int,
    stop_us: int,
) -> str:
    """All that the viewer shows as JSON that is safe inside a script element.

    Times become shares 0..1 of `[start_us, stop_us]` in float32: finer than a screen can show.

    Args:
        sample: the events of the cloud.
        curve: ON and OFF events over time, all of them.
        strip: frames of the video.
        palette: the colours.
        seen: how many events the recording has.
        stop_us: time of the last event, µs.
    """
    start_us, span_us = curve.start_us, max(1, stop_us - curve.start_us)
    data = {
        "width": sample.size.width,
        "height": sample.size.height,
        "start_us": start_us,
        "duration_us": span_us,
        "count": len(sample),
        "seen": seen,
        **_colours(palette),
        "dark": _colours(palette.dark),
        "xy": _base64(np.stack([sample.x, sample.y], axis=1).astype("<u2")),
        "t": _base64(((sample.t - start_us) / span_us).astype("<f4")),
        "p": _base64(sample.p),
        "rate": {
            "bins": curve.counts.shape[1],
            "bin_us": curve.bin_us,
            "peak": int(curve.counts.max(initial=0)),
        },
        "frames": [
            {
                "t": (t_us - start_us) / span_us,
                "src": "data:image/jpeg;base64," + base64.b64encode(jpeg).decode("ascii"),
            }
            for t_us, jpeg in strip.images
        ],
    }
    # "</script>" inside JSON would end the element.
    return json.dumps(data).replace("<", "\\u003c")


def _colours(palette: Palette) -> dict[str, Colour]:
    return {name: getattr(palette, name) for name in PALETTE_PARTS}


def _base64(values: Any) -> str:
    return base64.b64encode(np.ascontiguousarray(values).tobytes()).decode("ascii")


def _steps(counts: Any, *, scale: float) -> str:
    """Outline of a bar chart on the middle line, as an SVG path."""
    middle = CURVE_HEIGHT / 2
    width = CURVE_WIDTH / len(counts)
    parts = [f"M0 {middle:g}"]
    parts += [
        f"V{middle + count * scale:.1f}H{(index + 1) * width:.2f}"
        for index, count in enumerate(counts.tolist())
    ]
    return "".join(parts) + f"V{middle:g}Z"
