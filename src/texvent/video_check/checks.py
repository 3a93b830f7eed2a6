"""The checks: which measure, which limit, what it does to events, what helps.

docs/checks.md says on which clips the limits were set, and what others measure.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from texvent.video_check.flicker import LEAST_LOG, mains_alias

Measures = Mapping[str, float]

FROZEN_SHARE = 0.5
MOTION_LEVELS = 3.0
FLICKER_LEVELS = 2.0
FLASH_LEVELS = 20.0
DARK_LEVEL, BRIGHT_LEVEL = 12.0, 243.0
NOISE_CORRELATION = 0.4
"""Images have above 0.8."""
BEAT_SHARE, LEAST_SHOWN_SHARE = 0.15, 0.01
REPEAT_SHARE = 0.02
BLOCKINESS = 1.2
KEY_RATIO = 1.5
BANDED_SHARE = 0.1
IRREGULAR_SHARE = 0.02
MOTION_SHARE = 0.04
"""Of the longer side, per frame: 13 px of 320."""
LOW_RATE_HZ, HIGH_RATE_HZ = 0.05, 100.0
"""Events per pixel and second. A DAVIS346 reads 12 million per second, 133 per pixel."""


@dataclass(frozen=True, kw_only=True)
class Check:
    """One thing that is looked for."""

    name: str
    needs: str
    """The measure without which it is not made."""
    is_found: Callable[[Measures], bool]
    value: Callable[[Measures], str]
    """The measured value with its unit."""
    limit: str
    effect: str
    """What it does to events."""
    help: str
    """What helps; options are those of texvent simulate."""
    is_failure: bool = False
    """Whether a generated video that has it failed: another seed may give a better one."""


def _repeats(one: Measures) -> str:
    text = f"{one['repeat_share']:.1%} of pairs"
    period, repeats = one["pattern_period"], one["pattern_repeats"]
    if not period:
        return text
    true_fps = one["fps"] * (period - repeats) / period
    return f"{text}, {repeats:.0f} of {period:.0f}: true rate {true_fps:.3g} fps"


def _beat(one: Measures) -> str:
    if one["beat_share"] < LEAST_SHOWN_SHARE:
        return "none"
    text = f"{one['beat_log']:.3f} log at {one['beat_hz']:.1f} Hz in {one['beat_share']:.0%}"
    mains = mains_alias(one["beat_hz"], one["fps"], round(one["frames"]))
    return text if mains is None else f"{text}; {mains:.0f} Hz mains light looks so"


def _bars(one: Measures) -> str:
    names = ("top", "bottom", "left", "right")
    widths = [f"{name} {one[f'bar_{name}']:.0f}" for name in names if one[f"bar_{name}"]]
    return f"{one['bar_share']:.0%}" + (f": {', '.join(widths)} px" if widths else "")


def _keys(one: Measures) -> str:
    if not one["key_period"]:
        return "none"
    return f"{one['key_ratio']:.1f} times, every {one['key_period']:.0f} frames"


def _motion(one: Measures) -> str:
    return (
        f"{one['motion_px']:.1f} px per frame, {one['motion_share']:.1%} of the side; "
        f"fastest {one['fast_px']:.0f} px"
    )


def _rate(one: Measures) -> str:
    return f"{one['rate_hz']:.3g} ± {one['rate_error_hz']:.2g} per pixel and s"


ANOTHER_SEED = "generate: another `seed`, on_failure='retry'"

CHECKS = (
    Check(
        name="frozen",
        needs="still_share",
        is_failure=True,
        # Frames that repeat in a pattern are another finding: the clip moves.
        is_found=lambda one: one["still_share"] > FROZEN_SHARE and not one.get("pattern_period"),
        value=lambda one: f"{one['still_share']:.0%} of pairs still",
        limit=f"{FROZEN_SHARE:.0%}",
        effect="noise alone while it stands still",
        help=f"`start`, `stop`; {ANOTHER_SEED}",
    ),
    Check(
        name="no motion",
        needs="motion",
        is_failure=True,
        is_found=lambda one: one["motion"] < MOTION_LEVELS,
        value=lambda one: f"{one['motion']:.1f} levels",
        limit=f"at least {MOTION_LEVELS:g}",
        effect="nothing crosses the threshold: noise alone",
        help=ANOTHER_SEED,
    ),
    Check(
        name="flicker",
        needs="flicker",
        is_failure=True,
        is_found=lambda one: one["flicker"] > FLICKER_LEVELS,
        value=lambda one: f"{one['flicker']:.2f} levels",
        limit=f"{FLICKER_LEVELS:g}",
        effect="ON and OFF everywhere in turn; more intermediate frames",
        help="--deflicker",
    ),
    Check(
        name="flash",
        needs="flash",
        is_failure=True,
        is_found=lambda one: one["flash"] > FLASH_LEVELS,
        value=lambda one: f"{one['flash']:.1f} levels",
        limit=f"{FLASH_LEVELS:g}",
        effect="every pixel fires, up and down",
        help="`detect_cuts` (on unless switched off) keeps it at one instant; `start`, `stop`",
    ),
    Check(
        name="cut",
        needs="cuts",
        is_failure=True,
        is_found=lambda one: one["cuts"] > 0,
        value=lambda one: f"{one['cuts']:.0f}",
        limit="0",
        effect="most pixels fire at one instant, which no camera sees",
        help="`start`, `stop`: one shot; `detect_cuts` (on) keeps it at one instant",
    ),
    Check(
        name="dark",
        needs="bright_end",
        is_failure=True,
        is_found=lambda one: one["bright_end"] < DARK_LEVEL,
        value=lambda one: f"95 % below level {one['bright_end']:.0f}",
        limit=f"{DARK_LEVEL:g}",
        effect="few events of things, many of noise",
        help="lower `balance`, `contrast_threshold`; noise='none'",
    ),
    Check(
        name="saturated",
        needs="dark_end",
        is_failure=True,
        is_found=lambda one: one["dark_end"] > BRIGHT_LEVEL,
        value=lambda one: f"95 % above level {one['dark_end']:.0f}",
        limit=f"{BRIGHT_LEVEL:g}",
        effect="clipped: what moves in it fires nothing",
        help=f"`white_level`, if white is another value; {ANOTHER_SEED}",
    ),
    Check(
        name="noise",
        needs="correlation",
        is_failure=True,
        is_found=lambda one: one["correlation"] < NOISE_CORRELATION,
        value=lambda one: f"correlation {one['correlation']:.2f}",
        limit=f"at least {NOISE_CORRELATION:g}",
        effect="every pixel fires by itself",
        help=f"a smaller `sensor` averages it; {ANOTHER_SEED}",
    ),
    Check(
        name="repeated frames",
        needs="repeat_share",
        is_found=lambda one: one["repeat_share"] > REPEAT_SHARE,
        value=_repeats,
        limit=f"{REPEAT_SHARE:.0%}",
        effect="silence, then twice the change: the rate beats, times are wrong",
        help="drop them (ffmpeg -vf mpdecimate), then `fps` with the true rate",
    ),
    Check(
        name="beat",
        needs="beat_share",
        is_found=lambda one: one["beat_share"] > BEAT_SHARE,
        value=_beat,
        limit=f"{LEAST_LOG:g} log in {BEAT_SHARE:.0%}",
        effect="fires if twice that exceeds the threshold; else shifts the times of others",
        help="`deflicker`, if the whole image beats; or a recording at a higher frame rate",
    ),
    Check(
        name="compression blocks",
        needs="blockiness",
        is_found=lambda one: one["blockiness"] > BLOCKINESS,
        value=lambda one: f"{one['blockiness']:.2f} times",
        limit=f"{BLOCKINESS:g}",
        effect="false events in smooth areas, lost ones in detail",
        help="a better copy; a smaller `sensor` averages blocks",
    ),
    Check(
        name="key frames",
        needs="key_ratio",
        is_found=lambda one: one["key_ratio"] > KEY_RATIO,
        value=_keys,
        limit=f"{KEY_RATIO:g} times",
        effect="what rests changes at each: clumps of events at their rate",
        help="a better copy; a smaller `sensor`; a higher `contrast_threshold`",
    ),
    Check(
        name="banding",
        needs="banded_share",
        is_found=lambda one: one["banded_share"] > BANDED_SHARE,
        value=lambda one: f"{one['banded_share']:.0%} of the image",
        limit=f"{BANDED_SHARE:.0%}",
        effect="gradients move in stairs: lines fire together, in clumps",
        help="a source of 10 bits or more; --video-only stores 16",
    ),
    Check(
        name="black bars",
        needs="bar_share",
        is_found=lambda one: one["bar_share"] > 0,
        value=_bars,
        limit="0",
        effect="pixels that give noise alone; steady edges",
        help="`sensor` WIDTHxHEIGHT of what is inside, with fit='cover'",
    ),
    Check(
        name="frame times",
        needs="irregular_share",
        is_found=lambda one: one["irregular_share"] > IRREGULAR_SHARE,
        value=lambda one: (
            f"{one['irregular_share']:.0%} irregular, longest {one['longest_gap']:.1f} times"
        ),
        limit=f"{IRREGULAR_SHARE:.0%}",
        effect="right if the file is; else the rate jumps",
        help="`fps`, or `timestamps` of an image folder, replaces the times",
    ),
    Check(
        name="motion per frame",
        needs="motion_px",
        is_found=lambda one: one["motion_share"] > MOTION_SHARE,
        value=_motion,
        limit=f"{MOTION_SHARE:.0%} of the side",
        effect="interpolation loses things that move this far: ghosts instead of edges",
        help="more frames per second; `motion` of a renderer; generate: interpolate='exact'",
    ),
    Check(
        name="event rate",
        needs="rate_hz",
        is_found=lambda one: not LOW_RATE_HZ <= one["rate_hz"] <= HIGH_RATE_HZ,
        value=_rate,
        limit=f"{LOW_RATE_HZ:g} to {HIGH_RATE_HZ:g}",
        effect="below: little more than noise; above: more than sensors read out",
        help="`contrast_threshold`, or `target_rate`",
    ),
)
"""In the order of the table."""
