"""Call any diffusers text-to-video pipeline by its own argument names; steps are reported."""

from __future__ import annotations

import contextlib
import inspect
from collections.abc import Iterator, Mapping
from fractions import Fraction
from pathlib import Path
from typing import Any

from texvent._require import require
from texvent.errors import ConfigError, InputError, TexventError, one_line
from texvent.generation.diffusers_models.guardrail import PART
from texvent.generation.video_models.config import DiffusersConfig, VideoModel
from texvent.generation.video_models.controls import PIPELINES
from texvent.generation.videos.stored_video import to_16_bits_there
from texvent.runtime.progress import Progress

EXTRA = "generate"
ARGUMENTS: Mapping[str, tuple[str, ...]] = {
    "frames": ("num_frames", "video_length", "frames"),
    "width": ("width",),
    "height": ("height",),
    "steps": ("num_inference_steps",),
    "guidance": ("guidance_scale",),
    "negative_prompt": ("negative_prompt",),
}
"""Option → argument names of pipelines."""
RATE_ARGUMENTS = ("fps", "frame_rate")
SOUND = "sample_audio"
"""Switch of pipelines that can make sound as well, which no event shows."""
DISTILLED = "true_cfg_scale"
"""Argument of pipelines that make one pass, and follow no negative prompt, unless it is set."""
GUIDER = "guider"
"""Part in which some pipelines keep the guidance scale, instead of an argument of the call."""
ON_STEP = "callback_on_step_end"
FRAME_DIMENSIONS = 4
"""Dimensions of one video; most pipelines return a batch of them."""


def call_pipeline(
    pipe: Any,
    prompt: str,
    config: DiffusersConfig,
    *,
    model: VideoModel,
    fps: Fraction,
    generator: Any,
    progress: Progress,
    control: Any = None,
) -> Any:
    """Run a pipeline once.

    Args:
        pipe: a diffusers pipeline.
        prompt: content of the video.
        config: options; those that are None are not passed.
        model: its row, with further arguments of the call.
        fps: passed where the model takes the rate as an input (it changes the pixels).
        generator: torch's source of noise.
        progress: receives denoising steps, where the pipeline reports them.
        control: control video, [N, H, W, 3] uint8, for pipelines that follow one.

    Returns:
        Frames, [F, H, W, 3] int16 with the bits of 16-bit levels, on the decoder's device.

    Raises:
        ConfigError: the pipeline does not take an option, or refuses its value.
        InputError: it makes no frame, or numbers that are NaN or infinite.
        TexventError: the GPU's memory is too small.
    """
    accepted = check_options(type(pipe), config)
    arguments: dict[str, Any] = {**model.call, "prompt": prompt}
    for option, names in ARGUMENTS.items():
        value = getattr(config, option)
        arguments |= {name: value for name in names if value is not None and name in accepted}
    # Other step counts have no levels of their own: the pipeline's schedule gives them.
    if model.sigmas and config.steps in (None, len(model.sigmas)):
        arguments["sigmas"] = list(model.sigmas)
    for name in RATE_ARGUMENTS:
        if name in accepted:
            arguments[name] = int(fps) if fps.denominator == 1 else float(fps)
    if config.guidance != model.guidance:
        arguments.pop("guidance_scale_2", None)  # follows the first, unless it is given
    if SOUND in accepted:
        arguments[SOUND] = False
    if config.image is not None:
        arguments["image"] = _fitted_image(config.image, config, accepted)
    if control is not None:
        arguments |= _control_argument(pipe, control)
    if ON_STEP in accepted:
        arguments[ON_STEP] = _reporter(progress)
    # A guardrail looks at arrays of the host, which diffusers cannot make of bfloat16 tensors.
    is_on_host = getattr(pipe, PART, None) is not None
    arguments |= {"output_type": "np" if is_on_host else "pt", "generator": generator}
    with _guided(pipe, config.guidance):
        return _run(pipe, arguments)


def check_options(pipeline_class: type, config: DiffusersConfig) -> Mapping[str, inspect.Parameter]:
    """Refuse options that the pipeline does not take; nothing has to be loaded for that.

    Returns:
        Name → parameter of its call.

    Raises:
        ConfigError: an option is set that it does not take, or one is missing that it needs.
    """
    accepted = inspect.signature(pipeline_class.__call__).parameters
    name = pipeline_class.__name__
    has_guider = GUIDER in inspect.signature(pipeline_class).parameters
    for option, names in ARGUMENTS.items():
        is_taken = bool(set(names) & set(accepted)) or (option == "guidance" and has_guider)
        is_taken |= option == "frames" and name in PIPELINES  # they are those of the control video
        if getattr(config, option) is not None and not is_taken:
            raise ConfigError(f"{option} is set, but {name} does not take it")
    if config.negative_prompt is not None and DISTILLED in accepted:
        raise ConfigError(
            f"negative_prompt is set, but {name} is distilled to one pass, which follows none"
        )
    image = accepted.get("image")
    if config.image is not None and image is None:
        raise ConfigError(f"image is set, but {name} starts from text alone")
    if config.image is None and image is not None and image.default is inspect.Parameter.empty:
        raise ConfigError(f"{name} starts from an image; give image=PATH")
    return accepted


def read_image(path: Path) -> Any:
    """An image as PIL's RGB image, turned as its camera noted.

    Raises:
        InputError: it does not exist, or is no image.
        MissingDependencyError: Pillow is not installed.
    """
    images, operations = (require(f"PIL.{name}", extra=EXTRA) for name in ("Image", "ImageOps"))
    if not path.is_file():
        raise InputError(f"there is no image {path}")
    try:
        with images.open(path) as opened:
            return operations.exif_transpose(opened).convert("RGB")
    except (OSError, ValueError, SyntaxError, images.DecompressionBombError) as error:
        raise InputError(f"{path} cannot be read as an image ({one_line(error)})") from error


def _fitted_image(
    path: Path, config: DiffusersConfig, accepted: Mapping[str, inspect.Parameter]
) -> Any:
    """The image to start from, its middle cut to the video's shape and resized to its size."""
    size = [
        getattr(config, name) or (accepted[name].default if name in accepted else None)
        for name in ("width", "height")
    ]
    image = read_image(path)
    if all(isinstance(side, int) for side in size):
        image = require("PIL.ImageOps", extra=EXTRA).fit(image, tuple(size))
    return image


def _control_argument(pipe: Any, control: Any) -> dict[str, Any]:
    """A control video as a pipeline takes it."""
    images = require("PIL.Image", extra=EXTRA)
    frames: Any = [images.fromarray(one) for one in control]
    argument = PIPELINES[type(pipe).__name__].argument
    if argument == "reference_conditions":
        module = require("diffusers.pipelines.ltx2", extra=EXTRA)
        frames = [module.LTX2ReferenceCondition(frames=frames)]
    return {argument: frames}


def _reporter(progress: Progress) -> Any:
    """A callback for the end of a denoising step; an exception of `progress` stops the run."""

    def report(pipe: Any, step: int, time: Any, tensors: dict[str, Any]) -> dict[str, Any]:
        del time
        progress.advance("denoise", step + 1, pipe.num_timesteps)
        return tensors

    return report


@contextlib.contextmanager
def _guided(pipe: Any, guidance: float | None) -> Iterator[None]:
    """Inside, a pipeline with a guider uses this scale."""
    own = getattr(pipe, GUIDER, None)
    if guidance is None or own is None:
        yield
        return
    pipe.guider = own.new(guidance_scale=guidance)
    try:
        yield
    finally:
        pipe.guider = own


def _run(pipe: Any, arguments: Mapping[str, Any]) -> Any:
    torch = require("torch", extra=EXTRA)
    try:
        output = pipe(**arguments, return_dict=False)[0]
        output = output[0] if output.ndim > FRAME_DIMENSIONS else output
        is_tensor = isinstance(output, torch.Tensor)
        return to_16_bits_there(output.movedim(1, 3) if is_tensor else torch.from_numpy(output))
    except TexventError:  # some are ValueErrors
        raise
    except ValueError as error:
        raise ConfigError(
            f"{type(pipe).__name__} refuses the options: {one_line(error)}"
        ) from error
    except torch.OutOfMemoryError as error:
        raise TexventError(
            f"{type(pipe).__name__} does not fit into the GPU's memory; try offload='model' or "
            "offload='sequential', a smaller `width` and `height`, or fewer "
            "--frames"
        ) from error
    finally:
        # Also after Ctrl-C: parts that are offloaded go back, so that the next prompt can run.
        pipe.maybe_free_model_hooks()
