"""The controller's files, read and written: grammar, parameter catalogue, findings, one module per kind of file."""
