"""RIFE's network written out in NumPy float64, slowly and from the layout's description."""

import numpy as np


def convolve(x, weight, bias, stride=1):
    """[C, H, W], 3×3, one pixel of zeros around."""
    _, height, width = x.shape
    padded = np.pad(x, ((0, 0), (1, 1), (1, 1)))
    total = np.zeros((len(weight), -(-height // stride), -(-width // stride)))
    for dy in range(3):
        for dx in range(3):
            seen = padded[:, dy : dy + height : stride, dx : dx + width : stride]
            total += np.einsum("oc,chw->ohw", weight[:, :, dy, dx], seen)
    return total + bias[:, None, None]


def convolve_up(x, weight, bias):
    """Transposed 4×4 convolution, stride 2, one pixel cut off: twice the size."""
    _, height, width = x.shape
    spread = np.zeros((weight.shape[1], 2 * height + 2, 2 * width + 2))
    for dy in range(4):
        for dx in range(4):
            part = np.einsum("co,chw->ohw", weight[:, :, dy, dx], x)
            spread[:, dy : dy + 2 * height : 2, dx : dx + 2 * width : 2] += part
    return spread[:, 1:-1, 1:-1] + bias[:, None, None]


def resize(x, factor):
    """Bilinear between pixel centres, edges repeated."""
    for axis in (1, 2):
        length = x.shape[axis]
        at = (np.arange(round(length * factor)) + 0.5) / factor - 0.5
        at = np.clip(at, 0, length - 1)
        low = np.floor(at).astype(int)
        high = np.minimum(low + 1, length - 1)
        shape = [1, 1, 1]
        shape[axis] = -1
        share = (at - low).reshape(shape)
        x = np.take(x, low, axis) * (1 - share) + np.take(x, high, axis) * share
    return x


def warp(x, flow):
    _, height, width = x.shape
    rows, columns = np.mgrid[:height, :width].astype(float)
    column = np.clip(columns + flow[0], 0, width - 1)
    row = np.clip(rows + flow[1], 0, height - 1)
    left, top = np.floor(column).astype(int), np.floor(row).astype(int)
    right, bottom = np.minimum(left + 1, width - 1), np.minimum(top + 1, height - 1)
    across, down = column - left, row - top
    upper = x[:, top, left] * (1 - across) + x[:, top, right] * across
    lower = x[:, bottom, left] * (1 - across) + x[:, bottom, right] * across
    return upper * (1 - down) + lower * down


def shuffle_pixels(x):
    channels, height, width = x.shape
    cells = x.reshape(channels // 4, 2, 2, height, width)
    return cells.transpose(0, 3, 1, 4, 2).reshape(channels // 4, 2 * height, 2 * width)


def leak(x):
    return np.where(x > 0, x, 0.2 * x)


class NumpyRife:
    def __init__(self, layout, tensors):
        self.layout, self.tensors = layout, tensors

    def layer(self, x, name, stride=1):
        return convolve(x, self.tensors[f"{name}.weight"], self.tensors[f"{name}.bias"], stride)

    def layer_up(self, x, name):
        return convolve_up(x, self.tensors[f"{name}.weight"], self.tensors[f"{name}.bias"])

    def slope(self, x, name):
        if not self.layout.learned_slopes:
            return leak(x)
        return np.where(x > 0, x, self.tensors[f"{name}.weight"][:, None, None] * x)

    def encode(self, image):
        if not self.layout.encoded_channels:
            return image[:0]
        x = leak(self.layer(image, "encode.cnn0", 2))
        x = leak(self.layer(x, "encode.cnn1"))
        x = leak(self.layer(x, "encode.cnn2"))
        return self.layer_up(x, "encode.cnn3")

    def block(self, i, x, flow, scale):
        x = resize(x, 1 / scale)
        if flow is not None:
            x = np.concatenate([x, resize(flow, 1 / scale) / scale])
        for layer in (0, 1):
            name = f"block{i}.conv0.{layer}"
            x = self.slope(self.layer(x, f"{name}.0", 2), f"{name}.1")
        before = x
        for layer in range(8):
            name = f"block{i}.convblock.{layer}"
            if self.layout.learned_slopes:
                x = self.slope(self.layer(x, f"{name}.0"), f"{name}.1")
            else:
                beta = self.tensors[f"{name}.beta"][0]
                x = leak(self.layer(x, f"{name}.conv") * beta + x)
        if self.layout.learned_slopes:
            x = resize(self.layer_up(x + before, f"block{i}.lastconv"), 2 * scale)
            return 2 * scale * x[:4], x[4:5], x[:0]
        x = resize(shuffle_pixels(self.layer_up(x, f"block{i}.lastconv.0")), scale)
        return scale * x[:4], x[4:5], x[5 : 5 + self.layout.features]

    def estimate(self, first, second, position):
        """Flow [4, H, W] and mask logit [1, H, W]; images [3, H, W], 0..1."""
        codes = self.encode(first), self.encode(second)
        instant = np.full((1, *first.shape[1:]), position)
        flow, mask, features = self.block(
            0, np.concatenate([first, second, *codes, instant]), None, self.layout.scales[0]
        )
        for i, scale in enumerate(self.layout.scales[1:], start=1):
            seen = [warp(first, flow[:2]), warp(second, flow[2:])]
            seen += [warp(codes[0], flow[:2]), warp(codes[1], flow[2:]), instant, mask, features]
            step, logit, features = self.block(i, np.concatenate(seen), flow, scale)
            flow = flow + step
            mask = logit if self.layout.replaces_mask else mask + logit
        return flow, mask
