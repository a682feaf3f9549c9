//! The short path: a graph, a device and the host's textures in, shadow intensity out.

mod contacts;
mod cut;
mod given;
mod kernels;
mod marched;
mod part;
mod scratch;
mod seen;
mod shading;

use cut::{Cut, cut};
use given::Given;
use moment_shadows::{
    CameraView, ContactShadows, LeakReduction, LightView, MapEncoding, MarchedAir, ReceiverBias,
    SingleScattering, TextureFormat,
};
use part::{Maker, PARAMETERS, Part};
use scratch::{Scratch, Told};

use crate::record::{
    Bindings, HostPass, HostPassHandler, ImportedResource, PipelineOptions, Pipelines, Recording,
    written,
};
use crate::{Capabilities, Graph, GraphError, GraphErrorKind, Named, ResourceDesc, Stage};

/// A graph at work: pipelines, textures, bindings and uniform data for one set of light maps and any number of cameras.
///
/// The light maps are made once for all cameras, unless their ranges are fitted to what a camera sees. Each camera has textures of its own for what depends on it, of its own
/// size. The receiver bias follows from the kernel of the graph, from each light's texels and from how its depth is stored.
///
/// What a session keeps are the objects of [`crate::record`], which an engine can hold itself. Per frame it creates
/// nothing, submits nothing and waits for nothing.
#[derive(Debug)]
pub struct Session {
    maker: Maker,
    /// The imports as the graph file describes them.
    expected: Vec<Named<Option<ResourceDesc>>>,
    cut: Cut,
    /// The import that is the light's depth map, if one is.
    light_depth: Option<String>,
    /// What all cameras share, unless a camera has its own.
    imports: Vec<Given>,
    maps: Part,
    views: Vec<View>,
    /// How light leaking is reduced after the bound; [`LeakReduction::DEFAULT`] at first.
    pub leak_reduction: LeakReduction,
    /// What is in the air, and up to which distance from the camera it is lit, in scene units: for graphs with single
    /// scattering. Nothing at first.
    pub medium: (SingleScattering, f64),
    /// What marched scattering is told beside that: fog that thins with height, a spot's cone, the number of the frame. A homogeneous
    /// medium at first.
    pub marched: MarchedAir,
    /// How far shadows at contacts reach, in scene units: for graphs with such shadows. For scenes in metres at first.
    pub contact: ContactShadows,
    scratch: Scratch,
}

/// A camera.
#[derive(Debug)]
struct View {
    /// What is its own of the imports.
    imports: Vec<Given>,
    part: Part,
    /// Whether its parameters were ever written.
    placed: bool,
}

impl Session {
    /// Compiles a graph for a device and the host's textures, and makes everything that one camera, number 0, needs.
    ///
    /// Formats, sizes, layers and samples are those of the textures, whatever the graph file says of its imports. How many
    /// regions a layer has is what the file says.
    /// Refused, if the device or the textures do not fit the graph.
    pub async fn new(
        adapter: &wgpu::Adapter,
        device: &wgpu::Device,
        graph: Graph,
        imports: &[(&str, ImportedResource)],
        options: PipelineOptions,
    ) -> Result<Self, GraphError> {
        let capabilities = Capabilities::of_device(adapter, device);
        let expected = graph.imports.clone();
        let imports = given::take(imports, &expected)?;
        let nodes = graph.describe(&capabilities, &given::described(&imports))?;
        let cut = cut(graph, &nodes);
        let lights = cut.light_depths();
        if lights.len() > 1 {
            let names: Vec<&str> = lights.into_iter().collect();
            return Err(unsuitable(
                format!("the imports {}", names.join(", ")),
                "a session has one light map, with a layer or a region per view of a light; use one map with layers, or a \
                 session per map",
            ));
        }
        let light_depth = lights.first().map(|name| (*name).to_owned());
        let mut maker = Maker {
            device: device.clone(),
            capabilities,
            pipelines: Pipelines::default(),
            options,
        };
        let maps = maker.part(&cut.maps, &[&imports]).await?;
        let mut session = Self {
            maker,
            expected,
            cut,
            light_depth,
            imports,
            maps,
            views: Vec::new(),
            leak_reduction: LeakReduction::DEFAULT,
            medium: (SingleScattering::NONE, 1.0),
            marched: MarchedAir::default(),
            contact: ContactShadows::default(),
            scratch: Scratch::default(),
        };
        session.add_view(&[]).await?;
        Ok(session)
    }

    /// Adds a camera and gives its number. Imports that are not given are those of the session.
    /// Refused, if the textures do not fit the graph, or the light maps are made of one of them.
    pub async fn add_view(
        &mut self,
        imports: &[(&str, ImportedResource)],
    ) -> Result<usize, GraphError> {
        let imports = given::take(imports, &self.expected)?;
        if let Some(shared) = imports.iter().find(|given| self.cut.of_maps(&given.name)) {
            return Err(unsuitable(
                format!("import '{}'", shared.name),
                "the light maps of all cameras are made of it; give it to 'replace'",
            ));
        }
        let given: [&[Given]; 3] = [&imports, &self.imports, &self.maps.outputs()];
        let part = self.maker.part(&self.cut.picture, &given).await?;
        self.views.push(View {
            imports,
            part,
            placed: false,
        });
        Ok(self.views.len() - 1)
    }

    /// Takes other textures, as after a resize. Those that light maps are made of are replaced for all cameras, others for
    /// one. Imports that are not given stay. [`view`](Self::view) comes before the next frame.
    /// Refused, if there is no such camera or the textures do not fit the graph. The session is then as before.
    pub async fn replace(
        &mut self,
        view: usize,
        imports: &[(&str, ImportedResource)],
    ) -> Result<(), GraphError> {
        self.checked(view)?;
        let (shared, own): (Vec<_>, Vec<_>) = given::take(imports, &self.expected)?
            .into_iter()
            .partition(|given| self.cut.of_maps(&given.name));
        let own = given::merged(&self.views[view].imports, own);
        let made_anew = !shared.is_empty();
        let shared = given::merged(&self.imports, shared);
        let maps = match made_anew {
            true => Some(self.maker.part(&self.cut.maps, &[&shared]).await?),
            false => None,
        };
        let made = maps.as_ref().unwrap_or(&self.maps).outputs();
        let mut parts = Vec::new();
        for (number, other) in self.views.iter().enumerate() {
            if number == view || made_anew {
                let own = if number == view { &own } else { &other.imports };
                let given: [&[Given]; 3] = [own, &shared, &made];
                parts.push((number, self.maker.part(&self.cut.picture, &given).await?));
            }
        }
        for (number, part) in parts {
            self.views[number].part = part;
            self.views[number].placed = false;
        }
        self.views[view].imports = own;
        self.imports = shared;
        if let Some(maps) = maps {
            self.maps = maps;
        }
        Ok(())
    }

    /// Says where a camera and the lights are, for the frame that is recorded next. The views of lights that share a layer
    /// are its regions, in this order; all cameras have the same lights.
    /// Refused, if there is no such camera, or what is given does not suit the graph: nothing is then written. Natively also, if the
    /// device has no memory for writing it: the camera then has to be placed anew.
    pub fn view(
        &mut self,
        queue: &wgpu::Queue,
        view: usize,
        camera: &CameraView,
        lights: &[LightView],
    ) -> Result<(), GraphError> {
        self.checked(view)?;
        let told = Told {
            camera,
            lights,
            leak_reduction: self.leak_reduction,
            medium: self.medium,
            marched: self.marched,
            contact: self.contact,
            depth_format: self.depth_format(),
            light_depth: self.light_depth.as_deref(),
        };
        let view = &mut self.views[view];
        self.scratch.write(&mut self.maps, &told, true)?;
        self.scratch.write(&mut view.part, &told, false)?;
        let upload = || {
            self.maps.upload(queue);
            view.part.upload(queue);
        };
        let uploaded = written(&self.maker.device, PARAMETERS, upload);
        view.placed = uploaded.is_ok();
        uploaded
    }

    /// Records a stage for the light maps and all cameras. A host that draws one camera after the other records the maps by
    /// the first stage, and each camera by [`record_view`](Self::record_view).
    /// Refused, if a camera was never placed by [`view`](Self::view); the encoder is then as it was.
    pub fn record(
        &self,
        stage: Stage,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<(), GraphError> {
        self.record_all(stage, encoder, Recording::default())
    }

    /// The same for a graph with passes of the host's, such as `translucent_casters`: `draw` is called in their places.
    /// Refused, if a camera was never placed by [`view`](Self::view); the encoder is then as it was.
    pub fn record_with(
        &self,
        stage: Stage,
        encoder: &mut wgpu::CommandEncoder,
        draw: &mut dyn FnMut(HostPass<'_>, &mut wgpu::CommandEncoder),
    ) -> Result<(), GraphError> {
        let recording = Recording {
            host_passes: Some(draw),
            ..Recording::default()
        };
        self.record_all(stage, encoder, recording)
    }

    fn record_all(
        &self,
        stage: Stage,
        encoder: &mut wgpu::CommandEncoder,
        mut recording: Recording<'_>,
    ) -> Result<(), GraphError> {
        (0..self.views.len()).try_for_each(|view| self.placed(view).map(|_| ()))?;
        let parts = core::iter::once(&self.maps).chain(self.views.iter().map(|view| &view.part));
        for part in parts {
            let host_passes = recording.host_passes.as_deref_mut();
            let of_part = Recording {
                host_passes: host_passes.map(|draw| draw as HostPassHandler<'_>),
                ..Recording::default()
            };
            part.bindings.record(stage, encoder, of_part)?;
        }
        Ok(())
    }

    /// Records a stage for one camera, without the light maps.
    /// Refused, if there is no such camera or it was never placed; the encoder is then as it was.
    pub fn record_view(
        &self,
        view: usize,
        stage: Stage,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<(), GraphError> {
        let bindings = &self.placed(view)?.part.bindings;
        bindings.record(stage, encoder, Recording::default())
    }

    /// The texture behind an output of the graph, for a camera.
    #[must_use]
    pub fn output(&self, view: usize, name: &str) -> Option<&wgpu::Texture> {
        let of_view = self.views.get(view)?.part.bindings.output(name);
        of_view.or_else(|| self.maps.bindings.output(name))
    }

    /// How the map behind an output of the graph is encoded, where it is one that all cameras share: what a host's own shaders and
    /// blend states follow from.
    #[must_use]
    pub fn encoding(&self, output: &str) -> Option<&MapEncoding> {
        self.maps.plan.output_texture(output)?.encoding.as_ref()
    }

    /// The receiver bias of a view of a light whose map is an output of the graph, for shaders of your own.
    /// Refused, if there is no such output.
    pub fn receiver_bias(
        &self,
        output: &str,
        light: &LightView,
    ) -> Result<ReceiverBias, GraphError> {
        let map = self.maps.plan.output_texture(output).ok_or_else(|| {
            unsuitable(
                format!("output '{output}'"),
                "it is no map that the graph makes; name one of the graph's outputs",
            )
        })?;
        shading::receiver_bias(map, light, self.depth_format())
    }

    /// How the light's depth is stored.
    fn depth_format(&self) -> Option<TextureFormat> {
        let name = self.light_depth.as_ref()?;
        let given = self.imports.iter().find(|given| given.name == *name)?;
        Some(given.desc.texture()?.format)
    }

    /// The bound plan of the light maps, to record some layers or passes of it alone.
    #[must_use]
    pub fn maps(&self) -> &Bindings {
        &self.maps.bindings
    }

    /// The bound plan of a camera, to draw its last pass into a render pass of the host.
    #[must_use]
    pub fn bindings(&self, view: usize) -> Option<&Bindings> {
        Some(&self.views.get(view)?.part.bindings)
    }

    fn checked(&self, view: usize) -> Result<&View, GraphError> {
        self.views.get(view).ok_or_else(|| {
            let reason = format!("the session has {}, counted from 0", self.views.len());
            unsuitable(format!("camera {view}"), reason)
        })
    }

    fn placed(&self, view: usize) -> Result<&View, GraphError> {
        let checked = self.checked(view)?;
        if checked.placed {
            return Ok(checked);
        }
        let reason = "it was not placed since its textures were made; call 'view' before the frame";
        Err(unsuitable(format!("camera {view}"), reason))
    }
}

/// What cannot be used, what is wrong with it, and what would be right.
fn unsuitable(what: impl core::fmt::Display, reason: impl core::fmt::Display) -> GraphError {
    GraphError::new(GraphErrorKind::Parameters, format!("{what}: {reason}"))
}
