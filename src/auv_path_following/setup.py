"""What package.xml already says is read from there, so that no number stands in two places."""

from __future__ import annotations

import os
from pathlib import Path
from xml.etree import ElementTree

from setuptools import find_packages, setup

manifest = ElementTree.parse(Path(__file__).with_name("package.xml")).getroot()
maintainer = manifest.find("maintainer")
name = manifest.findtext("name")

# The shipped missions, vehicles and parameters: package data for importlib.resources, and once more under
# share/ where ROS people look. (`config` inside the package is a symbolic link to the one at the top.)
config = [
    (f"share/{name}/{Path(folder).relative_to(name)}", [f"{folder}/{file}" for file in sorted(files)])
    for folder, _, files in os.walk(f"{name}/config")
    if files
]

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
    package_data={name: ["py.typed", "config/**/*"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{name}"]),
        (f"share/{name}", ["package.xml"]),
        *config,
    ],
    python_requires=">=3.11",
    install_requires=["auv_msgs_py", "numpy", "pydantic>=2", "pymap3d", "scipy"],
    extras_require={"test": ["hypothesis", "pytest"]},  # where colcon looks for pytest
    zip_safe=False,
    entry_points={
        "console_scripts": [
            "current_observer = auv_path_following.nodes.current_observer_node:main",
            "ailos_guidance = auv_path_following.nodes.guidance_node:main",
            "heading_autopilot = auv_path_following.nodes.heading_autopilot_node:main",
        ]
    },
)
