//! The commands of `halcmd`.

/// Those that it knows.
const COMMANDS: [&str; 40] = [
    "addf",
    "alias",
    "debug",
    "delf",
    "delsig",
    "echo",
    "exit",
    "getp",
    "gets",
    "help",
    "linkpp",
    "linkps",
    "linksp",
    "list",
    "loadrt",
    "loadusr",
    "lock",
    "net",
    "newsig",
    "print",
    "ptype",
    "quit",
    "save",
    "setexact_for_test_suite_only",
    "setp",
    "sets",
    "show",
    "source",
    "start",
    "status",
    "stop",
    "stype",
    "unalias",
    "unecho",
    "unlinkp",
    "unload",
    "unloadrt",
    "unloadusr",
    "unlock",
    "waitusr",
];

/// Whether a line may begin with this word.
pub fn is_known(word: &str) -> bool {
    COMMANDS.contains(&word)
}

/// Arrows of `net`, which say nothing.
pub fn is_arrow(word: &str) -> bool {
    matches!(word, "=>" | "<=" | "<=>")
}
