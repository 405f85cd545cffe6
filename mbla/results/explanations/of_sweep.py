"""What a sweep remarks on its design, what of its file, its journal and its workers is refused, and why points fail."""

from __future__ import annotations

from mbla.results.explanations.explanation import Explanation

_NOTHING = "Nothing was computed and nothing written; an earlier sweep stays as it was."
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
        "another-run-at-work",
        "error",
        "Another run is at work on the same sweep, or writes results of the same deck into the same folder.",
        _POINTS,
        "Two runs of one deck into one folder would mix their files, two on one journal solve points twice; shards of "
        "one sweep run side by side, a whole run and a shard do not.",
        "Wait for its end, or end the process named on the machine named. A run that was killed holds nothing.",
        says=("is at work on it",),
    ),
    Explanation(
        "sweep-key",
        "error",
        "A parameter of a sweep names nothing in the base deck that could change.",
        _NOTHING,
        "A misspelt key path, an item that the list does not have (items count from 0), a whole section, or a section "
        "that is the same for all points, such as units.",
        "Take the key path as it stands in the deck, as for --set; the message names what is there.",
        example="key: blocks.0.wall.unit.2",
        says=(
            "unknown name",
            "the deck has nothing at",
            "the deck has a single value at",
            "is a section of the deck: name",
            "cannot change from point to point",
        ),
    ),
    Explanation(
        "sweep-ranges",
        "error",
        "The way in which a parameter gives its values does not fit the part of the design that it is in.",
        _NOTHING,
        "A grid needs so many points of each range, a sample takes ranges and distributions without a number of "
        "points, and zip needs lists of one length.",
        "Give points, leave them out, or put the parameter into another part of the design, as the message says.",
        says=(
            "has no meaning in a",
            "is a distribution, which",
            "needs points, how many values it has",
            "needs as many values of each parameter",
        ),
    ),
    Explanation(
        "sweep-file-and-deck",
        "error",
        "A deck stands where a sweep file belongs, or the other way round.",
        _NOTHING,
        "mbla run takes decks, mbla sweep takes sweep files, which name a deck of their own as their base.",
        "Take the other command, or correct `deck` in the sweep file.",
        says=("this is a deck, not a sweep file", "this is a sweep file, not a deck", "is the sweep file itself"),
    ),
    Explanation(
        "sweep-without-effect",
        "error",
        "Something that a sweep sets changes nothing, or is set twice.",
        _NOTHING,
        "The deck does not use it, the load case is not among those to solve, or two parameters, or a parameter and "
        "set, go to the same place.",
        "Drop one of them, or let the deck use it; one parameter may set several key paths.",
        says=(
            "has no effect: the deck does not use",
            "has no effect: load case",
            "has no effect: parameter",
            "one of them would have no effect",
            "sets it too",
        ),
    ),
    Explanation(
        "sweep-parts",
        "error",
        "The parts of a design do not share the parameters between them.",
        _NOTHING,
        "Each parameter belongs to one part. One part may leave out `of`: it takes all that no other part names.",
        "Name each parameter in one `of`.",
        says=(
            "stands in no part of the design",
            "only one part of the design can take",
            "the other parts name them all",
        ),
    ),
    Explanation(
        "sweep-directions",
        "error",
        "A parameter of directions has no vector to turn, or several that differ.",
        _NOTHING,
        "horizon and sphere turn a vector of three numbers of the deck and keep its size: horizon that of its "
        "horizontal part. One that points straight down has none.",
        "Give size; name the key of a vector, such as load_cases.push_x.live.0.acceleration; give vectors that differ "
        "a parameter each, in a zip.",
        says=("turns a vector of three numbers", "turns vectors that differ in the deck", "needs size: the vector"),
    ),
    Explanation(
        "sweep-columns",
        "error",
        "Two columns of the table would have one name.",
        _NOTHING,
        "A parameter is called as a result, as an angle of another parameter, or as a column of every sweep is: "
        "point, state, exit_code, reason, tries, seconds.",
        "Give the parameter another name, and its key path with key.",
        says=("of the table would be there twice", "of the table is a result"),
    ),
    Explanation(
        "sweep-fragility",
        "error",
        "A probability is asked for where the points of the design are no random sample.",
        _NOTHING,
        "A grid, or a sample of plain ranges, says nothing of how likely its points are; two samples make no one "
        "sample; status tells a structure that does not stand from one that no load brings down.",
        "Give each parameter of one random, latin_hypercube or sobol part a distribution, and status among the "
        "results.",
        says=(
            "needs a random design",
            "needs one random part of the design",
            "tells what does not stand from what no load brings down",
        ),
    ),
    Explanation(
        "sweep-too-many-points",
        "error",
        "The design has more points than a sweep takes.",
        _NOTHING,
        "Every part of a design is combined with every point of the others, so that the numbers multiply.",
        "Take fewer values, zip for parameters that change together, or one sample of several parameters.",
        says=("points, at most",),
    ),
    Explanation(
        "sweep-result",
        "error",
        "A result of a sweep is no single value of the JSON record.",
        _NOTHING,
        "A misspelt key, a key that holds an object or a list, or one that stands with its load case in front.",
        "Take a key path of cases[] in schemas/results.md, items of lists by number; the message suggests some.",
        example="results: [status, load_factor, mechanism.class, model.total_weight]",
        says=("is no result", "no single value; take", "stands without its load case"),
    ),
    Explanation(
        "point-beyond-limit",
        "error",
        "A point of a sweep was stopped at the limit of time or memory of the sweep file.",
        "None for that point, which has failed with exit status 7; the others are not touched.",
        "limits.time or limits.memory is less than the point takes; time is by the clock, and more processes than the "
        "machine has cores slow each of them down.",
        "Raise the limit and take --retry-failed; or leave such points out by a constraint.",
        says=("stopped at the limit of", "of memory that a point may take"),
    ),
    Explanation(
        "point-given-up",
        "error",
        "A point of a sweep ended its process at every try.",
        "None for that point, which has failed with exit status 1; the others are not touched.",
        "The operating system ended the process, mostly for want of memory, or a library broke.",
        "Solve the point alone by mbla run with the values of its row; give limits.memory, or fewer processes; "
        "--retry-failed tries it again.",
        says=("given up after",),
    ),
    Explanation(
        "workers-differ",
        "error",
        "A worker of the cluster has another mbla or other libraries than this program.",
        "None: no point was solved there. Answers of two versions in one table would not belong together.",
        "Another environment on the machine of the worker, or one that was changed after the worker was started.",
        "Install the same versions there, or share one environment, and start the worker again.",
        says=("install the same versions in the workers' environment", "cannot import this mbla"),
    ),
    Explanation(
        "scheduler-lost",
        "error",
        "The Dask scheduler, or all of its workers, are gone or were never there.",
        _POINTS,
        "It was ended or its machine went down, the jobs of the workers ran out or still queue, or the address, the "
        "port or the certificates are not right.",
        "See that `dask scheduler` and `dask worker` run, then go on with --resume.",
        says=("is gone; finished points are in the journal", "has had no worker for", "no connection to the scheduler"),
    ),
)
