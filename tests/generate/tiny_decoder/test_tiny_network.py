"""The tiny decoder, frame by frame, against the whole clip computed layer by layer in NumPy."""

import numpy as np
import pytest

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch")
pytest.importorskip("safetensors")
torch.set_num_threads(1)

from texvent.errors import FileFormatError, InputError  # noqa: E402
from texvent.generate.tiny_decoder.network import read_tiny_decoder  # noqa: E402

from .tiny_files import BASE, LAYOUTS, SUPER, random_tensors, save_tiny_decoder  # noqa: E402


def convolve(frames, weight, bias=None, groups=1):
    """Frames [T, C, h, w], zeros around them; the definition, tap by tap."""
    margin = weight.shape[-1] // 2
    padded = np.pad(frames, ((0, 0), (0, 0), (margin, margin), (margin, margin)))
    height, width = frames.shape[2:]
    out = np.zeros((len(frames), len(weight), height, width))
    for y in range(weight.shape[2]):
        for x in range(weight.shape[3]):
            part = padded[:, :, y : y + height, x : x + width]
            if groups == 1:
                out += np.einsum("oc,tchw->tohw", weight[:, :, y, x], part)
            else:
                out += weight[:, 0, y, x][None, :, None, None] * part
    return out if bias is None else out + bias[None, :, None, None]


def shuffle(frames, patch):
    """Groups of patch² channels become patches of the image."""
    count, channels, height, width = frames.shape
    parts = frames.reshape(count, channels // patch**2, patch, patch, height, width)
    return parts.transpose(0, 1, 4, 2, 5, 3).reshape(
        count, channels // patch**2, height * patch, width * patch
    )


def decode_whole(layout, tensors, latents, *, keeps_start=False):
    """Every layer over all frames at once, float64: the program of TAEHV run "in parallel"."""

    def apply(frames, name, groups=1):
        return convolve(frames, tensors[f"{name}.weight"], tensors.get(f"{name}.bias"), groups)

    frames = latents.transpose(1, 0, 2, 3).astype(np.float64)
    at = 0 if layout.is_super else 1
    frames = frames if layout.is_super else 3 * np.tanh(frames / 3)
    frames = apply(frames, f"decoder.{at}")
    frames = frames if layout.is_super else np.maximum(frames, 0)
    at += 1 if layout.is_super else 2
    for growth in layout.growths:
        for name in (f"decoder.{at + number}.conv" for number in range(3)):
            before = np.concatenate((np.zeros_like(frames[:1]), frames[:-1]))
            both = np.concatenate((frames, before), axis=1)
            if layout.is_super:
                inner = np.maximum(apply(apply(both, f"{name}.0", both.shape[1]), f"{name}.1"), 0)
                frames = apply(inner, f"{name}.3") + frames
            else:
                inner = np.maximum(apply(both, f"{name}.0"), 0)
                inner = np.maximum(apply(inner, f"{name}.2"), 0)
                frames = np.maximum(apply(inner, f"{name}.4") + frames, 0)
        at += 3
        if layout.is_super:
            frames = shuffle(np.maximum(apply(frames, f"decoder.{at}"), 0), 2)
            at += 3
        else:
            frames = frames.repeat(2, axis=2).repeat(2, axis=3)
            at += 1
        grown = apply(frames, f"decoder.{at}.conv")
        frames = grown.reshape(len(grown) * growth, -1, *grown.shape[2:])
        at += 1
        if not layout.is_super:
            frames = apply(frames, f"decoder.{at}")
            at += 1
    image = apply(frames if layout.is_super else np.maximum(frames, 0), "decoder.22")
    image = np.clip(shuffle(image, layout.patch), 0, 1).transpose(0, 2, 3, 1)
    return image if keeps_start else image[layout.frames_per_latent - 1 :]


def random_latents(layout, count, seed=1):
    rng = np.random.default_rng(seed)
    return rng.normal(0, 2, (layout.latent_channels, count, 2, 3)).astype(np.float32)


@pytest.mark.parametrize("name", LAYOUTS)
@pytest.mark.parametrize("extension", ["safetensors", "pth"])
def test_frame_by_frame_equals_the_whole_clip(name, extension, tmp_path):
    layout = LAYOUTS[name]
    path = save_tiny_decoder(tmp_path / f"any.{extension}", layout)
    decoder = read_tiny_decoder(path)
    assert decoder.layout == layout
    for count in (1, 3):
        latents = random_latents(layout, count)
        frames = np.stack(list(decoder.frames(latents)))
        size = layout.pixels_per_latent
        assert frames.shape == ((count - 1) * layout.frames_per_latent + 1, 2 * size, 3 * size, 3)
        assert frames.dtype == np.float32
        assert frames.std() > 0.01
        expected = decode_whole(layout, random_tensors(layout), latents)
        np.testing.assert_allclose(frames, expected, atol=1e-5)


@pytest.mark.parametrize(("latents", "frames"), [(2, 8), (3, 9), (4, 16)])
def test_even_numbers_of_cogvideox_are_whole_groups_of_frames(latents, frames, tmp_path):
    decoder = read_tiny_decoder(save_tiny_decoder(tmp_path / "taecvx.safetensors", BASE))
    values = random_latents(BASE, latents)
    decoded = np.stack(list(decoder.frames(values, pads_start=True)))
    assert len(decoded) == frames
    expected = decode_whole(BASE, random_tensors(BASE), values, keeps_start=latents % 2 == 0)
    np.testing.assert_allclose(decoded, expected, atol=1e-5)


@pytest.mark.parametrize("layout", [BASE, SUPER])
def test_a_frame_depends_on_no_later_latent(layout, tmp_path):
    decoder = read_tiny_decoder(save_tiny_decoder(tmp_path / "any.safetensors", layout))
    latents = random_latents(layout, 3)
    changed = latents.copy()
    changed[:, 2] += 1
    first, other = (np.stack(list(decoder.frames(one))) for one in (latents, changed))
    assert np.array_equal(first[:5], other[:5])
    assert not np.array_equal(first[5:], other[5:])


def test_frames_are_decoded_when_they_are_asked_for(tmp_path, monkeypatch):
    decoder = read_tiny_decoder(save_tiny_decoder(tmp_path / "any.safetensors", BASE))
    entered = []
    enter = decoder._enter
    monkeypatch.setattr(decoder, "_enter", lambda latent: entered.append(1) or enter(latent))
    frames = decoder.frames(random_latents(BASE, 5))
    assert entered == []
    next(frames)
    assert len(entered) == 1
    assert torch.is_grad_enabled()
    assert len(list(frames)) == 16


def test_code_in_a_pickle_is_not_run(tmp_path):
    class Harmful:
        def __reduce__(self):
            return (tmp_path.joinpath("run").touch, ())

    torch.save({"decoder.1.weight": Harmful()}, tmp_path / "bad.pth")
    with pytest.raises(FileFormatError, match=r"code would have to be run|cannot be read"):
        read_tiny_decoder(tmp_path / "bad.pth")
    assert not (tmp_path / "run").exists()


def test_latents_of_another_number_of_channels_are_refused(tmp_path):
    decoder = read_tiny_decoder(save_tiny_decoder(tmp_path / "any.safetensors", BASE))
    with pytest.raises(
        InputError, match=r"shape \[4, 1, 2, 2\]; this decoder takes \[3, T, h, w\]"
    ):
        next(decoder.frames(np.zeros((4, 1, 2, 2), np.float32)))
