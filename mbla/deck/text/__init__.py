"""The texts of a deck: files read with care, as a tree with the place of every value, merged and overridden."""
