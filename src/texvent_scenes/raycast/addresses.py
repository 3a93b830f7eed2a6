"""Items of arrays by address, in kernels (Numba).

Numba passes an array as seven numbers or more and counts references to it, at every call. The ray
caster passes a scene through many small functions per ray; with arrays that took most of the time.
So kernels pass one record on, `INSTANT_RECORD`, which has the addresses of all arrays of a
`World`; they are valid while the world lives. No index is checked.
"""

from __future__ import annotations

import ctypes
from typing import Any

import numba
import numpy as np
from numba import types

from texvent.runtime.jit import intrinsic
from texvent_scenes.raycast.records import (
    GLOW_RECORD,
    IMAGE_RECORD,
    MIRRORED_RECORD,
    NODE_RECORD,
    SEEN_MEDIUM_RECORD,
    SHAPE_RECORD,
    TRIANGLE_RECORD,
)
from texvent_scenes.rendered_scene import LAMP_RECORD


def _reader(dtype: Any) -> Any:
    """`read(address, index)`, in a kernel: item `index` of an array of `dtype` at an address."""
    kind: Any = numba.from_dtype(np.dtype(dtype))
    size = np.dtype(dtype).itemsize
    wide = {types.int32: types.int64, types.float32: types.float64}.get(kind, kind)

    def build_reader(typing_context: Any, address: Any, index: Any) -> Any:
        def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            offset = builder.mul(arguments[1], arguments[1].type(size))
            place, item = builder.add(arguments[0], offset), context.get_value_type(kind)
            if isinstance(kind, types.Record):
                return builder.inttoptr(place, item)
            value = builder.load(builder.inttoptr(place, item.as_pointer()))
            return context.cast(builder, value, kind, wide)

        return wide(types.int64, types.int64), build

    def read(address: int, index: int) -> Any:
        memory = (ctypes.c_char * size).from_address(int(address) + int(index) * size)
        item = np.frombuffer(memory, dtype).view(np.recarray)[0]
        return item if isinstance(item, np.record) else item.item()

    return intrinsic(build_reader, read)


shape_at: Any = _reader(SHAPE_RECORD)
lamp_at: Any = _reader(LAMP_RECORD)
medium_at: Any = _reader(SEEN_MEDIUM_RECORD)
glow_at: Any = _reader(GLOW_RECORD)
mirrored_at: Any = _reader(MIRRORED_RECORD)
node_at: Any = _reader(NODE_RECORD)
triangle_at: Any = _reader(TRIANGLE_RECORD)
image_at: Any = _reader(IMAGE_RECORD)
list_at: Any = _reader(np.int32)
texel_at: Any = _reader(np.float32)
