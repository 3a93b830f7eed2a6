"""
Six representations
===================

What networks read: the same 30 ms as dense arrays.
"""

import matplotlib.pyplot as plt

import texvent

events = texvent.generate("a dog runs right", sensor="128x96", duration=0.3, seed=3)
part = events.between(150_000, 180_000)
figure, axes = plt.subplots(2, 3, figsize=(7, 4))
names = (
    "event-frame",
    "voxel-e2vid",
    "time-surface",
    "stacked-histogram",
    "timestamp-image",
    "voxel-dsec",
)
for name, panel in zip(names, axes.flat, strict=True):
    array = part.represent(name)
    image = array if array.ndim == 2 else array[-1]
    if array.min() < 0:  # signed: as many colours for OFF as for ON
        panel.imshow(image, "RdBu", vmin=-3, vmax=3)
    else:
        panel.imshow(image, "gray_r")
    panel.set_title(f"{name}\n{list(array.shape)}", fontsize=9)
    panel.axis("off")
