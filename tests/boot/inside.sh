#!/bin/sh
# Becomes the systemd of a Debian tree. Runs as the first process of new PID, mount, network, UTS,
# IPC and cgroup namespaces (machine.py makes them); nothing of the machine's own root is written.
#   usage: inside.sh BASE BUILD WORK
# BASE is the tree (tree.sh), which stays as it is: changes go to memory. BUILD holds what is
# installed into it, WORK is an empty folder to mount in.
set -eu

fail() {
    echo "inside: $*" >&2
    exit 1
}

# A mount that is shared would be seen by the machine.
check_private() {
    if grep -q ' shared:' /proc/self/mountinfo; then fail "$1: a mount is shared with the machine"; fi
}

# /proc/self/mountinfo's line of the root: its type and its options.
root_mount() {
    awk '$5 == "/" { line = $0 } END { print line }' /proc/self/mountinfo
}

mount_devices() {
    mount -t tmpfs -o mode=755,nosuid tmpfs "$1"
    mkdir "$1/pts" "$1/shm"
    mount -t devpts -o newinstance,ptmxmode=0666 devpts "$1/pts"
    mount -t tmpfs -o mode=1777,nosuid,nodev tmpfs "$1/shm"
    for device in null zero full random urandom tty; do
        : >"$1/$device"
        mount --bind "/dev/$device" "$1/$device"
    done
    ln -s pts/ptmx "$1/ptmx"
    ln -s /proc/self/fd "$1/fd"
}

# What systemd wants to find mounted. The kernel's switches are for reading only.
mount_all() {
    mount -t proc -o nosuid,nodev,noexec proc "$1/proc"
    mount --bind "$1/proc/sys" "$1/proc/sys"
    mount -o remount,bind,ro "$1/proc/sys"
    mount -t sysfs -o ro,nosuid,nodev,noexec sysfs "$1/sys"
    mount -t cgroup2 -o nosuid,nodev,noexec cgroup2 "$1/sys/fs/cgroup"
    mount -t tmpfs -o mode=755,nosuid,nodev tmpfs "$1/run"
    mount -t tmpfs -o mode=1777,nosuid,nodev tmpfs "$1/tmp"
    mount_devices "$1/dev"
}

make_root() {
    mount -t tmpfs tmpfs "$work"
    mkdir "$work/changes" "$work/scratch" "$work/root"
    mount -t overlay -o "lowerdir=$base,upperdir=$work/changes,workdir=$work/scratch" overlay \
        "$work/root"
    DESTDIR="$work/root" cmake --install "$build" >/dev/null || fail "the installation failed"
    echo "$mark" >"$work/root/etc/reach-booted"
    : >"$work/root/etc/machine-id"
    chroot "$work/root" systemctl enable reach.target || fail "the target cannot be enabled"
    chroot "$work/root" systemctl set-default reach.target
}

base=$1 build=$2 work=$3
mark=$(cat /proc/sys/kernel/random/uuid)
[ $$ -eq 1 ] || fail "this is not the first process of a PID namespace"
mount --make-rprivate /
check_private "before"
make_root
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
