//! A vertex of the programmed path: where two legs meet.

use super::coarse_curve;
use super::easement;
use super::jump::{Jump, JumpSum, PointSum};
use super::kernel::{FlatKernel, Kernel, Side};
use super::leg::Leg;
use super::lone_corner::LoneCorner;
use super::metric::Metric;
use super::reversal::is_reversal;
use super::settings::BlendSettings;
use super::widths::{FURTHER, FurtherKernel, Widths};

/// A turn of the direction below this is rounding.
const NO_TANGENT_JUMP: f64 = 1e-9;

/// A jump of the curvature below this, 1 per machine unit, is rounding.
const NO_CURVATURE_JUMP: f64 = 1e-6;

/// Up to this turn of the direction, radians, two moves meet in a tangent: programs round their
/// coordinates.
const TANGENT: f64 = 0.01;

/// The start of a leg, where it meets the leg before.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vertex {
    /// Where it is, path distance.
    pub s: f64,
    /// Jump of dp/ds.
    pub tangent_jump: Jump,
    /// Jump of d2p/ds2.
    pub curvature_jump: Jump,
    /// Length of the jump of the tangent, 0 to 2.
    pub tangent_jump_size: f64,
    /// Length of the jump of the curvature, 1 per machine unit.
    pub curvature_jump_size: f64,
    /// What a degree of C counts of the tolerance on both legs at most.
    pub turn_share: f64,
    /// What the jump of the tangent counts of it: its length where C counts as much as A and B.
    pub tolerance_jump_size: f64,
    /// The smaller of its legs' tolerances.
    pub tolerance: f64,
    /// Half of its shorter leg.
    pub half_leg: f64,
    /// Length of the longer of its legs, whole ones where they are divided.
    pub longer_leg: f64,
    /// Mean length of its legs.
    pub mean_leg: f64,
    /// How much the curve that it belongs to may [shrink](super::shrinkage): by how much less its mix may be, times the square of
    /// its width.
    pub shrinkage: f64,
    /// By how much more than itself the other ends of its legs are moved, where a curve is moved by about all it may be; 0 elsewhere.
    pub moved_beside: f64,
    /// By how much the square of its width may grow with the distance from the end of what is known, machine units; infinite where it is on
    /// no curve. See [`tapering`](super::tapering).
    pub taper: f64,
    /// The machine comes to rest here.
    pub stop: bool,
    /// No kernel crosses it. It may have one itself, if it is not a stop.
    pub wall: bool,
    /// Where the nearest wall to the left is.
    pub left_wall: f64,
    /// Where the nearest wall to the right is, infinity where none is known.
    pub right_wall: f64,
    /// A soft limit is near: the path keeps to the inner side. It is a [wall](Self::wall), and its own kernel keeps clear of its
    /// neighbours' and is nowhere negative, so that between lines the path stays within what the program spans.
    pub at_limit: bool,
    /// What its easement is led to the [inner side](easement) by: the curvatures on both sides added up; none elsewhere.
    inner: Jump,
    /// What it may be where it keeps clear of its neighbours.
    pub corner: LoneCorner,
    /// Kernels and easements up to this width need no tolerance: half of the shorter leg under G64
    /// without P, else 0.
    pub free_limit: f64,
    /// What the feed wants of that: the kernel is not made narrower.
    pub free_kernel: f64,
    /// The same of the easement.
    pub free_easement: f64,
    /// Whether its kernel keeps clear of its neighbours' without more ado.
    pub isolated: bool,
    /// What the base width of the kernel is raised to at most.
    pub design_width: f64,
    /// The greatest width found within the tolerance so far.
    pub scanned: f64,
    /// Whether a greater width was found to leave it.
    pub scan_done: bool,
    /// Whether nothing that is yet to come can make it wider.
    pub searched: bool,
    /// What its widths would be but for its neighbours.
    pub base: Widths,
    /// What the check has left of the base widths, 0 to 1.
    pub factor: f64,
    /// The same, as long as not more of the path is known.
    pub temporary_factor: f64,
    /// Widths under examination.
    pub trial: Widths,
    /// What of them needs a tolerance.
    pub counted: Widths,
    /// Widths in force.
    stored: Widths,
    /// The factor that belongs to the stored widths.
    stored_factor: f64,
    /// The further kernels in force.
    further: [Kernel; FURTHER],
    /// What its widths are to be narrowed to, since it is to blame for a place that violates the tolerance; 1 if it is not.
    pub narrowing: f64,
    /// And that place may change for the better when more is known.
    pub marked_temporarily: bool,
    /// Whether it is to go back to the widths in force ..
    pub goes_back: bool,
    /// .. or has, and stays there as long as the trial lasts.
    pub held: bool,
}

impl Vertex {
    pub const VACANT: Self = Self {
        s: 0.0,
        tangent_jump: Jump::NONE,
        curvature_jump: Jump::NONE,
        tangent_jump_size: 0.0,
        curvature_jump_size: 0.0,
        turn_share: 1.0,
        tolerance_jump_size: 0.0,
        tolerance: 0.0,
        half_leg: 0.0,
        longer_leg: 0.0,
        mean_leg: 0.0,
        shrinkage: 0.0,
        moved_beside: 0.0,
        taper: f64::INFINITY,
        stop: true,
        wall: true,
        left_wall: 0.0,
        right_wall: f64::INFINITY,
        at_limit: false,
        inner: Jump::NONE,
        corner: LoneCorner::NONE,
        free_limit: 0.0,
        free_kernel: 0.0,
        free_easement: 0.0,
        isolated: false,
        design_width: 0.0,
        scanned: 0.0,
        scan_done: true,
        searched: true,
        base: Widths::NONE,
        factor: 1.0,
        temporary_factor: 1.0,
        trial: Widths::NONE,
        counted: Widths::NONE,
        stored: Widths::NONE,
        further: [Kernel::NONE; FURTHER],
        stored_factor: 1.0,
        narrowing: 1.0,
        marked_temporarily: false,
        goes_back: false,
        held: false,
    };

    /// Where the path begins at rest, at path distance `s`.
    pub fn first(s: f64) -> Self {
        Self {
            s,
            left_wall: s,
            ..Self::VACANT
        }
    }

    /// The vertex between two legs, with base widths as far as they depend on nothing else.
    pub fn between(before: &Leg, after: &Leg, settings: &BlendSettings, metric: &Metric) -> Self {
        let (from, to) = (before.point(before.end()), after.point(after.start));
        let (tangent_jump, curvature_jump) = (to.first - from.first, to.second - from.second);
        let significant = |size: f64, least: f64| if size > least { size } else { 0.0 };
        let tangent_jump_size = significant(metric.norm(&tangent_jump), NO_TANGENT_JUMP);
        let mut curvature_jump_size = significant(metric.norm(&curvature_jump), NO_CURVATURE_JUMP);
        let at_limit = before.near_limit.end || after.near_limit.start;
        let mut inner = Jump::NONE;
        if at_limit && (tangent_jump_size > 0.0 || curvature_jump_size > 0.0) {
            let sum = from.second + to.second;
            let size = significant(metric.norm(&sum), NO_CURVATURE_JUMP);
            curvature_jump_size = curvature_jump_size.max(size);
            inner = Jump::new(&sum);
        }
        let turn_share = before.turn_share.max(after.turn_share);
        let tolerance_jump_size = if tangent_jump_size > 0.0 {
            metric
                .deviation(&tangent_jump, turn_share)
                .max(NO_TANGENT_JUMP)
        } else {
            0.0
        };
        let exact = before.is_exact() || after.is_exact();
        let stop = before.stop_after
            || after.stop_before
            || exact && tangent_jump_size > TANGENT
            || is_reversal(before, after, [&from.first, &to.first], metric);
        let mut vertex = Self {
            s: after.start,
            tangent_jump: Jump::new(&tangent_jump),
            curvature_jump: Jump::new(&curvature_jump),
            tangent_jump_size,
            curvature_jump_size,
            turn_share,
            tolerance_jump_size,
            tolerance: before.tolerance().min(after.tolerance()),
            half_leg: 0.5 * before.length.min(after.length),
            longer_leg: before.whole.max(after.whole),
            mean_leg: 0.5 * (before.length + after.length),
            stop,
            wall: stop || exact || at_limit,
            at_limit,
            inner,
            ..Self::VACANT
        };
        if exact && !stop {
            vertex.find_exact_widths(before, after, settings);
        } else if !stop {
            vertex.find_base_widths(before, after, settings);
        }
        vertex
    }

    /// The width of the kernel where it keeps clear of its neighbours' and does not swing out.
    pub fn width_alone(&self) -> f64 {
        if self.isolated && self.free_limit > 0.0 {
            self.free_kernel
        } else {
            self.corner.width.min(self.half_leg).max(self.free_kernel)
        }
    }

    /// Its base widths where it keeps clear of its neighbours.
    pub fn widths_alone(&self) -> Widths {
        let plain = Widths {
            kernel: self.width_alone(),
            mix: self.corner.mix,
            ..Widths::NONE
        };
        Widths {
            easement: self.base.easement,
            ..self.corner.swinging_out(f64::INFINITY).unwrap_or(plain)
        }
    }

    /// What is left of the base widths within `clip`.
    pub fn widths_within(&self, clip: f64) -> Widths {
        let narrowed = self.temporary_factor;
        let swinging_out = if self.base.further_reach() > 0.0 {
            self.corner.swinging_out(clip / self.factor)
        } else {
            None
        };
        let kernels = match swinging_out {
            Some(widths) => widths.scaled(narrowed * self.factor),
            None => {
                let base = if self.base.further_reach() > 0.0 {
                    self.width_alone()
                } else {
                    self.base.kernel
                };
                let kernel = narrowed * clip.min(base * self.factor);
                let kernel = kernel.max(self.free_kernel.min(clip));
                Widths {
                    kernel,
                    mix: self.mix(kernel),
                    ..Widths::NONE
                }
            }
        };
        let easement = narrowed * clip.min(self.base.easement * self.factor.sqrt());
        Widths {
            easement: easement.max(self.free_easement.min(clip)),
            ..kernels
        }
    }

    /// Whether its kernel needs no tolerance, whatever its neighbours' are.
    pub fn is_free(&self) -> bool {
        self.scan_done && self.base.kernel <= self.free_limit
    }

    /// Puts widths under examination.
    pub fn set_trial(&mut self, widths: Widths) {
        let counted = |width: f64| if width > self.free_limit { width } else { 0.0 };
        let mut widths = widths;
        if self.at_limit && self.tangent_jump_size > 0.0 && self.curvature_jump_size > 0.0 {
            let both = widths.kernel.min(widths.easement);
            widths.kernel = both;
            widths.easement = both;
        }
        self.trial = widths;
        self.counted = Widths {
            kernel: counted(widths.kernel),
            easement: counted(widths.easement),
            ..widths
        };
    }

    /// Whether there is anything to be smoothed.
    pub fn is_smoothed(&self) -> bool {
        !self.stop && (self.tangent_jump_size > 0.0 || self.curvature_jump_size > 0.0)
    }

    /// Whether nothing at all changes the path here.
    pub fn is_bare_wall(&self) -> bool {
        self.wall && !self.is_smoothed()
    }

    /// What the width of its kernel is raised to at most where it is one of a curve, machine units.
    pub fn greatest_width_on_curve(&self, settings: &BlendSettings) -> f64 {
        let shorter_leg = 2.0 * self.half_leg;
        let legs = coarse_curve::most_legs(self.tangent_jump_size, self.longer_leg / shorter_leg);
        let run = legs * self.longer_leg;
        self.design_width
            .max(run.min(settings.greatest_design_width()))
    }

    /// How far it might reach in later assignments, going by what is known.
    pub fn possible_reach(&self, settings: &BlendSettings) -> f64 {
        let kernel = if self.scan_done {
            self.base.kernel
        } else {
            self.scanned.max(self.greatest_width_on_curve(settings))
        };
        let outer = if self.corner.may_swing_out {
            self.corner.greatest_width
        } else {
            0.0
        };
        kernel
            .max(outer)
            .max(self.base.easement)
            .max(self.stored.reach())
    }

    /// Adds what it contributes with `widths` to the deviation of the blended path from the
    /// programmed one, at `distance` from it, positive to its right.
    #[inline]
    pub fn add_deviation(&self, widths: &Widths, distance: f64, deviation: &mut JumpSum<1>) {
        let x = distance.abs();
        if x < widths.kernel || x < widths.further_reach() {
            deviation.add(&self.tangent_jump, &[widths.deviation(x)]);
        }
        if x < widths.easement {
            let value = widths.easement * widths.easement * easement::value(x / widths.easement);
            deviation.add(&self.curvature_jump, &[value.copysign(distance)]);
            if self.at_limit {
                let inner = easement::inner_value(x / widths.easement);
                deviation.add(&self.inner, &[widths.easement * widths.easement * inner]);
            }
        }
    }

    /// A bound of the second derivative of what it contributes with `widths`, at `distance` from
    /// it, 0 and above, and everywhere beyond.
    #[inline]
    pub fn bend_bound(&self, widths: &Widths, distance: f64) -> f64 {
        let mut bound = self.tangent_jump_size * widths.bend_bound(distance);
        if distance < widths.easement {
            bound += self.curvature_jump_size
                * if self.at_limit {
                    easement::INNER_GREATEST_SECOND
                } else {
                    easement::GREATEST_SECOND
                };
        }
        bound
    }

    /// Puts the widths under examination in force. Answers whether these are others than before.
    pub fn store_trial(&mut self) -> bool {
        self.stored_factor = self.factor;
        if self.trial == self.stored {
            return false;
        }
        self.stored = self.trial;
        self.further = self.stored.further.map(|further| {
            if further.width > 0.0 {
                Kernel::new(further.width, 0.0, further.share)
            } else {
                Kernel::NONE
            }
        });
        true
    }

    /// The kernel in force and its width, unless it has a share of K8: then one that is nowhere.
    pub fn stored_kernel(&self) -> (Kernel, f64) {
        let Widths { kernel, mix, .. } = self.stored;
        if mix < 0.0 {
            (Kernel::NONE, 0.0)
        } else {
            (Kernel::new(kernel, mix, self.stored.own_share()), kernel)
        }
    }

    /// Whether it adds more to the path than that.
    pub fn has_more(&self) -> bool {
        let Widths { mix, easement, .. } = self.stored;
        mix < 0.0 || self.stored.further_reach() > 0.0 || easement > 0.0
    }

    /// Widths in force.
    #[inline]
    pub fn stored(&self) -> &Widths {
        &self.stored
    }

    /// The factor that belongs to them.
    pub fn stored_factor(&self) -> f64 {
        self.stored_factor
    }

    /// Whether the curvature of the programmed path jumps here by more than rounding.
    pub fn curvature_jumps(&self) -> bool {
        self.curvature_jump_size > NO_CURVATURE_JUMP
    }

    /// Where between two places the third derivative of the path or its slope may jump: both sides of a jump.
    #[inline]
    pub fn breakpoints(&self, from: f64, to: f64, mut take: impl FnMut(f64)) {
        let Widths {
            kernel,
            further,
            easement,
            ..
        } = self.stored;
        let mut look = |place: f64| {
            if from < place && place < to {
                take(place);
            }
        };
        for FurtherKernel { width, .. } in further {
            if width > 0.0 {
                look(self.s - width);
                look(self.s + width);
            }
        }
        if kernel > 0.0 {
            look(self.s - kernel);
        }
        if easement > 0.0 {
            look(self.s - easement);
        }
        // The kernel itself has no edge in the middle.
        if easement > 0.0 || self.curvature_jumps() {
            look(self.s.next_down());
            look(self.s);
        }
        if easement > 0.0 {
            look(self.s + easement);
        }
        if kernel > 0.0 {
            look(self.s + kernel);
        }
    }

    /// Adds what it contributes in force besides its [kernel](Self::stored_kernel) to a point of the path at a `distance` from it,
    /// 0 and above, on this `side`. Few vertices have anything of the kind: apart, it leaves the registers to the others.
    #[inline(never)]
    pub fn add_more<const N: usize, const LOW: bool, const HIGH: bool>(
        &self,
        sum: &mut PointSum<N, LOW, HIGH>,
        distance: f64,
        side: Side,
    ) {
        let Widths {
            kernel,
            mix,
            further,
            ..
        } = self.stored;
        if mix < 0.0 && distance < kernel {
            let flat = FlatKernel::new(kernel, mix, self.stored.own_share());
            let factors = flat.factors(side.sign() * distance);
            sum.add(&self.tangent_jump, &factors);
        }
        for (further, kernel) in further.iter().zip(&self.further) {
            if distance < further.width {
                sum.add(&self.tangent_jump, &kernel.factors(distance, side));
            }
        }
        if distance < self.stored.easement {
            let width = self.stored.easement;
            sum.add(
                &self.curvature_jump,
                &easement::factors(width, distance, side),
            );
            if self.at_limit {
                sum.add(&self.inner, &easement::inner_factors(width, distance, side));
            }
        }
    }

    /// Whether nothing but XYZ jumps.
    pub fn is_linear(&self) -> bool {
        let jumps = [&self.tangent_jump, &self.curvature_jump, &self.inner];
        jumps.into_iter().all(Jump::is_linear)
    }
}
