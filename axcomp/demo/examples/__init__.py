"""The example machines in ``models/``: their lists, made from simulated measurements, their inputs and outputs.

``python -m axcomp.demo.examples`` writes them again.
"""
