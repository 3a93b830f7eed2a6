"""Motion vectors, depth and ids that a renderer gives with its frames, from files and arrays.

`attach.attach_motion` adds them to a stream of frames. `conventions` is the table of what numbers
mean, `fields` the table of file formats, `check` warps frames to see whether the meaning is right.
"""
