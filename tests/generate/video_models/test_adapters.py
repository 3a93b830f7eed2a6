"""What `--lora` says, and where the files are: on this machine, and in the cache of the hub."""

import dataclasses
import os

import pytest

from texvent.errors import ConfigError, FileFormatError, InputError, TexventError
from texvent.generate.video_config import DiffusersConfig
from texvent.generate.video_models.adapters import (
    Adapter,
    digest_adapter,
    files_of,
    find_adapter,
    find_local,
    parse_adapter,
)
from texvent.options.values import with_options

EMPTY = (2).to_bytes(8, "little") + b"{}"
"""A whole safetensors file without tensors."""


@pytest.mark.parametrize(
    ("text", "source", "weight", "noise"),
    [
        ("fast.safetensors", "fast.safetensors", 1.0, None),
        ("./a b/fast.safetensors:0.8", "./a b/fast.safetensors", 0.8, None),
        ("fast.safetensors:-1e-1", "fast.safetensors", -0.1, None),
        ("fast.safetensors:0:low", "fast.safetensors", 0.0, "low"),
        ("folder:high", "folder", 1.0, "high"),
        ("fast.safetensors:high:0.5", "fast.safetensors", 0.5, "high"),
        ("fast.safetensors:HIGH", "fast.safetensors", 1.0, "high"),
        ("hub:org/name", "hub:org/name", 1.0, None),
        ("hub:org/name@v1.0/a/b.safetensors:2", "hub:org/name@v1.0/a/b.safetensors", 2.0, None),
        ("C:model.safetensors", "C:model.safetensors", 1.0, None),
    ],
)
def test_source_weight_and_transformer_are_told_apart(text, source, weight, noise):
    assert parse_adapter(text) == Adapter(source, weight, noise)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "write FILE or FILE:WEIGHT"),
        (":0.5", "write FILE or FILE:WEIGHT"),
        ("a.safetensors:nan", "write FILE or FILE:WEIGHT"),
        ("a.safetensors:1.2.3", "write FILE or FILE:WEIGHT"),
        ("a.safetensors:inf", "write FILE or FILE:WEIGHT"),
        ("hub:name", "names no repository"),
        ("hub:org/na--me", "names no repository"),
        ("hub:org/name/a.safetensors:fast", "names no repository or file"),
        ("old.pt:0.5", "is a pickle"),
        ("hub:org/name/old.bin", "is a pickle"),
    ],
)
def test_other_forms_are_refused_as_an_option(text, message):
    with pytest.raises(ConfigError, match=message):
        DiffusersConfig(lora=(text,))


@pytest.mark.parametrize(
    ("source", "noise"),
    [
        ("hub:org/name/sub/high_noise_model.safetensors", "high"),
        ("wan-Low-Noise.safetensors", "low"),
        ("Wan2.2-Lightning_T2V-A14B-4steps-lora_HIGH_fp16.safetensors", "high"),
        ("a_LOW.safetensors", "low"),
        ("HIGH/style.safetensors", None),
        ("low_light.safetensors", None),
        ("SLOW.safetensors", None),
    ],
)
def test_names_say_which_transformer_a_file_is_for(source, noise):
    assert Adapter(source).noise_or_name == noise
    assert Adapter(source, noise="low").noise_or_name == "low"


def test_a_file_of_options_may_name_one_or_several():
    config = DiffusersConfig()
    assert with_options(config, {"lora": "a.safetensors"}, where="here").lora == ("a.safetensors",)
    several = with_options(config, {"lora": ["a.safetensors", "b.safetensors:2"]}, where="here")
    assert [one.weight for one in several.adapters] == [1.0, 2.0]
    assert dataclasses.replace(several).lora == several.lora
    with pytest.raises(ConfigError, match="here: lora is 3; it must be text"):
        with_options(config, {"lora": [3]}, where="here")


def test_files_and_folders_on_this_machine(tmp_path):
    path = tmp_path / "a.safetensors"
    path.write_bytes(EMPTY)
    assert find_local(Adapter(str(path))) == path
    assert find_local(Adapter(str(tmp_path))) == path
    (tmp_path / "b.safetensors").write_bytes(EMPTY)
    with pytest.raises(InputError, match=r"does not say which adapter: a\.safetensors, b\."):
        find_local(Adapter(str(tmp_path)))
    saved = tmp_path / "pytorch_lora_weights.safetensors"
    saved.write_bytes(EMPTY)
    assert find_local(Adapter(str(tmp_path))) == saved
    assert find_local(Adapter("hub:org/name")) is None
    (tmp_path / "note.txt").write_text("no adapter")
    for source, message in (
        ("none", "there is no adapter"),
        ("note.txt", "from .safetensors only"),
    ):
        with pytest.raises(InputError, match=message):
            find_local(Adapter(str(tmp_path / source)))
    path.write_bytes(EMPTY + b"more")
    with pytest.raises(FileFormatError, match="is damaged"):
        find_local(Adapter(str(path)))


@pytest.mark.torch
def test_a_repository_of_the_cache_is_used_and_another_is_told(tmp_path, monkeypatch):
    """The layout of the hub's cache: a folder per commit, and what the branches point at."""
    os.environ["HF_HUB_OFFLINE"] = "1"
    pytest.importorskip("huggingface_hub")
    from huggingface_hub import constants

    monkeypatch.setattr(constants, "HF_HUB_CACHE", str(tmp_path))
    commit = "0" * 40
    repository = tmp_path / "models--org--name"
    (repository / "refs").mkdir(parents=True)
    (repository / "refs" / "main").write_text(commit)
    snapshot = repository / "snapshots" / commit
    (snapshot / "sub").mkdir(parents=True)
    path = snapshot / "sub" / "fast.safetensors"
    path.write_bytes(EMPTY)
    lines = []
    source = "hub:org/name/sub/fast.safetensors"
    found = find_adapter(Adapter(source, 0.5), lines.append)
    assert found.path == path
    assert found.facts == {"source": source, "sha256": found.sha256, "weight": 0.5}
    with pytest.raises(TexventError, match=r"org/name is not on this machine"):
        find_adapter(Adapter("hub:org/name"), lines.append)  # the repository may hold others
    saved = snapshot / "pytorch_lora_weights.safetensors"
    saved.write_bytes(EMPTY)
    assert find_adapter(Adapter("hub:org/name"), lines.append).path == saved
    assert lines == []
    with pytest.raises(TexventError, match=r"org/other/a\.safetensors is not on this machine"):
        find_adapter(Adapter("hub:org/other/a.safetensors"), lines.append)
    assert lines[0].startswith("fetching the adapter hub:org/other/a.safetensors")
    with pytest.raises(TexventError, match=r"org/third is not on this machine"):
        find_adapter(Adapter("hub:org/third"), lines.append)


@pytest.fixture
def hub(tmp_path, monkeypatch):
    """The hub's cache in an empty folder, and a repository that the hub would list."""
    hub = pytest.importorskip("huggingface_hub")
    from huggingface_hub import constants

    monkeypatch.setattr(constants, "HF_HUB_CACHE", str(tmp_path))
    snapshot = tmp_path / "models--org--name" / "snapshots" / ("1" * 40)
    listed, fetched = [], []

    def fetch(repo, file, revision=None):
        assert repo == "org/name"
        fetched.append((file, revision))
        path = snapshot / file
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(EMPTY)
        return str(path)

    monkeypatch.setattr(hub, "hf_hub_download", fetch)
    monkeypatch.setattr(hub.HfApi, "list_repo_files", lambda self, repo, revision: listed)
    return snapshot, listed, fetched


@pytest.mark.torch
def test_the_scale_that_peft_saved_is_fetched_from_the_same_folder_and_commit(hub):
    snapshot, _, fetched = hub
    found = find_adapter(Adapter("hub:org/name/sub/adapter_model.safetensors"), lambda line: None)
    config = "sub/adapter_config.json"
    assert fetched == [("sub/adapter_model.safetensors", None), (config, "1" * 40)]
    assert found.path == snapshot / "sub" / "adapter_model.safetensors"


@pytest.mark.torch
def test_a_partial_copy_does_not_decide_what_a_repository_means(hub):
    snapshot, listed, _ = hub
    (snapshot / "old.safetensors").parent.mkdir(parents=True)
    (snapshot / "old.safetensors").write_bytes(EMPTY)
    refs = snapshot.parents[1] / "refs"
    refs.mkdir()
    (refs / "main").write_text(snapshot.name)
    listed += ["new.safetensors", "old.safetensors", "note.txt"]
    with pytest.raises(
        InputError, match=r"which adapter: new\.safetensors, old\.safetensors; name"
    ):
        find_adapter(Adapter("hub:org/name"), lambda line: None)


@pytest.mark.torch
def test_no_network_is_one_line(hub, monkeypatch):
    import huggingface_hub
    from huggingface_hub import errors

    def fail(self, repo, revision):
        raise errors.HTTPError("no route to host")

    monkeypatch.setattr(huggingface_hub.HfApi, "list_repo_files", fail)
    with pytest.raises(TexventError, match=r"org/name is not on this machine .*no route to host"):
        find_adapter(Adapter("hub:org/name"), lambda line: None)


def test_the_digest_covers_the_scale_that_peft_saved(tmp_path):
    path, config = tmp_path / "adapter_model.safetensors", tmp_path / "adapter_config.json"
    path.write_bytes(EMPTY)
    digests = [digest_adapter(path)]
    for text in ('{"lora_alpha": 2}', '{"lora_alpha": 32}'):
        config.write_text(text)
        assert files_of(path) == [path, config]
        digests.append(digest_adapter(path))
    assert len(set(digests)) == 3
