"""
Noise, and which events it made
===============================

With `label_noise` every event says whether noise made it.
"""

import matplotlib.pyplot as plt

import texvent

events = texvent.generate(
    "a red ball bounces on the grass",
    sensor="96x72",
    duration=0.4,
    seed=3,
    simulator="physical",
    noise_scale=8.0,
    label_noise=True,
)
figure, axes = plt.subplots(1, 2, figsize=(7, 3))
for panel, label, title in zip(axes, (0, 1), ("signal", "noise"), strict=True):
    part = events[events.label == label]
    panel.imshow(part.represent("event-frame"), "RdBu", vmin=-3, vmax=3)
    panel.set_title(f"{title}: {len(part):,} events")
    panel.axis("off")
