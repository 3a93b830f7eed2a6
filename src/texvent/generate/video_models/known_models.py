"""Learned text-to-video models that `--generator` knows by name, as one table of facts.

One adapter (`diffusers_models/generator.py`) runs all of them. A row says where the weights are,
which diffusers pipeline runs them and what they were made for; every value is a default that an
option overrides. Frame counts, sizes and step counts are the call defaults of diffusers 0.42, or
`differs` says why not. No row was run with its published weights, which cannot be had where
texvent's tests run; `is_verified` says that its pipeline class runs there with tiny random weights
of the same layout. Licences are what the publishers' repositories said in November 2026.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path
from typing import Any

LEAST_FPS = 24
"""Frame rate from which a model is recommended for events."""


@dataclass(frozen=True, kw_only=True)
class VideoModel:
    """One learned model; None means that the pipeline's own default is used."""

    name: str
    """What `--generator` calls it."""
    repo: str = ""
    """Repository on the model hub, `org/name`; empty for a local folder."""
    folder: Path | None = None
    """Local folder with the model, instead of the repository."""
    revision: str | None = None
    """Branch, tag or commit; None is the default branch."""
    pipeline: str | None = None
    """diffusers class; None is what `model_index.json` names."""
    image_pipeline: str | None = None
    """diffusers class that starts from an image with the same weights, if there is one."""
    needs_image: bool = False
    """Whether it makes videos from an image and a prompt only."""
    needs_reference: bool = False
    """Whether it makes videos of another video only, which it follows frame by frame."""
    fps: Fraction | None = None
    """Frame rate the model was trained for; it is nowhere in the weights."""
    frames: int | None = None
    width: int | None = None
    height: int | None = None
    steps: int | None = None
    guidance: float | None = None
    differs: str = ""
    """Why frames, size, steps or guidance are not the call defaults of the pipeline."""
    call: Mapping[str, Any] = field(default_factory=dict, hash=False)
    """Arguments of the pipeline's call that no option sets."""
    sigmas: tuple[float, ...] | None = None
    """Noise levels of the steps that a few-step model was distilled for, first to last; used with
    as many steps."""
    scheduler: Mapping[str, Any] = field(default_factory=dict, hash=False)
    """Settings of the noise schedule that the publisher asks for; "class": another diffusers
    class."""
    lora: tuple[str, ...] = ()
    """Adapters that it runs with, as `--lora` writes them; those that the option names
    replace them, except where the model follows a video: there they are added."""
    motion_adapter: str | None = None
    """Repository of an AnimateDiff network, `org/name`: makes an image model one of videos."""
    licence: str = "not known to texvent; read the model's page"
    """Name of the licence of the weights, that of SPDX where there is one."""
    licence_source: str = ""
    """Where it was read: the publisher's repository or page, and the file; empty: not read."""
    licence_terms: str = ""
    """What it asks of a user beyond keeping notices, in a few words."""
    gpu_gb: float | None = None
    """GPU memory with every part on the device, GB, as its makers or users report it; or None."""
    offload_gb: float | None = None
    """GPU memory with parts moved to the device when used, GB."""
    time_s: float | None = None
    """What the publisher says one video takes, seconds; None: nothing was found."""
    time_source: str = ""
    """On what, and where it was read."""
    dtype: str = "bfloat16"
    """Number format on a GPU."""
    needs_float32_vae: bool = False
    """Whether its decoder should stay in float32 (Wan's page asks for it)."""
    ignores_fps: bool = False
    """Whether the rate is known not to change the frames."""
    is_verified: bool = False

    @property
    def is_low_fps(self) -> bool:
        """Whether much moves far between its frames, which suits events badly."""
        return self.fps is not None and self.fps < LEAST_FPS

    @property
    def licence_and_terms(self) -> str:
        """Licence with its terms, for messages and metadata."""
        return f"{self.licence}; {self.licence_terms}" if self.licence_terms else self.licence

    @property
    def source(self) -> str:
        """Where the weights come from, for messages and metadata."""
        if self.folder is not None:
            return str(self.folder)
        return f"{self.repo}@{self.revision}" if self.revision else self.repo


def _row(
    name: str,
    repo: str,
    pipeline: str,
    shape: tuple[int, int | None, int | None],
    fps: int,
    steps: int | None,
    licence: str,
    **facts: Any,
) -> VideoModel:
    """A row; `shape` is frames, height, width."""
    frames, height, width = shape
    facts |= {"fps": Fraction(fps), "frames": frames, "height": height, "width": width}
    return VideoModel(
        name=name, repo=repo, pipeline=pipeline, steps=steps, licence=licence, **facts
    )


_TINY: dict[str, Any] = {"is_verified": True}
_NVIDIA: dict[str, Any] = _TINY | {"licence_terms": "ends if its guardrail is bypassed"}
_COSMOS_3: dict[str, Any] = _TINY | {
    "licence_source": "github.com/NVIDIA/cosmos: README.md, LICENSE",
    "differs": "the call leaves frames and size open; these are its documented defaults",
    "scheduler": {"flow_shift": 10.0, "use_karras_sigmas": False},
}
_COGVIDEO = "github.com/zai-org/CogVideo"
_COGVIDEOX: dict[str, Any] = _TINY | {
    "differs": "the call leaves frames and size to the weights",
    "ignores_fps": True,
}
_COGVIDEOX_5B: dict[str, Any] = _COGVIDEOX | {
    "licence_source": f"{_COGVIDEO}: MODEL_LICENSE",
    "licence_terms": "commercial use after registration; not military",
}
_LTX_2: dict[str, Any] = _TINY | {
    "image_pipeline": "LTX2ImageToVideoPipeline",
    "licence_source": "github.com/Lightricks/LTX-2: LICENSE (commit 4dbd99e)",
    "licence_terms": "paid from $10 M revenue; not military; no commercial training of other "
    "models",
}
# Eight noise levels and no guidance of any kind: the publisher's distilled.py.
_LTX_2_DISTILLED: dict[str, Any] = _LTX_2 | {
    "guidance": 1.0,
    "sigmas": (1.0, 0.99375, 0.9875, 0.98125, 0.975, 0.909375, 0.725, 0.421875),
    "call": {
        "stg_scale": 0.0,
        "modality_scale": 1.0,
        "audio_guidance_scale": 1.0,
        "audio_stg_scale": 0.0,
        "audio_modality_scale": 1.0,
        "spatio_temporal_guidance_blocks": None,
    },
}
# The example in LTX2HDRPipeline, whose call has no guidance but the scale by default.
_LTX_2_HDR: dict[str, Any] = _LTX_2_DISTILLED | {
    "image_pipeline": None,
    "needs_reference": True,
    "call": {},
    "lora": ("hub:Lightricks/LTX-2.3-22b-IC-LoRA-HDR/ltx-2.3-22b-ic-lora-hdr-0.9.safetensors",),
}
_HUNYUAN: dict[str, Any] = _TINY | {
    "licence_terms": "not in the EU, UK, South Korea; 100 M monthly users: ask; output may not "
    "improve other AI models",
}
_HUNYUAN_1_5: dict[str, Any] = _HUNYUAN | {
    "licence_source": "github.com/Tencent-Hunyuan/HunyuanVideo-1.5: LICENSE",
    "offload_gb": 14,
}
_SKYREELS: dict[str, Any] = _TINY | {
    "licence_source": "github.com/SkyworkAI/SkyReels-V2: LICENSE.txt",
    "licence_terms": "commercial use allowed under its conditions",
    "scheduler": {"flow_shift": 8.0},
    "needs_float32_vae": True,
}
_KANDINSKY_5: dict[str, Any] = _TINY | {
    "licence_source": "github.com/kandinskylab/kandinsky-5: LICENSE",
    "offload_gb": 24,
}
_ON_H100 = "H100; github.com/kandinskylab/kandinsky-5: README.md"
_HELIOS: dict[str, Any] = _TINY | {
    "licence_source": "github.com/PKU-YuanGroup/Helios: LICENSE.txt",
    "needs_float32_vae": True,
    "offload_gb": 6,
}
_ANYFLOW: dict[str, Any] = _TINY | {
    "licence_source": "github.com/NVlabs/AnyFlow: README.md, LICENSE",
    "ignores_fps": True,
    "differs": "the publisher's step count; the call's default is 50",
}
_WAN: dict[str, Any] = _TINY | {"needs_float32_vae": True, "ignores_fps": True}
_WAN_2_1: dict[str, Any] = _WAN | {"licence_source": "github.com/Wan-Video/Wan2.1: README.md"}
_WAN_2_2: dict[str, Any] = _WAN | {"licence_source": "github.com/Wan-Video/Wan2.2: README.md"}

# fmt: off
_ROWS = (
    # name, repository, pipeline, (frames, height, width), fps, steps, licence, what else is known
    _row("cosmos-7b", "nvidia/Cosmos-1.0-Diffusion-7B-Text2World", "CosmosTextToWorldPipeline",
         (121, 704, 1280), 24, 36, "NVIDIA Open Model License", **_NVIDIA,
         licence_source="docs.api.nvidia.com/nim: nvidia/cosmos-1_0-diffusion-7b",
         gpu_gb=74, offload_gb=24.4),
    _row("cosmos2.5-2b", "nvidia/Cosmos-Predict2.5-2B", "Cosmos2_5_PredictBasePipeline",
         (93, 704, 1280), 16, 36, "NVIDIA Open Model License", **_NVIDIA,
         licence_source="github.com/nvidia-cosmos/cosmos-predict2.5: README.md",
         revision="diffusers/base/post-trained", gpu_gb=32.5),
    _row("cosmos3-nano", "nvidia/Cosmos3-Nano", "Cosmos3OmniPipeline",
         (189, 720, 1280), 24, 35, "OpenMDW-1.1", **_COSMOS_3,
         time_s=240, time_source="H100; github.com/NVIDIA/cosmos: inference_benchmarks.md"),
    _row("cosmos3-super", "nvidia/Cosmos3-Super", "Cosmos3OmniPipeline",
         (189, 720, 1280), 24, 35, "OpenMDW-1.1", **_COSMOS_3, gpu_gb=120,
         time_s=886, time_source="H200; github.com/NVIDIA/cosmos: inference_benchmarks.md"),
    _row("wan-1.3b", "Wan-AI/Wan2.1-T2V-1.3B-Diffusers", "WanPipeline",
         (81, 480, 832), 16, 50, "Apache-2.0", offload_gb=8.2, **_WAN_2_1,
         time_s=240, time_source="RTX 4090; github.com/Wan-Video/Wan2.1: README.md"),
    _row("wan-14b", "Wan-AI/Wan2.1-T2V-14B-Diffusers", "WanPipeline",
         (81, 480, 832), 16, 50, "Apache-2.0", offload_gb=13, **_WAN_2_1),
    _row("wan-i2v-14b", "Wan-AI/Wan2.1-I2V-14B-480P-Diffusers", "WanImageToVideoPipeline",
         (81, 480, 832), 16, 50, "Apache-2.0", needs_image=True, **_WAN_2_1),
    _row("wan2.2-a14b", "Wan-AI/Wan2.2-T2V-A14B-Diffusers", "WanPipeline",
         (81, 480, 832), 16, 50, "Apache-2.0", gpu_gb=80, **_WAN_2_2),
    _row("wan2.2-i2v-a14b", "Wan-AI/Wan2.2-I2V-A14B-Diffusers", "WanImageToVideoPipeline",
         (81, 480, 832), 16, 40, "Apache-2.0", needs_image=True, guidance=3.5, gpu_gb=80,
         differs="steps and guidance of the publisher's wan_i2v_A14B.py", **_WAN_2_2),
    _row("wan2.2-5b", "Wan-AI/Wan2.2-TI2V-5B-Diffusers", "WanPipeline",
         (121, 704, 1280), 24, 50, "Apache-2.0", image_pipeline="WanImageToVideoPipeline",
         differs="frames and size of the publisher's README.md; the call has those of Wan 2.1",
         gpu_gb=24, **_WAN_2_2, time_s=540,
         time_source="under 9 minutes on a consumer GPU; github.com/Wan-Video/Wan2.2: README.md"),
    # Its index names a class of FastVideo. Distilled by DMD: clean video predicted at three noise
    # levels, new noise in between, as FlowMatchLCMScheduler does.
    _row("fastwan2.2-5b", "FastVideo/FastWan2.2-TI2V-5B-FullAttn-Diffusers", "WanPipeline",
         (121, 704, 1280), 24, 3, "Apache-2.0", image_pipeline="WanImageToVideoPipeline",
         **_WAN | {"licence_source": "hao-ai-lab.github.io/blogs/fastvideo_post_training"},
         guidance=1.0, sigmas=(1.0, 0.757, 0.522),
         scheduler={"class": "FlowMatchLCMScheduler", "shift": 1.0},
         differs="the publisher's three steps without guidance", gpu_gb=24,
         time_s=16, time_source="H200; hao-ai-lab.github.io/blogs/fastvideo_post_training"),
    _row("cogvideox-2b", "zai-org/CogVideoX-2b", "CogVideoXPipeline",
         (49, 480, 720), 8, 50, "Apache-2.0", **_COGVIDEOX,
         licence_source=f"{_COGVIDEO}: README.md", offload_gb=10, dtype="float16",
         time_s=45, time_source=f"H100; {_COGVIDEO}: README.md"),
    _row("cogvideox-5b", "zai-org/CogVideoX-5b", "CogVideoXPipeline",
         (49, 480, 720), 8, 50, "CogVideoX License", **_COGVIDEOX_5B, gpu_gb=33,
         time_s=90, time_source=f"H100; {_COGVIDEO}: README.md"),
    _row("cogvideox1.5-5b", "zai-org/CogVideoX1.5-5B", "CogVideoXPipeline",
         (81, 768, 1360), 16, 50, "CogVideoX License", **_COGVIDEOX_5B, gpu_gb=33,
         time_s=550, time_source=f"H100; {_COGVIDEO}: README.md"),
    _row("ltx", "Lightricks/LTX-Video", "LTXPipeline",
         (161, 512, 704), 25, 50, "OpenRail-M from 0.9.5", **_TINY,
         licence_source="github.com/Lightricks/LTX-Video: README.md",
         licence_terms="licence of older versions not read",
         image_pipeline="LTXImageToVideoPipeline", gpu_gb=10),
    # The LTX-2.x licence of August 2026, now in that file, is for LTX-2.5 and later.
    _row("ltx2", "Lightricks/LTX-2", "LTX2Pipeline",
         (121, 512, 768), 24, 30, "LTX-2 Community License (2026-01-05)", **_LTX_2,
         differs="the call leaves the frame count open; 121 without a head that chooses it",
         call={"spatio_temporal_guidance_blocks": [29]}),
    _row("ltx2.3-distilled", "diffusers/LTX-2.3-Distilled-Diffusers", "LTX2Pipeline",
         (121, 512, 768), 24, 8, "LTX-2 Community License (2026-01-05)", **_LTX_2_DISTILLED,
         differs="the publisher's eight noise levels without guidance"),
    _row("ltx2.3-hdr", "diffusers/LTX-2.3-Distilled-Diffusers", "LTX2HDRPipeline",
         (121, 512, 768), 24, 8, "LTX-2 Community License (2026-01-05)", **_LTX_2_HDR),
    _row("ltx2.5", "Lightricks/LTX-2.5-Diffusers", "LTX2Pipeline",
         (121, 512, 768), 24, 8, "LTX-2.x Community License (2026-08-11)",
         **_LTX_2_DISTILLED | {"licence_source": "github.com/Lightricks/LTX-2: LICENSE"},
         differs="the publisher's eight noise levels without guidance"),
    # The call's own noise levels are the publisher's eight; it takes no other step count.
    _row("ltx2.5-dfr", "Lightricks/LTX-2.5-Diffusers", "LTX2DFRPipeline",
         (121, 704, 1216), 24, None, "LTX-2.x Community License (2026-08-11)", **_TINY,
         licence_source="github.com/Lightricks/LTX-2: LICENSE",
         licence_terms=_LTX_2["licence_terms"],
         differs="the call leaves the frame count open; 121 without a head that chooses it"),
    _row("hunyuan", "hunyuanvideo-community/HunyuanVideo", "HunyuanVideoPipeline",
         (129, 720, 1280), 24, 50, "Tencent Hunyuan Community License", **_HUNYUAN,
         licence_source="github.com/Tencent-Hunyuan/HunyuanVideo: LICENSE.txt", gpu_gb=60,
         time_s=1904,
         time_source="GPU not named; github.com/Tencent-Hunyuan/HunyuanVideo: README.md"),
    _row("hunyuan1.5", "hunyuanvideo-community/HunyuanVideo-1.5-Diffusers-480p_t2v",
         "HunyuanVideo15Pipeline", (121, 480, 848), 24, 50, "Tencent Hunyuan Community License",
         **_HUNYUAN_1_5, differs="the call leaves the size to the weights"),
    _row("hunyuan1.5-i2v", "hunyuanvideo-community/HunyuanVideo-1.5-Diffusers-480p_i2v",
         "HunyuanVideo15ImageToVideoPipeline", (121, None, None), 24, 50,
         "Tencent Hunyuan Community License", needs_image=True, **_HUNYUAN_1_5),
    _row("mochi", "genmo/mochi-1-preview", "MochiPipeline",
         (84, 480, 848), 30, 64, "Apache-2.0", gpu_gb=70, offload_gb=22, **_TINY,
         differs="the usual length; the call's default is 19 frames, its size is open",
         licence_source="github.com/genmoai/mochi: README.md"),
    _row("allegro", "rhymes-ai/Allegro", "AllegroPipeline",
         (88, 720, 1280), 15, 100, "Apache-2.0", **_TINY,
         differs="the call leaves frames and size to the weights",
         licence_source="github.com/rhymes-ai/Allegro: LICENSE.txt"),
    _row("latte", "maxin-cn/Latte-1", "LattePipeline",
         (16, 512, 512), 8, 50, "Apache-2.0", **_TINY,
         licence_source="github.com/Vchitect/Latte: README.md, LICENSE"),
    _row("skyreels2-14b", "Skywork/SkyReels-V2-T2V-14B-720P-Diffusers", "SkyReelsV2Pipeline",
         (97, 544, 960), 24, 50, "Skywork Community License", **_SKYREELS, offload_gb=43.4),
    _row("skyreels2-df-1.3b", "Skywork/SkyReels-V2-DF-1.3B-540P-Diffusers",
         "SkyReelsV2DiffusionForcingPipeline",
         (97, 544, 960), 24, 50, "Skywork Community License", **_SKYREELS, offload_gb=14.7,
         image_pipeline="SkyReelsV2DiffusionForcingImageToVideoPipeline"),
    _row("sana-2b", "Efficient-Large-Model/SANA-Video_2B_480p_diffusers", "SanaVideoPipeline",
         (81, 480, 832), 16, 50, "NVIDIA Open Model License", **_TINY, needs_float32_vae=True,
         image_pipeline="SanaImageToVideoPipeline",
         licence_source="model page of Efficient-Large-Model/SANA-Video_2B_480p (a copy)"),
    _row("kandinsky5-lite", "kandinskylab/Kandinsky-5.0-T2V-Lite-sft-5s-Diffusers",
         "Kandinsky5T2VPipeline", (121, 512, 768), 24, 50, "MIT", **_KANDINSKY_5,
         time_s=139, time_source=_ON_H100),
    _row("kandinsky5-distill", "kandinskylab/Kandinsky-5.0-T2V-Lite-distilled16steps-5s-Diffusers",
         "Kandinsky5T2VPipeline", (121, 512, 768), 24, 16, "MIT", **_KANDINSKY_5, guidance=1.0,
         differs="distilled to 16 steps without guidance", time_s=35, time_source=_ON_H100),
    _row("kandinsky6-distill", "kandinskylab/Kandinsky-6.0-Pro-distill-5s-Diffusers",
         "Kandinsky6TI2VAPipeline", (121, 480, 864), 24, 16, "MIT", guidance=1.0, **_TINY,
         differs="size and steps of the example in its pipeline",
         licence_source="github.com/kandinskylab/kandinsky-6: pyproject.toml"),
    _row("animatediff", "frankjoshua/toonyou_beta6", "AnimateDiffPipeline",
         (16, 512, 512), 8, 50, "adapter Apache-2.0", **_TINY,
         differs="the call leaves the size to the weights",
         licence_source="github.com/guoyww/AnimateDiff: LICENSE.txt",
         licence_terms="image model: read its page",
         motion_adapter="guoyww/animatediff-motion-adapter-v1-5-2", dtype="float16",
         ignores_fps=True),
    _row("easyanimate-7b", "alibaba-pai/EasyAnimateV5.1-7b-zh-diffusers", "EasyAnimatePipeline",
         (49, 512, 512), 8, 50, "Apache-2.0", **_TINY,
         call={"negative_prompt": ""},  # it fails without one
         licence_source="github.com/aigc-apps/EasyAnimate: LICENSE"),
    _row("helios", "BestWishYsh/Helios-Base", "HeliosPipeline",
         (132, 384, 640), 24, 50, "Apache-2.0", **_HELIOS),
    _row("helios-distilled", "BestWishYsh/Helios-Distilled", "HeliosPyramidPipeline",
         (132, 384, 640), 24, 6, "Apache-2.0", **_HELIOS, guidance=1.0,
         call={"is_amplify_first_chunk": True},
         differs="the publisher's two steps at each of three sizes, without guidance",
         time_s=6.8,
         time_source="19.5 frames/s on H100; github.com/PKU-YuanGroup/Helios: README.md"),
    _row("motif-2b", "Motif-Technologies/Motif-Video-2B", "MotifVideoPipeline",
         (121, 736, 1280), 24, 50, "Apache-2.0, says a third party", **_TINY,
         image_pipeline="MotifVideoImage2VideoPipeline", offload_gb=30,
         licence_source="github.com/lucataco/cog-motif-video: README.md, not the publisher's"),
    _row("anyflow-1.3b", "nvidia/AnyFlow-Wan2.1-T2V-1.3B-Diffusers", "AnyFlowPipeline",
         (81, 480, 832), 16, 4, "Apache-2.0", **_ANYFLOW),
    _row("anyflow-14b", "nvidia/AnyFlow-Wan2.1-T2V-14B-Diffusers", "AnyFlowPipeline",
         (81, 480, 832), 16, 4, "Apache-2.0", **_ANYFLOW),
)
# fmt: on

MODELS: dict[str, VideoModel] = {row.name: row for row in _ROWS}
"""Name → row, the paper's default first."""
