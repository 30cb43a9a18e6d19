"""`./run accuracy --curves`: errors of four learners against samples, as one picture."""
