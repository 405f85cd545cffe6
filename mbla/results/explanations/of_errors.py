"""Faults of decks and files, by what their messages say."""

from __future__ import annotations

from mbla.results.explanations.explanation import Explanation, Kind

_NONE = "Nothing was computed and nothing written; an earlier result stays as it was."


def refused(
    identifier: str,
    title: str,
    cause: str,
    remedy: str,
    *says: str,
    example: str = "",
    kind: Kind = "error in a deck",
) -> Explanation:
    """An entry of an error; ``says``: parts of its messages by which a pasted one is recognised."""
    return Explanation(identifier, kind, title, _NONE, cause, remedy, example=example, says=says)


OF_DECKS = (
    refused(
        "not-yaml",
        "The file cannot be read as YAML.",
        "An unclosed bracket or quote, a tab, wrong indentation; the place given is where reading failed.",
        "Correct it there or in the lines before.",
        "not YAML:",
    ),
    refused(
        "yaml-not-allowed",
        "YAML features that decks do not have.",
        "Anchors, aliases, merge keys, tags, a second document.",
        "Write the value out, or use `parameters` and `include`.",
        "are not allowed",
        "a second document begins here",
    ),
    refused(
        "duplicate-key",
        "A key is given twice.",
        "YAML itself would silently take the last one.",
        "Leave one of them out.",
        "is given twice",
    ),
    refused(
        "unknown-key",
        "A key that decks do not have.",
        "A misspelt key, or one at the wrong level; nothing is ignored.",
        "The message lists what is allowed and suggests the nearest; README and the JSON Schema list all.",
        "unknown key",
        example="joints.dry.fricton: unknown key; did you mean friction?",
    ),
    refused(
        "unknown-name",
        "A material, joint law, group, load case or member that the deck does not have.",
        "A misspelt name; a group that no item makes.",
        "The message lists the known ones.",
        "unknown material",
        "unknown joint law",
        "unknown group",
        "unknown load case",
        "unknown member",
    ),
    refused(
        "missing-key",
        "A key that must be given is missing.",
        "A required key was left out; or one of several of which exactly one is needed.",
        "Give it.",
        "is missing:",
        "needs one of",
    ),
    refused(
        "not-a-number",
        "A value is no finite number, or outside of what is allowed.",
        "Words, booleans, lists, infinite values; a negative or zero value where that means nothing.",
        "The message says what is allowed.",
        "must be a number",
        "must be a finite number",
        "write the number without quotes",
    ),
    refused(
        "wrong-unit",
        "A text with a unit that measures something else, or an unknown unit.",
        "Mass for force, a stress for a force, a typing error.",
        "Write it as the example in the message, or as a plain number in the deck's units.",
        "has an unknown unit",
        "must be a number without a unit",
    ),
    refused(
        "wrong-expression",
        'An expression "=..." cannot be computed.',
        "Unknown parameters or functions, a division by zero, parameters that refer to themselves.",
        "Correct it; powers are written **.",
        "divides by zero",
        "unknown parameter",
        "refers to itself",
        "cannot be read as an expression",
    ),
    refused(
        "key-of-another-choice",
        "A key that applies to another choice only.",
        "Keys that exclude each other, such as a rise of a semicircular arch.",
        "Leave it out or change the choice that the message names.",
        "applies to",
    ),
    refused(
        "file-outside-folder",
        "A file outside of the deck's folder.",
        "A deck reads files of its own folder tree only, so that decks of others can be run safely.",
        "Copy the file into the deck's folder.",
        "leads out of the folder tree",
        "must be a path relative to the file",
    ),
    refused(
        "geometry-file",
        "A geometry file cannot be read.",
        "It does not exist, is of an unknown kind, not well-formed, or holds no blocks.",
        "Export it again as OBJ, PLY, STL, VTU, Gmsh, CalculiX, glTF, COMPAS or DXF.",
        "does not exist",
        "unknown kind of geometry file",
        "is not a well-formed",
        "holds no blocks",
    ),
)

OF_STRUCTURES = (
    refused(
        "open-polyhedron",
        "A block is not closed.",
        "A face is missing, or neighbouring faces miss each other by more than the tolerance.",
        "Add the face; for gaps of an export raise contacts.tolerance, or set `weld`.",
        "is not closed",
        example="block vault[1] (open): is not closed: 3 edges have one face only",
    ),
    refused(
        "bad-polyhedron",
        "A block is no simple solid.",
        "It intersects itself, has no volume, faces without area or listed twice, or is several pieces.",
        "Correct it where it was made.",
        "intersects itself",
        "has no volume",
        "separate pieces",
        "more than two faces",
        "have the same corners",
    ),
    refused(
        "face-not-planar",
        "A face of a block is not planar.",
        "Corners leave the plane by more than contacts.tolerance of the block size.",
        "Split the face, or raise contacts.tolerance for rounded coordinates.",
        "is not planar:",
    ),
    refused(
        "no-support",
        "Nothing holds the structure.",
        "supports is empty or missing.",
        "Give a ground plane or fixed blocks.",
        "nothing holds the structure",
        example="supports: [{ground: {z: 0}}]",
    ),
    refused(
        "nothing-can-move",
        "Every block is fixed or glued to a support.",
        "A selector of supports that takes all blocks; glue everywhere.",
        "Let blocks be free.",
        "nothing can move",
    ),
    refused(
        "ground-misplaced",
        "A ground plane lies off the structure, or through it.",
        "A wrong height or direction of the plane, or units of a file.",
        "Move the plane to the foot of the structure, or name the blocks that it carries.",
        "move the plane, or name the blocks",
        "no face of a block that can move lies on it",
    ),
    refused(
        "empty-selector",
        "A selector selects no block.",
        "An index that does not exist, an empty box, a position that the blocks do not have.",
        "Correct it; mbla check lists groups, members and positions.",
        "there is no such block",
        "lies in it; they lie between",
        "these blocks have no",
    ),
    refused(
        "live-load-without-effect",
        "A live load does nothing.",
        "It is zero, cancels another, or acts on blocks that cannot move.",
        "A load factor needs a load: correct its size, direction or blocks.",
        "live load with no effect",
        "the live load has no effect",
        "the live loads have no effect",
        "the live loads cancel each other",
        "the supports take every live load",
    ),
    refused(
        "load-beside-structure",
        "A line, path or pressure misses the blocks.",
        "It lies over no block, or on no free face.",
        "Shorten it, or look in another direction with `towards`.",
        "lie over no block",
        "no face of these blocks lies so",
    ),
    refused(
        "too-many-units",
        "An item makes more than can be handled.",
        "Mostly a length in another unit than the unit size.",
        "Check the units of the deck and of the item.",
        "can be handled",
    ),
    refused(
        "symmetry-broken",
        "What is given does not fit the plane of symmetry.",
        "Blocks across the plane, loads across it, supports in it.",
        "Give one side, name halved blocks with `halves`, or give the whole structure.",
        "give the blocks on one side",
        "acts across the plane of symmetry",
    ),
)

OF_RUNS = (
    refused(
        "result-exists",
        "An earlier result is not overwritten.",
        "The folder of the results holds some already.",
        "--force, or -o DIR.",
        "--force",
        kind="error",
    ),
    refused(
        "old-result-file",
        "A result file was written with another layout.",
        "Its version differs from that of this program.",
        "Run the deck again; its text is in the file under /deck/source_texts.",
        "layout version",
        kind="error",
    ),
    refused(
        "damaged-result-file",
        "A result file is damaged or not one of mbla.",
        "An incomplete copy, another program's file, a failing disk, or a file that was changed after the run: check "
        "sums do not fit.",
        "Copy it again, or run the deck again.",
        "not an mbla result file",
        "not an HDF5 file",
        "damaged:",
        "no check sum at its end",
        "its check sum does not fit",
        kind="error",
    ),
)

OF_ERRORS = (*OF_DECKS, *OF_STRUCTURES, *OF_RUNS)
