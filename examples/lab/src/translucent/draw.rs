//! A host that draws translucent casters all over a map.

use moment_shadows::{MapEncoding, Opacity, Source, Technique, link};
use moment_shadows_graph::TextureDesc;
use moment_shadows_graph::record::blend_state;

use super::casters::{Caster, Texture};
use super::host_pass::{begin_on, blending};
use crate::error::LabError;
use crate::gpu::Gpu;

/// The fragment entry points for the draws of a caster.
fn entry_points(technique: &Technique, opacity: Opacity) -> &'static [&'static str] {
    match (technique, opacity) {
        (Technique::Vsm, _) => &["two_moments"],
        (Technique::Hamburger6, _) => &["six_moments"],
        (_, Opacity::TwoDraws) => &["four_moments_product", "four_moments_sum"],
        (_, Opacity::SecondSource) => &["four_moments_and_opacity"],
        _ => &["four_moments"],
    }
}

/// The shader of casters that a text describes, linked for a map.
pub(super) fn shader(
    encoding: &MapEncoding,
    opacity: Opacity,
    casters: &str,
) -> Result<String, LabError> {
    let storage = format!("const STORAGE = {}u;", encoding.storage().wgsl_index());
    let mut text = include_str!("fragment.wgsl").to_owned();
    if opacity == Opacity::SecondSource {
        // Behind the imports.
        text = text.replacen("\n\n", "\n\nenable dual_source_blending;\n\n", 1);
        text += include_str!("second_source.wgsl");
    }
    text += casters;
    let source = Source {
        name: "fragment.wgsl",
        text: &text,
    };
    let storage = Source {
        name: "storage",
        text: &storage,
    };
    let linked = link(source, &[storage]);
    let linked = linked.map_err(|error| LabError::unsuitable("fragment.wgsl", error))?;
    Ok(linked.into_wgsl())
}

/// The pipelines for the draws of a caster, whose vertices an entry point of its text places.
pub(super) fn pipelines(
    gpu: &Gpu,
    encoding: &MapEncoding,
    opacity: Opacity,
    (casters, vertex): (&str, &str),
    buffers: &[Option<wgpu::VertexBufferLayout<'_>>],
) -> Result<Vec<wgpu::RenderPipeline>, LabError> {
    let wgsl = shader(encoding, opacity, casters)?;
    let module = gpu
        .device
        .create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("casters"),
            source: wgpu::ShaderSource::Wgsl(wgsl.into()),
        });
    let format = TextureDesc::new(encoding.format(), [1; 2]).wgpu_format();
    let states = encoding.blend_states(opacity)?;
    let names = entry_points(encoding.technique(), opacity);
    let planes = encoding.planes() as usize;
    let of_draw = |(state, fragment): (_, &&str)| {
        let target = (format, blend_state(state), planes);
        blending(gpu, &module, [vertex, fragment], buffers, target)
    };
    Ok(states.iter().zip(names).map(of_draw).collect())
}

/// Casters all over a map: their text.
pub(super) const LAYERS: &str = include_str!("layers.wgsl");

/// Pipelines and uniform data of casters, drawn in this order.
pub(super) struct Casters {
    pipelines: Vec<wgpu::RenderPipeline>,
    /// A bind group for each pipeline, and the blend constant.
    draws: Vec<(Vec<wgpu::BindGroup>, f64)>,
}

impl Casters {
    pub(super) fn new(
        gpu: &Gpu,
        encoding: &MapEncoding,
        opacity: Opacity,
        casters: &[Caster],
    ) -> Result<Self, LabError> {
        let pipelines = pipelines(gpu, encoding, opacity, (LAYERS, "cover"), &[])?;
        let draws = casters.iter().map(|caster| {
            let uniform = uniform(gpu, caster);
            let groups = pipelines.iter().map(|pipeline| {
                let layout = pipeline.get_bind_group_layout(0);
                gpu.bind(&layout, [uniform.as_entire_binding()])
            });
            (groups.collect(), f64::from(caster.opacity))
        });
        Ok(Self {
            draws: draws.collect(),
            pipelines,
        })
    }

    /// Draws them to all planes of a layer.
    pub(super) fn draw(&self, targets: &[wgpu::TextureView], encoder: &mut wgpu::CommandEncoder) {
        let mut drawn = begin_on(targets, "casters", encoder);
        for (groups, opacity) in &self.draws {
            let [r, g, b, a] = [*opacity; 4];
            drawn.set_blend_constant(wgpu::Color { r, g, b, a });
            for (pipeline, group) in self.pipelines.iter().zip(groups) {
                drawn.set_pipeline(pipeline);
                drawn.set_bind_group(0, group, &[]);
                drawn.draw(0..3, 0..1);
            }
        }
    }
}

/// The uniform struct of a caster.
pub(super) fn uniform(gpu: &Gpu, caster: &Caster) -> wgpu::Buffer {
    let (centre, inverse) = caster.shape();
    let shape = [centre, inverse].concat();
    let mut words: Vec<u32> = shape.iter().map(|value| value.to_bits()).collect();
    words.extend([
        (2.0 * caster.depth - 1.0).to_bits(),
        caster.opacity.to_bits(),
        u32::from(caster.texture == Texture::Hashed),
        0,
    ]);
    let words = bytemuck::cast_slice(&words);
    gpu.filled("caster", words, wgpu::BufferUsages::UNIFORM)
}
