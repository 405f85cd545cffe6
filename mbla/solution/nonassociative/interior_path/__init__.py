"""Interior path of the exact law without dilatancy, followed by arc length through its turning points."""
