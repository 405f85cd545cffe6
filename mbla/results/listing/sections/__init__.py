"""The sections of a listing: what each says of a model or of a load case, as blocks of text and tables."""
