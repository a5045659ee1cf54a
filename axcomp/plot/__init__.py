"""Compensation tables as pictures, as tables in the terminal, and the difference of two machines."""
