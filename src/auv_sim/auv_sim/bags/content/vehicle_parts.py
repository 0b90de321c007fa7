"""The vehicles in a recording of several, or in a fleet's run directory, each as a recording of its own."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.bags import line_owner
from auv_sim.bags.reading.bag_reader import everything, read_bag
from auv_sim.bags.reading.recording import Bag, RecordedTopic, TopicFilter
from auv_sim.bags.texts import label_of, texts_below

#: The file by which a run directory is a fleet's.
FLEET = Path("config") / "fleet.yaml"


def read_vehicles(
    path: Path, keeps: TopicFilter = everything, odometry: str | None = None, namespace: str | None = None
) -> dict[str, Bag]:
    """Read a recording, or those of a fleet's run directory.

    Args:
        path: as of `read_bag`, or the run directory of a fleet.
        keeps: which topics' messages to keep.
        odometry: full name of the vehicle's odometry topic.
        namespace: of one vehicle; all by default.

    Returns:
        Vehicle -> its recording. A recording of one vehicle, or of none, is there under an empty name and
        as it is.

    Raises:
        ConfigurationError: nothing can be read, or no vehicle has this namespace.
    """
    folders = fleet_folders(path)
    if folders:
        return _chosen({name: read_bag(folder, keeps, odometry) for name, folder in folders.items()},
                       path, namespace)  # fmt: skip
    bag = read_bag(path, keeps, odometry)
    if len(bag.vehicles) < 2:
        return {"": bag}
    if namespace is None and odometry is not None:
        chosen = "/" + odometry.strip("/")
        namespace = next((name for name in bag.vehicles if line_owner.is_within(chosen, name)), None)
    return _chosen({label_of(name): part_of(bag, name) for name in bag.vehicles}, path, namespace)


def fleet_folders(path: Path) -> dict[str, Path]:
    """Return the vehicles' run directories of a fleet where each has its own bag; empty for any other."""
    if not (path / FLEET).is_file() or (path / "bag").exists():
        return {}
    return {folder.name: folder for folder in sorted(path.iterdir()) if (folder / "bag").is_dir()}


def part_of(bag: Bag, namespace: str) -> Bag:
    """Return one vehicle's part of a recording: its topics, and its lines of the shared ones.

    Topics that are of no vehicle stay, as do the lines of nodes that are of none.
    """
    others = [name for name in bag.vehicles if name != namespace]
    part = Bag(
        bag.path, dict(bag.files), notes=list(bag.notes), size=bag.size, records=bag.records,
        profile=bag.profile, odometry=bag.odometry, vehicle=namespace, texts=_texts(bag, namespace),
    )  # fmt: skip
    rows: dict[str, dict[int, int]] = {}
    for name, topic in bag.topics.items():
        if any(line_owner.is_within(name, other) for other in others):
            continue
        kept = _kept(topic, others)
        rows[name] = {row: k for k, row in enumerate(kept)}
        part.topics[name] = topic if len(kept) == topic.count else _subset(topic, kept)
    part.order = [
        (part.topics[topic.name], rows[topic.name][row])
        for topic, row in bag.order
        if topic.name in rows and row in rows[topic.name]
    ]
    return part


def _chosen(found: dict[str, Bag], path: Path, namespace: str | None) -> dict[str, Bag]:
    """Return one vehicle, or all."""
    if namespace is None:
        return found
    if label_of(namespace) not in found:
        expected = f"one of {', '.join(found)}"
        raise ConfigurationError(f"{path}: --namespace", repr(namespace), expected)
    return {label_of(namespace): found[label_of(namespace)]}


def _kept(topic: RecordedTopic, others: list[str]) -> list[int]:
    """Return the rows that are not of other vehicles."""
    keeps = line_owner.without(topic.name, others)
    if keeps is None:
        return list(range(topic.count))
    return [row for row, data in enumerate(topic.messages) if data is None or keeps(data)]


def _subset(topic: RecordedTopic, rows: list[int]) -> RecordedTopic:
    def of(column: list[Any]) -> list[Any]:
        return [column[row] for row in rows]

    return dataclasses.replace(
        topic, log_ns=of(topic.log_ns), publish_ns=of(topic.publish_ns), sequence=of(topic.sequence),
        sizes=of(topic.sizes), messages=of(topic.messages),
    )  # fmt: skip


def _texts(bag: Bag, namespace: str) -> dict[str, str]:
    """Return the configuration of one vehicle: from the bag, else from beside it, else the bag's own."""
    label = label_of(namespace)
    own = {
        name.removeprefix(f"{label}/"): text
        for name, text in bag.texts.items()
        if name.startswith(f"{label}/")
    }
    root = bag.path if bag.path.is_dir() else bag.path.parent
    return own or texts_below(root.parent / label / "config") or bag.texts
