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
    package_data={name: ["py.typed"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{name}"]),
        (f"share/{name}", ["package.xml"]),
    ],
    python_requires=">=3.11",
    install_requires=["numpy", "pydantic>=2", "PyYAML"],
    extras_require={"test": ["hypothesis", "pytest"]},  # where colcon looks for pytest
    zip_safe=False,
)
