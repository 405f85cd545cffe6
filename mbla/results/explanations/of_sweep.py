"""What a sweep remarks on its design, and what its journal remarks and refuses."""

from __future__ import annotations

from mbla.results.explanations.explanation import Explanation

_POINTS = "None: a point is in the table with the answer that was verified for it, or is solved again."

OF_SWEEP = (
    Explanation(
        "sweep-design",
        "notice",
        "Something worth knowing of the points of a sweep.",
        "None for a single point. Shares of the points, as in a fragility curve, may be no probabilities.",
        "A Sobol sequence whose length is no power of two; a sample in which a parameter has only a range, or that is "
        "combined with another sample; constraints that leave out some of its points.",
        "The message says what to change; nothing where the points are only to be looked at one by one.",
    ),
    Explanation(
        "journal-repaired",
        "notice",
        "The last row of a sweep's journal was not whole and was cut off.",
        _POINTS,
        "The run before was killed, or the power went, while the row was being written.",
        "Nothing; its point is solved again.",
    ),
    Explanation(
        "journal-of-another-sweep",
        "error",
        "A sweep cannot go on with a journal that was written for something else.",
        _POINTS,
        "The base deck or a file that it names has changed, other results or load cases are asked for, or mbla is "
        "another version: rows of both in one table would not belong together.",
        "--force begins anew; -o FOLDER keeps the earlier one; or go on with what the journal was written with.",
        says=("it cannot be gone on with",),
    ),
    Explanation(
        "journal-damaged",
        "error",
        "Rows of a sweep's journal are not as they were written.",
        _POINTS,
        "It was saved by a spreadsheet, which rounds numbers, or edited, or the disk is failing: each row has a check "
        "sum.",
        "Put back the file as it was, or delete the lines named: their points are solved again. To look at results "
        "take sweep.csv, or a copy of the journal.",
        says=("does not match its check sum",),
    ),
    Explanation(
        "sweep-at-work",
        "error",
        "Another run is at work on the same sweep.",
        _POINTS,
        "Two runs on one journal would solve points twice; shards of one sweep run side by side, a whole run and a "
        "shard do not.",
        "Wait for its end, or end the process named on the machine named. A run that was killed holds nothing.",
        says=("is at work on it",),
    ),
)
