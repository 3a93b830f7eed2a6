"""Patches of 8×8 float32 as one vector per row, for other compiled kernels.

LLVM vectorises long loops, but unrolls a loop over eight numbers before it tries. So these are
written in LLVM's own language with vector types. Sums are taken row by row, then over the eight
columns by halves, so their bits are the same on every processor.

`layout` locates a patch by four whole numbers: pixels per image; flat index of the patch's first
pixel; flat index of the pixel up left of its place in the other image; pixels per row, in both
images.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from llvmlite import ir
from numba.core import types

from texvent.interpolate.dis_flow.definitions import PATCH
from texvent.runtime.jit import intrinsic

_FLOAT, _INT = ir.FloatType(), ir.IntType(32)
_ROW = ir.VectorType(_FLOAT, PATCH)
_ANY_ROW = ir.Constant(_ROW, ir.Undefined)


def _compare_patch(typing_context: Any, start: Any, stop: Any, layout: Any, weights: Any) -> Any:
    """Difference of a patch from its place in another image.

    Args:
        typing_context: Numba's.
        start: image of the patch, its slope_x and slope_y, one after the other, flat float32.
        stop: the other image, flat float32.
        layout: see above.
        weights: bilinear weights of the pixel up left, its right neighbour and the two below.

    Returns:
        Sums over the patch of d, d², d·slope_x and d·slope_y, where d is the other image minus
        the patch: four float32.
    """
    del typing_context
    sums: Any = types.UniTuple(types.float32, 4)  # type: ignore[no-untyped-call]
    signature = sums(start, stop, layout, weights)

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        (plane, _, _, step), patch, target, factors = _unpack(
            context, builder, signature, arguments
        )
        slope_x = builder.gep(patch, [plane])
        slope_y = builder.gep(slope_x, [plane])
        totals: list[Any] = []
        for difference in _differences(builder, patch, target, step, factors):
            terms = [
                difference,
                builder.fmul(difference, difference),
                builder.fmul(difference, _load(builder, slope_x)),
                builder.fmul(difference, _load(builder, slope_y)),
            ]
            added = zip(totals, terms, strict=True)
            totals = [builder.fadd(*pair) for pair in added] if totals else terms
            slope_x, slope_y = builder.gep(slope_x, [step]), builder.gep(slope_y, [step])
        numbers = [_total(builder, one) for one in totals]
        return context.make_tuple(builder, signature.return_type, numbers)

    return signature, generate


def _spread_patch(
    typing_context: Any, start: Any, stop: Any, layout: Any, weights: Any, sums: Any, flow: Any
) -> Any:
    """Add the flow of a patch to its pixels, weighted by how well the patch fits each.

    Args:
        typing_context: Numba's.
        start: image of the patch, flat float32.
        stop: as for `compare_patch`.
        layout: see above.
        weights: as for `compare_patch`.
        sums: of weights w = 1 / max(least, |d|), of w·u and of w·v, one after the other like
            images, flat float32.
        flow: u, v and the least difference.
    """
    del typing_context
    signature = types.void(start, stop, layout, weights, sums, flow)

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        layout, patch, target, factors = _unpack(context, builder, signature, arguments)
        plane, place, _, step = layout
        here = builder.gep(_data(context, builder, signature.args[4], arguments[4]), [place])
        u, v, least = (_splat(builder, builder.extract_value(arguments[5], k)) for k in range(3))
        one = ir.Constant(_ROW, [1.0] * PATCH)
        for difference in _differences(builder, patch, target, step, factors):
            size = _absolute(builder, difference)
            size = builder.select(builder.fcmp_ordered(">", size, least), size, least)
            weight = builder.fdiv(one, size)
            pointer = here
            for term in (weight, builder.fmul(weight, u), builder.fmul(weight, v)):
                _store(builder, builder.fadd(_load(builder, pointer), term), pointer)
                pointer = builder.gep(pointer, [plane])
            here = builder.gep(here, [step])
        return context.get_dummy_value()

    return signature, generate


def _unpack(
    context: Any, builder: Any, signature: Any, arguments: Any
) -> tuple[list[Any], Any, Any, list[Any]]:
    """The layout, pointers to the patch and to its place in the other image, and the weights."""
    layout = [builder.extract_value(arguments[2], k) for k in range(4)]
    begin, other = (_data(context, builder, signature.args[k], arguments[k]) for k in range(2))
    patch, target = builder.gep(begin, [layout[1]]), builder.gep(other, [layout[2]])
    factors = [_splat(builder, builder.extract_value(arguments[3], k)) for k in range(4)]
    return layout, patch, target, factors


def _differences(builder: Any, patch: Any, target: Any, stride: Any, factors: Any) -> Any:
    """Row by row, the other image (bilinear) minus the patch."""
    one = ir.Constant(stride.type, 1)
    upper = [_load(builder, target), _load(builder, builder.gep(target, [one]))]
    for _ in range(PATCH):
        target = builder.gep(target, [stride])
        lower = [_load(builder, target), _load(builder, builder.gep(target, [one]))]
        terms = [builder.fmul(*pair) for pair in zip(factors, upper + lower, strict=True)]
        mean = builder.fadd(builder.fadd(*terms[:2]), builder.fadd(*terms[2:]))
        yield builder.fsub(mean, _load(builder, patch))
        patch, upper = builder.gep(patch, [stride]), lower


def _data(context: Any, builder: Any, array_type: Any, array: Any) -> Any:
    return context.make_array(array_type)(context, builder, array).data


def _load(builder: Any, pointer: Any) -> Any:
    row = builder.load(builder.bitcast(pointer, _ROW.as_pointer()))
    row.align = 4
    return row


def _store(builder: Any, row: Any, pointer: Any) -> None:
    builder.store(row, builder.bitcast(pointer, _ROW.as_pointer())).align = 4


def _splat(builder: Any, number: Any) -> Any:
    first = builder.insert_element(_ANY_ROW, number, ir.Constant(_INT, 0))
    return builder.shuffle_vector(first, _ANY_ROW, _numbers([0] * PATCH))


def _absolute(builder: Any, row: Any) -> Any:
    integers = ir.VectorType(_INT, PATCH)
    bits = builder.and_(builder.bitcast(row, integers), _numbers([0x7FFFFFFF] * PATCH))
    return builder.bitcast(bits, _ROW)


def _total(builder: Any, row: Any) -> Any:
    """The sum of a row by halves: first columns four apart, then two, then one."""
    for half in (4, 2, 1):
        turned = _numbers([(k + half) % PATCH for k in range(PATCH)])
        row = builder.fadd(row, builder.shuffle_vector(row, _ANY_ROW, turned))
    return builder.extract_element(row, ir.Constant(_INT, 0))


def _numbers(values: list[int]) -> Any:
    return ir.Constant(ir.VectorType(_INT, PATCH), values)


def _compare_arrays(start: Any, stop: Any, layout: Any, weights: Any) -> Any:
    plane, place, _, step = map(int, layout)
    difference = _difference(start, stop, layout, weights)
    x, y = (_square(start, place + k * plane, step) for k in (1, 2))
    return tuple(
        np.float32((difference * factor).sum()) for factor in (np.float32(1), difference, x, y)
    )


def _spread_arrays(start: Any, stop: Any, layout: Any, weights: Any, sums: Any, flow: Any) -> None:
    plane, place, _, step = map(int, layout)
    u, v, least = flow
    weight = 1 / np.maximum(least, np.abs(_difference(start, stop, layout, weights)))
    for k, term in enumerate((weight, weight * u, weight * v)):
        _square(sums, place + k * plane, step)[:] += term


def _difference(start: Any, stop: Any, layout: Any, weights: Any) -> Any:
    _, place, corner, step = map(int, layout)
    corners = (_square(stop, corner + k, step) for k in (0, 1, step, step + 1))
    terms = [weight * pixels for weight, pixels in zip(weights, corners, strict=True)]
    return sum(terms) - _square(start, place, step)


def _square(image: Any, place: int, step: int) -> Any:
    return np.lib.stride_tricks.as_strided(image[place:], (PATCH, PATCH), (4 * step, 4))


compare_patch: Any = intrinsic(_compare_patch, _compare_arrays)
spread_patch: Any = intrinsic(_spread_patch, _spread_arrays)
