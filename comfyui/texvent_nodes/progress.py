"""ComfyUI's progress bar and its cancel button, where it runs."""

from __future__ import annotations

from collections.abc import Callable


def comfy_progress() -> Callable[[int, int | None, str], None] | bool:
    """A listener for texvent's `progress=`; False outside ComfyUI."""
    try:
        from comfy.model_management import throw_exception_if_processing_interrupted
        from comfy.utils import ProgressBar
    except ImportError:
        return False
    bars: dict[int, ProgressBar] = {}

    def listen(done: int, total: int | None, what: str) -> None:
        del what
        throw_exception_if_processing_interrupted()
        if total:
            bars.setdefault(total, ProgressBar(total)).update_absolute(done, total)

    return listen
