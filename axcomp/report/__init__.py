"""The report: everything there is to say about a machine's compensations on one page."""
