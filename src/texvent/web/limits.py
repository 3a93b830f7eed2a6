"""Limits of one job of the web page."""

from __future__ import annotations

from dataclasses import dataclass

from texvent.config import check_range


@dataclass(frozen=True, kw_only=True)
class Limits:
    """Bounds of one job."""

    max_upload_mb: float = 200.0
    """Largest video that may be uploaded, MB."""
    max_seconds: float = 20.0
    """Longest video or scene, seconds."""
    max_pixels: int = 1920 * 1080
    """Most pixels of a video frame or sensor."""
    max_events: int = 50_000_000
    """Most events of one job."""
    time_limit: float = 600.0
    """Longest work on one job, seconds; then it is stopped."""
    max_memory_gb: float = 8.0
    """Most memory that a job may take beside the programs it loads, GB; learned generators are
    exempt."""
    max_waiting: int = 20
    """Most jobs that wait for their turn; further visitors are asked to come back."""

    def __post_init__(self) -> None:
        check_range("max_upload_mb", self.max_upload_mb, 0.001, 1e6)
        check_range("max_seconds", self.max_seconds, 0.01, 86_400)
        check_range("max_pixels", self.max_pixels, 16, 1e9)
        check_range("max_events", self.max_events, 1, 1e11)
        check_range("time_limit", self.time_limit, 1, 1e6)
        check_range("max_memory_gb", self.max_memory_gb, 0.5, 1e5)
        check_range("max_waiting", self.max_waiting, 1, 10_000)
