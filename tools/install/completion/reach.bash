# Completion for bash of all programs: offers what their --help lists, so it needs no care.
# shellcheck shell=bash

# The options that the help on the standard input names.
_reach_options() { grep -oE '^ +(-[A-Za-z], )?--[a-z-]+' | grep -oE -- '--[a-z-]+'; }

# What the word $1 wants behind it, such as FILE; nothing when it is no option or wants nothing.
_reach_value() { [[ $1 != -* ]] || sed -nE "s/^ +(.*, )?$1 ([A-Z]+).*/\2/p"; }

# The commands that begin with the words given, one word more of each.
_reach_commands() {
    sed -n '/^commands/,$p' | grep -oE '^  [a-z-]+( [a-z-]+)*( |$)' | sed -E 's/^ +//; s/ +$//' |
        sed -n "s/^$1\([a-z-]*\).*/\1/p" | sort -u
}

_reach() {
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} said value i said_words=''
    said=$("$1" --help 2>/dev/null) || return
    COMPREPLY=()
    value=$(_reach_value "$before" <<<"$said")
    case $value in
    '') ;;
    F | FILE | DIR | PAIR | LEFT)
        compopt -o default 2>/dev/null
        return
        ;;
    *) return ;;
    esac
    if [[ $word == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$(_reach_options <<<"$said")" -- "$word")
        return
    fi
    for ((i = 1; i < COMP_CWORD; i++)); do
        [[ ${COMP_WORDS[i]} == -* || -n $(_reach_value "${COMP_WORDS[i - 1]}" <<<"$said") ]] ||
            said_words+="${COMP_WORDS[i]} "
    done
    if grep -q '^commands' <<<"$said"; then
        mapfile -t COMPREPLY < <(compgen -W "$(_reach_commands "$said_words" <<<"$said")" -- "$word")
    else
        compopt -o default 2>/dev/null
    fi
}

# ./run in the source tree: behind a command, the options that the command's own help lists.
_reach_run() {
    local word=${COMP_WORDS[COMP_CWORD]}
    COMPREPLY=()
    if ((COMP_CWORD == 1)); then
        mapfile -t COMPREPLY < <(compgen -W "$("$1" help | _reach_commands '')" -- "$word")
    elif [[ $word == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W \
            "$("$1" "${COMP_WORDS[1]}" --help 2>/dev/null | _reach_options)" -- "$word")
    else
        compopt -o default 2>/dev/null
    fi
}

# Installed once for each program, under its name, as bash looks for it. In the source tree it is
# read as it stands, and is for all of them: they are found there by the last part of their paths.
if [[ $(basename "${BASH_SOURCE[0]}") != reach.bash ]]; then
    complete -F _reach "$(basename "${BASH_SOURCE[0]}")"
else
    complete -F _reach reachd reachctl reach-{bench,eval,finder,learner,log,simrobot,vision}
    complete -F _reach_run run
fi
