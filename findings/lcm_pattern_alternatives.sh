#!/usr/bin/env bash
# lcm 1.5.3 (PyPI): a subscription to 'A|B' also gets every channel that begins with A or ends with B.
#
# A subscription takes a regular expression, and one expects that it must match a channel's whole name,
# since 'POSE' does not get 'POSE_RAW'. The library writes ^ before it and $ behind it, without brackets:
# '^A|B$' means "begins with A, or ends with B". Only '(A|B)' is what was meant. A logger that is told
# 'STATE|IMAGE' so records 'STATE_DEBUG' and 'THUMBNAIL_IMAGE', too.
#
# Needs python3 with venv, and the network for pip. Ends with 0 while that is so, with 1 when it is not.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/python" -m pip install -q --disable-pip-version-check lcm==1.5.3

heard=$("$folder/venv/bin/python" - <<'PYTHON'
import lcm

CHANNELS = ["STATE", "IMAGE", "STATE_DEBUG", "THUMBNAIL_IMAGE", "OTHER"]

for pattern in ("STATE|IMAGE", "(STATE|IMAGE)"):
    bus = lcm.LCM("memq://")
    heard = []
    bus.subscribe(pattern, lambda channel, data: heard.append(channel))
    for channel in CHANNELS:
        bus.publish(channel, b"x")
    while bus.handle_timeout(100) > 0:
        pass
    print(pattern, *heard)
PYTHON
)
printf '%s\n' "$heard"
expected='STATE|IMAGE STATE IMAGE STATE_DEBUG THUMBNAIL_IMAGE
(STATE|IMAGE) STATE IMAGE'
[ "$heard" = "$expected" ] || {
    echo "this has changed; it was:" >&2
    printf '%s\n' "$expected" >&2
    exit 1
}
