#!/bin/sh
# Runs a command in a network namespace of its own, with multicast on the loopback alone: LCM works
# in it, and nothing enters or leaves the machine.
#   usage: netns.sh [--no-route] COMMAND [ARGUMENTS]
# --no-route leaves the multicast route out, for tests of what programs say then.
set -eu

fail() {
    echo "netns: $*" >&2
    exit 1
}

inside() {
    route=$1
    shift
    ip link set lo up multicast on || fail "cannot bring lo up; is iproute2 installed?"
    [ "$route" = no ] || ip route add 224.0.0.0/4 dev lo || fail "cannot add the multicast route"
    exec "$@"
}

route=yes
case ${1:-} in
'' | -h | --help)
    echo "usage: netns.sh [--no-route] COMMAND [ARGUMENTS]"
    [ -n "${1:-}" ] || exit 2
    exit 0
    ;;
--inside)
    shift
    inside "$@"
    ;;
--no-route)
    route=no
    shift
    ;;
esac

# Who is not root becomes root of a user namespace, which owns the network namespace.
user=''
[ "$(id -u)" -eq 0 ] || user='--user --map-root-user'
# shellcheck disable=SC2086 # none or two words
unshare $user --net true 2>/dev/null ||
    fail "no network namespace can be made here; allow it (as root: sysctl -w" \
        "kernel.unprivileged_userns_clone=1, in a container: --cap-add SYS_ADMIN) or run as root"
# shellcheck disable=SC2086
exec unshare $user --net "$0" --inside "$route" "$@"
