"""Arrays that kernels pass on without counting references.

Numba counts references to an array atomically at every call. The ray caster passes its arrays
through several small functions per ray, and the counting would take most of the time.
"""

from __future__ import annotations

from typing import Any

from numba.core import cgutils
from numba.core.imputils import impl_ret_untracked
from numba.extending import intrinsic
from numba.np.arrayobj import make_array


@intrinsic
def borrow(typing_context: Any, array: Any) -> Any:
    """The same array without an owner; use it only while its owner lives (inside one kernel)."""

    def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        view = make_array(array)(context, builder, arguments[0])
        view.meminfo = cgutils.get_null_value(view.meminfo.type)
        view.parent = cgutils.get_null_value(view.parent.type)
        return impl_ret_untracked(context, builder, array, view._getvalue())

    return array(array), build
