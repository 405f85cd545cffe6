"""Which state a structure reaches without dilatancy: the path of elastic joints."""
