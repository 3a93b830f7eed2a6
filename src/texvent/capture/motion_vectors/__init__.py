"""Motion vectors, depth and ids that a renderer gives with its frames, from files and arrays.

`frames.attach_motion` adds them to a stream of frames. `conventions` is the table of units, signs
and axes, `fields` reads the files, `check` warps frames to test the convention.
"""
