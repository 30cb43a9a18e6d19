#!/usr/bin/env bash
# Makes a Debian tree with systemd and with what our packages depend on, but without them, once; it
# is made anew when what they depend on changes.
#   usage: tree.sh FOLDER PACKAGES    PACKAGES: the folder with our .deb files
set -euo pipefail

fail() {
    echo "tree: $*" >&2
    exit 1
}

# What packages depend on, and recommend, without what is in them themselves; the first of
# alternatives.
wanted_packages() {
    local package own
    own=$(for package; do dpkg-deb --field "$package" Package; done)
    for package; do
        dpkg-deb --field "$package" Depends Recommends | sed 's/^[A-Z][a-z]*: //' | tr ',' '\n' |
            sed 's/[(|].*//; s/ //g'
    done | grep -vxF "$own" | sort -u
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

[ $# -eq 2 ] || fail "usage: tree.sh FOLDER PACKAGES"
[ "$(id -u)" -eq 0 ] || fail "only root can make a tree to boot"
tree=$1
packages=$(wanted_packages "$2"/*.deb && echo systemd)
cmp -s "$tree/etc/reach-packages" <(echo "$packages") && exit 0
echo "tree: making $tree" >&2
mkdir -p "$(dirname "$tree")"
make_tree "$tree" "$packages" >"$tree.log" 2>&1 || {
    tail "$tree.log" >&2
    fail "no tree; $tree.log tells all"
}
