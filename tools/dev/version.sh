#!/bin/sh
# The version of this tree, "0.1.0 (c17bd48)": CMakeLists.txt's, and the git revision, or the one
# that `git archive` put here, or "unknown".
#   usage: version.sh [--debian | FILE]
# prints it; with FILE writes it there, and leaves a FILE that holds it untouched. --debian: as a
# package's, "0.1.0+git712.c17bd48", which grows with every commit.
set -eu
root=$(dirname "$(readlink -f "$0")")/../..
# shellcheck disable=SC2016 # git expands it, not the shell
archived='$Format:%h$'

# Only of a repository whose root this is: a copy inside another one is not of that one's revision.
repository_revision() {
    [ "$(git -C "$root" rev-parse --show-cdup 2>/dev/null || echo none)" = '' ] &&
        git -C "$root" describe --always --dirty 2>/dev/null
}

revision() {
    repository_revision && return
    case $archived in
    *Format*) echo unknown ;;
    *) echo "$archived" ;;
    esac
}

debian_suffix() {
    local_revision=$(repository_revision) || return 0
    echo "+git$(git -C "$root" rev-list --count HEAD).$(echo "$local_revision" | tr - .)"
}

number=$(sed -n 's/^project(reachd VERSION \([0-9.]*\) .*/\1/p' "$root/CMakeLists.txt")
version="$number ($(revision))"
if [ $# -eq 0 ]; then
    echo "$version"
elif [ "$1" = --debian ]; then
    echo "$number$(debian_suffix)"
elif [ "$(cat "$1" 2>/dev/null || true)" != "$version" ]; then
    echo "$version" >"$1"
fi
