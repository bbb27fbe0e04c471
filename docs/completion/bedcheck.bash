# bedcheck.bash -- completion of bedcheck and bedsim for bash.
#
# Commands and options are read from the programs' own --help, cases from `bedcheck list`: there is
# nothing here that could fall behind.

_bedcheck_commands() {
    "$1" --help 2>/dev/null | sed -n -e 's/^  \([a-z]\{1,\}\) .*/\1/p' \
        -e 's/^[U ].*bedsim \([a-z]\{1,\}\).*/\1/p'
    echo --help
    echo --version
}

_bedcheck_options() {
    "$1" "$2" --help 2>/dev/null | grep -o -e '--[a-z][a-z-]*=\{0,1\}'
}

_bedcheck() {
    local program=$1 word=$2 before=$3 command=${COMP_WORDS[1]} words= last=${COMP_WORDS[COMP_CWORD]}
    COMPREPLY=()
    if ((COMP_CWORD == 1)); then
        mapfile -t COMPREPLY < <(compgen -W "$(_bedcheck_commands "$program")" -- "$word")
        return
    fi
    # '=' is a word of its own in COMP_WORDS
    if [[ $before == = ]]; then
        before=${COMP_WORDS[COMP_CWORD - 2]}
    elif [[ $last == = ]]; then
        word=
    fi
    case $before in
        --tier) words="smoke paper large" ;;
        --cases | --references) mapfile -t COMPREPLY < <(compgen -d -- "$word"); return ;;
        --out | --file | --plot) mapfile -t COMPREPLY < <(compgen -f -- "$word"); return ;;
        --solver) mapfile -t COMPREPLY < <(compgen -c -f -- "$word"); return ;;
        --case) words=$("$program" list 2>/dev/null | cut -d' ' -f1) ;;
        --jobs | --seed | --seeds | --seed-offset | --set | --skip | --tag | --timeout | --reason | --level)
            return ;;
        *)
            if [[ $word == -* ]]; then
                words=$(_bedcheck_options "$program" "$command")
            else
                case $command in
                    list | show | run | calibrate)
                        if [[ ${program##*/} == bedcheck ]]; then
                            words=$("$program" list 2>/dev/null | cut -d' ' -f1)
                        else
                            mapfile -t COMPREPLY < <(compgen -f -- "$word")
                            return
                        fi ;;
                    params | datasets) words=$("$program" models 2>/dev/null | grep -o '^[a-z]*') ;;
                    xdmf) mapfile -t COMPREPLY < <(compgen -f -- "$word"); return ;;
                    check | report | accept | clean | compare | history)
                        mapfile -t COMPREPLY < <(compgen -d -- "$word")
                        return ;;
                esac
            fi ;;
    esac
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
    if [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == *= ]]; then
        compopt -o nospace 2>/dev/null
    fi
}

complete -F _bedcheck bedcheck bedsim
