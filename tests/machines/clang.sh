#!/usr/bin/env bash
# The other compiler builds everything, warns of nothing, and its programs pass the unit tests.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/../.."
REACH_WERROR=ON cmake --preset clang >build/configure-clang.log 2>&1 || {
    cat build/configure-clang.log >&2
    exit 1
}
cmake --build --preset clang
ctest --test-dir build/clang --output-on-failure -L unit
