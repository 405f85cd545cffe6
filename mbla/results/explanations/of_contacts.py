"""What the search for contacts and the choice of contact points remark."""

from __future__ import annotations

from mbla.results.explanations.explanation import Explanation

_TOLERANCE = "Lengths are compared with contacts.tolerance times the size of the smaller block."

OF_CONTACTS = (
    Explanation(
        "blocks-overlap",
        "warning",
        "Two blocks fill the same space by more than the tolerance.",
        "Weights are too large and contacts are where no joint is: mbla run refuses such a deck (exit status 3).",
        f"Wrong coordinates, an item given twice, or a rounded export. {_TOLERANCE}",
        "Move the blocks apart; where they are meant to touch, set contacts.tolerance above the figure of the message.",
        example="pier[3] and arch[0] overlap by 0.012 m, 0.03 of the block size: move them apart",
        says=("overlap by", "lies wholly inside"),
    ),
    Explanation(
        "overlap-not-checked",
        "warning",
        "Pairs of blocks could not be checked for overlap, because the faces of one form no closed solid.",
        "If they overlap, weights and contacts are wrong without a further message.",
        "Faces that are planar only within the tolerance leave gaps at edges.",
        "Look at these blocks; repair them where they were made.",
    ),
    Explanation(
        "near-misses",
        "warning",
        "Opposite faces of two bodies miss each other by little more than the tolerance: they are no contacts.",
        "If they touch in reality, contacts are missing: the load factor is mostly too low, or the structure falls.",
        f"Rounded or wrong coordinates, joints drawn with their thickness. {_TOLERANCE}",
        "Raise contacts.tolerance to the figure of the message if they should touch; compare the load factors of both.",
        example="contacts: {joint: dry, tolerance: 2.e-3}",
    ),
    Explanation(
        "slivers-dropped",
        "notice",
        "Common surfaces narrower than the tolerance were not taken as contacts.",
        "A sliver carries hardly any moment, but kept ones have raised a load factor by 0.7 %; dropping is the safe "
        "side.",
        "Blocks that touch along an edge, up to rounding.",
        "Lower contacts.tolerance if the widest one is a real bearing.",
    ),
    Explanation(
        "thin-block-between",
        "notice",
        "Faces within the tolerance of each other were not taken as contacts, because a thinner block lies between.",
        "Taken as contacts they would carry what only the thin block can carry: a block on a small thin foot would "
        "rest on the ground beside it.",
        "Feet, wedges, plates or layers of mortar thinner than contacts.tolerance of the blocks about them.",
        "Nothing, if the thin block is meant. Leave out blocks that are there only by rounding.",
    ),
    Explanation(
        "supports-in-one-plane",
        "notice",
        "Two supports hold the same piece of a face: it was counted once.",
        "Each piece of a face has one interface, so that cohesion and strengths count once: the load factor is right.",
        "A ground that is given twice, or a fixed block whose face lies in the plane of a ground.",
        "Nothing, if both are meant: the block, or the earlier ground, has the piece, the ground the rest of the face. "
        "Else leave one of them out, or name the blocks that the ground carries with blocks.",
        example="footing[0] and ground z = 0 hold the same piece of a face of pier[0]: it is counted once",
        says=("hold the same piece of a face",),
    ),
    Explanation(
        "outlines-simplified",
        "notice",
        "Corners of common surfaces that lie within the tolerance of the outline are left out, and the area shows it.",
        "Blocks turn about edges that lie a little inside of the true ones: a load factor by rocking is too low by "
        "about the share of the area.",
        f"Round faces of very many corners. {_TOLERANCE}",
        "Lower contacts.tolerance where that matters, for instance to a tenth; each corner kept is one contact point.",
        says=("are left out, which changes the area",),
    ),
    Explanation(
        "isolated-blocks",
        "warning or notice",
        "Blocks touch nothing at all.",
        "They fall under their own weight unless they are fixed, and fixed ones hold nothing: what was solved is not "
        "the structure that was meant. The run ends with exit status 4, whatever its load cases are.",
        "Gaps wider than the tolerance, a wrong unit of a file, or a block that does not belong to the structure.",
        "Close the gaps, or set contacts.tolerance as the message says where they are rounding; leave out blocks that "
        "do not belong there. contacts.isolated: allow is for those that are meant to touch nothing.",
        example="contacts: {joint: dry, tolerance: 0.026}",
        says=("touch nothing", "touches nothing"),
    ),
    Explanation(
        "unsupported-parts",
        "warning",
        "Parts of the structure are not connected to any support.",
        "They fall: no equilibrium for every load case with gravity.",
        "A missing ground plane or fixed block, or a gap larger than the tolerance.",
        "Add the support, or close the gap to the nearest neighbour that the message names.",
        says=("not connected to a support",),
    ),
    Explanation(
        "ground-without-contact",
        "warning",
        "No face of a block lies on a ground plane: it carries nothing.",
        "The structure is held by its other supports only.",
        "The plane lies off the feet of the structure by more than the tolerance.",
        "Move the plane, or leave it out.",
    ),
    Explanation(
        "block-crosses-ground",
        "warning",
        "Blocks reach from one side of a ground plane to the other.",
        "The ground does not hold them where they cross it, only where a face lies on it.",
        "A plane at the wrong height, or a support meant for some blocks only.",
        "Move the plane, or name with `blocks` those that it carries.",
    ),
    Explanation(
        "fixed-contacts-left-out",
        "notice",
        "Contacts between bodies that are both fixed were left out.",
        "None: nothing moves there.",
        "Fixed blocks side by side or on the ground.",
        "Nothing.",
    ),
    Explanation(
        "open-interfaces-left-out",
        "notice",
        "Interfaces with the joint law `open` were left out.",
        "No force passes there; without that law the load factor would mostly be higher.",
        "contacts or an override gives them `open`.",
        "Nothing, if that is meant.",
    ),
    Explanation(
        "blocks-glued",
        "notice",
        "Interfaces with the joint law `glued` were left out: their blocks are one rigid body.",
        "No joint can part inside of the body; the load factor is that of unlimited strength there, on the unsafe side "
        "of any real bond.",
        "contacts or an override gives them `glued`.",
        "Give a law with cohesion and tensile strength where the bond can break.",
    ),
    Explanation(
        "override-without-contact",
        "warning",
        "An override of joint laws fits no contact and has no effect.",
        "Joints keep the law that they would have without the override.",
        "The two selections do not touch, the orientation is another, the box is empty; or the order of overrides.",
        "Look at the table of joint laws in use; correct the selectors.",
    ),
    Explanation(
        "inset-not-applied",
        "warning",
        "Some interfaces keep their contact points where they are: contacts.points.inset cannot move them.",
        "These interfaces keep their full torsion and rocking strength: an overstated torsion stays overstated.",
        "Their centroid does not see all of their outline (they are not star-shaped, or have holes).",
        "Divide such interfaces, or use contact_model: convex.",
    ),
    Explanation(
        "rounding-not-applied",
        "warning",
        "Some interfaces keep their contact points where they are: contacts.points.rounding cannot move them.",
        "These interfaces rock about their full edges, as if not rounded: on the unsafe side.",
        "They are not convex, or narrower than twice the rounding.",
        "Lower the rounding, or divide such interfaces.",
    ),
)
