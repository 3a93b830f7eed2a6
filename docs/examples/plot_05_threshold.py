"""
The contrast threshold decides how many events
==============================================

Each halving of the threshold gives about twice the events, or more.
"""

import matplotlib.pyplot as plt

import texvent

frames = texvent.video("a red ball bounces on the grass", sensor="64x48", duration=0.4, seed=3)
thresholds = (0.05, 0.1, 0.2, 0.4, 0.8)
figure, axes = plt.subplots()
for simulator in ("texvent", "esim"):
    counts = []
    for threshold in thresholds:
        name = "contrast_threshold" if simulator == "texvent" else "contrast_threshold_on"
        options = {name: threshold}
        if simulator == "esim":
            options["contrast_threshold_off"] = threshold
        counts.append(len(texvent.simulate(frames, simulator=simulator, **options)))
    axes.loglog(thresholds, counts, "o-", label=simulator)
axes.set_xticks(thresholds, [str(threshold) for threshold in thresholds])
axes.minorticks_off()
axes.set_xlabel("contrast threshold, log units")
axes.set_ylabel("events")
axes.legend()
