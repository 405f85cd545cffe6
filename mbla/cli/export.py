"""``mbla export``."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mbla.cli.options import names, place
from mbla.errors import UsageError
from mbla.process.collector import loading

if TYPE_CHECKING:
    from mbla.results.results import Results


def add(commands: Any) -> None:
    """The command and its options."""
    command = commands.add_parser(
        "export", help="tables of blocks, interfaces, points and load cases; decks of macro-blocks"
    )
    command.set_defaults(action=export)
    command.add_argument("result", type=Path, metavar="RESULT.h5")
    command.add_argument("--csv", action="store_true", help="CSV, units in the header (what is written by default)")
    command.add_argument("--parquet", action="store_true", help="Parquet (extra mbla[tables])")
    words = (
        "in the place of tables a deck for each load case, STEM_CASE_macro.yaml, whose blocks are the rigid parts "
        "of its mechanism; with associative flow they have the same load factor"
    )
    command.add_argument("--macro-blocks", action="store_true", help=words)
    words = "with --macro-blocks: parts of the mechanism of associative flow, whatever the flow rule of the deck"
    command.add_argument("--associative", action="store_true", help=words)
    words = "folder of the files (default: that of the result)"
    command.add_argument("-o", "--output", type=place, metavar="DIR", help=words)
    command.add_argument("--case", action="append", default=[], metavar="NAME", help="only this load case (repeatable)")
    words = "only these tables, such as blocks,interfaces,points"
    command.add_argument("--table", type=names, default=[], metavar="NAME,...", help=words)
    words = "replace earlier files (those with the same content are not in the way)"
    command.add_argument("--force", action="store_true", help=words)


def export(options: argparse.Namespace) -> int:
    """Write tables, or decks of macro-blocks; their paths are printed.

    Raises UsageError for options that do not go together.
    """
    with loading():
        from mbla.results.hdf5.result_file import read_results_hdf5
        from mbla.results.tables.tables import export_results

    results = read_results_hdf5(options.result)
    folder = options.output or options.result.parent
    if options.macro_blocks:
        return _export_macro_blocks(options, results, folder)
    if options.associative:
        raise UsageError("command-line", "export: --associative applies with --macro-blocks")
    formats = {"csv": options.csv or not options.parquet, "parquet": options.parquet}
    chosen = (options.case, options.table)
    for path in export_results(results, folder, options.result.stem, *chosen, **formats, force=options.force):
        print(path)
    return 0


def _export_macro_blocks(options: argparse.Namespace, results: Results, folder: Path) -> int:
    from mbla.results.macro_blocks import write_macro_blocks

    if options.csv or options.parquet or options.table:
        raise UsageError("command-line", "export: --macro-blocks writes no tables: leave out --csv, --parquet, --table")
    chosen = (options.case, options.associative)
    for path in write_macro_blocks(results, folder, options.result.stem, *chosen, force=options.force):
        print(path)
    return 0
