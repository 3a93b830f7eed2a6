"""Clips whose faults are known."""

from fractions import Fraction

import av
import numpy as np

from texvent.frames import Frame, frame_time_us


def texture(height=96, width=320, seed=3, blur=3):
    """A smooth random image, 20..235."""
    noise = np.random.default_rng(seed).normal(size=(height, width))
    for axis in (0, 1):
        for _ in range(blur):
            noise = (np.roll(noise, 1, axis) + 2 * noise + np.roll(noise, -1, axis)) / 4
    noise = (noise - noise.min()) / np.ptp(noise)
    return (20 + 215 * noise).astype(np.float32)


def pan(count=30, width=128, step=2, **of_texture):
    """[N, H, W]: a textured image that moves `step` px per frame."""
    ground = texture(width=width + step * count, **of_texture)
    return np.stack([ground[:, step * i : step * i + width] for i in range(count)])


def frames(images, fps=24):
    """Frames at a regular rate."""
    return [Frame(np.asarray(one), frame_time_us(i, Fraction(fps))) for i, one in enumerate(images)]


def encode(images, path, *, codec="libx264", fps=24, **options):
    """Write grey images [N, H, W] as video; `options` are the codec's."""
    with av.open(str(path), "w") as file:
        stream = file.add_stream(codec, rate=fps, options=options)
        stream.height, stream.width = images[0].shape
        stream.pix_fmt = "yuv420p"
        for image in images:
            grey = np.clip(np.rint(image), 0, 255).astype(np.uint8)
            rgb = np.repeat(grey[..., None], 3, axis=2)
            file.mux(stream.encode(av.VideoFrame.from_ndarray(rgb, format="rgb24")))
        file.mux(stream.encode())
    return path
