//! Options that contradict each other, or name what is not there.

use crate::shop::{Shop, refused};

#[test]
fn what_would_be_settled_in_silence_is_refused() {
    let shop = Shop::new(&[("part.mpf", b"G0 X1\nM30\n")]);
    for (options, said) in [
        (
            &["--tool", "MILL=1", "--tool", "mill=2"][..],
            "error: --tool MILL= is given twice",
        ),
        (
            &["--set", "R5=1", "--set", "r5=2"],
            "error: --set R5= is given twice",
        ),
        (
            &["--edge", "3.2=13", "--edge", "3.2=14"],
            "error: --edge 3.2= is given twice",
        ),
        (
            &["--subprograms", "nowhere"],
            "error: --subprograms nowhere: there is no such folder",
        ),
    ] {
        let error = refused(&shop.run("part.mpf", options));
        assert!(error.contains(said), "{error}");
    }
}
