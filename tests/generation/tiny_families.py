"""A tiny pipeline of every family that the table of models names, in the layout of published ones.

Each builder makes a real diffusers pipeline with random weights.
"""

import json
import warnings
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import diffusers
import transformers
from diffusers.pipelines.ltx2 import LTX2LatentUpsamplerModel, LTX2TextConnectors, LTX2Vocoder
from safetensors.torch import save_file

from . import tiny_pipelines
from .tiny_pipelines import (
    SMALL,
    cogvideox,
    cosmos_transformer,
    flow_unipc,
    qwen,
    random_weights,
    t5,
    wan_transformer,
    wan_vae,
)

CONNECTOR = {
    "num_attention_heads": 2,
    "attention_head_dim": 8,
    "num_layers": 1,
    "num_learnable_registers": None,
}


@dataclass(frozen=True)
class Family:
    """How to build a family's tiny pipeline, and what its run needs."""

    build: Callable[[], Any]
    pipeline: str
    """diffusers class that runs."""
    options: dict[str, Any] = field(default_factory=dict)
    """Beside or instead of `tiny_models.OPTIONS`."""
    frames: int = 5
    """What comes out."""
    side: int = 32
    """Its width and height."""
    steps: int = 2
    """Denoising steps that are reported; HunyuanVideo 1.5 reports none."""
    takes_image: bool = False
    named: str = ""
    """The row whose facts the run takes, or the last part of its repository."""


def flow_match(**facts):
    return diffusers.FlowMatchEulerDiscreteScheduler(**facts)


def ltx2(kind=diffusers.LTX2Pipeline, patch_size=1, **of_transformer):
    tokenizer = gemma_tokenizer()
    text = SMALL | {"head_dim": 8, "num_key_value_heads": 2, "vocab_size": len(tokenizer)}
    vision = SMALL | {"image_size": 14, "patch_size": 14}
    gemma = transformers.Gemma3Config(
        text_config=text, vision_config=vision, mm_tokens_per_image=1, image_token_index=5
    )
    audio = {"base_channels": 4, "latent_channels": 2, "ch_mult": (1,), "num_res_blocks": 1}
    audio |= {"output_channels": 2, "in_channels": 2, "mel_bins": 8, "resolution": 32}
    connector = {
        f"{kind}_connector_{name}": value
        for kind in ("video", "audio")
        for name, value in CONNECTOR.items()
    }
    return kind(
        tokenizer=tokenizer,
        text_encoder=transformers.Gemma3ForConditionalGeneration(gemma).eval(),
        vae=diffusers.AutoencoderKLLTX2Video(
            latent_channels=4,
            block_out_channels=(8,),
            decoder_block_out_channels=(8,),
            layers_per_block=(1,),
            decoder_layers_per_block=(1, 1),
            spatio_temporal_scaling=(True,),
            decoder_spatio_temporal_scaling=(True,),
            decoder_inject_noise=(False, False),
            downsample_type=("spatiotemporal",),
            upsample_type=("spatiotemporal",),
            upsample_residual=(False,),
            upsample_factor=(1,),
            patch_size=patch_size,
            patch_size_t=1,
            decoder_causal=False,
        ),
        audio_vae=diffusers.AutoencoderKLLTX2Audio(**audio, mid_block_add_attention=False),
        vocoder=LTX2Vocoder(
            in_channels=16,
            hidden_channels=32,
            upsample_kernel_sizes=[4, 4],
            upsample_factors=[2, 2],
            resnet_kernel_sizes=[3],
            resnet_dilations=[[1, 3, 5]],
        ),
        connectors=LTX2TextConnectors(
            **connector,
            caption_channels=16,
            text_proj_in_factor=3,
            connector_rope_base_seq_len=32,
            rope_double_precision=False,
            rope_type="split",
        ),
        scheduler=flow_match(),
        transformer=diffusers.LTX2VideoTransformer3DModel(
            in_channels=4,
            out_channels=4,
            patch_size=1,
            num_attention_heads=2,
            attention_head_dim=8,
            cross_attention_dim=16,
            audio_in_channels=4,
            audio_out_channels=4,
            audio_num_attention_heads=2,
            audio_attention_head_dim=4,
            audio_cross_attention_dim=8,
            num_layers=1,
            caption_channels=16,
            rope_double_precision=False,
            rope_type="split",
            **of_transformer,
        ),
    )


def qwen_text():
    """The text half of Qwen2.5-VL, with its tokenizer."""
    parts = qwen()
    return {
        "tokenizer": parts["tokenizer"],
        "text_encoder": parts["text_encoder"].model.language_model.eval(),
    }


def hunyuan15():
    letters = transformers.ByT5Tokenizer()
    small_t5 = {"d_model": 16, "d_kv": 8, "d_ff": 16, "num_layers": 1, "num_heads": 2}
    byt5 = transformers.T5Config(vocab_size=len(letters), **small_t5)
    return diffusers.HunyuanVideo15Pipeline(
        **qwen_text(),
        tokenizer_2=letters,
        text_encoder_2=transformers.T5EncoderModel(byt5).eval(),
        vae=diffusers.AutoencoderKLHunyuanVideo15(
            latent_channels=4,
            block_out_channels=(16, 16),
            layers_per_block=1,
            spatial_compression_ratio=4,
            temporal_compression_ratio=2,
            downsample_match_channel=False,
            upsample_match_channel=False,
        ),
        scheduler=flow_match(shift=7.0),
        transformer=diffusers.HunyuanVideo15Transformer3DModel(
            in_channels=9,
            out_channels=4,
            num_attention_heads=2,
            attention_head_dim=8,
            num_layers=1,
            num_refiner_layers=1,
            mlp_ratio=2.0,
            text_embed_dim=16,
            text_embed_2_dim=16,
            image_embed_dim=12,
            rope_axes_dim=(2, 2, 4),
            target_size=32,
            task_type="t2v",
        ),
        guider=diffusers.ClassifierFreeGuidance(guidance_scale=6.0),
    )


def gemma_tokenizer():
    specials = ["<pad>", "<eos>", "<bos>", "<unk>", "<start_of_turn>", "<end_of_turn>", "▁"]
    letters = specials + [chr(code) for code in range(33, 127)]
    vocabulary = {letter: number for number, letter in enumerate(letters)}
    return transformers.GemmaTokenizer(vocab=vocabulary, merges=[])


def cosmos3():
    import cosmos_guardrail

    tokenizer = qwen()["tokenizer"]
    return diffusers.Cosmos3OmniPipeline(
        text_tokenizer=tokenizer,
        vae=wan_vae(),
        scheduler=flow_unipc(flow_shift=3.0),
        transformer=diffusers.Cosmos3OmniTransformer(
            head_dim=6,
            hidden_act="silu",
            hidden_size=6,
            intermediate_size=12,
            latent_channel=16,
            latent_patch_size=1,
            num_attention_heads=1,
            num_hidden_layers=1,
            num_key_value_heads=1,
            patch_latent_dim=16,
            rope_axes_dim=[1, 1, 1],
            vocab_size=len(tokenizer),
        ),
        safety_checker=cosmos_guardrail.CosmosSafetyChecker(),
    )


def wan_vace():
    return diffusers.WanVACEPipeline(
        **t5(transformers.UMT5EncoderModel, transformers.UMT5Config),
        vae=wan_vae(),
        scheduler=flow_match(shift=7.0),
        transformer=wan_transformer(
            diffusers.WanVACETransformer3DModel, vace_layers=[0], vace_in_channels=96
        ),
    )


def cosmos_transfer():
    import cosmos_guardrail

    like = {"text_embed_dim": 32, "extra_pos_embed_type": None, "use_crossattn_projection": True}
    like |= {"crossattn_proj_in_channels": 32, "encoder_hidden_states_channels": 32}
    transformer = cosmos_transformer(
        in_channels=17,
        out_channels=16,
        max_size=(93, 32, 32),  # chunks of 93 frames
        controlnet_block_every_n=1,
        img_context_dim_in=32,
        img_context_num_tokens=4,
        img_context_dim_out=32,
        **like,
    )
    shape = transformer.config
    return diffusers.Cosmos2_5_TransferPipeline(
        **qwen(),
        vae=wan_vae(),
        scheduler=flow_unipc(flow_shift=3.0),
        transformer=transformer,
        controlnet=diffusers.CosmosControlNetModel(
            n_controlnet_blocks=2,
            in_channels=18,
            latent_channels=18,
            model_channels=32,
            num_attention_heads=2,
            attention_head_dim=16,
            mlp_ratio=2,
            text_embed_dim=32,
            adaln_lora_dim=4,
            patch_size=shape.patch_size,
            max_size=shape.max_size,
            rope_scale=shape.rope_scale,
            use_crossattn_projection=False,
            crossattn_proj_in_channels=32,
            encoder_hidden_states_channels=32,
            img_context_dim_in=32,
            img_context_dim_out=32,
        ),
        safety_checker=cosmos_guardrail.CosmosSafetyChecker(),
    )


def cogvideox_fun():
    small = {"sample_width": 4, "sample_height": 4, "sample_frames": 5}
    return cogvideox(diffusers.CogVideoXFunControlPipeline, in_channels=8, **small)


class ModularParts:
    """Parts of a modular pipeline, saved as its publisher's repository has them."""

    def __init__(self, kind, **parts):
        self.kind, self.parts = kind, parts

    def save_pretrained(self, folder, safe_serialization):
        del safe_serialization
        index = {"_class_name": self.kind, "_blocks_class_name": "MiniMaxH3Blocks"}
        for name, part in self.parts.items():
            part.save_pretrained(folder / name)
            library, kind = type(part).__module__.partition(".")[0], type(part).__name__
            origin = {"pretrained_model_name_or_path": "org/name", "subfolder": name}
            index[name] = [library, kind, {"type_hint": [library, kind], **origin}]
        index["transformer_ref"] = index["transformer"]  # for another task: not fetched
        for file in ("model_index.json", "modular_model_index.json"):
            (folder / file).write_text(json.dumps(index))


def minimax_h3():
    tokenizer = qwen()["tokenizer"]
    text = SMALL | {"num_hidden_layers": 51, "num_key_value_heads": 2, "head_dim": 8}
    rope = {"mrope_section": [2, 1, 1], "rope_type": "default", "mrope_interleaved": True}
    text |= {"vocab_size": len(tokenizer), "rope_scaling": rope, "rope_theta": 5_000_000.0}
    text |= {"bos_token_id": None, "eos_token_id": None}
    vision = {"depth": 1, "hidden_size": 16, "intermediate_size": 16, "num_heads": 2}
    vision |= {"out_hidden_size": 16, "deepstack_visual_indexes": [0]}
    config = transformers.Qwen3VLConfig(text_config=text, vision_config=vision)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", FutureWarning)  # torch's of weight_norm
        audio_vae = diffusers.AutoencoderKLMiniMaxH3Audio(
            encoder_dim=2,
            latent_dim=64,
            latent_channels=4,
            num_attention_heads=2,
            decoder_dim=128,
            resblock_kernel_sizes=(3,),
            resblock_dilation_sizes=((1, 3, 5),),
            latents_mean=[0.0] * 4,
            latents_std=[1.0] * 4,
        )
    return ModularParts(
        "MiniMaxH3ModularPipeline",
        text_encoder=transformers.Qwen3VLForConditionalGeneration(config).eval(),
        tokenizer=tokenizer,
        vae=diffusers.AutoencoderKLMiniMaxH3(
            latent_channels=4,
            block_out_channels=(4, 4, 4, 4, 4, 4),
            layers_per_block=1,
            norm_num_groups=2,
            decoder_num_layers=1,
            decoder_num_attention_heads=2,
            decoder_attention_head_dim=16,
            latents_mean=(0.0,) * 4,
            latents_std=(1.0,) * 4,
        ),
        audio_vae=audio_vae,
        transformer=diffusers.MiniMaxH3Transformer3DModel(
            num_attention_heads=2,
            attention_head_dim=32,
            hidden_size=64,
            num_layers=1,
            num_refiner_layers=1,
            ffn_dim=32,
            in_channels=4,
            audio_in_channels=4,
            text_dim=16,
            freq_dim=16,
            time_embed_hidden_dim=16,
            time_embed_dim=16,
            rope_freq_dim=4,
        ),
        scheduler=diffusers.MiniMaxH3Scheduler(shift=12.0),
        audio_scheduler=diffusers.MiniMaxH3Scheduler(shift=3.0),
    )


class WithFiles:
    """A pipeline and networks of single files that are published elsewhere."""

    def __init__(self, pipe, **networks):
        self.pipe, self.networks = pipe, networks

    def save_pretrained(self, folder, safe_serialization):
        self.pipe.save_pretrained(folder, safe_serialization=safe_serialization)
        for name, network in self.networks.items():
            save_file(network.state_dict(), folder / f"{name}.safetensors")


def ltx2_temporal():
    """LTX-2.5, whose network marks keyframes, with its upscalers' files; it doubles both sides."""
    small = {"in_channels": 4, "mid_channels": 32, "num_blocks_per_stage": 1}
    space = LTX2LatentUpsamplerModel(**small, use_rational_resampler=False)
    time = LTX2LatentUpsamplerModel(**small, spatial_upsample=False, temporal_upsample=True)
    files = {
        "ltx-2.5-latent-spatial-upscaler-x2-bf16-1.0": space,
        "ltx-2.5-latent-temporal-upscaler-x2-bf16-1.0": time,
    }
    pipe = ltx2(patch_size=4, use_keyframes_abs_pos_embedding=True)
    return WithFiles(pipe, **files)


def ltx2_in_context():
    return ltx2(diffusers.LTX2InContextPipeline)


FAMILIES = {
    "hunyuan15": Family(hunyuan15, "HunyuanVideo15Pipeline", steps=0),
    "cosmos3": Family(cosmos3, "Cosmos3OmniPipeline"),
    "ltx2-distilled": Family(
        ltx2,
        "LTX2Pipeline",
        {"steps": 8, "guidance": 1.0},
        steps=8,
        named="LTX-2.3-Distilled-Diffusers",
    ),
    "ltx2-temporal": Family(
        ltx2_temporal,
        "LTX2DFRTemporalRefinePipeline",
        {
            "fps": 50,
            "frames": 33,
            "width": 64,
            "height": 64,
            "steps": None,
            "guidance": None,
        },
        frames=33,
        side=64,
        steps=8 + 3 + 2 * 4,
        named="ltx2.5-temporal",
    ),
    "minimax-h3": Family(
        minimax_h3,
        "MiniMaxH3ModularPipeline",
        {"fps": 24, "frames": 124, "guidance": None},
        frames=124,
        steps=0,
        named="MiniMax-H3",
    ),
    "ltx2-image": Family(ltx2, "LTX2ImageToVideoPipeline", takes_image=True, named="LTX-2"),
}
"""Name of the test → its pipeline."""
STEERED = {
    "wan-vace": Family(wan_vace, "WanVACEPipeline"),
    "cosmos-transfer": Family(cosmos_transfer, "Cosmos2_5_TransferPipeline"),
    "cogvideox-fun": Family(cogvideox_fun, "CogVideoXFunControlPipeline", {"frames": 9}, frames=9),
    "ltx2-control": Family(ltx2_in_context, "LTX2InContextPipeline", {"frames": 9}, frames=9),
}
"""As `FAMILIES`, of models that follow a scene."""


def save(name: str, folder: Path) -> Path:
    """Save the tiny pipeline of that name, of a builder or a family, and return its path."""
    family = {**FAMILIES, **STEERED}.get(name)
    path = folder / name / (family.named if family and family.named else f"tiny-{name}")
    with random_weights():
        pipe = family.build() if family else getattr(tiny_pipelines, name)()
    pipe.save_pretrained(path, safe_serialization=True)
    return path
