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
