"""`scripts/live_view.py`: show a running mission in Foxglove, or write a layout for it."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

from auv_sim.command_line import Parser, command, ros_domain, ros_namespace, target, whole


def parser() -> argparse.ArgumentParser:
    """Return the command line's parser."""
    p = Parser(
        prog="live_view.py",
        description="Show a running mission in Foxglove; nothing can be sent to the vehicle.",
        allow_abbrev=False,
    )
    p.add_argument(
        "--namespace", type=ros_namespace, default="/auv", help="namespace of the vehicle (default /auv)"
    )
    p.add_argument("--domain", type=ros_domain, help="ROS domain (default: ROS_DOMAIN_ID, or 0)")
    p.add_argument("--port", type=whole, default=8765, help="port for Foxglove (default %(default)s)")
    p.add_argument(
        "--address",
        default="127.0.0.1",
        help="address to listen on (default %(default)s); any other opens the port to its network",
    )
    p.add_argument("--layout", type=target, metavar="FILE", help="write a layout for Foxglove, and exit")
    return p


@command("live view")
def main(argv: Sequence[str] | None = None) -> int:
    """Return 0 after a signal or when the layout is written, 2 for bad input."""
    options = parser().parse_args(argv)
    layout: Path | None = options.layout
    from auv_sim.nodes.live_view import bridge

    if layout is not None:
        return bridge.write_layout(layout, options.namespace)
    return bridge.serve(options.namespace, options.address, options.port, options.domain)


if __name__ == "__main__":
    raise SystemExit(main())
