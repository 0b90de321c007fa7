"""Every `ros2 launch` line of the pages names a launch file and arguments that exist."""

from __future__ import annotations

import shlex

import pytest

from auv_path_following import config_files
from auv_sim.cli import mission as mission_cli
from auv_sim.launch.options import checked_options
from auv_sim.launch.ros_launch import launch_arguments
from doc_commands import FILES, LINES, Line
from doc_pages import ROOT


@pytest.mark.parametrize("line", [line for line in LINES if line.text.startswith("ros2 launch")], ids=str)
def test_a_launch_file_has_these_arguments(line: Line) -> None:
    _, _, package, file, *rest = shlex.split(line.text)
    text = (ROOT / "src" / package / "launch" / file).read_text(encoding="utf-8")
    values = dict(word.split(":=", 1) for word in rest)
    if file.endswith(".xml"):
        assert all(f'<arg name="{name}" default' in text for name in values)
        return
    if launch_arguments.FLEET in values:
        assert config_files.find("fleets", values.pop(launch_arguments.FLEET)).is_file()
    table = launch_arguments.of_mission() if file == "mission.launch.py" else launch_arguments.of_vehicle()
    assert set(values) <= {argument.name for argument in table}
    given = {argument.name: values.get(argument.name, argument.default) for argument in table}
    checked_options(vars(mission_cli.parser_of_one().parse_args(launch_arguments.command_line(table, given))))
    for option, kind in FILES.items():
        if option in values:
            assert config_files.find(kind, values[option]).is_file()
