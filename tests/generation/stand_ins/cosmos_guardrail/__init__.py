"""Stands in for NVIDIA's guardrail package in tests with random weights, which are not NVIDIA's.

It has the real one's class and methods, blocks one word, and, like the real one, logs an error in
its text model and calls the prompt safe.
"""

import logging

import numpy as np
import torch

logger = logging.getLogger("cosmos_guardrail.cosmos_guardrail")


class CosmosSafetyChecker(torch.nn.Module):
    checked_frames = 0
    device = torch.device("cpu")
    dtype = torch.float32

    def check_text_safety(self, prompt: str) -> bool:
        if "break" in prompt:
            logger.error("Unexpected error occurred when running Qwen3Guard guardrail")
        return "weapon" not in prompt

    def check_video_safety(self, frames: np.ndarray) -> np.ndarray:
        type(self).checked_frames += len(frames)
        return frames

    def to(self, device=None, dtype=None) -> None:
        """Nothing to move."""
