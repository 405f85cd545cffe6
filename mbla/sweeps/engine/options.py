"""Where the points of a sweep are solved, as the command line says it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from mbla.errors import UsageError

PATIENCE = 60.0
"""seconds to wait for a scheduler and its first worker"""


@dataclass(frozen=True)
class EngineOptions:
    """What engine is wanted.

    workers        : processes on this machine
    scheduler      : address of a Dask scheduler, ``tcp://host:port`` or ``tls://host:port``; empty for none
    scheduler_file : file in which a scheduler wrote its address
    tls_ca_file    : certificate of the authority; Dask's own configuration where these three are None
    tls_cert       : certificate of this client
    tls_key        : its private key
    patience       : seconds to wait for the scheduler and its first worker, and for another where all are gone
    """

    workers: int = 1
    scheduler: str = ""
    scheduler_file: Path | None = None
    tls_ca_file: Path | None = None
    tls_cert: Path | None = None
    tls_key: Path | None = None
    patience: float = PATIENCE

    @property
    def cluster(self) -> bool:
        """Whether a scheduler is named."""
        return bool(self.scheduler) or self.scheduler_file is not None

    @property
    def tls_files(self) -> dict[str, Path]:
        """Files that were named, by their option."""
        files = {"--tls-ca-file": self.tls_ca_file, "--tls-cert": self.tls_cert, "--tls-key": self.tls_key}
        return {option: path for option, path in files.items() if path is not None}


def check_options(options: EngineOptions) -> None:
    """UsageError for what does not go together or is not there; all of it in one line each."""
    wrong = []
    if options.workers < 1:
        wrong.append(f"-j {options.workers}: at least 1")
    if options.cluster and options.workers > 1:
        wrong.append("-j is for processes of this machine; with a scheduler its workers are all used")
    if options.scheduler and options.scheduler_file is not None:
        wrong.append("--scheduler and --scheduler-file: one of them says where the scheduler is")
    if options.scheduler and not options.scheduler.startswith(("tcp://", "tls://")):
        wrong.append(f"--scheduler {options.scheduler}: an address is tcp://HOST:PORT or tls://HOST:PORT")
    files = options.tls_files
    if files and (options.scheduler.startswith("tcp://") or not options.cluster):
        wrong.append(f"{', '.join(files)}: only for a scheduler at a tls:// address")
    if ("--tls-cert" in files) != ("--tls-key" in files):
        wrong.append("--tls-cert and --tls-key belong together")
    wrong += [f"{option} {path}: there is no such file" for option, path in files.items() if not path.is_file()]
    if wrong:
        raise UsageError("sweep-option", "\n".join(wrong))
