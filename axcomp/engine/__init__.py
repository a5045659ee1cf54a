"""The engine on its own: step by step, over whole trajectories, with NC commands; and the motions to run it with."""
