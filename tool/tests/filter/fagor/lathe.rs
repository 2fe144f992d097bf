//! Programs of lathes are refused: X is a diameter there.

use crate::shop::{Shop, accepted, refused};

const PROGRAM: &[u8] = b"%P05A,MX--,\nT2 D2 M6\nG90 G95 G0 X50 Z2\nM30\n";

#[test]
fn by_the_ending_of_the_file() {
    let shop = Shop::new(&[("part.pit", PROGRAM), ("PART.PIT", PROGRAM)]);
    for name in ["part.pit", "PART.PIT"] {
        for dialect in ["fagor", "auto"] {
            let shown = refused(&shop.run_in(dialect, name, &[]));
            assert!(
                shown.contains("the ending .pit is that of programs of lathes"),
                "{shown}"
            );
            assert!(
                shown.contains("give one of a mill the ending .pim"),
                "{shown}"
            );
        }
    }
}

#[test]
fn on_a_lathe() {
    for (ini, is_lathe) in [
        ("[DISPLAY]\nLATHE = 1\n", true),
        ("[TRAJ]\nCOORDINATES = X Z\n", true),
        ("[TRAJ]\nCOORDINATES = X Y Z\n", false),
    ] {
        let shop = Shop::new(&[("part.nc", PROGRAM), ("machine.ini", ini.as_bytes())]);
        let output = shop.run_in("fagor", "part.nc", &["--ini", "machine.ini"]);
        if is_lathe {
            let shown = refused(&output);
            assert!(shown.contains("the INI file is that of a lathe"), "{shown}");
        } else {
            accepted(&output);
        }
    }
}

/// Their subroutines are none of a program of a mill.
#[test]
fn in_files_of_subroutines() {
    let shop = Shop::new(&[
        ("part.pim", b"(CALL 10)\nM30\n"),
        ("other.pit", b"(SUB 10)\nG0 X50\n(RET)\n"),
    ]);
    let shown = refused(&shop.run_in("fagor", "part.pim", &[]));
    assert!(shown.contains("the subroutine 10 was not found"), "{shown}");
}
