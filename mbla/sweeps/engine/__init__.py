"""What solves the points: processes of this machine, or those of the workers of a Dask scheduler::

engine.py ──────────────> processes.py ──> supervised.py ──> child.py
  cluster.py ──────────────┘
tasks in, outcomes out   of each thread   limits of time and memory, deaths
"""
