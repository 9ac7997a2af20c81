# Completes as readline does: it calls the registered function with the command, the word and the word before.
source ./script
COMP_WORDS=(${1//=/ = } '') COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
[[ $1 == *[\ =] ]] || { unset 'COMP_WORDS[-1]'; COMP_CWORD=$((COMP_CWORD - 1)); }
registered=$(complete -p plane-contact)
[[ $registered =~ -F\ ([^\ ]+) ]]
"${BASH_REMATCH[1]}" plane-contact "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD-1]}" 2>/dev/null
printf '%s\n' "${COMPREPLY[@]}"
