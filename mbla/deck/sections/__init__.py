"""The sections of a deck: one file a section, with its type, its rules and its notices."""
