"""
Metrics see different errors
============================

A stream is scored against itself after its times were jittered, or events were dropped.
"""

import matplotlib.pyplot as plt
import numpy as np

import texvent

events = texvent.generate("a dog runs right", sensor="96x72", duration=0.4, seed=3)
rng = np.random.default_rng(0)


def jittered(sigma_us):
    """Events with normal errors of their times."""
    t = np.maximum(events.t + rng.normal(0, sigma_us, len(events)).astype(int), 0)
    order = np.argsort(t, kind="stable")
    x, y, p = (column[order] for column in (events.x, events.y, events.p))
    return texvent.EventStream(x, y, t[order], p, events.size)


sigmas = (1, 1000, 3000, 10_000, 30_000)
shares = (0, 0.1, 0.25, 0.5, 0.75)
changed = {
    "times jittered by, ms": (np.array(sigmas) / 1000, [jittered(s) for s in sigmas]),
    "share of events dropped": (shares, [events[rng.random(len(events)) >= s] for s in shares]),
}
figure, axes = plt.subplots(1, 2, figsize=(7, 3.2), sharey=True)
for panel, (label, (values, streams)) in zip(axes, changed.items(), strict=True):
    scores = [texvent.compare(one, events, ["stpp", "van_rossum"]) for one in streams]
    for name in ("stpp", "van_rossum"):
        panel.plot(values, [score[name] for score in scores], "o-", label=name)
    panel.set_xlabel(label)
axes[0].legend()
