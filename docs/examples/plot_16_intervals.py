"""
Times between events of a pixel
===============================

Texvent's preset gives a pixel at most one event per intermediate frame. ESIM gives as many
as the change of brightness asks for.
"""

import matplotlib.pyplot as plt

import texvent

frames = texvent.video("a dog runs right", sensor="96x72", duration=0.5, seed=3)
figure, axes = plt.subplots(1, 2, figsize=(7, 3), sharex=True)
for panel, simulator in zip(axes, ("texvent", "esim"), strict=True):
    texvent.simulate(frames, simulator=simulator, seed=1).plot("isi", ax=panel)
    panel.set_title(simulator)
