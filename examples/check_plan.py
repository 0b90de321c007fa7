"""Check in code whether a vehicle can fly a mission, in a current that rises until it cannot."""

from auv_msgs_py.values.types import Current
from auv_path_following import vehicle
from auv_path_following.mission_check.flyable import check
from auv_path_following.missions import mission_file

hull = vehicle.load("remus100")
mission = mission_file.load("survey_wgs84", hull)
for speed in (0.0, 0.5, 1.0, 1.5):
    found = check(mission, hull, Current(0.0, speed))
    print(f"{speed:.1f} m/s: {len(found.warnings)} warnings, {len(found.refusals)} refusals")
    for item in found.refusals[:1]:
        print(f"    {item.where}: found {item.found}, expected {item.expected}")
