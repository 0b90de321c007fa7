"""Finding a file by its path or by the name of a shipped one."""

from __future__ import annotations

import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import config_files


@pytest.mark.parametrize("name", ["remus100", "remus100.yaml"])
def test_shipped_file_is_found_with_and_without_suffix(name):
    path = config_files.find("vehicles", name)
    assert path.name == "remus100.yaml"
    assert path.is_file()


def test_existing_path_wins_over_a_shipped_name(tmp_path, monkeypatch):
    (tmp_path / "remus100.yaml").write_text("mine", encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    assert config_files.find("vehicles", "remus100.yaml").read_text(encoding="utf-8") == "mine"


def test_folder_does_not_hide_a_shipped_name(tmp_path, monkeypatch):
    (tmp_path / "remus100").mkdir()
    monkeypatch.chdir(tmp_path)
    assert config_files.find("vehicles", "remus100").is_file()


def test_home_is_understood(tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    (tmp_path / "own.yaml").write_text("mine", encoding="utf-8")
    assert config_files.find("missions", "~/own.yaml") == tmp_path / "own.yaml"


@pytest.mark.parametrize("kind", ["missions", "vehicles"])
@pytest.mark.parametrize("name", ["nowhere", "nowhere.yaml", "", ".", "../missions/paper_composite"])
def test_anything_else_is_refused_with_the_shipped_names(tmp_path, monkeypatch, kind, name):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ConfigurationError) as caught:
        config_files.find(kind, name)
    message = str(caught.value)
    assert message.startswith(name or "''")
    assert "\n" not in message
    assert all(shipped in message for shipped in config_files.shipped(kind))


def test_kinds_are_kept_apart():
    with pytest.raises(ConfigurationError, match="no such mission file"):
        config_files.find("missions", "remus100")
