"""Costs of a learned model before it is there: from its row, and from the model hub."""

import json
import os
import subprocess
import sys
import threading
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import pytest

from texvent.cli.app import main
from texvent.generation.video_models.known_models import MODELS

RUN = "import sys; from texvent.cli.app import main; sys.exit(main(sys.argv[1:]))"
COMMAND = ["generate", "a red car drives left", "--dry-run"]


@pytest.mark.parametrize(
    "name", ["wan-1.3b", "minimax-h3-turbo", "ltx2.5-temporal", "wan-vace-14b"]
)
def test_without_the_packages_a_dry_run_says_what_the_row_says(name, monkeypatch, capsys):
    for module in ("torch", "diffusers", "huggingface_hub"):
        monkeypatch.setitem(sys.modules, module, None)
    small = ["--width", "64", "--height", "48", "--frames", "5"] if "vace" in name else []
    assert main([*COMMAND, "--generator", name, *small]) == 0
    said, row = capsys.readouterr().out, MODELS[name]
    for fact in (
        row.licence_and_terms,
        row.memory,
        row.cost,
        f"{5 if small else row.frames} frames",
    ):
        assert fact in said
    assert "their sizes and a GPU are not known without diffusers (" in said
    assert "texvent[generate]" in said
    assert said.count("\n") == 1


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (["--generator", "./nothere", "--fps", "10"], "there is no model folder nothere"),
        (["--generator", "wan-vace-1.3b", "--frames", "82"], "--frames is 82; wan-vace-1.3b"),
        (["--generator", "minimax-h3", "--frames", "8"], "--frames is 8; minimax-h3 makes 120"),
        (
            ["--generator", "ltx2.5-temporal", "--frames", "240"],
            "takes multiples of 16 and one more, such as 241",
        ),
        (["--generator", "ltx2.5-temporal", "--steps", "8"], "--steps is set, but LTX2DFR"),
    ],
)
def test_without_the_packages_a_dry_run_refuses_what_the_row_refuses(
    options, told, monkeypatch, capsys
):
    for module in ("torch", "diffusers", "huggingface_hub"):
        monkeypatch.setitem(sys.modules, module, None)
    assert main([*COMMAND, *options]) != 0
    said = capsys.readouterr().err
    assert told in said
    assert "Traceback" not in said


FILES = {
    "Lightricks/LTX-2.5-Diffusers": {
        "transformer/diffusion_pytorch_model-00001-of-00002.safetensors": 40_000_000_000,
        "transformer/diffusion_pytorch_model-00002-of-00002.safetensors": 4_000_000_000,
        "transformer/diffusion_pytorch_model.fp16.safetensors": 1,
        "transformer/diffusion_pytorch_model.bin": 1,
        "transformer_full/diffusion_pytorch_model.safetensors": 44_000_000_000,
        "vae/diffusion_pytorch_model.safetensors": 2_000_000_000,
        "whole.safetensors": 1,
    },
    "Lightricks/LTX-2.5": {
        MODELS["ltx2.5-temporal"].upscalers[0].split("/", 2)[2]: 900_000_000,
        MODELS["ltx2.5-temporal"].upscalers[1].split("/", 2)[2]: 300_000_000,
    },
    "Wan-AI/Wan2.1-T2V-14B-Diffusers": {
        "transformer/diffusion_pytorch_model.safetensors": 28_000_000_000,
        "image_encoder/model.safetensors": 1,
    },
    "lightx2v/Wan2.1-Distill-Loras": {
        MODELS["wan-14b-distilled"].loras[0].split("/", 2)[2]: 641_000_000,
    },
}
"""Repository → its files, bytes."""
INDEX = {"_class_name": "WanPipeline", "transformer": ["diffusers", "WanTransformer3DModel"],
         "image_encoder": [None, None]}  # fmt: skip


class Hub(BaseHTTPRequestHandler):
    """A model hub that tells sizes and gives an index, and nothing else."""

    def do_HEAD(self):
        self.do_GET()

    def do_GET(self):
        path = self.path.partition("?")[0]
        repo = next((one for one in FILES if f"/{one}/" in f"{path}/"), None)
        if repo is None or not (path.startswith("/api/models/") or path.endswith("index.json")):
            self.send_error(404)
            return
        content = INDEX
        if path.startswith("/api/"):
            siblings = [{"rfilename": name, "size": size} for name, size in FILES[repo].items()]
            content = {"id": repo, "sha": "0" * 40, "siblings": siblings}
        body = json.dumps(content).encode()
        self.send_response(200)
        for name, value in {"ETag": '"1"', "X-Repo-Commit": "0" * 40}.items():
            self.send_header(name, value)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        if self.command == "GET":
            self.wfile.write(body)

    def log_message(self, *_):
        """Say nothing."""


@pytest.mark.torch
@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("ltx2.5-temporal", "download 47.2 GB with its upscalers ("),
        ("wan-14b-distilled", "download 28 GB, and of its LoRA 0.641 GB ("),
        ("wan-1.3b", "download not known, time about 4 min on RTX 4090"),
    ],
)
def test_a_dry_run_asks_the_model_hub_for_sizes_and_goes_on_without(name, told, tmp_path):
    pytest.importorskip("diffusers")
    server = ThreadingHTTPServer(("127.0.0.1", 0), Hub)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        own = {"HF_ENDPOINT": f"http://127.0.0.1:{server.server_port}", "HF_HUB_OFFLINE": "0",
               "HF_HOME": str(tmp_path), "TEXVENT_CACHE": str(tmp_path / "cache")}  # fmt: skip
        done = subprocess.run(
            [sys.executable, "-c", RUN, *COMMAND, "--generator", name],
            env=os.environ | own, capture_output=True, text=True, check=False,
        )  # fmt: skip
    finally:
        server.shutdown()
        server.server_close()
    assert done.returncode == 0, done.stderr
    assert "it has to be fetched first" in done.stdout
    assert told in done.stdout
    assert not list(tmp_path.rglob("*.safetensors"))
