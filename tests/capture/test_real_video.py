"""The whole path on a real film: frames in, events out."""

from pathlib import Path

import texvent

EXCERPT = Path(__file__).parents[1] / "clips" / "bigbuckbunny_excerpt.mp4"


def test_a_real_film_becomes_events_where_it_moves():
    events = texvent.simulate(EXCERPT, sensor="160x90", interpolate="blend", noise="none")
    assert events.size == (160, 90)
    start_us, stop_us = events.time_range
    assert start_us < 80_000
    assert 900_000 < stop_us <= 960_000
    assert {int(p) for p in events.p} == {0, 1}
    # The rabbit gets up in the left half; on the right a still meadow and sky.
    left = int((events.x < 80).sum())
    assert left > 3 * (len(events) - left)
