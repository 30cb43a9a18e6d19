#!/bin/sh
# Starts lcm-spy on a Java of today. Debian's own launcher asks for a garbage collector that Java
# no longer has, and does not know our types.
set -eu

here=$(dirname "$(readlink -f "$0")")
url=${LCM_DEFAULT_URL:-udpm://239.255.76.67:7667?ttl=0}

usage() {
    cat <<'TEXT'
usage: reach-spy [--url URL] [--jar FILE]...

A window with every channel on the bus, its type and rate; a double click shows the fields of its
messages, a click on a number plots it.

  --url URL       LCM bus; default $LCM_DEFAULT_URL, else this machine's own
  --jar FILE      types of yours (lcm-gen -j, then javac and jar) beside ours
  -h, --help      this text
  -V, --version   version and git revision

It wants Java 11 or newer, lcm.jar and jchart2d.jar (apt-get install default-jre liblcm-java
libjchart2d-java), and our types, which the build makes when a JDK is there (default-jdk-headless).

exit code: 0 the window was closed, 1 something is missing or failed, 2 wrong usage
TEXT
}

fail() {
    echo "reach-spy: $*" >&2
    exit 1
}

wrong_usage() {
    echo "reach-spy: $*; see reach-spy --help" >&2
    exit 2
}

# The first that exists of the files that are given.
first_of() {
    for file; do
        if [ -r "$file" ]; then
            echo "$file"
            return
        fi
    done
    return 1
}

library() {
    first_of "/usr/share/java/$1.jar" "/usr/local/share/java/$1.jar" ||
        fail "there is no $1.jar: apt-get install $2"
}

jars=''
while [ $# -gt 0 ]; do
    case $1 in
    --url | --jar) [ $# -gt 1 ] || wrong_usage "$1 wants a value" ;;
    esac
    case $1 in
    --url)
        url=$2
        shift
        ;;
    --jar)
        [ -r "$2" ] || fail "$2 cannot be read"
        jars=$jars:$2
        shift
        ;;
    -h | --help)
        usage
        exit 0
        ;;
    -V | --version)
        echo "reach-spy @REACH_VERSION@"
        exit 0
        ;;
    *) wrong_usage "unknown option '$1'" ;;
    esac
    shift
done

command -v java >/dev/null || fail "there is no java: apt-get install openjdk-17-jre"
[ -n "${DISPLAY:-}" ] || fail "there is no display; over ssh: ssh -X, or reachctl top"
types=$(first_of "$here/../java/reach_types.jar" "$here/../share/reach/reach_types.jar") ||
    fail "our types are not built: apt-get install openjdk-17-jdk-headless, then ./run build"
lcm=$(library lcm liblcm-java)
chart=$(library jchart2d libjchart2d-java)
exec java -Djava.net.preferIPv4Stack=true -Xms32m -Xmx256m -ea \
    -cp "$lcm:$chart:$types$jars" lcm.spy.Spy "--lcm-url=$url"
