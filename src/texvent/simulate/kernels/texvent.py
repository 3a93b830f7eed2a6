"""What a Texvent kernel keeps per pixel, which pixels it looks at closely, and how it draws noise.

The definition of the model is float64 NumPy on whole frames (`texvent.simulate.texvent_reference`).
A fast backend must return the same events, bit for bit, without a logarithm per pixel. It can,
because an event needs three things only, and each is told here once for all backends.

**State.** One array per pixel, `reference`: the intensity R that the pixel compares with, in the
type of the frames (uint8, uint16 or float32 luma; once frames of two types have come, float32,
which holds all three exactly). That is the whole state, because Eq. 5's cached reference is always
the intensity of an earlier frame: where a pixel fires, R becomes the frame's intensity there; where
the cache forgets (`local` after a source frame, `none` after every frame), R becomes the frame.
Only `reset="step"` and `cache="leaky"` move references between intensities. They keep two arrays
instead: `level`, the reference brightness itself, float64, exact; and `reference`, float32, the
balanced intensity exp(level), for the scan alone, rounded any way, within a relative 10⁻⁷.

**Trigger levels.** With brightness L = ln(α + I) an event is

    |L(I) − L(R)| ≥ δ   ⇔   α + I ≥ (α + R)·e^δ   or   α + I ≤ (α + R)·e^−δ ,

so a scan needs two multiplications and two comparisons per pixel, in float32. To be sure that
rounding hides no event the levels are brought together by a margin (`SCAN_MARGIN`, ten times the
rounding error): a pixel outside them *may* fire (a candidate), a pixel inside cannot. A candidate
fires if and only if `L(I) − L(R)`, both in float64 as `brightness.balanced_log` computes them,
differs from 0 by δ or more. For 8-bit frames a look-up table of 256 logarithms does that, for
16-bit ones one of 65,536; float frames take NumPy's logarithm of the candidates. For 8-bit frames
there is an even cheaper scan, on bytes: no pixel fires whose intensity differs from R by less than
the smallest difference of any two levels that fires.

**Noise.** Eq. 6 is a Poisson process of `mean` = λ1·λ2 events per pixel. The frame is cut into runs
of `NOISE_BLOCK` pixels in row-major order. Block b draws how many events its pixels would have if
all were noisy, and for each a place and a time, both uniform; then the mask of Eq. 6 is applied
where they fell. A Poisson number per block with uniform places is the same distribution as a
Poisson number per pixel, and costs time only where noise is. All draws are hashes
(`draws.draw_words`) of the frame's key, with y, x = b div 2¹⁶, b mod 2¹⁶:

    u  = uniform(NOISE_COUNT.draw())        count: Poisson quantile of u, mean · NOISE_BLOCK
    wₖ = word(NOISE_PLACE.draw(k))          k = 0..count−1; its top 12 bits: pixel in the block;
                                            its other 52 · 2⁻⁵²: time, fraction of the interval
    vₖ = uniform(NOISE_POLARITY.draw(k))    ON where vₖ < on_fraction

Places beyond the last pixel of the frame are dropped. Blocks know nothing of each other, so bands,
threads, chunks and GPUs draw the same noise.

**Order.** Events of a packet are ordered by (t, y, x, p, label).
"""

from __future__ import annotations

NOISE_BLOCK = 4096
"""Pixels per noise block; also what a scan works on at a time."""
NOISE_PLACE_SHIFT = 52
"""By how many bits a place word is shifted to give the pixel in its block."""
SCAN_MARGIN = 1e-6
"""Relative distance by which the scan's levels are brought together: over four roundings."""
