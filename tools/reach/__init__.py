"""Experiments with reachd and reports on them."""
