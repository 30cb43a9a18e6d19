"""From a URDF to a robot that reaches: the configuration of simulator and daemon, and a trial."""
