//! All rays from a receiver to the places of a light: a pyramid, and which triangles block which of them.

use glam::{DVec2, DVec3};

use super::bvh::Box3;

/// By how much the pyramid is wider than the light, so that no rounding cuts off what a ray meets.
const WIDENED: f64 = 1.001;

/// The narrowest pyramid, as a part of its length: that of a light without size has an inside, too.
const NARROWEST: f64 = 1e-6;

/// A light as a receiver sees it: the vectors to its places are `base + x half.x right + y half.y up` with x and y from -1
/// to 1.
#[derive(Clone, Copy)]
pub(super) struct Target {
    /// The vector to the light's centre.
    pub(super) base: DVec3,
    /// Unit vectors along its sides.
    pub(super) right: DVec3,
    pub(super) up: DVec3,
    /// Half its width and height.
    pub(super) half: DVec2,
    /// Whether rays end at the light; otherwise these are directions.
    pub(super) finite: bool,
}

/// The pyramid from a receiver to a light.
pub(super) struct Shaft {
    pub(super) origin: DVec3,
    pub(super) target: Target,
    /// Normals that point inwards, and their products with a point on the plane.
    planes: [(DVec3, f64); 6],
}

/// A function of the place on the light: `value + place . gradient`.
#[derive(Clone, Copy)]
pub(super) struct Affine {
    value: f64,
    gradient: DVec2,
}

impl Affine {
    pub(super) fn new(normal: DVec3, target: &Target) -> Self {
        Self {
            value: normal.dot(target.base),
            gradient: DVec2::new(normal.dot(target.right), normal.dot(target.up)) * target.half,
        }
    }

    pub(super) fn at(self, place: DVec2) -> f64 {
        self.value + self.gradient.dot(place)
    }

    /// The largest value with x and y from -1 to 1.
    fn largest(self) -> f64 {
        self.value + self.gradient.abs().element_sum()
    }

    fn smallest(self) -> f64 {
        self.value - self.gradient.abs().element_sum()
    }
}

/// What a triangle hides of a light from a receiver: the places where none of these is negative.
pub(super) struct Shade {
    /// The corners' weights, up to a common factor, and how far behind the triangle the light lies.
    pub(super) bounds: [Affine; 4],
    /// Whether it hides the light completely.
    pub(super) complete: bool,
}

impl Shaft {
    pub(super) fn new(origin: DVec3, target: Target, axis: DVec3) -> Self {
        let least = NARROWEST * target.base.length();
        let half = (WIDENED * target.half).max(DVec2::splat(least));
        let [u, v] = [half.x * target.right, half.y * target.up];
        let base = target.base;
        let corners = [base + u + v, base - u + v, base - u - v, base + u - v];
        let inwards = |normal: DVec3| (normal, normal.dot(origin));
        let side = |index: usize| {
            let normal = corners[index].cross(corners[(index + 1) % 4]);
            inwards(normal * normal.dot(base).signum())
        };
        let end = if target.finite {
            (-axis, -axis.dot(origin + base))
        } else {
            (DVec3::ZERO, 0.0)
        };
        Self {
            origin,
            target,
            planes: [side(0), side(1), side(2), side(3), inwards(axis), end],
        }
    }

    /// Whether some of a box may lie within.
    pub(super) fn meets(&self, bounds: &Box3) -> bool {
        self.planes.iter().all(|&(normal, offset)| {
            normal.dot(bounds.centre) + normal.abs().dot(bounds.half) >= offset
        })
    }

    /// What a triangle with this normal (any length) hides of the light; `None` if nothing.
    pub(super) fn shade(&self, corners: &[DVec3; 3], normal: DVec3) -> Option<Shade> {
        let [a, b, c] = corners.map(|corner| corner - self.origin);
        let distance = normal.dot(a);
        // The side of the triangle that the receiver sees decides the sign of everything.
        let side = distance.signum();
        let affine = |normal: DVec3| Affine::new(side * normal, &self.target);
        let mut behind = affine(normal);
        if self.target.finite {
            behind.value -= side * distance;
        }
        // Two triangles share an edge with opposite signs: no ray slips between them.
        let bounds = [
            affine(b.cross(c)),
            affine(c.cross(a)),
            affine(a.cross(b)),
            behind,
        ];
        if distance == 0.0 || bounds.iter().any(|bound| bound.largest() < 0.0) {
            return None;
        }
        let complete = bounds.iter().all(|bound| bound.smallest() >= 0.0);
        Some(Shade { bounds, complete })
    }
}
