#!/usr/bin/env bash
# Makes a Debian tree with systemd and with what installed programs of ours need to run, once; it is
# made anew when the list of packages changes.
#   usage: tree.sh FOLDER PROGRAM...
set -euo pipefail
root=$(dirname "$(readlink -f "$0")")/../..

fail() {
    echo "tree: $*" >&2
    exit 1
}

# The packages of the libraries that the programs name.
library_packages() {
    local program library path
    for program; do
        readelf -d "$program" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' | while read -r library; do
            path=$(ldd "$program" | awk -v name="$library" '$1 == name { print $3 }')
            [ -z "$path" ] || dpkg -S "$path" 2>/dev/null || dpkg -S "/usr$path" 2>/dev/null ||
                fail "no package has $path, which $program needs"
        done
    done | cut -d: -f1 | sort -u
}

wanted_packages() {
    library_packages "$@"
    awk '$1 == "run" { print $2 }' "$root/cmake/packages.txt"
}

# In namespaces of its own, so that nothing which a package starts or mounts outlives it.
install_packages() {
    local tree=$1
    shift
    # shellcheck disable=SC2016 # expanded inside
    unshare --mount --pid --fork --kill-child chroot "$tree" sh -c '
        mount -t proc proc /proc && apt-get -q update &&
        DEBIAN_FRONTEND=noninteractive apt-get -q -y -o Dpkg::Use-Pty=0 \
            install --no-install-recommends "$@" && apt-get clean' sh "$@"
}

make_tree() {
    local tree=$1 packages=$2 suite
    suite=$(. /etc/os-release && echo "$VERSION_CODENAME")
    rm -rf "$tree" "$tree.new"
    debootstrap --variant=minbase "$suite" "$tree.new" || fail "debootstrap failed"
    # shellcheck disable=SC2086 # a list of names
    install_packages "$tree.new" $packages || fail "the packages could not be installed"
    echo "$packages" >"$tree.new/etc/reach-packages"
    mv "$tree.new" "$tree"
}

[ $# -ge 2 ] || fail "usage: tree.sh FOLDER PROGRAM..."
[ "$(id -u)" -eq 0 ] || fail "only root can make a tree to boot"
tree=$1
shift
packages=$(wanted_packages "$@")
cmp -s "$tree/etc/reach-packages" <(echo "$packages") && exit 0
echo "tree: making $tree" >&2
mkdir -p "$(dirname "$tree")"
make_tree "$tree" "$packages" >"$tree.log" 2>&1 || {
    tail "$tree.log" >&2
    fail "no tree; $tree.log tells all"
}
