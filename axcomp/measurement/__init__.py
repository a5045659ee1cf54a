"""From measurements to lists: measuring a machine, here a simulated one, and making compensation tables of it."""
