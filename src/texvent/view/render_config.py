"""How a recording is made visible: the options of `texvent render`."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from texvent.config import check_range
from texvent.errors import ConfigError
from texvent.video import MICROSECONDS
from texvent.view.drawing.annotations import Overlay
from texvent.view.drawing.palettes import DEFAULT_PALETTE, get_palette
from texvent.view.page.sample import SAMPLE_EVENTS


@dataclass(frozen=True, kw_only=True)
class RenderConfig:
    """How events are made visible."""

    render_fps: Fraction = Fraction(30)
    """Images per second of video."""
    window: float | None = None
    """Time that one image gathers, in ms of the recording. Without it, videos show every event
    once and images show at most 40 ms."""
    events_per_image: int | None = None
    """Fixed count instead of fixed time: every image gathers this many events, however long
    that takes; a video shows one such slice after the other."""
    decay: float | None = None
    """Let events fade instead of counting them: exp(-age / decay), decay in ms (30 is usual)."""
    speed: float = 1.0
    """Speed of the video: 0.1 is ten times slower than the recording."""
    palette: str = DEFAULT_PALETTE
    """Colours of ON and OFF events."""
    panels: int = 1
    """Images on a PNG: 1 shows the busiest moment, more show moments evenly spaced."""
    overlay: Overlay = "none"
    """Boxes with class names, optical flow (arrows as long as the motion in 50 ms), or both, for
    scenes that the embedded generator renders again."""
    points: int = SAMPLE_EVENTS
    """Most events in the cloud of a page or .rrd file; more are drawn uniformly at random."""

    def __post_init__(self) -> None:
        get_palette(self.palette)
        check_range("speed", self.speed, 1e-6, 1e6)
        check_range("panels", self.panels, 1, 100)
        check_range("points", self.points, 1, 20_000_000)
        ways = {
            "window": self.window,
            "events_per_image": self.events_per_image,
            "decay": self.decay,
        }
        given = {name: value for name, value in ways.items() if value is not None}
        if len(given) > 1:
            raise ConfigError(
                f"{' and '.join(given)} are different ways to gather events; give one of them"
            )
        for name, value in given.items():
            check_range(name, value, 1 if name == "events_per_image" else 0.001, 1e12)
        if not 0 < self.render_fps <= 1000:
            raise ConfigError(f"render_fps is {self.render_fps}; it must be above 0, at most 1000")

    @property
    def window_us(self) -> int | None:
        """The window in µs."""
        return None if self.window is None else max(1, round(self.window * 1000))

    @property
    def step_us(self) -> Fraction:
        """Time of the recording from one video frame to the next, µs, exact."""
        return Fraction(self.speed) * MICROSECONDS / self.render_fps

    @property
    def tau_us(self) -> int | None:
        """Decay time in µs."""
        return None if self.decay is None else max(1, round(self.decay * 1000))
