"""Tiny decoders with random weights, saved in the published layouts of TAEHV."""

import numpy as np

from texvent.generate.tiny_decoder.layout import TinyLayout

BASE = TinyLayout(3, (8, 6, 5, 4), (1, 2, 2), 1, is_super=False)
"""As taehv, taew2_1 and taecvx, but for the numbers of channels."""
PATCHED = TinyLayout(6, (8, 6, 5, 4), (1, 2, 2), 2, is_super=False)
"""As taehv1_5 and taew2_2."""
LTX = TinyLayout(5, (8, 6, 5, 4), (2, 2, 2), 4, is_super=False)
"""As taeltx_2."""
SUPER = TinyLayout(6, (8, 6, 5, 4), (1, 2, 2), 2, is_super=True)
"""As taehv1_5_super and taew2_2_super."""
LAYOUTS = {"base": BASE, "patched": PATCHED, "ltx": LTX, "super": SUPER}


def random_tensors(layout, seed=0):
    """Name → array; large enough for frames to differ, and an encoder as the files have."""
    rng = np.random.default_rng(seed)
    tensors = {
        name: rng.normal(0, 0.8 / max(1, np.prod(shape[1:])) ** 0.5, shape).astype(np.float32)
        for name, shape in layout.tensor_shapes().items()
    }
    tensors["decoder.22.bias"][:] = 0.5
    return {**tensors, "encoder.0.weight": np.zeros((4, 3, 3, 3), np.float32)}


def save_tiny_decoder(path, layout, seed=0):
    """Save random weights as `.safetensors` or as a torch state dict; return the path."""
    import torch
    from safetensors.torch import save_file

    arrays = random_tensors(layout, seed)
    tensors = {name: torch.from_numpy(array) for name, array in arrays.items()}
    if path.suffix == ".safetensors":
        save_file(tensors, path)
    else:
        torch.save(tensors, path)
    return path
