"""What the daemon's numbers mean, in words."""


def body_words(status) -> str:
    """What is known of the robot's body."""
    if status.body == status.BODY_FOUND:
        return (f"found from {status.body_samples} samples, off by {status.body_error:.2f} times"
                f" the noise, unsure by {100 * status.body_doubt:.2f} %")  # fmt: skip
    others = {status.BODY_SEARCHING: "searching", status.BODY_NO_CHAIN: "not a chain",
              status.BODY_NO_FINDER: "no reach-finder on the bus"}  # fmt: skip
    return others.get(status.body, "none yet")
