#!/bin/sh
# Makes LCM's UDP multicast work on this machine alone: what `reachctl doctor` finds about it, mended.
set -eu

group=239.255.76.67  # LCM's own
least_buffer=1843200 # bytes of a pair of raw images
good_buffer=8388608
dry_run=no

usage() {
    cat <<'TEXT'
usage: reach-lcm-setup [--dry-run]

Does what is missing of three things: the multicast flag of the loopback interface, a route for
multicast by it, so that nothing leaves the machine, and receive buffers that pairs of raw images
fit in.

To be called by root. It lasts until the machine is switched off; reach-lcm-setup.service does it at each start.

  --dry-run       print the commands, do nothing
  -h, --help      this text
  -V, --version   version and git revision

exit code: 0 all is there, 1 something failed, 2 wrong usage
TEXT
}

fail() {
    echo "reach-lcm-setup: $*" >&2
    exit 1
}

do_it() {
    echo "$*"
    [ "$dry_run" = yes ] || sh -c "$*" || fail "that failed; are you root?"
}

case ${1:-} in
'') ;;
--dry-run) dry_run=yes ;;
-h | --help)
    usage
    exit 0
    ;;
-V | --version)
    echo "reach-lcm-setup @REACH_VERSION@"
    exit 0
    ;;
*)
    echo "reach-lcm-setup: unknown option '$1'; see reach-lcm-setup --help" >&2
    exit 2
    ;;
esac
command -v ip >/dev/null || fail "there is no ip command: apt-get install iproute2"

flags=$(ip -o link show lo) || fail "there is no loopback interface"
case $flags in
*[\<,]UP[,\>]*) ;;
*) do_it "ip link set lo up" ;;
esac
case $flags in
*MULTICAST*) ;;
*) do_it "ip link set lo multicast on" ;;
esac
ip route get $group >/dev/null 2>&1 || do_it "ip route add 224.0.0.0/4 dev lo"
# Not every network namespace shows it, and none but the first may change it.
limit=/proc/sys/net/core/rmem_max
if [ -r $limit ] && [ "$(cat $limit)" -lt $least_buffer ]; then
    do_it "echo $good_buffer > $limit"
fi
