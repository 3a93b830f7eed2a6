"""A tiny pipeline of every family that the table of models names, beside those of `tiny_pipelines`.

Each builder makes a real diffusers pipeline with random weights; `tests/generate/tiny_pipelines.py`
saves it in the layout of the published ones.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import diffusers
import torch
import transformers
from diffusers.pipelines.ltx2 import LTX2TextConnectors, LTX2Vocoder

from . import tiny_pipelines
from .tiny_pipelines import clip_text, qwen, t5, wan_vae

WAN_LIKE = {
    "patch_size": (1, 2, 2),
    "num_attention_heads": 2,
    "attention_head_dim": 12,
    "in_channels": 16,
    "out_channels": 16,
    "text_dim": 32,
    "freq_dim": 16,
    "ffn_dim": 32,
    "num_layers": 1,
}
SMALL_TEXT = {
    "hidden_size": 16,
    "intermediate_size": 16,
    "num_hidden_layers": 2,
    "num_attention_heads": 2,
}
SANA_PATCH = {
    f"diffusers.pipelines.sana_video.{module}.ASPECT_RATIO_480_BIN": {"1.0": [32.0, 32.0]}
    for module in ("pipeline_sana_video", "pipeline_sana_video_i2v")
}
"""Sizes that the pipelines generate at, by aspect ratio; the real ones are near 480 lines."""
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
    steps: int = 2
    """Denoising steps that are reported."""
    size: tuple[int, int] = (32, 32)
    """Height and width that come out."""
    takes_image: bool = False
    patches: dict[str, Any] = field(default_factory=dict)
    """Names in diffusers, and what stands in for them."""
    named: str = ""
    """The row whose facts the run takes, or the last part of its repository."""


def umt5():
    return t5(None, transformers.UMT5EncoderModel, transformers.UMT5Config)


def flow_match(**facts):
    return diffusers.FlowMatchEulerDiscreteScheduler(**facts)


def flow_unipc():
    return diffusers.UniPCMultistepScheduler(
        prediction_type="flow_prediction", use_flow_sigmas=True, flow_shift=3.0
    )


def wan_image_to_video():
    size = {"height": 32, "width": 32}
    return diffusers.WanImageToVideoPipeline(
        **umt5(),
        vae=wan_vae(),
        scheduler=flow_unipc(),
        transformer=diffusers.WanTransformer3DModel(**WAN_LIKE | {"in_channels": 36}, image_dim=4),
        image_encoder=transformers.CLIPVisionModel(
            transformers.CLIPVisionConfig(
                hidden_size=4,
                intermediate_size=8,
                num_hidden_layers=2,
                num_attention_heads=2,
                image_size=32,
                patch_size=8,
            )
        ),
        image_processor=transformers.CLIPImageProcessorPil(size=size, crop_size=size),
    )


def skyreels_parts(*, takes_fps):
    return {
        **umt5(),
        "vae": wan_vae(),
        "scheduler": flow_unipc(),
        "transformer": diffusers.SkyReelsV2Transformer3DModel(
            **WAN_LIKE, inject_sample_info=takes_fps
        ),
    }


def skyreels():
    return diffusers.SkyReelsV2Pipeline(**skyreels_parts(takes_fps=False))


def skyreels_forcing():
    return diffusers.SkyReelsV2DiffusionForcingPipeline(**skyreels_parts(takes_fps=True))


def anyflow():
    return diffusers.AnyFlowPipeline(
        **umt5(),
        vae=wan_vae(),
        scheduler=diffusers.FlowMapEulerDiscreteScheduler(shift=5.0),
        transformer=diffusers.AnyFlowTransformer3DModel(
            **WAN_LIKE, gate_value=0.25, deltatime_type="r"
        ),
    )


def helios_parts():
    return {
        **umt5(),
        "vae": wan_vae(),
        "transformer": diffusers.HeliosTransformer3DModel(
            **WAN_LIKE,
            rope_dim=(4, 4, 4),
            has_multi_term_memory_patch=True,
            guidance_cross_attn=True,
            zero_history_timestep=True,
        ),
    }


def helios():
    scheduler = diffusers.HeliosScheduler(stage_range=[0, 1], stages=1, use_dynamic_shifting=True)
    return diffusers.HeliosPipeline(**helios_parts(), scheduler=scheduler)


def helios_distilled():
    # With the usual gamma, 1/3, diffusers 0.42 factorises a singular matrix, which fails on a CPU.
    scheduler = diffusers.HeliosDMDScheduler(use_dynamic_shifting=True, gamma=0.3)
    return diffusers.HeliosPyramidPipeline(**helios_parts(), scheduler=scheduler, is_distilled=True)


def ltx():
    return tiny_pipelines.ltx(None)


def ltx2(pipeline=diffusers.LTX2Pipeline, patch_size=1, **transformer):
    tokenizer = gemma_tokenizer()
    text = SMALL_TEXT | {"head_dim": 8, "num_key_value_heads": 2, "vocab_size": len(tokenizer)}
    vision = SMALL_TEXT | {"image_size": 14, "patch_size": 14}
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
    return pipeline(
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
            **transformer,
        ),
    )


def ltx2_keyframes():
    """LTX-2.5's: the transformer knows keyframes by a mark, which training makes; zero at first."""
    pipe = ltx2(
        diffusers.LTX2DFRPipeline,
        patch_size=4,  # few tokens: the rounds run the transformer 32 times
        use_keyframes_abs_pos_embedding=True,
        vae_scale_factors=(2, 8, 8),
    )
    torch.nn.init.normal_(pipe.transformer.keyframes_abs_pos_embedding, std=0.1)
    return pipe


def fast_wan():
    return diffusers.WanPipeline(
        **umt5(),
        vae=wan_vae(),
        scheduler=flow_unipc(),
        transformer=diffusers.WanTransformer3DModel(**WAN_LIKE),
        expand_timesteps=True,
    )


def motif():
    text = transformers.T5Gemma2TextConfig(
        hidden_size=32,
        num_hidden_layers=1,
        num_attention_heads=2,
        intermediate_size=64,
        vocab_size=98,
        head_dim=16,
        num_key_value_heads=2,
        dropout_rate=0.0,
    )
    vision = SMALL_TEXT | {"num_hidden_layers": 1, "image_size": 16, "patch_size": 8}
    encoder = transformers.T5Gemma2EncoderConfig(
        text_config=text, vision_config=vision, mm_tokens_per_image=4
    )
    return diffusers.MotifVideoPipeline(
        tokenizer=t5(None)["tokenizer"],
        text_encoder=transformers.models.t5gemma2.modeling_t5gemma2.T5Gemma2Encoder(encoder).eval(),
        vae=wan_vae(),
        scheduler=flow_match(shift=7.0),
        transformer=diffusers.MotifVideoTransformer3DModel(
            in_channels=33,
            out_channels=16,
            num_attention_heads=2,
            attention_head_dim=12,
            num_layers=1,
            num_single_layers=1,
            patch_size=1,
            patch_size_t=1,
            text_embed_dim=32,
            image_embed_dim=16,
            rope_axes_dim=(4, 4, 4),
        ),
        guider=diffusers.AdaptiveProjectedGuidance(),
        feature_extractor=transformers.SiglipImageProcessorPil(size={"height": 16, "width": 16}),
    )


def hunyuan_vae(levels=4):
    return diffusers.AutoencoderKLHunyuanVideo(
        latent_channels=4,
        down_block_types=("HunyuanVideoDownBlock3D",) * levels,
        up_block_types=("HunyuanVideoUpBlock3D",) * levels,
        block_out_channels=(8,) * levels,
        layers_per_block=1,
        norm_num_groups=4,
    )


def hunyuan():
    letters = t5(None)["tokenizer"]
    llama = transformers.LlamaConfig(**SMALL_TEXT, vocab_size=len(letters), pad_token_id=0)
    clip = clip_text(length=77)
    return diffusers.HunyuanVideoPipeline(
        tokenizer=letters,
        text_encoder=transformers.LlamaModel(llama).eval(),
        tokenizer_2=clip["tokenizer"],
        text_encoder_2=clip["text_encoder"],
        vae=hunyuan_vae(),
        scheduler=flow_match(shift=7.0),
        transformer=diffusers.HunyuanVideoTransformer3DModel(
            in_channels=4,
            out_channels=4,
            num_attention_heads=2,
            attention_head_dim=10,
            num_layers=1,
            num_single_layers=1,
            num_refiner_layers=1,
            patch_size=1,
            text_embed_dim=16,
            pooled_projection_dim=16,
            rope_axes_dim=(2, 4, 4),
        ),
    )


def qwen_text():
    """The text half of Qwen2.5-VL, with its tokenizer."""
    parts = qwen()
    return {
        "tokenizer": parts["tokenizer"],
        "text_encoder": parts["text_encoder"].model.language_model.eval(),
    }


def hunyuan15_parts(task):
    letters = transformers.ByT5Tokenizer()
    small_t5 = {"d_model": 16, "d_kv": 8, "d_ff": 16, "num_layers": 1, "num_heads": 2}
    byt5 = transformers.T5Config(vocab_size=len(letters), **small_t5)
    return {
        **qwen_text(),
        "tokenizer_2": letters,
        "text_encoder_2": transformers.T5EncoderModel(byt5).eval(),
        "vae": diffusers.AutoencoderKLHunyuanVideo15(
            latent_channels=4,
            block_out_channels=(16, 16),
            layers_per_block=1,
            spatial_compression_ratio=4,
            temporal_compression_ratio=2,
            downsample_match_channel=False,
            upsample_match_channel=False,
        ),
        "scheduler": flow_match(shift=7.0),
        "transformer": diffusers.HunyuanVideo15Transformer3DModel(
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
            task_type=task,
        ),
        "guider": diffusers.ClassifierFreeGuidance(guidance_scale=6.0),
    }


def hunyuan15():
    return diffusers.HunyuanVideo15Pipeline(**hunyuan15_parts("t2v"))


def hunyuan15_image():
    vision = transformers.SiglipVisionConfig(
        hidden_size=12,
        intermediate_size=16,
        num_hidden_layers=1,
        num_attention_heads=2,
        image_size=27 * 2,
        patch_size=2,
    )
    return diffusers.HunyuanVideo15ImageToVideoPipeline(
        **hunyuan15_parts("i2v"),
        image_encoder=transformers.SiglipVisionModel(vision).eval(),
        feature_extractor=transformers.SiglipImageProcessorPil(size={"height": 54, "width": 54}),
    )


def mochi():
    return diffusers.MochiPipeline(
        **t5(None),
        vae=diffusers.AutoencoderKLMochi(
            latent_channels=12,
            encoder_block_out_channels=(32,) * 4,
            decoder_block_out_channels=(32,) * 4,
            layers_per_block=(1,) * 5,
        ),
        scheduler=flow_match(),
        transformer=diffusers.MochiTransformer3DModel(
            num_attention_heads=2,
            attention_head_dim=8,
            num_layers=2,
            pooled_projection_dim=16,
            in_channels=12,
            text_embed_dim=32,
            time_embed_dim=4,
        ),
    )


def allegro():
    return diffusers.AllegroPipeline(
        **t5(None),
        vae=diffusers.AutoencoderKLAllegro(
            down_block_types=("AllegroDownBlock3D",) * 4,
            up_block_types=("AllegroUpBlock3D",) * 4,
            block_out_channels=(4,) * 4,
            latent_channels=4,
            layers_per_block=1,
            norm_num_groups=2,
        ),
        scheduler=diffusers.DDIMScheduler(),
        transformer=diffusers.AllegroTransformer3DModel(
            num_attention_heads=2,
            attention_head_dim=12,
            in_channels=4,
            out_channels=4,
            num_layers=1,
            cross_attention_dim=24,
            sample_width=40,
            sample_height=40,
            sample_frames=6,
            caption_channels=32,
        ),
    )


def latte():
    return diffusers.LattePipeline(
        **t5(None),
        vae=diffusers.AutoencoderKL(
            block_out_channels=(8,) * 4,
            down_block_types=("DownEncoderBlock2D",) * 4,
            up_block_types=("UpDecoderBlock2D",) * 4,
            latent_channels=4,
            norm_num_groups=2,
        ),
        scheduler=diffusers.DDIMScheduler(),
        transformer=diffusers.LatteTransformer3DModel(
            sample_size=8,
            num_layers=1,
            patch_size=2,
            attention_head_dim=8,
            num_attention_heads=3,
            caption_channels=32,
            in_channels=4,
            cross_attention_dim=24,
            out_channels=8,
            attention_bias=True,
            activation_fn="gelu-approximate",
            num_embeds_ada_norm=1000,
            norm_type="ada_norm_single",
            norm_elementwise_affine=False,
            norm_eps=1e-6,
            video_length=5,
        ),
    )


def gemma_tokenizer():
    specials = ["<pad>", "<eos>", "<bos>", "<unk>", "<start_of_turn>", "<end_of_turn>", "▁"]
    letters = specials + [chr(code) for code in range(33, 127)]
    vocabulary = {letter: number for number, letter in enumerate(letters)}
    return transformers.GemmaTokenizer(vocab=vocabulary, merges=[])


def sana():
    tokenizer = gemma_tokenizer()
    gemma = transformers.Gemma2Config(
        head_dim=8,
        hidden_size=16,
        intermediate_size=16,
        num_attention_heads=2,
        num_key_value_heads=2,
        num_hidden_layers=1,
        vocab_size=len(tokenizer),
    )
    return diffusers.SanaVideoPipeline(
        tokenizer=tokenizer,
        text_encoder=transformers.Gemma2Model(gemma).eval(),
        vae=wan_vae(),
        scheduler=diffusers.DPMSolverMultistepScheduler(
            prediction_type="flow_prediction", use_flow_sigmas=True, flow_shift=8.0
        ),
        transformer=diffusers.SanaVideoTransformer3DModel(
            in_channels=16,
            out_channels=16,
            num_attention_heads=2,
            attention_head_dim=12,
            num_layers=2,
            num_cross_attention_heads=2,
            cross_attention_head_dim=12,
            cross_attention_dim=24,
            caption_channels=16,
            sample_size=30,
            rope_max_seq_len=32,
        ),
    )


def easyanimate():
    return diffusers.EasyAnimatePipeline(
        **qwen(),
        vae=diffusers.AutoencoderKLMagvit(
            latent_channels=4,
            block_out_channels=(8,) * 4,
            layers_per_block=1,
            norm_num_groups=2,
            spatial_group_norm=False,
        ),
        scheduler=flow_match(),
        transformer=diffusers.EasyAnimateTransformer3DModel(
            num_attention_heads=2,
            attention_head_dim=16,
            in_channels=4,
            out_channels=4,
            time_embed_dim=2,
            text_embed_dim=16,
            num_layers=1,
            sample_width=4,
            sample_height=4,
            patch_size=2,
        ),
    )


def kandinsky_text():
    clip = clip_text(length=77)
    return {
        **qwen(),
        "tokenizer_2": clip["tokenizer"],
        "text_encoder_2": clip["text_encoder"],
        "vae": hunyuan_vae(),
    }


KANDINSKY = {
    "in_visual_dim": 4,
    "out_visual_dim": 4,
    "in_text_dim": 16,
    "in_text_dim2": 16,
    "time_dim": 16,
    "model_dim": 16,
    "ff_dim": 32,
    "num_text_blocks": 1,
    "num_visual_blocks": 1,
    "axes_dims": (2, 2, 4),
}


def kandinsky5():
    return diffusers.Kandinsky5T2VPipeline(
        **kandinsky_text(),
        scheduler=flow_match(shift=5.0),
        transformer=diffusers.Kandinsky5Transformer3DModel(**KANDINSKY),
    )


def kandinsky6():
    return diffusers.Kandinsky6TI2VAPipeline(
        **kandinsky_text(),
        scheduler=diffusers.PiflowScheduler(),
        transformer=diffusers.Kandinsky6Transformer3DModel(
            **KANDINSKY | {"out_visual_dim": 40, "out_audio_dim": 200}  # a grid of ten
        ),
    )


def cosmos3():
    import cosmos_guardrail

    tokenizer = qwen()["tokenizer"]
    return diffusers.Cosmos3OmniPipeline(
        text_tokenizer=tokenizer,
        vae=wan_vae(),
        scheduler=flow_unipc(),
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


SQUARE = {"width": 64, "height": 64}
FAMILIES = {
    "wan-image": Family(wan_image_to_video, "WanImageToVideoPipeline", takes_image=True),
    "fast-wan": Family(
        fast_wan,
        "WanPipeline",
        {"steps": 3, "guidance": 1.0},
        steps=3,
        named="FastWan2.2-TI2V-5B-FullAttn-Diffusers",
    ),
    "skyreels": Family(skyreels, "SkyReelsV2Pipeline"),
    "skyreels-forcing": Family(
        skyreels_forcing,
        "SkyReelsV2DiffusionForcingPipeline",
        named="SkyReels-V2-DF-1.3B-540P-Diffusers",
    ),
    "skyreels-forcing-image": Family(
        skyreels_forcing,
        "SkyReelsV2DiffusionForcingImageToVideoPipeline",
        takes_image=True,
        named="SkyReels-V2-DF-1.3B-540P-Diffusers",
    ),
    "anyflow": Family(anyflow, "AnyFlowPipeline"),
    "helios": Family(helios, "HeliosPipeline", frames=33),
    "helios-distilled": Family(
        helios_distilled,
        "HeliosPyramidPipeline",
        {**SQUARE, "steps": 3, "guidance": 1.0},
        frames=33,
        size=(64, 64),
        steps=6,  # the first chunk takes twice as many
        named="Helios-Distilled",
    ),
    "motif": Family(motif, "MotifVideoPipeline"),
    "motif-image": Family(
        motif, "MotifVideoImage2VideoPipeline", takes_image=True, named="Motif-Video-2B"
    ),
    "hunyuan": Family(hunyuan, "HunyuanVideoPipeline"),
    "hunyuan15": Family(hunyuan15, "HunyuanVideo15Pipeline"),
    "hunyuan15-image": Family(
        hunyuan15_image,
        "HunyuanVideo15ImageToVideoPipeline",
        {"width": None, "height": None},
        size=(28, 36),
        takes_image=True,
    ),
    "mochi": Family(mochi, "MochiPipeline", {"frames": 7}, frames=7),
    "allegro": Family(
        allegro,
        "AllegroPipeline",
        {"frames": 24, "width": 320, "height": 320},
        frames=24,
        size=(320, 320),
    ),
    "latte": Family(latte, "LattePipeline"),
    "sana": Family(sana, "SanaVideoPipeline", patches=SANA_PATCH),
    "sana-image": Family(
        sana,
        "SanaImageToVideoPipeline",
        takes_image=True,
        patches=SANA_PATCH,
        named="SANA-Video_2B_480p_diffusers",
    ),
    "easyanimate": Family(
        easyanimate, "EasyAnimatePipeline", named="EasyAnimateV5.1-7b-zh-diffusers"
    ),
    "kandinsky5": Family(kandinsky5, "Kandinsky5T2VPipeline"),
    "kandinsky6": Family(kandinsky6, "Kandinsky6TI2VAPipeline", {"guidance": 1.0}),
    "cosmos3": Family(cosmos3, "Cosmos3OmniPipeline"),
    "ltx-image": Family(ltx, "LTXImageToVideoPipeline", takes_image=True, named="LTX-Video"),
    "ltx2": Family(ltx2, "LTX2Pipeline", named="LTX-2"),
    "ltx2-distilled": Family(
        ltx2,
        "LTX2Pipeline",
        {"steps": 8, "guidance": 1.0},
        steps=8,
        named="LTX-2.3-Distilled-Diffusers",
    ),
    "ltx2-keyframes": Family(
        ltx2_keyframes,
        "LTX2DFRPipeline",
        {"steps": None, "guidance": None},
        steps=8,
        named="ltx2.5-dfr",
    ),
    "ltx2-image": Family(ltx2, "LTX2ImageToVideoPipeline", takes_image=True, named="LTX-2"),
}
"""Name of the test → its pipeline. Those of `tiny_pipelines` are run by the other tests."""
