"""RIFE's network on a GPU: float16, all of its launches recorded once per size and then replayed.

At the sizes of video the network waits for launches, not for arithmetic. Needs torch to import.
Runs in several threads may share a network: they take turns.
"""

from __future__ import annotations

import threading
from typing import Any, NamedTuple

from texvent.interpolate.rife.network import IntermediateFlow, RifeNetwork, torch
from texvent.networks.weight_files import Tensor

_one_records = threading.Lock()
"""Before it records, torch waits for the device, which CUDA refuses during another recording."""
WARM_UPS = 3
"""Runs before recording, in which libraries choose and set up what they need."""


class _Recording(NamedTuple):
    graph: Any
    images: tuple[Tensor, Tensor]
    """Read by the graph."""
    motion: IntermediateFlow
    """Written by it."""


class RecordedNetwork:
    """The network at the middle of pairs of one size after the other; float16, flows float32.

    Deviation: the flows differ from the float32 network's by the rounding of float16; how much is
        not measured yet.
    """

    def __init__(self, network: RifeNetwork) -> None:
        self._network = network
        self._recording: _Recording | None = None
        self._turn = threading.Lock()

    def __call__(self, first: Tensor, second: Tensor) -> IntermediateFlow:
        """The motion at the middle of a pair; arguments as of `RifeNetwork.forward`."""
        with self._turn, torch.cuda.device(first.device):
            recording = self._recording
            if recording is None or recording.images[0].shape != first.shape:
                self._recording = None  # frees the memory of the other size first
                recording = self._recording = self._record(first, second)
            for kept, image in zip(recording.images, (first, second), strict=True):
                kept.copy_(image)
            recording.graph.replay()
            # The next pair overwrites what the graph wrote.
            return IntermediateFlow(recording.motion.flow.clone(), recording.motion.mask.clone())

    def _record(self, first: Tensor, second: Tensor) -> _Recording:
        images = first.contiguous().clone(), second.contiguous().clone()
        aside = torch.cuda.Stream()
        aside.wait_stream(torch.cuda.current_stream())
        with torch.cuda.stream(aside):
            for _ in range(WARM_UPS):
                self._run(images)
        torch.cuda.current_stream().wait_stream(aside)
        graph = torch.cuda.CUDAGraph()
        # Other threads go on: only this thread's calls must be ones that can be recorded.
        with _one_records, torch.cuda.graph(graph, capture_error_mode="thread_local"):
            motion = self._run(images)
        return _Recording(graph, images, motion)

    def _run(self, images: tuple[Tensor, Tensor]) -> Any:
        # Without the cache: casts of the weights that lived on outside would not be replayed.
        with torch.autocast("cuda", torch.float16, cache_enabled=False):
            return self._network(*images)
