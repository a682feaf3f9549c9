//! The plugin, and what can be set while the application runs.

use bevy::core_pipeline::core_3d::prepare_core_3d_depth_textures;
use bevy::core_pipeline::{Core3d, Core3dSystems};
use bevy::light::DirectionalLightShadowMap;
use bevy::pbr::{ExtendedMaterial, LATE_SHADOW_PASS, per_view_shadow_pass};
use bevy::prelude::*;
use bevy::render::extract_resource::{ExtractResource, ExtractResourcePlugin};
use bevy::render::renderer::{RenderAdapter, RenderDevice};
use bevy::render::{ExtractSchedule, Render, RenderApp, RenderSystems};
use moment_shadows::LeakReduction;
use moment_shadows_graph::{Capabilities, LightSize};

use crate::cameras::{Cameras, prepare_cameras, read_camera_depth};
use crate::compiled::Compiled;
use crate::maps::{Maps, prepare_maps};
use crate::material::{FILTERED_SHADOWS_SHADER, FilteredShadows};
use crate::{node, shaders, warnings};

/// Filters Bevy's shadow maps by a graph. Add it after `DefaultPlugins`.
pub struct MomentShadowsPlugin {
    /// The text of a graph file: what is done. `docs/bevy.md` says which imports and outputs it can have.
    pub graph: String,
    /// The most cameras that show filtered shadows.
    pub cameras: u32,
    /// The most layers of Bevy's shadow map that a camera has: a directional light's cascades, and a layer per spot light.
    pub layers: u32,
}

impl MomentShadowsPlugin {
    /// Filters by a graph, for two cameras with four layers each.
    #[must_use]
    pub fn new(graph: impl Into<String>) -> Self {
        Self {
            graph: graph.into(),
            cameras: 2,
            layers: 4,
        }
    }
}

/// What can be changed while the application runs.
#[derive(Resource, Clone, ExtractResource)]
#[extract_app(RenderApp)]
pub struct MomentShadows {
    /// Whether anything is done. Where not, materials that are extended by [`FilteredShadows`] show no shadow of a directional light,
    /// and Bevy's own of spot lights.
    pub enabled: bool,
    /// The sun's angular diameter, for soft shadows.
    pub sun: LightSize,
    /// How large spot lights are, for soft shadows.
    pub spots: LightSize,
    /// What is done about light leaking.
    pub leak_reduction: LeakReduction,
    /// What is in the air, for graphs with the output `scattering`.
    pub air: Air,
}

impl Default for MomentShadows {
    fn default() -> Self {
        Self {
            enabled: true,
            sun: LightSize::Point,
            spots: LightSize::Point,
            leak_reduction: LeakReduction::DEFAULT,
            air: Air::default(),
        }
    }
}

/// A homogeneous medium, lit by the directional light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Air {
    /// Extinction per metre of red, green and blue light.
    pub extinction: [f32; 3],
    /// Scattering per metre of red, green and blue light.
    pub scattering: [f32; 3],
    /// The asymmetry of the phase function (Henyey & Greenstein), from -0.99 to 0.99.
    pub asymmetry: f32,
    /// Up to which distance along the camera's axis there is air, in metres.
    pub far: f64,
}

impl Default for Air {
    fn default() -> Self {
        Self {
            extinction: [0.02; 3],
            scattering: [0.018; 3],
            asymmetry: 0.5,
            far: 100.0,
        }
    }
}

impl Plugin for MomentShadowsPlugin {
    fn build(&self, app: &mut App) {
        app.init_resource::<MomentShadows>().add_plugins((
            ExtractResourcePlugin::<MomentShadows>::default(),
            MaterialPlugin::<Extended>::default(),
        ));
        app.add_systems(
            Update,
            bind_again.run_if(resource_changed::<DirectionalLightShadowMap>),
        );
        let after_shadows = node::filter
            .after(per_view_shadow_pass::<LATE_SHADOW_PASS>)
            .before(Core3dSystems::MainPass);
        let after_main = node::scatter
            .after(Core3dSystems::MainPass)
            .before(Core3dSystems::EarlyPostProcess);
        let depth = read_camera_depth
            .in_set(RenderSystems::Prepare)
            .before(prepare_core_3d_depth_textures);
        let cameras = prepare_cameras.in_set(RenderSystems::PrepareBindGroups);
        app.sub_app_mut(RenderApp)
            .init_resource::<Cameras>()
            .add_systems(ExtractSchedule, prepare_maps)
            .add_systems(Render, (depth, cameras))
            .add_systems(Core3d, (after_shadows, after_main));
    }

    fn finish(&self, app: &mut App) {
        let render = app.sub_app(RenderApp).world();
        let device = render.resource::<RenderDevice>().wgpu_device();
        let adapter = render.resource::<RenderAdapter>();
        let capabilities = Capabilities::of_device(adapter, device);
        let compiled = Compiled::new(self, capabilities)
            .unwrap_or_else(|error| panic!("the graph of MomentShadowsPlugin: {error}"));
        let mut shaders = app.world_mut().resource_mut::<Assets<Shader>>();
        let handles = shaders::register(&compiled, &mut shaders, FILTERED_SHADOWS_SHADER)
            .unwrap_or_else(|error| panic!("the graph of MomentShadowsPlugin: {error}"));
        app.insert_resource(handles);
        if compiled.map.is_some() {
            app.add_systems(Update, warnings::found.pipe(warnings::say));
        }
        app.sub_app_mut(RenderApp)
            .insert_resource(Maps::new(&compiled))
            .insert_resource(compiled);
    }
}

type Extended = ExtendedMaterial<StandardMaterial, FilteredShadows>;

/// Materials are bound to the maps, which are others when their size changes.
fn bind_again(mut materials: ResMut<Assets<Extended>>) {
    for (_, material) in materials.iter_mut() {
        // To be looked at mutably is to be bound again.
        let _ = &mut *material;
    }
}
