//! Roundings and chamfers that are none: places that are said again, and lengths of 0.

use crate::expected::Path;
use crate::shop::{Shop, refused};
use framepath_tool::dialects::Dialect;

/// The error text of a program that must be refused.
fn errors(program: &str) -> String {
    let shop = Shop::new(&[("part.mpf", program.as_bytes())]);
    refused(&shop.run("part.mpf", &[]))
}

/// A modal rounding takes no notice of a place that is said again, and 0 rounds nothing.
#[test]
fn corners_that_are_none() {
    let check = |program: &str, path: &Path| {
        path.check(Dialect::Sinumerik, &[("part.mpf", program)], program);
    };
    let rounded = Path::from([0.0; 3])
        .lines(&[(18., 0.)])
        .ccw([20., 2., 0.], (18., 2.))
        .lines(&[(20., 18.)])
        .ccw([18., 20., 0.], (18., 18.))
        .lines(&[(0., 20.)]);
    for (first, second) in [("", ""), ("X20 Y0\n", "X=IC(0)\nY20 X20 F100\n")] {
        let program =
            format!("G0 X0 Y0 Z0\nRNDM=2\nG1 X0 F100\nX20\n{first}Y20\n{second}X0\nM30\n");
        check(&program, &rounded);
    }
    let sharp = Path::from([0.0; 3])
        .lines(&[(20., 0.), (20., 18.)])
        .ccw([18., 20., 0.], (18., 18.))
        .lines(&[(0., 20.)]);
    for none in ["RND=R5", "CHF=R5", "CHR=0"] {
        let program = format!("R5=0\nG0 X0 Y0 Z0\nG1 X20 F100 {none}\nY20 RND=2\nX0\nM30\n");
        check(&program, &sharp);
        check(
            &program
                .replace("R5=0\n", "R5=0 RNDM=2\n")
                .replace("R5=0 RNDM=2", "R5=0\nRNDM=2"),
            &sharp,
        );
    }
    assert!(errors("G0 X0 Y0\nG1 X5 F9 RND=-1\nX0\nM30\n").contains("cannot be negative"));
    let twice = errors("G0 X0 Y0\nG1 X5 F9 RND=1\nX5\nY9\nM30\n");
    assert!(twice.contains("goes nowhere"), "{twice}");
}
