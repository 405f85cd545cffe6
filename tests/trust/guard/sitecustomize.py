"""Python imports this at its start where the folder is on its path: every way to another machine is refused.

Processes that are begun inherit it. Each attempt is written to the file MBLA_ATTEMPTS, as a program may swallow the
error; sockets of this machine are allowed, which the processes of a sweep use.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

HERE = ("127.0.0.1", "::1", "localhost", "", "0.0.0.0", "::", None)
CALLS = ("socket.connect", "socket.sendto", "socket.getaddrinfo", "socket.gethostbyname")


def refuse(event: str, arguments: tuple[object, ...]) -> None:
    """An audit hook (PEP 578)."""
    if event not in CALLS:
        return
    place = arguments[0] if event in ("socket.getaddrinfo", "socket.gethostbyname") else arguments[1]
    host = place[0] if isinstance(place, tuple) else place
    if event in ("socket.connect", "socket.sendto") and not isinstance(place, tuple):
        return  # a socket of this machine: its address is a path
    if host not in HERE:
        with Path(os.environ["MBLA_ATTEMPTS"]).open("a", encoding="utf-8") as file:
            file.write(f"{event} {host}\n")
        raise OSError(f"no network: {event} {host}")


sys.addaudithook(refuse)
