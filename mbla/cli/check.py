"""``mbla check``: read, build, find contacts, say what the model is and what solving it needs; solve nothing."""

from __future__ import annotations

import time
from dataclasses import asdict, replace

import numpy as np

from mbla.contacts import Contacts
from mbla.contacts.glue import held_model, solids_of
from mbla.deck import Deck
from mbla.model import Model, build_model
from mbla.model.model import LoadCase
from mbla.program import assemble
from mbla.program.choice import has_conditions_on_interfaces
from mbla.program.kinematic import ConeProgram, kinematic_form
from mbla.program.reductions.steps import glued_step
from mbla.results.deck_record import deck_record
from mbla.results.files import OutputFolder
from mbla.results.needs import CaseNeeds
from mbla.results.provenance import collect_provenance
from mbla.results.results import Results
from mbla.results.settings_words import settings_in_words
from mbla.results.vtu.mesh_files import write_model_vtu
from mbla.run import contacts_of, notices_of, reduced_program, select_cases
from mbla.run_options import RunOptions
from mbla.solution.cone_solvers.choice import interior_point_method
from mbla.solution.settings import solver_settings

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
    contacts = contacts_of(deck, model)
    model = held_model(model, contacts)
    results = Results(
        deck=deck_record(deck),
        model=model,
        contacts=contacts,
        cases=(),
        notices=notices_of(deck, model, contacts),
        provenance=collect_provenance(),
        settings=settings_in_words(deck, solver_settings(deck.analysis)),
        time={"read": read - started, "contacts": time.perf_counter() - read},
        exit_code=0,
    )
    if vtu:
        with OutputFolder(options.folder_for(deck.path), f"{deck.path.stem}_check", options.force) as out:
            write_model_vtu(results, out)
    return results, {case.name: needs_of(deck, model, contacts, case) for case in select_cases(model, options.cases)}


def needs_of(deck: Deck, model: Model, contacts: Contacts, load_case: LoadCase) -> CaseNeeds:
    """What of the model reaches the solver, the size of its first cone programs, and who solves them."""
    model = model.of_case(load_case)
    solids = solids_of(model, contacts)
    on_solids = (solids.model, solids.contacts, solids.load_case(load_case))
    reduced = reduced_program(deck, solids, assemble(*on_solids))
    conditions = has_conditions_on_interfaces(deck.analysis, solids.model, solids.contacts)
    if conditions:
        from mbla.program.resultants import assemble_convex, convex_form
        from mbla.program.resultants.assemble import size_of_convex

        convex = assemble_convex(*on_solids, deck.analysis.contact_model)
        reduced = replace(reduced, steps=(glued_step(solids, size_of_convex(convex)),))
        unknowns, programs = len(convex.program.dead_load), [convex_form(convex).cone_program]
    else:
        unknowns = sum(len(part.dead_load) for part in reduced.parts)
        programs = [kinematic_form(part, part.limits).cone_program for part in reduced.parts if np.any(part.live_load)]
    further = [size for program in programs for size in program.further_cones]
    counts = asdict(reduced.size) | {
        "unknown_velocities": unknowns,
        "cones": sum(program.n_cones for program in programs) + sum(size > 1 for size in further),
        "half_lines": sum(program.n_half_lines for program in programs) + further.count(1),
        "matrix_entries": sum(int(program.matrix.nnz) for program in programs),
        "solver": ", ".join(dict.fromkeys(_solver(deck, program, conditions) for program in programs)),
    }
    return CaseNeeds(counts, reduced.steps)


def _solver(deck: Deck, program: ConeProgram, conditions: bool) -> str:
    """Of the associative program; conditions on interfaces have cones of dimensions that clarabel alone takes."""
    if conditions:
        return "clarabel"
    return "highs" if deck.analysis.solver == "highs" else interior_point_method(program, deck.analysis.solver)
