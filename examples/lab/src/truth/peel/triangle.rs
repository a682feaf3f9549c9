//! A triangle as the light sees it, sampled at places of the light's map in f64.

use glam::{DVec2, DVec3, DVec4};

use crate::light::{LightView, StoredDepth};

/// A light with the texels of its map.
pub(in crate::truth) struct Projection<'a> {
    pub(in crate::truth) light: &'a LightView,
    pub(in crate::truth) map: [u32; 2],
}

impl Projection<'_> {
    /// The place in the map in texels, times the third component: 1 for parallel rays, the distance along the axis for
    /// rays from a point.
    fn place(&self, world: DVec3) -> DVec3 {
        let clip: DVec4 = self.light.clip_from_world() * world.extend(1.0);
        let [width, height] = self.map.map(f64::from);
        DVec3::new(
            0.5 * width * (clip.w + clip.x),
            0.5 * height * (clip.w - clip.y),
            clip.w,
        )
    }

    /// The distance along the axis at which rays begin.
    pub(in crate::truth) fn near(&self) -> f64 {
        match self.light.depth {
            StoredDepth::Orthographic { near, .. } | StoredDepth::Perspective { near, .. } => near,
        }
    }
}

/// A triangle by its edges, in homogeneous coordinates of the map: no clipping is needed where it passes the light.
pub(in crate::truth) struct Triangle {
    /// Times a place (x, y, 1) these are the weights of the corners, up to a common factor.
    edges: [DVec3; 3],
    /// Distances of the corners along the light's axis.
    distances: DVec3,
    /// Columns and rows of the texels whose centres it may cover, the ends excluded.
    pub(in crate::truth) columns: [u32; 2],
    pub(in crate::truth) rows: [u32; 2],
}

/// Where a ray meets a triangle.
#[derive(Clone, Copy)]
pub(in crate::truth) struct Hit {
    /// The weights of the corners in world space; not negative, their sum is 1.
    pub(in crate::truth) weights: DVec3,
    /// Distance along the light's axis.
    pub(in crate::truth) distance: f64,
}

impl Triangle {
    /// The triangle with these corners in world space; `None` if it covers no texel of the map.
    pub(in crate::truth) fn new(projection: &Projection<'_>, corners: [DVec3; 3]) -> Option<Self> {
        let places = corners.map(|corner| projection.place(corner));
        let [a, b, c] = places;
        let distances = DVec3::from_array(corners.map(|corner| projection.light.distance(corner)));
        let [columns, rows] = covered(places, distances, projection)?;
        Some(Self {
            edges: [b.cross(c), c.cross(a), a.cross(b)],
            distances,
            columns,
            rows,
        })
    }

    /// Where the ray through `place`, in texels, meets the triangle. A ray through an edge between two triangles meets
    /// one of them: their edge functions differ in nothing but their sign, so that exactly one owns the edge.
    pub(in crate::truth) fn hit(&self, place: DVec2) -> Option<Hit> {
        let place = place.extend(1.0);
        let weights = self.edges.map(|edge| edge.dot(place));
        let sum = weights[0] + weights[1] + weights[2];
        let inside = self.edges.iter().zip(weights).all(|(edge, weight)| {
            let (inwards, weight) = (edge * sum.signum(), weight * sum.signum());
            let owned = inwards.x > 0.0 || (inwards.x == 0.0 && inwards.y > 0.0);
            weight > 0.0 || (weight == 0.0 && owned)
        });
        // Seen edge-on it has no weights.
        if !inside || sum == 0.0 {
            return None;
        }
        let weights = DVec3::from_array(weights) / sum;
        Some(Hit {
            weights,
            distance: weights.dot(self.distances),
        })
    }

    /// How the attribute with these values at the corners changes per texel at `place`.
    pub(in crate::truth) fn gradient(&self, place: DVec2, values: DVec3) -> DVec2 {
        let [a, b, c] = self.edges;
        let value = a * values.x + b * values.y + c * values.z;
        let weight = a + b + c;
        let place = place.extend(1.0);
        let [v, w] = [value.dot(place), weight.dot(place)];
        (value.truncate() * w - weight.truncate() * v) / (w * w)
    }

    /// How the distance along the axis changes per texel at `place`.
    pub(in crate::truth) fn distance_gradient(&self, place: DVec2) -> DVec2 {
        self.gradient(place, self.distances)
    }
}

/// Columns and rows that the part of a triangle behind the near plane may cover.
fn covered(
    places: [DVec3; 3],
    distances: DVec3,
    projection: &Projection<'_>,
) -> Option<[[u32; 2]; 2]> {
    let near = projection.near();
    let mut low = DVec2::INFINITY;
    let mut high = DVec2::NEG_INFINITY;
    let mut add = |place: DVec3| {
        let place = place.truncate() / place.z;
        low = low.min(place);
        high = high.max(place);
    };
    for i in 0..3 {
        let next = (i + 1) % 3;
        let [from, to] = [distances[i] - near, distances[next] - near];
        if from >= 0.0 {
            add(places[i]);
        }
        if (from < 0.0) != (to < 0.0) {
            add(places[i].lerp(places[next], from / (from - to)));
        }
    }
    // A texel more on each side than the rounding of the division needs.
    let range = |low: f64, high: f64, size: u32| {
        let first = (low - 1.5).clamp(0.0, f64::from(size)) as u32;
        let end = (high + 1.5).clamp(0.0, f64::from(size)) as u32;
        (first < end).then_some([first, end])
    };
    let [width, height] = projection.map;
    Some([range(low.x, high.x, width)?, range(low.y, high.y, height)?])
}
