import super::super::bounds::hamburger4::{hamburger4_support};
import super::super::maths::hankel::{hankel_christoffel_number, hankel_factor, hankel_second_polynomial};

// Blocker search in filtered moments: how deep the blockers of a receiver are on average, in constant time.
//
// The moments of a search region have one canonical distribution with the fragment depth as a support point; what it has
// in front of the fragment stands for the blockers (Peters et al., JCGT 6(1) 2017, section 5; GDC 2016). Here their mean
// comes without the published quotient of roots: outside of the Gauss nodes all support points lie on one side of the
// fragment, so that the mean of the whole distribution gives it, and between them one lies in front.
//
// The fragment depth has no receiver bias: with one, the blockers at a contact would be taken for the receiver.

// What lies in front of a receiver.
struct SoftBlockers {
    // Its share, in [0, 1].
    share: f32,
    // Its mean moment depth, in [-1, 1]; the receiver's where there is nothing.
    depth: f32,
}

// With a share far below this the mean is the receiver's depth (GDC 2016): the little that rounding leaves in front of an
// unshadowed receiver has no meaningful depth.
const SOFT_BLOCKERS_SMALLEST_SHARE: f32 = 1e-3;

// Blockers of a receiver at moment depth `z` whose share is `share` and whose mean is `distance` in front of the receiver.
fn soft_blockers_from(z: f32, share: f32, distance: f32) -> SoftBlockers {
    let weight = saturate(share);
    // (share * mean + smallest * z) / (share + smallest), relative to z.
    let mean = z - max(distance, 0.0) * (weight / (weight + SOFT_BLOCKERS_SMALLEST_SHARE));
    return SoftBlockers(weight, clamp(mean, -1.0, 1.0));
}

// Blockers from four moments that are already biased by `alpha` >= 3e-7 and lie within [-2.1, 2.1].
fn soft_blockers_of_four_moments(biased: vec4f, fragment_depth: f32, alpha: f32) -> SoftBlockers {
    let z = clamp(fragment_depth, -1.0, 1.0);
    let factor = hankel_factor(biased, alpha);
    let x = z - biased.x;
    let polynomial = hankel_second_polynomial(factor, x);
    let support = hamburger4_support(factor, x, polynomial);
    let outside = polynomial >= 0.0;
    // The weight of the fragment itself, or of the support point in front of it. The farthest one is at infinity where
    // the fragment is in front of the Gauss nodes, without weight.
    let t = select(support.points.x, x, outside);
    let weight = hankel_christoffel_number(factor, t, hankel_second_polynomial(factor, t));
    if !outside {
        return soft_blockers_from(z, weight, x - support.points.x);
    }
    if x < 0.0 {
        return SoftBlockers(0.0, z);
    }
    // All the rest is in front: sum of weights 1 - w, and the mean of (point - mean) is -w x / (1 - w).
    let share = 1.0 - weight;
    return soft_blockers_from(z, share, x / max(share, 1e-6));
}

// Blockers from two moments with a variance of at least `smallest_variance`: the canonical distribution has one more point.
fn soft_blockers_of_two_moments(moments: vec2f, fragment_depth: f32, smallest_variance: f32) -> SoftBlockers {
    let z = clamp(fragment_depth, -1.0, 1.0);
    let variance = max(fma(-moments.x, moments.x, moments.y), smallest_variance);
    let x = z - moments.x;
    if x <= 0.0 {
        return SoftBlockers(0.0, z);
    }
    // It is variance / x in front of the mean.
    let square = x * x;
    return soft_blockers_from(z, square / (variance + square), x + variance / max(x, 1e-6));
}
