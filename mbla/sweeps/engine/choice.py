"""From what the command line asks for to an engine."""

from __future__ import annotations

from typing import TYPE_CHECKING

from mbla.sweeps.engine.options import EngineOptions, check_options
from mbla.sweeps.engine.serial import SerialEngine

if TYPE_CHECKING:
    from mbla.sweeps.engine.cluster import ClusterEngine


def engine_for(options: EngineOptions) -> SerialEngine | ClusterEngine:
    """The engine; it is started by entering its context.

    Raises
    ------
    UsageError
        options that do not go together, or an extra that is not installed
    """
    check_options(options)
    if options.workers == 1 and not options.cluster:
        return SerialEngine()
    from mbla.sweeps.engine.cluster import ClusterEngine

    return ClusterEngine(options)
