//! A graph on a frame: compiled for what the host has drawn, recorded, and read back.

use moment_shadows::{
    Border, CameraView, ContactShadowParameters, ContactShadows, DepthRange, LeakReduction,
    LightDepth, LightSize, LightView, MapRegion, ReceiverBias, ScatteringParameters, Technique,
    TextureFormat, ViewParameters,
};
use moment_shadows_graph::record::{
    Bindings, ImportedResource, PipelineOptions, Pipelines, Recording, Resources,
};
use moment_shadows_graph::{Capabilities, Plan, ResourceDesc, Stage, TextureDesc};
use pollster::block_on;

use crate::error::LabError;
use crate::frame::{Frame, FrameDesc};
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::light::{LightShape, StoredDepth};
use crate::scattering::Air;

/// The output that the lab shades with.
const SHADOW_INTENSITY: &str = "shadow_intensity";

/// The half widths in texels that soft shadows keep to: a texel at contacts, and whatever the light's size asks
/// for elsewhere.
const SOFT_RADII: std::ops::RangeInclusive<f64> = 1.0..=4096.0;

/// Moment depth by which receivers of percentage closer soft shadows are moved further towards the light. A search that
/// takes the receiver itself for a blocker narrows its penumbra, and rasterisers round the camera's depth by some 2^-24 of
/// the nearest depth of a triangle: on a ground plane that reaches to the camera, that is much for what lies far away.
const SOFT_BIAS: f32 = 2e-4;

/// A graph that is bound to a frame.
pub struct GraphFrame {
    /// The compiled graph.
    pub plan: Plan,
    /// The bound plan.
    pub bindings: Bindings,
    pipelines: Pipelines,
    resources: Resources,
    parameters: wgpu::Buffer,
    /// Recordings until what is kept from frame to frame has settled.
    frames: u32,
}

impl GraphFrame {
    /// Compiles the graph for the frame's textures, creates what it needs and fills in its parameters.
    pub fn new(gpu: &Gpu, frame: &Frame, file: &GraphFile) -> Result<Self, LabError> {
        Self::in_air(gpu, frame, file, None)
    }

    /// Compiles the graph as [`new`](Self::new) does, with something in the air for nodes that light it.
    pub fn in_air(
        gpu: &Gpu,
        frame: &Frame,
        file: &GraphFile,
        air: Option<&Air>,
    ) -> Result<Self, LabError> {
        let desc = &frame.desc;
        let capabilities = Capabilities::of_device(&gpu.adapter, &gpu.device);
        let plan = file
            .graph
            .compile(&capabilities, &imports(desc)?)
            .map_err(LabError::graph(&file.name))?;
        let pipelines = block_on(Pipelines::create(
            &gpu.device,
            &plan,
            PipelineOptions::default(),
        ))?;
        let resources = block_on(Resources::create(&gpu.device, &plan))?;
        let parameters = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("lab/parameters"),
            size: u64::from(plan.parameters.size.max(16)),
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let bindings = bind(gpu, frame, &plan, (&pipelines, &resources), &parameters)?;
        let graph = Self {
            plan,
            bindings,
            pipelines,
            resources,
            parameters,
            frames: file.frames(),
        };
        graph.fill(gpu, desc, file, air)?;
        Ok(graph)
    }

    /// Binds the graph to another frame with textures of the same sizes and formats, and fills in its parameters.
    pub fn rebind(&mut self, gpu: &Gpu, frame: &Frame, file: &GraphFile) -> Result<(), LabError> {
        let made = (&self.pipelines, &self.resources);
        self.bindings = bind(gpu, frame, &self.plan, made, &self.parameters)?;
        self.fill(gpu, &frame.desc, file, None)
    }

    /// Fills in the parameters for a light and a camera.
    pub fn fill(
        &self,
        gpu: &Gpu,
        desc: &FrameDesc,
        file: &GraphFile,
        air: Option<&Air>,
    ) -> Result<(), LabError> {
        let bytes = parameter_bytes(&self.plan, desc, file, air)?;
        self.write(gpu, &bytes);
        Ok(())
    }

    /// Fills in the parameters, with another receiver bias than the one that follows from the graph.
    pub fn fill_biased(
        &self,
        gpu: &Gpu,
        desc: &FrameDesc,
        file: &GraphFile,
        bias: ReceiverBias,
    ) -> Result<(), LabError> {
        let mut bytes = parameter_bytes(&self.plan, desc, file, None)?;
        let parameters = ViewParameters {
            receiver_bias: bias,
            ..shade_parameters(desc, file)?
        };
        let blocks = &self.plan.parameters;
        let of_views = |name: &str| name == "ViewParameters";
        for block in blocks.blocks.iter().filter(|it| of_views(&it.name)) {
            blocks.write(&mut bytes, &block.node, 0, &parameters)?;
        }
        self.write(gpu, &bytes);
        Ok(())
    }

    /// Fills in the parameters, with another reach of shadows at contacts than the usual one.
    pub fn fill_contacts(
        &self,
        gpu: &Gpu,
        desc: &FrameDesc,
        file: &GraphFile,
        contact: ContactShadows,
    ) -> Result<(), LabError> {
        let mut bytes = parameter_bytes(&self.plan, desc, file, None)?;
        let blocks = &self.plan.parameters;
        let parameters =
            ContactShadowParameters::new(&camera_view(desc)?, &light_view(desc), contact)?;
        let of_contacts = |name: &str| name == "ContactShadowParameters";
        for block in blocks.blocks.iter().filter(|it| of_contacts(&it.name)) {
            blocks.write(&mut bytes, &block.node, 0, &parameters)?;
        }
        self.write(gpu, &bytes);
        Ok(())
    }

    /// Writes parameters that were filled in otherwise.
    pub fn write(&self, gpu: &Gpu, bytes: &[u8]) {
        gpu.queue.write_buffer(&self.parameters, 0, bytes);
    }

    /// Records all stages and submits them, until what is kept from frame to frame has settled.
    pub fn run(&self, gpu: &Gpu) -> Result<(), LabError> {
        for _ in 0..self.frames {
            self.run_once(gpu)?;
        }
        Ok(())
    }

    fn run_once(&self, gpu: &Gpu) -> Result<(), LabError> {
        let mut encoder = gpu
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor {
                label: Some("lab/graph"),
            });
        for stage in Stage::ALL {
            self.bindings
                .record(stage, &mut encoder, Recording::default())?;
        }
        gpu.queue.submit([encoder.finish()]);
        gpu.check()
    }

    /// The shadow intensity that the graph gives.
    pub fn shadow(&self, file: &GraphFile) -> Result<&wgpu::Texture, LabError> {
        self.bindings.output(SHADOW_INTENSITY).ok_or_else(|| {
            LabError::unsuitable(&file.name, format!("it has no output '{SHADOW_INTENSITY}'"))
        })
    }

    /// What another output with one channel of shadow intensity holds, the top row first.
    pub fn read_output(
        &self,
        gpu: &Gpu,
        file: &GraphFile,
        name: &str,
    ) -> Result<Vec<f32>, LabError> {
        let output = self.bindings.output(name).ok_or_else(|| {
            LabError::unsuitable(&file.name, format!("it has no output '{name}'"))
        })?;
        read_intensity(gpu, output)
    }

    /// The shadow intensity per pixel, the top row first.
    pub fn read_shadow(&self, gpu: &Gpu, file: &GraphFile) -> Result<Vec<f32>, LabError> {
        read_intensity(gpu, self.shadow(file)?)
    }
}

fn bind(
    gpu: &Gpu,
    frame: &Frame,
    plan: &Plan,
    (pipelines, resources): (&Pipelines, &Resources),
    parameters: &wgpu::Buffer,
) -> Result<Bindings, LabError> {
    let imports = [
        (
            "light_depth",
            ImportedResource::from(&frame.light_map.texture),
        ),
        ("camera_depth", ImportedResource::from(frame.camera_depth())),
    ];
    Ok(block_on(Bindings::create(
        &gpu.device,
        plan,
        pipelines,
        resources,
        &imports,
        Some(parameters),
    ))?)
}

/// What a texture with one channel of shadow intensity holds, the top row first.
pub fn read_intensity(gpu: &Gpu, texture: &wgpu::Texture) -> Result<Vec<f32>, LabError> {
    let bytes = gpu.read_texture(texture, 0, SHADOW_INTENSITY)?;
    match texture.format() {
        wgpu::TextureFormat::R8Unorm => {
            Ok(bytes.iter().map(|&byte| f32::from(byte) / 255.0).collect())
        }
        wgpu::TextureFormat::R16Float => Ok(bytes
            .chunks_exact(2)
            .map(|pair| half::f16::from_le_bytes([pair[0], pair[1]]).to_f32())
            .collect()),
        wgpu::TextureFormat::R32Float => Ok(bytemuck::pod_collect_to_vec(&bytes)),
        other => Err(LabError::unsuitable(
            SHADOW_INTENSITY,
            format!("its format is {other:?}; the lab reads r8unorm, r16float and r32float"),
        )),
    }
}

/// A format of depth in the library's terms.
fn stored_format(format: wgpu::TextureFormat) -> Result<TextureFormat, LabError> {
    let mut all = TextureFormat::ALL.into_iter();
    let found = all.find(|&it| TextureDesc::new(it, [1, 1]).wgpu_format() == format);
    found.ok_or_else(|| LabError::unsuitable("a depth map", format!("no node reads {format:?}")))
}

/// What the host gives, described for the compiler.
pub fn imports(desc: &FrameDesc) -> Result<[(&'static str, ResourceDesc); 2], LabError> {
    let texture = |format, samples, size| {
        Ok::<_, LabError>(ResourceDesc::Texture(TextureDesc {
            samples,
            ..TextureDesc::new(stored_format(format)?, size)
        }))
    };
    let (format, samples) = desc.camera_depth;
    Ok([
        ("light_depth", texture(desc.format, desc.samples, desc.map)?),
        ("camera_depth", texture(format, samples, desc.picture)?),
    ])
}

/// The parameters of the library's nodes for a frame, with something in the air or nothing, as the plan lays them out.
pub fn parameter_bytes(
    plan: &Plan,
    desc: &FrameDesc,
    file: &GraphFile,
    air: Option<&Air>,
) -> Result<Vec<u8>, LabError> {
    let air = air
        .map(|air| scattering_parameters(desc, air))
        .transpose()?;
    let blocks = &plan.parameters;
    let mut bytes = blocks.initial();
    for block in &blocks.blocks {
        let (into, node) = (&mut bytes, &block.node);
        match (block.name.as_str(), &air) {
            ("DepthConversion", _) => {
                blocks.write(into, node, 0, &light_view(desc).depth.conversion()?)?;
            }
            ("ViewParameters", _) => blocks.write(into, node, 0, &shade_parameters(desc, file)?)?,
            ("ContactShadowParameters", _) => {
                let (camera, contact) = (camera_view(desc)?, ContactShadows::default());
                let parameters = ContactShadowParameters::new(&camera, &light_view(desc), contact)?;
                blocks.write(into, node, 0, &parameters)?;
            }
            ("RectifyMomentsParameters", Some(air)) => blocks.write(into, node, 0, &air.rectify)?,
            ("IntegrateScatteringParameters", Some(air)) => {
                blocks.write(into, node, 0, &air.integrate)?;
            }
            ("CompositeScatteringParameters", Some(air)) => {
                blocks.write(into, node, 0, &air.composite)?;
            }
            // They begin as the graph says: with its kernel, or with nothing in the air.
            (
                "BlurParameters"
                | "RectifyMomentsParameters"
                | "IntegrateScatteringParameters"
                | "CompositeScatteringParameters"
                | "MarchScatteringParameters"
                | "UpsampleScatteringParameters",
                _,
            ) => {}
            (other, _) => {
                let reason = format!("the lab knows no parameters '{other}' of node '{node}'");
                return Err(LabError::unsuitable(&file.name, reason));
            }
        }
    }
    Ok(bytes)
}

/// What the nodes of single scattering are given for a frame.
pub fn scattering_parameters(
    desc: &FrameDesc,
    air: &Air,
) -> Result<ScatteringParameters, LabError> {
    let camera = camera_view(desc)?;
    Ok(ScatteringParameters::new(
        &camera,
        air.far,
        &light_view(desc),
        air.medium,
    )?)
}

/// The camera in the library's terms.
pub fn camera_view(desc: &FrameDesc) -> Result<CameraView, LabError> {
    Ok(CameraView {
        clip_from_world: desc.camera.clip_from_world_columns()?,
        far_depth: 0.0,
    })
}

/// What `shade_hard` is given for a frame.
pub fn shade_parameters(desc: &FrameDesc, file: &GraphFile) -> Result<ViewParameters, LabError> {
    let mut parameters = ViewParameters::new(
        &camera_view(desc)?,
        &light_view(desc),
        receiver_bias(desc, file)?,
        LeakReduction::DEFAULT,
    )?;
    let is_percentage_closer = matches!(file.technique(), Some(Technique::Pcss { .. }));
    if is_percentage_closer || file.has_node("shade_soft") {
        desc.shape.check(desc.light.kind())?;
        parameters.light = light_view(desc).area_light(desc.map, SOFT_RADII)?;
    }
    // Without a size there is nothing to search: the binary test.
    if is_percentage_closer && !desc.shape.is_point() {
        parameters.receiver_bias.constant += SOFT_BIAS;
        parameters.receiver_bias.maximum += SOFT_BIAS;
    }
    Ok(parameters)
}

/// The receiver bias that follows from the graph's kernel and the light: the same rule for all scenes.
pub fn receiver_bias(desc: &FrameDesc, file: &GraphFile) -> Result<ReceiverBias, LabError> {
    let deviation = file
        .kernel()?
        .map_or(0.0, |kernel| kernel.standard_deviation());
    let depth_per_texel = light_view(desc).depth_per_texel(desc.map);
    let bias = ReceiverBias::for_kernel(deviation, depth_per_texel as f32);
    Ok(bias.for_stored_depth(
        stored_format(desc.format)?,
        &light_view(desc).depth.conversion()?,
    ))
}

/// The light in the library's terms.
pub fn light_view(desc: &FrameDesc) -> LightView {
    let [near, far] = desc.light.range;
    let range = DepthRange { near, far };
    LightView {
        clip_from_world: desc.light.clip_from_world().to_cols_array_2d(),
        depth: match desc.light.depth {
            StoredDepth::Orthographic { reversed, .. } => LightDepth::Orthographic { reversed },
            StoredDepth::Perspective {
                near,
                far,
                reversed,
            } => LightDepth::Perspective {
                near,
                far: far.unwrap_or(f64::INFINITY),
                reversed,
                range,
            },
        },
        layer: 0,
        region: MapRegion::WHOLE,
        guard: 0,
        border: Border::Sharp,
        channel: 0,
        size: match desc.shape {
            shape if shape.is_point() => LightSize::Point,
            LightShape::Directional { angular_diameter } => {
                LightSize::AngularDiameter(angular_diameter)
            }
            LightShape::Disk { diameter } => LightSize::Disk(diameter),
            LightShape::Rectangle { size } => LightSize::Rectangle(size),
        },
    }
}
