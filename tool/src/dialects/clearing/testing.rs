//! What the tests of clearing share.

use cavalier_contours::polyline::{PlineSourceMut, Polyline};

/// A closed contour of straight lines.
pub fn polygon(corners: &[[f64; 2]]) -> Polyline {
    let mut line = Polyline::new_closed();
    for [x, y] in corners {
        line.add(*x, *y, 0.0);
    }
    line
}
