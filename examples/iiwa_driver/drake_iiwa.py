"""An iiwa in Drake, behind Drake's own driver of a simulated one: IIWA_STATUS and IIWA_COMMAND as a
real arm has them, and END_EFFECTOR as a tracking system would measure it."""

import argparse
import time
from pathlib import Path

import lcm
import pydrake.manipulation as kuka
from drake import lcmt_iiwa_command, lcmt_iiwa_status
from pydrake.lcm import DrakeLcm
from pydrake.multibody.parsing import Parser
from pydrake.multibody.plant import AddMultibodyPlantSceneGraph, MultibodyPlant
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import DiagramBuilder
from pydrake.systems.lcm import LcmInterfaceSystem, LcmPublisherSystem, LcmSubscriberSystem
from reach.messages import reach as types

URL = "udpm://239.255.76.67:7667?ttl=0"
START = [0.3, 0.5, -0.2, 0.9, 0.2, 0.6, 0.0]  # rad
EFFECTOR_PERIOD = 0.02  # s


def fill(plant: MultibodyPlant, urdf: Path):
    """The arm, welded to the world, with a motor at each joint. Returns its model."""
    (arm,) = Parser(plant).AddModels(str(urdf))
    plant.WeldFrames(plant.world_frame(), plant.GetFrameByName("iiwa_link_0"))
    if plant.num_actuators() == 0:  # the URDF has no transmissions
        for i in range(1, 8):
            joint = plant.GetJointByName(f"iiwa_joint_{i}")
            plant.AddJointActuator(f"motor_{i}", joint)
    plant.Finalize()
    return arm


def wire(builder: DiagramBuilder, driver, bus) -> None:
    """The driver's ports to the two messages."""
    receiver = builder.AddSystem(kuka.IiwaCommandReceiver())
    command = builder.AddSystem(
        LcmSubscriberSystem.Make("IIWA_COMMAND", lcmt_iiwa_command, bus, use_cpp_serializer=True)
    )
    builder.Connect(command.get_output_port(), receiver.GetInputPort("lcmt_iiwa_command"))
    builder.Connect(
        driver.GetOutputPort("position_measured"), receiver.GetInputPort("position_measured")
    )
    builder.Connect(receiver.GetOutputPort("position"), driver.GetInputPort("position"))
    sender = builder.AddSystem(kuka.IiwaStatusSender())
    for port in range(sender.num_input_ports()):
        name = sender.get_input_port(port).get_name()
        if driver.HasOutputPort(name):
            builder.Connect(driver.GetOutputPort(name), sender.GetInputPort(name))
    status = builder.AddSystem(
        LcmPublisherSystem.Make(
            "IIWA_STATUS", lcmt_iiwa_status, bus, publish_period=kuka.kIiwaLcmStatusPeriod,
            use_cpp_serializer=True,
        )
    )  # fmt: skip
    builder.Connect(sender.get_output_port(), status.get_input_port())


class Effector:
    """Where the hand is, with the time of our clock."""

    def __init__(self, plant: MultibodyPlant):
        self._plant = plant
        self._frame = plant.GetFrameByName("iiwa_link_ee")
        self._lcm = lcm.LCM(URL)
        self._message = types.end_effector_t()

    def tell(self, context) -> None:
        pose = self._frame.CalcPoseInWorld(self._plant.GetMyContextFromRoot(context))
        self._message.utime = time.time_ns() // 1000
        self._message.seq += 1
        self._message.position = list(pose.translation())
        self._lcm.publish("END_EFFECTOR", self._message.encode())


def main() -> None:
    parser = argparse.ArgumentParser(prog="drake_iiwa.py", description=__doc__)
    parser.add_argument("--urdf", type=Path, default=Path(__file__).parent / "iiwa.urdf")
    options = parser.parse_args()
    builder = DiagramBuilder()
    plant, _ = AddMultibodyPlantSceneGraph(builder, time_step=0.001)
    arm = fill(plant, options.urdf)
    its_model = MultibodyPlant(0.001)  # what the controller knows of the arm
    fill(its_model, options.urdf)
    driver = kuka.SimIiwaDriver.AddToBuilder(
        builder, plant, arm, kuka.IiwaDriver(control_mode="position_only"), its_model
    )
    wire(builder, driver, builder.AddSystem(LcmInterfaceSystem(lcm=DrakeLcm(URL))))
    simulator = Simulator(builder.Build())
    context = simulator.get_mutable_context()
    plant.SetPositions(plant.GetMyContextFromRoot(context), arm, START)
    simulator.set_target_realtime_rate(1.0)
    effector = Effector(plant)
    while True:
        effector.tell(context)
        simulator.AdvanceTo(context.get_time() + EFFECTOR_PERIOD)


if __name__ == "__main__":
    main()
