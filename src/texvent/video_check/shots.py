"""Cuts and flashes, as the simulation sees them."""

from __future__ import annotations

from texvent.pairs.scene_change import SceneChange, detect_scene_change
from texvent.video_check.blocks import SeenFrame


class Shots:
    """Counts the pairs that `detect_scene_change` calls a cut."""

    def __init__(self) -> None:
        self._previous: SeenFrame | None = None
        self.cut_times_us: list[int] = []
        """Times of the first frames of new shots, µs."""

    def add(self, seen: SeenFrame) -> None:
        """Take one frame."""
        if self._previous is not None:
            change = detect_scene_change(self._previous.frame, seen.frame)
            if change is SceneChange.CUT:
                self.cut_times_us.append(seen.frame.t_us)
        self._previous = seen

    def measures(self) -> dict[str, float]:
        """`cuts`: how many."""
        return {"cuts": float(len(self.cut_times_us))}
