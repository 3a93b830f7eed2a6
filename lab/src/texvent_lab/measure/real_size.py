"""A pipeline of published size with random weights, from its files to events.

    python -m texvent_lab.measure.gpu --real-size wan-vace-1.3b

It shows that a model fits and how long each step takes, before anything is fetched. Of the text
encoder two layers are made; it takes a moment in a run. The frames are noise: the worst case of a
simulation.
"""

from __future__ import annotations

import tempfile
import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any

from texvent.extending import require
from texvent.pipeline import text_to_events
from texvent.settings.resolution import resolve
from texvent_lab.measure.speed.timing import rounded

EXTRA = "generate"
SENTENCE = "a red car drives left past two trees"


@dataclass(frozen=True)
class RealSize:
    """Wan 2.1 VACE; by default of its published 1.3B size."""

    heads: int = 12
    head_width: int = 128
    layers: int = 30
    inner_width: int = 8960
    text_width: int = 4096
    text_layers: int = 2
    decoder_width: int = 96


PUBLISHED: Mapping[str, RealSize] = MappingProxyType({"wan-vace-1.3b": RealSize()})
"""Row of the table of models → its size."""


class _Stages:
    """Notes when each stage of a run begins, and its denoising steps."""

    def __init__(self) -> None:
        self.seconds: dict[str, float] = {}
        self._stage, self._since = "", time.perf_counter()

    def announce(self, message: str) -> None:
        """A stage begins with a line of its own."""
        self.begin(message.split(" ", 1)[0])

    def advance(self, stage: str, done: int, total: int | None) -> None:
        """A step ended."""
        self.begin(f"{stage} {done + 1} of {total}" if done != total else "decode and check")

    def begin(self, stage: str) -> None:
        """End the stage before."""
        now = time.perf_counter()
        if self._stage:
            self.seconds[self._stage] = rounded(now - self._since)
        self._stage, self._since = stage, now


def measure_real_size(name: str, size: RealSize, device: str, **options: Any) -> dict[str, Any]:
    """Seconds of every stage and peak memory of a run with a pipeline of that size.

    Args:
        name: row of the table of models whose defaults apply.
        size: of its networks.
        device: on which the weights are drawn.
        options: of the run.
    """
    torch = require("torch", extra=EXTRA)
    clock = _Stages()
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch) / name
        clock.begin("build and save")
        _save(size, folder, device)
        clock.begin("begin")
        given = {"generator": str(folder), "reuse_video": False, **options}
        run = text_to_events(SENTENCE, resolve("generate", given), progress=clock)
        clock.begin("simulate")
        events = sum(len(packet) for packet in run)
        clock.begin("end")
    peak = torch.cuda.max_memory_allocated() / 1e9 if torch.cuda.is_available() else None
    return {
        "model": name,
        "size": str(run.video.size),
        "frames": run.video.frame_count,
        "events": events,
        "peak_gb": peak and rounded(peak),
        "seconds": clock.seconds,
    }


def _save(size: RealSize, folder: Path, device: str) -> None:
    torch, diffusers = require("torch", extra=EXTRA), require("diffusers", extra=EXTRA)
    transformers = require("transformers", extra=EXTRA)
    letters = [("<pad>", 0.0), ("</s>", 0.0), ("<unk>", 0.0), ("▁", -2.0)]
    letters += [(chr(code), -3.0) for code in range(33, 127)]
    words = transformers.UMT5Config(
        vocab_size=len(letters),
        d_model=size.text_width,
        d_kv=max(8, size.text_width // 64),
        d_ff=2 * size.text_width,
        num_layers=size.text_layers,
        num_heads=4,
    )
    with torch.device(device), torch.inference_mode():
        torch.manual_seed(0)
        pipe = diffusers.WanVACEPipeline(
            tokenizer=transformers.T5TokenizerFast(vocab=letters, extra_ids=0),
            text_encoder=transformers.UMT5EncoderModel(words).to(torch.bfloat16).eval(),
            transformer=diffusers.WanVACETransformer3DModel(
                num_attention_heads=size.heads,
                attention_head_dim=size.head_width,
                num_layers=size.layers,
                ffn_dim=size.inner_width,
                text_dim=size.text_width,
                vace_layers=list(range(0, size.layers, 2)),
            ).to(torch.bfloat16),
            vae=diffusers.AutoencoderKLWan(base_dim=size.decoder_width),
            scheduler=diffusers.UniPCMultistepScheduler(
                prediction_type="flow_prediction", use_flow_sigmas=True, flow_shift=3.0
            ),
        )
        pipe.save_pretrained(folder, safe_serialization=True)
