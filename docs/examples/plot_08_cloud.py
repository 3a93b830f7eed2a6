"""
The cloud of a bouncing ball
============================

Events in space and time. `events.show()` opens the same in the browser, to turn and play.
"""

import texvent

events = texvent.generate("a red ball bounces", sensor="96x72", duration=1.0, seed=3, noise="none")
axes = events.plot("cloud")
