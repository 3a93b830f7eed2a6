"""A scene drawn at one instant after another: only tiles that can differ are drawn anew."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from texvent.scenes.raycast.acceleration import TILE
from texvent.scenes.raycast.render import light_of_rows, world_and_shapes
from texvent.scenes.raycast.reuse.changed import Drawn, changed_tiles
from texvent.scenes.scene import Float32Array, Float64Array, Scene
from texvent.sensor import SensorSize
from texvent.transfer import encode_srgb

MOST_CHANGED = 0.9
"""Above this share of tiles all are drawn."""


class FrameMemory:
    """Draws a scene as `render` does, to the last bit, and remembers the last frame.

    Several threads may use it: each call reads the last frame once and replaces it whole.

    Args:
        scene: what is drawn.
        size: of the frames, pixels.
        samples: as for `render`.
        shadows: as for `render`.
        code: makes levels of light (1 is white).
    """

    def __init__(
        self,
        scene: Scene,
        size: SensorSize,
        *,
        samples: int,
        shadows: bool,
        code: Callable[[Float64Array], Float32Array] = encode_srgb,
    ) -> None:
        self._scene, self._size, self._code = scene, size, code
        self._samples, self._shadows = samples, shadows
        self._last: tuple[Drawn, Float32Array] | None = None

    def render(self, time_s: float) -> Float32Array:
        """The frame at an instant, [H, W, 3], coded."""
        size, samples = self._size, self._samples
        world, primitives = world_and_shapes(
            self._scene, time_s, size, shadows=self._shadows, samples=samples
        )
        drawn, last = Drawn(world, primitives), self._last
        tiles = None if last is None else changed_tiles(last[0], drawn)
        if last is None or tiles is None or tiles.mean() > MOST_CHANGED:
            light = light_of_rows(world, (0, size.height), size, samples=samples)
            pixels = self._code(light)
        else:
            wanted = tiles.repeat(TILE, axis=0).repeat(TILE, axis=1)[: size.height, : size.width]
            light = light_of_rows(world, (0, size.height), size, samples=samples, wanted=wanted)
            pixels = last[1].copy()
            pixels[wanted] = self._code(light[wanted])
        kept = pixels.copy()
        kept.flags.writeable = False
        self._last = drawn, kept
        return np.asarray(pixels)
