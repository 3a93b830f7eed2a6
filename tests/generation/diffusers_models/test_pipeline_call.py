"""Arguments that a pipeline is called with, and what becomes of its frames and errors."""

from fractions import Fraction

import pytest

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch")

from texvent.errors import ConfigError, InputError  # noqa: E402
from texvent.generation.diffusers_models.pipeline_call import call_pipeline  # noqa: E402
from texvent.generation.video_models.config import DiffusersConfig  # noqa: E402
from texvent.generation.video_models.known_models import MODELS  # noqa: E402

from ..watcher import Watcher  # noqa: E402


class Pipe:
    """Keeps the arguments of its call; gives frames of one value, or fails."""

    def __init__(self, value=0.5, error=None):
        self.value, self.error = value, error

    def __call__(self, prompt, guidance_scale=5.0, guidance_scale_2=None, **others):
        self.scales = (guidance_scale, guidance_scale_2)
        if self.error:
            raise self.error
        return [torch.full((1, 2, 3, 4, 4), self.value)]

    def maybe_free_model_hooks(self):
        pass


def call(pipe, **options):
    return call_pipeline(
        pipe,
        "a dog",
        DiffusersConfig(**options),
        model=MODELS["wan2.2-a14b"],
        fps=Fraction(16),
        generator=None,
        progress=Watcher(),
    )


def test_frames_that_are_no_numbers_are_no_fault_of_the_options():
    with pytest.raises(InputError, match="NaN or infinite values; try another seed"):
        call(Pipe(float("nan")))
    with pytest.raises(ConfigError, match="Pipe refuses the options: 7 steps"):
        call(Pipe(error=ValueError("7 steps")))


@pytest.mark.parametrize(("guidance", "scales"), [(4.0, (4.0, 3.0)), (1.0, (1.0, None))])
def test_the_second_guidance_follows_one_that_is_not_the_models(guidance, scales):
    pipe = Pipe()
    call(pipe, guidance=guidance)
    assert pipe.scales == scales
