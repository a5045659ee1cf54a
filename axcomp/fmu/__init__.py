"""The FMU: its variables, its model description, its instance at run time, and the file it is packed into."""
