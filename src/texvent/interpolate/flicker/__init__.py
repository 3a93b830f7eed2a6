"""A lamp of known frequency: taken off the source frames, put back on the frames between them.

Frames show a lamp that beats faster than they come at its alias: at 24 frames per second, 37 Hz,
11 Hz and 13 Hz give the same frames. Whoever knows the frequency resolves that.

    light(t) = (steady(t) + a cos 2πft + b sin 2πft) · (1 + c cos 2πft + d sin 2πft)

`windows.py` keeps the last frames, `fit_reference.py` and `fit_cpu.py` find a and b of each pixel,
`image_gain.py` c and d of the image, `known_light.py` takes both off and puts them back.
"""
