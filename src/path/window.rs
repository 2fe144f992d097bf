//! The part of the path that widths are chosen for at a time.

use super::chain::{Chain, NEIGHBOURS};
use super::settings::BlendSettings;

/// Kernels end this share before what they must not reach, so that rounding never carries them
/// over it.
const CLEAR: f64 = 0.999;

/// What is final keeps this factor clear of kernels that are not, so that rounding never carries
/// them into it, and that what they keep clear of it takes nothing from them.
const AMPLE: f64 = 1.002;

/// The vertices whose widths may change, and what they must not reach.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window {
    /// Number of the first vertex whose widths may change.
    pub open: u64,
    /// Number of the first leg that is not looked at yet.
    pub next: u64,
    /// Where the last leg that is looked at ends, path distance.
    pub end: f64,
    /// Up to here the path never changes again.
    pub frozen: f64,
}

impl Window {
    pub const EMPTY: Self = Self {
        open: 0,
        next: 0,
        end: 0.0,
        frozen: 0.0,
    };

    /// How far a vertex may reach: to the nearest wall, the ends of the window, and its 32nd
    /// neighbour on either side.
    pub fn clip(&self, chain: &Chain, number: u64) -> f64 {
        self.room(chain, number, self.end)
    }

    /// The same where the legs that are yet to come are as long as can be: no width beyond this will
    /// ever be possible.
    pub fn lasting_clip(&self, chain: &Chain, number: u64) -> f64 {
        self.room(chain, number, f64::INFINITY)
    }

    /// How far a vertex may reach if the window ends at `end`.
    fn room(&self, chain: &Chain, number: u64, end: f64) -> f64 {
        let vertex = chain.vertex(number);
        let left = match number.checked_sub(NEIGHBOURS) {
            Some(far) if far >= chain.first() => chain.vertex(far).s,
            _ => vertex.left_wall,
        };
        let far = number.saturating_add(NEIGHBOURS);
        let right = if far < self.next {
            chain.vertex(far).s
        } else {
            end
        };
        let left = vertex.s - left.max(vertex.left_wall).max(self.frozen);
        let right = right.min(vertex.right_wall) - vertex.s;
        CLEAR * left.min(right).max(0.0)
    }

    /// Whether what happens at `s` may look different when more is known.
    pub fn is_near_end(&self, s: f64, distance: f64) -> bool {
        self.end - s < distance
    }

    /// Up to where neither the open vertices nor those yet to come will have any effect.
    pub fn untouchable(&self, chain: &Chain, settings: &BlendSettings) -> f64 {
        let Self {
            open, next, end, ..
        } = *self;
        let newest = next.wrapping_sub(1);
        let (last, vertex) = (chain.leg(newest), chain.vertex(newest));
        let wall = if vertex.wall {
            vertex.s
        } else {
            vertex.left_wall
        };
        let bare = next < chain.next() && chain.vertex(next).is_bare_wall();
        let coming = if last.stop_after || bare {
            end
        } else {
            (end - AMPLE * last.reserve(settings, vertex.tangent_jump_size)).max(wall)
        };
        (open..next)
            .map(|number| chain.vertex(number))
            .map(|vertex| {
                let reach = AMPLE * vertex.possible_reach(settings);
                (vertex.s - reach).max(vertex.left_wall)
            })
            .fold(coming, f64::min)
    }
}
