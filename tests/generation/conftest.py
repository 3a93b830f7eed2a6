"""What the tests of learned generators share; diffusers is imported only by those that need it."""

import os

import pytest

os.environ["HF_HUB_OFFLINE"] = "1"


@pytest.fixture(scope="session")
def models(tmp_path_factory):
    """Folder of a tiny pipeline by its name, saved once."""
    from .tiny_families import save

    folder = tmp_path_factory.mktemp("models")
    saved = {}

    def find(name):
        if name not in saved:
            saved[name] = save(name, folder)
        return saved[name]

    return find


@pytest.fixture
def model_cache(tmp_path, monkeypatch):
    """An empty cache folder, and no pipeline in memory."""
    import torch

    from texvent.generation.diffusers_models.pipeline_loading import forget_pipeline

    torch.set_num_threads(1)  # tiny arrays: more threads only wait for each other

    monkeypatch.setenv("TEXVENT_CACHE", str(tmp_path / "cache"))
    forget_pipeline()
    return tmp_path / "cache"
