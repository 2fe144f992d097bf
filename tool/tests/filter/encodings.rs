//! Files as old controls, DOS and Windows wrote them.

use crate::shop::{Shop, accepted, refused};
use encoding_rs::{WINDOWS_1250, WINDOWS_1251, WINDOWS_1252};

/// `; Fräser für Öffnung, Größe`, as DOS had it in western Europe.
const FRAESER_850: &[u8] = b"G0 X1 ; Fr\x84ser f\x81r \x99ffnung, Gr\x94\xe1e\r\nM30\r\n";

/// `; Střed díry`, as DOS had it in central Europe.
const STRED_852: &[u8] = b"G0 X1 ; St\xfded d\xa1ry, v\xec\xe7ka\r\nM30\r\n";

/// The output and what is said about the encoding.
fn read(bytes: &[u8], options: &[&str]) -> (String, String) {
    let shop = Shop::new(&[("part.mpf", bytes)]);
    let output = shop.run("part.mpf", options);
    let said = String::from_utf8_lossy(&output.stderr);
    let notes = said.lines().filter(|line| line.starts_with("note: "));
    (accepted(&output), notes.collect())
}

#[test]
fn comments_are_read_in_the_encoding_that_makes_words_of_them() {
    let program = |encoding: &'static encoding_rs::Encoding, comment: &str| {
        let text = format!("G0 X1 ; {comment}\r\nM30\r\n");
        encoding.encode(&text).0.into_owned()
    };
    for (bytes, comment, taken) in [
        (
            program(WINDOWS_1252, "Fräser für Öffnung"),
            "Fräser für Öffnung",
            "CP1252",
        ),
        (
            program(WINDOWS_1251, "Фреза для отверстия"),
            "Фреза для отверстия",
            "CP1251",
        ),
        (
            program(WINDOWS_1250, "Střed díry, výška"),
            "Střed díry; výška",
            "CP1250",
        ),
        (FRAESER_850.to_vec(), "Fräser für Öffnung, Größe", "CP850"),
        (STRED_852.to_vec(), "Střed díry, výška", "CP852"),
    ] {
        let (output, notes) = read(&bytes, &[]);
        let comment = comment.replace("; ", ", ");
        assert!(
            output.contains(&format!("G0 X1 (line 1: {comment})")),
            "{output}"
        );
        assert!(notes.contains("part.mpf is not UTF-8, taken as"), "{notes}");
        assert!(
            notes.contains(taken) && notes.contains("--encoding"),
            "{notes}"
        );
    }
}

#[test]
fn nothing_is_said_of_utf_8_and_of_an_encoding_that_is_named() {
    for (bytes, options) in [
        (
            "\u{feff}G0 X1 ; ñ\nM30\n".as_bytes(),
            &["--encoding", "auto"][..],
        ),
        ("G0 X1 ; ñ\nM30\n".as_bytes(), &["--encoding", "UTF-8"]),
        (&b"G0 X1 ; \xa4\nM30\n"[..], &["--encoding", "cp850"]),
        (b"G0 X1 ; \xf1\nM30\n", &["--encoding", "cp1252"]),
        (
            b"\xff\xfeG\x000\x00 \x00X\x001\x00 \x00;\x00\xf1\x00\n\x00M\x003\x000\x00",
            &["--encoding", "utf-16le"],
        ),
    ] {
        let (output, notes) = read(bytes, options);
        assert!(output.contains("G0 X1 (line 1: ñ)"), "{output}");
        assert!(notes.is_empty(), "{notes}");
    }
}

#[test]
fn what_is_not_in_the_encoding_is_refused_at_its_place() {
    let shop = Shop::new(&[("part.mpf", b"G0 X1\nG1 X2 ; \xe4\nM30\n")]);
    let shown = refused(&shop.run("part.mpf", &["--encoding", "utf-8"]));
    assert!(
        shown.contains("part.mpf:2:9") && shown.contains("this is not UTF-8"),
        "{shown}"
    );
    let shown = refused(&shop.run("part.mpf", &["--encoding", "utf-8", "--longest-whole", "0"]));
    assert!(shown.contains("part.mpf:2:9"), "{shown}");
}

#[test]
fn letters_outside_of_comments_are_refused_whatever_they_were() {
    for bytes in [b"G1 X1 \xe4\nM30\n", b"G1 X1 \x84\nM30\n"] {
        let shop = Shop::new(&[("part.mpf", bytes)]);
        let shown = refused(&shop.run("part.mpf", &[]));
        assert!(shown.contains("part.mpf:1:7"), "{shown}");
        assert!(shown.contains("has no meaning"), "{shown}");
    }
}

#[test]
fn subprograms_have_encodings_of_their_own() {
    let shop = Shop::new(&[
        ("part.mpf", "L10 ; año\nM30\n".as_bytes()),
        ("l10.spf", b"G0 X1 ; Fr\x84ser f\x81r\nM17\n"),
    ]);
    let output = shop.run("part.mpf", &[]);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    let text = accepted(&output);
    assert!(text.contains("(line 1: Fräser für)"), "{text}");
    assert!(
        said.contains("l10.spf is not UTF-8, taken as CP850"),
        "{said}"
    );
    assert!(!said.contains("part.mpf is not"), "{said}");
}

#[test]
fn all_line_ends_and_marks_of_tapes_are_understood() {
    for bytes in [
        &b"%\r\nN10 G0 X1\r\nN20 M30\r\n%\r\n"[..],
        b"%\rN10 G0 X1\rN20 M30\r%",
        b"\0\0\0%\n\n\nN10 G0 X1\n\nN20 M30\n%\n\x1a",
        b"%\r\r\nN10 G0 X1\r\r\nN20 M30\r\r\n%\r\r\n\0\0",
    ] {
        for options in [&[][..], &["--longest-whole", "0", "--piece", "5"]] {
            let (output, _) = read(bytes, options);
            let lines: Vec<&str> = output.lines().skip(3).map(|line| &line[..9]).collect();
            assert_eq!(lines, ["N10 G0 X1", "N20 M30 ("], "{output}");
        }
    }
}
