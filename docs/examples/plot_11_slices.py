"""
Slices of equal time, or of equal count
=======================================

Equal times show speed; equal counts show equal detail.
"""

import matplotlib.pyplot as plt

import texvent
from texvent.represent.slices import slices

events = texvent.generate("a red ball bounces", sensor="96x72", duration=0.8, seed=3, noise="none")
rows = {
    "100 ms": list(slices(events, duration_us=100_000)),
    "1,000 events": list(slices(events, count=1000)),
}
figure, axes = plt.subplots(2, 5, figsize=(7, 2.6))
for (name, parts), panels in zip(rows.items(), axes, strict=True):
    for part, panel in zip(parts, panels, strict=False):
        panel.imshow(part.represent("event-frame"), "RdBu", vmin=-2, vmax=2)
        panel.set_title(f"{len(part):,}", fontsize=9)
        panel.set_xticks([])
        panel.set_yticks([])
    panels[0].set_ylabel(name)
