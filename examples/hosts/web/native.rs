//! The picture of the page, drawn without a browser: the same shader, corners and graph file, recorded by a `Session` on wgpu.
//!
//! `cargo run --release --example web_page -- FRAME.json...`. A frame is what `check/browser` writes of the page: its picture is written
//! beside it, as FRAME.png. What nodes are told of camera, sun and air is derived here, from matrices.

#[path = "../../renderer/mod.rs"]
mod renderer;

use std::error::Error;
use std::fs;

use moment_shadows::LightSize;
use moment_shadows_graph::{CameraView, Graph, LightView, Session, SingleScattering, Stage};
use pollster::block_on;
use renderer::{Renderer, pass};
use serde::Deserialize;
use wgpu::util::{BufferInitDescriptor, DeviceExt as _};
use wgpu::{CompareFunction, TextureFormat};

const PICTURE: TextureFormat = TextureFormat::Rgba8Unorm;

#[derive(Deserialize)]
struct Frame {
    size: [u32; 2],
    /// Texels along each side of the sun's map, and samples of each.
    map: [u32; 2],
    shader: String,
    vertices: Vec<f32>,
    towards_sun: [f32; 3],
    sun: [f64; 16],
    camera: [f64; 16],
    /// In radians.
    size_of_sun: Option<f64>,
    graph: serde_json::Value,
    air: Option<Air>,
}

#[derive(Deserialize)]
struct Air {
    graph: serde_json::Value,
    far: f64,
    extinction: [f32; 3],
    scattering: [f32; 3],
    anisotropy: f32,
    irradiance: [f32; 3],
}

fn main() -> Result<(), Box<dyn Error>> {
    let yours = Renderer::open()?;
    for file in std::env::args().skip(1) {
        let frame = serde_json::from_str(&fs::read_to_string(&file)?)?;
        draw(&yours, &frame, &file.replace(".json", ".png"))
            .map_err(|error| format!("{file}: {error}"))?;
    }
    Ok(())
}

fn draw(yours: &Renderer, frame: &Frame, out: &str) -> Result<(), Box<dyn Error>> {
    let [side, samples] = frame.map;
    let light_depth = yours.texture([side; 2], samples, TextureFormat::Depth32Float);
    let camera_depth = yours.texture(frame.size, 1, TextureFormat::Depth32Float);
    let picture = yours.texture(frame.size, 1, PICTURE);
    let session = |graph: &serde_json::Value| -> Result<Session, Box<dyn Error>> {
        let graph: Graph = graph.to_string().parse()?;
        let imports = [
            ("light_depth", (&light_depth).into()),
            ("camera_depth", (&camera_depth).into()),
        ];
        let made = Session::new(
            &yours.adapter,
            &yours.device,
            graph,
            &imports,
            Default::default(),
        );
        Ok(block_on(made)?)
    };
    let eye = CameraView {
        clip_from_world: columns(&frame.camera),
        far_depth: 0.0,
    };
    let mut sun = LightView::orthographic(columns(&frame.sun));
    let mut sessions = vec![session(&frame.graph)?];
    if let Some(air) = &frame.air {
        let mut session = session(&air.graph)?;
        let medium = SingleScattering::new(
            air.extinction,
            air.scattering,
            air.anisotropy,
            air.irradiance,
        )?;
        session.medium = (medium, air.far);
        sessions.push(session);
    }
    if let Some(size) = frame.size_of_sun {
        sun.size = LightSize::AngularDiameter(size);
    }
    for session in &mut sessions {
        session.view(&yours.queue, 0, &eye, &[sun])?;
    }

    let scene = Scene::new(yours, frame);
    let mut encoder = yours.device.create_command_encoder(&Default::default());
    scene.depth(
        &mut encoder,
        &frame.sun,
        &light_depth,
        CompareFunction::Less,
    );
    for session in &mut sessions {
        session.record(Stage::AfterShadowMaps, &mut encoder)?;
    }
    scene.depth(
        &mut encoder,
        &frame.camera,
        &camera_depth,
        CompareFunction::Greater,
    );
    for session in &mut sessions {
        session.record(Stage::AfterMainPass, &mut encoder)?;
    }
    let missing = "the graph has no such output";
    let shadow = sessions[0].output(0, "shadow_intensity").ok_or(missing)?;
    let none = yours.texture([1, 1], 1, PICTURE);
    drop(pass(&mut encoder, &[(&none, wgpu::Color::BLACK)], None));
    let air = sessions
        .get(1)
        .map(|session| session.output(0, "scattering").ok_or(missing));
    let air = air.transpose()?.unwrap_or(&none);
    scene.picture(
        &mut encoder,
        &frame.camera,
        [shadow, air],
        &camera_depth,
        &picture,
    );
    yours.save_texture(encoder, &picture, out)
}

fn columns(matrix: &[f64; 16]) -> [[f64; 4]; 4] {
    [0, 4, 8, 12].map(|first| [0, 1, 2, 3].map(|row| matrix[first + row]))
}

/// The page's scene and shader.
struct Scene<'a> {
    yours: &'a Renderer,
    frame: &'a Frame,
    shader: wgpu::ShaderModule,
    vertices: wgpu::Buffer,
}

impl<'a> Scene<'a> {
    fn new(yours: &'a Renderer, frame: &'a Frame) -> Self {
        let shader = yours
            .device
            .create_shader_module(wgpu::ShaderModuleDescriptor {
                label: None,
                source: wgpu::ShaderSource::Wgsl(frame.shader.as_str().into()),
            });
        let vertices = yours.device.create_buffer_init(&BufferInitDescriptor {
            label: None,
            contents: bytemuck::cast_slice(&frame.vertices),
            usage: wgpu::BufferUsages::VERTEX,
        });
        Self {
            yours,
            frame,
            shader,
            vertices,
        }
    }

    fn depth(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        matrix: &[f64; 16],
        depth: &wgpu::Texture,
        compare: CompareFunction,
    ) {
        let pipeline = self.pipeline([Some("depth"), None], depth, compare);
        let far = if compare == CompareFunction::Less {
            1.0
        } else {
            0.0
        };
        let group = self.group(&pipeline, &[(0, self.drawn(matrix).as_entire_binding())]);
        let mut pass = pass(encoder, &[], Some((depth, far)));
        self.draw(&mut pass, &pipeline, &group);
    }

    fn picture(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        matrix: &[f64; 16],
        [shadow, air]: [&wgpu::Texture; 2],
        depth: &wgpu::Texture,
        picture: &wgpu::Texture,
    ) {
        let views = [shadow, air].map(|texture| texture.create_view(&Default::default()));
        let [shadow, air] = views.each_ref().map(wgpu::BindingResource::TextureView);
        let drawn = self.drawn(matrix);
        let lit = self.pipeline(
            [Some("place"), Some("light")],
            depth,
            CompareFunction::Greater,
        );
        let sky = self.pipeline([Some("cover"), Some("sky")], depth, CompareFunction::Equal);
        let of_lit = [
            (0, drawn.as_entire_binding()),
            (1, shadow.clone()),
            (2, shadow),
            (3, air.clone()),
        ];
        let (of_lit, of_sky) = (self.group(&lit, &of_lit), self.group(&sky, &[(3, air)]));
        let mut pass = pass(
            encoder,
            &[(picture, wgpu::Color::BLACK)],
            Some((depth, 0.0)),
        );
        self.draw(&mut pass, &lit, &of_lit);
        pass.set_pipeline(&sky);
        pass.set_bind_group(0, &of_sky, &[]);
        pass.draw(0..3, 0..1);
    }

    /// The shader's struct `Drawn`; the whole picture shows one technique.
    fn drawn(&self, matrix: &[f64; 16]) -> wgpu::Buffer {
        let mut floats = matrix.map(|entry| entry as f32).to_vec();
        floats.extend(self.frame.towards_sun);
        floats.push(self.frame.size[0] as f32);
        self.yours.uniform(bytemuck::cast_slice(&floats))
    }

    fn draw(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        pipeline: &wgpu::RenderPipeline,
        group: &wgpu::BindGroup,
    ) {
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, group, &[]);
        pass.set_vertex_buffer(0, self.vertices.slice(..));
        pass.draw(0..self.frame.vertices.len() as u32 / 9, 0..1);
    }

    fn group(
        &self,
        pipeline: &wgpu::RenderPipeline,
        resources: &[(u32, wgpu::BindingResource<'_>)],
    ) -> wgpu::BindGroup {
        let entries = resources
            .iter()
            .map(|(binding, resource)| wgpu::BindGroupEntry {
                binding: *binding,
                resource: resource.clone(),
            });
        self.yours
            .device
            .create_bind_group(&wgpu::BindGroupDescriptor {
                label: None,
                layout: &pipeline.get_bind_group_layout(0),
                entries: &entries.collect::<Vec<_>>(),
            })
    }

    /// Without a fragment stage it draws depth alone. The sky covers the picture and is behind everything.
    fn pipeline(
        &self,
        [vertex, fragment]: [Option<&str>; 2],
        depth: &wgpu::Texture,
        compare: CompareFunction,
    ) -> wgpu::RenderPipeline {
        let attributes = wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x3];
        let corners = wgpu::VertexBufferLayout {
            array_stride: 36,
            step_mode: wgpu::VertexStepMode::Vertex,
            attributes: &attributes,
        };
        let corners = [Some(corners)];
        let behind = compare == CompareFunction::Equal;
        self.yours
            .device
            .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: None,
                layout: None,
                vertex: wgpu::VertexState {
                    module: &self.shader,
                    entry_point: vertex,
                    compilation_options: Default::default(),
                    buffers: if behind { &[] } else { &corners },
                },
                primitive: wgpu::PrimitiveState {
                    cull_mode: (!behind).then_some(wgpu::Face::Back),
                    ..Default::default()
                },
                depth_stencil: Some(wgpu::DepthStencilState {
                    format: depth.format(),
                    depth_write_enabled: Some(!behind),
                    depth_compare: Some(compare),
                    stencil: Default::default(),
                    bias: Default::default(),
                }),
                multisample: wgpu::MultisampleState {
                    count: depth.sample_count(),
                    ..Default::default()
                },
                fragment: fragment.is_some().then_some(wgpu::FragmentState {
                    module: &self.shader,
                    entry_point: fragment,
                    compilation_options: Default::default(),
                    targets: &[Some(PICTURE.into())],
                }),
                multiview_mask: None,
                cache: None,
            })
    }
}
