//! The little of glTF's materials that shadows need.

use gltf::material::AlphaMode;
use gltf::texture::{MagFilter, MinFilter, Sampler, WrappingMode};
use wgpu::{AddressMode, FilterMode};

use super::Material;
use super::gltf_mesh::Loader;

impl Loader<'_> {
    /// The material's index in the scene; loads it where nothing has used it yet.
    pub(super) fn material(&mut self, material: &gltf::Material<'_>) -> Result<usize, String> {
        let Some(index) = material.index() else {
            return Ok(self.loaded.len());
        };
        if std::mem::replace(&mut self.loaded[index], true) {
            return Ok(index);
        }
        let name = material.name().unwrap_or("unnamed").to_owned();
        let mask = match material.alpha_mode() {
            AlphaMode::Opaque | AlphaMode::Blend => None,
            AlphaMode::Mask => Some(material.alpha_cutoff().unwrap_or(0.5)),
        };
        let surface = material.pbr_metallic_roughness();
        let mut texture = None;
        let mut wrap = [AddressMode::Repeat; 2];
        let mut filter = FilterMode::Linear;
        if let Some(info) = surface.base_color_texture() {
            let sampler = info.texture().sampler();
            wrap = [sampler.wrap_s(), sampler.wrap_t()].map(|mode| match mode {
                WrappingMode::ClampToEdge => AddressMode::ClampToEdge,
                WrappingMode::MirroredRepeat => AddressMode::MirrorRepeat,
                WrappingMode::Repeat => AddressMode::Repeat,
            });
            filter = between_texels(&sampler);
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
            filter,
            mask,
            blend: material.alpha_mode() == AlphaMode::Blend,
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

/// What lies between texels of a large image. Where a file leaves that open, it is as with a small one.
fn between_texels(sampler: &Sampler<'_>) -> FilterMode {
    let nearest = match (sampler.mag_filter(), sampler.min_filter()) {
        (Some(large), _) => large == MagFilter::Nearest,
        (None, small) => matches!(
            small,
            Some(
                MinFilter::Nearest
                    | MinFilter::NearestMipmapNearest
                    | MinFilter::NearestMipmapLinear
            )
        ),
    };
    if nearest {
        FilterMode::Nearest
    } else {
        FilterMode::Linear
    }
}
