#!/usr/bin/env bash
# Formatting and static checks of our own sources; generated code is not in the tree. Called by
# ./run lint, after the packages are there and build/ is configured.
set -uo pipefail
cd "$(dirname "$(readlink -f "$0")")/../.." || exit
failed=()

check() {
    local name=$1 start=$SECONDS
    shift
    if "$@"; then
        printf 'lint: %-13s ok (%d s)\n' "$name" $((SECONDS - start))
    else
        printf 'lint: %-13s FAILED\n' "$name"
        failed+=("$name")
    fi
}

sources() { git ls-files --cached --others --exclude-standard -- "$@"; }

c_sources() { sources '*.c' '*.h' '*.cc' '*.cpp'; }

check_format() {
    local wrong
    wrong=$(c_sources | xargs -r .venv/bin/clang-format -n -Werror 2>&1 | sed -n 's/:[0-9]*:.*error:.*//p' |
        sort -u)
    [ -z "$wrong" ] || {
        # shellcheck disable=SC2086 # a list of names
        printf 'lint: %s is not formatted; ./run lint --fix\n' $wrong
        return 1
    }
}

fix() {
    c_sources | xargs -r .venv/bin/clang-format -i
    .venv/bin/ruff check -q --fix . || true
    .venv/bin/ruff format -q .
}

check_size() {
    sources '*.c' '*.h' '*.cc' '*.cpp' '*.py' '*.sh' run | xargs -r wc -l |
        awk '$2 != "total" && $1 > 400 { print "lint: " $2 " has " $1 " lines, at most 400"; bad = 1 }
             END { exit bad }'
}

# clang-tidy works on what the build compiles; headers are checked through their users. Tests are
# left out: their macros confuse both analysers, and they would double the time.
check_tidy() {
    local files
    # The generated headers that the sources include.
    cmake --build build --target reach_lcmtypes reach_lcmtypes_cpp_files iiwa_lcmtypes >build/lint.log 2>&1 || {
        cat build/lint.log
        return 1
    }
    files=$(.venv/bin/python tools/dev/compiled_sources.py build/compile_commands.json)
    # shellcheck disable=SC2086 # a list of files without blanks
    printf '%s\n' $files | xargs -r -P 2 -n 1 clang-tidy -p build --quiet >build/tidy.log 2>/dev/null ||
        { grep -E 'warning:|error:' build/tidy.log | sort -u; return 1; }
}

check_cppcheck() {
    sources '*.c' '*.cc' '*.cpp' | grep -v '^tests/' >build/cppcheck.txt
    cppcheck --file-list=build/cppcheck.txt -j 2 -q -I . \
        --enable=warning,performance,portability --inline-suppr --error-exitcode=1 \
        --suppressions-list=cmake/cppcheck-suppressions.txt
}

check_python() { .venv/bin/ruff check -q . && .venv/bin/ruff format -q --check .; }

check_shell() { sources '*.sh' '*.bash' run .ci/run | xargs -r shellcheck -x; }

# The loop thread: no recursion, no forbidden call, a bounded stack.
check_loop() { .venv/bin/python tools/dev/loop_stack.py; }

# Which folder includes which: no circle, and nothing from above.
check_rooms() { .venv/bin/python tools/dev/include_graph.py "$@"; }

case ${1:-} in
'') ;;
--fix) fix ;;
--graph)
    check_rooms --graph
    exit
    ;;
*)
    echo "lint: unknown option '$1'; there are --fix, which formats in place, and --graph, which draws" \
        "what includes what" >&2
    exit 2
    ;;
esac
check format check_format
check size check_size
check rooms check_rooms
check python check_python
check shell check_shell
check cppcheck check_cppcheck
check clang-tidy check_tidy
check loop check_loop

if [ "${#failed[@]}" -gt 0 ]; then
    echo "lint: failed: ${failed[*]}"
    exit 1
fi
echo "lint: everything passed"
