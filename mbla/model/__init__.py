"""The model stage: from a checked deck to blocks, supports and loads as arrays."""
