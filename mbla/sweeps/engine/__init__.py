"""What solves the points: ``SerialEngine`` in one process beside this one, ``ClusterEngine`` on workers of Dask::

    engine.py, cluster.py ──> on_worker.py ──> supervised.py ──> child.py
    tasks in, outcomes out    in a worker      its process: limits of time and memory, deaths

Only ``connection.py`` imports Dask.
"""
