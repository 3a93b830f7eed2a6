"""
Training samples on the fly
===========================

Every sample has a seed of its own, and brings its targets. Nothing is stored.
"""

import matplotlib.pyplot as plt

from texvent.dataset import SimulatedSamples

samples = SimulatedSamples(
    prompts=["a red car drives left", "a dog runs right"],
    representation="voxel-e2vid",
    slice_us=50_000,
    targets=["frame"],
    simulation={"sensor": "96x72", "duration": 0.15, "randomize": "stoffregen"},
    seed=1,
)
figure, axes = plt.subplots(2, 4, figsize=(7, 3))
for number, (above, below) in enumerate(axes.T):
    sample = samples.make(number)
    above.imshow(sample["representation"][1].sum(axis=0), "RdBu", vmin=-1, vmax=1)
    below.imshow(sample["frame"][1], "gray", vmin=0, vmax=255)
    above.set_title(f"sample {number}", fontsize=9)
    above.axis("off")
    below.axis("off")
