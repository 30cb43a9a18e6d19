"""An arm in a URDF: its joints from the base to the tip, and where its links are.

Only what a configuration needs. What is wrong with masses, motors or meshes, reach-simrobot says.
"""

import re
import xml.etree.ElementTree as ET
from dataclasses import dataclass
from pathlib import Path
from xml.parsers import expat

import numpy as np

TURNS, SLIDES = ("revolute", "continuous"), ("prismatic",)
SLOW = 0.17  # rad/s or m/s: such as a torso that is lifted
_FINGER = re.compile("finger|grip|jaw|thumb", re.IGNORECASE)


class UnusableError(Exception):
    """No arm can be made of this file; one line that says why, and what to do."""


@dataclass(frozen=True)
class Joint:
    name: str
    kind: str
    parent: str
    child: str
    origin: np.ndarray  # 4 x 4, its frame in the parent link's, at zero
    axis: np.ndarray  # unit vector
    lower: float  # rad or m; -inf and inf: turns without end
    upper: float
    velocity: float  # rad/s or m/s
    leader: str = ""  # <mimic>: position = multiplier * the leader's + offset
    multiplier: float = 1
    offset: float = 0
    fault: str = ""  # what is wrong with its numbers, if it is to be used

    @property
    def finger(self) -> bool:
        return _FINGER.search(self.name) is not None

    @property
    def slides(self) -> bool:
        return self.kind in SLIDES

    @property
    def unit(self) -> str:
        return "m" if self.slides else "rad"

    @property
    def drivable(self) -> bool:
        return self.kind in TURNS + SLIDES and not self.leader

    def moved(self, position: float) -> np.ndarray:
        """Frame of the child link in the parent's."""
        pose = np.eye(4)
        if self.slides:
            pose[:3, 3] = position * self.axis
        else:
            pose[:3, :3] = _turn(self.axis, position)
        return self.origin @ pose


class Urdf:
    """The tree of links. UnusableError: there is none."""

    def __init__(self, path: Path):
        self.path = path
        root = _parse(path)
        self.name = root.get("name") or path.stem
        self.joints = [_joint(element) for element in root.findall("joint")]
        self.links = [element.get("name", "") for element in root.findall("link")]
        self._above = {joint.child: joint for joint in self.joints}
        tops = [link for link in self.links if link not in self._above]
        if len(tops) != 1:
            raise UnusableError(
                f"{path}: one link must carry all others; these hang on none: {tops}"
            )
        self.base = tops[0]

    def path_to(self, link: str) -> list[Joint]:
        """All joints from the base to this link, fixed ones too."""
        if link not in self.links:
            raise UnusableError(f"{self.path}: there is no link '{link}'")
        path: list[Joint] = []
        while joint := self._above.get(link):
            path.insert(0, joint)
            link = joint.parent
            if len(path) > len(self.joints):
                raise UnusableError(f"{self.path}: its links hang in a ring")
        return path

    def tip(self) -> str:
        """Where the hand is, if nobody says it: on the longest chain, before fingers, the link that
        is farthest from the last joint."""
        longest = max(self.links, key=lambda link: sum(j.drivable for j in self.path_to(link)))
        path = [joint for joint in self.path_to(longest) if joint.kind != "fixed"]
        if not any(joint.drivable for joint in path):
            raise UnusableError(f"{self.path}: no joint of it moves")
        last = self._wrist(path)
        rigid = [link for link in self.links if self._carrier(link) is last]
        return max(rigid, key=lambda link: (self._distance(last, link), link))

    def _wrist(self, path: list[Joint]) -> Joint:
        """The last joint before fingers: those that are called so, or where the chain spreads with
        few joints to come."""
        for done, joint in enumerate(path, start=1):
            if done > 1 and joint.finger:
                return path[done - 2]
            spread = [
                other
                for other in self.joints
                if other.kind != "fixed" and self._carrier(other.parent) is joint
            ]
            if len(spread) > 1 and len(path) - done < done:
                return joint
        return path[-1]

    def _carrier(self, link: str) -> Joint | None:
        """The nearest moving joint above a link."""
        return next((j for j in reversed(self.path_to(link)) if j.kind != "fixed"), None)

    def _distance(self, joint: Joint, link: str) -> float:
        path = self.path_to(link)
        frames = [other.origin for other in path[path.index(joint) + 1 :]]
        return round(float(np.linalg.norm(_product(frames)[:3, 3])), 9)


class Arm:
    """The joints to be driven, in the order of the messages, and the link whose place counts.

    `names`: these joints alone, in this order; else all between base and tip that are not so slow
    (rad/s, m/s) that they would hold up all others: the daemon has one speed for all.
    """

    def __init__(self, urdf: Urdf, tip: str | None = None, names: list[str] | None = None):
        self.urdf = urdf
        self.tip = tip or urdf.tip()
        self._path = urdf.path_to(self.tip)
        for joint in self._path:
            if joint.fault:
                raise UnusableError(f"{urdf.path}: joint {joint.name}: {joint.fault}")
        movable = {joint.name: joint for joint in self._path if joint.drivable}
        for name in names or []:
            if name not in movable:
                raise UnusableError(
                    f"{urdf.path}: joint '{name}' does not move link {self.tip}; those that do:"
                    f" {', '.join(movable) or 'none'}"
                )
        swift = [joint for joint in movable.values() if joint.velocity >= SLOW]
        usual = swift or list(movable.values())
        self.joints = [movable[name] for name in names] if names else usual
        self.left_out = [] if names else [j for j in movable.values() if j not in usual]
        if not 1 <= len(self.joints) <= 16:
            raise UnusableError(
                f"{urdf.path}: {len(self.joints)} joints move link {self.tip}, and 1 to 16 can be"
                f" driven; choose with --tip and --joints: {', '.join(movable)}"
            )

    @property
    def order(self) -> list[int]:
        """The joints from the base to the tip, by number from 1."""
        along = [joint.name for joint in self._path]
        return sorted(
            range(1, len(self.joints) + 1), key=lambda i: along.index(self.joints[i - 1].name)
        )

    def frames(self, positions: np.ndarray) -> list[np.ndarray]:
        """Base to tip: the frame of each link on the way. `positions` as `joints`, rad or m."""
        at = {joint.name: q for joint, q in zip(self.joints, positions, strict=True)}
        frames = [np.eye(4)]
        for joint in self._path:
            follows = joint.multiplier * at.get(joint.leader, 0.0) + joint.offset
            frames.append(frames[-1] @ joint.moved(at.get(joint.name, follows)))
        return frames

    def place(self, positions: np.ndarray) -> np.ndarray:
        """Of the tip, in the base's frame; m."""
        return self.frames(positions)[-1][:3, 3]


def _parse(path: Path) -> ET.Element:
    try:
        root = _tree(path.read_bytes().lstrip())
    except OSError as error:
        raise UnusableError(f"{path}: {error.strerror}") from None
    except expat.ExpatError as error:
        raise UnusableError(f"{path}:{error.lineno}: not a URDF robot: {error}") from None
    if path.suffix == ".xacro" or any(part.tag.startswith("xacro:") for part in root.iter()):
        raise UnusableError(
            f"{path}: is xacro, from which a URDF is made: xacro {path} > robot.urdf"
        )
    if root.tag != "robot":
        raise UnusableError(f"{path}: not a URDF robot: it begins with <{root.tag}>")
    return root


def _tree(text: bytes) -> ET.Element:
    """As ElementTree would make it, but prefixes that nobody declared are taken, as every program
    that reads URDF does."""
    builder, parser = ET.TreeBuilder(), expat.ParserCreate()
    parser.StartElementHandler, parser.EndElementHandler = builder.start, builder.end
    parser.Parse(text, True)
    return builder.close()


def _joint(element: ET.Element) -> Joint:
    name, kind = element.get("name", ""), element.get("type", "")
    parent, child = _attribute(element, "parent", "link"), _attribute(element, "child", "link")
    try:
        return Joint(name, kind, parent, child, **_numbers_of(element, kind))
    except ValueError as error:
        return Joint(name, kind, parent, child, np.eye(4), np.zeros(3), 0, 0, 0, fault=str(error))


def _numbers_of(element: ET.Element, kind: str) -> dict:
    limit, mimic = element.find("limit"), element.find("mimic")
    given = {} if limit is None else limit.attrib
    followed = {} if mimic is None else mimic.attrib
    endless = kind == "continuous" or limit is None
    axis = _numbers(_attribute(element, "axis", "xyz") or "1 0 0", 3)
    return {
        "origin": _origin(element.find("origin")),
        "axis": axis / max(np.linalg.norm(axis), 1e-12),
        "lower": -np.inf if endless else float(given.get("lower", 0)),
        "upper": np.inf if endless else float(given.get("upper", 0)),
        "velocity": float(given.get("velocity", 0)),
        "leader": followed.get("joint", ""),
        "multiplier": float(followed.get("multiplier", 1)),
        "offset": float(followed.get("offset", 0)),
    }


def _attribute(element: ET.Element, child: str, name: str) -> str:
    found = element.find(child)
    return "" if found is None else found.get(name, "")


def _numbers(text: str, count: int) -> np.ndarray:
    values = np.array([float(word) for word in text.split()])
    if len(values) != count or not np.isfinite(values).all():
        raise ValueError(f"{count} numbers are wanted, not '{text}'")
    return values


def _origin(element: ET.Element | None) -> np.ndarray:
    pose = np.eye(4)
    if element is None:
        return pose
    pose[:3, 3] = _numbers(element.get("xyz") or "0 0 0", 3)
    if quaternion := element.get("quat_xyzw"):
        pose[:3, :3] = _of_quaternion(_numbers(quaternion, 4))
    else:
        roll, pitch, yaw = _numbers(element.get("rpy") or "0 0 0", 3)
        pose[:3, :3] = (
            _turn(np.array([0, 0, 1.0]), yaw)
            @ _turn(np.array([0, 1.0, 0]), pitch)
            @ _turn(np.array([1.0, 0, 0]), roll)
        )
    return pose


def _of_quaternion(q: np.ndarray) -> np.ndarray:
    length = np.linalg.norm(q[:3])
    axis = q[:3] / length if length > 0 else q[:3]
    return _turn(axis, 2 * np.arctan2(length, q[3]))


def _turn(axis: np.ndarray, angle: float) -> np.ndarray:
    """Rodrigues' formula."""
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def _product(frames: list[np.ndarray]) -> np.ndarray:
    whole = np.eye(4)
    for frame in frames:
        whole = whole @ frame
    return whole
