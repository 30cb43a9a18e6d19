#!/usr/bin/env bash
# Runs every harness of build/fuzz for its share of the time. Called by ./run fuzz, which builds them.
#   usage: fuzz.sh SECONDS
# What they find interesting gathers in build/fuzz/found/; an input that breaks something is kept in
# out/fuzz/, and the harness, called with that file, shows it again.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/../.."
seconds=$1
harnesses=(build/fuzz/tests/fuzz_*)
share=$((seconds / ${#harnesses[@]}))
[ "$share" -ge 1 ] || share=1
failed=()
mkdir -p out/fuzz

for harness in "${harnesses[@]}"; do
    name=${harness##*fuzz_}
    found=build/fuzz/found/$name log=out/fuzz/$name.log
    mkdir -p "$found"
    if "$harness" -max_total_time="$share" -timeout=10 -rss_limit_mb=2048 -max_len=16384 \
        -print_final_stats=1 -artifact_prefix="out/fuzz/$name-" \
        "$found" "build/fuzz/seeds/$name" >"$log" 2>&1; then
        printf '%-10s %s runs in %d s, %s\n' "$name" \
            "$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")" "$share" \
            "$(grep -oE 'cov: [0-9]+' "$log" | tail -n 1)"
    else
        printf '%-10s FAILED: %s\n' "$name" "$log"
        failed+=("$name")
    fi
done
[ "${#failed[@]}" -eq 0 ] || exit 1
