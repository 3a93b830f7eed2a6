"""Learned text-to-video models that `--generator` knows by name, as one table of facts.

One adapter (`diffusers_models/generator.py`) runs all of them. A row says where the weights are,
which diffusers pipeline runs them and what they were made for; every value is a default that an
option overrides. Frame counts, sizes and step counts are the call defaults of diffusers 0.42. The
weights cannot be redistributed here, so `is_verified` says how far a row was tried: True means that
the pipeline class runs with tiny random weights of the same layout in the tests of texvent.
Licences are what the publishers' repositories said in November 2026.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any


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
    fps: Fraction | None = None
    """Frame rate the model was trained for; it is nowhere in the weights."""
    frames: int | None = None
    width: int | None = None
    height: int | None = None
    steps: int | None = None
    guidance: float | None = None
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
    dtype: str = "bfloat16"
    """Number format on a GPU."""
    needs_float32_vae: bool = False
    """Whether its decoder should stay in float32 (Wan's page asks for it)."""
    ignores_fps: bool = False
    """Whether the rate is known not to change the frames."""
    is_verified: bool = False

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
    shape: tuple[int, int, int],
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


_NVIDIA: dict[str, Any] = {"licence_terms": "ends if its guardrail is bypassed"}
_COGVIDEOX: dict[str, Any] = {
    "licence_source": "github.com/zai-org/CogVideo: MODEL_LICENSE",
    "licence_terms": "commercial use after registration; not military",
}
_HUNYUAN: dict[str, Any] = {
    "licence_terms": "not in the EU, UK, South Korea; 100 M monthly users: ask; output may not "
    "improve other AI models",
}
_WAN: dict[str, Any] = {"needs_float32_vae": True, "ignores_fps": True, "is_verified": True}
_WAN_2_1: dict[str, Any] = _WAN | {"licence_source": "github.com/Wan-Video/Wan2.1: README.md"}
_WAN_2_2: dict[str, Any] = _WAN | {"licence_source": "github.com/Wan-Video/Wan2.2: README.md"}

# fmt: off
_ROWS = (
    # name, repository, pipeline, (frames, height, width), fps, steps, licence, what else is known
    _row("cosmos-7b", "nvidia/Cosmos-1.0-Diffusion-7B-Text2World", "CosmosTextToWorldPipeline",
         (121, 704, 1280), 24, 36, "NVIDIA Open Model License", **_NVIDIA,
         licence_source="docs.api.nvidia.com/nim: nvidia/cosmos-1_0-diffusion-7b",
         gpu_gb=74, offload_gb=24.4, is_verified=True),
    _row("cosmos2.5-2b", "nvidia/Cosmos-Predict2.5-2B", "Cosmos2_5_PredictBasePipeline",
         (93, 704, 1280), 16, 36, "NVIDIA Open Model License", **_NVIDIA,
         licence_source="github.com/nvidia-cosmos/cosmos-predict2.5: README.md",
         revision="diffusers/base/post-trained", gpu_gb=32.5, is_verified=True),
    _row("cosmos3-nano", "nvidia/Cosmos3-Nano", "Cosmos3OmniPipeline",
         (189, 720, 1280), 24, 35, "OpenMDW-1.1",
         licence_source="github.com/NVIDIA/cosmos: README.md, LICENSE"),
    _row("wan-1.3b", "Wan-AI/Wan2.1-T2V-1.3B-Diffusers", "WanPipeline",
         (81, 480, 832), 16, 50, "Apache-2.0", offload_gb=8.2, **_WAN_2_1),
    _row("wan-14b", "Wan-AI/Wan2.1-T2V-14B-Diffusers", "WanPipeline",
         (81, 480, 832), 16, 50, "Apache-2.0", offload_gb=13, **_WAN_2_1),
    _row("wan2.2-a14b", "Wan-AI/Wan2.2-T2V-A14B-Diffusers", "WanPipeline",
         (81, 480, 832), 16, 50, "Apache-2.0", gpu_gb=80, **_WAN_2_2),
    _row("wan2.2-5b", "Wan-AI/Wan2.2-TI2V-5B-Diffusers", "WanPipeline",
         (121, 704, 1280), 24, 50, "Apache-2.0", image_pipeline="WanImageToVideoPipeline",
         gpu_gb=24, **_WAN_2_2),
    _row("cogvideox-2b", "zai-org/CogVideoX-2b", "CogVideoXPipeline",
         (49, 480, 720), 8, 50, "Apache-2.0",
         licence_source="github.com/zai-org/CogVideo: README.md", offload_gb=10,
         dtype="float16", ignores_fps=True, is_verified=True),
    _row("cogvideox-5b", "zai-org/CogVideoX-5b", "CogVideoXPipeline",
         (49, 480, 720), 8, 50, "CogVideoX License", **_COGVIDEOX, gpu_gb=33,
         ignores_fps=True, is_verified=True),
    _row("cogvideox1.5-5b", "zai-org/CogVideoX1.5-5B", "CogVideoXPipeline",
         (81, 768, 1360), 16, 50, "CogVideoX License", **_COGVIDEOX, gpu_gb=33,
         ignores_fps=True, is_verified=True),
    _row("ltx", "Lightricks/LTX-Video", "LTXPipeline",
         (161, 512, 704), 25, 50, "OpenRail-M from 0.9.5",
         licence_source="github.com/Lightricks/LTX-Video: README.md",
         licence_terms="licence of older versions not read",
         image_pipeline="LTXImageToVideoPipeline", gpu_gb=10, is_verified=True),
    # The LTX-2.x licence of August 2026, now in that file, is for LTX-2.5 and later.
    _row("ltx2", "Lightricks/LTX-2", "LTX2Pipeline",
         (121, 512, 768), 24, 30, "LTX-2 Community License (2026-01-05)",
         licence_source="github.com/Lightricks/LTX-2: LICENSE (commit 4dbd99e)",
         licence_terms="paid from $10 M revenue; not military; no commercial training of other "
         "models"),
    _row("hunyuan", "hunyuanvideo-community/HunyuanVideo", "HunyuanVideoPipeline",
         (129, 720, 1280), 24, 50, "Tencent Hunyuan Community License", **_HUNYUAN,
         licence_source="github.com/Tencent-Hunyuan/HunyuanVideo: LICENSE.txt"),
    _row("hunyuan1.5", "hunyuanvideo-community/HunyuanVideo-1.5-480p_t2v", "HunyuanVideo15Pipeline",
         (121, 480, 848), 24, 50, "Tencent Hunyuan Community License", **_HUNYUAN,
         licence_source="github.com/Tencent-Hunyuan/HunyuanVideo-1.5: LICENSE"),
    _row("mochi", "genmo/mochi-1-preview", "MochiPipeline",
         (84, 480, 848), 30, 64, "Apache-2.0", gpu_gb=70, offload_gb=22,
         licence_source="github.com/genmoai/mochi: README.md"),
    _row("allegro", "rhymes-ai/Allegro", "AllegroPipeline",
         (88, 720, 1280), 15, 100, "Apache-2.0",
         licence_source="github.com/rhymes-ai/Allegro: LICENSE.txt"),
    _row("latte", "maxin-cn/Latte-1", "LattePipeline",
         (16, 512, 512), 8, 50, "Apache-2.0",
         licence_source="github.com/Vchitect/Latte: README.md, LICENSE"),
    _row("skyreels2-14b", "Skywork/SkyReels-V2-T2V-14B-720P-Diffusers", "SkyReelsV2Pipeline",
         (97, 544, 960), 24, 50, "Skywork Community License",
         licence_source="github.com/SkyworkAI/SkyReels-V2: LICENSE.txt",
         licence_terms="commercial use allowed under its conditions"),
    _row("sana-2b", "Efficient-Large-Model/SANA-Video_2B_480p_diffusers", "SanaVideoPipeline",
         (81, 480, 832), 16, 50, "NVIDIA Open Model License",
         licence_source="model page of Efficient-Large-Model/SANA-Video_2B_480p (a copy)"),
    _row("kandinsky5-lite", "kandinskylab/Kandinsky-5.0-T2V-Lite-sft-5s-Diffusers",
         "Kandinsky5T2VPipeline", (121, 512, 768), 24, 50, "MIT",
         licence_source="github.com/kandinskylab/kandinsky-5: LICENSE"),
    _row("kandinsky6-distill", "kandinskylab/Kandinsky-6.0-Pro-distill-5s-Diffusers",
         "Kandinsky6TI2VAPipeline", (121, 480, 864), 24, 16, "MIT", guidance=1.0,
         licence_source="github.com/kandinskylab/kandinsky-6: pyproject.toml"),
    _row("animatediff", "frankjoshua/toonyou_beta6", "AnimateDiffPipeline",
         (16, 512, 512), 8, 50, "adapter Apache-2.0",
         licence_source="github.com/guoyww/AnimateDiff: LICENSE.txt",
         licence_terms="image model: read its page",
         motion_adapter="guoyww/animatediff-motion-adapter-v1-5-2", dtype="float16",
         ignores_fps=True, is_verified=True),
    _row("easyanimate-7b", "alibaba-pai/EasyAnimateV5.1-7b-zh-diffusers", "EasyAnimatePipeline",
         (49, 512, 512), 8, 50, "Apache-2.0",
         licence_source="github.com/aigc-apps/EasyAnimate: LICENSE"),
    _row("helios", "BestWishYsh/Helios-Base", "HeliosPipeline",
         (132, 384, 640), 24, 50, "Apache-2.0", offload_gb=6,
         licence_source="github.com/PKU-YuanGroup/Helios: LICENSE.txt"),
    _row("motif-2b", "Motif-Technologies/Motif-Video-2B", "MotifVideoPipeline",
         (121, 736, 1280), 24, None, VideoModel.licence, offload_gb=30),
    _row("anyflow-14b", "nvidia/AnyFlow-Wan2.1-T2V-14B-Diffusers", "AnyFlowPipeline",
         (81, 480, 832), 16, 4, "Apache-2.0",
         licence_source="github.com/NVlabs/AnyFlow: README.md, LICENSE"),
)
# fmt: on

MODELS: dict[str, VideoModel] = {row.name: row for row in _ROWS}
"""Name → row, the paper's default first."""
