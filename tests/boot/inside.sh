#!/bin/sh
# Becomes the systemd of a Debian tree. Runs as the first process of new PID, mount, network, UTS,
# IPC and cgroup namespaces (machine.py makes them).
#   usage: inside.sh BASE PACKAGES WORK
# BASE is the tree (tree.sh), PACKAGES holds what is installed into it, WORK is an empty folder to
# mount in.
set -eu
# shellcheck source=tests/boot/root.sh
. "$(dirname "$0")/root.sh"

# /proc/self/mountinfo's line of the root: its type and its options.
root_mount() {
    awk '$5 == "/" { line = $0 } END { print line }' /proc/self/mountinfo
}

# What systemd wants to find mounted. The kernel's switches are for reading only.
mount_all() {
    mount --bind "$1/proc/sys" "$1/proc/sys"
    mount -o remount,bind,ro "$1/proc/sys"
    mount -t sysfs -o ro,nosuid,nodev,noexec sysfs "$1/sys"
    mount -t cgroup2 -o nosuid,nodev,noexec cgroup2 "$1/sys/fs/cgroup"
    mount -t tmpfs -o mode=755,nosuid,nodev tmpfs "$1/run"
    mount -t tmpfs -o mode=1777,nosuid,nodev tmpfs "$1/tmp"
}

base=$1 packages=$2 work=$3
mark=$(cat /proc/sys/kernel/random/uuid)
make_root "$base" "$packages" "$work"
echo "$mark" >"$work/root/etc/reach-booted"
: >"$work/root/etc/machine-id"
chroot "$work/root" systemctl enable reach.target || fail "the target cannot be enabled"
chroot "$work/root" systemctl set-default reach.target
mount_all "$work/root"
cd "$work/root"
mkdir -p .machine
pivot_root . .machine
umount -l /.machine
check_private "in the tree"
[ "$(cat /etc/reach-booted)" = "$mark" ] || fail "the root is not the tree"
case $(root_mount) in *' - overlay overlay '*) ;; *) fail "the root is not the tree's" ;; esac
exec env -i container=reach-boot PATH=/usr/sbin:/usr/bin:/sbin:/bin \
    setpriv --bounding-set=-sys_time,-sys_module,-sys_rawio,-syslog,-sys_pacct,-wake_alarm \
    /lib/systemd/systemd --log-target=journal --show-status=false
