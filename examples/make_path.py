"""Make a composite path in code: a line, a half circle and rounded waypoints, and evaluate it."""

import math

from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.arc import Arc
from auv_path_following.curves.kinds.line import Line
from auv_path_following.missions.routes.smoothing import Smoothing, smooth

# 60 m north, then a half circle of 20 m radius to starboard, which ends at north 60, east 40.
first = [Line(0.0, 0.0, 60.0, 0.0), Arc(60.0, 20.0, 20.0, -math.pi / 2, math.pi / 2)]
rest = smooth([(60.0, 40.0), (0.0, 40.0), (0.0, 120.0)], Smoothing(kind="fermat", radius=15.0))
path = CompositePath([*first, *rest])

print(f"{path.n} subpaths, {path.length:.1f} m")
for joint in path.joints:
    print(f"joint {joint.index} at ({joint.x:6.1f}, {joint.y:6.1f}): {joint.geometric}, {joint.parametric}")
middle = path.at(1.5)
print(f"s = 1.5: north {middle.x:.1f} m, east {middle.y:.1f} m, curvature {middle.kappa:.3f} 1/m")
