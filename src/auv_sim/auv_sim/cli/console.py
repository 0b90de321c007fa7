"""`scripts/console.py`: watch missions and steer them in a browser."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.command_line import Parser, command, ros_domain, ros_namespace, whole
from auv_sim.views.console.listening import INSTALL, LOOPBACK, PORT


def parser() -> argparse.ArgumentParser:
    """Return the command line's parser."""
    p = Parser(prog="console.py", description="Watch and steer missions in the browser.", allow_abbrev=False)
    p.add_argument(
        "--namespace",
        type=ros_namespace,
        action="append",
        default=[],
        help="namespace of a vehicle; repeat it for several (default: all that are discovered)",
    )
    p.add_argument("--domain", type=ros_domain, help="ROS domain (default: ROS_DOMAIN_ID, or 0)")
    p.add_argument(
        "--port",
        type=whole,
        help=f"port for the browser; 0: any free one (default: {PORT}, or a free one if it is taken)",
    )
    p.add_argument(
        "--address",
        default=LOOPBACK,
        help="address to listen on (default %(default)s); any other opens the port to its network",
    )
    p.add_argument("--view-only", action="store_true", help="accept no commands from any browser")
    p.add_argument(
        "--missions", type=Path, metavar="DIR", help="folder of further mission files to choose from"
    )
    p.add_argument(
        "--forget", action="store_true", help="store neither tracks nor cookies for a restart of the console"
    )
    return p


@command("console")
def main(argv: Sequence[str] | None = None) -> int:
    """Return 0 after a signal, 2 for bad input."""
    options = parser().parse_args(argv)
    try:
        import aiohttp  # noqa: F401
    except ImportError:
        raise ConfigurationError("aiohttp", "not installed", INSTALL) from None
    from auv_sim.nodes.console.console_session import ConsoleOptions, serve

    return serve(
        ConsoleOptions(
            namespaces=tuple(options.namespace), domain=options.domain, address=options.address,
            port=options.port, view_only=options.view_only, missions=options.missions,
            keep=not options.forget,
        )
    )  # fmt: skip


if __name__ == "__main__":
    raise SystemExit(main())
