"""A model of MuJoCo, and of it the joints and the tip that matter."""

import argparse
import re
from pathlib import Path

import eyes
import mujoco
import numpy as np
from reach.new_robot import choices
from reach.new_robot.urdf import Arm as UrdfArm
from reach.new_robot.urdf import UnusableError, Urdf

STEP = 0.001  # s


class Arm:
    """`joints` are driven; all others are held where the model has zero."""

    def __init__(self, spec: mujoco.MjSpec, joints: list[str], tip: str, rod: float,
                 eye_names: list[str]):  # fmt: skip
        spec.option.timestep = STEP
        spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
        spec.option.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
        body = spec.body(tip)
        if body is None:
            raise KeyError(f"there is no body '{tip}'")
        body.add_site(name="reach_tip", pos=[0, 0, rod])
        if rod > 0:
            body.add_geom(type=mujoco.mjtGeom.mjGEOM_CAPSULE, size=[0.005, 0, 0],
                          fromto=[0, 0, 0, 0, 0, rod], mass=0.1 * rod)  # fmt: skip
        if eye_names:
            eyes.put_in(spec, eye_names, tip, rod)
        _leave_out(spec, joints)
        self.model = spec.compile()
        self.data = mujoco.MjData(self.model)
        found = [self.model.joint(name) for name in joints]
        self.dofs = np.array([joint.dofadr[0] for joint in found])
        # A drive masters the friction of its own gear; those of drives.py are told nothing of it.
        self.model.dof_damping[self.dofs] = self.model.dof_frictionloss[self.dofs] = 0
        self.effort = np.array([self._effort(joint.id) for joint in found])
        self._places = np.array([joint.qposadr[0] for joint in found])
        self._tip = self.model.site("reach_tip").id
        self.ranges = np.array([joint.range for joint in found])

    @property
    def step_length(self) -> float:
        return self.model.opt.timestep

    @property
    def positions(self) -> np.ndarray:
        return self.data.qpos[self._places]

    @property
    def velocities(self) -> np.ndarray:
        return self.data.qvel[self.dofs]

    @property
    def tip(self) -> np.ndarray:
        """m, in the frame of the world."""
        return self.data.site_xpos[self._tip]

    def _effort(self, joint: int) -> float:
        """The motor's greatest torque, without limit where the model has none."""
        limited = self.model.jnt_actfrclimited[joint]
        return float(self.model.jnt_actfrcrange[joint][1]) if limited else np.inf

    def put(self, positions: np.ndarray) -> None:
        """At rest."""
        self.data.qpos[self._places] = positions
        mujoco.mj_forward(self.model, self.data)

    def step(self) -> None:
        mujoco.mj_step(self.model, self.data)
        mujoco.mj_forward(self.model, self.data)  # forces and places of this instant


def _leave_out(spec: mujoco.MjSpec, joints: list[str]) -> None:
    """Joints that are not driven, and what would drive or bind them: drives.py does that."""
    undriven = [joint for joint in spec.joints if joint.name not in joints]
    for part in [*spec.equalities, *spec.actuators, *spec.sensors, *spec.keys, *spec.tendons,
                 *undriven]:  # fmt: skip
        spec.delete(part)


def load(options: argparse.Namespace) -> Arm:
    """The arm that the options name, at its start. ValueError, KeyError: it cannot be made."""
    joints, tip, start = options.joints, options.tip, None
    head = options.head.split(",") if options.head else []
    if options.model.suffix == ".urdf":
        try:
            known = UrdfArm(Urdf(options.model), tip, joints.split(",") if joints else None)
        except UnusableError as error:
            raise ValueError(error) from None
        joints, tip = [joint.name for joint in known.joints], known.tip
        start = [choices.range_of(joint).middle for joint in known.joints]
        slides = np.array([joint.slides for joint in known.joints])
        start = [*np.where(slides, start, np.radians(start)), *[0.0] * len(head)]
        spec = mujoco.MjSpec.from_string(_bare(options.model))
        spec.compiler.fusestatic = False
    else:
        if not joints or not tip:
            raise ValueError("of an MJCF --joints and --tip are wanted")
        joints, spec = joints.split(","), mujoco.MjSpec.from_file(str(options.model))
    joints = [*joints, *head]
    arm = Arm(spec, joints, tip, options.rod, options.eyes.split(",") if options.eyes else [])
    if options.start:
        given = np.array([float(word) for word in options.start.split(",")])
        kinds = [arm.model.joint(name).type[0] for name in joints]
        start = np.where(np.array(kinds) == mujoco.mjtJoint.mjJNT_SLIDE, given, np.radians(given))
    arm.put(arm.ranges.mean(axis=1) if start is None else np.array(start))
    return arm


def _bare(path: Path) -> str:
    """A URDF without what is seen or bumped into: nothing here does either, and meshes may be
    missing."""
    text = path.read_text(encoding="utf-8", errors="replace")
    return re.sub(r"<(visual|collision)\b.*?</\1>", "", text, flags=re.DOTALL)
