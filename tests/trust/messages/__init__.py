"""No error without a stable identifier; each identifier is explained, and tested by at least one exact text."""
