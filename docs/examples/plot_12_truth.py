"""
Ground truth
============

The embedded generator knows depth, optical flow and the object behind every event.
"""

from pathlib import Path
from tempfile import mkdtemp

import matplotlib.pyplot as plt
import numpy as np

import texvent

folder = Path(mkdtemp()) / "car.truth"
events = texvent.generate(
    "a red car drives left past two trees",
    sensor="128x96",
    duration=0.3,
    seed=3,
    truth_folder=folder,
)
truth = texvent.load_truth(folder)
frame = len(truth) // 2
speed = np.hypot(*np.moveaxis(truth.flow(frame), -1, 0))
objects = np.zeros((96, 128), int)
objects[events.y, events.x] = events.instance

figure, axes = plt.subplots(1, 3, figsize=(7, 2.2))
images = {
    "depth, m": (np.minimum(truth.depth(frame), 60), "viridis_r"),
    "flow, px per frame": (speed, "magma"),
    "object of each event": (objects, "tab10"),
}
for panel, (title, (image, colours)) in zip(axes, images.items(), strict=True):
    panel.imshow(image, colours)
    panel.set_title(title)
    panel.axis("off")
