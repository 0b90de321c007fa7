"""Which topic is the vehicle's odometry, where the recording was not made with the contract's names."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from auv_sim.bags.definitions import typestore
from auv_sim.bags.reading.load import load
from auv_sim.bags.writing.bag_writer import BagWriter
from auv_sim.cli import bag as bag_command

ODOMETRY, FLOAT = "nav_msgs/msg/Odometry", "std_msgs/msg/Float64"


def odometry(k: int, speed: float) -> bytes:
    """Going east at `speed` m a row."""
    kinds = typestore().types
    zero = kinds["geometry_msgs/msg/Vector3"](0.0, 0.0, 0.0)
    pose = kinds["geometry_msgs/msg/Pose"](
        kinds["geometry_msgs/msg/Point"](k * speed, 0.0, 0.0),
        kinds["geometry_msgs/msg/Quaternion"](0.0, 0.0, 0.0, 1.0),
    )
    message = kinds[ODOMETRY](
        kinds["std_msgs/msg/Header"](kinds["builtin_interfaces/msg/Time"](1 + k, 0), "map"),
        "base_link",
        kinds["geometry_msgs/msg/PoseWithCovariance"](pose, np.zeros(36)),
        kinds["geometry_msgs/msg/TwistWithCovariance"](
            kinds["geometry_msgs/msg/Twist"](zero, zero), np.zeros(36)
        ),
    )
    return bytes(typestore().serialize_cdr(message, ODOMETRY))


def record(directory: Path, **speeds: float) -> Path:
    """Topics by their name with `_` for `/`, each at a speed of its own; returns the directory."""
    with BagWriter(directory) as writer:
        writer.add_topic("/depth", FLOAT, [])
        for name, speed in speeds.items():
            topic = writer.add_topic("/" + name.replace("__", "/"), ODOMETRY, [])
            for k in range(5):
                at = (1 + k) * 10**9
                writer.write(topic, at, at, odometry(k, speed), k + 1)
    return directory


def test_the_only_odometry_counts_whatever_its_name(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bag = record(tmp_path / "bag", odometry__filtered=2.0, auv__true_odom=9.0)
    np.testing.assert_array_equal(load(bag).y, 2.0 * np.arange(5))
    assert bag_command.main(["inspect", str(bag)]) == 0
    assert "odometry taken from /odometry/filtered" in capsys.readouterr().out


def test_the_contracts_name_comes_first(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    bag = record(tmp_path / "bag", odometry__filtered=2.0, auv__odom=3.0)
    np.testing.assert_array_equal(load(bag).y, 3.0 * np.arange(5))
    assert bag_command.main(["inspect", str(bag)]) == 0
    assert "odometry taken from" not in capsys.readouterr().out


def test_of_several_one_is_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    bag = record(tmp_path / "bag", wheels=1.0, odometry__filtered=2.0)
    table = tmp_path / "table.csv"
    export = ["export", str(bag), "--out", str(table)]
    assert bag_command.main(export) == 2
    err = capsys.readouterr().err
    assert "/odometry/filtered and /wheels, expected --odometry with one of them" in err
    assert err.count("\n") == 1
    assert bag_command.main([*export, "--odometry", "/wheels"]) == 0
    last = table.read_text().splitlines()[-1].split(",")
    assert float(last[table.read_text().splitlines()[0].split(",").index("y [m]")]) == 4.0


def test_a_namespace_chooses_among_them(tmp_path: Path) -> None:
    bag = record(tmp_path / "bag", auv1__odometry__filtered=1.0, auv2__odometry__filtered=2.0)
    np.testing.assert_array_equal(load(bag, namespace="auv2").y, 2.0 * np.arange(5))


@pytest.mark.parametrize("asked", ["/nothing", "/depth"])
def test_a_name_that_is_no_odometry_gets_the_candidates(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], asked: str
) -> None:
    bag = record(tmp_path / "bag", wheels=1.0, odometry__filtered=2.0)
    for verb in ("inspect", "report", "export"):
        assert bag_command.main([verb, str(bag), "--odometry", asked]) == 2
        err = capsys.readouterr().err
        assert err == f"--odometry: found {asked}, expected one of /odometry/filtered and /wheels\n"


@pytest.mark.parametrize("verb", ["report", "rerun"])
def test_verbs_take_the_one_that_was_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], verb: str
) -> None:
    """`rerun` gets as far as the commands, which were not recorded."""
    bag = record(tmp_path / "bag", wheels=1.0, odometry__filtered=2.0)
    options = ["--odometry", "/wheels"]
    if verb == "report":
        assert bag_command.main([verb, str(bag), "--out", str(tmp_path / "report"), *options]) == 0
        assert (tmp_path / "report" / "track.png").exists()
    else:
        options += ["--mission", "paper_composite", "--vehicle", "remus100"]
        assert bag_command.main([verb, str(bag), *options]) == 2
        assert "no commands" in capsys.readouterr().err


def test_no_odometry_at_all(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    bag = record(tmp_path / "bag")
    assert bag_command.main(["inspect", str(bag), "--json"]) == 0
    assert any("no odometry" in note for note in json.loads(capsys.readouterr().out)["notes"])
