"""Numbers at an address, for kernels.

Large tables that never change are read at their address, which stands in the instant's record;
what makes such a table keeps it for as long as the process runs.
"""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

_pack: Any = cgutils.pack_array
_tuple_of: Any = types.UniTuple
_PLACES, _FOUR = _tuple_of(types.int64, 4), _tuple_of(types.float64, 4)
_FLOATS = ir.VectorType(ir.FloatType(), 4)
_DOUBLES = ir.VectorType(ir.DoubleType(), 4)


def _build_blend(typing_context: Any, *arguments: Any) -> Any:
    def build(context: Any, builder: Any, signature: Any, values: Any) -> Any:
        address, places, weights = values
        pointer = builder.inttoptr(address, ir.FloatType().as_pointer())
        total = ir.Constant(_DOUBLES, [0.0] * 4)
        for number in range(4):
            place = builder.extract_value(places, number)
            here = builder.bitcast(builder.gep(pointer, [place]), _FLOATS.as_pointer())
            four = builder.fpext(builder.load(here, align=4), _DOUBLES)
            weight = ir.Constant(_DOUBLES, ir.Undefined)
            for lane in range(4):
                weight = builder.insert_element(
                    weight, builder.extract_value(weights, number), ir.IntType(32)(lane)
                )
            total = builder.fadd(total, builder.fmul(four, weight))
        lanes = [builder.extract_element(total, ir.IntType(32)(lane)) for lane in range(4)]
        return _pack(builder, lanes)

    return _FOUR(types.int64, _PLACES, _FOUR), build


def _typed_blend(typing_context: Any, address: Any, places: Any, weights: Any) -> Any:
    return _build_blend(typing_context, address, places, weights)


blend_four: Any = intrinsic(_typed_blend)
"""`blend_four(address, places, weights)`: the weighted sum of four rows of four float32 numbers
that begin `places` (four integers) numbers after the address; four float64."""
