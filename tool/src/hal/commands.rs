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

/// Whether a signal may have this type, in LinuxCNC 2.9 or in 2.10, which has those of 64 bits.
pub fn is_signal_type(word: &str) -> bool {
    let types = ["bit", "float", "s32", "u32", "s64", "u64", "port"];
    types.iter().any(|known| word.eq_ignore_ascii_case(known))
}
