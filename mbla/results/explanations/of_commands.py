"""Errors of commands, files and solvers: what is told without a place in a deck."""

from __future__ import annotations

from mbla.results.explanations.explanation import Explanation
from mbla.results.explanations.of_errors import refused


def _error(identifier: str, title: str, cause: str, remedy: str, example: str = "") -> Explanation:
    return refused(identifier, title, cause, remedy, example=example, kind="error")


OF_FILES = (
    _error("bad-file-name", "A file name cannot be one.", "It holds a zero byte or is far too long.", "Correct it."),
    _error(
        "file-missing",
        "A file or folder does not exist.",
        "A misspelt name, or one relative to another folder: files of a deck are relative to the deck.",
        "Correct the name, or make the folder.",
    ),
    _error(
        "not-a-regular-file",
        "What is named is no file with content.",
        "A folder, a pipe or a device.",
        "Name a file.",
    ),
    _error(
        "folder-given",
        "A folder stands where a file belongs.",
        "The name of a file is missing behind that of its folder, or a folder has the name of the file to be written.",
        "Name the file.",
    ),
    _error(
        "file-unreadable",
        "A file cannot be opened or read.",
        "The system's reason is in the message: permissions, a lost network drive, a failing disk.",
        "Remove the reason; ls -l shows the permissions.",
    ),
    _error(
        "file-not-written",
        "A file cannot be written.",
        "The system's reason is in the message: a full disk, a read-only folder, a quota.",
        "Make room, or write elsewhere with -o.",
    ),
    _error(
        "file-system",
        "The operating system refused to read or write something.",
        "The message has its reason and the name where there is one.",
        "Remove the reason, then run again.",
    ),
    _error(
        "path-not-utf-8",
        "The path of a deck cannot be written in UTF-8.",
        "A name from a system with another encoding.",
        "Rename the file or folder.",
    ),
    _error(
        "current-folder-gone",
        "The folder in which the command was started has been deleted.",
        "Another program removed or replaced it.",
        "Change into a folder that exists.",
    ),
)

OF_USAGE = (
    _error(
        "command-line",
        "The command line cannot be understood.",
        "An unknown command or option, a missing argument, a value that an option does not take.",
        "mbla COMMAND --help lists what there is.",
        example="mbla: run: the following arguments are required: DECK",
    ),
    _error(
        "deck-invalid",
        "The deck, or the sweep file, has faults.",
        "Each fault has a line and an identifier of its own.",
        "See the identifiers of the faults; in Python `faults` lists them.",
    ),
    _error(
        "same-result-files",
        "Two decks of one command would write the same files.",
        "They have the same name and go into the same folder.",
        "Rename one, or run them with different -o.",
    ),
    _error(
        "explain-unknown",
        "Nothing is known by the name that was asked for.",
        "A misspelt identifier.",
        "mbla explain lists every identifier.",
    ),
    _error(
        "unknown-load-case",
        "A load case does not exist.",
        "A misspelt name behind --case, or that of another deck.",
        "Take one of those listed.",
    ),
    _error(
        "load-case-not-chosen",
        "There are several load cases, and one is needed.",
        "The command, or the property of a result, is about a single one.",
        "Choose one by --case, or by case() in Python.",
    ),
    _error(
        "no-expectations",
        "--expected has nothing to compare with.",
        "The deck has no section expected.",
        "Write one, or leave --expected out.",
    ),
    _error(
        "no-least-load-factor",
        "No least load factor of a load that travels is known.",
        "Not every position has a verified answer.",
        "Ask for load_factors, which has the answer at each position.",
    ),
    _error(
        "extra-missing",
        "A part of mbla is not installed.",
        "Pictures, reports, Parquet tables and clusters need libraries that are optional.",
        "pip install with the extra that the message names.",
        example="pip install 'mbla[pictures]'",
    ),
    _error(
        "no-opengl",
        "Pictures in space need OpenGL, and there is none.",
        "A machine without graphics libraries, often a container.",
        "Install libEGL or OSMesa.",
    ),
    _error(
        "output-format",
        "The name of an output file says a format that the command does not write.",
        "Pictures are PNG, SVG or PDF, animations GIF or MP4, reports HTML.",
        "Give the file a name that ends in one of these.",
    ),
    _error(
        "several-pictures-one-file",
        "Several pictures cannot go into one file.",
        "There are several load cases or kinds of picture.",
        "Choose one, or name a folder.",
    ),
    _error(
        "picture-option",
        "An option of pictures has a value that it does not take.",
        "An unknown kind or view, or a size out of range.",
        "Take what the message lists.",
    ),
    _error(
        "no-mechanism",
        "There is no mechanism to be animated.",
        "The load case has no collapse, or was not solved.",
        "Choose another load case; the status of this one says why.",
    ),
    _error(
        "table-option",
        "--table has nothing to choose from.",
        "It chooses tables for --csv and --parquet.",
        "Give one of these too.",
    ),
    _error("unknown-table", "A table does not exist.", "A misspelt name.", "Take one of those listed."),
    _error(
        "interact-option",
        "Options of mbla interact contradict each other, or are out of range.",
        "--loads goes with --from and --to, not with --case; the number of points has limits.",
        "Correct them as the message says.",
    ),
    _error(
        "interact-load",
        "The live loads of the deck cannot be turned or combined as mbla interact needs.",
        "Symmetry, a settlement, a kind of load without direction, or different dead loads.",
        "Give the whole structure and live loads of the kinds that the message names.",
    ),
    _error(
        "tradeoff-option",
        "A knob or a setting of mbla tradeoff is not understood.",
        "It is not KEY.PATH=VALUE,VALUE, has too many values, or a name is there twice.",
        "Write it as the message shows.",
    ),
    _error(
        "sweep-option",
        "Options of mbla sweep contradict each other.",
        "Such as --resume with --force, or a local number of processes with a scheduler.",
        "Leave one of them out.",
    ),
)

OF_SWEEPS = (
    _error(
        "sweep-exists",
        "A journal of an earlier sweep is there.",
        "It was interrupted, or finished before.",
        "--resume goes on with it; --force begins anew.",
    ),
    _error(
        "journal-changed",
        "The journal was changed while the sweep was writing it, or could not be written.",
        "Another program saved it, the disk is full, or its folder was moved.",
        "Leave the journal alone while a sweep runs, then go on with --resume.",
    ),
    _error(
        "locks-missing",
        "The journal of a sweep, or a folder of results, cannot be protected against a second run.",
        "A file system without locks, or a lock file that cannot be written.",
        "Write elsewhere with -o FOLDER.",
    ),
    _error(
        "sweep-table-damaged",
        "The table of a sweep cannot be read.",
        "A file is missing, changed by hand, or written by another version.",
        "Name the folder of the sweep; run it again with --resume, which writes its tables anew.",
    ),
    _error(
        "nothing-to-draw",
        "A sweep has nothing for the picture that is asked for.",
        "No points, no results with numbers, or a kind of picture that its design does not have.",
        "Choose another kind or result.",
    ),
    _error(
        "unknown-column",
        "A column does not exist in the table of a sweep.",
        "A misspelt parameter or result.",
        "Take one of those listed.",
    ),
    _error(
        "deck-changed",
        "A worker finds another deck than the one that was planned.",
        "The deck or a file that it names was changed, or the worker's machine has an older copy.",
        "Let all machines see the same files, then go on with --resume.",
    ),
    _error(
        "memory-limit-unknown",
        "The machine has no limit on the memory of a process.",
        "The operating system does not offer one.",
        "Leave limits.memory out.",
    ),
    _error(
        "worker-refused",
        "A worker cannot solve points.",
        "Its process does not start, or finds something else than was planned; the message says what.",
        "Correct that on the machine of the worker.",
    ),
    _error(
        "scheduler-file",
        "The file that tells the address of a scheduler cannot be used.",
        "It does not exist, is not from Dask, or is still being written.",
        "Start dask scheduler --scheduler-file FILE and give that file.",
    ),
)

OF_SOLVERS = (
    _error(
        "out-of-memory",
        "The memory of the machine is not enough.",
        "A model or a setting that is too large for it, or a limit (ulimit, batch system) that leaves too little.",
        "Use symmetry, fewer contact points, accuracy: draft, or a larger machine; or raise the limit.",
    ),
    _error(
        "solver-status",
        "A solver answered with a status that mbla does not know.",
        "A version of the solver that is newer than this mbla.",
        "Install the version of the solver that this mbla was tested with.",
    ),
    _error(
        "solver-unfit",
        "The solver that the deck names does not take programs of this kind.",
        "HiGHS solves linear programs; friction cones in space are not linear.",
        "Write friction_cone: polyhedral, or solver: auto.",
    ),
    _error(
        "unknown-solver",
        "A solver does not exist.",
        "A misspelt name in Python; decks are checked before.",
        "Take one of those listed.",
    ),
    _error(
        "solver-option",
        "A solver refuses an option.",
        "A value out of its range, or another version of the solver.",
        "Change the setting that the message names.",
    ),
    _error(
        "program-not-finite",
        "The program to be solved holds numbers that are not finite.",
        "Loads, strengths or coordinates so large that products of them overflow.",
        "Check the units; report it where they are right.",
    ),
    _error(
        "factorisation-missing",
        "A factorisation that was asked for does not work here.",
        "Its library is not installed, or failed in a small trial.",
        "Install it, or leave the choice to the program.",
    ),
    _error(
        "block-refused",
        "Blocks made in Python are no sound solids.",
        "Open surfaces, faces that are not planar, or degenerate shapes; a line for each.",
        "Correct the vertices or faces of the blocks named.",
    ),
    _error(
        "internal-error",
        "A defect of the program.",
        "Something that the program does not expect of itself.",
        "Report it with the deck; MBLA_TRACEBACK=1 in the environment shows where it arose.",
    ),
)

OF_COMMANDS = (*OF_FILES, *OF_USAGE, *OF_SWEEPS, *OF_SOLVERS)
