"""Decode a video's latents a few frames at a time, to the very frames of decoding them at once.

A pipeline decodes the whole clip in one call, which is where its memory peaks. Two families of
decoders can go through a clip in order and hand out frames as they come:

=========  =========================================================================
causal     keeps what it needs of earlier frames: Wan, CogVideoX
windows    decodes overlapping stretches of time and blends where they meet:
           HunyuanVideo; LTX-Video where memory is short (`place_pipeline`)
=========  =========================================================================

With tiling, diffusers decodes one tile of the image through all time and then the next; here
all tiles advance together, each with a memory of its own, so the results are the same numbers.
Mochi is missing because its decoding in steps fails in diffusers 0.42 itself.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Mapping
from typing import Any, NamedTuple

from texvent._require import require

EXTRA = "generate"
WAN = "AutoencoderKLWan"
COGVIDEOX = "AutoencoderKLCogVideoX"
HUNYUAN = "AutoencoderKLHunyuanVideo"
LTX = "AutoencoderKLLTXVideo"


class TileGrid(NamedTuple):
    """Overlapping tiles: (height, width) each."""

    latent_size: tuple[int, int]
    """Of a tile, latent pixels."""
    latent_stride: tuple[int, int]
    """From one tile to the next, latent pixels."""
    keep: tuple[int, int]
    """What remains of a decoded tile after blending, pixels; the last of a row keeps all."""
    blend: tuple[int, int]
    """What is blended with the tile before, pixels."""


Steps = Callable[[Any, Any], Iterator[Any]]
"""(decoder, latents [1, C, T, h, w]) → raw chunks [1, C', n, H, W], in order."""


def can_stream(decoder: Any) -> bool:
    """True if `stream_decoder` can run this decoder."""
    name = type(decoder).__name__
    if name in (LTX, HUNYUAN):
        return bool(decoder.use_framewise_decoding)
    return name in _STREAMS


def stream_decoder(decoder: Any, latents: Any, *conditions: Any) -> Iterator[Any]:
    """What `decoder.decode(latents, *conditions)` returns, in chunks.

    Args:
        decoder: one that `can_stream`.
        latents: what it takes, tensor [1, C, T, h, w], on its device.
        *conditions: what else it takes (the time step of LTX-Video's decoder, or None).

    Yields:
        Tensors [1, 3, n, H, W] in -1..1; together all frames in time order.
    """
    return _STREAMS[type(decoder).__name__](decoder, latents, *conditions)


def _stream_wan(decoder: Any, latents: Any) -> Iterator[Any]:
    patch = decoder.config.patch_size
    unpatchify = require("diffusers.models.autoencoders.autoencoder_kl_wan", extra=EXTRA).unpatchify
    for chunk in _merge_tiles(decoder, latents, _step_wan, _stride_grid(decoder, patch or 1)):
        whole = chunk if patch is None else unpatchify(chunk, patch_size=patch)
        yield whole.clamp(-1.0, 1.0)


def _step_wan(decoder: Any, latents: Any) -> Iterator[Any]:
    decoder.clear_cache()
    memory = [None] * len(decoder._feat_map)
    for index in range(latents.shape[2]):
        prepared = decoder.post_quant_conv(latents[:, :, index : index + 1])
        yield decoder.decoder(
            prepared,
            feat_cache=memory,
            feat_idx=[0],
            **({"first_chunk": True} if not index else {}),
        )


def _stream_cogvideox(decoder: Any, latents: Any) -> Iterator[Any]:
    overlap = decoder.tile_overlap_factor_height, decoder.tile_overlap_factor_width
    size = decoder.tile_latent_min_height, decoder.tile_latent_min_width
    pixels = decoder.tile_sample_min_height, decoder.tile_sample_min_width
    blend = int(pixels[0] * overlap[0]), int(pixels[1] * overlap[1])
    grid = TileGrid(
        size,
        (int(size[0] * (1 - overlap[0])), int(size[1] * (1 - overlap[1]))),
        (pixels[0] - blend[0], pixels[1] - blend[1]),
        blend,
    )
    return _merge_tiles(decoder, latents, _step_cogvideox, grid)


def _step_cogvideox(decoder: Any, latents: Any) -> Iterator[Any]:
    batch, total = decoder.num_latent_frames_batch_size, latents.shape[2]
    # The rest of the division comes first, as in `AutoencoderKLCogVideoX`.
    stops = range(batch + total % batch, total + 1, batch) if total >= batch else [total]
    memory, start = None, 0
    for stop in stops:
        chunk = latents[:, :, start:stop]
        if decoder.post_quant_conv is not None:
            chunk = decoder.post_quant_conv(chunk)
        chunk, memory = decoder.decoder(chunk, conv_cache=memory)
        start = stop
        yield chunk


def _stream_hunyuan(decoder: Any, latents: Any) -> Iterator[Any]:
    def decode(window: Any) -> Any:
        if _needs_tiles(decoder, window, _stride_grid(decoder, 1).latent_size):
            return decoder.tiled_decode(window, return_dict=False)[0]
        return decoder.decoder(decoder.post_quant_conv(window))

    return _blend_windows(decoder, latents, decode, surplus=slice(1, None))


def _stream_ltx(decoder: Any, latents: Any, time_step: Any = None) -> Iterator[Any]:
    def decode(window: Any) -> Any:
        if _needs_tiles(decoder, window, _stride_grid(decoder, 1).latent_size):
            return decoder.tiled_decode(window, time_step, return_dict=False)[0]
        return decoder.decoder(window, time_step)

    return _blend_windows(decoder, latents, decode, surplus=slice(None, -1))


_STREAMS: Mapping[str, Callable[..., Iterator[Any]]] = {
    WAN: _stream_wan,
    COGVIDEOX: _stream_cogvideox,
    HUNYUAN: _stream_hunyuan,
    LTX: _stream_ltx,
}


def _blend_windows(
    decoder: Any, latents: Any, decode: Callable[[Any], Any], *, surplus: slice
) -> Iterator[Any]:
    """Frames of overlapping windows of time, blended where they meet.

    Args:
        decoder: with the sizes of its windows.
        latents: [1, C, T, h, w].
        decode: a window of latents → its frames, [1, 3, n, H, W].
        surplus: which frames of every window but the first are kept: each window has one too many.
    """
    ratio = decoder.temporal_compression_ratio
    window = decoder.tile_sample_min_num_frames // ratio
    if latents.shape[2] <= window:
        yield decode(latents)
        return
    stride = decoder.tile_sample_stride_num_frames
    overlap = decoder.tile_sample_min_num_frames - stride
    left = (latents.shape[2] - 1) * ratio + 1
    before = None
    for start in range(0, latents.shape[2], stride // ratio):
        frames = decode(latents[:, :, start : start + window + 1])
        if before is None:
            kept = frames[:, :, : stride + 1]
        else:
            frames = decoder.blend_t(before, frames[:, :, surplus], overlap)
            kept = frames[:, :, :stride]
        before = frames
        yield kept[:, :, :left]
        left -= kept.shape[2]
        if left <= 0:
            return


def _stride_grid(decoder: Any, patch: int) -> TileGrid:
    """The tiles of decoders that say size and stride in pixels.

    Args:
        decoder: the decoder.
        patch: pixels per decoded pixel, along each side: Wan 2.2 puts patches into channels.
    """
    ratio = decoder.spatial_compression_ratio
    size = decoder.tile_sample_min_height, decoder.tile_sample_min_width
    stride = decoder.tile_sample_stride_height, decoder.tile_sample_stride_width
    keep = stride[0] // patch, stride[1] // patch
    return TileGrid(
        (size[0] // ratio, size[1] // ratio),
        (stride[0] // ratio, stride[1] // ratio),
        keep,
        (size[0] // patch - keep[0], size[1] // patch - keep[1]),
    )


def _needs_tiles(decoder: Any, latents: Any, size: tuple[int, int]) -> bool:
    height, width = latents.shape[3:]
    return bool(decoder.use_tiling) and (height > size[0] or width > size[1])


def _merge_tiles(decoder: Any, latents: Any, steps: Steps, grid: TileGrid) -> Iterator[Any]:
    """Chunks of whole frames: of one decoding, or of the tiles of a grid that advance together."""
    if not _needs_tiles(decoder, latents, grid.latent_size):
        return steps(decoder, latents)
    height, width = latents.shape[3:]
    rows = [
        [
            steps(decoder, latents[..., y : y + grid.latent_size[0], x : x + grid.latent_size[1]])
            for x in range(0, width, grid.latent_stride[1])
        ]
        for y in range(0, height, grid.latent_stride[0])
    ]
    columns = len(rows[0])
    together = zip(*itertools.chain.from_iterable(rows), strict=True)
    return (
        _blend_tiles(decoder, [tiles[i : i + columns] for i in range(0, len(tiles), columns)], grid)
        for tiles in together
    )


def _blend_tiles(decoder: Any, rows: list[tuple[Any, ...]], grid: TileGrid) -> Any:
    """One chunk of whole frames. The decoder's own blending changes the later tile in place."""
    torch = require("torch", extra=EXTRA)
    merged = []
    for index, row in enumerate(rows):
        kept = []
        for column, tile in enumerate(row):
            if index > 0:
                decoder.blend_v(rows[index - 1][column], tile, grid.blend[0])
            if column > 0:
                decoder.blend_h(row[column - 1], tile, grid.blend[1])
            kept.append(tile[..., : grid.keep[0], : grid.keep[1]])
        merged.append(torch.cat(kept, dim=-1))
    return torch.cat(merged, dim=-2)
