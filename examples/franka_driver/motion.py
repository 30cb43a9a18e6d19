"""The drivers' motion core, examples/motion/motion.h, for a driver in Python."""

import ctypes
from pathlib import Path

Doubles = ctypes.POINTER(ctypes.c_double)


class Motion:
    """See motion.h for what it promises; `library` is libreach_motion.so."""

    def __init__(self, library: Path, lowest, highest, fastest, acceleration, leash, period):
        self._c = ctypes.CDLL(str(library))
        self._c.motion_create.restype = ctypes.c_void_p
        self._c.motion_create.argtypes = [ctypes.c_int, *[Doubles] * 4, *[ctypes.c_double] * 2]
        self._c.motion_destroy.argtypes = [ctypes.c_void_p]
        self._c.motion_command.restype = ctypes.c_bool
        self._c.motion_command.argtypes = [ctypes.c_void_p, ctypes.c_int, Doubles, ctypes.c_int64]
        self._c.motion_step.restype = ctypes.c_bool
        self._c.motion_step.argtypes = [
            ctypes.c_void_p, *[Doubles] * 3, *[ctypes.c_int64] * 2, *[Doubles] * 2
        ]  # fmt: skip
        self._c.motion_leashed.argtypes = [ctypes.c_void_p]
        self._array = ctypes.c_double * len(lowest)
        self._position, self._velocity = self._array(), self._array()
        self._handle = self._c.motion_create(
            len(lowest),
            *map(self._doubles, (lowest, highest, fastest, acceleration)),
            leash,
            period,
        )
        if not self._handle:
            raise ValueError("these limits are none")

    def _doubles(self, values):
        return self._array(*values)

    def close(self) -> None:
        self._c.motion_destroy(self._handle)
        self._handle = None

    def command(self, velocity, now: int) -> bool:
        array = (ctypes.c_double * len(velocity))(*velocity)
        return self._c.motion_command(self._handle, len(velocity), array, now)

    def step(self, measured, set_point, set_velocity, robot: int, now: int) -> list[float]:
        """The next velocities, of drives that are given such."""
        if not self._c.motion_step(
            self._handle, *map(self._doubles, (measured, set_point, set_velocity)), robot, now,
            self._position, self._velocity,
        ):  # fmt: skip
            raise ValueError("the robot's reading is not finite")
        return list(self._velocity)

    def leashed(self) -> int:
        return self._c.motion_leashed(self._handle)
