//! What blending casters takes, beside drawing as many opaque ones into a depth map.

use core::fmt;

use moment_shadows::{MapEncoding, Opacity, Storage, Technique};
use moment_shadows_graph::TextureDesc;
use serde::Serialize;

use super::casters::{Caster, Texture, stack};
use super::draw::{Casters, LAYERS, shader, uniform};
use super::stage::TranslucentStage;
use crate::cost::clock::{Clock, ClockKind};
use crate::cost::protocol::{FEWEST_ROUNDS, Rounds, Subject};
use crate::cost::statistics::Distribution;
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::texture::texture;

/// Samples per texel of depth maps.
const SAMPLES: [u32; 2] = [1, 4];

/// A way to draw casters all over a map, of textured opacity but where a constant says it.
#[derive(Clone, Debug, Serialize)]
pub struct CostRow {
    /// Technique and storage with the source of opacity, or the depth map.
    pub map: String,
    /// How many casters.
    pub casters: u32,
    /// By how much the time is that of as many casters in a depth map of one sample, and of four.
    pub times: [Distribution; 2],
}

/// All that is measured.
#[derive(Clone, Debug, Serialize)]
pub struct CostReport {
    /// Texels per side of the map.
    pub side: u32,
    /// Whose time it is.
    pub adapter: String,
    /// Its clock.
    pub clock: ClockKind,
    /// Ways to draw casters.
    pub rows: Vec<CostRow>,
}

/// Times casters, far to near, in maps and in depth maps, all in the same rounds.
pub fn costs(stage: &TranslucentStage, counts: &[u32]) -> Result<CostReport, LabError> {
    let gpu = stage.gpu();
    let clock = Clock::new(gpu, ClockKind::for_device(gpu));
    let mut rows = Vec::new();
    for &casters in counts {
        let drawn = stack(casters, false, Texture::Hashed);
        let mut subjects = Vec::new();
        for samples in SAMPLES {
            let opaque = Opaque::new(gpu, stage.side(), samples, &drawn)?;
            subjects.push(Subject {
                name: format!("depth32float, {samples} samples"),
                record: Box::new(move |encoder| {
                    opaque.draw(encoder);
                    Ok(())
                }),
            });
        }
        for (encoding, opacity) in ways(stage)? {
            let blended = Casters::new(gpu, &encoding, opacity, &drawn)?;
            let desc = TextureDesc::of_map(encoding.clone(), [stage.side(); 2]);
            let usage = wgpu::TextureUsages::RENDER_ATTACHMENT;
            let map = texture(gpu, "cost/map", &desc, usage);
            let planes: Vec<_> = (0..encoding.planes())
                .map(|plane| layer(&map, plane))
                .collect();
            subjects.push(Subject {
                name: format!("{encoding}, {}", name(opacity)),
                record: Box::new(move |encoder| {
                    blended.draw(&planes, encoder);
                    Ok(())
                }),
            });
        }
        let rounds = Rounds::run(&clock, &subjects, FEWEST_ROUNDS, || ())?;
        rows.extend(
            subjects
                .iter()
                .enumerate()
                .map(|(number, subject)| CostRow {
                    map: subject.name.clone(),
                    casters,
                    times: [0, 1].map(|depth| rounds.ratio(&[number], &[depth])),
                }),
        );
    }
    Ok(CostReport {
        side: stage.side(),
        adapter: gpu.adapter.get_info().name,
        clock: clock.kind(),
        rows,
    })
}

/// Maps and sources of opacity.
fn ways(stage: &TranslucentStage) -> Result<Vec<(MapEncoding, Opacity)>, LabError> {
    let mut ways = Vec::new();
    for storage in [Storage::Unorm16, Storage::Float16] {
        let four = MapEncoding::new(Technique::Hamburger4, storage)?;
        ways.push((four.clone(), Opacity::Constant));
        if stage.has_second_source() {
            ways.push((four.clone(), Opacity::SecondSource));
        }
        ways.push((four, Opacity::TwoDraws));
        for technique in [Technique::Hamburger6, Technique::Vsm] {
            ways.push((MapEncoding::new(technique, storage)?, Opacity::Alpha));
        }
    }
    Ok(ways)
}

/// As [`Opacity`] spells it.
fn name(opacity: Opacity) -> &'static str {
    match opacity {
        Opacity::Alpha => "alpha",
        Opacity::Constant => "constant",
        Opacity::SecondSource => "second source",
        Opacity::TwoDraws => "two draws",
    }
}

fn layer(map: &wgpu::Texture, layer: u32) -> wgpu::TextureView {
    map.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2),
        base_array_layer: layer,
        array_layer_count: Some(1),
        ..Default::default()
    })
}

/// The same casters as opaque ones in a depth map, with nothing but depth.
struct Opaque {
    view: wgpu::TextureView,
    pipeline: wgpu::RenderPipeline,
    groups: Vec<wgpu::BindGroup>,
}

impl Opaque {
    fn new(gpu: &Gpu, side: u32, samples: u32, casters: &[Caster]) -> Result<Self, LabError> {
        let desc = TextureDesc {
            samples,
            ..TextureDesc::new(moment_shadows::TextureFormat::Depth32Float, [side; 2])
        };
        let map = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("cost/depth"),
            size: wgpu::Extent3d {
                width: side,
                height: side,
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: samples,
            dimension: wgpu::TextureDimension::D2,
            format: desc.wgpu_format(),
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
            view_formats: &[],
        });
        let any = MapEncoding::new(Technique::Vsm, Storage::Float16)?;
        let wgsl = shader(&any, Opacity::Alpha, LAYERS)?;
        let module = gpu
            .device
            .create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some("casters"),
                source: wgpu::ShaderSource::Wgsl(wgsl.into()),
            });
        let pipeline = gpu
            .device
            .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some("cost/depth"),
                layout: None,
                vertex: wgpu::VertexState {
                    module: &module,
                    entry_point: Some("cover"),
                    compilation_options: Default::default(),
                    buffers: &[],
                },
                primitive: Default::default(),
                depth_stencil: Some(wgpu::DepthStencilState {
                    format: map.format(),
                    depth_write_enabled: Some(true),
                    depth_compare: Some(wgpu::CompareFunction::Less),
                    stencil: Default::default(),
                    bias: Default::default(),
                }),
                multisample: wgpu::MultisampleState {
                    count: samples,
                    ..Default::default()
                },
                fragment: None,
                multiview_mask: None,
                cache: None,
            });
        let layout = pipeline.get_bind_group_layout(0);
        let group = |caster| gpu.bind(&layout, [uniform(gpu, caster).as_entire_binding()]);
        Ok(Self {
            view: map.create_view(&Default::default()),
            groups: casters.iter().map(group).collect(),
            pipeline,
        })
    }

    fn draw(&self, encoder: &mut wgpu::CommandEncoder) {
        let mut drawn = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("cost/depth"),
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.view,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        drawn.set_pipeline(&self.pipeline);
        for group in &self.groups {
            drawn.set_bind_group(0, group, &[]);
            drawn.draw(0..3, 0..1);
        }
    }
}

impl fmt::Display for CostReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (side, adapter) = (self.side, &self.adapter);
        writeln!(
            f,
            "Casters all over a map of {side}x{side} texels, far to near, beside as many in a depth map; {adapter}, {:?}\n",
            self.clock
        )?;
        writeln!(
            f,
            "| map | casters | of depth, 1 sample | of depth, 4 samples |"
        )?;
        writeln!(f, "|---|---|---|---|")?;
        for row in &self.rows {
            let times = row.times.map(|it| {
                let unsure = if it.reliable() { "" } else { " (unreliable)" };
                format!("{:.2}{unsure}", it.median)
            });
            writeln!(
                f,
                "| {} | {} | {} | {} |",
                row.map, row.casters, times[0], times[1]
            )?;
        }
        Ok(())
    }
}
