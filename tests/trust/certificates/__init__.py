"""Certificates: what is called solved is proved by the result file alone, also in rational arithmetic."""
