#!/usr/bin/env bash
# The project as a newcomer with another Debian meets it: in a tree of that release, with nothing but
# git, ./run fetches what it needs, builds, tests, checks and runs the demo. What was fetched and built
# stays in build/machines/SUITE for the next time.
#   usage: debian.sh SUITE [COMMAND ...]    COMMAND: of ./run; without any: test lint demo
set -euo pipefail
here=$(dirname "$(readlink -f "$0")")
cd "$here/../.."
# shellcheck source=tests/boot/root.sh
. tests/boot/root.sh

# The way to the network is this machine's: whom it trusts, its proxy.
trusted=/etc/ssl/certs/ca-certificates.crt

make_tree() {
    rm -rf "$1" "$1.new"
    debootstrap --variant=minbase --include=git,ca-certificates "$2" "$1.new"
    mv "$1.new" "$1"
}

# A repository, since --version and lint ask git. Files keep their time, for short builds.
copy_source() {
    mkdir -p "$1"
    git ls-files -z --cached --others --exclude-standard |
        tar --create --null --files-from=- --ignore-failed-read | tar --extract --directory "$1"
    rm -rf "$1/.git"
    git -C "$1" init -q
    git -C "$1" add -A
    git -C "$1" -c user.name=nobody -c user.email=nobody@localhost commit -q -m "as it is"
}

# In namespaces of its own: nothing that a package starts or mounts outlives it.
inside() {
    local tree=$1 command network
    shift
    mount --make-rprivate /
    check_private "before"
    mount -t proc -o nosuid,nodev,noexec proc "$tree/proc"
    mount -t tmpfs -o mode=1777,nosuid,nodev tmpfs "$tree/tmp"
    mount_devices "$tree/dev"
    cp /etc/resolv.conf "$tree/etc/resolv.conf"
    cp "$trusted" "$tree$trusted"
    mapfile -t network < <(env | grep -iE '^(https?_proxy|no_proxy|pip_index_url)=' || true)
    for command; do
        echo "debian: ./run $command" >&2
        chroot "$tree" env -i "${network[@]}" PIP_CERT=$trusted LC_ALL=C.UTF-8 HOME=/root \
            PATH=/usr/sbin:/usr/bin:/sbin:/bin sh -c "cd /root/reachd && ./run $command" || fail "./run $command failed"
    done
}

if [ "${1:-}" = --inside ]; then
    shift
    inside "$@"
    exit
fi
suite=${1:?usage: debian.sh SUITE [COMMAND ...]}
shift
[ "$(id -u)" -eq 0 ] || fail "only root can have a tree of its own"
tree=build/machines/$suite
mkdir -p build/machines
[ -d "$tree" ] || make_tree "$tree" "$suite" >"$tree.log" 2>&1 || {
    tail "$tree.log" >&2
    fail "debootstrap failed; $tree.log tells all"
}
copy_source "$tree/root/reachd"
[ $# -gt 0 ] || set -- test lint demo
unshare --mount --pid --ipc --uts --fork --kill-child "$0" --inside "$PWD/$tree" "$@"
