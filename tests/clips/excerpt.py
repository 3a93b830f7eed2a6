"""Cut the committed clip; see README.md for the command."""

import sys
from fractions import Fraction

import av

# The film was made at 24 fps and repeats every 25th picture; these 25 are all different.
FIRST, COUNT = 7, 25
WIDTH, HEIGHT = 320, 180


def cut(source: str, target: str) -> None:
    with av.open(source) as film, av.open(target, "w", options={"movflags": "faststart"}) as clip:
        stream = clip.add_stream("libx264", rate=25, options={"crf": "23", "preset": "slow"})
        stream.width, stream.height, stream.pix_fmt = WIDTH, HEIGHT, "yuv420p"
        for index, frame in enumerate(film.decode(video=0)):
            if FIRST <= index < FIRST + COUNT:
                small = frame.reformat(WIDTH, HEIGHT, "yuv420p")
                small.pts, small.time_base = index - FIRST, Fraction(1, 25)
                clip.mux(stream.encode(small))
        clip.mux(stream.encode(None))


if __name__ == "__main__":
    cut(*sys.argv[1:])
