"""Writes etc/robots/icub.urdf from the Denavit-Hartenberg table of the iCub's right arm.

python tools/dev/icub_urdf.py > etc/robots/icub.urdf

The table is that of the public iCub, first version, in the standard convention: joint i turns by
theta about z of frame i - 1, and frame i lies at Rz(theta + offset) Tz(d) Tx(a) Rx(alpha) of it.
URDF puts a link's frame into its joint: the link that joint i carries is frame i - 1 turned by
theta, and what remains of a row, with its constant offset, is where the next joint sits in it.
So every joint turns about its z, and the angle of URDF is the angle of the table.
"""

import sys
from math import cos, radians, sin

import numpy as np

# joint, a (m), d (m), alpha (deg), offset (deg), limits (deg; None: held at 0, no joint of ours)
TABLE = (
    ("waist_pitch", 0.032, 0, 90, 0, (-10, 30)),
    ("waist_roll", 0, -0.0055, 90, -90, (-30, 30)),
    ("waist_yaw", -0.0233647, -0.1433, 90, -105, (-30, 30)),
    ("shoulder_pitch", 0, -0.10774, 90, -90, (-80, 0)),
    ("shoulder_yaw", 0, 0, -90, -90, (0, 80)),
    ("shoulder_roll", -0.015, -0.15228, -90, -105, (0, 80)),
    ("elbow", 0.015, 0, 90, 0, (20, 80)),
    ("forearm", 0, -0.1373, 90, -90, None),
    ("wrist_pitch", 0, 0, 90, 90, None),
    ("wrist_yaw", 0.0625, 0.016, 0, 180, None),
)
# Root frame to the first joint's.
H0 = np.array([[0, -1, 0, 0], [0, 0, -1, 0], [1, 0, 0, 0], [0, 0, 0, 1.0]])
# The ground frame: x forward, y left, z up, between the feet. The root frame looks backwards; its
# height is that of the waist of a robot a metre tall.
ROOT_HEIGHT = 0.6

# What a link weighs (kg) and its largest motor torque (N m): masses of the public model; links that
# the model does not name are the small castings between two joints.
LINKS = {
    "waist_pitch": (0.5, 60, "lower_waist"),
    "waist_roll": (0.5, 60, "upper_waist"),
    "waist_yaw": (7.64 + 1.51, 60, "chest"),  # with the head, which does not move here
    "shoulder_pitch": (0.2, 40, "shoulder"),
    "shoulder_yaw": (0.2, 40, "shoulder_inner"),
    "shoulder_roll": (0.745, 40, "upper_arm"),
    "elbow": (0.635, 30, "forearm_link"),
}
HAND_MASS = 0.248
MOTOR_SPEED = 2.5  # rad/s


def row_transform(a: float, d: float, alpha: float, offset: float) -> np.ndarray:
    """What a row adds when its joint is at 0."""
    ct, st, ca, sa = cos(offset), sin(offset), cos(alpha), sin(alpha)
    return np.array(
        [
            [ct, -st * ca, st * sa, a * ct],
            [st, ct * ca, -ct * sa, a * st],
            [0, sa, ca, d],
            [0, 0, 0, 1],
        ]
    )


def origin(transform: np.ndarray) -> str:
    """URDF's xyz and rpy: rotation is Rz(yaw) Ry(pitch) Rx(roll)."""
    r = transform[:3, :3]
    pitch = np.arctan2(-r[2, 0], np.hypot(r[0, 0], r[1, 0]))
    if abs(np.cos(pitch)) > 1e-9:
        roll, yaw = np.arctan2(r[2, 1], r[2, 2]), np.arctan2(r[1, 0], r[0, 0])
    else:  # yaw and roll turn about the same axis: leave it all to roll
        roll, yaw = np.arctan2(-r[1, 2], r[1, 1]), 0.0
    xyz = " ".join(f"{value + 0.0:.9g}" for value in np.round(transform[:3, 3], 9))
    rpy = " ".join(f"{value + 0.0:.12g}" for value in np.round((roll, pitch, yaw), 12))
    return f'<origin xyz="{xyz}" rpy="{rpy}"/>'


def visual(frame: np.ndarray, geometry: str, material: str) -> str:
    return (
        f"    <visual>\n      {origin(frame)}\n      <geometry>{geometry}</geometry>\n"
        f'      <material name="{material}"/>\n    </visual>\n'
    )


def collision(frame: np.ndarray, geometry: str) -> str:
    return (
        f"    <collision>\n      {origin(frame)}\n      <geometry>{geometry}</geometry>\n"
        "    </collision>\n"
    )


def solid(frame: np.ndarray, geometry: str, material: str) -> str:
    """Seen, and bumped into."""
    return visual(frame, geometry, material) + collision(frame, geometry)


def frame_along(start: np.ndarray, end: np.ndarray) -> np.ndarray:
    """In the middle between two points, z towards the second."""
    z = (end - start) / np.linalg.norm(end - start)
    side = np.cross(z, [1.0, 0, 0] if abs(z[0]) < 0.9 else [0, 1.0, 0])
    x = side / np.linalg.norm(side)
    frame = np.eye(4)
    frame[:3, :3] = np.column_stack((x, np.cross(z, x), z))
    frame[:3, 3] = (start + end) / 2
    return frame


def rod(start: np.ndarray, end: np.ndarray, radius: float, material: str, made=visual) -> str:
    length = np.linalg.norm(end - start)
    geometry = f'<cylinder radius="{radius}" length="{length:.6g}"/>'
    return made(frame_along(start, end), geometry, material)


def inertial(centre: np.ndarray, mass: float, size: float) -> str:
    """As of a ball of this radius: motors are strong, the exact inertia decides nothing."""
    i = 0.4 * mass * size**2
    frame = np.eye(4)
    frame[:3, 3] = centre
    return (
        f"    <inertial>\n      {origin(frame)}\n"
        f'      <mass value="{mass:g}"/>\n      <inertia ixx="{i:.4g}" ixy="0" ixz="0" '
        f'iyy="{i:.4g}" iyz="0" izz="{i:.4g}"/>\n    </inertial>\n'
    )


def joint(name: str, parent: str, child: str, frame: np.ndarray, rest: str = "") -> str:
    kind = "revolute" if rest else "fixed"
    return (
        f'  <joint name="{name}" type="{kind}">\n    <parent link="{parent}"/>\n'
        f'    <child link="{child}"/>\n    {origin(frame)}\n{rest}  </joint>\n'
    )


def link(name: str, content: str) -> str:
    return f'  <link name="{name}">\n{content}  </link>\n'


def point(frame: np.ndarray) -> np.ndarray:
    return frame[:3, 3]


def lower_body() -> str:
    """Hips and legs, in the root frame, whose y is to the right."""
    text = rod(np.array([0, 0, -0.25]), np.zeros(3), 0.06, "dark", solid)
    for side in (-0.068, 0.068):
        text += rod(np.array([0, side, -0.58]), np.array([0, side, -0.15]), 0.05, "dark", solid)
    return text


def upper_body(chest: np.ndarray, shoulder: np.ndarray) -> str:
    """Trunk, shoulder girdle and head, in the chest's frame, which is at `chest` in the root's and
    has z down its yaw axis. The trunk is so narrow that an arm that hangs does not touch it."""
    middle = shoulder * [0, 0, 1]
    trunk, head = np.eye(4), np.eye(4)
    trunk[:3, 3] = [0, 0, 0.125]
    head[:3, 3] = middle * 1.75
    return (
        solid(np.linalg.inv(chest) @ trunk, '<box size="0.10 0.13 0.15"/>', "blue")
        + rod(middle, shoulder, 0.035, "shell")
        + solid(head, '<sphere radius="0.075"/>', "shell")
    )


def build() -> str:
    limits = (
        '    <axis xyz="0 0 1"/>\n'
        '    <limit lower="{:.6f}" upper="{:.6f}" effort="{}" velocity="{}"/>\n'
    )
    transforms = [row_transform(a, d, radians(al), radians(o)) for _, a, d, al, o, _ in TABLE]
    hand = transforms[6] @ transforms[7] @ transforms[8] @ transforms[9]
    wrist = transforms[6] @ transforms[7]

    ground = np.diag([-1.0, -1.0, 1.0, 1.0])
    ground[2, 3] = ROOT_HEIGHT
    text = link("ground", "") + joint("stand", "ground", "root", ground)
    text += link("root", lower_body())

    parent, frame = "root", H0
    for (name, *_, degrees), after in zip(TABLE[:7], transforms[:7], strict=True):
        mass, effort, child = LINKS[name]
        rest = limits.format(radians(degrees[0]), radians(degrees[1]), effort, MOTOR_SPEED)
        end = point(hand) if name == "elbow" else point(after)
        content = inertial(end / 2, mass, 0.1 if name == "waist_yaw" else 0.05)
        if name == "waist_yaw":
            content += upper_body(H0 @ transforms[0] @ transforms[1], end)
        elif name == "elbow":
            content += rod(point(after), point(wrist), 0.026, "shell", solid)
        elif np.linalg.norm(end) > 0.03:
            content += rod(np.zeros(3), end, 0.03, "shell", solid)
        text += joint(name, parent, child, frame, rest) + link(child, content)
        parent, frame = child, after
    palm = np.eye(4)
    palm[:3, 3] = [-0.03, 0, -0.02]
    text += joint("hand_mount", parent, "hand", hand)
    text += link("hand", inertial(point(palm), HAND_MASS, 0.03)
                 + solid(palm, '<box size="0.08 0.07 0.02"/>', "dark"))  # fmt: skip
    return HEADER + text + "</robot>\n"


HEADER = """<?xml version="1.0"?>
<!-- The arm and waist of an iCub, written by tools/dev/icub_urdf.py: change it there. Base frame
     "ground": between the feet, x forward, y left, z up. Link "root" has the frame of the public
     kinematics, "hand" that of the palm: x towards the fingers, z out of the palm, -y at the
     thumb. Every joint turns about its z. -->
<robot name="icub">
  <material name="shell"><color rgba="0.82 0.82 0.84 1"/></material>
  <material name="dark"><color rgba="0.22 0.23 0.26 1"/></material>
  <material name="blue"><color rgba="0.30 0.40 0.60 1"/></material>

"""


if __name__ == "__main__":
    sys.stdout.write(build())
