"""Studies: many runs of one deck, each in a process of its own, and what they say together.

The stage to the right of results: a study calls the whole line (:mod:`mbla.run_deck`) as often as it needs to.
"""
