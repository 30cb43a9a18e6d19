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

setup_packages() {
    local missing privilege command
    command -v apt-get >/dev/null ||
        setup_fail "this is not Debian or Ubuntu (no apt-get); install what cmake/packages.txt lists"
    missing=$(setup_missing "$1" | paste -sd ' ')
    [ -n "$missing" ] || return 0
    command="apt-get install -y --no-install-recommends $missing"
    privilege=$(setup_privilege) ||
        setup_fail "Debian packages are missing and there is no sudo; as root: $command"
    echo "run: installing $missing" >&2
    setup_apt "$privilege" update ||
        setup_fail "apt-get update failed; mend the package sources, then: $command"
    # shellcheck disable=SC2086 # a list of names
    setup_apt "$privilege" install --no-install-recommends $missing ||
        setup_fail "the installation failed; try by hand: $command"
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
        if "$candidate" -c 'import sys, venv, ensurepip; sys.exit(sys.version_info < (3, 11))' \
            2>/dev/null; then
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
        setup_fail "Python 3.11 or newer with venv is wanted: apt-get install python3-venv"
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
