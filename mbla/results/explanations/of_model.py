"""What building the blocks, their loads and masses remarks."""

from __future__ import annotations

from mbla.model.build_blocks import PLANAR
from mbla.model.joint_laws import UNLIMITED
from mbla.results.explanations.explanation import Explanation

_SHAPE_KEPT = "None: the shape of the blocks is the same."
_LOOK = "Look at the blocks in a picture or in ParaView (mbla check --vtu) if the number surprises."

OF_BLOCKS = (
    Explanation(
        "coordinates-coarse",
        "warning",
        "Blocks lie so far from the origin that the rounding of their coordinates is noticeable beside their size.",
        "It may be off by about ten times the share in the message: the corners themselves are rounded before anything "
        "is computed. Beyond contacts.tolerance the deck is refused.",
        "Coordinates of a surveyor's grid, or a wrong unit of the offset.",
        "Move the structure to the origin, in the file or with `transform: {translate: ...}` where the file has the "
        "small coordinates.",
    ),
    Explanation(
        "friction-limited",
        "notice",
        f"A friction coefficient above {UNLIMITED:g} is taken for {UNLIMITED:g}.",
        "Less than a millionth: joints do not slide either way.",
        "Friction that is meant to be unlimited.",
        "Nothing.",
    ),
    Explanation(
        "vertices-unused",
        "notice",
        "A polyhedron lists vertices that none of its faces has.",
        _SHAPE_KEPT,
        "Vertices left over in the deck or by the exporting program; or a face that is missing a corner.",
        "Check the faces of the block named; nothing else to do.",
    ),
    Explanation(
        "faces-turned-outwards",
        "notice",
        "Faces whose corners ran the wrong way round were turned, so that their normals point out of the block.",
        _SHAPE_KEPT,
        "The exporting program has inward normals, or corners were listed clockwise.",
        "Nothing: the volume and its sign have been checked after turning.",
    ),
    Explanation(
        "faces-not-quite-planar",
        "notice",
        f"Corners leave the plane of their face by more than {PLANAR:g} of the block size, within contacts.tolerance.",
        "Each face is taken as the plane fitted to its corners. Contact areas and lever arms change by about the "
        "deviation over the size of the face.",
        "Coordinates rounded in a file, or faces that are warped.",
        "Nothing for roundings. For warped beds compare with a run whose faces are split into planes on purpose: the "
        "choice of diagonal can change the load factor by several per cent.",
    ),
    Explanation(
        "bent-faces-split",
        "notice",
        "Faces whose corners leave their plane by more than contacts.tolerance were split into triangles.",
        "They touch nothing, so that they count for volumes and weights only: of two ways to split a face the volumes "
        "differ by up to its area times its deviation.",
        "Rubble, or a curved extrados whose quadrilaterals are twisted.",
        "Nothing, where such faces are free; one that touches something is refused (face-not-planar).",
        example="1 face of 1 block (b[1]) is not planar and was split into triangles; the worst, face 1 of b[1]",
        says=("split into triangles",),
    ),
    Explanation(
        "mirrored",
        "notice",
        "The symmetry section of the deck has mirrored what it gives.",
        "Only symmetric collapses are looked for: an unsymmetric one may have a lower load factor.",
        "symmetry in the deck.",
        "Give the whole structure where an unsymmetric collapse cannot be ruled out.",
    ),
    Explanation(
        "mass-outside-block",
        "notice",
        "An added mass lies outside of the block that carries it.",
        "Its weight and its inertia act at the point given, with their moment about the block.",
        "A floor or a roof whose centre of mass is not over its bearing; or a coordinate in another unit.",
        "Check `at`. If the mass rests on several blocks give one mass for each.",
    ),
    Explanation(
        "mass-on-support",
        "warning",
        "An added mass rests on blocks that do not move.",
        "The mass has no effect on any load factor.",
        "The selector of the mass takes fixed blocks, or blocks glued to a support.",
        "Select the blocks that bear it.",
    ),
)

OF_FILES = (
    Explanation(
        "mesh-placed",
        "notice",
        "Unit and upward axis of a geometry file were taken from its format or header.",
        "A wrong unit changes no load factor of an acceleration, but any factor of a force, a cohesion or a strength; "
        "a wrong axis turns gravity.",
        "The item gives neither units nor up.",
        "Compare the size in the message with the structure; write `units` and `up` to settle it.",
    ),
    Explanation(
        "mesh-cells-left-out",
        "warning or notice",
        "Parts of a geometry file became no blocks.",
        "What was left out neither weighs nor supports anything: if it was a block, the load factor is of another "
        "structure.",
        "Points, lines, surfaces beside volume cells, or objects that are no meshes.",
        "Count the blocks against the file; export the missing ones as closed surfaces or volume cells.",
    ),
    Explanation(
        "objects-empty",
        "warning",
        "Objects of a geometry file have no faces, and became no blocks.",
        "What was left out neither weighs nor supports anything: if it was a block, the load factor is of another "
        "structure.",
        "A file that is cut off, an export without faces, or an object that is there for its name only.",
        "Count the blocks against the file; export the object again, or remove it.",
    ),
    Explanation(
        "file-vertices-unused",
        "warning",
        "No face of a geometry file uses some of its vertices.",
        "If the faces are missing, so are blocks: the load factor is then of another structure.",
        "A file that is cut off, a block that lost its faces, or points that the exporting program left behind.",
        "Count the blocks against the file, and export it again where they differ.",
    ),
    Explanation(
        "mesh-supports-marked",
        "notice",
        "A geometry file marks blocks as supports; the deck alone fixes blocks.",
        "Blocks so marked move unless the deck's supports fix them.",
        "The file comes from a program that stores supports with the blocks.",
        "Write the support that the message offers.",
    ),
    Explanation(
        "mesh-deformation-ignored",
        "warning",
        "A glTF file has skinned or morphed meshes; they are taken without deformation.",
        "The geometry may not be the one that its viewer shows.",
        "The file was made for animation.",
        "Apply the deformation before exporting.",
    ),
    Explanation(
        "mesh-file-remarks",
        "warning",
        "The library that read a geometry file remarked something about it.",
        "Unknown: something in the file was not understood and may be missing.",
        "Elements, attributes or sections that the reader does not know.",
        f"Read the remark; count the blocks against the file. {_LOOK}",
    ),
    Explanation(
        "drawing-fields",
        "notice",
        "Fields enclosed by lines of a drawing were taken as outlines of blocks.",
        "A field that is a void in reality counts as a block.",
        "The drawing has lines in place of closed polylines.",
        f"Count the blocks. {_LOOK}",
    ),
    Explanation(
        "drawing-lines-left-out",
        "warning",
        "Lines of a drawing enclose no field and became no block.",
        "A block may be missing, and with it its weight and its contacts.",
        "Lines whose ends do not meet, or axes and dimensions on the layer of the blocks.",
        "Close the outlines, or put other lines on a layer that is not read.",
    ),
    Explanation(
        "drawing-layer-hidden",
        "warning",
        "Outlines of a layer that is off or frozen were left out.",
        "Blocks may be missing.",
        "The layer was switched off when the drawing was saved.",
        "Switch the layer on, or delete it, before saving.",
    ),
)

OF_REPAIR = (
    Explanation(
        "vertices-merged",
        "notice",
        "Vertices of a block at the very same place were made one.",
        _SHAPE_KEPT,
        "The file lists the corners of every face by themselves.",
        "Nothing.",
    ),
    Explanation(
        "vertices-welded",
        "notice",
        "Vertices of a block that nearly coincide were made one, to close it.",
        "Blocks change by the distance that the message gives; contacts by as much.",
        "Rounded coordinates: neighbouring faces miss each other, or `weld` asks for it.",
        "Compare the distance with the joints of the structure; a smaller contacts.tolerance or weld merges less.",
    ),
    Explanation(
        "t-junctions",
        "notice",
        "Vertices that lie on the edge of another face of their block were made corners of it.",
        _SHAPE_KEPT,
        "Faces were divided on one side of an edge only.",
        "Nothing.",
    ),
    Explanation(
        "faces-collapsed",
        "notice",
        "Faces without area, their corners at one place, were left out.",
        _SHAPE_KEPT,
        "Degenerate triangles of the exporting program.",
        "Nothing.",
    ),
    Explanation(
        "faces-flat",
        "notice",
        "Faces without area, all corners on one line, were left out.",
        _SHAPE_KEPT,
        "Degenerate triangles of the exporting program.",
        "Nothing.",
    ),
    Explanation(
        "faces-repeated",
        "notice",
        "Faces that a file lists twice were taken once.",
        "None: otherwise volumes and weights would double.",
        "The exporting program writes both sides of each face.",
        "Nothing.",
    ),
    Explanation(
        "surfaces-repeated",
        "notice",
        "Closed surfaces that are another one once more were left out.",
        "None: otherwise two blocks would fill one place.",
        "An object was copied onto itself before exporting.",
        "Count the blocks.",
    ),
    Explanation(
        "objects-split",
        "notice",
        "Objects of a file that hold several closed surfaces became a block for each.",
        "Blocks that were meant to be one rigid body can part, which lowers the load factor.",
        "Several stones in one object; or one stone with a hole inside.",
        "Join them with `glued` where they are one body.",
    ),
    Explanation(
        "objects-joined",
        "warning",
        "No object of a file is closed by itself; all their faces together were taken as one surface.",
        "Faces decide what is a block, not the objects; the names of objects are lost to selectors.",
        "The file has an object for each face.",
        f"Count the blocks. {_LOOK}",
    ),
)

OF_LOADS = (
    Explanation(
        "force-outside-block",
        "warning",
        "A force acts at a point outside of the block that takes it.",
        "Its moment about the block is kept, and with it the lever arm of a rigid arm to the point.",
        "A wrong coordinate, index or unit; or a force that really acts over an arm.",
        "Check `at` against the extents of the block.",
    ),
    Explanation(
        "line-load-outside-blocks",
        "warning",
        "A line load is drawn away from the blocks that take it, and not along its own direction.",
        "Its moment about the blocks is kept.",
        "The line lies above or beside the blocks that it finds along `towards`.",
        "Draw the line on the surface that it loads.",
    ),
    Explanation(
        "pressure-on-part-of-face",
        "warning",
        "Other blocks or the ground cover parts of the faces under pressure; it acts on the free parts.",
        "The resultant is less than pressure times whole faces.",
        "Buttresses, cross walls or the ground touch the face.",
        "Nothing, if that is meant; `faces: all` loads whole faces all the same.",
    ),
    Explanation(
        "dead-load-on-support",
        "warning",
        "A dead load acts on blocks that do not move and goes straight into the support.",
        "It has no effect on any load factor.",
        "The selector takes fixed blocks.",
        "Select the blocks that bear it, or leave it out.",
    ),
    Explanation(
        "tilt-turns-gravity-only",
        "warning",
        "On a tilting table only gravity turns; the other dead loads keep their direction in the structure.",
        "The angle holds for loads that tilt with the table, such as ties and springs, not for hanging ones.",
        "A load case with tilt has dead loads beside gravity.",
        "Give hung weights as `masses`: these are turned with gravity.",
    ),
)

OF_MODEL = (*OF_BLOCKS, *OF_FILES, *OF_REPAIR, *OF_LOADS)
