//! How the scene is lit and seen.

use bevy::core_pipeline::tonemapping::{DebandDither, Tonemapping};
use bevy::light::{
    CascadeShadowConfigBuilder, DirectionalLightShadowMap, FogVolume, ShadowFilteringMethod,
    VolumetricFog, VolumetricLight,
};
use bevy::pbr::ExtendedMaterial;
use bevy::prelude::*;

use super::scene;
use crate::{Air, FilteredShadows, LightSize, MomentShadows, MomentShadowsPlugin};

/// What is in the air.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fog {
    /// Nothing.
    None,
    /// A medium that the graph's output `scattering` draws.
    Filtered,
    /// The same medium by Bevy's volumetric fog with this many steps.
    Bevys(u32),
}

/// How the scene is lit and seen, and which shadows it has.
#[derive(Clone, Debug)]
pub struct Look {
    /// The text of a graph file; `None` for Bevy's own shadows.
    pub graph: Option<String>,
    /// Whether what the graph does is recorded.
    pub enabled: bool,
    /// Whether lights have shadow maps.
    pub shadows: bool,
    /// Cascades of the sun; 0 for a scene without a sun.
    pub cascades: usize,
    /// Up to which distance from the camera there are shadows of the sun, in metres.
    pub reach: f32,
    /// Whether surfaces are black, so that the air alone is seen.
    pub black: bool,
    /// The sun's angular diameter in radians, for soft shadows.
    pub sun: f64,
    /// Whether there is a spot light.
    pub spot: bool,
    pub fog: Fog,
    /// Where cameras are, and what they look at.
    pub eyes: Vec<[Vec3; 2]>,
    /// Width and height of shadow maps.
    pub map: usize,
    /// Samples per pixel.
    pub msaa: Msaa,
    /// The depth bias in metres and the normal bias in texels of Bevy's own filter of the sun.
    pub bias: [f32; 2],
    /// The same of the spot light.
    pub spot_bias: [f32; 2],
}

/// The medium of both kinds of fog: 4 % of light are lost per metre, nine tenths of it scattered.
const EXTINCTION: f32 = 0.04;
const SCATTERING: f32 = 0.036;
const ASYMMETRY: f32 = 0.3;
/// Half of the side of Bevy's volume of fog, which contains the scene and the cameras.
const FOG_HALF_SIDE: f32 = 60.0;

impl Default for Look {
    fn default() -> Self {
        Self {
            graph: None,
            enabled: true,
            shadows: true,
            cascades: 1,
            reach: 30.0,
            black: false,
            sun: 0.0,
            spot: false,
            fog: Fog::None,
            eyes: vec![Self::EYE],
            map: 1024,
            msaa: Msaa::Off,
            bias: [
                DirectionalLight::DEFAULT_SHADOW_DEPTH_BIAS,
                DirectionalLight::DEFAULT_SHADOW_NORMAL_BIAS,
            ],
            spot_bias: [
                SpotLight::DEFAULT_SHADOW_DEPTH_BIAS,
                SpotLight::DEFAULT_SHADOW_NORMAL_BIAS,
            ],
        }
    }
}

impl Look {
    /// Before the fence.
    pub const EYE: [Vec3; 2] = [Vec3::new(-5.5, 3.2, 8.5), Vec3::new(-0.3, 1.2, -0.5)];
    /// From the other side.
    pub const OTHER_EYE: [Vec3; 2] = [Vec3::new(7.0, 2.2, 5.0), Vec3::new(0.0, 1.2, -1.5)];
}

/// A depth bias that leads out of the shadow map of a directional light: Bevy takes every surface for lit, and looks nothing up.
const BEVY_IS_LIT: f32 = 1e6;

/// Adds the scene, seen by a camera for each target, to an application that has `DefaultPlugins`.
pub fn add_to(app: &mut App, look: &Look, targets: Vec<bevy::camera::RenderTarget>) {
    app.insert_resource(DirectionalLightShadowMap { size: look.map })
        .insert_resource(ClearColor(Color::linear_rgb(0.25, 0.35, 0.5)))
        .insert_resource(bevy::light::GlobalAmbientLight {
            brightness: 250.0,
            ..default()
        });
    if let Some(graph) = &look.graph {
        app.add_plugins(MomentShadowsPlugin::new(graph.clone()));
        app.insert_resource(MomentShadows {
            enabled: look.enabled,
            sun: LightSize::AngularDiameter(look.sun),
            spots: LightSize::Disk(0.2),
            air: Air {
                extinction: [EXTINCTION; 3],
                scattering: [SCATTERING; 3],
                asymmetry: ASYMMETRY,
                far: f64::from(look.reach),
            },
            ..default()
        });
    }
    spawn_bodies(app, look);
    let look = look.clone();
    let world = app.world_mut();
    spawn_lights(&mut world.commands(), &look);
    for (order, (target, [eye, at])) in targets.into_iter().zip(look.eyes).enumerate() {
        let mut camera = world.spawn((
            Camera3d::default(),
            Camera {
                order: order as isize,
                ..default()
            },
            target,
            Transform::from_translation(eye).looking_at(at, Vec3::Y),
            Tonemapping::None,
            DebandDither::Disabled,
            ShadowFilteringMethod::Gaussian,
            look.msaa,
        ));
        if let Fog::Bevys(step_count) = look.fog {
            camera.insert(VolumetricFog {
                ambient_intensity: 0.0,
                step_count,
                ..default()
            });
        }
    }
    world.flush();
}

/// The sun, turned by the tangents of two angles.
#[must_use]
pub fn sun([x, y]: [f32; 2]) -> Transform {
    let straight = Transform::from_xyz(0.45, 0.8, 0.4).looking_at(Vec3::ZERO, Vec3::Y);
    let towards = *straight.back() + x * straight.right() + y * straight.up();
    Transform::from_translation(towards).looking_at(Vec3::ZERO, Vec3::Y)
}

fn spawn_bodies(app: &mut App, look: &Look) {
    let (filtered, black) = (look.graph.is_some(), look.black);
    let tint = move |mut base: StandardMaterial| {
        if black {
            base.base_color = Color::BLACK;
            base.reflectance = 0.0;
        }
        base
    };
    let world = app.world_mut();
    world.resource_scope(|world, mut meshes: Mut<Assets<Mesh>>| {
        world.resource_scope(|world, mut plain: Mut<Assets<StandardMaterial>>| {
            if filtered {
                type Extended = ExtendedMaterial<StandardMaterial, FilteredShadows>;
                world.resource_scope(|world, mut extended: Mut<Assets<Extended>>| {
                    scene::spawn(&mut world.commands(), &mut meshes, &mut |entity, base| {
                        let (base, extension) = (tint(base), FilteredShadows {});
                        let material = extended.add(ExtendedMaterial { base, extension });
                        entity.insert(MeshMaterial3d(material));
                    });
                });
            } else {
                scene::spawn(&mut world.commands(), &mut meshes, &mut |entity, base| {
                    entity.insert(MeshMaterial3d(plain.add(tint(base))));
                });
            }
        });
    });
    world.flush();
}

fn spawn_lights(commands: &mut Commands, look: &Look) {
    if look.cascades > 0 {
        let cascades = CascadeShadowConfigBuilder {
            num_cascades: look.cascades,
            minimum_distance: 0.1,
            maximum_distance: look.reach,
            first_cascade_far_bound: 9.0,
            ..default()
        };
        commands.spawn((
            DirectionalLight {
                illuminance: 3500.0,
                shadow_maps_enabled: look.shadows,
                shadow_depth_bias: if look.graph.is_some() {
                    BEVY_IS_LIT
                } else {
                    look.bias[0]
                },
                shadow_normal_bias: look.bias[1],
                ..default()
            },
            sun([0.0; 2]),
            cascades.build(),
            VolumetricLight,
        ));
    }
    if look.spot {
        commands.spawn((
            SpotLight {
                intensity: 4e6,
                range: 30.0,
                outer_angle: 0.6,
                inner_angle: 0.5,
                shadow_maps_enabled: look.shadows,
                shadow_depth_bias: look.spot_bias[0],
                shadow_normal_bias: look.spot_bias[1],
                ..default()
            },
            Transform::from_xyz(3.5, 8.0, 7.5).looking_at(Vec3::new(-1.0, 0.5, 0.5), Vec3::Y),
        ));
    }
    if let Fog::Bevys(_) = look.fog {
        commands.spawn((
            FogVolume {
                fog_color: Color::WHITE,
                // Bevy attenuates the sun's light once for the whole volume by this much; taken back here.
                light_intensity: (EXTINCTION * FOG_HALF_SIDE * 3f32.sqrt()).exp(),
                density_factor: 1.0,
                absorption: EXTINCTION - SCATTERING,
                scattering: SCATTERING,
                scattering_asymmetry: ASYMMETRY,
                ..default()
            },
            Transform::from_scale(Vec3::splat(2.0 * FOG_HALF_SIDE)),
        ));
    }
}
