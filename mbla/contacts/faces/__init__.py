"""From faces of blocks to the surfaces that they share: facets, pairs that are near, and what is a contact of them."""
