"""
Pixel models side by side
=========================

The same frames through six models, each with its own defaults.
"""

import matplotlib.pyplot as plt

import texvent

frames = texvent.video("a dog runs across a meadow", sensor="128x96", duration=0.3, seed=1)
names = ("texvent", "esim", "v2e", "physical", "voltmeter", "senpi")

figure, axes = plt.subplots(2, 3, figsize=(7, 4))
for name, panel in zip(names, axes.flat, strict=True):
    events = texvent.simulate(frames, simulator=name, seed=1)
    part = events.between(150_000, 180_000)
    panel.imshow(part.represent("event-frame"), "RdBu", vmin=-3, vmax=3)
    panel.set_title(f"{name}: {len(events):,} events", fontsize=8)
    panel.axis("off")
