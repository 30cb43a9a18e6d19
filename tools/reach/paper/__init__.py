"""`./run paper`: every experiment of the paper on the simulated robots, and one report."""
