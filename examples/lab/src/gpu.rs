//! Opening an adapter the same way everywhere: native interfaces only, exactly the features of one profile.

use std::fmt::Display;
use std::sync::{Arc, Mutex};

use moment_shadows::Profile;
use moment_shadows_graph::command::adapter;
use wgpu::util::{DeviceExt, DownloadBuffer};

use crate::error::LabError;

/// An open device with its queue.
pub struct Gpu {
    /// The adapter the device was made from.
    pub adapter: wgpu::Adapter,
    /// The device.
    pub device: wgpu::Device,
    /// The device's queue.
    pub queue: wgpu::Queue,
    errors: Arc<Mutex<Vec<String>>>,
}

impl Gpu {
    /// Opens the best adapter with the features of `profile`, and every depth format that it has.
    pub fn open(profile: Profile) -> Result<Self, LabError> {
        Self::open_with(profile, wgpu::Features::DEPTH32FLOAT_STENCIL8)
    }

    /// Opens the best adapter with the features of `profile` and those of `optional` that it has.
    pub fn open_with(profile: Profile, optional: wgpu::Features) -> Result<Self, LabError> {
        let adapter = adapter::best()?;
        let name = adapter.get_info().name;
        let required = required_features(profile);
        let missing = required - adapter.features();
        if !missing.is_empty() {
            return Err(LabError::refused(format!(
                "adapter '{name}' lacks {missing:?}, which the profile {profile} asks for; choose a smaller profile"
            )));
        }
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("moment-shadows lab"),
            required_features: required | (optional & adapter.features()),
            ..Default::default()
        };
        let (device, queue) =
            pollster::block_on(adapter.request_device(&descriptor)).map_err(|error| {
                LabError::refused(format!("adapter '{name}' gave no device: {error}"))
            })?;
        let errors = Arc::new(Mutex::new(Vec::new()));
        let sink = Arc::clone(&errors);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            if let Ok(mut errors) = sink.lock() {
                errors.push(error.to_string());
            }
        }));
        Ok(Self {
            adapter,
            device,
            queue,
            errors,
        })
    }

    /// The device of a host that has one already. Errors outside any scope stay with the host's own handler, so that
    /// [`check`](Self::check) finds none.
    pub fn of_host(adapter: wgpu::Adapter, device: wgpu::Device, queue: wgpu::Queue) -> Self {
        Self {
            adapter,
            device,
            queue,
            errors: Arc::default(),
        }
    }

    /// The adapter's name, and its driver with the version.
    #[must_use]
    pub fn described(&self) -> String {
        let info = self.adapter.get_info();
        format!("{}, {} {}", info.name, info.driver, info.driver_info)
    }

    /// The first error that the device reported outside any scope, if there was one.
    pub fn check(&self) -> Result<(), LabError> {
        let first = self.errors.lock().ok().and_then(|mut errors| {
            if errors.is_empty() {
                None
            } else {
                Some(errors.remove(0))
            }
        });
        first.map_or(Ok(()), |error| {
            let reason = format!("the device reported an error: {error}");
            Err(LabError::refused(reason))
        })
    }

    /// A compute pipeline whose layout is what its shader binds.
    pub fn compute(&self, label: &str, wgsl: &str, entry_point: &str) -> wgpu::ComputePipeline {
        let module = self
            .device
            .create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(label),
                source: wgpu::ShaderSource::Wgsl(wgsl.into()),
            });
        self.device
            .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(label),
                layout: None,
                module: &module,
                entry_point: Some(entry_point),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                cache: None,
            })
    }

    /// A group of what its bindings 0, 1, ... are.
    pub fn bind<'a>(
        &self,
        layout: &wgpu::BindGroupLayout,
        resources: impl IntoIterator<Item = wgpu::BindingResource<'a>>,
    ) -> wgpu::BindGroup {
        let entries: Vec<_> = (0..)
            .zip(resources)
            .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource })
            .collect();
        self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout,
            entries: &entries,
        })
    }

    /// A buffer of `size` bytes that a shader writes and [`read_buffer`](Self::read_buffer) reads.
    pub fn output(&self, label: &str, size: u64) -> wgpu::Buffer {
        self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        })
    }

    /// A buffer of these bytes.
    pub fn filled(&self, label: &str, contents: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
        let descriptor = wgpu::util::BufferInitDescriptor {
            label: Some(label),
            contents,
            usage,
        };
        self.device.create_buffer_init(&descriptor)
    }

    /// Dispatches a pipeline once, with groups 0, 1, ..., and submits that.
    pub fn dispatch(
        &self,
        pipeline: &wgpu::ComputePipeline,
        groups: &[&wgpu::BindGroup],
        [x, y]: [u32; 2],
    ) {
        let mut encoder = self.device.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(pipeline);
        for (index, group) in (0..).zip(groups) {
            pass.set_bind_group(index, *group, &[]);
        }
        pass.dispatch_workgroups(x, y, 1);
        drop(pass);
        self.queue.submit([encoder.finish()]);
    }

    /// Copies a buffer (usage `COPY_SRC`) to the processor and waits for it.
    pub fn read_buffer(&self, buffer: &wgpu::Buffer, label: &str) -> Result<Vec<u8>, LabError> {
        let failed = |reason: &dyn Display| lost(label, reason);
        let (send, receive) = std::sync::mpsc::channel();
        let whole = buffer.slice(..);
        DownloadBuffer::read_buffer(&self.device, &self.queue, &whole, move |result| {
            // The receiver is gone only if this function returned early; then nobody waits for the answer.
            let _ = send.send(result);
        });
        self.device
            .poll(wgpu::PollType::wait_indefinitely())
            .map_err(|error| failed(&error))?;
        let data = receive
            .recv()
            .map_err(|error| failed(&error))?
            .map_err(|error| failed(&error))?;
        self.check()?;
        Ok(data.to_vec())
    }

    /// Copies layer `layer` of mip 0 of a single-sampled colour texture (usage `COPY_SRC`) to the processor,
    /// rows tightly packed, top row first.
    pub fn read_texture(
        &self,
        texture: &wgpu::Texture,
        layer: u32,
        label: &str,
    ) -> Result<Vec<u8>, LabError> {
        self.read_level(texture, layer, 0, label)
    }

    /// Copies layer `layer` of any mip level to the processor, as [`read_texture`](Self::read_texture) does of mip 0.
    pub fn read_level(
        &self,
        texture: &wgpu::Texture,
        layer: u32,
        level: u32,
        label: &str,
    ) -> Result<Vec<u8>, LabError> {
        let width = (texture.width() >> level).max(1);
        let height = (texture.height() >> level).max(1);
        let aspect = if texture.format().has_depth_aspect() {
            wgpu::TextureAspect::DepthOnly
        } else {
            wgpu::TextureAspect::All
        };
        let texel_bytes = texture
            .format()
            .block_copy_size(Some(aspect))
            .ok_or_else(|| {
                lost(
                    label,
                    &format!("format {:?} cannot be copied", texture.format()),
                )
            })?;
        let row = width * texel_bytes;
        let padded = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let staging = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: u64::from(padded) * u64::from(height),
            usage: wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut encoder = self
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some(label) });
        encoder.copy_texture_to_buffer(
            wgpu::TexelCopyTextureInfo {
                texture,
                mip_level: level,
                origin: wgpu::Origin3d {
                    x: 0,
                    y: 0,
                    z: layer,
                },
                aspect,
            },
            wgpu::TexelCopyBufferInfo {
                buffer: &staging,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(padded),
                    rows_per_image: None,
                },
            },
            wgpu::Extent3d {
                width,
                height,
                depth_or_array_layers: 1,
            },
        );
        self.queue.submit([encoder.finish()]);
        let data = self.read_buffer(&staging, label)?;
        Ok(data
            .chunks_exact(padded as usize)
            .flat_map(|line| &line[..row as usize])
            .copied()
            .collect())
    }
}

fn lost(label: &str, reason: &dyn Display) -> LabError {
    LabError::refused(format!(
        "the device could not give back '{label}': {reason}; it may have been lost"
    ))
}

/// The features that a profile stands for.
fn required_features(profile: Profile) -> wgpu::Features {
    match profile {
        Profile::WebgpuCore => wgpu::Features::empty(),
        Profile::Native => wgpu::Features::TEXTURE_FORMAT_16BIT_NORM,
        // wgpu has no name for the feature of browsers; these devices do what that allows, and more.
        Profile::NativeAdapter | Profile::WebgpuTier1 => {
            wgpu::Features::TEXTURE_FORMAT_16BIT_NORM
                | wgpu::Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES
        }
    }
}
