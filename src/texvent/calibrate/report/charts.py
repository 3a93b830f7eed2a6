"""Plots of a calibration as HTML and SVG without a script, in the colours of the page."""

from __future__ import annotations

import base64
import html
import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.calibrate.bootstrap import Float64Array
from texvent.view.drawing.canvas import png_bytes

WIDTH, HEIGHT = 400, 160
BINS = 40
TOP = 0.94
"""Part of the height that the highest value takes."""
LOW_COLOUR, HIGH_COLOUR = (24, 30, 60), (255, 226, 120)
MARK = (230, 40, 60)
UNKNOWN = (128, 128, 128)
"""Colours of maps: least, greatest, marked pixels, pixels without a value."""


class Distribution(NamedTuple):
    """Shares of values in bins, of a recording and of a model."""

    edges: Float64Array
    """[bins + 1]."""
    recorded: Float64Array
    """[bins] share of all."""
    simulated: Float64Array
    """[bins]."""


def compare_values(recorded: Float64Array, simulated: Float64Array) -> Distribution | None:
    """Distributions of positive values in bins that grow by a factor; None if one has none.

    Example:
        >>> found = compare_values(np.array([1.0, 1.0, 100.0]), np.array([100.0]))
        >>> float(found.recorded.sum()), float(found.simulated[-1])
        (1.0, 1.0)
    """
    if not recorded.size or not simulated.size:
        return None
    both = np.concatenate([recorded, simulated])
    low, high = float(both.min()), float(both.max())
    edges = np.geomspace(low, max(high, low * 1.01), BINS + 1)
    edges[0], edges[-1] = low, max(high, edges[-1])
    shares = [np.histogram(one, edges)[0] / one.size for one in (recorded, simulated)]
    return Distribution(edges, *shares)


def distribution_chart(title: str, found: Distribution | None, unit: str) -> str:
    """The recording as an area, the model as a line, over a logarithmic axis."""
    if found is None:
        return _figure(title, '<p class="note">No values.</p>')
    full = max(float(found.recorded.max()), float(found.simulated.max()))
    area = _stairs(found.recorded / full, closed=True)
    line = _stairs(found.simulated / full, closed=False)
    low, high = float(found.edges[0]), float(found.edges[-1])
    label = html.escape(f"{title}: recording and model, {low:.3g} to {high:.3g} {unit}")
    return _figure(
        title,
        f'{_svg(label)}<path class="recorded" d="{area}"/><path class="model" d="{line}"/></svg>'
        f"{_scale(_short(low), f'{html.escape(unit)}, logarithmic', _short(high))}",
    )


def rate_chart(recorded: NDArray[np.int64], simulated: NDArray[np.int64], seconds: float) -> str:
    """The event rate over time, ON and OFF together.

    Args:
        recorded: events per bin.
        simulated: those of the model.
        seconds: that the bins last together.
    """
    full = max(int(recorded.max()), int(simulated.max()), 1)
    per_second = full * len(recorded) / seconds
    area = _stairs(recorded / full, closed=True)
    line = _stairs(simulated / full, closed=False)
    return _figure(
        "Event rate over time",
        f"{_svg('Event rate over time, recording and model')}"
        f'<path class="recorded" d="{area}"/><path class="model" d="{line}"/></svg>'
        f"{_scale('0 s', f'at most {_short(per_second)} events/s', f'{seconds:.3g} s')}",
    )


def noise_chart(levels: Float64Array, rates: Float64Array, ends: Float64Array) -> str:
    """Noise by intensity: measured points with intervals, and the curve of the model.

    Args:
        levels: [n] linear intensity, 0..255.
        rates: [n] events per pixel and second, above 0.
        ends: [2, n] ends of the intervals.
    """
    floor = float(rates.min()) / 3
    ends = np.maximum(ends, floor)
    low, high = math.log10(min(floor, float(ends.min()))), math.log10(float(ends.max()) * 1.3)

    def place(level: float, rate: float) -> tuple[float, float]:
        across = math.log(1 + level) / math.log(256)
        up = (math.log10(rate) - low) / (high - low)
        return WIDTH * across, HEIGHT * (1 - up)

    columns = zip(levels.tolist(), rates.tolist(), *ends.tolist(), strict=True)
    marks, path = "", ""
    for level, rate, bottom, top in columns:
        x, y = place(level, rate)
        path += f"{'L' if path else f'M0 {y:.1f}L'}{x:.1f} {y:.1f}"
        marks += (
            f'<path class="interval" d="M{x:.1f} {place(level, bottom)[1]:.1f}'
            f'V{place(level, top)[1]:.1f}"/><path class="point" d="M{x:.1f} {y:.1f}h0"/>'
        )
    path += f"H{WIDTH}"
    return _figure(
        "Noise by intensity: points with 95 % intervals, and the curve of the model",
        f'{_svg("Noise by linear intensity")}<path class="model" d="{path}"/>{marks}</svg>'
        + _scale("level 0", f"{10**low:.2g} to {10**high:.2g} 1/(px s), logarithmic", "255"),
    )


def map_chart(title: str, values: Float64Array, marked: NDArray[np.bool_] | None = None) -> str:
    """Values of pixels from dark to bright; marked pixels in red, pixels without one in grey.

    Args:
        title: what is shown.
        values: [H, W]; NaN is no value.
        marked: [H, W].
    """
    known = values[np.isfinite(values)]
    low, high = np.quantile(known, [0.01, 0.99]) if known.size else (0.0, 1.0)
    share = np.clip((np.nan_to_num(values) - low) / max(high - low, 1e-12), 0, 1)[..., None]
    image = np.array(LOW_COLOUR) * (1 - share) + np.array(HIGH_COLOUR) * share
    image[~np.isfinite(values)] = UNKNOWN
    if marked is not None:
        image[marked] = MARK
    data = base64.b64encode(png_bytes(np.rint(image).astype(np.uint8))).decode("ascii")
    text = html.escape(title)
    return (
        f'<figure class="chart map"><figcaption>{text}</figcaption>'
        f'<img alt="{text}" src="data:image/png;base64,{data}">'
        f"{_scale(_short(float(low)), 'dark to bright', _short(float(high)))}</figure>"
    )


def _figure(title: str, inside: str) -> str:
    return f'<figure class="chart"><figcaption>{html.escape(title)}</figcaption>{inside}</figure>'


def _svg(label: str) -> str:
    return (
        f'<svg viewBox="0 0 {WIDTH} {HEIGHT}" preserveAspectRatio="none" role="img" '
        f'aria-label="{label}">'
    )


def _scale(*texts: str) -> str:
    return f'<div class="scale">{"".join(f"<span>{text}</span>" for text in texts)}</div>'


def _stairs(heights: Float64Array, *, closed: bool) -> str:
    """A path through the tops of bars of height 0..1."""
    step = WIDTH / len(heights)
    tops: Sequence[float] = (HEIGHT * (1 - TOP * heights)).tolist()
    begin = f"M0 {HEIGHT}" if closed else f"M0 {tops[0]:.1f}"
    path = begin + "".join(f"V{top:.1f}H{(n + 1) * step:.1f}" for n, top in enumerate(tops))
    return f"{path}V{HEIGHT}Z" if closed else path


def _short(value: float) -> str:
    return f"{value:,.0f}" if abs(value) >= 1000 else f"{value:.3g}"
