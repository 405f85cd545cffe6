"""Decks, sweep files and geometry files from somebody who means harm, or from nobody: made at random.

``test_hostile.py`` gives the program files written to hurt it, ``test_fuzzing.py`` files that were changed at random,
``coverage_guided.py`` files that a fuzzer changes with an eye on which lines of the program they reach. What any of
them found is kept in ``corpus/`` and read again by ``test_corpus.py``.
"""
