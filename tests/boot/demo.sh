#!/bin/sh
# A small demo with installed programs and nothing else: the simulated robot learns some samples with
# its hand and with the tube, and the log of it becomes tables. LCM's multicast must work.
#   usage: demo.sh WORK [ROOT]    results go to the folder WORK; ROOT: where / of the packages is
# Without ROOT, lcm-logger and numpy must be installed, too.
set -eu
work=$1
root=${2:-}
etc=$root/etc/reach
PATH=$root/usr/sbin:$root/usr/bin:$PATH
pids=''

fail() {
    echo "demo: $*" >&2
    tail -n 5 "$work"/*.err >&2
    exit 1
}

# Nothing outlives a demo that failed or was killed.
start() {
    name=$1
    shift
    setpriv --pdeathsig TERM "$@" >"$work/$name.out" 2>"$work/$name.err" &
    pids="$! $pids"
}

# The last started first, so that the daemon's last command is heard; each must end well.
stop_all() {
    for pid in $pids; do
        kill "$pid"
        wait "$pid" || fail "a program ended with status $?"
    done
}

# At first it waits for states of the robot.
wait_until_idle() {
    for _ in $(seq 100); do
        if reachctl status --json 2>/dev/null | grep -q '"state": "idle"'; then return; fi
        sleep 0.1
    done
    fail "the daemon is not idle after ten seconds"
}

ask() { reachctl --timeout 60 "$@" || fail "reachctl $* failed"; }

mkdir -p "$work/model"
[ -n "$root" ] || start logger lcm-logger '--channel=REACH_.*' "$work/run.lcmlog"
start simrobot reach-simrobot --config "$etc/simrobot-kobian.yaml" --lockstep
start vision reach-vision --config "$etc/vision-kobian.yaml"
start finder reach-finder
start reachd reachd --config "$etc/kobian.yaml" --lockstep --set "model.directory=$work/model"
wait_until_idle
ask --wait babble 3
ask sim attach 1
ask --wait babble 3
ask status --json >"$work/status.json"
stop_all
reachd --config "$etc/kobian.yaml" --set "model.directory=$work/model" --check-model
[ -n "$root" ] || reach-export "$work/run.lcmlog" --csv "$work/tables"
