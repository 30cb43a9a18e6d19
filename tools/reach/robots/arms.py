"""The arms, by name, before anything of them was measured. Files are below the folder into which
their packages are installed (requirements-robots.txt)."""

from dataclasses import dataclass
from pathlib import Path

from ..messages import ROOT

_DATA = "cmeel.prefix/share/example-robot-data/robots"
_FOURIER = "fourier_robot_descriptions/assets/urdf"
_DEXMATE = "dexmate_urdf/robots/humanoid"


@dataclass(frozen=True)
class Public:
    name: str
    file: str
    tip: str | None = None  # None: as reach-new-robot chooses
    ours: bool = False  # in this tree

    def path(self, packages: Path) -> Path:
        return (ROOT if self.ours else packages) / self.file


OURS = [
    Public(name, f"etc/robots/{name}.urdf", ours=True) for name in ("kobian", "icub", "sixaxis")
]
PUBLIC = [
    Public("panda", f"{_DATA}/panda_description/urdf/panda.urdf"),
    Public("ur3", f"{_DATA}/ur_description/urdf/ur3_robot.urdf"),
    Public("ur5", f"{_DATA}/ur_description/urdf/ur5_robot.urdf"),
    Public("ur10", f"{_DATA}/ur_description/urdf/ur10_robot.urdf"),
    Public("ur3e", "airo_models/arms/ur3e/ur3e.urdf"),
    Public("ur5e", "airo_models/arms/ur5e/ur5e.urdf"),
    Public("xarm7", f"{_DATA}/xarm_description/urdf/xarm7.urdf"),
    Public("kinova", f"{_DATA}/kinova_description/robots/kinova.urdf"),
    Public("z1", f"{_DATA}/z1_description/urdf/z1.urdf"),
    Public("so100", f"{_DATA}/so_arm_description/urdf/so100.urdf"),
    Public("so101", f"{_DATA}/so_arm_description/urdf/so101.urdf"),
    Public("baxter", f"{_DATA}/baxter_description/urdf/baxter.urdf"),
    Public("tiago", f"{_DATA}/tiago_description/robots/tiago.urdf"),
    Public("tiago-dual", f"{_DATA}/tiago_description/robots/tiago_dual.urdf"),
    Public("tiago-pro", f"{_DATA}/tiago_pro_description/robots/tiago_pro.urdf"),
    Public("pr2", f"{_DATA}/pr2_description/urdf/pr2.urdf"),
    Public("talos-arm", f"{_DATA}/talos_data/robots/talos_left_arm.urdf"),
    Public("talos", f"{_DATA}/talos_data/robots/talos_full_v2.urdf"),
    Public("romeo", f"{_DATA}/romeo_description/urdf/romeo.urdf"),
    Public("icub-data", f"{_DATA}/icub_description/robots/icub.urdf"),
    Public("icub-gazebo", "../../../share/iCub/robots/iCubGazeboV2_5/model.urdf"),
    Public("centauro", f"{_DATA}/centauro_description/urdf/centauro.urdf"),
    Public("alex", f"{_DATA}/alex_description/urdf/alex_nub_hands.urdf"),
    Public("g1", f"{_DATA}/g1_description/urdf/g1_29dof_rev_1_0.urdf"),
    Public("human", f"{_DATA}/human_description/robots/human.urdf"),
    Public("vega", f"{_DEXMATE}/vega_1u/vega_1u.urdf"),
    Public("armar6", "armar/description/urdf/armar6.urdf", tip="arm_t8_r0"),
    Public("armar4", "armar/description/urdf/armar4.urdf"),
    Public("gr1", f"{_FOURIER}/gr1t2.urdf"),
    Public("gr3", f"{_FOURIER}/gr3.urdf"),
]
# Of different makers and sizes: for tests that have no hour.
TEN = (
    "panda", "ur5", "ur10", "xarm7", "kinova", "z1", "so100", "so101", "tiago", "tiago-pro",
)  # fmt: skip
