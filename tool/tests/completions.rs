//! `framepath completions` as shells take it.

use std::process::{Command, Output};

fn framepath(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_framepath"))
        .args(arguments)
        .output()
        .expect("framepath runs")
}

fn completions(shell: &str) -> String {
    let output = framepath(&["completions", shell]);
    assert!(output.status.success(), "{output:?}");
    String::from_utf8(output.stdout).expect("text")
}

/// What bash offers behind these words, of which the last one is not complete.
fn offered(words: &[&str]) -> Vec<String> {
    let script = format!(
        "{}\nCOMP_WORDS=({})\nCOMP_CWORD={}\n_framepath framepath {} {}\nprintf '%s\\n' \"${{COMPREPLY[@]}}\"\n",
        completions("bash"),
        words.join(" "),
        words.len() - 1,
        words[words.len() - 1],
        words[words.len() - 2],
    );
    let output = Command::new("bash")
        .args(["-c", &script])
        .output()
        .expect("bash runs");
    assert!(output.status.success(), "{output:?}");
    let text = String::from_utf8(output.stdout).expect("text");
    text.lines().map(str::to_owned).collect()
}

#[test]
fn bash_completes_commands_options_and_values() {
    assert_eq!(offered(&["framepath", "rec"]), ["record"]);
    assert_eq!(
        offered(&["framepath", "record", "--until"]),
        ["--until-done"]
    );
    assert_eq!(
        offered(&["framepath", "filter", "--dialect", "fan"]),
        ["fanuc"]
    );
}

/// Those that `framepath --help` lists.
fn commands() -> Vec<String> {
    let help = String::from_utf8(framepath(&["--help"]).stdout).expect("text");
    let listed = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    let listed = listed.take_while(|line| !line.is_empty());
    listed
        .filter_map(|line| line.split_whitespace().next())
        .map(str::to_owned)
        .collect()
}

/// All commands that people call, and no other.
#[test]
fn each_shell_gets_all_commands() {
    let commands = commands();
    assert!(
        commands.len() > 8 && commands.contains(&"record".to_owned()),
        "{commands:?}"
    );
    for (shell, start) in [
        ("bash", "_framepath()"),
        ("zsh", "#compdef framepath"),
        ("fish", ""),
    ] {
        let text = completions(shell);
        assert!(text.starts_with(start), "{shell}");
        for command in &commands {
            assert!(text.contains(command), "{shell}: {command}");
        }
        assert!(!text.contains("compare-host"), "{shell}");
    }
}

#[test]
fn another_shell_is_refused_by_name() {
    let output = framepath(&["completions", "tcsh"]);
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8(output.stderr).expect("text");
    assert!(
        said.contains("'tcsh'") && said.contains("bash, zsh, fish"),
        "{said}"
    );
}
