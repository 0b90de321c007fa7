"""Keys of depth that make no path: each is refused in one line with its place."""

from __future__ import annotations

import math

import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.missions import mission_file

HEAD = "version: 1\nname: test\nframe: ned\nthrust: 5\n"
LOITER = "loiter: {centre: [0, 0], radius: 20}\n"
ROUND = 2.0 * math.pi * 20.0


def _profile(knots: str, more: str = "") -> str:
    return f"depth_profile: {{{more}knots: {knots}}}\n{LOITER}"


def _linear(points: str, more: str = "") -> str:
    return f"waypoints: {{points: {points}, {more}smoothing: {{kind: linear}}}}\n"


def _helix(to: float, more: str) -> str:
    return f"helix: {{centre: [0, 0], radius: 15, from_depth: 5, to_depth: {to}, {more}}}\n"


UNEVEN = (
    "survey: {polygon: [[0, 0], [90, 0], [90, 60], [0, 60]], spacing: 30, heading_deg: 0,"
    " smoothing: {kind: linear}, leg_depths: [5, 9]}\n"
)
WRONG = [
    (f"depth: -1\n{LOITER}", "depth: found -1, expected a number of at least 0"),
    (f"depth: .nan\n{LOITER}", "depth: found"),
    (
        f"depth: 5\naltitude: {{above_bottom: 5}}\n{LOITER}",
        "altitude: found it beside depth, expected one of",
    ),
    (f"depth: 5\n{_profile('[[0, 5], [9, 5]]')}", "depth: found depth and depth_profile, expected one of"),
    (f"altitude: {{above_bottom: 5, min: 5}}\n{LOITER}", "altitude: found above_bottom 5 m with min 5 m"),
    (_profile("[[0, 5], [9, 5]]"), f"at 9.000 m, expected the path's horizontal length, {ROUND:.3f} m"),
    (_profile(f"[[1, 5], [{ROUND}, 5]]"), "depth_profile.knots[0]: found 1 m, expected 0"),
    (_profile(f"[[0, 5], [50, 6], [40, 7], [{ROUND}, 5]]"), "knots[2]: found 40 m behind 50 m"),
    (_profile(f"[[0, 5], [50, -6], [{ROUND}, 5]]"), "depth_profile.knots[1]: found (50, -6)"),
    (_profile("[[0, 5], [9, 5]]", "kind: cubic, "), "kind: found 'cubic', expected one of 'smooth' or"),
    (
        f"repeat: 2\n{_profile(f'[[0, 5], [{ROUND}, 9]]')}",
        "repeat: found 2 for a path that starts at a depth of 5 m and ends at 9 m",
    ),
    (
        _linear("[[0, 0, 5], [90, 0], [90, 90, 5]]"),
        "waypoints.points[1]: found no depth, expected one: [0] has a depth",
    ),
    (
        _linear("[[0, 0, 5], [90, 0, -2]]"),
        "waypoints.points[1]: found a depth of -2 m, expected 0 to 12000 m",
    ),
    (
        _linear("[[0, 0, 5], [0, 0, 9], [90, 0, 9]]"),
        "waypoints.points[1]: found a vertical leg, from 5 to 9 m, expected",
    ),
    (_linear("[[0, 0, 5, 1], [90, 0, 5, 1]]"), "points[0]: found [0, 0, 5, 1], expected at most 3 item(s)"),
    (f"depth: 3\n{_linear('[[0, 0, 5], [90, 0, 5]]')}", "depth: found depth and waypoints with a depth"),
    (_linear("[[0, 0], [90, 0]]", "depth_ramp: linear, "), "depth_ramp: found linear, expected it only with"),
    (_helix(5, "slope_deg: 10"), "helix: found from_depth and to_depth both 5"),
    (_helix(9, "slope_deg: 10, turns: 2"), "helix: found 2 of slope_deg and turns (slope_deg, turns)"),
    (_helix(9000, "slope_deg: 1"), "helix.slope_deg: found 1 deg: 5468 turns"),
    (f"depth: 5\n{_helix(9, 'turns: 2')}", "depth: found depth and helix"),
    (UNEVEN.replace("[5, 9]", "[5]"), "survey.leg_depths: found 1 depths, expected one for each of the 2"),
    (UNEVEN.replace("[5, 9]", "[5, -9]"), "survey.leg_depths[1]: found a depth of -9 m"),
    (
        "segments:\n  - spline: {points: [[0, 0, 5], [90, 0], [120, 9, 5]]}\n",
        "segments[0].spline.points[1]: found no depth",
    ),
]


@pytest.mark.parametrize(("text", "message"), WRONG, ids=range(len(WRONG)))
def test_what_makes_no_path_is_refused_with_its_place(tmp_path, text, message):
    (tmp_path / "mission.yaml").write_text(HEAD + text, encoding="utf-8")
    with pytest.raises(ConfigurationError) as error:
        mission_file.load(str(tmp_path / "mission.yaml"))
    assert message in str(error.value).split("mission.yaml: ", 1)[1]
