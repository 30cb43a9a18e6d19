"""What goes on beside a test. Every test written in Python finds this module."""

import threading


class Background(threading.Thread):
    """Runs while its context lasts: until `_halt` is set."""

    def __init__(self):
        super().__init__(daemon=True)
        self._halt = threading.Event()

    def __enter__(self):
        self.start()
        return self

    def __exit__(self, *_):
        self._halt.set()
        self.join()
