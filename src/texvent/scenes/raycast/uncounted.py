"""Tables that kernels read at an address.

Numba passes an array as seven numbers or more and counts references to it, at every call. The ray
caster passes a scene through many small functions per ray; with arrays that took most of the time.
"""

from __future__ import annotations

import functools
import operator
from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba
import numpy as np
from numba import types
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import intrinsic, lower_builtin, models, overload, register_model
from numba.np.arrayobj import make_array

from texvent.scenes.raycast.records import (
    GLOW_RECORD,
    IMAGE_RECORD,
    NODE_RECORD,
    PUFF_RECORD,
    TRIANGLE_RECORD,
    MeshView,
    OwnedWorld,
    SceneView,
    World,
)
from texvent.scenes.scene import LAMP_COLUMNS

Kernel = TypeVar("Kernel", bound=Callable[..., Any])

_array_view: Any = make_array
_lower: Any = lower_builtin
_use_model: Any = register_model
_signature: Any = signature


class Table(types.Type):
    """Numba's type of an address where items lie one after the other.

    `table[k]` is item k: a number, a record, or in a table of rows the k-th row, as a table. There
    is no check of `k`, which must not be negative.
    """

    def __init__(self, dtype: Any, row: int) -> None:
        self.dtype, self.row = dtype, row
        super().__init__(f"Table({dtype}, {row})")


_use_model(Table)(models.OpaqueModel)


def _build_table(typing_context: Any, array: Any) -> Any:
    """Where an array lies; use it only while the array lives (inside one kernel)."""
    if array.layout != "C":
        raise numba.TypingError(f"the kernels need arrays without gaps, not {array}")

    def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        data = _array_view(array)(context, builder, arguments[0]).data
        return builder.bitcast(data, context.get_value_type(signature.return_type))

    return Table(array.dtype, LAMP_COLUMNS if array.ndim == 2 else 0)(array), build


_table_of: Any = intrinsic(_build_table)


@infer_global(operator.getitem)  # type: ignore[no-untyped-call]
class _ItemOfTable(AbstractTemplate):
    """The type of `table[k]`."""

    def generic(self, arguments: Any, keywords: Any) -> Any:
        if not isinstance(arguments[0], Table):
            return None
        table = arguments[0]
        kind = Table(table.dtype, 0) if table.row else table.dtype
        return _signature(kind, table, types.int64)


def _item_of_table(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
    """Machine code of `table[k]`."""
    table, kind = signature.args[0], signature.return_type
    size = max(table.row, 1) * context.get_abi_sizeof(context.get_data_type(table.dtype))
    place = builder.gep(arguments[0], [builder.mul(arguments[1], arguments[1].type(size))])
    value = context.get_value_type(kind)
    if isinstance(kind, (Table, types.Record)):
        return builder.bitcast(place, value)
    return builder.load(builder.bitcast(place, value.as_pointer()))


_lower(operator.getitem, Table, types.Integer)(_item_of_table)


def uncounted_world(owner: World | OwnedWorld) -> World:
    """In a kernel: the same scene by address, for as long as its arrays live."""
    kind: Any = SceneView if isinstance(owner, World) else MeshView
    return cast(World, kind(*owner[: len(SceneView._fields)]))


@overload(uncounted_world, strict=False)
def _overload_uncounted_world(owner: Any) -> Any:
    kind = SceneView if owner.instance_class is World else MeshView

    def build(owner: Any) -> Any:
        return kind(
            _table_of(owner.instant),
            _table_of(owner.shapes),
            _table_of(owner.lists),
            _table_of(owner.lamps),
        )

    return build


def has_meshes(world: World) -> bool:
    """In a kernel: whether the scene has meshes or images; known when it is compiled."""
    return not isinstance(world, (World, SceneView))


@overload(has_meshes, strict=False)
def _overload_has_meshes(world: Any) -> Any:
    if world.instance_class in (World, SceneView):
        return lambda world: False
    return lambda world: True


def only_with_meshes(stand_in: Kernel) -> Callable[[Kernel], Kernel]:
    """Decorator of a kernel whose first argument is the scene: without meshes, it is `stand_in`.

    So kernels for scenes without meshes are compiled sooner. `stand_in` is a plain function with
    the same arguments and results; it is never called.
    """

    def decorate(kernel: Kernel) -> Kernel:
        whole: Any = getattr(kernel, "py_func", kernel)

        @functools.wraps(whole)
        def chosen(world: Any, *rest: Any) -> Any:
            return kernel(world, *rest)

        @overload(chosen, strict=False, jit_options={"error_model": "numpy", "nogil": True})
        def choose(world: Any, *rest: Any) -> Any:
            return stand_in if world.instance_class in (World, SceneView) else whole

        return cast(Kernel, chosen)

    return decorate


def _record_reader(dtype: np.dtype[Any]) -> Any:
    """`read(address, index)`, in a kernel: one record of an array at an address."""
    kind: Any = numba.from_dtype(dtype)
    size = dtype.itemsize

    def build_reader(typing_context: Any, address: Any, index: Any) -> Any:
        def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            offset = builder.mul(arguments[1], arguments[1].type(size))
            place = builder.add(arguments[0], offset)
            return builder.inttoptr(place, context.get_value_type(kind))

        return kind(types.int64, types.int64), build

    return intrinsic(build_reader)


node_at: Any = _record_reader(NODE_RECORD)
triangle_at: Any = _record_reader(TRIANGLE_RECORD)
image_at: Any = _record_reader(IMAGE_RECORD)
puff_at: Any = _record_reader(PUFF_RECORD)
glow_at: Any = _record_reader(GLOW_RECORD)


def _build_texel(typing_context: Any, address: Any, index: Any) -> Any:
    def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        value = context.get_value_type(types.float32)
        place = builder.inttoptr(arguments[0], value.as_pointer())
        texel = builder.load(builder.gep(place, [arguments[1]]))
        return builder.fpext(texel, context.get_value_type(types.float64))

    return types.float64(types.int64, types.int64), build


texel_at: Any = intrinsic(_build_texel)
"""`texel_at(address, index)`, in a kernel: one number of the texels."""
