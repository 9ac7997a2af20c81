# Presses Tab in a terminal.
zmodload zsh/zpty
zpty z zsh -f -i
zpty -w z 'autoload -U compinit; compinit -u -D; bindkey "^I" list-choices; source ./script; PROMPT="<${:-ready}>"'
zpty -r z shown '*<ready>*'
zpty -w -n z "$1"$'\t\C-u'
zpty -w z 'print "<${:-done}>"'
zpty -r z shown '*<done>*'
print -r -- "$shown"
