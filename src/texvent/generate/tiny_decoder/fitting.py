"""Which tiny decoder takes the latents of which model, and on which scale."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from texvent._require import require
from texvent.errors import InputError
from texvent.generate.tiny_decoder.layout import TinyLayout
from texvent.generate.video_models.weight_files import CONFIG, read_json

EXTRA = "generate"
WAN = "AutoencoderKLWan"
HUNYUAN = "AutoencoderKLHunyuanVideo"
HUNYUAN_15 = "AutoencoderKLHunyuanVideo15"
COGVIDEOX = "AutoencoderKLCogVideoX"
LTX_2 = "AutoencoderKLLTX2Video"
PUBLISHED: Mapping[str, tuple[str, ...]] = {
    WAN: ("taew2_1", "taew2_2"),
    HUNYUAN: ("taehv",),
    HUNYUAN_15: ("taehv1_5",),
    COGVIDEOX: ("taecvx",),
    LTX_2: ("taeltx",),
}
"""diffusers class of a model's own decoder → how the files of its tiny ones begin. Some have the
same shape for different latents, so that a name is all that tells them apart."""
CHANNELS = ("z_dim", "latent_channels")
"""What configs of decoders call the number of latent channels."""


def check_model(layout: TinyLayout, path: Path, folder: Path, index: Mapping[str, Any]) -> None:
    """Refuse a tiny decoder that takes other latents than a model makes; nothing is loaded.

    Args:
        layout: of the tiny decoder.
        path: its file.
        folder: of the model.
        index: `model_index.json` of the model.

    Raises:
        InputError: see above.
        FileFormatError: the config of the model's own decoder is damaged.
    """
    entry = index.get("vae")
    network = str(entry[1]) if isinstance(entry, list) and len(entry) == 2 else "none"
    if network not in PUBLISHED:
        raise InputError(
            f"{path} cannot decode this model's latents: its own decoder is {network}, and tiny "
            f"ones are published for {', '.join(PUBLISHED)}"
        )
    names = [name for name in sum(PUBLISHED.values(), ()) if path.stem.startswith(name)]
    meant = max(names, key=len, default="")
    if names and meant not in PUBLISHED[network]:
        raise InputError(
            f"{path} is made for other latents: this model's own decoder is {network}, its tiny "
            f"one is called {' or '.join(PUBLISHED[network])}"
        )
    config = read_json(folder / "vae" / CONFIG)
    channels = next((config[name] for name in CHANNELS if name in config), None)
    if channels not in (None, layout.latent_channels):
        raise InputError(
            f"{path} takes latents of {layout.latent_channels} channels, this model makes "
            f"{channels}; its tiny decoder is called {' or '.join(PUBLISHED[network])}"
        )


def check_pipeline(layout: TinyLayout, path: Path, pipe: Any) -> None:
    """Refuse a tiny decoder that makes other sizes or frame counts than the model's own.

    Raises:
        InputError: see above.
    """
    found = layout.frames_per_latent, layout.pixels_per_latent
    wanted = tuple(
        getattr(pipe, f"vae_scale_factor_{kind}", None)
        or getattr(pipe, f"vae_{kind}_compression_ratio", None)
        for kind in ("temporal", "spatial")
    )
    if found != wanted:
        raise InputError(
            f"{path} makes {found[0]} frames and {found[1]} pixels of a latent one; the model's "
            f"own decoder makes {wanted[0]} and {wanted[1]}"
        )


def tiny_input(vae: Any, latents: Any) -> Any:
    """Latents as a tiny decoder takes them, from those that the model's own decoder takes.

    The published ones take what the diffusion model denoises, without the scale and shift that
    its decoder wants; that of CogVideoX takes what the decoder takes.

    Args:
        vae: the model's own decoder, a class of `PUBLISHED`.
        latents: its input, tensor [1, C, T, h, w].

    Returns:
        Tensor [C, T, h, w], float32.
    """
    torch = require("torch", extra=EXTRA)
    name, config, values = type(vae).__name__, vae.config, latents[0].float()
    if name == COGVIDEOX:
        return values
    if name in (HUNYUAN, HUNYUAN_15):
        return values * config.scaling_factor
    # LTX-2 has them as buffers, on another device where it is offloaded.
    source = config if name == WAN else vae
    mean, deviation = (
        torch.as_tensor(part).to(values).view(-1, 1, 1, 1)
        for part in (source.latents_mean, source.latents_std)
    )
    return (values - mean) / deviation * getattr(config, "scaling_factor", 1.0)
