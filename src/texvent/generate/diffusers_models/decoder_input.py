"""Take what a pipeline hands to its decoder, instead of letting it decode.

Every pipeline scales, unpacks and trims its latents in a way of its own before it decodes them.
So they are taken where they are ready: at the call of the decoder, which here keeps its arguments
and answers with a grey speck that the pipeline then makes a video of.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from typing import Any

from texvent._require import require

EXTRA = "generate"
SINGLE_DECODE_PIPELINES = frozenset(
    {
        "AnyFlowPipeline",
        "CogVideoXImageToVideoPipeline",
        "CogVideoXPipeline",
        "HunyuanVideo15ImageToVideoPipeline",
        "HunyuanVideo15Pipeline",
        "HunyuanVideoPipeline",
        "Kandinsky5T2VPipeline",
        "Kandinsky6TI2VAPipeline",
        "LTX2ImageToVideoPipeline",
        "LTX2Pipeline",
        "LTXImageToVideoPipeline",
        "LTXPipeline",
        "MotifVideoPipeline",
        "SkyReelsV2Pipeline",
        "WanImageToVideoPipeline",
        "WanPipeline",
    }
)
"""Pipelines that decode once, at the end, and give the frames as they come from the decoder."""


@contextlib.contextmanager
def capture_decoder_input(pipe: Any) -> Iterator[list[tuple[Any, ...]]]:
    """Inside, `pipe` denoises and does not decode.

    Args:
        pipe: one of `SINGLE_DECODE_PIPELINES`.

    Yields:
        A list that receives the arguments of the decoder: latents [1, C, T, h, w], and what else
        it takes.
    """
    output = require("diffusers.models.autoencoders.vae", extra=EXTRA).DecoderOutput
    taken: list[tuple[Any, ...]] = []

    def keep(latents: Any, *conditions: Any, return_dict: bool = True) -> Any:
        del return_dict  # the answer can be read either way
        taken.append((latents, *conditions))
        return output(sample=latents.new_zeros(1, 3, 1, 8, 8))

    pipe.vae.decode = keep
    try:
        yield taken
    finally:
        del pipe.vae.decode
