"""Checks of a video: each has a measurement, a limit, its effect on events, and advice.

docs/checks.md says on which clips the limits were set.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

from texvent.frames import MICROSECONDS, Frame
from texvent.pairs.time_jump import RATIO, SHORTEST_US
from texvent.video_check.measurements import Measurements, measure_video

FROZEN_SHARE = 0.5
MOTION_LEVELS = 3.0
FLICKER_LEVELS = 2.0
FLASH_LEVELS = 20.0
DARK_LEVEL, BRIGHT_LEVEL = 12.0, 243.0
NOISE_CORRELATION = 0.4
"""Images have above 0.8."""
REPEAT_SHARE = 0.02
MOTION_SHARE = 0.04
"""Share of the longer side, per frame: 13 px of 320."""


@dataclass(frozen=True, kw_only=True)
class Check:
    """One fault of videos."""

    name: str
    needs: str
    """The measurement without which it is not made."""
    is_found: Callable[[Measurements], bool]
    value: Callable[[Measurements], str]
    """The measured value with its unit."""
    limit: str
    effect: str
    """Effect on events."""
    help: str
    """Advice; options are those of texvent simulate."""
    is_failure: bool = True
    """Whether a generated video that has it failed: another seed may give a better one."""


def _repeats(one: Measurements) -> str:
    text = f"{one['repeat_share']:.1%} of pairs"
    period, repeats = one["pattern_period"], one["pattern_repeats"]
    if not period:
        return text
    true_fps = one["fps"] * (period - repeats) / period
    return f"{text}, {repeats:.0f} of {period:.0f}: true rate {true_fps:.3g} fps"


def _motion(one: Measurements) -> str:
    return (
        f"{one['motion_px']:.1f} px per frame, {one['motion_share']:.1%} of the side; "
        f"fastest {one['fast_px']:.0f} px"
    )


ANOTHER_SEED = "generate: another `seed`, on_failure='retry'"

CHECKS = (
    Check(
        name="frozen",
        needs="still_share",
        # Frames that repeat in a pattern are another finding: the clip moves.
        is_found=lambda one: one["still_share"] > FROZEN_SHARE and not one.get("pattern_period"),
        value=lambda one: f"{one['still_share']:.0%} of pairs still",
        limit=f"{FROZEN_SHARE:.0%}",
        effect="noise alone while it rests",
        help=f"`start`, `stop`; {ANOTHER_SEED}",
    ),
    Check(
        name="no motion",
        needs="motion",
        is_found=lambda one: one["motion"] < MOTION_LEVELS,
        value=lambda one: f"{one['motion']:.1f} levels",
        limit=f"at least {MOTION_LEVELS:g}",
        effect="nothing crosses the threshold: noise alone",
        help=ANOTHER_SEED,
    ),
    Check(
        name="flicker",
        needs="flicker",
        is_found=lambda one: one["flicker"] > FLICKER_LEVELS,
        value=lambda one: f"{one['flicker']:.2f} levels",
        limit=f"{FLICKER_LEVELS:g}",
        effect="ON and OFF everywhere in turn; more intermediate frames",
        help="`deflicker`",
    ),
    Check(
        name="flash",
        needs="flash",
        is_found=lambda one: one["flash"] > FLASH_LEVELS,
        value=lambda one: f"{one['flash']:.1f} levels",
        limit=f"{FLASH_LEVELS:g}",
        effect="every pixel fires, up and down",
        help="`detect_cuts` (on unless switched off) keeps it at one instant; `start`, `stop`",
    ),
    Check(
        name="cut",
        needs="cuts",
        is_found=lambda one: one["cuts"] > 0,
        value=lambda one: f"{one['cuts']:.0f}",
        limit="0",
        effect="most pixels fire at one instant, which no camera sees",
        help="`start`, `stop`: one shot; `detect_cuts` (on) keeps it at one instant",
    ),
    Check(
        name="dark",
        needs="bright_end",
        is_found=lambda one: one["bright_end"] < DARK_LEVEL,
        value=lambda one: f"95 % below level {one['bright_end']:.0f}",
        limit=f"{DARK_LEVEL:g}",
        effect="few events of the scene, many of noise",
        help="lower `balance`, `contrast_threshold`; noise='none'",
    ),
    Check(
        name="saturated",
        needs="dark_end",
        is_found=lambda one: one["dark_end"] > BRIGHT_LEVEL,
        value=lambda one: f"95 % above level {one['dark_end']:.0f}",
        limit=f"{BRIGHT_LEVEL:g}",
        effect="clipped: motion in it fires nothing",
        help=f"`white_level`, if white is another value; {ANOTHER_SEED}",
    ),
    Check(
        name="noise",
        needs="correlation",
        is_found=lambda one: one["correlation"] < NOISE_CORRELATION,
        value=lambda one: f"correlation {one['correlation']:.2f}",
        limit=f"at least {NOISE_CORRELATION:g}",
        effect="every pixel fires by itself",
        help=f"a smaller `sensor` averages it; {ANOTHER_SEED}",
    ),
    Check(
        name="time jump",
        is_failure=False,
        needs="jumps",
        is_found=lambda one: one["jumps"] > 0,
        value=lambda one: (
            f"{one['jumps']:.0f}, of up to {one['longest_jump_s']:,.6g} s"
            if one["jumps"]
            else "none"
        ),
        limit=f"{SHORTEST_US // MICROSECONDS} s and {RATIO} usual steps",
        effect="noise alone fills it; an hour or more is refused",
        help="`fps`; `start`, `stop`: one part",
    ),
    Check(
        name="missing frames",
        is_failure=False,
        needs="missing",
        is_found=lambda one: one["missing"] > 0,
        value=lambda one: f"{'a gap' if one['missing'] else 'no gap'} in the numbers of images",
        limit="0",
        effect="later frames come too early",
        help="`timestamps`; put the images back",
    ),
    Check(
        name="repeated frames",
        is_failure=False,
        needs="repeat_share",
        is_found=lambda one: one["repeat_share"] > REPEAT_SHARE,
        value=_repeats,
        limit=f"{REPEAT_SHARE:.0%}",
        effect="silence, then twice the change: the rate beats, times are wrong",
        help="drop them (ffmpeg -vf mpdecimate), then `fps` with the true rate",
    ),
    Check(
        name="motion per frame",
        is_failure=False,
        needs="motion_px",
        is_found=lambda one: one["motion_share"] > MOTION_SHARE,
        value=_motion,
        limit=f"{MOTION_SHARE:.0%} of the side",
        effect="interpolation loses motion this fast: ghosts instead of edges",
        help="more frames per second; `motion` of a renderer; generate: interpolate='exact'",
    ),
)
"""In the order of the table."""


@dataclass(frozen=True)
class Finding:
    """One check of one video."""

    check: Check
    value: str
    """The measured value with its unit."""
    is_found: bool

    def as_facts(self) -> dict[str, Any]:
        """JSON-ready."""
        check = self.check
        return {
            "check": check.name, "is_found": self.is_found, "measured": self.value,
            "limit": check.limit, "effect": check.effect, "help": check.help,
        }  # fmt: skip


@dataclass(frozen=True)
class VideoReport:
    """Findings of the checks, of a video's measurements with or without those of motion."""

    measurements: Measurements

    @property
    def problems(self) -> tuple[str, ...]:
        """Faults of a video: frozen, no motion, flicker, flash, cut, dark, saturated, noise."""
        return self._found(is_failure=True)

    @property
    def remarks(self) -> tuple[str, ...]:
        """Findings of the other checks: the video is what it should be, and events suffer."""
        return self._found(is_failure=False)

    def _found(self, *, is_failure: bool) -> tuple[str, ...]:
        found = (one.check for one in self.findings if one.is_found)
        return tuple(check.name for check in found if check.is_failure == is_failure)

    @property
    def is_fine(self) -> bool:
        """True if the video has not failed."""
        return not self.problems

    @property
    def summary(self) -> str:
        """The problems in one line."""
        return ", ".join(self.problems)

    @property
    def findings(self) -> tuple[Finding, ...]:
        """Every check that was made, found or not."""
        made = [check for check in CHECKS if check.needs in self.measurements]
        return tuple(
            Finding(check, check.value(self.measurements), check.is_found(self.measurements))
            for check in made
        )

    def as_facts(self) -> dict[str, Any]:
        """JSON-ready, for metadata."""
        rounded = {name: round(value, 4) for name, value in self.measurements.items()}
        return {"problems": list(self.problems), "remarks": list(self.remarks), **rounded}


def check_video(frames: Iterable[Frame]) -> VideoReport:
    """Look through a clip once.

    Args:
        frames: a video; at least two frames, else it has no motion.
    """
    return VideoReport(measure_video(frames))
