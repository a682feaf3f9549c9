//! Drawing a plan with the library's recorder, on depth maps drawn from the same numbers as the frame graph's.

use moment_shadows_graph::record::{
    Bindings, ImportedResource, PipelineOptions, Pipelines, Recording, Resources,
};
use moment_shadows_graph::{Stage, TextureDesc};
use pollster::block_on;
use wgpu::util::DeviceExt;

use crate::error::RecorderError;
use crate::input::Input;

pub(crate) struct Recorder {
    device: wgpu::Device,
    queue: wgpu::Queue,
}

impl Recorder {
    pub(crate) fn open() -> Result<Self, RecorderError> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
            backends: wgpu::Backends::VULKAN,
            ..wgpu::InstanceDescriptor::new_without_display_handle()
        });
        let adapter = block_on(instance.request_adapter(&Default::default()));
        let adapter = adapter.map_err(failed)?;
        let device = block_on(adapter.request_device(&Default::default()));
        let (device, queue) = device.map_err(failed)?;
        Ok(Self { device, queue })
    }

    /// The outputs by name: texels, row by row.
    pub(crate) fn draw(&self, input: &Input) -> Result<Vec<(String, Vec<u8>)>, RecorderError> {
        let (device, plan) = (&self.device, &input.plan);
        let parameters = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("parameters"),
            contents: &input.bytes("parameters")?,
            usage: wgpu::BufferUsages::UNIFORM,
        });
        let mut encoder = device.create_command_encoder(&Default::default());
        let mut imports = Vec::new();
        for import in &plan.imports {
            let of = plan.resources[import.value].desc.texture();
            let of = of.ok_or_else(|| RecorderError::Format(import.name.clone()))?;
            let layers = (0..of.array_layers()).map(|layer| {
                let depths = input.bytes(&format!("{}.{layer}.depth", import.name))?;
                Ok(self.draw_depth(&mut encoder, of, &depths))
            });
            let mut layers = layers.collect::<Result<Vec<_>, RecorderError>>()?;
            let given = match (layers.len(), layers.pop()) {
                (1, Some(texture)) => ImportedResource::Texture(texture),
                (_, last) => ImportedResource::Layers(layers.into_iter().chain(last).collect()),
            };
            imports.push((import.name.as_str(), given));
        }
        let pipelines = block_on(Pipelines::create(device, plan, PipelineOptions::default()))?;
        let resources = block_on(Resources::create(device, plan))?;
        let given = Some(&parameters);
        let bindings = Bindings::create(device, plan, &pipelines, &resources, &imports, given);
        let bindings = block_on(bindings)?;
        for stage in Stage::ALL {
            bindings.record(stage, &mut encoder, Recording::default())?;
        }
        self.queue.submit([encoder.finish()]);
        let outputs = plan.outputs.iter().filter_map(|output| {
            let texture = bindings.output(&output.name)?;
            Some(
                self.read(texture)
                    .map(|texels| (output.name.clone(), texels)),
            )
        });
        outputs.collect()
    }

    /// A depth map that holds these numbers.
    fn draw_depth(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        of: &TextureDesc,
        depths: &[u8],
    ) -> wgpu::Texture {
        let device = &self.device;
        let format = of.wgpu_format();
        let module = device.create_shader_module(wgpu::include_wgsl!("../../src/frame/depth.wgsl"));
        let constants = [
            ("width", f64::from(of.size[0])),
            ("samples", f64::from(of.samples)),
        ];
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("depth"),
            layout: None,
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("triangle"),
                compilation_options: Default::default(),
                buffers: &[],
            },
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("depth"),
                compilation_options: wgpu::PipelineCompilationOptions {
                    constants: &constants,
                    ..Default::default()
                },
                targets: &[],
            }),
            primitive: Default::default(),
            depth_stencil: Some(wgpu::DepthStencilState {
                format,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Always),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: wgpu::MultisampleState {
                count: of.samples,
                ..Default::default()
            },
            multiview_mask: None,
            cache: None,
        });
        let depths = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("depths"),
            contents: depths,
            usage: wgpu::BufferUsages::STORAGE,
        });
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pipeline.get_bind_group_layout(0),
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: depths.as_entire_binding(),
            }],
        });
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("depth"),
            size: wgpu::Extent3d {
                width: of.size[0],
                height: of.size[1],
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: of.samples,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &texture.create_view(&Default::default()),
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(0.0),
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
        texture
    }

    fn read(&self, texture: &wgpu::Texture) -> Result<Vec<u8>, RecorderError> {
        let texel = texture.format().block_copy_size(None).unwrap_or(0);
        let row = texture.width() * texel;
        let padded = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("read"),
            size: u64::from(padded) * u64::from(texture.height()),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = self.device.create_command_encoder(&Default::default());
        let into = wgpu::TexelCopyBufferInfo {
            buffer: &buffer,
            layout: wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(padded),
                rows_per_image: None,
            },
        };
        encoder.copy_texture_to_buffer(texture.as_image_copy(), into, texture.size());
        self.queue.submit([encoder.finish()]);
        buffer.map_async(wgpu::MapMode::Read, .., |_| {});
        self.device
            .poll(wgpu::PollType::wait_indefinitely())
            .map_err(failed)?;
        let bytes = buffer.get_mapped_range(..).map_err(failed)?;
        let rows = bytes.chunks_exact(padded as usize);
        Ok(rows.flat_map(|it| it[..row as usize].to_vec()).collect())
    }
}

fn failed(error: impl std::fmt::Display) -> RecorderError {
    RecorderError::Device(error.to_string())
}
