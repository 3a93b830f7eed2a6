"""
A stereo rig
============

Two cameras on one body, 12 cm apart: near things shift more.
"""

from pathlib import Path
from tempfile import mkdtemp

import matplotlib.pyplot as plt

import texvent

folder = Path(mkdtemp()) / "ball"
texvent.rig.record(
    "a red ball rolls left past a tree",
    folder,
    stereo=0.12,
    sensor="96x72",
    duration=0.4,
)
figure, axes = plt.subplots(1, 2, figsize=(7, 2.9))
for panel, camera, title in zip(axes, ("cam0", "cam1"), ("left", "right"), strict=True):
    events = texvent.load(folder / camera / "events.h5")
    panel.imshow(events.between(200_000, 260_000).represent("event-frame"), "RdBu", vmin=-2, vmax=2)
    panel.set_title(f"{title}: {len(events):,} events")
    panel.axis("off")
