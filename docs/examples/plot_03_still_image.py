"""
A still image under a moving camera
===================================

Eyes and N-MNIST's sensor see a still image by moving. The events of each saccade show the edges
across its direction.
"""

import matplotlib.pyplot as plt
import numpy as np

import texvent

y, x = np.mgrid[:384, :512]
image = np.full((384, 512), 90, np.uint8)
image[np.hypot(x - 150, y - 190) < 90] = 210
image[(abs(x - 370) < 80) & (abs(y - 190) < 80)] = 30
events = texvent.simulate(image, camera="saccade", sensor="128x96", noise="none")

figure, axes = plt.subplots(1, 3, figsize=(7, 2.2))
for number, panel in enumerate(axes):
    part = events.between(number * 105_000, (number + 1) * 105_000)
    panel.imshow(part.represent("event-frame"), "RdBu", vmin=-6, vmax=6)
    panel.set_title(f"saccade {number + 1}")
    panel.axis("off")
