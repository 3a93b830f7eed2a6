"""
Frames of your own
==================

A NumPy array is a video: here a bar that turns twice a second.
"""

import matplotlib.pyplot as plt
import numpy as np

import texvent

y, x = np.mgrid[-48:48, -64:64]
angles = np.arange(30) / 30 * 2 * np.pi
bars = [np.abs(x * np.sin(a) - y * np.cos(a)) < 4 for a in angles]
inside = np.hypot(x, y) < 44
frames = np.stack([np.where(bar & inside, 220, 60) for bar in bars]).astype(np.uint8)
events = texvent.simulate(frames, fps=60, noise="none")

# %%
# In time the edges of the bar draw two screws.

axes = plt.figure(figsize=(7, 5)).add_subplot(projection="3d")
shown = events[:: max(1, len(events) // 15_000)]
axes.scatter(shown.t / 1000, shown.x, -shown.y.astype(int), c=shown.p, cmap="bwr_r", s=0.5)
axes.set_xlabel("t, ms")
axes.set_ylabel("x")
axes.set_zlabel("−y")
axes.view_init(20, -60)
