"""What a deck is: read, build, find contacts, say what the model is and what solving it needs; solve nothing."""

from __future__ import annotations

import time
from dataclasses import asdict

import numpy as np

from mbla.assembly import Assembly, build_assembly
from mbla.deck import Deck
from mbla.model import build_model
from mbla.model.model import LoadCase, select_cases
from mbla.process.run_options import RunOptions
from mbla.program.build import build_program
from mbla.program.kinematic import kinematic_form
from mbla.results.files import OutputFolder
from mbla.results.provenance import CaseNeeds, results_before
from mbla.results.results import Results
from mbla.solution.cone_solvers.choice import interior_point_method
from mbla.solution.settings import settings_for, solver_settings

Needs = dict[str, CaseNeeds]
"""By the name of the load case."""


def check(deck: Deck, options: RunOptions, vtu: bool, started: float) -> tuple[Results, Needs]:
    """Results without cases, and what solving each load case needs.

    vtu     : also write STEM_check_blocks.vtu and STEM_check_interfaces.vtu into the output folder
    started : when reading began, by ``time.perf_counter``

    Raises
    ------
    DeckError, FileError
        as ``run`` does
    """
    model = build_model(deck)
    read = time.perf_counter()
    assembly = build_assembly(deck, model)
    settings, seconds = solver_settings(deck.analysis), {"read": read - started, "contacts": time.perf_counter() - read}
    results = results_before(deck, assembly, settings, seconds)
    if vtu:
        from mbla.results.vtu.mesh_files import write_model_vtu

        with OutputFolder(options.folder_for(deck.path), f"{deck.path.stem}_check", options.force) as out:
            write_model_vtu(results, out)
    return results, {case.name: needs_of(deck, assembly, case) for case in select_cases(model, options.cases)}


def needs_of(deck: Deck, assembly: Assembly, load_case: LoadCase) -> CaseNeeds:
    """What of the model reaches the solver, the size of its first cone programs, and who solves them.

    Of a load case without a load factor those of its state at rest.
    """
    load_case = load_case if load_case.has_load_factor else load_case.dead_alone
    analysis = settings_for(load_case, solver_settings(deck.analysis)).analysis
    built = build_program(assembly, load_case, analysis)
    reduced = built.reduced
    unknowns = sum(len(part.with_own_motions.dead_load) for part in reduced.parts)
    programs = [kinematic_form(part, part.limits).cone_program for part in reduced.parts if np.any(part.live_load)]
    further = [size for program in programs for size in program.further_cones]
    counts = asdict(reduced.size) | {
        "unknown_velocities": unknowns,
        "cones": sum(program.n_cones for program in programs) + sum(size > 1 for size in further),
        "half_lines": sum(program.n_half_lines for program in programs) + further.count(1),
        "matrix_entries": sum(int(program.matrix.nnz) for program in programs),
        "solver": ", ".join(
            dict.fromkeys(interior_point_method(program, deck.analysis.solver) for program in programs)
        ),
    }
    return CaseNeeds(counts, reduced.steps)
