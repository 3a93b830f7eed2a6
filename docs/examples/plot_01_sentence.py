"""
A sentence
==========

The frame that the embedded generator draws, and the events until the next one.
"""

import matplotlib.pyplot as plt

import texvent

options = {"sensor": "173x130", "duration": 0.4, "seed": 3}
prompt = "a red car drives left past two trees at dusk"
frames = list(texvent.video(prompt, **options))
events = texvent.generate(prompt, **options)

# %%
middle = len(frames) // 2
start, stop = frames[middle].t_us, frames[middle + 1].t_us
figure, (left, right) = plt.subplots(1, 2)
left.imshow(frames[middle].pixels.clip(0, 255) / 255)
right.imshow(events.between(start, stop).represent("event-frame"), "RdBu", vmin=-2, vmax=2)
for axes in (left, right):
    axes.axis("off")
