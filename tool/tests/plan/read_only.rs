//! A plan reads; and where it cannot read, it says in which file.

use crate::support::{Bench, MILL};

#[test]
fn python_in_a_program_is_refused_and_not_run() {
    let bench = Bench::new();
    let made = bench.path().join("made");
    let python = format!("open('{}','w')", made.display());
    bench.write("direct.ngc", &format!("G21\nG0 X1\n;py,{python}\nM2\n"));
    bench.write("capital.ngc", "G21\n(PY,import os)\nG0 X1\nM2\n");
    bench.write("behind.ngc", "G21\nG0 X1 (py,import os)\nM2\n");
    bench.write("brackets.ngc", "G21\n(py,import os)\nG0 X1\nM2\n");
    bench.write("called.ngc", "G21\no<sub> call\nM2\n");
    bench.write(
        "sub.ngc",
        &format!("o<sub> sub\nG0 X1\n;py,{python}\no<sub> endsub\nM2\n"),
    );
    let keys = "[RS274NGC]\nSUBROUTINE_PATH = .\n";
    bench.write("mill.ini", &MILL.replace("[RS274NGC]\n", keys));
    for (program, place) in [
        ("direct.ngc", "direct.ngc:3: "),
        ("capital.ngc", "capital.ngc:2: "),
        ("behind.ngc", "behind.ngc:2: "),
        ("brackets.ngc", "brackets.ngc:2: "),
        ("called.ngc", "called.ngc:2: in sub.ngc, line 3: "),
    ] {
        let error = bench.refused(&[program, "--ini", "mill.ini"]);
        let expected = format!("{place}Python in a program (;py");
        assert!(error.starts_with(&expected), "{error}");
        assert!(!made.exists(), "{program}");
    }
    let startup = "RS274NGC_STARTUP_CODE = G21 (py,import os)";
    let ini = MILL.replace("RS274NGC_STARTUP_CODE = G61.1 G21", startup);
    bench.write("mill.ini", &ini);
    bench.write("part.ngc", "G21\nG0 X1\nM2\n");
    let error = bench.refused(&["part.ngc", "--ini", "mill.ini"]);
    assert!(
        error.contains("[RS274NGC]RS274NGC_STARTUP_CODE: Python in a program"),
        "{error}"
    );
}

#[test]
fn a_line_of_the_parameter_file_is_named() {
    let bench = Bench::new();
    let ini = MILL.replace("[RS274NGC]\n", "[RS274NGC]\nPARAMETER_FILE = mill.var\n");
    bench.write("mill.ini", &ini);
    bench.write("part.ngc", "G21\nG0 X1\nM2\n");
    for (parameters, said) in [
        (
            "5221\t1\n5161\t2\n",
            "mill.var:2: parameter 5161 stands behind parameter 5221",
        ),
        ("5221\tnan\n", "mill.var:1: parameter 5221 is NaN"),
        (
            "5161\t1\n99999\t2\n",
            "mill.var:2: LinuxCNC has no parameter 99999",
        ),
    ] {
        bench.write("mill.var", parameters);
        let error = bench.refused(&["part.ngc", "--ini", "mill.ini"]);
        assert!(error.contains(said), "{error}");
    }
    // In a program the same words are of its own line.
    bench.write("mill.var", "5161\t1\n");
    bench.write("part.ngc", "G21\n#99999=1\nG0 X1\nM2\n");
    let error = bench.refused(&["part.ngc", "--ini", "mill.ini"]);
    assert!(error.starts_with("part.ngc:2: "), "{error}");
}

#[test]
fn a_remap_without_its_file_is_named() {
    let bench = Bench::new();
    std::fs::create_dir_all(bench.path().join("with blank/subs")).expect("a folder");
    bench.write(
        "with blank/subs/change.ngc",
        "o<change> sub\no<change> endsub\nM2\n",
    );
    bench.write("part.ngc", "G21\nG0 X1\nM2\n");
    let remap = "[RS274NGC]\nSUBROUTINE_PATH = subs\nREMAP = M6 modalgroup=6 ngc=change\n";
    bench.write("with blank/mill.ini", &MILL.replace("[RS274NGC]\n", remap));
    let error = bench.refused(&["part.ngc", "--ini", "with blank/mill.ini"]);
    assert!(
        error.contains("NGC file not found: ngc=change")
            && error.contains("help: put change.ngc into a folder of")
            && error.contains("whose path has a blank"),
        "{error}"
    );
}

#[test]
fn a_folder_for_temporary_files_that_is_not_there_is_named() {
    let bench = Bench::new();
    bench.write("part.ngc", "G21\nG0 X1\nM2\n");
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_framepath"))
        .current_dir(bench.path())
        .env("TMPDIR", "/nothing/here")
        .args(["plan", "part.ngc"])
        .output()
        .expect("the program runs");
    let error = crate::bench::refusal(output);
    assert!(
        error.contains("/nothing/here: ") && error.contains("set TMPDIR"),
        "{error}"
    );
}
