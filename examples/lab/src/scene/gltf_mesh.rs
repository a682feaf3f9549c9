//! glTF primitives as meshes in world space.

use std::collections::HashMap;

use glam::{DMat3, DMat4, DVec3, Vec2};
use gltf::accessor::{Dimensions, Item};
use gltf::mesh::{Mode, Semantic};

use super::gltf_source::{Source, check};
use super::{Bounds, Material, Mesh, Scene};

/// Products of two lengths in a scene, its ground plane among them, fit in single precision.
const LARGEST_COORDINATE: f32 = 1e15;

/// A vertex in a [`Mesh`] and its place in double precision.
const VERTEX_BYTES: usize = 64;

/// A scene that is being loaded.
pub(super) struct Loader<'a> {
    pub(super) source: Source<'a>,
    /// Where the vertices of each of the scene's meshes lie.
    placed: Vec<Vec<DVec3>>,
    /// Whether the file's materials are loaded: those that nothing uses may be broken.
    pub(super) loaded: Vec<bool>,
    /// The file's images that are loaded, as indices in the scene.
    pub(super) images: HashMap<usize, Result<usize, String>>,
    pub(super) scene: Scene,
}

impl<'a> Loader<'a> {
    pub(super) fn new(source: Source<'a>, document: &gltf::Document, name: &str) -> Self {
        let count = document.materials().len();
        let default = Material::plain("default", [0.8, 0.8, 0.8]);
        Self {
            source,
            placed: Vec::new(),
            loaded: vec![false; count],
            images: HashMap::new(),
            scene: Scene {
                name: name.to_owned(),
                // The file's in their order, then the default one.
                materials: vec![default; count + 1],
                in_box: true,
                ..Scene::default()
            },
        }
    }

    /// Adds a warning once. After many, one says that there are more.
    pub(super) fn warn(&mut self, warning: String) {
        const MOST: usize = 100;
        let warnings = &mut self.scene.warnings;
        let warning = match warnings.len() {
            0..MOST => warning,
            _ => "further warnings are left out".to_owned(),
        };
        if !warnings.contains(&warning) {
            warnings.push(warning);
        }
    }

    /// The scene with the middle of its lowest points at zero. Only then are places rounded to single precision, which far
    /// from zero is coarse.
    pub(super) fn finish(mut self) -> Scene {
        let meshes = self.scene.meshes.iter().zip(&self.placed);
        let corners = meshes.flat_map(|(mesh, placed)| {
            let corners = mesh.indices.iter();
            corners.map(|&corner| placed[corner as usize])
        });
        let bounds = Bounds::of(corners);
        let origin = bounds.centre().with_y(bounds.min.y);
        for (mesh, placed) in self.scene.meshes.iter_mut().zip(self.placed) {
            let moved = placed.into_iter().map(|place| (place - origin).as_vec3());
            mesh.positions = moved.map(|place| place.to_array()).collect();
        }
        self.scene.origin = origin;
        self.scene
    }

    /// Adds one primitive, placed by each of `worlds`, if it has triangles.
    pub(super) fn primitive(
        &mut self,
        primitive: &gltf::Primitive<'_>,
        worlds: &[DMat4],
        item: &str,
    ) -> Result<(), String> {
        self.source.take(1, size_of::<Mesh>())?;
        if primitive.morph_targets().next().is_some() {
            self.warn(format!("{item}: its morph targets are ignored"));
        }
        let mode = primitive.mode();
        if !matches!(
            mode,
            Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan
        ) {
            self.warn(format!("{item}: points and lines are ignored"));
            return Ok(());
        }
        let Some(local) = self.attribute::<3>(primitive, &Semantic::Positions)? else {
            self.warn(format!("{item}: it has no positions and is ignored"));
            return Ok(());
        };
        let vertices = local.len();
        let indices = self.source.indices(primitive)?;
        let indices = indices.unwrap_or_else(|| (0..vertices as u32).collect());
        if let Some(index) = indices.iter().find(|&&index| index as usize >= vertices) {
            return Err(format!(
                "it has the index {index}, but only {vertices} vertices"
            ));
        }
        let normals = self.attribute::<3>(primitive, &Semantic::Normals)?;
        let material = self.material(&primitive.material())?;
        let uvs = self.uvs(primitive, item)?;
        let alphas = self.alphas(primitive, material)?;
        let mesh = Mesh {
            uvs: uvs.unwrap_or_else(|| vec![[0.0; 2]; vertices]),
            alphas: alphas.unwrap_or_default(),
            indices: triangles(mode, &indices),
            material,
            ..Mesh::default()
        };
        if mesh.uvs.len() != vertices
            || normals.as_ref().is_some_and(|all| all.len() != vertices)
            || !(mesh.alphas.is_empty() || mesh.alphas.len() == vertices)
        {
            return Err(format!(
                "it has {vertices} positions, but another number of normals, texture coordinates or colours"
            ));
        }
        if mesh.indices.is_empty() {
            return Ok(());
        }
        for world in worlds {
            self.place(&mesh, &local, normals.as_deref(), world)?;
        }
        Ok(())
    }

    /// Adds a mesh whose vertices and their normals, if there are any, are `world`'s images of those given.
    fn place(
        &mut self,
        mesh: &Mesh,
        local: &[[f32; 3]],
        normals: Option<&[[f32; 3]]>,
        world: &DMat4,
    ) -> Result<(), String> {
        self.source.take(1, size_of::<Mesh>())?;
        self.source.take(mesh.indices.len(), size_of::<u32>())?;
        self.source.take(local.len(), VERTEX_BYTES)?;
        let place = |&local: &[f32; 3]| world.transform_point3(to_f64(local));
        let placed: Vec<DVec3> = local.iter().map(place).collect();
        let rounded: Vec<_> = placed.iter().map(|at| at.as_vec3().to_array()).collect();
        check("placed POSITION", &rounded, LARGEST_COORDINATE)?;
        // A node that is flat along an axis leaves normals without a direction.
        let to_world = DMat3::from_mat4(*world).inverse().transpose();
        let (mesh, placed) = match normals.filter(|_| to_world.is_finite()) {
            Some(normals) => {
                let turn = |&normal: &[f32; 3]| unit(to_world * to_f64(normal));
                let normals = normals.iter().map(turn).collect();
                let mesh = mesh.clone();
                (Mesh { normals, ..mesh }, placed)
            }
            None => {
                self.source.take(mesh.indices.len(), VERTEX_BYTES)?;
                flat(mesh, &placed)
            }
        };
        self.scene.meshes.push(mesh);
        self.placed.push(placed);
        Ok(())
    }

    /// An attribute of a primitive, if it has it.
    fn attribute<const N: usize>(
        &mut self,
        primitive: &gltf::Primitive<'_>,
        semantic: &Semantic,
    ) -> Result<Option<Vec<[f32; N]>>, String>
    where
        [i8; N]: Item,
        [u8; N]: Item,
        [i16; N]: Item,
        [u16; N]: Item,
        [f32; N]: Item,
    {
        let accessor = primitive.get(semantic);
        let mut read = |accessor| self.source.floats(&accessor, &semantic.to_string());
        accessor.map(&mut read).transpose()
    }

    /// What the vertices' colours make of a mask or of blending.
    fn alphas(
        &mut self,
        primitive: &gltf::Primitive<'_>,
        material: usize,
    ) -> Result<Option<Vec<f32>>, String> {
        let semantic = Semantic::Colors(0);
        let colours = primitive.get(&semantic);
        let has_alpha = colours.is_some_and(|it| it.dimensions() == Dimensions::Vec4);
        let Material { mask, blend, .. } = &self.scene.materials[material];
        if (mask.is_none() && !blend) || !has_alpha {
            return Ok(None);
        }
        let colours = self.attribute::<4>(primitive, &semantic)?;
        Ok(colours.map(|colours| colours.iter().map(|colour| colour[3]).collect()))
    }

    /// Where the base colour's texture lies on the primitive.
    fn uvs(
        &mut self,
        primitive: &gltf::Primitive<'_>,
        item: &str,
    ) -> Result<Option<Vec<[f32; 2]>>, String> {
        let material = primitive.material();
        let info = material.pbr_metallic_roughness().base_color_texture();
        let transform = info.as_ref().and_then(|info| info.texture_transform());
        let set = transform.as_ref().and_then(|change| change.tex_coord());
        let set = set.or(info.as_ref().map(|info| info.tex_coord()));
        let semantic = Semantic::TexCoords(set.unwrap_or(0));
        let mut uvs = self.attribute::<2>(primitive, &semantic)?;
        if uvs.is_none() && info.is_some() {
            self.warn(format!("{item}: its texture has no coordinates"));
        }
        if let (Some(uvs), Some(transform)) = (&mut uvs, transform) {
            let [scale, offset] = [transform.scale(), transform.offset()].map(Vec2::from_array);
            // Counterclockwise in the image, whose v points down.
            let turn = Vec2::from_angle(-transform.rotation());
            for uv in &mut *uvs {
                *uv = (turn.rotate(scale * Vec2::from_array(*uv)) + offset).to_array();
            }
            check("transformed texture coordinate", uvs, f32::MAX)?;
        }
        Ok(uvs)
    }
}

fn to_f64([x, y, z]: [f32; 3]) -> DVec3 {
    DVec3::new(f64::from(x), f64::from(y), f64::from(z))
}

fn unit(direction: DVec3) -> [f32; 3] {
    direction.normalize_or_zero().as_vec3().to_array()
}

/// The indices of a triangle list, strip or fan as those of a list. An incomplete last triangle is dropped.
fn triangles(mode: Mode, indices: &[u32]) -> Vec<u32> {
    let last = 2..indices.len();
    let corners: Vec<[usize; 3]> = match mode {
        // Every second triangle of a strip turns the other way.
        Mode::TriangleStrip => last
            .map(|at| [at - 2 + at % 2, at - 1 - at % 2, at])
            .collect(),
        Mode::TriangleFan => last.map(|at| [0, at - 1, at]).collect(),
        _ => last.step_by(3).map(|at| [at - 2, at - 1, at]).collect(),
    };
    corners
        .as_flattened()
        .iter()
        .map(|&at| indices[at])
        .collect()
}

/// A mesh whose triangles share no vertices, with the triangles' own normals: what glTF asks for where it gives none. Also
/// where its vertices lie.
fn flat(shared: &Mesh, placed: &[DVec3]) -> (Mesh, Vec<DVec3>) {
    let corners = |at: &[u32; 3]| at.map(|corner| placed[corner as usize]);
    let of_triangle = |at: &[u32; 3]| {
        let [p, q, r] = corners(at);
        [unit((q - p).cross(r - p)); 3]
    };
    let indices = shared.indices.as_chunks::<3>().0;
    let vertices = || shared.indices.iter().map(|&corner| corner as usize);
    let mesh = Mesh {
        normals: indices.iter().flat_map(of_triangle).collect(),
        uvs: vertices().map(|vertex| shared.uvs[vertex]).collect(),
        alphas: vertices()
            .filter_map(|vertex| shared.alphas.get(vertex).copied())
            .collect(),
        indices: (0..shared.indices.len() as u32).collect(),
        material: shared.material,
        ..Mesh::default()
    };
    (mesh, indices.iter().flat_map(corners).collect())
}
