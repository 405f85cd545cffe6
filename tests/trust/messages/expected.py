"""The exact lines of the errors in ``cases.py``, by the name of the function; {folder} is its folder."""

EXPECTED: dict[str, tuple[str, ...]] = {
    "name_with_a_zero_byte": ("is not a file name  [bad-file-name]",),
    "deck_beyond_all_size": (
        "{folder}/deck.yaml:1:1 is larger than 1 MB: put large geometry in a mesh file (`mesh: {file: "
        "...}`)  [file-too-large]",
    ),
    "list_beyond_all_length": (
        "{folder}/deck.yaml:10:54 blocks[0].box.min[2]: is one item too many: a list has at most 100,000  "
        "[too-many-entries]",
    ),
    "geometry_beyond_all_size": (
        "{folder}/deck.yaml:10:49 blocks[0].mesh.file = wall.obj: is larger than 1 MB: divide it into several files  "
        "[geometry-too-large]",
    ),
    "deck_in_latin_1": ("{folder}/deck.yaml:2:9 byte 0xF6 is not UTF-8: save the deck as UTF-8  [not-utf-8]",),
    "folder_for_a_deck": ("mbla: {folder}: is a folder, not a deck  [folder-given]",),
    "deck_for_a_folder_that_is_not_there": (
        "mbla: {folder}/none/deck.yaml: there is no folder {folder}/none  [file-missing]",
    ),
    "deck_that_is_not_there": (
        "mbla: {folder}/none.yaml: cannot be opened: No such file or directory  [file-unreadable]",
    ),
    "deck_that_is_a_device": ("mbla: /dev/null: is not a regular file  [not-a-regular-file]",),
    "starter_below_a_file": (
        "mbla: "
        "{folder}/nnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnn"
        "nnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnn"
        "nnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnn"
        "nnnnnnnnnnnnnnnnnnnnn.yaml: File name too long  [file-not-written]",
    ),
    "disk_that_fails": ("deck.yaml: Input/output error  [file-system]",),
    "memory_that_is_used_up": ("out of memory  [out-of-memory]",),
    "defect_of_the_program": (
        "mbla: internal error, please report it with the deck: ZeroDivisionError: first second  [internal-error]",
    ),
    "deck_with_a_name_of_bytes": (
        "/decks/a\udcff.yaml: the path is not UTF-8, results cannot name it; rename it  [path-not-utf-8]",
    ),
    "folder_that_was_removed": ("mbla: the current folder does not exist any more  [current-folder-gone]",),
    "starter_over_an_earlier_deck": ("mbla: {folder}/deck.yaml: exists already; --force replaces it  [result-exists]",),
    "result_of_zeros": ("mbla: {folder}/a.h5: not an HDF5 file  [damaged-result-file]",),
    "result_of_an_earlier_layout": (
        "mbla: {folder}/tower.h5: layout version 1, written by mbla 0.1.0; this mbla reads version 5: "
        "run the deck again; its text is in /deck/source_texts  [old-result-file]",
    ),
    "command_without_a_deck": ("mbla: run: the following arguments are required: DECK  [command-line]",),
    "two_decks_of_one_name": (
        "mbla: two of the decks would write the same result files: give them different names or folders  "
        "[same-result-files]",
    ),
    "identifier_that_nothing_has": (
        "mbla: explain xyzzy: nothing is known by that name; mbla explain lists every identifier  [explain-unknown]",
    ),
    "load_case_that_the_deck_lacks": ("mbla: no load case pull in the deck; it has push  [unknown-load-case]",),
    "nothing_expected": ("mbla: {folder}/deck.yaml: has no expected section to compare with  [no-expectations]",),
    "result_of_several_load_cases": (
        "the result has 2 load cases; name one with case(): push_x, pull  [load-case-not-chosen]",
    ),
    "cluster_without_dask": (
        "several processes and clusters need an extra that is not installed: pip install 'mbla[dask]'  [extra-missing]",
    ),
    "picture_as_a_text": (
        "mbla: {folder}/a.bmp: pictures are written as PNG, SVG or PDF, by the name of the file  [output-format]",
    ),
    "picture_of_an_unknown_kind": ("mbla: --dpi 9: 20 to 1200 dots per inch  [picture-option]",),
    "pictures_in_one_file": (
        "mbla: {folder}/a.png: one file for 3 pictures; name one with --case and --kind, or a folder  "
        "[several-pictures-one-file]",
    ),
    "film_of_what_stands_still": (
        "load case push_x: there is no mechanism, so there is nothing to animate  [no-mechanism]",
    ),
    "table_that_is_none": (
        "no table walls; there are cases, blocks, interfaces, points, reactions, programs, iterations, "
        "path, series, notices  [unknown-table]",
    ),
    "angles_of_directions": ("mbla: --from and --to apply with --loads; directions go all around  [interact-option]",),
    "load_without_a_horizontal_part": (
        "mbla: load case push: no live load has a horizontal part that could be turned  [interact-load]",
    ),
    "knob_without_a_value": ("mbla: --knob analysis.accuracy: must be KEY.PATH=VALUE,VALUE,...  [tradeoff-option]",),
    "open_block_in_python": (
        "block block[0]: is not closed: 3 edges, first that between vertices 1 and 2, have one face "
        "only, face 0  [block-refused]",
    ),
    "blocks_in_one_place": (
        "{folder}/deck.yaml:10:3 blocks: block[0] and block[1] overlap by 0.0833 m, 0.083 of the block "
        "size: move them apart, or set contacts.tolerance above 0.087 if they are meant to touch  "
        "[blocks-overlap]",
    ),
    "table_full_of_words": (
        "{folder}/deck.yaml:16:20 load_cases.push.live[0].table = loads.csv: loads.csv:2: fx = word: "
        "must be a finite number  [table-number]",
        "{folder}/deck.yaml:16:20 load_cases.push.live[0].table = loads.csv: loads.csv:3: fx = word: "
        "must be a finite number  [table-number]",
        "{folder}/deck.yaml:16:20 load_cases.push.live[0].table = loads.csv: loads.csv:4: fx = word: "
        "must be a finite number  [table-number]",
        "{folder}/deck.yaml:16:20 load_cases.push.live[0].table = loads.csv: loads.csv:5: fx = word: "
        "must be a finite number  [table-number]",
        "{folder}/deck.yaml:16:20 load_cases.push.live[0].table = loads.csv: loads.csv:6: fx = word: "
        "must be a finite number  [table-number]",
        "{folder}/deck.yaml:16:20 load_cases.push.live[0].table = loads.csv: loads.csv:7: fx = word: "
        "must be a finite number  [table-number]",
        "{folder}/deck.yaml:16:20 load_cases.push.live[0].table = loads.csv: loads.csv:8: fx = word: "
        "must be a finite number  [table-number]",
        "{folder}/deck.yaml:16:20 load_cases.push.live[0].table = loads.csv: loads.csv:9: fx = word: "
        "must be a finite number  [table-number]",
        "{folder}/deck.yaml:16:20 load_cases.push.live[0].table = loads.csv: loads.csv:10: fx = word: "
        "must be a finite number  [table-number]",
        "{folder}/deck.yaml:16:20 load_cases.push.live[0].table = loads.csv: loads.csv:11: fx = word: "
        "must be a finite number  [table-number]",
        "{folder}/deck.yaml:16:20 load_cases.push.live[0].table = loads.csv: 2 more faults of this table "
        " [more-faults]",
    ),
    "table_that_is_empty": (
        "{folder}/deck.yaml:16:20 load_cases.push.live[0].table = loads.csv: loads.csv: is empty: its "
        "first line must name the columns group, index, fx, fy and fz  [table-unreadable]",
    ),
    "status_of_another_version": ("HiGHS returned a status that is not known: kOptimal  [solver-status]",),
    "quadratic_program_for_highs": (
        "HiGHS solves linear programs only, and this one has cones or a quadratic term  [solver-unfit]",
    ),
    "solver_that_is_none": (
        "there is no cone solver simplex; there are auto, mbla, clarabel, highs  [unknown-solver]",
    ),
    "limit_below_zero": ("HiGHS refuses the option ipm_iteration_limit = -5  [solver-option]",),
    "program_with_an_infinite_cost": ("the cone program holds numbers that are not finite  [program-not-finite]",),
    "factorisation_that_is_none": (
        "there is no factorisation mumps: it is one of qdldl, superlu, cholmod  [factorisation-missing]",
    ),
    "resume_and_force": ("--resume goes on with the journal and --force begins anew: one of them  [sweep-option]",),
    "sweep_that_was_run": (
        "{folder}/journal.csv: exists already; --resume goes on with it, --force begins anew and drops "
        "what it holds, -o FOLDER writes elsewhere  [sweep-exists]",
    ),
    "journal_of_something_else": (
        "{folder}/journal.csv: is no journal of a sweep; --force begins anew and drops what it holds, -o "
        "FOLDER writes elsewhere  [journal-damaged]",
    ),
    "journal_of_another_deck": (
        "{folder}/journal.csv: is of another base deck, or of one that has changed since: it cannot be "
        "gone on with; --force begins anew and drops what it holds, -o FOLDER writes elsewhere  "
        "[journal-of-another-sweep]",
    ),
    "file_system_without_locks": (
        "{folder}/sweep: its file system has no locks to keep two runs apart; -o FOLDER writes elsewhere "
        " [locks-missing]",
    ),
    "sweep_that_is_running": (
        "{folder}/journal.csv: another process is at work on it; wait for its end or stop it  [another-run-at-work]",
    ),
    "folder_without_a_table": (
        "mbla: {folder}/sweep.json: there is none; mbla sweep writes sweep.csv and sweep.json into one "
        "folder  [sweep-table-damaged]",
    ),
    "map_of_one_parameter": (
        "--kind map of load_factor: needs two parameters of a grid with two values each  [nothing-to-draw]",
    ),
    "column_of_another_sweep": ("--by nu: unknown parameter; the sweep has: mu  [unknown-column]",),
    "constraints_that_leave_nothing": (
        "{folder}/sweep.yaml:4:14 constraints = [mu > 1]: leave none of 1 point: mu > 1 is broken by 1  "
        "[sweep-no-point]",
    ),
    "constraint_that_compares_nothing": (
        '{folder}/sweep.yaml:4:15 constraints[0] = mu: is no comparison: write one such as "t < '
        '0.2*radius"  [wrong-comparison]',
    ),
    "plan_of_another_program": ("its mbla is 0.2.0+fedcba, the sweep was planned by 0.1.0+abcdef  [workers-differ]",),
    "plan_of_another_deck": (
        "{folder}/base.yaml on stone is not the deck that was planned: it, or a file that it names, is "
        "another or changed  [deck-changed]",
    ),
    "machine_without_limits": (
        "limits.memory: plan9 has no limit on the memory of a process; leave it out  [memory-limit-unknown]",
    ),
    "scheduler_without_workers": (
        "the scheduler tcp://stone:8786 is gone; finished points are in the journal, --resume goes on "
        "with the rest  [scheduler-lost]",
    ),
    "scheduler_file_that_is_not_there": (
        "--scheduler-file {folder}/s.json: there is no such file; `dask scheduler --scheduler-file` "
        "writes it  [scheduler-file]",
    ),
    "machine_without_opengl": (
        "pictures need OpenGL, with or without a display: install libEGL (Debian: apt install libegl1) "
        "or OSMesa  [no-opengl]",
    ),
    "load_that_travels_without_an_answer": (
        "truck: no least load factor is known; ask load_factors for each position  [no-least-load-factor]",
    ),
    "worker_that_does_not_start": (
        "the process that solves points cannot be started: its process ended with status 3  [worker-refused]",
    ),
    "value_that_no_type_describes": ("deck.yaml:2:8 title = 1: is not as it should be  [wrong-value]",),
}
