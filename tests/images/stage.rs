//! A stage: textures and a compiled graph that many scenes, lights and cameras are run through.

use glam::DVec3;
use moment_shadows::Storage;
use moment_shadows_graph::record::{
    Bindings, ImportedResource, PipelineOptions, Pipelines, Recording, Resources,
};
use moment_shadows_graph::{Capabilities, Plan, Stage as GraphStage};
use moment_shadows_lab::command::render::profile_for;
use moment_shadows_lab::frame::FrameDesc;
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::graph_file::GraphFile;
use moment_shadows_lab::graph_frame::{imports, parameter_bytes};
use moment_shadows_lab::host::{
    DepthMap, DepthMapDesc, Model, Renderer, Surface, SurfacePixels, read_gbuffer,
};
use moment_shadows_lab::light::{LightShape, LightView};
use moment_shadows_lab::scene::{Material, Mesh, Scene};
use moment_shadows_lab::view::{Camera, View};
use pollster::block_on;

/// What does not change from scene to scene.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StageDesc {
    pub(crate) storage: Storage,
    pub(crate) radius: u32,
    pub(crate) sigma: f32,
    pub(crate) picture: [u32; 2],
    pub(crate) map: u32,
    pub(crate) samples: u32,
    pub(crate) format: wgpu::TextureFormat,
    pub(crate) reversed: bool,
    /// Whether the blur resolves by itself and rounds inwards.
    pub(crate) blur_resolves: bool,
}

impl StageDesc {
    /// A Gaussian of 9 x 9 taps on a small map of four samples.
    pub(crate) fn new(storage: Storage) -> Self {
        Self {
            storage,
            radius: 4,
            sigma: 2.4,
            picture: [96, 54],
            map: 128,
            samples: 4,
            format: wgpu::TextureFormat::Depth32Float,
            reversed: false,
            blur_resolves: false,
        }
    }

    /// The graph: resolve, blur, shade in single precision.
    pub(crate) fn graph(&self) -> GraphFile {
        let format = match self.format {
            wgpu::TextureFormat::Depth16Unorm => "depth16unorm",
            _ => "depth32float",
        };
        let [width, height] = self.picture;
        let Self {
            storage,
            radius,
            sigma,
            map,
            samples,
            ..
        } = self;
        let text = format!(
            r#"{{
  "version": 2,
  "imports": [
    {{ "name": "light_depth", "texture": {{ "format": "{format}", "size": [{map}, {map}], "samples": {samples} }} }},
    {{ "name": "camera_depth", "texture": {{ "format": "depth32float", "size": [{width}, {height}] }} }}
  ],
  "nodes": [
    {{ "name": "resolve", "type": "resolve", "properties": {{ "storage": "{storage}" }} }},
    {{ "name": "blur", "type": "blur", "properties": {{ "kernel": {{ "radius": {radius}, "sigma": {sigma} }} }} }},
    {{ "name": "shade", "type": "shade_hard", "properties": {{ "format": "r32float" }} }}
  ],
  "edges": [
    {{ "from": "light_depth", "to": "resolve.depth" }},
    {{ "from": "resolve.map", "to": "blur.map" }},
    {{ "from": "blur.blurred", "to": "shade.map" }},
    {{ "from": "camera_depth", "to": "shade.camera_depth" }}
  ],
  "outputs": [ {{ "name": "shadow_intensity", "from": "shade.shadow_intensity" }} ]
}}"#
        );
        let text = if self.blur_resolves {
            resolved_by_the_blur(&text)
        } else {
            text
        };
        GraphFile::parse("stage.json", text, None).unwrap()
    }
}

/// The graph without its node `resolve`, whose blur does that.
fn resolved_by_the_blur(text: &str) -> String {
    let mut file: serde_json::Value = serde_json::from_str(text).unwrap();
    let resolve = file["nodes"].as_array_mut().unwrap().remove(0);
    file["nodes"][0]["properties"]["resolve"] = resolve["properties"].clone();
    file["nodes"][0]["properties"]["rounded_inwards"] = true.into();
    let edges = file["edges"].as_array_mut().unwrap();
    edges.remove(1);
    edges[0]["to"] = "blur.depth".into();
    file.to_string()
}

pub(crate) struct Stage {
    pub(crate) desc: StageDesc,
    pub(crate) gpu: Gpu,
    file: GraphFile,
    renderer: Renderer,
    light_map: DepthMap,
    surface: Surface,
    plan: Plan,
    bindings: Bindings,
    parameters: wgpu::Buffer,
}

impl Stage {
    pub(crate) fn new(desc: StageDesc) -> Self {
        let gpu = Gpu::open(profile_for(Some(desc.storage), desc.samples)).unwrap();
        let file = desc.graph();
        let renderer = Renderer::new(&gpu).unwrap();
        let light_map = renderer
            .depth_map(
                &gpu,
                &DepthMapDesc {
                    size: [desc.map; 2],
                    samples: desc.samples,
                    format: desc.format,
                    reversed: desc.reversed,
                },
            )
            .unwrap();
        let surface = renderer.surface(&gpu, desc.picture).unwrap();
        let capabilities = Capabilities::of_device(&gpu.adapter, &gpu.device);
        // The parameters of a light are not an import.
        let (light, camera) = (any_light(desc.reversed), any_camera());
        let frame = frame_desc(&desc, light, camera);
        let plan = file
            .graph
            .compile(&capabilities, &imports(&frame).unwrap())
            .unwrap();
        let pipelines = block_on(Pipelines::create(
            &gpu.device,
            &plan,
            PipelineOptions::default(),
        ))
        .unwrap();
        let resources = block_on(Resources::create(&gpu.device, &plan)).unwrap();
        let parameters = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("stage/parameters"),
            size: u64::from(plan.parameters.size),
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let bindings = block_on(Bindings::create(
            &gpu.device,
            &plan,
            &pipelines,
            &resources,
            &[
                ("light_depth", ImportedResource::from(&light_map.texture)),
                ("camera_depth", ImportedResource::from(&surface.depth)),
            ],
            Some(&parameters),
        ))
        .unwrap();
        Self {
            desc,
            gpu,
            file,
            renderer,
            light_map,
            surface,
            plan,
            bindings,
            parameters,
        }
    }

    pub(crate) fn upload(&self, scene: &Scene) -> Model {
        self.renderer.upload(&self.gpu, scene).unwrap()
    }

    /// The shadow intensity of every pixel, the top row first.
    pub(crate) fn shadow(&self, model: &Model, light: &LightView, camera: &Camera) -> Vec<f32> {
        let gpu = &self.gpu;
        let frame = frame_desc(&self.desc, *light, *camera);
        let bytes = parameter_bytes(&self.plan, &frame, &self.file, None).unwrap();
        gpu.queue.write_buffer(&self.parameters, 0, &bytes);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.renderer.draw_depth(
            gpu,
            &mut encoder,
            model,
            &self.light_map,
            light.clip_from_world(),
        );
        self.renderer
            .draw_surface(gpu, &mut encoder, model, &self.surface, camera)
            .unwrap();
        for stage in GraphStage::ALL {
            self.bindings
                .record(stage, &mut encoder, Recording::default())
                .unwrap();
        }
        gpu.queue.submit([encoder.finish()]);
        let texture = self.bindings.output("shadow_intensity").unwrap();
        let bytes = gpu.read_texture(texture, 0, "shadow").unwrap();
        gpu.check().unwrap();
        bytemuck::pod_collect_to_vec(&bytes)
    }

    /// What the camera of the last picture saw.
    pub(crate) fn pixels(&self) -> SurfacePixels {
        read_gbuffer(&self.gpu, &self.surface).unwrap()
    }
}

pub(crate) fn frame_desc(desc: &StageDesc, light: LightView, camera: Camera) -> FrameDesc {
    FrameDesc {
        picture: desc.picture,
        map: [desc.map; 2],
        samples: desc.samples,
        format: desc.format,
        camera_depth: (wgpu::TextureFormat::Depth32Float, 1),
        shape: LightShape::usual(&light),
        light,
        camera,
    }
}

fn any_light(reversed: bool) -> LightView {
    LightView::spot(DVec3::Y, DVec3::NEG_Y, 1.0, 0.1, None, [0.1, 1.0], reversed).unwrap()
}

fn any_camera() -> Camera {
    camera_at(DVec3::ONE, DVec3::ZERO)
}

/// A camera of 16 to 9.
pub(crate) fn camera_at(eye: DVec3, target: DVec3) -> Camera {
    Camera {
        eye,
        target,
        vertical_angle: 0.7,
        aspect: 16.0 / 9.0,
        near: 0.01 * (target - eye).length(),
        far: None,
    }
}

/// A scene of flat quadrilaterals, counter-clockwise as seen from their front.
pub(crate) fn scene_of(name: &str, quads: &[[DVec3; 4]]) -> Scene {
    let mut mesh = Mesh::default();
    for corners in quads {
        let first = mesh.positions.len() as u32;
        let normal = (corners[2] - corners[0]).cross(corners[3] - corners[1]);
        for corner in corners {
            mesh.positions.push(corner.as_vec3().to_array());
            mesh.normals
                .push(normal.normalize_or_zero().as_vec3().to_array());
            mesh.uvs.push([0.0; 2]);
        }
        mesh.indices
            .extend([0, 1, 2, 0, 2, 3].map(|corner| first + corner));
    }
    Scene {
        name: name.to_owned(),
        meshes: vec![mesh],
        materials: vec![Material::plain("grey", [0.5; 3])],
        ..Scene::default()
    }
}

/// A viewpoint's camera for the stage's picture.
pub(crate) fn camera_for(view: &View, desc: &StageDesc) -> Camera {
    Camera {
        aspect: f64::from(desc.picture[0]) / f64::from(desc.picture[1]),
        ..view.camera
    }
}

/// The mean absolute difference of two pictures.
pub(crate) fn mean_difference(a: &[f32], b: &[f32]) -> f64 {
    assert_eq!(a.len(), b.len());
    let sum: f64 = a.iter().zip(b).map(|(a, b)| f64::from((a - b).abs())).sum();
    sum / a.len() as f64
}
