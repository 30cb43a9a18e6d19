# Sourced: a root of its own for a test, a Debian tree with our packages installed into it, in mount
# and PID namespaces that the test has made for itself. Nothing of the machine's own root is written.
# shellcheck shell=sh

fail() {
    echo "$(basename "$0"): $*" >&2
    exit 1
}

# A mount that is shared would be seen by the machine.
check_private() {
    if grep -q ' shared:' /proc/self/mountinfo; then fail "$1: a mount is shared with the machine"; fi
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

# make_root BASE PACKAGES WORK: WORK/root is BASE, whose changes go to memory, with the packages of
# the folder PACKAGES. dpkg refuses them where BASE lacks what they depend on.
make_root() {
    [ $$ -eq 1 ] || fail "this is not the first process of a PID namespace"
    mount --make-rprivate /
    check_private "before"
    mount -t tmpfs tmpfs "$3"
    mkdir "$3/changes" "$3/scratch" "$3/root"
    mount -t overlay -o "lowerdir=$1,upperdir=$3/changes,workdir=$3/scratch" overlay "$3/root"
    mkdir "$3/root/packages"
    cp "$2"/*.deb "$3/root/packages"
    mount -t proc -o nosuid,nodev,noexec proc "$3/root/proc"
    mount_devices "$3/root/dev"
    chroot "$3/root" sh -c 'dpkg --install /packages/*.deb' >"$3/dpkg.log" 2>&1 || {
        cat "$3/dpkg.log" >&2
        fail "the packages cannot be installed"
    }
}
