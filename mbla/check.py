"""``mbla check``: read, build, find contacts, say what the model is and what solving it needs; solve nothing."""

from __future__ import annotations

import time
from pathlib import Path

from mbla.deck import read_deck
from mbla.model import build_model
from mbla.program import assemble
from mbla.program.kinematic import kinematic_form
from mbla.results.files import OutputFolder
from mbla.results.provenance import collect_provenance
from mbla.results.results import Results
from mbla.results.vtu import write_model_vtu
from mbla.run import RunOptions, contacts_of, deck_record, notices_of, settings_in_words
from mbla.solution.settings import solver_settings


def check(deck_path: Path, options: RunOptions, vtu: bool = False) -> tuple[Results, dict[str, int]]:
    """Results without cases, and the size of the cone program of one load case by name of what is counted.

    vtu : also write STEM_check_blocks.vtu and STEM_check_interfaces.vtu into the output folder

    Raises
    ------
    DeckError, FileError
        as ``run`` does
    """
    started = time.perf_counter()
    deck = read_deck(deck_path, options.overrides)
    model = build_model(deck)
    read = time.perf_counter()
    contacts = contacts_of(deck, model)
    results = Results(
        deck=deck_record(deck),
        model=model,
        contacts=contacts,
        cases=(),
        notices=notices_of(deck, model, contacts),
        provenance=collect_provenance(),
        settings=settings_in_words(deck, solver_settings(deck.analysis, options.threads)),
        time={"read": read - started, "contacts": time.perf_counter() - read},
        exit_code=0,
    )
    if vtu:
        with OutputFolder(options.folder_for(deck_path), f"{deck_path.stem}_check", options.force) as out:
            write_model_vtu(results, out)
    program = assemble(model, contacts, model.load_cases[0])
    cone_program = kinematic_form(program, program.limits).cone_program
    needs = {
        "unknown_velocities": len(program.dead_load),
        "cones": cone_program.n_cones,
        "half_lines": cone_program.n_half_lines,
        "matrix_entries": int(cone_program.matrix.nnz),
    }
    return results, needs
