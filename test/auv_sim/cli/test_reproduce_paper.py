"""The command as a person runs it, shortened: every file is there, every verdict follows from the numbers."""

from __future__ import annotations

import csv
import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

from auv_sim.cli.reproduce_paper import main
from auv_sim.studies.paper.figures import FIGURES

REPOSITORY = Path(__file__).resolve().parents[3]


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    out = tmp_path_factory.mktemp("reproduction")
    command = [
        sys.executable,
        "-c",
        "import sys; from auv_sim.cli.reproduce_paper import main; sys.exit(main())",
        *("--out", str(out), "--quick", "--time-limit", "30"),
    ]
    packages = [str(REPOSITORY / "src" / name) for name in ("auv_msgs_py", "auv_path_following", "auv_sim")]
    result = subprocess.run(
        command, capture_output=True, text=True, check=False, timeout=300,
        env={"PYTHONPATH": ":".join(packages), "PATH": "/usr/bin:/bin", "MPLCONFIGDIR": str(out / "mpl")},
    )  # fmt: skip
    assert result.returncode == 0, result.stderr
    return out, result.stdout


def test_every_figure_is_there_with_its_data(made):
    out, _ = made
    for number in FIGURES:
        stem = out / f"figure-{number:02d}"
        assert stem.with_suffix(".png").read_bytes().startswith(b"\x89PNG")
        assert "<svg" in stem.with_suffix(".svg").read_text(encoding="utf-8")[:2000]
        with stem.with_suffix(".csv").open(encoding="utf-8") as stream:
            rows = list(csv.reader(stream))
        assert len(rows) > 1 or number == 10  # which looks at the corner only


def test_the_page_needs_nothing_beside_it(made):
    out, _ = made
    text = (out / "reproduction.html").read_text(encoding="utf-8")
    assert not re.search(r"(src|href)=['\"](?!data:|#)", text)
    assert text.count("data:image/png") == len(FIGURES)
    record = json.loads((out / "claims.json").read_text(encoding="utf-8"))
    for claim in record["claims"]:
        assert f"id='{claim['key']}'" in text


def test_a_mission_that_is_cut_off_is_not_said_to_be_followed(made):
    out, stdout = made
    claims = {c["key"]: c for c in json.loads((out / "claims.json").read_text(encoding="utf-8"))["claims"]}
    assert claims["global_following"]["verdict"] == "does not hold"
    assert claims["early_switching"]["verdict"] == "does not hold"
    assert claims["theorem_1"]["verdict"] == "holds"
    assert claims["observer"]["verdict"] == "holds"
    assert "scripts/reproduce_paper.py --study" in stdout


@pytest.mark.parametrize(
    "wrong",
    [["--runs", "0"], ["--time-limit", "1"], ["--study", "tea"], ["--workers", "x"], ["--seed", "-1"]],
)
def test_wrong_options_are_refused_in_one_line(wrong, capsys):
    with pytest.raises(SystemExit) as caught:
        main(wrong)
    assert caught.value.code == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_a_directory_that_cannot_be_made_is_named(tmp_path, capsys):
    (tmp_path / "file").write_text("", encoding="utf-8")
    assert main(["--out", str(tmp_path / "file" / "below")]) == 2
    assert "--out" in capsys.readouterr().err
