"""RVT checkpoints as its training leaves them, with random numbers, and the backbone in loops."""

import math

import numpy as np

STRIDES = (4, 2, 2, 2)
TINY = (8, 4)
"""Channels of the first stage and of a head: narrower than any that was published, for arithmetic
that is checked by loops."""


def random_tensors(size, seed=0):
    """Name → float64 array; norms near 1, the rest small."""
    from texvent.metrics.rvt_backbone import RvtBackbone

    rng = np.random.default_rng(seed)
    found = {}
    for name, tensor in RvtBackbone(*size).state_dict().items():
        values = rng.normal(0, 1 / math.sqrt(max(np.prod(tensor.shape[1:]), 4)), tensor.shape)
        is_scale = ".norm" in name and name.endswith("weight")
        found[name] = values + 1 if is_scale or "gamma" in name else values
    return found


def checkpoint(size, seed=0):
    """The content of a Lightning checkpoint of the whole detector."""
    import torch

    backbone = {
        f"mdl.backbone.{name}": torch.from_numpy(values.astype(np.float32))
        for name, values in random_tensors(size, seed).items()
    }
    rest = {
        "mdl.fpn.lateral_conv0.conv.weight": torch.zeros(2, 2, 1, 1),
        "mdl.yolox_head.stems.0.bn.num_batches_tracked": torch.tensor(7),
    }
    return {
        "epoch": 3,
        "global_step": 400_000,
        "pytorch-lightning_version": "1.8.6",
        "state_dict": {**backbone, **rest},
        "loops": {"fit_loop": {"epoch_progress": {"total": {"ready": 4, "completed": 3}}}},
        "callbacks": {"ModelCheckpoint": {"best_model_score": torch.tensor(0.44)}},
        "optimizer_states": [{"state": {0: {"step": torch.tensor(1.0)}}, "param_groups": []}],
        "lr_schedulers": [],
        "NativeMixedPrecisionPlugin": {"scale": 65536.0, "growth_factor": 2.0},
    }


EVLIB = {
    "att_blocks": "attention_blocks",
    "att_window": "window_attn",
    "att_grid": "grid_attn",
    "self_attn": "attn",
    "mlp.net.0.0": "mlp.fc1",
    "mlp.net.2": "mlp.fc2",
    ".gamma": "",
}
"""Published name → that of evlib, in parts."""


def trained_here(size, seed=0, binning=2):
    """The content of weights.pt of `texvent train detection`, with the same numbers."""
    state = {}
    for name, values in checkpoint(size, seed)["state_dict"].items():
        for part, other in EVLIB.items():
            name = name.replace(part, other)
        state[name.removeprefix("mdl.")] = values
    return {"state_dict": state, "classes": ["car"], "binning": binning}


def slow_backbone(histogram, tensors, head_channels, stages):
    """RVT's stages pixel by pixel from the paper's Eqs. 1-5; [C, H, W] per stage, padding kept."""
    channels, height, width = histogram.shape
    x = np.zeros((channels, height + -height % 64, width + -width % 64))
    x[:, :height, :width] = histogram
    partition = (x.shape[1] // 64, x.shape[2] // 64)
    found = []
    for stage in range(stages):
        at = f"stages.{stage}"
        kernel = tensors[f"{at}.downsample_cf2cl.conv.weight"]
        x = slow_convolution(x, kernel, STRIDES[stage])
        x = np.moveaxis(x, 0, 2)
        x = norm(x, tensors, f"{at}.downsample_cf2cl.norm")
        for part, groups in (("att_window", windows), ("att_grid", grids)):
            name = f"{at}.att_blocks.0.{part}"
            inner = norm(x, tensors, f"{name}.norm1") if part == "att_grid" else x
            seen = np.zeros_like(x)
            for pixels in groups(x.shape[:2], partition):
                rows, columns = np.array(pixels).T
                seen[rows, columns] = attention(inner[rows, columns], tensors, name, head_channels)
            x = x + tensors[f"{name}.ls1.gamma"] * seen
            inner = linear(norm(x, tensors, f"{name}.norm2"), tensors, f"{name}.mlp.net.0.0")
            inner = np.vectorize(gelu)(inner)
            inner = linear(inner, tensors, f"{name}.mlp.net.2")
            x = x + tensors[f"{name}.ls2.gamma"] * inner
        x = np.moveaxis(lstm(x, tensors, f"{at}.lstm.conv1x1"), 2, 0)
        found.append(x)
    return found


def slow_convolution(x, kernel, stride):
    side = kernel.shape[2]
    padded = np.pad(x, ((0, 0), (side // 2,) * 2, (side // 2,) * 2))
    rows, columns = x.shape[1] // stride, x.shape[2] // stride
    out = np.zeros((len(kernel), rows, columns))
    for row in range(rows):
        for column in range(columns):
            top, left = row * stride, column * stride
            seen = padded[:, top : top + side, left : left + side]
            out[:, row, column] = (kernel * seen).sum(axis=(1, 2, 3))
    return out


def norm(x, tensors, name):
    centred = x - x.mean(axis=-1, keepdims=True)
    spread = np.sqrt((centred**2).mean(axis=-1, keepdims=True) + 1e-5)
    return centred / spread * tensors[f"{name}.weight"] + tensors[f"{name}.bias"]


def linear(x, tensors, name):
    return x @ tensors[f"{name}.weight"].T + tensors[f"{name}.bias"]


def gelu(value):
    return value * (1 + math.erf(value / math.sqrt(2))) / 2


def windows(shape, partition):
    """Pixels of every part of neighbours, as lists of (row, column)."""
    down, across = partition
    for top in range(0, shape[0], down):
        for left in range(0, shape[1], across):
            yield [(top + i, left + j) for i in range(down) for j in range(across)]


def grids(shape, partition):
    """Pixels of every part that is spread over the map, with equal gaps."""
    down, across = partition
    gap_y, gap_x = shape[0] // down, shape[1] // across
    for top in range(gap_y):
        for left in range(gap_x):
            yield [(top + i * gap_y, left + j * gap_x) for i in range(down) for j in range(across)]


def attention(pixels, tensors, name, size):
    """Multi-head attention of [n, C] pixels to each other, head by head."""
    mixed = linear(pixels, tensors, f"{name}.self_attn.qkv")
    heads = []
    for head in range(pixels.shape[1] // size):
        start = head * 3 * size
        query, key, value = (mixed[:, start + i * size : start + (i + 1) * size] for i in range(3))
        scores = np.exp(query @ key.T / math.sqrt(size))
        heads.append(scores / scores.sum(axis=1, keepdims=True) @ value)
    return linear(np.concatenate(heads, axis=1), tensors, f"{name}.self_attn.proj")


def lstm(x, tensors, name):
    """One step of an LSTM whose hidden state and cell are zero, all gates written out."""
    hidden, cell = np.zeros_like(x), np.zeros_like(x)
    both = np.concatenate([x, hidden], axis=2)
    gates = both @ tensors[f"{name}.weight"][:, :, 0, 0].T + tensors[f"{name}.bias"]
    forget, let_in, let_out, content = np.split(gates, 4, axis=2)
    cell = sigmoid(forget) * cell + sigmoid(let_in) * np.tanh(content)
    return sigmoid(let_out) * np.tanh(cell)


def sigmoid(x):
    return 1 / (1 + np.exp(-x))
