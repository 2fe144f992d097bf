//! How wide a vertex should be: the widest kernel within the tolerance, if all its neighbours had
//! the same width.

use super::blame::MANY_KERNELS;
use super::chain::Chain;
use super::equal_widths::EqualWidthsSum;
use super::linear_axes;
use super::lone_corner::OUTER_REACH;
use super::metric::Metric;
use super::settings::BlendSettings;
use super::vertex::Vertex;
use super::vertex_widths::KERNEL_SHARE;
use super::widths::Widths;
use super::window::Window;

/// Ratio of one width tried to the one before.
const GROWTH: f64 = 1.25;

/// Two jumps of the tangent are of the same kind if the cosine between them exceeds this.
const SAME_KIND: f64 = 0.25;

/// Beside a corner only those are corners that turn by more than this share of what it does.
const ANOTHER_CORNER: f64 = 0.5;

/// Vertices to one side of a corner that are looked at for another one.
const LOOKED_AT: usize = 8;

/// A scan that ends below so many corner widths gains nothing over a plain corner.
const WORTHWHILE: f64 = 1.65;

/// Tries the next greater width for a vertex. Answers whether the search goes on, and how many
/// kernel terms it took.
pub(super) fn widen(
    chain: &mut Chain,
    number: u64,
    window: &Window,
    settings: &BlendSettings,
    metric: &Metric,
) -> (bool, usize) {
    let looked = keep_clear(chain, number, window, metric);
    let vertex = chain.vertex(number);
    if vertex.scan_done || vertex.wall || vertex.tangent_jump_size <= 0.0 {
        return (false, looked);
    }
    let grown = vertex.scanned * GROWTH;
    // That much is allowed beside any neighbours.
    let width = if grown <= vertex.design_width {
        grown
    } else {
        grown.min(greatest_width(chain, number, window, settings, metric))
    };
    let wider = width > vertex.scanned * 1.0001;
    // Whether nothing that is yet to come can make a greater width possible.
    let mut searched = if wider {
        width > window.lasting_clip(chain, number)
    } else {
        number.saturating_add(1) < window.next || has_long_legs(vertex, settings)
    };
    let mut cost = looked;
    let mut goes_on = false;
    let mut too_wide = false;
    if wider && width <= window.clip(chain, number) {
        let (deviation, terms) = deviation_at_equal_widths(chain, number, width, window, metric);
        cost += terms;
        let allowed = KERNEL_SHARE * vertex.tolerance / deviation;
        too_wide = allowed < 1.0;
        searched = too_wide;
        goes_on = !too_wide;
        // On a curve the deviation grows with the square of the widths. Among many kernels it would be too wide all the same.
        let found = if !too_wide {
            width
        } else if terms <= MANY_KERNELS {
            width * allowed.sqrt()
        } else {
            vertex.scanned
        };
        let vertex = chain.vertex_mut(number);
        vertex.scanned = vertex.scanned.max(found);
        vertex.let_shrink(deviation);
    }
    let vertex = chain.vertex_mut(number);
    vertex.scan_done = too_wide;
    vertex.searched = searched;
    choose(chain, number);
    (goes_on, cost)
}

/// Whether both legs of a vertex are so long that no width that is tried is wider than half of one, where kernels would overlap.
fn has_long_legs(vertex: &Vertex, settings: &BlendSettings) -> bool {
    vertex.half_leg >= settings.greatest_design_width()
}

/// Looks how far the next corner is from a vertex that may swing out. Answers the kernel terms that it took.
fn keep_clear(chain: &mut Chain, number: u64, window: &Window, metric: &Metric) -> usize {
    let vertex = chain.vertex(number);
    if !vertex.corner.may_swing_out {
        return 1;
    }
    let before = chain.left_of(number).skip(1);
    let left = next_corner(vertex, before, 2.0 * vertex.half_leg, metric);
    let after = chain.right_of(number, window.next);
    let right = next_corner(vertex, after, window.end - vertex.s, metric);
    let vertex = chain.vertex_mut(number);
    vertex.corner.clear = left.distance.min(right.distance);
    vertex.corner.of_figure = left.turns_on && right.turns_on;
    if vertex.scan_done {
        choose(chain, number);
    }
    LOOKED_AT / 2
}

/// Base widths as wide as was found, or those of a corner by itself.
fn choose(chain: &mut Chain, number: u64) {
    let vertex = chain.vertex_mut(number);
    let plain = if vertex.free_limit > 0.0 {
        vertex.width_alone()
    } else {
        vertex.corner.biweight_width.min(vertex.half_leg)
    };
    let alone = vertex.widths_alone();
    let beyond = 1.01 * vertex.half_leg.max(alone.further_reach());
    let overlaps = vertex.scanned > beyond && vertex.scanned >= WORTHWHILE * plain;
    vertex.base = if overlaps {
        Widths {
            kernel: vertex.scanned,
            easement: vertex.base.easement,
            ..Widths::NONE
        }
    } else {
        alone
    };
    chain.set_of_curve(number);
}

/// The next corner to one side.
struct NextCorner {
    distance: f64,
    /// Whether it turns to the same side.
    turns_on: bool,
}

/// The nearest of the `others` that turns as a corner does beside `vertex`; at least as far as the last one that is
/// looked at, or `end` if they end before. Where no corner may swing out, none reaches farther.
fn next_corner<'a>(
    vertex: &Vertex,
    others: impl Iterator<Item = (u64, &'a Vertex)>,
    end: f64,
    metric: &Metric,
) -> NextCorner {
    let least = ANOTHER_CORNER * vertex.tangent_jump_size;
    let mut next = NextCorner {
        distance: end,
        turns_on: false,
    };
    let mut found = false;
    for (looked, (_, other)) in others.enumerate() {
        let distance = (other.s - vertex.s).abs();
        if found && distance >= OUTER_REACH * next.distance {
            break;
        }
        if other.at_limit {
            next.distance = distance / OUTER_REACH;
            break;
        }
        let turns = other.tangent_jump_size > least;
        if !found && (other.wall || turns || looked + 1 >= LOOKED_AT) {
            found = true;
            next.distance = distance;
            next.turns_on = turns && is_same_kind(vertex, other, metric);
        }
    }
    next
}

/// Whether two vertices turn to about the same side.
fn is_same_kind(one: &Vertex, other: &Vertex, metric: &Metric) -> bool {
    metric.product(&one.tangent_jump.axes(), &other.tangent_jump.axes())
        > SAME_KIND * one.tangent_jump_size * other.tangent_jump_size
}

/// What a width is raised to at most, where neighbours turn to the same side as on a coarse curve.
fn greatest_width(
    chain: &Chain,
    number: u64,
    window: &Window,
    settings: &BlendSettings,
    metric: &Metric,
) -> f64 {
    let vertex = chain.vertex(number);
    let same = |other: &Vertex| is_same_kind(vertex, other, metric);
    let before = chain.vertex(number.saturating_sub(1));
    let after = chain.vertex(number.saturating_add(1));
    if number.saturating_add(1) < window.next && same(before) && same(after) {
        vertex.greatest_width_on_curve(settings)
    } else {
        vertex.design_width
    }
}

/// The deviation at a vertex if it and its neighbours had kernels of this width, isolated corners
/// their own, and the kernel terms that it took.
fn deviation_at_equal_widths(
    chain: &Chain,
    number: u64,
    width: f64,
    window: &Window,
    metric: &Metric,
) -> (f64, usize) {
    let here = chain.vertex(number).s;
    let mut sum = EqualWidthsSum::new(here, width);
    let vertex = |number| chain.vertex(number);
    sum.add(chain.curve_left_of(number), vertex);
    sum.add(chain.curve_right_of(number, window.next), vertex);
    let (mut deviation, terms) = sum.total();
    let share = chain.vertex(number).turn_share;
    linear_axes::add(&mut deviation, &chain.leg(number).shift_at(here));
    (metric.deviation(&deviation, share), terms)
}
