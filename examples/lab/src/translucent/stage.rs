//! Maps with translucent casters, shaded by the library and by the exact transmittance.

use moment_shadows::{
    CameraView, Kernel, LeakReduction, LightView, MapEncoding, Opacity, Profile, ReceiverBias,
    TextureFormat, ViewParameters,
};
use moment_shadows_graph::record::{
    Bindings, HostPass, ImportedResource, PipelineOptions, Pipelines, Recording, Resources,
};
use moment_shadows_graph::{Capabilities, Graph, NodeRegistry, ResourceDesc, Stage, TextureDesc};
use pollster::block_on;
use serde_json::json;

use super::casters::Caster;
use super::draw::Casters;
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::texture::upload;

/// The kernel of a blur: its radius and deviation in texels.
const KERNEL: (u32, f32) = (4, 2.4);

/// What shades a map of `side` texels, each of which is a pixel.
pub struct TranslucentStage {
    gpu: Gpu,
    side: u32,
}

/// Where opaque casters and receivers lie at each texel, as stored depth, and whether the map is blurred.
pub struct Surfaces<'a> {
    /// Opaque casters; 1 where there is none.
    pub opaque: &'a dyn Fn([u32; 2]) -> f32,
    /// Receivers.
    pub receiver: &'a dyn Fn([u32; 2]) -> f32,
    /// Whether the map is filtered after casters were drawn.
    pub blurred: bool,
}

impl TranslucentStage {
    /// A stage on an adapter that blends into every storage.
    pub fn new(side: u32) -> Result<Self, LabError> {
        let optional = wgpu::Features::FLOAT32_BLENDABLE | wgpu::Features::DUAL_SOURCE_BLENDING;
        let gpu = Gpu::open_with(Profile::NativeAdapter, optional)?;
        Ok(Self { gpu, side })
    }

    pub(super) fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// Whether a fragment can give its opacity as a second source.
    #[must_use]
    pub fn has_second_source(&self) -> bool {
        let features = self.gpu.device.features();
        features.contains(wgpu::Features::DUAL_SOURCE_BLENDING)
    }

    /// Texels per side.
    #[must_use]
    pub fn side(&self) -> u32 {
        self.side
    }

    fn texels(&self) -> impl Iterator<Item = [u32; 2]> {
        let side = self.side;
        (0..side).flat_map(move |y| (0..side).map(move |x| [x, y]))
    }

    /// Shadow intensity by a map with these casters, far to near.
    pub fn found(
        &self,
        encoding: &MapEncoding,
        opacity: Opacity,
        casters: &[Caster],
        surfaces: &Surfaces<'_>,
    ) -> Result<Vec<f32>, LabError> {
        let drawn = Casters::new(&self.gpu, encoding, opacity, casters)?;
        self.shaded(encoding, surfaces, &mut |pass, encoder| {
            drawn.draw(pass.targets, encoder);
        })
    }

    /// Shadow intensity by a map with what `draw` blends into it.
    pub(super) fn shaded(
        &self,
        encoding: &MapEncoding,
        surfaces: &Surfaces<'_>,
        draw: &mut dyn FnMut(HostPass<'_>, &mut wgpu::CommandEncoder),
    ) -> Result<Vec<f32>, LabError> {
        let (gpu, size) = (&self.gpu, [self.side; 2]);
        let capabilities = Capabilities::of_device(&gpu.adapter, &gpu.device);
        let light = TextureDesc::new(TextureFormat::R32Float, size);
        let camera = TextureDesc::new(TextureFormat::Depth32Float, size);
        let described = [("light_depth", &light), ("camera_depth", &camera)];
        let described = described.map(|(name, desc)| (name, ResourceDesc::Texture(desc.clone())));
        let graph = Graph::parse(&graph(encoding, surfaces.blurred), &NodeRegistry::new())?;
        let plan = graph.compile(&capabilities, &described)?;
        let pipelines = Pipelines::create(&gpu.device, &plan, PipelineOptions::default());
        let pipelines = block_on(pipelines)?;
        let resources = block_on(Resources::create(&gpu.device, &plan))?;
        let mut block = plan.parameters.initial();
        plan.parameters.write(&mut block, "shade", 0, &aligned()?)?;
        let parameters = gpu.filled("parameters", &block, wgpu::BufferUsages::UNIFORM);
        let opaque: Vec<f32> = self.texels().map(surfaces.opaque).collect();
        let receivers: Vec<f32> = self.texels().map(surfaces.receiver).collect();
        let light = upload(gpu, &light, bytemuck::cast_slice(&opaque));
        let camera = self.depth_texture(&receivers);
        let imports = [
            ("light_depth", ImportedResource::from(&light)),
            ("camera_depth", ImportedResource::from(&camera)),
        ];
        let bindings = block_on(Bindings::create(
            &gpu.device,
            &plan,
            &pipelines,
            &resources,
            &imports,
            Some(&parameters),
        ))?;
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        for stage in Stage::ALL {
            let recording = Recording {
                host_passes: Some(&mut *draw),
                ..Recording::default()
            };
            bindings.record(stage, &mut encoder, recording)?;
        }
        gpu.queue.submit([encoder.finish()]);
        gpu.check()?;
        let output = bindings.output("shadow_intensity");
        let output = output.ok_or_else(|| LabError::refused("the plan has no such output"))?;
        let bytes = gpu.read_texture(output, 0, "shadow intensity")?;
        Ok(bytemuck::pod_collect_to_vec(&bytes))
    }

    /// The same by the transmittance of each texel's ray, filtered as the map is.
    pub fn truth(&self, casters: &[Caster], surfaces: &Surfaces<'_>) -> Result<Vec<f64>, LabError> {
        let side = self.side as i64;
        let weights = if surfaces.blurred {
            Kernel::gaussian(KERNEL.0, KERNEL.1)?.weights().to_vec()
        } else {
            vec![1.0]
        };
        let reach = weights.len() as i64 / 2;
        let of_texel = |texel: [u32; 2], depth: f32| {
            if (surfaces.opaque)(texel) < depth {
                return 1.0;
            }
            let before = casters.iter().filter(|caster| caster.depth < depth);
            let transmittance: f64 = before
                .map(|caster| 1.0 - caster.opacity_at(texel))
                .product();
            1.0 - transmittance
        };
        let shaded = self.texels().map(|texel| {
            let depth = (surfaces.receiver)(texel);
            let mut sum = 0.0;
            for (row, down) in weights.iter().zip(-reach..) {
                for (column, across) in weights.iter().zip(-reach..) {
                    // A blur repeats the last texel.
                    let place = [(texel[0], across), (texel[1], down)];
                    let place =
                        place.map(|(at, step)| (i64::from(at) + step).clamp(0, side - 1) as u32);
                    sum += f64::from(row * column) * of_texel(place, depth);
                }
            }
            sum
        });
        Ok(shaded.collect())
    }

    /// A depth texture with these contents, row by row.
    fn depth_texture(&self, depths: &[f32]) -> wgpu::Texture {
        let device = &self.gpu.device;
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("receivers"),
            size: wgpu::Extent3d {
                width: self.side,
                height: self.side,
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Depth32Float,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        let module = device.create_shader_module(wgpu::include_wgsl!("depth.wgsl"));
        let constants = [("width", f64::from(self.side))];
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("receivers"),
            layout: None,
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("cover"),
                compilation_options: Default::default(),
                buffers: &[],
            },
            primitive: Default::default(),
            depth_stencil: Some(wgpu::DepthStencilState {
                format: texture.format(),
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Always),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("depth"),
                compilation_options: wgpu::PipelineCompilationOptions {
                    constants: &constants,
                    ..Default::default()
                },
                targets: &[],
            }),
            multiview_mask: None,
            cache: None,
        });
        let bytes = bytemuck::cast_slice(depths);
        let buffer = self
            .gpu
            .filled("receivers", bytes, wgpu::BufferUsages::STORAGE);
        let group = self.gpu.bind(
            &pipeline.get_bind_group_layout(0),
            [buffer.as_entire_binding()],
        );
        let view = texture.create_view(&Default::default());
        let mut encoder = device.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &view,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.draw(0..3, 0..1);
        drop(pass);
        self.gpu.queue.submit([encoder.finish()]);
        texture
    }
}

/// A camera and a light that look along one axis, so that pixels are texels, without any bias of receivers.
fn aligned() -> Result<ViewParameters, LabError> {
    let along_z = [0, 1, 2, 3].map(|column| {
        let mut entries = [0.0; 4];
        entries[column] = 1.0;
        entries
    });
    let camera = CameraView {
        clip_from_world: along_z,
        far_depth: 1.0,
    };
    let light = LightView::orthographic(along_z);
    let parameters = ViewParameters::new(&camera, &light, ReceiverBias::NONE, LeakReduction::NONE);
    parameters.map_err(|error| LabError::unsuitable("a view along an axis", error))
}

/// The graph with the casters between resolve and shading.
fn graph(encoding: &MapEncoding, blurred: bool) -> String {
    let resolve = json!({
        "technique": encoding.technique(),
        "storage": encoding.storage(),
        "blends": encoding.blends(),
    });
    let (radius, sigma) = KERNEL;
    let blur = json!({ "name": "blur", "type": "blur", "properties": { "kernel": { "radius": radius, "sigma": sigma } } });
    let mut nodes = vec![
        json!({ "name": "resolve", "type": "resolve", "properties": resolve }),
        json!({ "name": "casters", "type": "translucent_casters" }),
        json!({ "name": "shade", "type": "shade_hard", "properties": { "format": "r32float" } }),
    ];
    let mut edges = vec![
        json!({ "from": "light_depth", "to": "resolve.depth" }),
        json!({ "from": "resolve.map", "to": "casters.map" }),
        json!({ "from": "camera_depth", "to": "shade.camera_depth" }),
    ];
    if blurred {
        nodes.push(blur);
        edges.push(json!({ "from": "casters.map", "to": "blur.map" }));
        edges.push(json!({ "from": "blur.blurred", "to": "shade.map" }));
    } else {
        edges.push(json!({ "from": "casters.map", "to": "shade.map" }));
    }
    json!({
        "version": 2,
        "imports": [{ "name": "light_depth" }, { "name": "camera_depth" }],
        "nodes": nodes,
        "edges": edges,
        "outputs": [{ "name": "shadow_intensity", "from": "shade.shadow_intensity" }],
    })
    .to_string()
}
