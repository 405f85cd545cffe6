"""Verification of time histories: what is stored held against the deck, with no code of the step."""
