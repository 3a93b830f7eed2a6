"""What decoding costs at 720p, counted on the real architectures without weights.

Networks run on torch's meta device, where tensors have shapes and no values. Multiply-adds are
those of convolutions, linear layers and attention. Memory is the largest sum of all tensors that
live at one time, weights apart, in float32: what a run that frees at once needs.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

from texvent.extending import require
from texvent_lab.latents.head import HeadConfig, apply_head

torch: Any = require("torch", extra="generate")
python_dispatch: Any = require("torch.utils._python_dispatch", extra="generate")
HEIGHT, WIDTH, FRAMES = 720, 1280, 121
WAN_22 = {
    "base_dim": 160,
    "decoder_base_dim": 256,
    "z_dim": 48,
    "is_residual": True,
    "patch_size": 2,
    "in_channels": 12,
    "out_channels": 12,
}
"""Of Wan 2.2 TI2V-5B, where it differs from diffusers' defaults, which are Wan 2.1's."""
Row = dict[str, Any]


class LiveBytes(python_dispatch.TorchDispatchMode):  # type: ignore[misc]
    """Follows the bytes of all tensors that are made inside, and their largest sum."""

    def __init__(self) -> None:
        super().__init__()
        self._live: dict[int, tuple[Any, int]] = {}
        self.peak = 0

    def __torch_dispatch__(
        self, function: Any, types: Any, args: Any = (), kwargs: Any = None
    ) -> Any:
        """Run an operation and count what it made."""
        del types
        made = function(*args, **(kwargs or {}))
        weak = torch.multiprocessing.reductions.StorageWeakRef
        for one in made if isinstance(made, tuple | list) else (made,):
            if isinstance(one, torch.Tensor):
                storage = one.untyped_storage()
                self._live[storage._cdata] = (weak(storage), storage.nbytes())
        self._live = {key: one for key, one in self._live.items() if not one[0].expired()}
        self.peak = max(self.peak, sum(size for _, size in self._live.values()))
        return made


def count_all() -> list[Row]:
    """A row per network; latents of `FRAMES` frames of 720p."""
    diffusers = require("diffusers", extra="generate")
    rows = []
    with torch.device("meta"), torch.no_grad():
        for model, channels, side in (("Wan 2.1", 16, 8), ("Wan 2.2 5B", 48, 16)):
            size = 1 + (FRAMES - 1) // 4, HEIGHT // side, WIDTH // side
            latents = torch.empty(1, channels, *size)
            vae = diffusers.AutoencoderKLWan(**(WAN_22 if channels == 48 else {}))
            weights = list(vae.decoder.parameters()) + list(vae.post_quant_conv.parameters())
            rows.append(_row(f"{model}, full decoder", weights, lambda: _full(vae, latents)))  # noqa: B023
            config = HeadConfig(channels=channels, frames_per_latent=4, pixels_per_latent=side)
            head = {name: torch.empty(shape) for name, shape in config.shapes.items()}
            rows.append(
                _row(f"{model}, head", head.values(), lambda: apply_head(head, config, latents))  # noqa: B023
            )
    return rows


def _row(name: str, weights: Iterable[Any], run: Callable[[], Any]) -> Row:
    flops = require("torch.utils.flop_counter", extra="generate")
    with flops.FlopCounterMode(display=False) as counter, LiveBytes() as live:
        run()
    operations = counter.get_total_flops() / 2
    return {
        "network": name,
        "parameters": sum(one.numel() for one in weights),
        "multiply_adds": operations,
        "multiply_adds_per_pixel": operations / (FRAMES * HEIGHT * WIDTH),
        "peak_bytes": live.peak,
    }


def _full(vae: Any, latents: Any) -> None:
    vae.decode(latents)


def table(rows: list[Row]) -> str:
    """Markdown."""
    lines = ["| network | parameters | multiply-adds | per pixel | peak |", "|---|---|---|---|---|"]
    for row in rows:
        cells = (
            row["network"],
            f"{row['parameters'] / 1e6:.1f} M",
            f"{row['multiply_adds'] / 1e12:.3g} T",
            f"{row['multiply_adds_per_pixel']:,.0f}",
            f"{row['peak_bytes'] / 2**30:.2f} GiB",
        )
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines)
