"""Flicker: brightness that jumps from frame to frame, and brightness that beats at one frequency.

The beat is looked for in the spectrum of every block's brightness ln(30 + I), by Welch's method:
segments of 64 frames that overlap by half, each without its straight line, under a Hann window. The
amplitude of a sine of period N/k frames comes out as its amplitude, in log units:

    A_k = c |Σ w_i s_i exp(-2πj k i / N)| / Σ w_i,    c = 2, and 1 at half the frame rate

A line is a bin whose amplitude is `PROMINENCE` times that of the bins beside it, on both sides, so
slow motion, whose spectrum falls with frequency, has none. Blocks that something passes have no
common frequency; a lamp's beat has one, in all the blocks that it lights.

Source: Welch, The use of FFT for the estimation of power spectra (IEEE Trans. Audio 1967).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from texvent.brightness import Float64Array
from texvent.video_check.blocks import SeenFrame

BALANCE = 30.0
"""Balance of the logarithm, as of the default pixel model."""
SEGMENT_FRAMES, LEAST_FRAMES = 64, 16
"""A clip shorter than a segment is one; shorter than the least, it has no spectrum."""
FIRST_BIN = 5
"""Lines below this bin are not told from slow changes."""
NEAR_BINS, FAR_BINS = 3, 6
"""Bins this far to each side are the background of a line; nearer ones belong to the window."""
PROMINENCE = 3.0
LEAST_LOG = 0.01
"""Amplitude below which a block has no line: a twentieth of the usual contrast threshold."""
MAINS_HZ = (100.0, 120.0)
"""Lamps flicker at twice the frequency of the mains."""


@dataclass(frozen=True, eq=False)
class FlickerSpectrum:
    """How strongly a clip's brightness beats, by frequency."""

    frequency: Float64Array
    """[K], cycles per frame, 0..0.5."""
    whole_log: Float64Array
    """[K], amplitude of the mean over all blocks, log units."""
    blocks_log: Float64Array
    """[K], root mean square over blocks of their amplitudes, log units."""
    line_share: Float64Array
    """[K], share of the blocks that have a line there."""
    line_log: Float64Array
    """[K], median amplitude of those blocks, log units; 0 where there is none."""


class Flicker:
    """Takes the brightness of blocks over time; keeps one segment, and a number per frame."""

    def __init__(self) -> None:
        self._means: list[float] = []
        self._segment: list[Float64Array] = []
        self._unread = 0
        self._power: Float64Array | None = None
        self._whole: Float64Array | None = None
        self._segments = 0

    def add(self, seen: SeenFrame) -> None:
        """Take one frame."""
        self._means.append(float(seen.means.mean(dtype=np.float64)))
        self._segment.append(np.log(BALANCE + seen.means.ravel().astype(np.float64)))
        self._unread += 1
        if len(self._segment) == SEGMENT_FRAMES:
            self._read_segment()
            del self._segment[: SEGMENT_FRAMES // 2]

    def _read_segment(self) -> None:
        series = np.stack(self._segment)
        power = amplitudes(series) ** 2
        whole = amplitudes(series.mean(axis=1, keepdims=True))[:, 0] ** 2
        self._power = power if self._power is None else self._power + power
        self._whole = whole if self._whole is None else self._whole + whole
        self._segments += 1
        self._unread = 0

    def spectrum(self) -> FlickerSpectrum | None:
        """The spectrum of all frames so far; None of fewer than `LEAST_FRAMES`.

        Frames at the end that do not fill half a segment are left out, unless there is no other.
        """
        if self._segments == 0 and len(self._segment) >= LEAST_FRAMES:
            self._read_segment()
        if self._power is None or self._whole is None:
            return None
        blocks = np.sqrt(self._power / self._segments)
        lines = find_lines(blocks)
        count = lines.sum(axis=1)
        line_log = np.array(
            [
                float(np.median(row[has])) if has.any() else 0.0
                for row, has in zip(blocks, lines, strict=True)
            ]
        )
        return FlickerSpectrum(
            frequency=np.linspace(0, 0.5, len(blocks)),
            whole_log=np.sqrt(self._whole / self._segments),
            blocks_log=np.sqrt((blocks**2).mean(axis=1)),
            line_share=count / blocks.shape[1],
            line_log=line_log,
        )

    def measures(self, fps: float) -> dict[str, float]:
        """By name.

        Args:
            fps: frames per second; 0 if not known.

        Returns:
            `flicker` and `flash`: upper quartile and maximum of how far a frame's mean stands out
            from both neighbours, on the same side, levels. `beat_share`: largest share of blocks
            that have a line at one frequency; `beat_hz` and `beat_log`: that frequency and the
            median amplitude of those blocks, log units.
        """
        jitter = _jitter(np.array(self._means))
        spectrum = self.spectrum()
        share = hz = log = 0.0
        if spectrum is not None:
            strongest = int((spectrum.line_share * spectrum.line_log).argmax())
            share = float(spectrum.line_share[strongest])
            hz = float(spectrum.frequency[strongest]) * fps if share else 0.0
            log = float(spectrum.line_log[strongest])
        return {
            "flicker": float(np.percentile(jitter, 75)),
            "flash": float(jitter.max()),
            "beat_share": share,
            "beat_hz": hz,
            "beat_log": log,
        }


def amplitudes(series: Float64Array) -> Float64Array:
    """Amplitude of the sine at each frequency; see the module.

    Args:
        series: N values of each of B signals, [N, B].

    Returns:
        [N // 2 + 1, B]; the first, the mean, is 0.
    """
    count = len(series)
    time = np.arange(count) - (count - 1) / 2
    centred = series - series.mean(axis=0)
    centred -= time[:, None] * (time @ centred / (time @ time))
    window = 0.5 - 0.5 * np.cos(2 * np.pi * np.arange(count) / count)
    result = 2 * np.abs(np.fft.rfft(centred * window[:, None], axis=0)) / window.sum()
    result[0] = 0.0
    if count % 2 == 0:
        result[-1] /= 2
    return np.asarray(result)


def find_lines(amplitude: Float64Array) -> NDArray[np.bool_]:
    """Bins that stand out from those beside them.

    Args:
        amplitude: of K bins of B signals, [K, B].

    Returns:
        [K, B]: amplitude at least `LEAST_LOG`, not below its neighbours, and `PROMINENCE` times
        the median of the bins `NEAR_BINS`..`FAR_BINS` away, on the left and, where there are two
        of them, on the right.
    """
    found = np.zeros(amplitude.shape, bool)
    for k in range(FIRST_BIN, len(amplitude)):
        here = amplitude[k]
        is_line = (here >= LEAST_LOG) & (here >= amplitude[k - 1])
        if k + 1 < len(amplitude):
            is_line &= here >= amplitude[k + 1]
        left = amplitude[max(1, k - FAR_BINS) : k - NEAR_BINS + 1]
        right = amplitude[k + NEAR_BINS : k + FAR_BINS + 1]
        for beside in (left, right):
            if len(beside) >= 2:
                is_line &= here >= PROMINENCE * np.median(beside, axis=0)
        found[k] = is_line
    return found


def mains_alias(hz: float, fps: float, frames: int) -> float | None:
    """The frequency of mains light, 100 or 120 Hz, that a video at `fps` shows as `hz`.

    A frequency f appears at |f - fps · round(f / fps)|.

    Args:
        hz: of the beat in the video.
        fps: frames per second.
        frames: of the clip; they decide how exactly `hz` is known.

    Returns:
        100 or 120; None if neither appears within a bin of `hz`.

    Example:
        >>> mains_alias(4.1, 24, 64), mains_alias(10.0, 30, 64), mains_alias(7.0, 24, 64)
        (100.0, 100.0, None)
    """
    bin_hz = fps / min(frames, SEGMENT_FRAMES)
    for mains in MAINS_HZ:
        alias = abs(mains - fps * round(mains / fps))
        if alias >= bin_hz and abs(alias - hz) <= bin_hz:
            return mains
    return None


def _jitter(means: Float64Array) -> Float64Array:
    """How far each inner frame's mean stands out from both neighbours, on the same side."""
    if len(means) < 3:
        return np.zeros(1)
    before = means[1:-1] - means[:-2]
    after = means[1:-1] - means[2:]
    return np.where(before * after > 0, np.minimum(np.abs(before), np.abs(after)), 0.0)
