"""The commands on results: call what does the work, print, return the exit status; nothing else.

They print as :mod:`mbla.cli` does, which calls them and says what went wrong. Everything of a command is imported when
it is called, so that the program starts at once.
"""

from __future__ import annotations

import argparse
import sys

from mbla.errors import UsageError
from mbla.process.collector import loading


def show(options: argparse.Namespace) -> int:
    """Print the listing, or the JSON object."""
    with loading():
        from mbla.results.hdf5.result_file import read_results_hdf5
        from mbla.results.listing.listing import listing
        from mbla.results.records.json_record import json_line, results_json

    results = read_results_hdf5(options.result)
    print(json_line(results_json(results)) + "\n" if options.json else listing(results), end="")
    return 0


def verify(options: argparse.Namespace) -> int:
    """Recompute what the file claims; the exit status tells what it is worth by that."""
    with loading():
        from mbla.results.listing.listing import verification_lines
        from mbla.results.records.json_record import json_line, verification_json
        from mbla.verify_file import verify_file

    results, agreed = verify_file(options.result)
    if options.json:
        print(json_line(verification_json(results, agreed)))
    else:
        print("\n".join(verification_lines(results, agreed)))
    return results.exit_code


def plot(options: argparse.Namespace) -> int:
    """Draw pictures or films; their paths are printed."""
    with loading():
        from mbla.results.hdf5.result_file import read_results_hdf5
        from mbla.results.pictures.options import picture_options
        from mbla.results.pictures.plot import plot_results

    chosen = picture_options(options)
    results = read_results_hdf5(options.result)
    target = options.output or options.result.parent
    for path in plot_results(results, target, options.result.stem, chosen):
        print(path)
    return 0


def sweep_plot(options: argparse.Namespace) -> int:
    """Draw pictures of a sweep; their paths are printed."""
    with loading():
        from mbla.sweeps.pictures.plot import plot_sweep_files

    for path in plot_sweep_files(options.sweep, options):
        print(path)
    return 0


def report(options: argparse.Namespace) -> int:
    """Write the HTML file; its path is printed, remarks on what it lacks go to standard error."""
    with loading():
        from mbla.results.hdf5.result_file import read_results_hdf5
        from mbla.results.report.report import report_path, write_report

    results = read_results_hdf5(options.result)
    target = report_path(options.output, options.result)
    for remark in write_report(results, target, options.case, view=not options.no_3d):
        print(f"mbla: {remark}", file=sys.stderr)
    print(target)
    return 0


def export(options: argparse.Namespace) -> int:
    """Write tables and meshes; their paths are printed."""
    with loading():
        from mbla.results.hdf5.result_file import read_results_hdf5
        from mbla.results.tables.export import Formats, export_results

    results = read_results_hdf5(options.result)
    folder = options.output or options.result.parent
    if options.vtkhdf:
        raise UsageError(
            "command-line", "export: --vtkhdf is no more: ParaView reads the VTU files that every run writes"
        )
    formats = Formats(options.csv, options.parquet)
    for path in export_results(
        results, folder, options.result.stem, formats, options.case, options.table, options.force
    ):
        print(path)
    return 0


def diff(options: argparse.Namespace) -> int:
    """Print what differs; status 4 only where it is asked for."""
    with loading():
        from mbla.results.diff.comparison import compare_results
        from mbla.results.diff.records import comparison_json
        from mbla.results.diff.words import comparison_text
        from mbla.results.hdf5.result_file import read_results_hdf5
        from mbla.results.records.json_record import json_line

    names = str(options.first), str(options.second)
    results = read_results_hdf5(options.first), read_results_hdf5(options.second)
    comparison = compare_results(*results, options.tolerance)
    if options.json:
        print(json_line(comparison_json(comparison, names)))
    else:
        print(comparison_text(comparison, names), end="")
    return 4 if options.fail and comparison.differing else 0


def explain(options: argparse.Namespace) -> int:
    """Print what identifiers mean."""
    with loading():
        from mbla.results.explanations import (
            all_text,
            explanation_json,
            explanation_text,
            explanations,
            find_explanations,
        )
        from mbla.results.records.json_record import json_line

    asked = " ".join(options.identifier)
    found = find_explanations(asked) if asked.strip() else tuple(explanations().values())
    if options.json:
        print(json_line({"explanations": [explanation_json(entry) for entry in found]}))
    else:
        print(explanation_text(found) if asked.strip() else all_text(), end="")
    return 0
