//! glTF primitives as meshes in world space, with what they need of their materials.

use std::collections::HashMap;

use glam::{DMat3, DMat4, DVec3, Vec2};
use gltf::accessor::Dimensions;
use gltf::material::AlphaMode;
use gltf::mesh::{Mode, Semantic};
use gltf::texture::{MagFilter, WrappingMode};
use wgpu::AddressMode;

use super::gltf_source::{Source, check};
use super::{Material, Mesh, Scene};

/// Products of two lengths in a scene, its ground plane among them, fit in single precision.
const LARGEST_COORDINATE: f32 = 1e15;

/// A vertex and its index in a [`Mesh`].
const VERTEX_BYTES: usize = 36;

/// A scene that is being loaded.
pub(super) struct Loader<'a> {
    source: Source<'a>,
    /// Whether the file's materials are loaded: those that nothing uses may be broken.
    loaded: Vec<bool>,
    /// The file's images that are loaded, as indices in the scene.
    images: HashMap<usize, Result<usize, String>>,
    pub(super) scene: Scene,
}

impl<'a> Loader<'a> {
    pub(super) fn new(source: Source<'a>, document: &gltf::Document, name: &str) -> Self {
        let count = document.materials().len();
        let default = Material::plain("default", [0.8, 0.8, 0.8]);
        Self {
            source,
            loaded: vec![false; count],
            images: HashMap::new(),
            scene: Scene {
                name: name.to_owned(),
                // The file's in their order, then the default one.
                materials: vec![default; count + 1],
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

    /// Adds one primitive, placed by `world`, if it has triangles.
    pub(super) fn primitive(
        &mut self,
        primitive: &gltf::Primitive<'_>,
        world: &DMat4,
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
        let Some(local) = self
            .source
            .attribute::<3>(primitive, &Semantic::Positions)?
        else {
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
        let normals = self.source.attribute::<3>(primitive, &Semantic::Normals)?;
        let material = self.material(&primitive.material())?;
        let uvs = self.uvs(primitive, item)?;
        let uvs = uvs.unwrap_or_else(|| vec![[0.0; 2]; vertices]);
        if uvs.len() != vertices || normals.as_ref().is_some_and(|all| all.len() != vertices) {
            return Err(format!(
                "it has {vertices} positions, but another number of normals or texture coordinates"
            ));
        }
        let color = primitive.get(&Semantic::Colors(0));
        if self.scene.materials[material].mask.is_some()
            && color.is_some_and(|color| color.dimensions() == Dimensions::Vec4)
        {
            self.warn(format!(
                "{item}: the alpha of its vertices (COLOR_0) is ignored"
            ));
        }
        let place = |&position: &[f32; 3]| world.transform_point3(to_f64(position)).as_vec3();
        let positions: Vec<_> = local.iter().map(|local| place(local).to_array()).collect();
        check("placed POSITION", &positions, LARGEST_COORDINATE)?;
        // A node that is flat along an axis leaves normals without a direction.
        let to_world = DMat3::from_mat4(*world).inverse().transpose();
        let normals = normals.filter(|_| to_world.is_finite());
        let indices = triangles(mode, &indices);
        let mesh = match normals {
            Some(normals) => Mesh {
                positions,
                normals: normals
                    .iter()
                    .map(|&normal| unit(to_world * to_f64(normal)))
                    .collect(),
                uvs,
                indices,
                material,
                ground: false,
            },
            None => {
                self.source.take(indices.len(), VERTEX_BYTES)?;
                flat(&positions, &uvs, &indices, material)
            }
        };
        if !mesh.indices.is_empty() {
            self.scene.meshes.push(mesh);
        }
        Ok(())
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
        let mut uvs = self.source.attribute::<2>(primitive, &semantic)?;
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

    /// The material's index in the scene; loads it where nothing has used it yet.
    fn material(&mut self, material: &gltf::Material<'_>) -> Result<usize, String> {
        let Some(index) = material.index() else {
            return Ok(self.loaded.len());
        };
        if std::mem::replace(&mut self.loaded[index], true) {
            return Ok(index);
        }
        let name = material.name().unwrap_or("unnamed").to_owned();
        let mask = match material.alpha_mode() {
            AlphaMode::Opaque => None,
            AlphaMode::Mask => Some(material.alpha_cutoff().unwrap_or(0.5)),
            AlphaMode::Blend => {
                self.warn(format!(
                    "material '{name}': blending is ignored, it is opaque"
                ));
                None
            }
        };
        let surface = material.pbr_metallic_roughness();
        let mut texture = None;
        let mut wrap = [AddressMode::Repeat; 2];
        if let Some(info) = surface.base_color_texture() {
            let sampler = info.texture().sampler();
            wrap = [sampler.wrap_s(), sampler.wrap_t()].map(|mode| match mode {
                WrappingMode::ClampToEdge => AddressMode::ClampToEdge,
                WrappingMode::MirroredRepeat => AddressMode::MirrorRepeat,
                WrappingMode::Repeat => AddressMode::Repeat,
            });
            if mask.is_some() && sampler.mag_filter() == Some(MagFilter::Nearest) {
                self.warn(format!(
                    "material '{name}': its mask is filtered linearly, not by the nearest texel"
                ));
            }
            let image = info.texture().source().map(|image| self.image(&image));
            let image =
                image.unwrap_or_else(|| Err("there is no image that can be read".to_owned()));
            match image {
                Ok(image) => texture = Some(image),
                Err(reason) if mask.is_some() && info.texture().source().is_some() => {
                    return Err(format!("material '{name}': {reason}"));
                }
                Err(reason) => self.warn(format!(
                    "material '{name}': its texture is left out: {reason}"
                )),
            }
        }
        self.scene.materials[index] = Material {
            name,
            base_colour: surface.base_color_factor(),
            texture,
            wrap,
            mask,
            double_sided: material.double_sided(),
        };
        Ok(index)
    }

    /// The image's index in the scene.
    fn image(&mut self, source: &gltf::Image<'_>) -> Result<usize, String> {
        if let Some(known) = self.images.get(&source.index()) {
            return known.clone();
        }
        let loaded = match self.source.image(source) {
            Ok(image) => {
                self.scene.images.push(image);
                Ok(self.scene.images.len() - 1)
            }
            Err(reason) => Err(format!("image {}: {reason}", source.index())),
        };
        self.images.insert(source.index(), loaded.clone());
        loaded
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

/// A mesh whose triangles share no vertices, with the triangles' own normals: what glTF asks for where it gives none.
fn flat(positions: &[[f32; 3]], uvs: &[[f32; 2]], indices: &[u32], material: usize) -> Mesh {
    let mut mesh = Mesh {
        material,
        ..Mesh::default()
    };
    for corners in indices.chunks_exact(3) {
        let corners = [corners[0], corners[1], corners[2]].map(|corner| corner as usize);
        let [p, q, r] = corners.map(|corner| to_f64(positions[corner]));
        let normal = unit((q - p).cross(r - p));
        for corner in corners {
            mesh.indices.push(mesh.positions.len() as u32);
            mesh.positions.push(positions[corner]);
            mesh.normals.push(normal);
            mesh.uvs.push(uvs[corner]);
        }
    }
    mesh
}
