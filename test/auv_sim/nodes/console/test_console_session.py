"""The console's command line: addresses, ports, folders; nothing joins the graph before they are right."""

from __future__ import annotations

import socket
from pathlib import Path

import pytest

from auv_sim.cli import console
from auv_sim.nodes.console.console_session import ConsoleOptions, announcement
from auv_sim.views.console.web.page_guard import Tokens

TOKENS = Tokens("secret", "look")


def test_two_addresses_are_printed_one_of_them_to_look_only() -> None:
    assert list(announcement(ConsoleOptions(), TOKENS, 8642)) == [
        "console: http://127.0.0.1:8642/?token=secret",
        "to look only: http://127.0.0.1:8642/?token=look",
    ]
    assert list(announcement(ConsoleOptions(view_only=True), Tokens("", "look"), 8642)) == [
        "to look only: http://127.0.0.1:8642/?token=look"
    ]


@pytest.mark.parametrize(
    ("address", "shown"),
    [
        ("192.168.7.5", "192.168.7.5"),
        ("::1", "[::1]"),
        ("0.0.0.0", socket.gethostname()),  # noqa: S104
    ],
)
def test_another_address_is_warned_of(address: str, shown: str) -> None:
    warning, control, _ = announcement(ConsoleOptions(address=address), TOKENS, 80)
    assert warning.startswith(f"warning --address {address}: ")
    assert control == f"console: http://{shown}:80/?token=secret"


def test_a_taken_port_is_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        assert console.main(["--port", str(port)]) == 2
    found = capsys.readouterr().err
    assert found.startswith(f"--port: found 127.0.0.1 port {port} (")
    assert found.endswith("), expected a free port; --port 0 takes any\n")


@pytest.mark.parametrize("arguments", [["--port", "70000"], ["--address", "no.such.host.invalid"]])
def test_an_address_that_cannot_be_listened_on_is_one_line(
    arguments: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert console.main(arguments) == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_a_folder_of_missions_has_to_exist(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert console.main(["--missions", str(tmp_path / "none")]) == 2
    assert (
        capsys.readouterr().err
        == f"--missions: found {tmp_path / 'none'}, expected a folder of mission files\n"
    )
