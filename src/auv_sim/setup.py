"""What package.xml already says is read from there, so that no number stands in two places."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

from setuptools import find_packages, setup

manifest = ElementTree.parse(Path(__file__).with_name("package.xml")).getroot()
maintainer = manifest.find("maintainer")
name = manifest.findtext("name")

setup(
    name=name,
    version=manifest.findtext("version"),
    description=manifest.findtext("description"),
    license=manifest.findtext("license"),
    author=maintainer.text,
    author_email=maintainer.get("email"),
    maintainer=maintainer.text,
    maintainer_email=maintainer.get("email"),
    packages=find_packages(include=[name, f"{name}.*"]),
    package_data={
        name: [
            "py.typed",
            "bags/showing/page/*.html",
            "bags/showing/page/*.js",
            "launch/processes/*.xml",
            "own_vehicle/prove/*.html",
            "views/console/page/*",
        ]
    },
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{name}"]),
        (f"share/{name}", ["package.xml"]),
        (f"share/{name}/launch", sorted(map(str, Path("launch").glob("*.launch.*")))),
    ],
    python_requires=">=3.11",
    install_requires=[
        "auv_msgs_py",
        "auv_path_following",
        "matplotlib",
        "mcap",
        "numpy",
        "pydantic",
        "pymavlink",
        "PyYAML",
        "rich",
        "rosbags",
        "scipy",
        "zstandard",
    ],
    # Without numba the batch engine is slow; campaigns and Parquet exports need pyarrow; without distributed
    # a campaign stays on one machine. colcon looks for pytest under "test".
    extras_require={
        "batch": ["numba"],
        "campaign": ["pyarrow"],
        "cluster": ["distributed"],
        "console": ["aiohttp"],
        "foxglove": ["foxglove-sdk"],
        "test": ["hypothesis", "pytest"],
        "vehicle": ["cma", "numba"],
    },
    zip_safe=False,
    entry_points={
        "console_scripts": [
            "remus_plant = auv_sim.nodes.plant_node:main",
            "recorder = auv_sim.nodes.recorder_node:main",
            "fleet_clock = auv_sim.nodes.fleet.fleet_clock_node:main",
            "fault_relay = auv_sim.nodes.fault_relay:main",
            "check_vehicle = auv_sim.cli.vehicles.check_vehicle:main",
            "mavlink_driver = auv_sim.nodes.mavlink.driver:main",
            "mavlink_emulator = auv_sim.nodes.mavlink.emulator:main",
            "manoeuvres = auv_sim.nodes.manoeuvres.manoeuvres_node:main",
            "display = auv_sim.nodes.display.display_node:main",
            "mission_supervisor = auv_sim.launch.ros_launch.supervisor:main",
            "mavlink_strangers = auv_sim.checks.faults.strangers:main",
        ]
    },
)
