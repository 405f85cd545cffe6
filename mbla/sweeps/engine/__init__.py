"""What solves the points: processes of this machine, or those of the workers of a Dask scheduler::

engine.py ────────────────────────────> supervised.py ──> child.py
  cluster.py ──> on_worker.py ───────────┘
tasks in,        in a worker of Dask    a process: limits of time and memory, deaths
outcomes out
"""
