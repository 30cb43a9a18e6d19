"""Public arms on the simulator: do they load, hold together, learn and reach?"""
