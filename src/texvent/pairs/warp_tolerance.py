"""How far two flows may disagree before they are no longer trusted.

The error of a flow is the distance between the path it claims (from the earlier to the later
frame) and the path that the flow of the other direction claims for the same point. Squared, e, and
with a squared tolerance T, the flow is trusted by T² / (T² + e²): 1 for no error, 1/2 at the
tolerance, falling to 0 with the fourth power of the error.
"""

VISIBLE_RELATIVE = 0.01
VISIBLE_PX2 = 0.1
"""A point counts as seen in a frame if its squared error is below
`VISIBLE_RELATIVE · |path|² + VISIBLE_PX2`, px²: a third of a pixel plus a tenth of the path. This
is the usual occlusion test (Sundaram, Brox and Keutzer 2010), made gradual."""

UNSEEN_WEIGHT = 0.2
"""What a frame still counts at a point that it seems not to show, as far as the other frame is not
trusted either."""

LOST_RELATIVE = 0.5
LOST_PX2 = 2.0
"""The motion counts as lost if, in both frames, the squared error is above
`LOST_RELATIVE · |path|² + LOST_PX2`, px²: an error of 0.7 of the path says nothing about motion.
There the two frames are blended where they are."""

CONTESTED_RELATIVE, CONTESTED_PX2 = 0.1, 16.0
"""Where the two flows at a pixel differ by more than this share of the longer one, squared, plus
this, px², two surfaces meet there, and the path is chosen among theirs."""

CLEARLY_BETTER = 0.3
"""By how much more the flows must confirm another path (0..2) to take it instead of the mean."""

SWEPT = 1.5
"""How well the flows must confirm what passes in front, 0..2."""

LEAST_SWEEP_PX2, MOST_SWEEP_PX2 = 9.0, 2304.0
"""What moves less, squared, covers each pixel of its path in one of the frames. What moves more is
not followed along its path, which would take too long."""

MOST_PX2 = 1e9
"""Squares of longer paths and larger errors count as this, so that float32 can hold the products
of the weights."""
