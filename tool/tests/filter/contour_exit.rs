//! KONT: the control goes round the end of the contour where the way of G40 leads behind it, LinuxCNC straight.

use crate::shop::{Shop, accepted, refused};
use std::process::Output;

/// Runs a program with a contour that goes up at X50, its tool on the right, and leaves it by these blocks.
fn leave(head: &str, exit: &str) -> Output {
    let program = format!(
        "T1 D1 M6\nG54 G17 G90 G71 F500 {head}\nG0 X0 Y-20 Z5\nG1 Z-1\nG42 X10 Y0\nX50\nY40\n{exit}\nM30\n"
    );
    let shop = Shop::new(&[("part.mpf", program.as_bytes())]);
    shop.run("part.mpf", &["--backend", "program"])
}

#[test]
fn a_way_behind_the_contour_is_refused() {
    for (exit, place) in [
        ("G40 X30 Y50", "8:1"),
        ("G0 G40 X49", "8:4"),
        ("G40\nX30 Y50", "8:1"),
        ("G40\nG91\nX-5", "8:1"),
        ("NORM\nKONT G40 X30", "9:6"),
    ] {
        let shown = refused(&leave("KONT", exit));
        assert!(
            shown.contains(&format!("part.mpf:{place}\n")),
            "{exit}\n{shown}"
        );
        assert!(shown.contains("KONT goes round the end"), "{exit}\n{shown}");
        assert!(shown.contains("write NORM before it"), "{exit}\n{shown}");
    }
    let shown = refused(&leave("KONT", "G40\nSUPA G0 X0 Y0"));
    assert!(shown.contains("is not known ahead of time"), "{shown}");
}

#[test]
fn other_ways_run_as_with_norm() {
    for (head, exit) in [
        ("KONT", "G40 X80 Y40"),
        ("KONT", "G40 X50 Y60"),
        ("KONT", "G40 X51 Y0"),
        ("KONT", "G0 Z50\nG40 X0 Y0"),
        ("KONT", "G40 G0 Z50\nX0 Y0"),
        ("KONT", "NORM G40 X30 Y50"),
        ("NORM", "G40 X30 Y50"),
        ("", "G40 X30 Y50"),
    ] {
        let output = accepted(&leave(head, exit));
        assert!(output.contains("G40"), "{exit}\n{output}");
    }
}

/// KONT is a G function: it comes back behind a subprogram with SAVE.
#[test]
fn it_is_kept_with_the_modes() {
    let program = "%_N_PART_MPF\nT1 D1 M6\nG54 G17 G90 F500 KONT\nG0 X0 Y-20 Z5\nSUB_\nG42 G1 X10 Y0\nX50\nY40\n\
                   G40 X30 Y50\nM30\n%_N_SUB__SPF\nPROC SUB_ SAVE\nNORM\nM17\n";
    let shop = Shop::new(&[("part.mpf", program.as_bytes())]);
    let shown = refused(&shop.run("part.mpf", &[]));
    assert!(shown.contains("KONT goes round the end"), "{shown}");
}
