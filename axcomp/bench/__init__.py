"""What a cycle costs: the engine and the FMU, over machines of all sizes."""
