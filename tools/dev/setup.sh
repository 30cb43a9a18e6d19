# Sourced by ./run: installs what is missing and nothing else, so that it costs nothing when all is
# there. The packages and their reasons are in cmake/packages.txt and requirements.txt.
# shellcheck shell=bash

# The names of a group ("build" or "lint") in cmake/packages.txt.
setup_wanted() { awk -v group="$1" '$1 == group { print $2 }' cmake/packages.txt; }

setup_missing() {
    comm -23 <(setup_wanted "$1" | sort -u) \
        <(dpkg-query -W -f '${db:Status-Abbrev} ${binary:Package}\n' 2>/dev/null |
            awk '$1 == "ii" { sub(/:.*/, "", $2); print $2 }' | sort -u)
}

# How this user installs packages: nothing in front, sudo, or no way at all.
setup_privilege() {
    if [ "$(id -u)" -eq 0 ]; then
        echo env
    elif command -v sudo >/dev/null; then
        echo sudo
    else
        return 1
    fi
}

# The oldest versions that do, and the oldest systems that have them.
readonly SETUP_CMAKE=3.25 SETUP_PYTHON=3.11 SETUP_SYSTEMS="Debian 12 or Ubuntu 24.04"

setup_packages() {
    local missing privilege command
    command -v apt-get >/dev/null || {
        setup_told "$1"
        return 0
    }
    missing=$(setup_missing "$1" | paste -sd ' ')
    [ -n "$missing" ] || return 0
    command="apt-get install -y --no-install-recommends $missing"
    privilege=$(setup_privilege) ||
        setup_fail "Debian packages are missing and there is no sudo; as root: $command"
    echo "run: installing $missing" >&2
    setup_apt "$privilege" update ||
        setup_fail "apt-get update failed; mend the package sources, then: $command"
    setup_check_versions
    # shellcheck disable=SC2086 # a list of names
    setup_apt "$privilege" install --no-install-recommends $missing ||
        setup_fail "the installation failed; try by hand: $command"
}

# Without apt-get nobody can install for the user, who may have all by another name: said once a group,
# and what is missing then is found by CMake or by the test that wants it.
setup_told() {
    local told=build/packages-told.$1
    [ ! -e "$told" ] || return 0
    {
        echo "run: this is not Debian or Ubuntu (no apt-get). What is needed, by Debian's names, must be there:"
        awk -v group="$1" '$1 == group { sub(/^[^ ]+ +/, "    "); print }' cmake/packages.txt
        echo "run: going on with what is there (CMake $SETUP_CMAKE and Python $SETUP_PYTHON at least)"
    } >&2
    mkdir -p build
    : >"$told"
}

# Before anything is installed, so that a system that is too old ends with one line and not with an
# error of CMake after two gigabytes.
setup_check_versions() {
    setup_check_version cmake "$SETUP_CMAKE" "$(setup_candidate cmake)"
    setup_find_python >/dev/null ||
        setup_check_version python3 "$SETUP_PYTHON" "$(setup_candidate python3)"
}

# setup_check_version NAME OLDEST FOUND
setup_check_version() {
    printf '%s\n' "$2" "$3" | sort -V -C ||
        setup_fail "$1 $2 or newer is wanted, and this system has ${3:-none}: $SETUP_SYSTEMS at least"
}

# The version that apt-get would install, without its epoch; nothing where there is none.
setup_candidate() {
    apt-cache policy "$1" | awk '$1 == "Candidate:" && $2 != "(none)" { sub(/^[0-9]+:/, "", $2); print $2 }'
}

setup_apt() {
    local privilege=$1
    shift
    "$privilege" DEBIAN_FRONTEND=noninteractive apt-get -q -y \
        -o Dpkg::Use-Pty=0 -o DPkg::Lock::Timeout=300 "$@" >&2
}

# A Python new enough (tomllib) that can make virtual environments.
setup_find_python() {
    local candidate
    for candidate in python3 /usr/bin/python3; do
        if "$candidate" -c 'import sys, venv, ensurepip; sys.exit(sys.version_info[:2] <
            tuple(map(int, sys.argv[1].split("."))))' "$SETUP_PYTHON" 2>/dev/null; then
            echo "$candidate"
            return
        fi
    done
    return 1
}

setup_python() {
    local interpreter
    # The copy is made last: it says that the installation ended well.
    cmp -s requirements.txt .venv/requirements.installed && return 0
    interpreter=$(setup_find_python) ||
        setup_fail "Python $SETUP_PYTHON or newer with venv is wanted: apt-get install python3-venv"
    echo "run: installing Python packages into .venv" >&2
    "$interpreter" -m venv .venv ||
        setup_fail "the virtual environment failed: $interpreter -m venv .venv"
    .venv/bin/python -m pip install -q --disable-pip-version-check -r requirements.txt ||
        setup_fail "pip failed; try by hand: .venv/bin/python -m pip install -r requirements.txt"
    cp requirements.txt .venv/requirements.installed
}

# The viewer of ./run live, 170 MB to fetch and 500 MB on disk: too much for ./run demo, which says how
# to get it and writes no recording without it.
setup_live() {
    .venv/bin/python -c 'import rerun' 2>/dev/null && return 0
    echo "run: installing rerun-sdk into .venv" >&2
    .venv/bin/python -m pip install -q --disable-pip-version-check -r requirements-live.txt ||
        setup_fail "pip failed; try by hand: .venv/bin/python -m pip install -r requirements-live.txt"
    .venv/bin/rerun analytics disable >/dev/null 2>&1 || true # nothing leaves its namespace anyway
}

# The optimiser of ./run tune, and what its report compares with: 230 MB on disk.
setup_tune() {
    .venv/bin/python -c 'import optuna, sklearn' 2>/dev/null && return 0
    echo "run: installing optuna and scikit-learn into .venv" >&2
    .venv/bin/python -m pip install -q --disable-pip-version-check -r requirements-tune.txt ||
        setup_fail "pip failed; try by hand: .venv/bin/python -m pip install -r requirements-tune.txt"
}

setup_fail() {
    echo "run: $*" >&2
    exit 1
}
