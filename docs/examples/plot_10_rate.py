"""
Event rate over time
====================

A ball makes most events when it is fastest, and few at the top of its flight.
"""

import texvent

events = texvent.generate("a red ball bounces", sensor="96x72", duration=1.5, seed=3)
axes = events.plot("rate", bin_us=20_000)
