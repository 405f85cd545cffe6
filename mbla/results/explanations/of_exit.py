"""Exit statuses of the program."""

from __future__ import annotations

from mbla.results.explanations.explanation import Explanation


def _status(number: int, title: str, meaning: str, cause: str, remedy: str) -> Explanation:
    return Explanation(
        f"exit-{number}", "exit status", title, meaning, cause, remedy, aliases=(str(number), f"exit status {number}")
    )


_NO_FACTOR = "No load factor: nothing was computed."
_STOPPED = (
    "Load cases that were done before are in STEM.partial.h5, .lst and .json; the others have no load factor. An "
    "earlier result stays as it was."
)

OF_EXIT = (
    _status(
        0,
        "Every load case solved and verified, to the accuracy that the deck asks for.",
        "Every load factor is confirmed by code that did not compute it. With accuracy: draft, or a gap or residual "
        "given, a case may be approximate within what was asked for: its status says so.",
        "All went well.",
        "Read the warnings all the same.",
    ),
    _status(
        1,
        "Internal error: a defect of the program.",
        _STOPPED,
        "Something that the program does not expect of itself.",
        "Report it with the deck; MBLA_TRACEBACK=1 in the environment shows where it arose.",
    ),
    _status(
        2,
        "Wrong usage of the command line.",
        _NO_FACTOR,
        "An unknown command, option or name, or an extra that is not installed.",
        "mbla COMMAND --help lists what there is.",
    ),
    _status(
        3,
        "The deck, or the sweep file, is not valid.",
        f"{_NO_FACTOR} An earlier result stays as it was.",
        "Each fault has a line with file, line, column, value and what is allowed.",
        "Correct them; mbla check reads the deck again without solving, mbla sweep --dry-run a sweep file.",
    ),
    _status(
        4,
        "A load case is not solved or not verified, or is not as expected, or blocks touch nothing.",
        "At least one case has no load factor, one rougher than asked for, or one that differs from what the deck "
        "expects. Other cases of the run may be verified: the status of each says so.",
        "Blocks that touch nothing (isolated-blocks), told before the cases; verification found more than its "
        "tolerances; a limit of iterations; a numerical failure; --expected; "
        "mbla verify found that a file says otherwise; mbla diff --fail found a difference.",
        "Look at the status of each case and at its warnings.",
    ),
    _status(
        5,
        "The deck is valid, but there is no load factor.",
        "A proved answer: the dead load is not carried, or no multiple of the live load brings collapse.",
        "See no-equilibrium and unbounded.",
        "Look at the motion or the forces that prove it.",
    ),
    _status(
        6,
        "A file cannot be read or written, or would be overwritten.",
        f"{_NO_FACTOR} An earlier result stays as it was.",
        "A missing or damaged file, an older layout of a result file, a full disk, an existing result.",
        "The message names the file; --force replaces an earlier result.",
    ),
    _status(
        7,
        "Out of time or memory.",
        "Load factors of cases that were done before stand; the others have none, or a bound only.",
        "--time-limit or analysis.time_limit was reached, or the memory of the machine.",
        "Give more time, a smaller model, symmetry, or accuracy: draft.",
    ),
    _status(
        8,
        "A sweep came to its end, but some of its points failed.",
        "All other points have verified answers. A failed point has no verified answer for one load case at least: its "
        "state is failed, its reason stands in its row, and pictures and probabilities count it as unknown.",
        "A case that is not solved or not verified at that point; a limit of time or memory in the sweep file; a "
        "value that the deck cannot take; a point that ended its process twice.",
        "Look at the column reason of sweep.csv. --retry-failed solves these points again, with the limits that the "
        "sweep file has by then; the rest is kept.",
    ),
    _status(
        130,
        "Interrupted from the keyboard.",
        _STOPPED,
        "Ctrl-C (SIGINT).",
        "Run again; a sweep goes on with --resume, its finished points are in the journal.",
    ),
    _status(
        143,
        "Terminated by a signal.",
        _STOPPED,
        "SIGTERM, mostly of a batch system at its time limit.",
        "Run again with more time, or give --time-limit below that of the batch system; a sweep goes on with --resume.",
    ),
)
