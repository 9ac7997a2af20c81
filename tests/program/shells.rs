//! Completions as shells read them.

use std::path::Path;
use std::process::Command;

use tempfile::TempDir;

use crate::common::tools::is_there;
use crate::texts::printed;

/// Completes as readline does: it calls the registered function with the command, the word and the word before.
const BASH: &str = r#"
    source ./script
    COMP_WORDS=(${1//=/ = } '') COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
    [[ $1 == *[\ =] ]] || { unset 'COMP_WORDS[-1]'; COMP_CWORD=$((COMP_CWORD - 1)); }
    registered=$(complete -p plane-contact)
    [[ $registered =~ -F\ ([^\ ]+) ]]
    "${BASH_REMATCH[1]}" plane-contact "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD-1]}" 2>/dev/null
    printf '%s\n' "${COMPREPLY[@]}"
"#;

const FISH: &str = "source ./script; complete -C $argv[1]";

/// Presses Tab in a terminal.
const ZSH: &str = r#"
    zmodload zsh/zpty
    zpty z zsh -f -i
    zpty -w z 'autoload -U compinit; compinit -u -D; bindkey "^I" list-choices; source ./script; PROMPT="<${:-ready}>"'
    zpty -r z shown '*<ready>*'
    zpty -w -n z "$1"$'\t\C-u'
    zpty -w z 'print "<${:-done}>"'
    zpty -r z shown '*<done>*'
    print -r -- "$shown"
"#;

/// Returns what a shell shows on Tab after `line`.
fn offered(shell: &str, line: &str) -> String {
    let folder = TempDir::new().expect("a folder");
    let script = printed(&["--completions", shell]);
    std::fs::write(folder.path().join("script"), script).expect("it is written");
    std::fs::write(folder.path().join("calm.csv"), "").expect("it is written");
    let (program, more): (&str, &[&str]) = match shell {
        "bash" => (BASH, &["--norc", "-c"]),
        "fish" => (FISH, &["-c"]),
        _ => (ZSH, &["-f", "-c"]),
    };
    let mut command = Command::new(shell);
    command
        .args(more)
        .arg(program)
        .args(if shell == "fish" { None } else { Some(shell) })
        .arg(line);
    // The script asks the program of that name.
    let own = Path::new(env!("CARGO_BIN_EXE_plane-contact")).parent().expect("its folder");
    let path = format!("{}:{}", own.display(), std::env::var("PATH").expect("a path"));
    command.current_dir(folder.path()).env("HOME", folder.path()).env("PATH", path);
    let output = command.output();
    String::from_utf8_lossy(&output.expect(shell).stdout).into_owned()
}

#[test]
fn shells_complete_commands_options_and_values() {
    let lines: [(&str, &[&str]); 13] = [
        ("plane-contact so", &["solve"]),
        ("plane-contact snapshot re", &["record"]),
        ("plane-contact listing run ", &["c_cnt", "Km"]),
        ("plane-contact solve --no-p", &["--no-pictures"]),
        ("plane-contact solve fig1 --variant ", &["printed", "tied", "stepped", "unilateral"]),
        ("plane-contact audit --claim P1", &["P12"]),
        ("plane-contact solve --reading R5", &["R5=node_n"]),
        ("plane-contact guide sce", &["scenes"]),
        ("plane-contact scene copy C1", &["C10", "C15"]),
        ("plane-contact help ", &["solve", "snapshot"]),
        ("plane-contact help snapshot re", &["record"]),
        ("plane-contact scene help m", &["mesh"]),
        ("plane-contact compare fig1 --with cal", &["calm.csv"]),
    ];
    for shell in ["bash", "zsh", "fish"] {
        let mut version = Command::new(shell);
        version.arg("--version");
        if !is_there(version, "REQUIRE_SHELLS") {
            continue;
        }
        for (line, wanted) in lines {
            let shown = offered(shell, line);
            for word in wanted {
                let word = word.split('=').next_back().expect("a part");
                assert!(shown.contains(word), "{shell}: {line}: {word} is not in {shown:?}");
            }
        }
    }
}

#[test]
fn every_shell_has_a_script() {
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        assert!(!printed(&["--completions", shell]).is_empty());
    }
}
