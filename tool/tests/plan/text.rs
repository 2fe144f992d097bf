//! What a user sees of a plan.

use crate::support::{Bench, MILL};

#[test]
fn the_text_says_where_the_time_goes() {
    let bench = Bench::new();
    bench.write("mill.ini", MILL);
    bench.write("part.ngc", "G21 G61.1 F6000\nG1 X1\nM2\n");
    let output = bench.plan(&["part.ngc", "--ini", "mill.ini"]);
    assert!(output.status.success());
    let text = String::from_utf8(output.stdout).expect("a text");
    // Which of several equal peaks is found first is a matter of the last digits.
    let (text, peaks) = text.split_once("Peaks of the axes").expect("peaks");
    assert!(peaks.contains("  X   velocity ") && peaks.ends_with('\n'));
    insta::assert_snapshot!("a_line_from_rest_to_rest", text);
}
