source ./script; complete -C $argv[1]
