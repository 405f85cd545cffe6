"""mbla: limit analysis of masonry as an assembly of rigid blocks.

The program on one line; each word is a folder, and up to ``results`` its main type carries the folder's name::

    deck ──> questions ──> model ──> contacts ──> assembly ──> program ──> solution ──> results ──> codes ──> sweeps
    text     what is       blocks,   interfaces,  rigid        equilib-    load         .h5 .vtu    capacity  a deck
             asked of a    supports, contact      bodies,      rium, yield factor,      listing,    over      run many
             load case     loads     points       ties         cones       mechanism    pictures    demand    times

A stage imports only from the stages to its left. One exception: kinds of blocks and of loads are each one file of
``model/blocks`` and ``model/loads``, and two files of ``deck`` ask them for the keys that they have in a deck.
``run.py`` is the table of contents.
"""

import sys
from types import ModuleType
from typing import TYPE_CHECKING

__version__ = "0.1.0"

if TYPE_CHECKING:
    from mbla.api import assess as assess
    from mbla.api import read_results as read_results
    from mbla.api import run as run
    from mbla.errors import DeckError as DeckError
    from mbla.errors import FileError as FileError
    from mbla.errors import LimitError as LimitError
    from mbla.errors import MblaError as MblaError
    from mbla.errors import SolverError as SolverError
    from mbla.errors import UsageError as UsageError
    from mbla.results.notebook.case import Case as Case
    from mbla.results.notebook.run import Run as Run
    from mbla.sweeps.api import read_sweep as read_sweep
    from mbla.sweeps.api import sweep as sweep
    from mbla.sweeps.tables.sweep_table import SweepTable as SweepTable

_HOMES = {
    "run": "mbla.api",
    "read_results": "mbla.api",
    "assess": "mbla.api",
    "sweep": "mbla.sweeps.api",
    "read_sweep": "mbla.sweeps.api",
    "Run": "mbla.results.notebook.run",
    "Case": "mbla.results.notebook.case",
    "SweepTable": "mbla.sweeps.tables.sweep_table",
    "MblaError": "mbla.errors",
    "DeckError": "mbla.errors",
    "FileError": "mbla.errors",
    "LimitError": "mbla.errors",
    "SolverError": "mbla.errors",
    "UsageError": "mbla.errors",
}
"""public names and the modules they come from; imported when first asked for, as the command line must start at once"""

__all__ = ["__version__", *_HOMES]


if not TYPE_CHECKING:  # a checker knows the names above, and only these

    def __getattr__(name: str) -> object:
        if name not in _HOMES:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        from importlib import import_module

        return getattr(import_module(_HOMES[name]), name)

    class _Package(ModuleType):
        """The package, in which ``mbla.run`` is the function that users call although a module has that name too."""

        def __setattr__(self, name: str, value: object) -> None:
            if name not in _HOMES or not isinstance(value, ModuleType):
                super().__setattr__(name, value)

    sys.modules[__name__].__class__ = _Package


def __dir__() -> list[str]:
    return sorted(__all__)
