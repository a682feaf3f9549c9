//! What passes are compared with: copies of textures to others of the same format and size.

use moment_shadows::TextureFormat;
use moment_shadows_graph::TextureDesc;

use super::protocol::Record;
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::pass::{Bound, Pass, Work};
use crate::texture::texture;

/// Pairs of textures of one format and size, and the shaders that copy one of a pair to the other.
pub struct Copies {
    pairs: Vec<[wgpu::Texture; 2]>,
    layers: Vec<Pass>,
}

/// How the shader copies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum CopyWork {
    /// A dispatch with a texel per invocation, in workgroups of 64 by 1.
    Compute,
    /// A triangle over the whole target: the baseline of passes that draw one, whose formats need not be storable.
    Fullscreen,
}

const WORKGROUP: u32 = 64;

impl Copies {
    /// Textures as described: all layers of the first mip level of each.
    pub fn new(gpu: &Gpu, descs: &[TextureDesc], work: CopyWork) -> Result<Self, LabError> {
        let mut copies = Self {
            pairs: Vec::new(),
            layers: Vec::new(),
        };
        for desc in descs {
            let scope = gpu.device.push_error_scope(wgpu::ErrorFilter::Validation);
            copies.add(gpu, desc, work);
            if let Some(error) = pollster::block_on(scope.pop()) {
                let reason =
                    format!("a copy was refused: {error}; measure a graph with another format");
                return Err(LabError::unsuitable(desc.format, reason));
            }
        }
        Ok(copies)
    }

    fn add(&mut self, gpu: &Gpu, desc: &TextureDesc, work: CopyWork) {
        let target = match work {
            CopyWork::Compute => wgpu::TextureUsages::STORAGE_BINDING,
            CopyWork::Fullscreen => wgpu::TextureUsages::RENDER_ATTACHMENT,
        };
        let pair = [
            wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_SRC,
            target | wgpu::TextureUsages::COPY_DST,
        ]
        .map(|usage| texture(gpu, "cost/copy", desc, usage));
        for layer in 0..desc.array_layers() {
            let [source, target] = pair.each_ref().map(|texture| {
                texture.create_view(&wgpu::TextureViewDescriptor {
                    dimension: Some(wgpu::TextureViewDimension::D2),
                    base_array_layer: layer,
                    array_layer_count: Some(1),
                    ..Default::default()
                })
            });
            let mut bound = vec![(0, Bound::Texture(source))];
            let [width, height] = desc.size;
            let does = match work {
                CopyWork::Compute => {
                    bound.push((1, Bound::Texture(target)));
                    Work::Dispatch([width.div_ceil(WORKGROUP), height])
                }
                CopyWork::Fullscreen => Work::Draw(target),
            };
            let wgsl = shader(work, desc.format);
            self.layers
                .push(Pass::new(gpu, "cost/copy", wgsl, &[], &bound, does));
        }
        self.pairs.push(pair);
    }

    /// The copy by a shader: the unit of all costs.
    pub fn by_shader(&self) -> Record<'_> {
        Box::new(|encoder| {
            self.layers.iter().for_each(|layer| layer.record(encoder));
            Ok(())
        })
    }

    /// The copy by the interface: on a graphics processor the fastest there is, on a software adapter a memcpy.
    pub fn by_interface(&self) -> Record<'_> {
        Box::new(|encoder| {
            for [from, to] in &self.pairs {
                let (from, to, size) = (from.as_image_copy(), to.as_image_copy(), to.size());
                encoder.copy_texture_to_texture(from, to, size);
            }
            Ok(())
        })
    }
}

fn shader(work: CopyWork, format: TextureFormat) -> String {
    let texel = if format.is_integer() { "u32" } else { "f32" };
    match work {
        CopyWork::Compute => format!(
            "@group(0) @binding(0) var copied: texture_2d<{texel}>;
@group(0) @binding(1) var copy_target: texture_storage_2d<{format}, write>;
@compute @workgroup_size({WORKGROUP}, 1)
fn copy(@builtin(global_invocation_id) id: vec3u) {{
    if all(id.xy < textureDimensions(copy_target)) {{
        textureStore(copy_target, id.xy, textureLoad(copied, id.xy, 0));
    }}
}}
"
        ),
        CopyWork::Fullscreen => "@group(0) @binding(0) var copied: texture_2d<f32>;
@vertex
fn fullscreen(@builtin(vertex_index) vertex: u32) -> @builtin(position) vec4f {
    return vec4f(vec2f(vec2u(vertex & 1u, vertex >> 1u)) * 4.0 - 1.0, 0.0, 1.0);
}
@fragment
fn copy(@builtin(position) position: vec4f) -> @location(0) vec4f {
    return textureLoad(copied, vec2i(position.xy), 0);
}
"
        .to_owned(),
    }
}

/// A texture of as many bytes that a shader can store to everywhere: the same one, unless its texels are too small.
pub(super) fn storable(desc: &TextureDesc) -> TextureDesc {
    match desc.format {
        TextureFormat::R8Unorm | TextureFormat::R16Float => {
            let row = desc.size[0] * desc.format.bytes_per_texel();
            TextureDesc {
                layers: desc.layers,
                ..TextureDesc::new(TextureFormat::R32Float, [row.div_ceil(4), desc.size[1]])
            }
        }
        _ => desc.clone(),
    }
}
