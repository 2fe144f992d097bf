//! Derivatives of a function that is known at points which are not evenly spaced.

/// Points of a stencil: the polynomial through them is of the sixth degree.
pub(crate) const STENCIL: usize = 7;

/// Derivatives that are computed: those of order 0 to 3.
pub(crate) const ORDERS: usize = 4;

/// Weights of the values at `points` in the derivatives of order 0 to 3 at `at`: shape (4, 7).
///
/// Fornberg, "Generation of finite difference formulas on arbitrarily spaced grids", Mathematics of
/// Computation 51 (1988). The points have to differ from each other.
pub(crate) fn weights(at: f64, points: &[f64; STENCIL]) -> [[f64; STENCIL]; ORDERS] {
    let mut weights = [[0.0; STENCIL]; ORDERS];
    weights[0][0] = 1.0;
    let mut product = 1.0;
    let mut offset = points[0] - at;
    for i in 1..STENCIL {
        let mut next_product = 1.0;
        let offset_before = offset;
        offset = points[i] - at;
        for j in 0..i {
            let distance = points[i] - points[j];
            next_product *= distance;
            if j == i - 1 {
                for order in (0..ORDERS).rev() {
                    let lower = match order {
                        0 => 0.0,
                        _ => order as f64 * weights[order - 1][i - 1],
                    };
                    weights[order][i] =
                        product * (lower - offset_before * weights[order][i - 1]) / next_product;
                }
            }
            for order in (0..ORDERS).rev() {
                let lower = match order {
                    0 => 0.0,
                    _ => order as f64 * weights[order - 1][j],
                };
                weights[order][j] = (offset * weights[order][j] - lower) / distance;
            }
        }
        product = next_product;
    }
    weights
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_for_polynomials_of_the_sixth_degree() {
        let points = [-1.0, -0.4, 0.1, 0.7, 1.0, 1.9, 2.2];
        let at = 0.3_f64;
        let weights = weights(at, &points);
        let value = |x: f64| x.powi(6) - 2.0 * x.powi(3) + x;
        let exact = [
            value(at),
            6.0 * at.powi(5) - 6.0 * at.powi(2) + 1.0,
            30.0 * at.powi(4) - 12.0 * at,
            120.0 * at.powi(3) - 12.0,
        ];
        for (weights, exact) in weights.iter().zip(exact) {
            let sum: f64 = weights.iter().zip(points).map(|(w, x)| w * value(x)).sum();
            assert!((sum - exact).abs() < 1e-11, "{sum} {exact}");
        }
    }
}
