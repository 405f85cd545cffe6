"""The structure of one load case in a browser, to be turned with the mouse."""
