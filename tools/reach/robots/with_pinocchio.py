"""Run by an interpreter that has pinocchio and nothing of ours: what it makes of the same postures.

stdin: {"urdf", "tip", "joints": [names], "ball": kg, "postures": [[rad or m]]}; stdout: a list of
{"place": [m], "gravity": [N m or N]}, the latter as the simulator counts it: what gravity does.
"""

import json
import sys

import numpy as np
import pinocchio as pin

GRAVITY = 9.81  # m/s2, of the simulator


def configuration(model: pin.Model, joints: list[int], positions: list[float]) -> np.ndarray:
    """All other joints at zero. One that turns without end has cosine and sine."""
    q = pin.neutral(model)
    for joint, position in zip(joints, positions, strict=True):
        at = model.joints[joint].idx_q
        if model.joints[joint].nq == 2:
            q[at : at + 2] = np.cos(position), np.sin(position)
        else:
            q[at] = position
    return q


def main() -> None:
    asked = json.load(sys.stdin)
    model = pin.buildModelFromUrdf(asked["urdf"])
    model.gravity.linear = np.array([0, 0, -GRAVITY])
    data, tip = model.createData(), model.getFrameId(asked["tip"], pin.BODY)
    joints = [model.getJointId(name) for name in asked["joints"]]
    rows = [model.joints[joint].idx_v for joint in joints]
    answers = []
    for positions in asked["postures"]:
        q = configuration(model, joints, positions)
        pin.framesForwardKinematics(model, data, q)
        place = data.oMf[tip].translation.copy()
        held = pin.computeGeneralizedGravity(model, data, q)
        jacobian = pin.computeFrameJacobian(model, data, q, tip, pin.LOCAL_WORLD_ALIGNED)
        ball = jacobian[:3].T @ np.array([0, 0, -GRAVITY * asked["ball"]])
        answers.append({"place": place.tolist(), "gravity": (ball - held)[rows].tolist()})
    json.dump(answers, sys.stdout)


if __name__ == "__main__":
    main()
