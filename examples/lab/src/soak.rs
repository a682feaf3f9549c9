//! A session over many frames: maps and pictures are resized, layers are made anew one by one, regions move. What it shows has to be
//! what a session shows that was made just then, and its memory has to stay what it was.

use glam::{DMat4, DVec3, DVec4};
use moment_shadows::{CameraView, LightView, MapRegion};
use moment_shadows_graph::record::{ImportedResource, Layers, Recording};
use moment_shadows_graph::{Graph, NodeRegistry, Session, Stage};
use pollster::block_on;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::Serialize;

use crate::error::LabError;
use crate::gpu::Gpu;
use crate::view::Camera;

/// The graph of hard shadows, for two lights in each of three layers.
const GRAPH: &str = include_str!("../../hard_shadows.json");

/// Layers of the light's map.
const LAYERS: u32 = 3;

/// Regions of a layer.
const REGIONS: u32 = 2;

/// Sides of the light's map.
const MAPS: [u32; 3] = [64, 96, 128];

/// Pictures.
const PICTURES: [[u32; 2]; 3] = [[48, 27], [80, 45], [33, 60]];

/// How the light's map stores depth, and how the picture does: of the formats of a camera's depth this one can be written.
const MAP_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R32Float;
const PICTURE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth16Unorm;

/// One frame of so many has maps or pictures of another size.
const RESIZED: u32 = 50;

/// How long it goes on.
#[derive(Clone, Copy, Debug, clap::Args)]
pub struct SoakDesc {
    /// Frames.
    #[arg(long, default_value_t = 100_000)]
    pub frames: u32,
    /// A session is made anew and compared with after so many frames.
    #[arg(long, default_value_t = 100, value_parser = clap::value_parser!(u32).range(1..))]
    pub every: u32,
    /// Seed of what changes from frame to frame.
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
}

/// What became of it.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Soak {
    /// Frames.
    pub frames: u32,
    /// Changes of size.
    pub resizes: u32,
    /// Layers that were made anew.
    pub layers: u32,
    /// Sessions that were compared with.
    pub compared: u32,
    /// Those that showed something else.
    pub different: u32,
    /// Bytes of the process in memory after each tenth of the frames, where the system says so.
    pub bytes: Vec<u64>,
}

/// How much more memory there may be in the end than after two tenths: an allocator keeps what it has.
const GROWTH: f64 = 1.05;

impl Soak {
    /// Whether everything was as in a session that is new, and memory stayed what it was.
    #[must_use]
    pub fn passed(&self) -> bool {
        let grown = match (self.bytes.get(1), self.bytes.last()) {
            (Some(&early), Some(&late)) => late as f64 > GROWTH * early as f64,
            _ => false,
        };
        self.different == 0 && !grown
    }
}

impl core::fmt::Display for Soak {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        writeln!(
            f,
            "{} frames, {} resizes, {} layers made anew; {} of {} new sessions show something else",
            self.frames, self.resizes, self.layers, self.different, self.compared
        )?;
        let megabytes = self
            .bytes
            .iter()
            .map(|bytes| format!("{:.1}", *bytes as f64 / f64::from(1 << 20)));
        let megabytes: Vec<String> = megabytes.collect();
        writeln!(f, "MiB after each tenth: {}", megabytes.join(", "))?;
        writeln!(f, "{}", if self.passed() { "ok" } else { "FAULT" })
    }
}

/// Textures of the host, and what they were drawn with.
struct Host {
    random: ChaCha8Rng,
    map: wgpu::Texture,
    depth: wgpu::Texture,
    lights: Vec<LightView>,
    camera: CameraView,
}

impl Host {
    fn new(gpu: &Gpu, seed: u64) -> Result<Self, LabError> {
        let mut host = Self {
            random: ChaCha8Rng::seed_from_u64(seed),
            map: texture(gpu, MAP_FORMAT, [MAPS[0]; 2], LAYERS),
            depth: texture(gpu, PICTURE_FORMAT, PICTURES[0], 1),
            lights: Vec::new(),
            camera: CameraView {
                clip_from_world: DMat4::IDENTITY.to_cols_array_2d(),
                far_depth: 0.0,
            },
        };
        let light = LightView::orthographic(DMat4::IDENTITY.to_cols_array_2d());
        host.lights = vec![light; (LAYERS * REGIONS) as usize];
        (0..LAYERS).for_each(|layer| host.draw_layer(gpu, layer));
        host.draw_picture(gpu)?;
        Ok(host)
    }

    fn one_of<T: Copy>(&mut self, values: &[T]) -> T {
        values[self.random.random_range(0..values.len())]
    }

    /// Noise over the texels of a layer of a texture.
    fn fill<T: bytemuck::NoUninit>(
        &mut self,
        gpu: &Gpu,
        texture: &wgpu::Texture,
        layer: u32,
        texel: impl Fn(&mut ChaCha8Rng) -> T,
    ) {
        let size = texture.size();
        let texels: Vec<T> = (0..size.width * size.height)
            .map(|_| texel(&mut self.random))
            .collect();
        let mut copy = texture.as_image_copy();
        copy.origin.z = layer;
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(size_of::<T>() as u32 * size.width),
            rows_per_image: None,
        };
        let extent = wgpu::Extent3d {
            depth_or_array_layers: 1,
            ..size
        };
        (gpu.queue).write_texture(copy, bytemuck::cast_slice(&texels), layout, extent);
    }

    /// Draws a layer of the light's map anew, from other lights in other regions.
    fn draw_layer(&mut self, gpu: &Gpu, layer: u32) {
        let map = self.map.clone();
        self.fill(gpu, &map, layer, |random| random.random_range(0.0..1.0_f32));
        let side = map.width();
        let split = self.random.random_range(24..side - 24);
        for (first, width) in [(0, split), (split, side - split)] {
            let along = self.direction();
            let across = along.any_orthonormal_vector();
            let up = across.cross(along);
            let rows = [across / 8.0, up / 8.0, along / 40.0];
            let rows = [0.0, 0.0, 0.5].into_iter().zip(rows);
            let rows: Vec<DVec4> = rows.map(|(offset, row)| row.extend(offset)).collect();
            let clip = DMat4::from_cols(rows[0], rows[1], rows[2], DVec4::W).transpose();
            let height = self.random.random_range(24..=side);
            let light = (layer * REGIONS + u32::from(first > 0)) as usize;
            self.lights[light] = LightView {
                layer,
                region: MapRegion {
                    origin: [first, side - height],
                    extent: [width, height],
                },
                channel: light as u32 % 4,
                ..LightView::orthographic(clip.to_cols_array_2d())
            };
        }
    }

    fn direction(&mut self) -> DVec3 {
        let [x, y, z] = [(); 3].map(|()| self.random.random_range(-1.0..1.0));
        DVec3::new(x, y, z).normalize_or(DVec3::NEG_Y)
    }

    /// Draws the picture from another place.
    fn draw_picture(&mut self, gpu: &Gpu) -> Result<(), LabError> {
        let depth = self.depth.clone();
        // From 1 to 20 scene units away.
        self.fill(gpu, &depth, 0, |random| random.random_range(328..6554_u16));
        let camera = Camera {
            eye: 4.0 * self.direction(),
            target: DVec3::ZERO,
            vertical_angle: 1.0,
            aspect: f64::from(depth.width()) / f64::from(depth.height()),
            near: 0.1,
            far: None,
        };
        self.camera.clip_from_world = camera.clip_from_world_columns()?;
        Ok(())
    }

    fn imports(&self) -> [(&'static str, ImportedResource); 2] {
        [
            ("light_depth", (&self.map).into()),
            ("camera_depth", (&self.depth).into()),
        ]
    }

    fn session(&self, gpu: &Gpu) -> Result<Session, LabError> {
        let graph = Graph::parse(&graph_text(), &NodeRegistry::new())?;
        let (imports, options) = (self.imports(), Default::default());
        let made = Session::new(&gpu.adapter, &gpu.device, graph, &imports, options);
        Ok(block_on(made)?)
    }

    /// What a session shows of this frame, where so many layers are made anew.
    fn shown(&self, gpu: &Gpu, session: &mut Session, layers: &[u32]) -> Result<Vec<u8>, LabError> {
        session.view(&gpu.queue, 0, &self.camera, &self.lights)?;
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        for stage in Stage::ALL {
            let recording = Recording {
                layers: Layers::Only(layers),
                ..Recording::default()
            };
            session.maps().record(stage, &mut encoder, recording)?;
            session.record_view(0, stage, &mut encoder)?;
        }
        gpu.queue.submit([encoder.finish()]);
        gpu.check()?;
        let output = session.output(0, "shadow_intensity").ok_or_else(|| {
            LabError::Refused("the graph of hard shadows has no output 'shadow_intensity'".into())
        })?;
        gpu.read_texture(output, 0, "shadow intensity")
    }
}

/// The graph for regions of several layers of a map of single precision.
fn graph_text() -> String {
    let views = LAYERS * REGIONS;
    let import = format!(
        r#""texture": {{ "format": "r32float", "size": [64, 64], "layers": {LAYERS}, "regions": {REGIONS} }}"#
    );
    let shade =
        format!(r#""type": "shade_hard", "properties": {{ "views": {views}, "lights": 4 }}"#);
    let depth = r#""texture": { "format": "depth32float", "size": [1024, 1024], "samples": 4 }"#;
    GRAPH
        .replace(depth, &import)
        .replace(r#""type": "shade_hard""#, &shade)
}

fn texture(
    gpu: &Gpu,
    format: wgpu::TextureFormat,
    [width, height]: [u32; 2],
    layers: u32,
) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("soak"),
        size: wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: layers,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    })
}

/// Bytes of this process in memory, where the system says so.
fn resident() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    let kibibytes: u64 = line.split_whitespace().next()?.parse().ok()?;
    Some(kibibytes << 10)
}

/// Goes on for so many frames. `step` is called after each.
pub fn run(gpu: &Gpu, desc: &SoakDesc, mut step: impl FnMut()) -> Result<Soak, LabError> {
    let mut host = Host::new(gpu, desc.seed)?;
    let mut session = host.session(gpu)?;
    let mut found = Soak {
        frames: desc.frames,
        ..Soak::default()
    };
    let all: Vec<u32> = (0..LAYERS).collect();
    let mut dirty = all.clone();
    for frame in 1..=desc.frames {
        if host.random.random_range(0..RESIZED) == 0 {
            let sides = host.one_of(&MAPS);
            let picture = host.one_of(&PICTURES);
            let both = host.random.random_range(0..2) == 0;
            host.depth = texture(gpu, PICTURE_FORMAT, picture, 1);
            let mut replaced = host.imports().to_vec();
            if both {
                host.map = texture(gpu, MAP_FORMAT, [sides; 2], LAYERS);
                dirty.clone_from(&all);
                replaced = host.imports().to_vec();
            } else {
                replaced.remove(0);
            }
            block_on(session.replace(0, &replaced))?;
            found.resizes += 1;
        } else if frame > 1 {
            dirty.retain(|_| false);
            dirty.extend((0..LAYERS).filter(|_| host.random.random_range(0..3) == 0));
        }
        for &layer in &dirty {
            host.draw_layer(gpu, layer);
        }
        host.draw_picture(gpu)?;
        found.layers += dirty.len() as u32;
        let shown = host.shown(gpu, &mut session, &dirty)?;
        if frame % desc.every == 0 {
            let mut fresh = host.session(gpu)?;
            found.compared += 1;
            found.different += u32::from(host.shown(gpu, &mut fresh, &all)? != shown);
        }
        let tenth = (desc.frames / 10).max(1);
        if frame % tenth == 0 {
            found.bytes.extend(resident());
        }
        step();
    }
    Ok(found)
}
