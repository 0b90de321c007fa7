"""Report, console and pictures share their colours and their drawing."""

from __future__ import annotations

import shutil
import subprocess

import pytest

from auv_sim.bags.verbs import report
from auv_sim.views import plot_style


def test_pictures_have_the_colours_of_the_pages() -> None:
    found = (
        plot_style.INK,
        plot_style.PATH,
        plot_style.BLUE,
        plot_style.ORANGE,
        plot_style.GREEN,
        plot_style.RED,
    )
    assert found == ("#1b2733", "#b9c3cd", "#0b5fa5", "#e07b1a", "#2a9d6f", "#c8374a")


@pytest.mark.skipif(shutil.which("node") is None, reason="not run: no node")
def test_the_modules_work_as_plain_scripts_in_one_page() -> None:
    scripts = "".join(report._as_script(report._shared(name)) for name in report._DRAWING)
    code = (
        f"{scripts}\nconsole.log(ticks(0, 10, 4)[0].length, placing({{x: 0, y: 0, scale: 2}}, 10, 10)(1, 2))"
    )
    done = subprocess.run(["node", "-e", code], capture_output=True, text=True, check=False)
    assert (done.stderr, done.stdout.split()) == ("", ["3", "[", "9,", "3", "]"])
