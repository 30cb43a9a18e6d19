#!/usr/bin/env bash
# Whether arm64 (Raspberry Pi, Jetson) computes what this machine does: builds everything for it and runs
# unit tests and the replay of the golden logs under qemu. The libraries are those of the same Debian.
#   usage: arm64.sh [TESTS]    TESTS: a pattern for ctest -R, to run fewer
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/../.."
tree=build/machines/arm64
triple=aarch64-linux-gnu

fail() {
    echo "arm64: $*" >&2
    exit 1
}

# Every package whose headers or libraries the build wants.
wanted_packages() {
    awk '$1 == "build" && ($2 ~ /-dev$/ || $2 == "check") { print $2 }' cmake/packages.txt
    echo libblas-dev liblapack-dev libc6-dev libstdc++-12-dev libgl1-mesa-dri | tr ' ' '\n'
}

# The packages are unpacked and never configured, so that no program of theirs runs here.
make_tree() {
    local suite links
    suite=$(. /etc/os-release && echo "$VERSION_CODENAME")
    rm -rf "$tree" "$tree.new"
    mmdebstrap --variant=extract --architectures=arm64 --include="$1" "$suite" "$tree.new"
    # Links that start at the root would lead to this machine's own libraries.
    links=$tree.new/usr/lib/$triple
    find "$tree.new" -type l -lname '/*' -printf '%P %l\n' | while read -r link target; do
        ln -sfrT "$tree.new$target" "$tree.new/$link"
    done
    # What update-alternatives would have made.
    ln -sf {blas/libblas,lapack/liblapack}.so{,.3} "$links"
    # Ceres names what it links against by where it lies on its own machine.
    sed -i "s#/usr/lib/$triple/lib#$PWD/$tree&#g" "$links/cmake/Ceres/CeresTargets.cmake"
    rm -rf "$tree.new/var/cache/apt"
    echo "$1" >"$tree.new/etc/reach-packages"
    mv "$tree.new" "$tree"
}

for program in mmdebstrap qemu-aarch64-static $triple-g++; do
    command -v "$program" >/dev/null || fail "no $program: ./run test --full installs it"
done
packages=$(wanted_packages | paste -sd,)
if [ "$(cat "$tree/etc/reach-packages" 2>/dev/null)" != "$packages" ]; then
    echo "arm64: making $tree" >&2
    mkdir -p build/machines
    make_tree "$packages" >"$tree.log" 2>&1 || {
        tail "$tree.log" >&2
        fail "no tree; $tree.log tells all"
    }
fi
cmake --preset arm64 >build/configure-arm64.log 2>&1 || {
    cat build/configure-arm64.log >&2
    fail "cmake could not configure preset 'arm64'"
}
cmake --build --preset arm64

for log in tests/golden/*.xz; do
    unpacked=build/arm64/$(basename "$log" .xz)
    xz --decompress --stdout "$log" >"$unpacked"
    qemu-aarch64-static -L "$tree" build/arm64/bin/reachd --replay "$unpacked" --verify ||
        fail "$log: what arm64 computes is not what was recorded"
done
ctest --test-dir build/arm64 --output-on-failure -L unit -R "${1:-^(test|fuzz)_}"
