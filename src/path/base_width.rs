//! How wide a vertex should be: the widest kernel within the tolerance, if all its neighbours had
//! the same width.

use super::chain::Chain;
use super::jump::JumpSum;
use super::kernel;
use super::metric::Metric;
use super::settings::BlendSettings;
use super::vertex::{KERNEL_SHARE, Vertex};
use super::window::Window;

/// Ratio of one width tried to the one before.
const GROWTH: f64 = 1.25;

/// Two jumps of the tangent are of the same kind if the cosine between them exceeds this.
const SAME_KIND: f64 = 0.25;

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
    let vertex = chain.vertex(number);
    if vertex.scan_done || vertex.wall || vertex.tangent_jump_size <= 0.0 {
        return (false, 1);
    }
    let width =
        (vertex.scanned * GROWTH).min(greatest_width(chain, number, window, settings, metric));
    let wider = width > vertex.scanned * 1.0001;
    // Whether nothing that is yet to come can make a greater width possible.
    let mut searched = if wider {
        width > window.lasting_clip(chain, number)
    } else {
        number.saturating_add(1) < window.next
    };
    let mut cost = 1;
    let mut goes_on = false;
    let mut too_wide = false;
    if wider && width <= window.clip(chain, number) {
        let (deviation, terms) = deviation_at_equal_widths(chain, number, width, window, metric);
        cost += terms;
        too_wide = deviation > KERNEL_SHARE * vertex.tolerance;
        searched = too_wide;
        goes_on = !too_wide;
    }
    let vertex = chain.vertex_mut(number);
    if goes_on {
        vertex.scanned = width;
    }
    vertex.scan_done = too_wide;
    vertex.searched = searched;
    let alone = if vertex.free_limit > 0.0 {
        vertex.width_alone()
    } else {
        vertex.biweight_width.min(vertex.half_leg)
    };
    let overlaps = vertex.scanned > vertex.half_leg * 1.01 && vertex.scanned >= WORTHWHILE * alone;
    vertex.base.kernel = if overlaps {
        vertex.scanned
    } else {
        vertex.width_alone()
    };
    (goes_on, cost)
}

/// What a width is raised to at most: where neighbours turn the same way, as on a coarse curve,
/// two legs at least.
fn greatest_width(
    chain: &Chain,
    number: u64,
    window: &Window,
    settings: &BlendSettings,
    metric: &Metric,
) -> f64 {
    let vertex = chain.vertex(number);
    let same = |other: &Vertex| {
        metric.product(&other.tangent_jump.axes(), &vertex.tangent_jump.axes())
            > SAME_KIND * other.tangent_jump_size * vertex.tangent_jump_size
    };
    let before = chain.vertex(number.saturating_sub(1));
    let after = chain.vertex(number.saturating_add(1));
    if number.saturating_add(1) < window.next && same(before) && same(after) {
        let run = 2.0 * vertex.longer_leg;
        vertex
            .design_width
            .max(run.min(settings.greatest_design_width()))
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
    let mut sum = JumpSum::ZERO;
    let mut terms = 1;
    let left = chain
        .left_of(number)
        .take_while(|(_, vertex)| here - vertex.s < width);
    let right = chain
        .right_of(number, window.next)
        .take_while(|(_, vertex)| vertex.s - here < width);
    for (_, vertex) in left.chain(right) {
        terms += 1;
        let (kernel_width, mix) = if vertex.wall || vertex.is_free() {
            continue;
        } else if vertex.isolated {
            (vertex.base.kernel.min(width), vertex.corner_mix)
        } else {
            (width, vertex.overlapping_mix(width))
        };
        let distance = (here - vertex.s).abs();
        if distance < kernel_width {
            let value = kernel_width * kernel::value(distance / kernel_width, mix);
            sum.add(&vertex.tangent_jump, &[value]);
        }
    }
    let share = chain.vertex(number).turn_share;
    (metric.deviation(&sum.axes(), share), terms)
}
