//! A host that draws translucent casters all over a map.

use moment_shadows::{MapEncoding, Opacity, Source, Technique, link};
use moment_shadows_graph::TextureDesc;
use moment_shadows_graph::record::{HostPass, blend_state};

use super::casters::{Caster, Texture};
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
        let storage = format!("const STORAGE = {}u;", encoding.storage().wgsl_index());
        let mut text = include_str!("fragment.wgsl").to_owned();
        if opacity == Opacity::SecondSource {
            // Behind the imports.
            text = text.replacen("\n\n", "\n\nenable dual_source_blending;\n\n", 1);
            text += include_str!("second_source.wgsl");
        }
        let source = Source {
            name: "fragment.wgsl",
            text: &text,
        };
        let storage = Source {
            name: "storage",
            text: &storage,
        };
        let linked = link(source, &[storage])
            .map_err(|error| LabError::unsuitable("fragment.wgsl", error))?;
        let module = gpu
            .device
            .create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some("casters"),
                source: wgpu::ShaderSource::Wgsl(linked.wgsl().into()),
            });
        let format = TextureDesc::new(encoding.format(), [1; 2]);
        let states = encoding.blend_states(opacity)?;
        let names = entry_points(encoding.technique(), opacity);
        let pipelines = states.iter().zip(names).map(|(state, entry_point)| {
            let target = wgpu::ColorTargetState {
                format: format.wgpu_format(),
                blend: Some(blend_state(state)),
                write_mask: wgpu::ColorWrites::ALL,
            };
            gpu.device
                .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                    label: Some(entry_point),
                    layout: None,
                    vertex: wgpu::VertexState {
                        module: &module,
                        entry_point: Some("cover"),
                        compilation_options: Default::default(),
                        buffers: &[],
                    },
                    primitive: Default::default(),
                    depth_stencil: None,
                    multisample: Default::default(),
                    fragment: Some(wgpu::FragmentState {
                        module: &module,
                        entry_point: Some(entry_point),
                        compilation_options: Default::default(),
                        targets: &vec![Some(target); encoding.planes() as usize],
                    }),
                    multiview_mask: None,
                    cache: None,
                })
        });
        let pipelines: Vec<_> = pipelines.collect();
        let draws = casters.iter().map(|caster| {
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
            let buffer = gpu.filled("caster", words, wgpu::BufferUsages::UNIFORM);
            let groups = pipelines.iter().map(|pipeline| {
                let layout = pipeline.get_bind_group_layout(0);
                gpu.bind(&layout, [buffer.as_entire_binding()])
            });
            (groups.collect(), f64::from(caster.opacity))
        });
        Ok(Self {
            draws: draws.collect(),
            pipelines,
        })
    }

    /// Draws them to the targets of a host's pass.
    pub(super) fn draw(&self, pass: &HostPass<'_>, encoder: &mut wgpu::CommandEncoder) {
        let targets: Vec<_> = pass.targets.iter().map(attachment).collect();
        let mut drawn = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(pass.name),
            color_attachments: &targets,
            ..Default::default()
        });
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

fn attachment(view: &wgpu::TextureView) -> Option<wgpu::RenderPassColorAttachment<'_>> {
    Some(wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations {
            load: wgpu::LoadOp::Load,
            store: wgpu::StoreOp::Store,
        },
    })
}
