"""Where the console listens unless it is given, and what it needs; it imports no library."""

from __future__ import annotations

LOOPBACK = "127.0.0.1"
PORT = 8642
INSTALL = "pip install -r requirements/console.txt"
