#!/bin/sh
# Installs the packages in a Debian tree that has what they depend on and nothing of ours, runs the
# demo there, and removes them again; in namespaces of its own.
#   usage: demo_in_tree.sh BASE PACKAGES
set -eu
here=$(dirname "$(readlink -f "$0")")
# shellcheck source=tests/boot/root.sh
. "$here/root.sh"

in_tree() { chroot "$root" env -i LC_ALL=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin "$@"; }

inside() {
    make_root "$1" "$2" "$3"
    root=$3/root
    in_tree reach-lcm-setup # the demo's multicast
    cp "$here/demo.sh" "$root"
    in_tree sh /demo.sh /demo || fail "the demo failed"
    [ "$(in_tree python3 -c 'import reach; print(len(reach.read_log("/demo/run.lcmlog")["REACH_SAMPLE"]))')" = 6 ] ||
        fail "the log does not have the six samples"
    [ -s "$root/demo/tables/REACH_STATUS.csv" ] || fail "the log did not become tables"
    in_tree dpkg --purge reachd reach-sim reach-tools libreach-dev
    left=$(cd "$root" && find etc usr var/lib -name '*reach*' ! -path '*/dpkg/*' ! -name 'reach-packages')
    [ -z "$left" ] || fail "purging leaves: $left"
}

if [ "${1:-}" = --inside ]; then
    shift
    inside "$@"
    exit
fi
[ "$(id -u)" -eq 0 ] || fail "only root can have a root of its own"
work=$(mktemp -d)
status=0
unshare --mount --pid --net --ipc --uts --fork --kill-child "$0" --inside "$1" "$2" "$work" || status=$?
rmdir "$work"
exit $status
