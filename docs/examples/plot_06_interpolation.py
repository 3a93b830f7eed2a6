"""
What happens between two frames
===============================

One row of the sensor over time. Without intermediate frames the events of an interval lie anywhere
between the two edges; motion compensation puts them where the edge was.
"""

import matplotlib.pyplot as plt
import numpy as np

import texvent

y, x = np.mgrid[:48, :96]
frames = [np.where(np.hypot(x - 15 - 6 * i, y - 24) < 9, 220, 60) for i in range(12)]
clip = np.stack(frames).astype(np.uint8)

figure, axes = plt.subplots(1, 3, figsize=(7, 3), sharey=True)
for panel, way in zip(axes, ("none", "blend", "flow"), strict=True):
    events = texvent.simulate(clip, fps=24, interpolate=way, simulator="esim")
    row = events[events.y == 24]
    panel.scatter(row.t / 1000, row.x, c=row.p, cmap="bwr_r", s=4)
    panel.set_title(way)
    panel.set_xlabel("t, ms")
axes[0].set_ylabel("x of row 24")
