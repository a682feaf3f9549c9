//! A small renderer that stands in for yours: boxes with depth maps from anywhere, and a picture that is lit with shadow
//! intensity. Nothing in here belongs to the library.
#![allow(dead_code, reason = "each example uses a part of it")]

mod boxes;
mod pass;
mod trace;

use std::error::Error;
use std::path::Path;

use glam::dcamera::rh::proj::directx::{orthographic, perspective, perspective_infinite_reverse};
use glam::dcamera::rh::view::look_at_mat4;
use glam::{DMat4, DVec3};
use moment_shadows::LightView;
pub(crate) use pass::pass;
use pollster::block_on;
use wgpu::util::DeviceExt as _;

pub(crate) type Matrix = [[f64; 4]; 4];

/// What is seen where there is no surface.
pub(crate) const SKY: wgpu::Color = wgpu::Color {
    r: 0.25,
    g: 0.45,
    b: 0.8,
    a: 1.0,
};

/// The format of linear colours in between.
const COLOUR: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

pub(crate) struct Renderer {
    pub(crate) adapter: wgpu::Adapter,
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    shader: wgpu::ShaderModule,
    boxes: wgpu::Buffer,
    count: u32,
}

/// What the camera sees, without shadows.
pub(crate) struct Picture {
    pub(crate) depth: wgpu::Texture,
    ambient: wgpu::Texture,
    direct: wgpu::Texture,
    lit: wgpu::Texture,
}

impl Picture {
    /// The lit picture, to draw to.
    pub(crate) fn lit_view(&self) -> wgpu::TextureView {
        self.lit.create_view(&Default::default())
    }
}

/// A sun from `towards`, whose map covers the colonnade: 0 is stored at the near plane.
pub(crate) fn sun(towards: [f64; 3]) -> Matrix {
    let towards = DVec3::from(towards).normalize();
    let centre = DVec3::new(0.0, 1.4, -0.8);
    let view = look_at_mat4(centre + 8.0 * towards, centre, DVec3::Y);
    (orthographic(-6.5, 6.5, -6.5, 6.5, 0.0, 16.0) * view).to_cols_array_2d()
}

/// A lamp at `eye` with planes at `near` and `far`, which shines on the middle of the floor.
pub(crate) fn lamp(eye: [f64; 3], near: f64, far: f64) -> Matrix {
    let view = look_at_mat4(DVec3::from(eye), DVec3::ZERO, DVec3::Y);
    (perspective(1.6, 1.0, near, far) * view).to_cols_array_2d()
}

/// A camera at `eye` with reversed, infinite depth.
pub(crate) fn camera(eye: [f64; 3], target: [f64; 3], size: [u32; 2]) -> Matrix {
    let aspect = f64::from(size[0]) / f64::from(size[1]);
    let view = look_at_mat4(DVec3::from(eye), DVec3::from(target), DVec3::Y);
    (perspective_infinite_reverse(0.8, aspect, 0.1) * view).to_cols_array_2d()
}

impl Renderer {
    /// A device with what the adapter has of what the library can use: 16-bit normalised formats, for maps that leak least.
    pub(crate) fn open() -> Result<Self, Box<dyn Error>> {
        let instance = wgpu::Instance::default();
        let adapter = block_on(instance.request_adapter(&Default::default()))?;
        let wanted = wgpu::Features::TEXTURE_FORMAT_16BIT_NORM | wgpu::Features::FLOAT32_FILTERABLE;
        let (device, queue) = block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            required_features: adapter.features() & wanted,
            ..Default::default()
        }))?;
        let shader = device.create_shader_module(wgpu::include_wgsl!("renderer.wgsl"));
        let boxes = boxes::boxes();
        Ok(Self {
            shader,
            count: boxes.len() as u32,
            boxes: device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: None,
                contents: bytemuck::cast_slice(&boxes),
                usage: wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::STORAGE,
            }),
            adapter,
            device,
            queue,
        })
    }

    pub(crate) fn texture(
        &self,
        size: [u32; 2],
        samples: u32,
        format: wgpu::TextureFormat,
    ) -> wgpu::Texture {
        let mut usage =
            wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
        usage.set(wgpu::TextureUsages::COPY_SRC, samples == 1);
        self.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d {
                width: size[0],
                height: size[1],
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: samples,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage,
            view_formats: &[],
        })
    }

    /// A light's depth map: four samples per texel.
    pub(crate) fn light_depth(&self, side: u32) -> wgpu::Texture {
        self.texture([side, side], 4, wgpu::TextureFormat::Depth32Float)
    }

    pub(crate) fn picture(&self, size: [u32; 2]) -> Picture {
        Picture {
            depth: self.texture(size, 1, wgpu::TextureFormat::Depth32Float),
            ambient: self.texture(size, 1, COLOUR),
            direct: self.texture(size, 1, COLOUR),
            lit: self.texture(size, 1, wgpu::TextureFormat::Rgba8UnormSrgb),
        }
    }

    /// The light's own pass: depth alone, 1 where nothing is.
    pub(crate) fn draw_light(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        light: &Matrix,
        depth: &wgpu::Texture,
    ) {
        self.draw_views(encoder, &[LightView::orthographic(*light)], depth);
    }

    /// The same of several views, each in its region of the map.
    pub(crate) fn draw_views(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        views: &[LightView],
        depth: &wgpu::Texture,
    ) {
        let compare = Some(wgpu::CompareFunction::Less);
        let entries = ["draw", "surface"];
        let pipeline = self.pipeline(&self.shader, entries, &[], compare, depth.sample_count());
        let mut pass = pass(encoder, &[], Some((depth, 1.0)));
        pass.set_pipeline(&pipeline);
        for view in views {
            let [x, y] = view.region.origin;
            let [width, height] = view.region.extent;
            let [width, height] = [width.min(depth.width()), height.min(depth.height())];
            let frame = self.frame(&view.clip_from_world, [0.0; 4]);
            let group = self.group(&pipeline, 0, &[frame.as_entire_binding()]);
            pass.set_viewport(x as f32, y as f32, width as f32, height as f32, 0.0, 1.0);
            pass.set_scissor_rect(x, y, width, height);
            pass.set_bind_group(0, &group, &[]);
            self.draw_boxes(&mut pass);
        }
    }

    /// The main pass: depth and colours, 0 where nothing is. `light` is the direction towards a sun and 0, or a lamp's
    /// position and 1.
    pub(crate) fn draw_camera(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        camera: &Matrix,
        light: [f32; 4],
        picture: &Picture,
    ) {
        let frame = self.frame(camera, light);
        let colours = [
            (&picture.ambient, SKY),
            (&picture.direct, wgpu::Color::BLACK),
        ];
        let formats = colours.map(|(colour, _)| colour.format());
        let compare = Some(wgpu::CompareFunction::Greater);
        let entries = ["draw", "surface"];
        let pipeline = self.pipeline(&self.shader, entries, &formats, compare, 1);
        let group = self.group(&pipeline, 0, &[frame.as_entire_binding()]);
        let mut pass = pass(encoder, &colours, Some((&picture.depth, 0.0)));
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        self.draw_boxes(&mut pass);
    }

    /// Lights the picture with shadow intensity, and with what the air scatters where that is given.
    pub(crate) fn light(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        picture: &Picture,
        shadow: &wgpu::Texture,
        scattering: Option<&wgpu::Texture>,
    ) {
        // Without air: no radiance, and all of the surface is seen.
        let clear = self.texture([picture.lit.width(), picture.lit.height()], 1, COLOUR);
        if scattering.is_none() {
            drop(pass(encoder, &[(&clear, wgpu::Color::BLACK)], None));
        }
        let pipeline = self.pipeline(
            &self.shader,
            ["cover", "light"],
            &[picture.lit.format()],
            None,
            1,
        );
        let textures = [
            &picture.ambient,
            &picture.direct,
            shadow,
            scattering.unwrap_or(&clear),
        ];
        let views = textures.map(|texture| texture.create_view(&Default::default()));
        let resources = views.each_ref().map(wgpu::BindingResource::TextureView);
        let group = self.group(&pipeline, 0, &resources);
        let mut pass = pass(encoder, &[(&picture.lit, wgpu::Color::BLACK)], None);
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.draw(0..3, 0..1);
    }

    /// Submits and writes the lit picture to a file.
    pub(crate) fn save(
        &self,
        encoder: wgpu::CommandEncoder,
        picture: &Picture,
        file: &str,
    ) -> Result<(), Box<dyn Error>> {
        self.save_texture(encoder, &picture.lit, file)
    }

    pub(crate) fn save_texture(
        &self,
        mut encoder: wgpu::CommandEncoder,
        texture: &wgpu::Texture,
        file: &str,
    ) -> Result<(), Box<dyn Error>> {
        let (width, height) = (texture.width(), texture.height());
        let stride = (4 * width).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: u64::from(stride * height),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(stride),
            rows_per_image: None,
        };
        encoder.copy_texture_to_buffer(
            texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout,
            },
            texture.size(),
        );
        self.queue.submit([encoder.finish()]);
        buffer.slice(..).map_async(wgpu::MapMode::Read, |_| ());
        self.device.poll(wgpu::PollType::wait_indefinitely())?;
        let mapped = buffer.slice(..).get_mapped_range()?;
        let rows = mapped.chunks_exact(stride as usize);
        let pixels: Vec<u8> = rows
            .flat_map(|row| row[..4 * width as usize].to_vec())
            .collect();
        if let Some(folder) = Path::new(file).parent() {
            std::fs::create_dir_all(folder)?;
        }
        image::save_buffer(file, &pixels, width, height, image::ColorType::Rgba8)?;
        println!("{file}");
        Ok(())
    }

    /// Draws all boxes with a pipeline that takes them, and group 0 of what it is given.
    pub(crate) fn draw_boxes(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_vertex_buffer(0, self.boxes.slice(..));
        pass.draw(0..36, 0..self.count);
    }

    /// A uniform buffer.
    pub(crate) fn uniform(&self, contents: &[u8]) -> wgpu::Buffer {
        self.buffer(contents, wgpu::BufferUsages::UNIFORM)
    }

    /// A buffer of an array.
    pub(crate) fn storage(&self, contents: &[u8]) -> wgpu::Buffer {
        self.buffer(contents, wgpu::BufferUsages::STORAGE)
    }

    fn buffer(&self, contents: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
        self.device
            .create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: None,
                contents,
                usage,
            })
    }

    pub(crate) fn group(
        &self,
        pipeline: &wgpu::RenderPipeline,
        index: u32,
        resources: &[wgpu::BindingResource<'_>],
    ) -> wgpu::BindGroup {
        let entries: Vec<_> = (0..)
            .zip(resources)
            .map(|(binding, resource)| wgpu::BindGroupEntry {
                binding,
                resource: resource.clone(),
            })
            .collect();
        self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pipeline.get_bind_group_layout(index),
            entries: &entries,
        })
    }

    fn frame(&self, clip_from_world: &Matrix, light: [f32; 4]) -> wgpu::Buffer {
        let matrix = DMat4::from_cols_array_2d(clip_from_world).as_mat4();
        let columns = matrix.to_cols_array_2d();
        self.uniform(bytemuck::cast_slice(&[
            columns[0], columns[1], columns[2], columns[3], light,
        ]))
    }

    /// A pipeline with the vertex and fragment entry points of a shader. With a depth test it draws boxes.
    pub(crate) fn pipeline(
        &self,
        shader: &wgpu::ShaderModule,
        [vertex, fragment]: [&str; 2],
        colours: &[wgpu::TextureFormat],
        depth: Option<wgpu::CompareFunction>,
        samples: u32,
    ) -> wgpu::RenderPipeline {
        let targets: Vec<_> = colours.iter().map(|&format| Some(format.into())).collect();
        let attributes = wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x3];
        let boxes = Some(wgpu::VertexBufferLayout {
            array_stride: 36,
            step_mode: wgpu::VertexStepMode::Instance,
            attributes: &attributes,
        });
        let buffers: &[_] = if depth.is_some() { &[boxes] } else { &[] };
        self.device
            .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: None,
                layout: None,
                vertex: wgpu::VertexState {
                    module: shader,
                    entry_point: Some(vertex),
                    compilation_options: Default::default(),
                    buffers,
                },
                primitive: wgpu::PrimitiveState::default(),
                depth_stencil: depth.map(|compare| wgpu::DepthStencilState {
                    format: wgpu::TextureFormat::Depth32Float,
                    depth_write_enabled: Some(true),
                    depth_compare: Some(compare),
                    stencil: Default::default(),
                    bias: Default::default(),
                }),
                multisample: wgpu::MultisampleState {
                    count: samples,
                    ..Default::default()
                },
                fragment: (!targets.is_empty()).then_some(wgpu::FragmentState {
                    module: shader,
                    entry_point: Some(fragment),
                    compilation_options: Default::default(),
                    targets: &targets,
                }),
                multiview_mask: None,
                cache: None,
            })
    }
}
