"""Parameter sweeps: a base deck run over a design of experiments, to a journal, a table and pictures::

    sweep file ──> design ──> tasks ──> engine ──> journal ──> table ──> pictures
    file/          design/    plan.py   engine/    journal.py  tables/   pictures/

What goes to a worker and comes back from it is plain data (``plan.py``); ``command.py`` puts the parts together.
``interaction/`` and ``tradeoff/`` are sweeps that a command makes by itself, over an angle and over settings
(``studies.py``).
"""
