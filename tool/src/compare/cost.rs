//! What the calls of a module cost.

use serde::Serialize;

/// Durations, microseconds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub(crate) struct Cost {
    pub calls: usize,
    pub mean: f64,
    pub median: f64,
    /// 99.9th percentile.
    pub p999: f64,
    pub max: f64,
}

impl Cost {
    /// From durations in nanoseconds.
    pub(crate) fn of(durations: impl Iterator<Item = u32>) -> Cost {
        let mut sorted: Vec<u32> = durations.collect();
        sorted.sort_unstable();
        let Some(&max) = sorted.last() else {
            return Cost::default();
        };
        let at = |share: f64| f64::from(sorted[((sorted.len() - 1) as f64 * share) as usize]) / 1e3;
        let sum: f64 = sorted.iter().map(|&duration| f64::from(duration)).sum();
        Cost {
            calls: sorted.len(),
            mean: sum / sorted.len() as f64 / 1e3,
            median: at(0.5),
            p999: at(0.999),
            max: f64::from(max) / 1e3,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_a_thousand_and_one() {
        let cost = Cost::of((0..=1000).map(|n| n * 1000));
        assert_eq!(
            (cost.calls, cost.median, cost.p999, cost.max),
            (1001, 500.0, 999.0, 1000.0)
        );
        assert!((cost.mean - 500.0).abs() < 1e-9);
        assert_eq!(Cost::of(std::iter::empty()), Cost::default());
    }
}
