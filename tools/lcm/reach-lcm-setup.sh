#!/bin/sh
# Makes LCM's UDP multicast work on this machine alone: what `reachctl doctor` finds about it, mended.
set -eu

group=239.255.76.67  # LCM's own
least_buffer=1843200 # bytes of a pair of raw images
good_buffer=8388608
dry_run=no
port=7667

usage() {
    cat <<'TEXT'
usage: reach-lcm-setup [--dry-run]
       reach-lcm-setup [--dry-run] [--port PORT] --allow ADDRESS ... | --allow-all

Does what is missing of three things: the multicast flag of the loopback interface, a route for
multicast by it, so that nothing leaves the machine, and receive buffers that pairs of raw images
fit in.

With --allow, something else: a rule of the kernel's filter (nftables), by which LCM's messages are
heard from these IPv4 addresses or networks (10.1.2.0/24) and from this machine itself, and from
nobody else. It takes the place of the rule before.

To be called by root, in the network namespace that is meant. It lasts until the machine is switched off; reach-lcm-setup.service does it at each start.

  --allow A ...   who may speak, all words that follow
  --allow-all     take the rule away
  --port PORT     of the bus whose senders are meant; default 7667
  --dry-run       print the commands, do nothing
  -h, --help      this text
  -V, --version   version and git revision

exit code: 0 all is there, 1 something failed, 2 wrong usage
TEXT
}

fail() {
    echo "reach-lcm-setup: $*" >&2
    exit 1
}

do_it() {
    echo "$*"
    [ "$dry_run" = yes ] || sh -c "$*" || fail "that failed; are you root?"
}

wrong() {
    echo "reach-lcm-setup: $*; see reach-lcm-setup --help" >&2
    exit 2
}

# One transaction: at no moment is there no rule, or half of one.
allow() {
    command -v nft >/dev/null || fail "there is no nft command: apt-get install nftables"
    rules="add table inet reach; delete table inet reach"
    if [ $# -gt 0 ]; then
        list=''
        for address in "$@"; do
            case $address in
            *[!0-9./]* | '' | /* | *//*) wrong "'$address' is no IPv4 address or network" ;;
            esac
            list="$list${list:+, }$address"
        done
        rules="$rules; table inet reach { chain input { type filter hook input priority 0;"
        rules="$rules udp dport $port fib saddr type local accept;"
        rules="$rules udp dport $port ip saddr { $list } accept;"
        rules="$rules udp dport $port counter drop; }; }"
    fi
    echo "nft '$rules'"
    [ "$dry_run" = yes ] || nft "$rules" || fail "nft refused the rule; are you root?"
    exit 0
}

while [ $# -gt 0 ]; do
    case $1 in
    --dry-run) dry_run=yes ;;
    --port)
        shift
        case ${1:-} in
        '' | *[!0-9]*) wrong "--port wants a number" ;;
        esac
        port=$1
        ;;
    --allow)
        shift
        [ $# -gt 0 ] || wrong "--allow wants an address"
        allow "$@"
        ;;
    --allow-all) allow ;;
    -h | --help)
        usage
        exit 0
        ;;
    -V | --version)
        echo "reach-lcm-setup @REACH_VERSION@"
        exit 0
        ;;
    *) wrong "unknown option '$1'" ;;
    esac
    shift
done
command -v ip >/dev/null || fail "there is no ip command: apt-get install iproute2"

flags=$(ip -o link show lo) || fail "there is no loopback interface"
case $flags in
*[\<,]UP[,\>]*) ;;
*) do_it "ip link set lo up" ;;
esac
case $flags in
*MULTICAST*) ;;
*) do_it "ip link set lo multicast on" ;;
esac
ip route get $group >/dev/null 2>&1 || do_it "ip route add 224.0.0.0/4 dev lo"
# Not every network namespace shows it, and none but the first may change it.
limit=/proc/sys/net/core/rmem_max
if [ -r $limit ] && [ "$(cat $limit)" -lt $least_buffer ]; then
    do_it "echo $good_buffer > $limit"
fi
