"""Parameter sweeps: a base deck run over a design of experiments, to a journal, a table and pictures::

    sweep file ──> design ──> tasks ──> engine ──> journal ──> table ──> pictures
    file/          design/    plan.py   engine/    journal.py  tables/   pictures/
                                        worker/

What goes to a worker and comes back from it is plain data (``plan.py``, ``outcome.py``); ``command.py`` puts the parts
together.
"""
