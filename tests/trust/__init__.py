"""What a solver must hold to be trusted, checked and counted.

Every check has a short form that runs with all tests and a full one with the marker ``trust``.
``python -m tests.trust`` runs the full ones and writes what they counted to ``counts/`` and into the table of
``README.md`` beside this file.
"""
