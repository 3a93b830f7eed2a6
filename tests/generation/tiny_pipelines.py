"""Pipelines of the real classes with tiny random weights, saved as the real ones are.

They make noise of 5 frames of 32x32 pixels in two steps, in about a second on a CPU, and go
through the same files, classes and calls as models of 100 GB.
"""

import contextlib
from pathlib import Path
from types import SimpleNamespace

import diffusers
import numpy as np
import torch
import transformers
from tokenizers.pre_tokenizers import ByteLevel

TEXT = {"d_model": 32, "d_kv": 8, "d_ff": 37, "num_layers": 2, "num_heads": 4}
SMALL = {
    "hidden_size": 16,
    "intermediate_size": 16,
    "num_hidden_layers": 2,
    "num_attention_heads": 2,
}


@contextlib.contextmanager
def random_weights(seed=0):
    with torch.random.fork_rng():
        torch.manual_seed(seed)
        yield


def replace_torchvision():
    """Two functions that diffusers' Cosmos pipelines use, where torchvision is not installed.

    The torchvision of the package index does not fit a CPU build of torch. Users of Cosmos have
    it: cosmos-guardrail requires it.
    """
    from diffusers.models.controlnets import controlnet_cosmos
    from diffusers.models.transformers import transformer_cosmos
    from diffusers.pipelines.cosmos import pipeline_cosmos2_5_predict

    def resize(image, size, interpolation):
        return torch.nn.functional.interpolate(image, size=size, mode=interpolation)

    def to_tensor(image):
        levels = np.asarray(image, dtype=np.float32).transpose(2, 0, 1) / 255.0
        return torch.from_numpy(np.ascontiguousarray(levels))

    functions = SimpleNamespace(resize=resize, to_tensor=to_tensor)
    modes = SimpleNamespace(NEAREST="nearest")
    transforms = SimpleNamespace(functional=functions, InterpolationMode=modes)
    for module in (transformer_cosmos, controlnet_cosmos):
        if not hasattr(module, "transforms"):
            module.transforms = transforms
    if not hasattr(pipeline_cosmos2_5_predict, "torchvision"):
        pipeline_cosmos2_5_predict.torchvision = SimpleNamespace(transforms=transforms)


def t5(encoder=transformers.T5EncoderModel, config=transformers.T5Config):
    letters = [("<pad>", 0.0), ("</s>", 0.0), ("<unk>", 0.0), ("▁", -2.0)]
    vocabulary = letters + [(chr(code), -3.0) for code in range(33, 127)]
    tokenizer = transformers.T5TokenizerFast(vocab=vocabulary, extra_ids=0)
    text_encoder = encoder(config(vocab_size=len(vocabulary), **TEXT)).eval()
    return {"tokenizer": tokenizer, "text_encoder": text_encoder}


def wan_vae():
    return diffusers.AutoencoderKLWan(base_dim=3, z_dim=16, dim_mult=[1, 1, 1, 1], num_res_blocks=1)


def wan_transformer(kind=diffusers.WanTransformer3DModel, **facts):
    return kind(
        num_attention_heads=2,
        attention_head_dim=12,
        num_layers=2,
        text_dim=32,
        freq_dim=16,
        ffn_dim=32,
        patch_size=(1, 2, 2),
        **facts,
    )


def flow_unipc(**facts):
    return diffusers.UniPCMultistepScheduler(
        prediction_type="flow_prediction", use_flow_sigmas=True, **facts
    )


def wan():
    return diffusers.WanPipeline(
        **t5(transformers.UMT5EncoderModel, transformers.UMT5Config),
        vae=wan_vae(),
        scheduler=diffusers.FlowMatchEulerDiscreteScheduler(shift=7.0),
        transformer=wan_transformer(),
    )


def wan22():
    """A second network takes over below a share of the noise, as in Wan 2.2's 14B."""
    return diffusers.WanPipeline(
        **t5(transformers.UMT5EncoderModel, transformers.UMT5Config),
        vae=wan_vae(),
        scheduler=flow_unipc(flow_shift=3.0),
        transformer=wan_transformer(),
        transformer_2=wan_transformer(),
        boundary_ratio=0.875,
    )


COGVIDEOX = {"in_channels": 4, "sample_width": 8, "sample_height": 8, "sample_frames": 9}


def cogvideox(kind=diffusers.CogVideoXPipeline, **of_transformer):
    return kind(
        **t5(),
        vae=diffusers.AutoencoderKLCogVideoX(
            block_out_channels=(8, 8, 8, 8),
            latent_channels=4,
            layers_per_block=1,
            norm_num_groups=2,
            temporal_compression_ratio=4,
        ),
        scheduler=diffusers.CogVideoXDDIMScheduler(),
        transformer=diffusers.CogVideoXTransformer3DModel(
            num_attention_heads=8,
            attention_head_dim=4,
            out_channels=4,
            time_embed_dim=2,
            text_embed_dim=32,
            num_layers=1,
            patch_size=2,
            temporal_compression_ratio=4,
            max_text_seq_length=226,
            **(of_transformer or COGVIDEOX),
        ),
    )


def cosmos_transformer(**facts):
    replace_torchvision()
    return diffusers.CosmosTransformer3DModel(
        num_attention_heads=2,
        attention_head_dim=16,
        num_layers=2,
        mlp_ratio=2,
        adaln_lora_dim=4,
        patch_size=(1, 2, 2),
        rope_scale=(2.0, 1.0, 1.0),
        concat_padding_mask=True,
        **{"max_size": (4, 32, 32), **facts},
    )


def cosmos():
    import cosmos_guardrail

    return diffusers.CosmosTextToWorldPipeline(
        **t5(),
        vae=diffusers.AutoencoderKLCosmos(
            encoder_block_out_channels=(8, 8, 8, 8),
            decode_block_out_channels=(8, 8, 8, 8),
            attention_resolutions=(8,),
            resolution=64,
            latent_channels=4,
            num_layers=2,
            patch_size=4,
            patch_type="haar",
            spatial_compression_ratio=4,
            temporal_compression_ratio=4,
        ),
        scheduler=diffusers.EDMEulerScheduler(
            sigma_min=0.002,
            sigma_max=80,
            sigma_data=0.5,
            sigma_schedule="karras",
            num_train_timesteps=1000,
            prediction_type="epsilon",
            rho=7.0,
            final_sigmas_type="sigma_min",
        ),
        transformer=cosmos_transformer(
            in_channels=4, out_channels=4, text_embed_dim=32, extra_pos_embed_type="learnable"
        ),
        safety_checker=cosmos_guardrail.CosmosSafetyChecker(),
    )


def qwen():
    specials = ["<|endoftext|>", "<|im_start|>", "<|im_end|>"]
    letters = sorted(ByteLevel.alphabet()) + specials
    tokenizer = transformers.Qwen2Tokenizer(
        vocab={letter: index for index, letter in enumerate(letters)}, merges=[]
    )
    tokenizer.pad_token = "<|endoftext|>"
    tokenizer.chat_template = (
        "{% for m in messages %}<|im_start|>{{ m['role'] }}: "
        "{% if m['content'] is string %}{{ m['content'] }}"
        "{% else %}{% for c in m['content'] %}{{ c['text'] }}{% endfor %}{% endif %}"
        "<|im_end|>{% endfor %}"
    )
    config = transformers.Qwen2_5_VLConfig(
        text_config={
            **SMALL,
            "num_key_value_heads": 2,
            "vocab_size": len(letters),
            "rope_scaling": {"type": "mrope", "mrope_section": [1, 1, 2], "rope_type": "default"},
            "rope_theta": 1_000_000.0,
        },
        vision_config={
            "depth": 2,
            "hidden_size": 16,
            "intermediate_size": 16,
            "num_heads": 2,
            "out_hidden_size": 16,
        },
    )
    encoder = transformers.Qwen2_5_VLForConditionalGeneration(config).eval()
    return {"tokenizer": tokenizer, "text_encoder": encoder}


def cosmos25():
    import cosmos_guardrail

    return diffusers.Cosmos2_5_PredictBasePipeline(
        **qwen(),
        vae=wan_vae(),
        scheduler=flow_unipc(use_karras_sigmas=True),
        transformer=cosmos_transformer(
            in_channels=17,
            out_channels=16,
            text_embed_dim=32,
            extra_pos_embed_type=None,
            use_crossattn_projection=True,
            crossattn_proj_in_channels=32,
            encoder_hidden_states_channels=32,
        ),
        safety_checker=cosmos_guardrail.CosmosSafetyChecker(),
    )


def ltx():
    return diffusers.LTXPipeline(
        **t5(),
        vae=diffusers.AutoencoderKLLTXVideo(
            latent_channels=8,
            block_out_channels=(8, 8, 8, 8),
            decoder_block_out_channels=(8, 8, 8, 8),
            layers_per_block=(1, 1, 1, 1, 1),
            decoder_layers_per_block=(1, 1, 1, 1, 1),
            spatio_temporal_scaling=(True, True, False, False),
            decoder_spatio_temporal_scaling=(True, True, False, False),
            patch_size=1,
            patch_size_t=1,
            decoder_causal=False,
        ),
        scheduler=diffusers.FlowMatchEulerDiscreteScheduler(),
        transformer=diffusers.LTXVideoTransformer3DModel(
            in_channels=8,
            out_channels=8,
            num_attention_heads=4,
            attention_head_dim=8,
            cross_attention_dim=32,
            num_layers=1,
            caption_channels=32,
        ),
    )


def save_clip(folder: Path) -> Path:
    """Save a tiny random CLIP model with its tokenizer and return the folder."""
    tokenizer = t5()["tokenizer"]
    config = transformers.CLIPConfig(
        text_config={
            **SMALL,
            "vocab_size": len(tokenizer),
            "max_position_embeddings": 40,
            "eos_token_id": tokenizer.eos_token_id,
            "bos_token_id": None,
            "pad_token_id": tokenizer.pad_token_id,
        },
        vision_config={**SMALL, "image_size": 32, "patch_size": 8},
        projection_dim=16,
    )
    with random_weights():
        transformers.CLIPModel(config).save_pretrained(folder)
    tokenizer.save_pretrained(folder)
    return folder


CHAT = (
    "{% for m in messages %}USER: {% for c in m['content'] %}"
    "{% if c['type'] == 'image' %}<image>\n{% else %}{{ c['text'] }}{% endif %}"
    "{% endfor %}{% endfor %} ASSISTANT:"
)


def save_llava(folder: Path) -> Path:
    """Save a tiny random LLaVA model with its processor and return the folder."""
    tokenizer = t5()["tokenizer"]
    tokenizer.add_special_tokens({"additional_special_tokens": ["<image>"]})
    small = {**SMALL, "initializer_range": 0.5}  # large enough for the image to change the words
    words = {"vocab_size": len(tokenizer), "pad_token_id": 0, "eos_token_id": 1}
    config = transformers.LlavaConfig(
        text_config=transformers.LlamaConfig(**small, **words, bos_token_id=None),
        vision_config=transformers.CLIPVisionConfig(**small, image_size=16, patch_size=8),
        initializer_range=0.5,
        image_token_index=tokenizer.convert_tokens_to_ids("<image>"),
    )
    size = {"height": 16, "width": 16}
    processor = transformers.LlavaProcessor(
        image_processor=transformers.CLIPImageProcessorPil(size=size, crop_size=size),
        tokenizer=tokenizer,
        patch_size=8,
        vision_feature_select_strategy="default",
        num_additional_image_tokens=1,
        image_token="<image>",
        chat_template=CHAT,
    )
    with random_weights():
        transformers.LlavaForConditionalGeneration(config).save_pretrained(folder)
    processor.save_pretrained(folder)
    return folder
