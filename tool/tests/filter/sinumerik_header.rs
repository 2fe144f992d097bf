//! Words that the headers of posts write: run, left out with a note, or refused as words.

use crate::shop::{Shop, accepted, commands, refused, translate};

/// What is said about a program that runs, and what is written for it.
fn said_and_written(program: &str) -> (String, Vec<String>) {
    let output = translate(program, &["--backend", "program"]);
    let (said, written): (Vec<String>, Vec<String>) = commands(&output)
        .into_iter()
        .partition(|line| line.starts_with("(MSG,"));
    (said.join("\n"), written)
}

#[test]
fn words_that_tune_the_control_are_left_out_and_named() {
    for (words, names) in [
        ("SETMS", &["SETMS"][..]),
        ("SETMS(1)", &["SETMS"]),
        ("KONT CUT2D G451", &["KONT", "CUT2D", "G451"]),
        ("EXTERN POCKET(REAL, INT)", &["EXTERN"]),
        ("EXTERN POCKET", &["EXTERN"]),
        ("FGROUP(X,Y,Z)", &["FGROUP"]),
        ("FGROUP() SOFT FFWON", &["FGROUP", "SOFT", "FFWON"]),
        ("TOROTOF PAROTOF", &["TOROTOF", "PAROTOF"]),
        ("TRAFOOF", &["TRAFOOF"]),
        ("DYNNORM", &["DYNNORM"]),
        ("G17 DYNFINISH G90", &["DYNFINISH"]),
        ("DYNROUGH DYNSEMIFIN", &["DYNROUGH", "DYNSEMIFIN"]),
        ("ORISON", &["ORISON"]),
        ("ACC[X]=50 ACC[Y]=50+R1", &["ACC"]),
        ("VELOLIM[C]=80 OTOL=0.1", &["VELOLIM", "OTOL"]),
        (
            "WORKPIECE(,\"\",,\"BOX\",112,0,-51,-80,50,25,-50,-25)",
            &["WORKPIECE"],
        ),
    ] {
        let (said, written) = said_and_written(&format!("R1=1\n{words}\nG0 X1\nM30\n"));
        assert_eq!(written.iter().filter(|line| line.contains("X1")).count(), 1);
        assert_eq!(said.matches("is left out").count(), names.len(), "{said}");
        for name in names {
            assert!(said.contains(&format!("{name} tunes")), "{words}\n{said}");
        }
    }
    let (_, written) = said_and_written("ACC[X]=50 G1 X5 F100 SOFT\nM30\n");
    assert_eq!(written, ["G1 X5 F100", "M30"]);
}

#[test]
fn unknown_words_are_named_as_such_with_the_nearest_known_ones() {
    for (program, words, advice) in [
        (
            "DYNFINISCH\n",
            "`DYNFINISCH` is neither a word",
            "did you mean DYNFINISH?",
        ),
        (
            "COMPCAF\n",
            "`COMPCAF` is neither a word",
            "did you mean COMPCAD?",
        ),
        (
            "BLUBBER\n",
            "`BLUBBER` is neither a word",
            "%_N_BLUBBER_SPF",
        ),
        (
            "BLUBBER(5)\n",
            "the subprogram BLUBBER was not found",
            "blubber.spf",
        ),
        (
            "G17 G64 FFWOM\n",
            "`FFWOM` is not a word",
            "did you mean FFWON or FFWOF?",
        ),
        ("SETMS(3)\n", "only the first spindle", "SETMS(1)"),
        ("KONTC\n", "KONTC is not supported", "KONT and NORM"),
        ("FGROUP(X,Y\n", "`)` is missing", ""),
        ("TOROT\n", "TOROT is not supported", "ROT"),
    ] {
        let shop = Shop::new(&[("part.mpf", format!("{program}M30\n").as_bytes())]);
        let shown = refused(&shop.run("part.mpf", &[]));
        assert!(shown.contains(words), "{program}{shown}");
        assert!(shown.contains(advice), "{program}{shown}");
    }
}

/// A declared subprogram is called as any other.
#[test]
fn subprograms_that_are_declared_run() {
    let program = "%_N_PART_MPF\nEXTERN BORE(REAL)\nG0 X0\nBORE(-3)\nM30\n\
                   %_N_BORE_SPF\nPROC BORE(REAL DEPTH)\nG1 Z=DEPTH F100\nM17\n";
    let shop = Shop::new(&[("part.mpf", program.as_bytes())]);
    let output = accepted(&shop.run("part.mpf", &["--backend", "program"]));
    assert!(output.contains("G1 Z-3 F100"), "{output}");
}

/// The head of a subprogram names it, by a number too.
#[test]
fn heads_of_subprograms_have_names() {
    let program = "%_N_PART_MPF\nG0 X0\nL10\nM30\n%_N_L10_SPF\nPROC L10 DISPLOF\nG0 X3\nM17\n";
    let (_, written) = said_and_written(program);
    assert_eq!(written, ["G0 X0", "G0 X3", "M30"]);
    for (head, words) in [
        ("PROC", "the name of the subprogram is missing"),
        ("PROC (REAL DEPTH)", "the name of the subprogram is missing"),
        (
            "PROC L",
            "the number of a subprogram must be a whole number",
        ),
    ] {
        let shop = Shop::new(&[("part.mpf", format!("{head}\nM30\n").as_bytes())]);
        let shown = refused(&shop.run("part.mpf", &[]));
        assert!(shown.contains(words), "{head}\n{shown}");
    }
}

/// G70 and G71 leave F in the unit of the machine, which is said where that is another one.
#[test]
fn the_unit_of_f_is_said_where_it_is_not_that_of_lengths() {
    for (program, machine, said) in [
        (
            "G71",
            "--machine-in-inch",
            Some("G71 is for lengths only: F stays in inches"),
        ),
        (
            "G70",
            "--skip-blocks",
            Some("G70 is for lengths only: F stays in millimetres"),
        ),
        ("G710", "--machine-in-inch", None),
        ("G70", "--machine-in-inch", None),
        ("G71", "--skip-blocks", None),
        ("G70 G93", "--skip-blocks", None),
    ] {
        let program = format!("G54 {program}\nG0 X0 Y0\nG1 X1 F60\nX2 F30\nM30\n");
        let shop = Shop::new(&[("part.mpf", program.as_bytes())]);
        let output = shop.run("part.mpf", &[machine]);
        let written = accepted(&output);
        let count = written.matches("is for lengths only").count();
        assert_eq!(count, usize::from(said.is_some()), "{written}");
        assert!(said.is_none_or(|said| written.contains(said)), "{written}");
    }
}
