"""Faults of decks, sweep files and the files that they name, told with file, line and column."""

from __future__ import annotations

from mbla.results.explanations.of_errors import refused

OF_TEXTS = (
    refused(
        "control-character",
        "A text holds a control character.",
        "Binary content, or an escape such as \\0 in quotes; it could change what a terminal shows.",
        "Delete the character; the place is told.",
        example="title: control characters are not allowed in a text",
    ),
    refused(
        "not-utf-8",
        "The file is not UTF-8 text.",
        "An editor saved it as UTF-16, Latin-1 or Windows text.",
        "Save it as UTF-8.",
        example="byte 0xE9 is not UTF-8: save the deck as UTF-8",
    ),
    refused(
        "file-too-large",
        "A deck is larger than can be read.",
        "Geometry written out in YAML, or the wrong file.",
        "Put large geometry into a mesh or a table file and name it in the deck.",
    ),
    refused(
        "too-many-files",
        "A deck includes more files than are read.",
        "A generated list, or a pattern that matched a whole folder.",
        "Put what belongs together into one file.",
    ),
    refused(
        "too-many-entries",
        "A mapping has more keys, or a list more items, than are read.",
        "Geometry written out in YAML, or a program that wrote the same thing again and again.",
        "Put large geometry into a mesh or a table file and name it in the deck, or use `repeat`.",
        example="masses[100000]: is one item too many: a list has at most 100,000",
    ),
    refused(
        "nested-too-deeply",
        "Lists or mappings lie in each other at more levels than any deck needs.",
        "Unbalanced brackets, or a file that is no deck.",
        "Close the brackets; no section of a deck needs more than a few levels.",
    ),
    refused(
        "not-a-mapping",
        "The file holds no mapping of keys to values.",
        "An empty file, a list, or a single text.",
        "Begin with mbla: 1 for a deck, mbla_sweep: 1 for a sweep file; mbla new NAME writes a deck to start from.",
    ),
    refused(
        "key-not-text",
        "A key is no text, or is missing before its colon.",
        "YAML reads 1, true or a list in the place of a key as what they are.",
        "Write the key in quotes, or give the missing one.",
    ),
    refused(
        "no-value",
        "A key has no value.",
        "Nothing stands behind the colon, or behind the = of --set; null counts as nothing.",
        "Give a value, or leave the key out: then its default is taken.",
    ),
    refused(
        "include-refused",
        "A file cannot be included.",
        "It includes itself by a circle, is no .yaml file, or there are too many.",
        "Break the circle, or merge files.",
        example="include[0]: includes a file that includes it in turn",
    ),
    refused(
        "set-refused",
        "An override by --set, set= or `set` of a sweep file cannot be applied.",
        "It is not key.path=value on one line, its path leads below a single value or to an item that does not exist, "
        "or it would set include.",
        "Write the key path as it stands in the deck; items of lists count from 0.",
        example="--set joints.dry.friction=0.5 --set blocks.0.box.max.2=1.2",
    ),
)

OF_VALUES = (
    refused(
        "wrong-type",
        "A value is of another type than its key takes.",
        "A single value where a list or a mapping belongs, a word for a switch, a number for a text.",
        "The message says which type: a list is written [...], a mapping {key: value}.",
        example="supports = 3: must be a list: [...]",
    ),
    refused(
        "wrong-length",
        "A list has too many or too few items.",
        "A vector has three numbers, a pair two selectors, and some lists need a least number of items.",
        "Give as many as the message says.",
        example="min = [0, 0]: needs 3 numbers, has 2",
    ),
    refused(
        "wrong-text",
        "A name or a text has characters, or a length, that are not allowed.",
        "Blanks or signs in a name, line breaks in a title, an empty text.",
        "Take letters, digits and . _ - for names, beginning with a letter, digit or _.",
    ),
    refused(
        "wrong-value",
        "A value is not what its key takes.",
        "It has a form that no other message describes.",
        "Compare with the key reference in the README.",
    ),
    refused(
        "unknown-choice",
        "A value is none of the words that a key takes.",
        "A misspelt word, or one of another key.",
        "Take one of those listed.",
        example="bond = runing: must be running, stretcher or stack; did you mean running?",
    ),
    refused(
        "out-of-bounds",
        "A number, or a place, is outside of what is allowed.",
        "A sign, a unit, or two values that do not fit each other, such as a hole that is wider than its dome.",
        "Keep within the bound of the message, which names the other value where it depends on one.",
        example="joints.bed.friction = -0.6: must be >= 0",
    ),
    refused(
        "zero-vector",
        "A direction, axis or normal has no length.",
        "All three numbers are zero.",
        "Give the direction; its size does not matter.",
    ),
    refused(
        "one-of-several",
        "Keys are given of which only one may be.",
        "Both say the same thing in two ways.",
        "Leave out all but one.",
        example="joints.dry.friction_angle: only one of friction or friction_angle may be given",
    ),
    refused(
        "reserved-name",
        "A name means something else already.",
        "It is a function or constant of expressions, a joint law that every deck has, or the word for the ground.",
        "Choose another name.",
    ),
    refused(
        "replaced-key",
        "A key of an earlier version of the deck format.",
        "The key has another name or place now.",
        "Write the key that the message names.",
    ),
    refused(
        "key-of-another-program",
        "A key of other programs that has no meaning here.",
        "Rigid blocks have no stiffness: the collapse load does not depend on it.",
        "Leave it out, or do as the message says.",
    ),
)

OF_ITEMS = (
    refused(
        "wall-shape",
        "A wall, an opening, a gable or a buttress cannot be built in courses as it is given.",
        "An opening off the bed joints, a lintel or a buttress that reaches into something, walls that meet neither "
        "at a line nor clear of each other, a plan whose corners are no right angles.",
        "Move or resize the part that the message names; openings lie on bed joints.",
        example="openings[0].from[1] = 0.1: must lie on a bed joint; the nearest are 0 and 0.15",
    ),
    refused(
        "arch-shape",
        "An arch or a bridge cannot be built as it is given.",
        "Too few or too many voussoirs for the curve, joints that cross, springings that a pier cannot carry, points "
        "that coincide.",
        "Change the number of voussoirs, the thickness, or the curve, as the message says.",
    ),
    refused(
        "vault-shape",
        "A dome or a vault cannot be built as it is given.",
        "Springings that cannot lie on level ground, a pointed curve that needs a keystone, a drum that its courses "
        "do not fit.",
        "Take the choice that the message names.",
    ),
    refused(
        "geometry-options",
        "A mesh item lacks what its kind of file needs.",
        "A drawing of outlines has no thickness of its own.",
        "Give extrude, the thickness.",
    ),
    refused(
        "more-faults",
        "There are more faults of the same kind, which are only counted.",
        "Mostly one reason for all: a mesh of the wrong scale or kind, a table with another column order.",
        "Correct those that are told, then run again.",
    ),
    refused(
        "one-block-only",
        "A force, moment or mass at a point needs one block, and none or several are selected.",
        "`on` is missing, or names a group with several blocks.",
        "Give an index, a member or a position, or one load for each block.",
        example="on = wall: a force acts on one block, 33 are selected: give an index, or one force for each",
    ),
    refused(
        "load-misplaced",
        "A load stands where it cannot.",
        "travel and tilt are live loads, alone in their load case; named loads contain each other in a circle.",
        "Move it as the message says.",
    ),
    refused(
        "degenerate-line",
        "A line or a path of a load has no length, or no side.",
        "Two points are the same, or the direction to look for blocks runs along the line.",
        "Correct the points, or give towards.",
    ),
    refused(
        "load-beyond-computing",
        "Loads are so small or so large that squares of them cannot be computed.",
        "Mostly wrong units.",
        "Check units, densities and sizes.",
    ),
    refused(
        "settlement-not-fixed",
        "Blocks that are to give way are not fixed in the first place.",
        "A settlement moves blocks that `supports` holds; a ground plane is no block.",
        "Fix the blocks, or give a block in the place of the ground plane.",
    ),
    refused(
        "settlement-without-effect",
        "A settlement moves nothing that has weight.",
        "There is no dead load on blocks that can move.",
        "Give gravity as dead load.",
    ),
    refused(
        "supports-at-odds",
        "Two bodies hold the same piece of a face, and nothing says which of them does.",
        "Grounds of different joints in one plane, a ground and a fixed block of different joints, or a ground in the "
        "plane of a block that can move. Counted twice, strengths would be too high.",
        "Leave one of them out, name the blocks that a ground carries with blocks, or give one of the two interfaces "
        "the joint open in contacts.overrides.",
        "by different joints, ",
        example="footing[0] and ground z = 0 hold the same piece of a face of pier[0], by different joints",
    ),
    refused(
        "support-held-twice",
        "A block is held in two ways that contradict each other.",
        "Two items of supports name it, or glue ties it to what moves otherwise.",
        "Say how a block is held in one item; leave glue away from what may move.",
    ),
    refused(
        "too-many-points",
        "A spacing would give an interface too many contact points.",
        "The spacing is small for the interface, mostly because of units.",
        "Take a spacing above the figure of the message, or per_edge.",
    ),
)

OF_TABLES = (
    refused(
        "table-unreadable",
        "A CSV table cannot be read.",
        "It is missing, empty, not UTF-8, or a quotation mark is not closed.",
        "Save it as CSV UTF-8 with a header and a row for each entry.",
    ),
    refused(
        "table-columns",
        "The columns of a CSV table are not those that it needs.",
        "A column is missing, there twice or misspelt, or a row has more or fewer than the header.",
        "The message lists the columns.",
    ),
    refused(
        "table-number",
        "A cell of a CSV table is no finite number.",
        "A word, an empty cell, or a decimal comma in a file with commas between columns.",
        "Correct the cell; with decimal commas take semicolons between columns.",
    ),
    refused(
        "table-row",
        "A row of a CSV table does not fit the others, or the model.",
        "It names a block, vertex or joint that does not exist, repeats one, or has too few corners.",
        "Correct the row; file and line are told.",
    ),
    refused(
        "interface-misfit",
        "A given interface does not fit the blocks that it is between.",
        "Its corners leave a face of one of them by more than contacts.tolerance, are too few, or it overlaps another.",
        "Correct its corners, or leave contacts to be found.",
    ),
    refused(
        "geometry-without-blocks",
        "A geometry file holds nothing that makes a block.",
        "It has points, lines or parametric shapes only.",
        "Export surfaces or volume cells; convert shapes to meshes.",
    ),
    refused(
        "geometry-too-large",
        "A geometry file is larger, or asks for more memory, than blocks of its size need.",
        "A damaged header that announces more than the file holds, numbers of nodes without end, insertions without "
        "number, a line of millions of characters, or a model of many gigabytes.",
        "Export it anew, without packing; divide a large model into several files.",
    ),
    refused(
        "geometry-not-read",
        "A geometry file uses something that is not followed.",
        "An unknown kind of file, a compression or extension, a card that changes the mesh, outlines in another plane.",
        "Export it without that, as the message says.",
    ),
)

OF_SWEEP_FILES = (
    refused(
        "sweep-values",
        "The values of a parameter of a sweep cannot be had.",
        "Expressions, lists of lists, or ends of a range that numbers do not tell apart.",
        "Write plain numbers, words or vectors; widen the range or take fewer points.",
    ),
    refused(
        "sweep-unit",
        "The unit of a parameter is not the one that the deck takes there.",
        "A unit in a sweep file names a column, it does not convert.",
        "Write the values in the deck's unit.",
    ),
    refused(
        "sweep-no-point",
        "The constraints of a sweep leave no point.",
        "They contradict each other or the ranges.",
        "The message counts what each constraint excludes: loosen one.",
    ),
    refused(
        "wrong-comparison",
        "A constraint of a sweep is no comparison that can be computed.",
        "It lacks a comparison sign, joins several, or names what is no number.",
        'Write one comparison for each, such as "t < 0.2*radius".',
    ),
)

OF_FAULTS = (*OF_TEXTS, *OF_VALUES, *OF_ITEMS, *OF_TABLES, *OF_SWEEP_FILES)
