"""A grid of reconstructed images, one row per source of events, and the true frames."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from texvent.view.drawing.canvas import Image, blank, draw_text, png_bytes
from texvent_lab.bench.real.frame_recording import FrameRecording
from texvent_lab.bench.reconstruction.image_scores import true_image
from texvent_lab.reconstruct.reconstructor import Intensity

TITLE_PX, MARGIN_PX = 11, 6
PAPER, INK = (236, 238, 242), (38, 42, 50)
TRUE = "frames"


class ReconstructionGrid:
    """Collects images while they are made: a row per source of events, a column per instant.

    Call it with (recording, source, time in µs, image), as `ReconstructionScorer.on_image` is.
    """

    def __init__(self, recording: FrameRecording, times_us: Sequence[int]) -> None:
        """An empty grid with the true frames in its first row.

        Args:
            recording: whose images are kept.
            times_us: instants to show, µs; each shows the first frame at or after it.
        """
        self._name = recording.name
        frames = {}
        wanted = sorted(times_us)
        for frame in recording.frames:
            if wanted and frame.t_us >= wanted[0]:
                frames[frame.t_us] = true_image(frame)
                wanted = [t_us for t_us in wanted if t_us > frame.t_us]
        self._rows: dict[str, dict[int, Intensity]] = {TRUE: frames}

    def __call__(self, recording: str, source: str, t_us: int, image: Intensity) -> None:
        """Keep the image if it belongs to the grid."""
        if recording == self._name and t_us in self._rows[TRUE]:
            self._rows.setdefault(source, {})[t_us] = image

    def png(self) -> bytes:
        """The grid as a PNG file."""
        times = list(self._rows[TRUE])
        height, width = self._rows[TRUE][times[0]].shape
        step_y, step_x = height + TITLE_PX + 2 * MARGIN_PX, width + MARGIN_PX
        whole = blank(len(times) * step_x + MARGIN_PX, len(self._rows) * step_y + MARGIN_PX, PAPER)
        for row, (source, images) in enumerate(self._rows.items()):
            top = row * step_y + MARGIN_PX
            draw_text(whole, source, MARGIN_PX, top + TITLE_PX, height=TITLE_PX - 1, colour=INK)
            top += TITLE_PX + MARGIN_PX
            for column, t_us in enumerate(times):
                left = column * step_x + MARGIN_PX
                if t_us in images:
                    whole[top : top + height, left : left + width] = _grey(images[t_us])
        return png_bytes(whole, level=9)


def _grey(image: Intensity) -> Image:
    levels = np.rint(np.clip(image, 0.0, 1.0) * 255.0).astype(np.uint8)
    return np.repeat(levels[..., None], 3, axis=2)
