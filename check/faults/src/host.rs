//! A host: its textures, where camera and light are, and how it draws a frame.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use glam::{DMat4, DVec3};
use moment_shadows::{CameraView, LightView, Profile};
use moment_shadows_graph::record::ImportedResource;
use moment_shadows_lab::error::LabError;
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::view::Camera;
use wgpu::util::DeviceExt as _;

/// The textures of one frame.
pub(crate) struct Textures {
    map: wgpu::Texture,
    depth: wgpu::Texture,
}

impl Textures {
    fn new(gpu: &Gpu, map: u32, picture: [u32; 2]) -> Self {
        let texture = |format, [width, height]: [u32; 2], texels: &[u8]| {
            let desc = wgpu::TextureDescriptor {
                label: Some("host"),
                size: wgpu::Extent3d {
                    width,
                    height,
                    depth_or_array_layers: 1,
                },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::TEXTURE_BINDING,
                view_formats: &[],
            };
            let order = wgpu::util::TextureDataOrder::LayerMajor;
            (gpu.device).create_texture_with_data(&gpu.queue, &desc, order, texels)
        };
        // Steps in both: shadows with edges.
        let of_light = (0..map * map).map(|index| 0.3 + 0.4 * f32::from((index / 7 % 3) as u8));
        let of_light: Vec<u8> = of_light.flat_map(f32::to_le_bytes).collect();
        let of_camera = (0..picture[0] * picture[1]).map(|index| 2000 + 100 * (index % 37) as u16);
        let of_camera: Vec<u8> = of_camera.flat_map(u16::to_le_bytes).collect();
        Self {
            map: texture(wgpu::TextureFormat::R32Float, [map; 2], &of_light),
            depth: texture(wgpu::TextureFormat::Depth16Unorm, picture, &of_camera),
        }
    }

    pub(crate) fn imports(&self) -> [(&'static str, ImportedResource); 2] {
        [
            ("light_depth", (&self.map).into()),
            ("camera_depth", (&self.depth).into()),
        ]
    }
}

/// The host.
pub(crate) struct Host {
    pub(crate) gpu: Gpu,
    pub(crate) small: Textures,
    pub(crate) large: Textures,
    pub(crate) camera: CameraView,
    pub(crate) light: LightView,
    lost: Arc<AtomicBool>,
}

impl Host {
    pub(crate) fn new() -> Result<Self, LabError> {
        let gpu = Gpu::open(Profile::WebgpuCore)?;
        let lost = Arc::new(AtomicBool::new(false));
        let said = Arc::clone(&lost);
        gpu.device
            .set_device_lost_callback(move |_, _| said.store(true, Ordering::SeqCst));
        let camera = Camera {
            eye: DVec3::new(4.0, 3.0, 5.0),
            target: DVec3::ZERO,
            vertical_angle: 1.0,
            aspect: 1.5,
            near: 0.1,
            far: None,
        };
        // Straight down: x, then -z, then depth along y.
        let sun = DMat4::from_cols_array_2d(&[
            [0.125, 0.0, 0.0, 0.0],
            [0.0, 0.0, -0.05, 0.0],
            [0.0, -0.125, 0.0, 0.0],
            [0.0, 0.0, 0.5, 1.0],
        ]);
        Ok(Self {
            small: Textures::new(&gpu, 32, [24, 16]),
            large: Textures::new(&gpu, 48, [40, 24]),
            camera: CameraView {
                clip_from_world: camera.clip_from_world_columns()?,
                far_depth: 0.0,
            },
            light: LightView::orthographic(sun.to_cols_array_2d()),
            gpu,
            lost,
        })
    }

    /// Whether the device said that it is lost.
    pub(crate) fn lost(&self) -> bool {
        self.lost.load(Ordering::SeqCst)
    }

    /// Submits what was recorded, and reads some outputs.
    pub(crate) fn shown(
        &self,
        encoder: wgpu::CommandEncoder,
        outputs: &[&wgpu::Texture],
    ) -> Result<Vec<u8>, LabError> {
        self.gpu.queue.submit([encoder.finish()]);
        let mut shown = Vec::new();
        for output in outputs {
            shown.extend(self.gpu.read_texture(output, 0, "an output")?);
        }
        Ok(shown)
    }
}
