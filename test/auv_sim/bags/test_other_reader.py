"""A reader that is neither ours nor Python's decodes every message: @mcap/core with rosmsg2-serialization."""

from __future__ import annotations

import dataclasses
import json
import math
import shutil
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rosbags.interfaces import Nodetype

from auv_msgs_py.contract import topics
from auv_sim.bags.definitions import typestore
from auv_sim.bags.reading.bag_reader import read_bag
from auv_sim.bags.reading.deserialize import deserializer
from auv_sim.bags.writing.bag_writer import BagWriter

READER = Path(__file__).parents[2] / "node_reader"
TYPES = {topic.name.strip("/"): topic.type for topic in topics.CONTRACT} | {
    "rosout": "rcl_interfaces/msg/Log",
    "parameter_events": "rcl_interfaces/msg/ParameterEvent",
}


@pytest.fixture(scope="module")
def node() -> str:
    """The interpreter, with the packages of the lock file beside the script."""
    found, npm = shutil.which("node"), shutil.which("npm")
    if found is None or npm is None:
        pytest.skip("not run: no node")
    lock, stamp = READER / "package-lock.json", READER / "node_modules" / ".package-lock.json"
    if not stamp.exists() or stamp.stat().st_mtime < lock.stat().st_mtime:
        done = subprocess.run(
            [npm, "ci", "--ignore-scripts", "--no-audit", "--no-fund"],
            cwd=READER,
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, f"npm ci: {done.stderr}"
    return found


def test_the_lock_file_names_no_host() -> None:
    text = (READER / "package-lock.json").read_text()
    assert "://" not in text
    assert '"integrity"' in text


def filled(type_name: str, seed: float) -> Any:
    """A message in which every field has a value of its own, two entries in every sequence."""
    store = typestore()
    values = []
    for k, (_, (kind, detail)) in enumerate(store.fielddefs[type_name][1]):
        value = seed + 0.25 * (k + 1)
        values.append(_value(kind, detail, value))
    return store.types[type_name](*values)


def _value(kind: Any, detail: Any, value: float) -> Any:
    if kind is Nodetype.NAME:
        return filled(detail, value)
    if kind is Nodetype.BASE:
        name = detail[0]
        if name == "string":
            return f"text {value} ψ"
        if name == "bool":
            return True
        return value if name.startswith("float") else int(abs(value)) % 100
    (inner_kind, inner), size = detail
    number = size or 2
    items = [_value(inner_kind, inner, value + 0.5 * k) for k in range(number)]
    if inner_kind is Nodetype.BASE and inner[0] not in ("string",):
        return np.array(items, {"bool": bool, "octet": np.uint8}.get(inner[0], inner[0]))
    return items


def _plain(value: Any) -> Any:
    """As JSON has it; names as in the definition."""
    if dataclasses.is_dataclass(value):
        # Constants are attributes too; only what is on the wire counts.
        names = [name for name, _ in typestore().fielddefs[value.__msgtype__][1]]
        return {name: _plain(getattr(value, name)) for name in names}
    if isinstance(value, np.ndarray):
        return [_plain(item) for item in value.tolist()]
    if isinstance(value, list):
        return [_plain(item) for item in value]
    return value


def _sum(value: Any) -> float:
    if isinstance(value, dict):
        return sum(_sum(item) for item in value.values())
    if isinstance(value, list):
        return sum(_sum(item) for item in value)
    return float(value) if isinstance(value, float | int) and not isinstance(value, bool) else 0.0


@pytest.mark.parametrize("compression", ["zstd", "none"])
def test_it_decodes_every_message_of_every_topic(tmp_path: Path, node: str, compression: str) -> None:
    store = typestore()
    with BagWriter(tmp_path / "bag", compression, max_duration_ns=2 * 10**9) as writer:  # type: ignore[arg-type]
        for n, (name, type_name) in enumerate(TYPES.items()):
            channel = writer.add_topic(f"/auv/{name}", type_name, [])
            for k in range(20 + n):
                data = bytes(store.serialize_cdr(filled(type_name, k + 0.125 * n), type_name))
                writer.write(channel, 10**9 + k * 10**8, 10**9 + k * 10**8, data, k + 1)
            writer.flush()
    files = sorted(str(file) for file in (tmp_path / "bag").glob("*.mcap"))
    assert len(files) > 1
    command = [node, str(READER / "read_bag.mjs"), *files]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    bag = read_bag(tmp_path / "bag")
    assert set(found) == set(bag.topics) == {f"/auv/{name}" for name in TYPES}
    for n, (name, topic) in enumerate(bag.topics.items()):
        decode = deserializer(topic)
        messages = [_plain(decode(data)) for data in topic.messages if data is not None]
        assert found[name]["type"] == topic.type
        assert found[name]["count"] == len(messages) == 20 + n
        assert math.isclose(found[name]["sum"], sum(map(_sum, messages)), rel_tol=1e-9)
        assert found[name]["last"] == messages[-1]
