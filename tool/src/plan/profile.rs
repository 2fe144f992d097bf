//! Least and greatest values over time of runs whose length is not known beforehand.

/// Buckets of time at most.
const MOST_BUCKETS: usize = 4096;

/// Ranges of several quantities in equal buckets of time: when there are too many, two become one.
#[derive(Clone, Debug)]
pub struct Profiles {
    channels: usize,
    /// Servo cycles in each bucket.
    pub cycles: usize,
    /// Cycles in the last bucket.
    filled: usize,
    /// Shape (buckets, channels).
    ranges: Vec<[f32; 2]>,
}

impl Profiles {
    /// For so many quantities.
    pub fn new(channels: usize) -> Self {
        Profiles {
            channels,
            cycles: 1,
            filled: 1,
            ranges: Vec::new(),
        }
    }

    /// Number of buckets.
    pub fn buckets(&self) -> usize {
        self.ranges.len() / self.channels
    }

    /// A servo cycle, shape (channels).
    pub fn note(&mut self, values: &[f32]) {
        if self.ranges.is_empty() || self.filled == self.cycles {
            if self.buckets() == MOST_BUCKETS {
                self.halve();
            }
            self.ranges.extend(values.iter().map(|value| [*value; 2]));
            self.filled = 1;
            return;
        }
        self.filled += 1;
        let first = self.ranges.len() - self.channels;
        for (range, value) in self.ranges[first..].iter_mut().zip(values) {
            *range = [range[0].min(*value), range[1].max(*value)];
        }
    }

    fn halve(&mut self) {
        let channels = self.channels;
        for bucket in 0..MOST_BUCKETS / 2 {
            for channel in 0..channels {
                let [a, b] =
                    [2 * bucket, 2 * bucket + 1].map(|k| self.ranges[k * channels + channel]);
                self.ranges[bucket * channels + channel] = [a[0].min(b[0]), a[1].max(b[1])];
            }
        }
        self.ranges.truncate(MOST_BUCKETS / 2 * channels);
        self.cycles *= 2;
    }

    /// Least and greatest value of a quantity in each bucket, shape (buckets).
    pub fn channel(&self, channel: usize) -> impl Iterator<Item = [f32; 2]> + '_ {
        self.ranges
            .iter()
            .skip(channel)
            .step_by(self.channels)
            .copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_single_spike_survives() {
        let mut profiles = Profiles::new(2);
        for k in 0..100_000 {
            profiles.note(&[if k == 77_777 { 5.0 } else { 0.0 }, k as f32]);
        }
        assert!(profiles.buckets() <= MOST_BUCKETS && profiles.buckets() > MOST_BUCKETS / 4);
        let spikes: Vec<usize> = profiles
            .channel(0)
            .enumerate()
            .filter(|(_, range)| range[1] == 5.0)
            .map(|(bucket, _)| bucket)
            .collect();
        assert_eq!(spikes, [77_777 / profiles.cycles]);
        let last = profiles.channel(1).last().expect("a bucket");
        assert_eq!(last[1], 99_999.0);
        assert!(profiles.channel(1).all(|[low, high]| low <= high));
    }
}
