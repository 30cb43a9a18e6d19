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

# How to get a namespace here. Ubuntu since 24.04 makes one for a user and gives it no rights in it, so
# that the failure comes late; its other switch is on all the while.
remedy() {
    if [ "$(cat /proc/sys/kernel/apparmor_restrict_unprivileged_userns 2>/dev/null)" = 1 ]; then
        echo "allow it (as root: sysctl -w kernel.apparmor_restrict_unprivileged_userns=0) or run as root"
    else
        echo "allow it (as root: sysctl -w kernel.unprivileged_userns_clone=1, in a container:" \
            "--cap-add SYS_ADMIN) or run as root"
    fi
}

inside() {
    route=$1
    shift
    command -v ip >/dev/null || fail "cannot bring lo up: there is no program ip; install iproute2"
    ip link set lo up multicast on || fail "cannot bring lo up in the namespace; $(remedy)"
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
    fail "no network namespace can be made here; $(remedy)"
# shellcheck disable=SC2086
exec unshare $user --net "$0" --inside "$route" "$@"
