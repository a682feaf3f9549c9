//! Depth peeling in light space: every surface that the light's rays meet, layer by layer, in f64 on the processor.
//!
//! A ray goes through the centre of each texel of the light's map and begins at the light's near plane. It meets all
//! triangles, from either side and however far away, except where a masked material has a hole. Surfaces that a peel in
//! single-precision depth could not tell apart, closer than 2^-24 of the light's range, count once.

pub(super) mod triangle;

use std::ops::Range;

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use triangle::{Hit, Projection, Triangle};

use super::check_map;
use super::opacity::{AlphaCorners, Opacity};
use crate::error::LabError;
use crate::light::LightView;
use crate::scene::{Mesh, Scene};

/// Distances closer than this, relative to the light's range, are those of one surface.
const SAME_SURFACE: f64 = 1.0 / (1 << 24) as f64;

/// A surface where a ray meets it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSurface {
    /// Column and row of the ray's texel.
    pub texel: [u32; 2],
    /// How many surfaces lie in front of it on the ray.
    pub layer: u32,
    /// Where, in world space.
    pub position: DVec3,
    /// The unit normal of the triangle, on either side.
    pub normal: DVec3,
    /// Distance along the light's axis.
    pub distance: f64,
    /// Gradient of distance along the axis per texel of the map; infinite edge-on.
    pub distance_gradient: DVec2,
    /// Whether it shows the light its front (the triangle's vertices run counter-clockwise as seen from there), or is of
    /// a material that has two.
    pub faces_light: bool,
    /// Whether it belongs to the ground, which lights are not fitted to.
    pub ground: bool,
    /// The share of light that it keeps: 1 but where a material is blended.
    pub opacity: f64,
    /// How many surfaces of blended materials count as this one; 0 for an opaque one.
    pub blended: u32,
}

impl LightSurface {
    /// Another surface is at the same place.
    fn merge(&mut self, opacity: Option<f64>) {
        match opacity {
            Some(opacity) if self.blended > 0 => {
                self.opacity = 1.0 - (1.0 - self.opacity) * (1.0 - opacity);
                self.blended += 1;
            }
            Some(_) => {}
            None => (self.opacity, self.blended) = (1.0, 0),
        }
    }

    /// Length of the gradient of distance along the axis per texel of the map; infinite edge-on.
    #[must_use]
    pub fn distance_per_texel(&self) -> f64 {
        self.distance_gradient.length()
    }
}

/// A scene made ready to be peeled.
pub struct Peeler<'a> {
    scene: &'a Scene,
    projection: Projection<'a>,
    triangles: Vec<SceneTriangle>,
    /// Opacity of each material.
    opacity: Vec<Option<Opacity>>,
}

struct SceneTriangle {
    mesh: u32,
    corners: [u32; 3],
    seen: Triangle,
}

/// A hit on a ray of one row.
struct RowHit {
    column: u32,
    triangle: u32,
    hit: Hit,
}

impl<'a> Peeler<'a> {
    /// Projects all triangles of the scene into a map of `map` texels.
    pub fn new(scene: &'a Scene, light: &'a LightView, map: [u32; 2]) -> Result<Self, LabError> {
        check_map(map)?;
        let projection = Projection { light, map };
        let mut triangles = Vec::new();
        for (index, mesh) in scene.meshes.iter().enumerate() {
            check(scene, index, mesh)?;
            for &corners in mesh.indices.as_chunks::<3>().0 {
                let seen = Triangle::new(&projection, corners.map(|corner| position(mesh, corner)));
                triangles.extend(seen.map(|seen| SceneTriangle {
                    mesh: index as u32,
                    corners,
                    seen,
                }));
            }
        }
        Ok(Self {
            scene,
            projection,
            triangles,
            opacity: scene
                .materials
                .iter()
                .map(|material| Opacity::of(material, &scene.images))
                .collect(),
        })
    }

    /// The surfaces on the rays of some rows of the map: row by row, column by column, from the light on.
    pub fn rows(&self, rows: Range<u32>) -> Vec<LightSurface> {
        let rows = rows.start..rows.end.min(self.projection.map[1]);
        let mut of_row: Vec<Vec<u32>> = vec![Vec::new(); rows.len()];
        for (index, triangle) in self.triangles.iter().enumerate() {
            let [first, end] = triangle.seen.rows;
            for row in first.max(rows.start)..end.min(rows.end) {
                of_row[(row - rows.start) as usize].push(index as u32);
            }
        }
        let surfaces: Vec<Vec<LightSurface>> = of_row
            .par_iter()
            .zip(rows)
            .map(|(triangles, row)| self.row(row, triangles))
            .collect();
        surfaces.concat()
    }

    fn row(&self, row: u32, triangles: &[u32]) -> Vec<LightSurface> {
        let mut hits = Vec::new();
        for &index in triangles {
            let triangle = &self.triangles[index as usize];
            let [first, end] = triangle.seen.columns;
            for column in first..end {
                let place = centre([column, row]);
                let hit = triangle.seen.hit(place).filter(|hit| {
                    hit.distance >= self.projection.near() && !self.is_hole(triangle, hit)
                });
                hits.extend(hit.map(|hit| RowHit {
                    column,
                    triangle: index,
                    hit,
                }));
            }
        }
        hits.sort_unstable_by(|a, b| {
            let by_distance = a.hit.distance.total_cmp(&b.hit.distance);
            let by_place = a.column.cmp(&b.column).then(by_distance);
            by_place.then(a.triangle.cmp(&b.triangle))
        });
        let [near, far] = self.projection.light.range;
        let same = SAME_SURFACE * (far - near);
        let mut surfaces: Vec<LightSurface> = Vec::with_capacity(hits.len());
        for RowHit {
            column,
            triangle,
            hit,
        } in hits
        {
            let texel = [column, row];
            let triangle = &self.triangles[triangle as usize];
            let opacity = self.blended(triangle, &hit);
            let front = surfaces.last_mut().filter(|front| front.texel == texel);
            let layer = match front {
                Some(front) if hit.distance - front.distance <= same => {
                    front.merge(opacity);
                    continue;
                }
                Some(front) => front.layer + 1,
                None => 0,
            };
            let mut surface = self.surface(texel, layer, triangle, &hit);
            surface.opacity = opacity.unwrap_or(1.0);
            surface.blended = opacity.is_some().into();
            surfaces.push(surface);
        }
        surfaces
    }

    fn surface(
        &self,
        texel: [u32; 2],
        layer: u32,
        triangle: &SceneTriangle,
        hit: &Hit,
    ) -> LightSurface {
        let mesh = &self.scene.meshes[triangle.mesh as usize];
        let [a, b, c] = triangle.corners.map(|corner| position(mesh, corner));
        let gradient = triangle.seen.distance_gradient(centre(texel));
        let position = a * hit.weights.x + b * hit.weights.y + c * hit.weights.z;
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let material = self.scene.materials.get(mesh.material);
        let front = normal.dot(self.projection.light.towards_light(position)) > 0.0;
        LightSurface {
            texel,
            layer,
            position,
            normal,
            distance: hit.distance,
            distance_gradient: if gradient.length().is_finite() {
                gradient
            } else {
                DVec2::new(f64::INFINITY, 0.0)
            },
            faces_light: front || material.is_some_and(|material| material.double_sided),
            ground: mesh.ground,
            opacity: 1.0,
            blended: 0,
        }
    }

    fn is_hole(&self, triangle: &SceneTriangle, hit: &Hit) -> bool {
        self.opacity(triangle)
            .is_some_and(|(opacity, corners)| opacity.is_hole(&corners, hit.weights))
    }

    /// The opacity of a blended material.
    fn blended(&self, triangle: &SceneTriangle, hit: &Hit) -> Option<f64> {
        let (opacity, corners) = self.opacity(triangle)?;
        opacity.blended(&corners, hit.weights)
    }

    /// What a material that is not opaque says of a triangle.
    fn opacity(&self, triangle: &SceneTriangle) -> Option<(&Opacity, AlphaCorners)> {
        let mesh = &self.scene.meshes[triangle.mesh as usize];
        let opacity = self.opacity.get(mesh.material)?.as_ref()?;
        Some((opacity, AlphaCorners::of(mesh, triangle.corners)))
    }
}

/// The place of a texel's centre, in texels.
fn centre(texel: [u32; 2]) -> DVec2 {
    DVec2::from_array(texel.map(f64::from)) + 0.5
}

pub(super) fn position(mesh: &Mesh, corner: u32) -> DVec3 {
    DVec3::from_array(mesh.positions[corner as usize].map(f64::from))
}

/// Refuses a mesh whose triangles lack vertices, or have one at a non-finite place.
pub(super) fn check(scene: &Scene, index: usize, mesh: &Mesh) -> Result<(), LabError> {
    let refuse = |reason: String| {
        Err(LabError::refused(format!(
            "mesh {index} of scene '{}' {reason}; load the scene from a valid file",
            scene.name
        )))
    };
    let vertices = mesh.positions.len().min(mesh.uvs.len());
    if let Some(corner) = mesh
        .indices
        .iter()
        .find(|&&corner| corner as usize >= vertices)
    {
        return refuse(format!("has a triangle with vertex {corner} of {vertices}"));
    }
    let finite = |position: &[f32; 3]| position.iter().all(|coordinate| coordinate.is_finite());
    if let Some(vertex) = mesh.positions.iter().position(|position| !finite(position)) {
        return refuse(format!("has vertex {vertex} at no finite place"));
    }
    Ok(())
}
