"""A run that is stopped leaves the load cases that were done, beside an earlier result and never in its place.

Their files are ``STEM.partial.h5``, ``.lst`` and ``.json`` in the folder of the results. They say that they are not
complete, what was not done, and give way to those of the next run of the deck, whole or stopped again. A run that is
refused (its deck, its options, a file) leaves nothing: it has said why, and comes as far again.
"""

from __future__ import annotations

from dataclasses import replace

from mbla.deck.sections.output import OutputSection
from mbla.errors import DeckError, FileError, MblaError, Notice, UsageError
from mbla.results.failures import StoppedRun, words_of
from mbla.results.files import OutputFolder, is_partial, partial_stem
from mbla.results.results import Results
from mbla.results.write import write_results

NAMED = 5
"""load cases that a remark names"""


def leaves_nothing(cause: BaseException) -> bool:
    """Whether a run was refused, not stopped."""
    return isinstance(cause, (DeckError, UsageError, FileError, OSError))


def partial_results(results: Results, cause: BaseException) -> Results:
    """Results of the load cases that were done, with a warning that they are not all."""
    status, words = words_of(cause)
    left = results.not_done
    more = f" and {len(left) - NAMED} more" if len(left) > NAMED else ""
    lacking = f"not done: {', '.join(left[:NAMED])}{more}" if left else "not written: its other files"
    text = f"the run was stopped ({words}); load cases done: {_done(results)}; {lacking}"
    warning = Notice("warning", "run-stopped", text)
    return replace(results, complete=False, exit_code=status, notices=(*results.notices, warning))


def keep_partial(results: Results, out: OutputFolder, output: OutputSection) -> Results:
    """Write the files of partial results, none for ParaView and no pictures; what was written is in ``files``.

    Raises
    ------
    FileError, OSError, MemoryError
        They could not be written, or files of another deck have their names; nothing is left then.
    """
    stem = partial_stem(out.stem)
    with OutputFolder(out.folder, stem, force=is_partial(out.folder, stem)) as beside:
        return write_results(results, beside, output.model_copy(update={"vtu": False, "plots": False}))


def stopped(results: Results, cause: BaseException, out: OutputFolder, output: OutputSection) -> StoppedRun:
    """What to raise where a run was stopped; what stopped it tells where the load cases that were done are.

    out : where the whole result would have gone
    """
    partial = partial_results(results, cause)
    try:
        partial = keep_partial(partial, out, output)
    except (MblaError, OSError, MemoryError) as error:
        cause.add_note(f"load cases done: {_done(results)}, which could not be written: {words_of(error)[1]}")
    else:
        cause.add_note(f"load cases done: {_done(results)}, in {out.folder / partial_stem(out.stem)}.h5")
    return StoppedRun(cause, partial)


def _done(results: Results) -> str:
    return f"{len(results.cases)} of {len(results.cases) + len(results.not_done)}"
