//! A session for each of Bevy's cameras, and what is said to it before every frame.

use std::collections::HashMap;

use bevy::pbr::{ExtractedDirectionalLight, ViewLightEntities, ViewShadowBindings};
use bevy::prelude::*;
use bevy::render::camera::ExtractedCamera;
use bevy::render::renderer::{RenderAdapter, RenderDevice, RenderQueue};
use bevy::render::view::{ExtractedView, ViewDepthStencilTexture, ViewTarget};
use moment_shadows::{AreaLight, SingleScattering};
use moment_shadows_graph::record::{HostTarget, ImportedResource, PipelineOptions};
use moment_shadows_graph::{CameraView, GraphError, LightView, Session};
use pollster::block_on;

use crate::MomentShadows;
use crate::compiled::{CAMERA_DEPTH, Compiled, LIGHT_DEPTH, SHADOW_MAP, unsuitable};
use crate::lights::{Lights, Seen, clip_from_world};
use crate::maps::Maps;
use crate::table::{ShadowCamera, ShadowView};

/// The cameras that there are, by their entities in the render world.
#[derive(Resource, Default)]
pub(crate) struct Cameras(pub(crate) HashMap<Entity, Camera>);

/// A camera of Bevy's.
pub(crate) struct Camera {
    pub(crate) session: Session,
    /// Its place in the filtered map and in the table.
    pub(crate) slot: u32,
    /// Whether it sees a light of which there is a map.
    pub(crate) lit: bool,
    light_depth: wgpu::Texture,
    camera_depth: Option<wgpu::Texture>,
    target: wgpu::TextureFormat,
}

type View = (
    Entity,
    &'static ViewShadowBindings,
    &'static ViewLightEntities,
    &'static ExtractedView,
    &'static ExtractedCamera,
    &'static ViewTarget,
    Option<&'static ViewDepthStencilTexture>,
);

/// What a camera draws into and reads.
struct Given {
    light_depth: wgpu::Texture,
    camera_depth: Option<wgpu::Texture>,
    target: wgpu::TextureFormat,
}

/// Lets what draws the air read the depth that the main pass has drawn.
pub(crate) fn read_camera_depth(compiled: Res<Compiled>, mut cameras: Query<&mut Camera3d>) {
    if compiled.imports(CAMERA_DEPTH) {
        for mut camera in &mut cameras {
            camera.depth_texture_usages.0 |= wgpu::TextureUsages::TEXTURE_BINDING.bits();
        }
    }
}

/// Makes a session for each new camera, tells all of them where they and the lights are, and writes the table.
#[allow(clippy::too_many_arguments)]
pub(crate) fn prepare_cameras(
    views: Query<View>,
    lights: Lights,
    suns: Query<&ExtractedDirectionalLight>,
    settings: Res<MomentShadows>,
    compiled: Res<Compiled>,
    maps: Res<Maps>,
    mut cameras: ResMut<Cameras>,
    (adapter, device, queue): (Res<RenderAdapter>, Res<RenderDevice>, Res<RenderQueue>),
) -> Result<(), BevyError> {
    let Some(bound) = maps.bound.as_ref() else {
        return Ok(());
    };
    let mut table = vec![0; maps.cameras as usize * maps.row()];
    if !settings.enabled {
        // Sessions stay for when it is switched on again.
        cameras.0.values_mut().for_each(|camera| camera.lit = false);
        queue.write_buffer(&bound.table, 0, &table);
        return Ok(());
    }
    cameras.0.retain(|entity, _| views.contains(*entity));
    for (entity, shadows, view_lights, view, extracted, target, depth) in &views {
        let given = Given {
            light_depth: (*shadows.directional_light_depth_texture).clone(),
            camera_depth: depth
                .filter(|_| compiled.imports(CAMERA_DEPTH))
                .map(|depth| (**depth.texture()).clone()),
            target: target.main_texture_format(),
        };
        if compiled.scattering.is_some() && extracted.viewport.is_some() {
            let message = "a camera with a viewport draws no air; let it draw a whole texture";
            return Err(unsuitable(message).into());
        }
        let layers = given.light_depth.depth_or_array_layers();
        if compiled.map.is_some() && layers > maps.layers {
            return Err(unsuitable(format!(
                "Bevy's shadow map has {layers} layers, for cascades and spot lights, but MomentShadowsPlugin has 'layers: {}'; \
                 give it more",
                maps.layers
            ))
            .into());
        }
        let camera = camera(
            &mut cameras.0,
            entity,
            &given,
            &compiled,
            &maps,
            &adapter,
            &device,
        )?;
        let seen = lights.of(view_lights, layers, &settings)?;
        camera.lit = !seen.views.is_empty();
        if !camera.lit {
            continue;
        }
        camera.session.leak_reduction = settings.leak_reduction;
        if compiled.scattering.is_some() {
            let sun = seen.sun.and_then(|sun| suns.get(sun).ok());
            camera.session.medium = medium(&settings, &seen, sun, extracted.exposure)?;
        }
        let eye = CameraView {
            clip_from_world: clip_from_world(view).to_cols_array_2d(),
            far_depth: 0.0,
        };
        camera.session.view(&queue, 0, &eye, &seen.views)?;
        if compiled.map.is_some() {
            let row = row(camera, view, &seen.views, &compiled, &maps)?;
            let first = camera.slot as usize * maps.row();
            table[first..][..row.len()].copy_from_slice(&row);
        }
    }
    queue.write_buffer(&bound.table, 0, &table);
    Ok(())
}

/// The session of a camera: a new one, or the old one with what is new.
fn camera<'a>(
    cameras: &'a mut HashMap<Entity, Camera>,
    entity: Entity,
    given: &Given,
    compiled: &Compiled,
    maps: &Maps,
    adapter: &RenderAdapter,
    device: &RenderDevice,
) -> Result<&'a mut Camera, GraphError> {
    let mut imports: Vec<(&str, ImportedResource)> =
        vec![(LIGHT_DEPTH, (&given.light_depth).into())];
    if let Some(depth) = &given.camera_depth {
        imports.push((CAMERA_DEPTH, depth.into()));
    }
    if let Some(camera) = cameras.get_mut(&entity)
        && camera.target == given.target
    {
        if camera.light_depth != given.light_depth || camera.camera_depth != given.camera_depth {
            block_on(camera.session.replace(0, &imports))?;
            camera.light_depth.clone_from(&given.light_depth);
            camera.camera_depth.clone_from(&given.camera_depth);
        }
    } else {
        cameras.remove(&entity);
        let taken = |slot: &u32| cameras.values().any(|camera| camera.slot == *slot);
        let slot = (0..maps.cameras).find(|slot| !taken(slot)).ok_or_else(|| {
            unsuitable(format!(
                "there are more cameras in 3D than MomentShadowsPlugin's 'cameras: {}'; give it more",
                maps.cameras
            ))
        })?;
        let target = HostTarget::scattered(given.target);
        let options = PipelineOptions {
            cache: None,
            host_targets: compiled
                .scattering
                .iter()
                .map(|pass| (pass.clone(), target))
                .collect(),
        };
        let graph = compiled.text.parse()?;
        let session = Session::new(adapter, device.wgpu_device(), graph, &imports, options);
        cameras.insert(
            entity,
            Camera {
                session: block_on(session)?,
                slot,
                lit: false,
                light_depth: given.light_depth.clone(),
                camera_depth: given.camera_depth.clone(),
                target: given.target,
            },
        );
    }
    let camera = cameras.get_mut(&entity);
    camera.ok_or_else(|| unsuitable("a camera is gone while it is made"))
}

/// The air as the directional light lights it.
fn medium(
    settings: &MomentShadows,
    seen: &Seen,
    sun: Option<&ExtractedDirectionalLight>,
    exposure: f32,
) -> Result<(SingleScattering, f64), BevyError> {
    let Some(sun) = sun.filter(|_| seen.cascades == 1) else {
        return Err(unsuitable(format!(
            "the air is lit by one directional light with one cascade, which covers all of the view; there are {} cascades: \
             give CascadeShadowConfigBuilder 'num_cascades: 1'",
            seen.cascades
        ))
        .into());
    };
    let light = sun.color.to_vec3() * sun.illuminance * exposure;
    let air = settings.air;
    let (extinction, scattering) = (air.extinction, air.scattering);
    let medium = SingleScattering::new(extinction, scattering, air.asymmetry, light.to_array())?;
    Ok((medium, air.far))
}

/// A camera's row of the table.
fn row(
    camera: &Camera,
    view: &ExtractedView,
    lights: &[LightView],
    compiled: &Compiled,
    maps: &Maps,
) -> Result<Vec<u8>, BevyError> {
    let eye = view.world_from_view.translation().as_dvec3();
    let clip = clip_from_world(view).as_mat4();
    let mut row = bytemuck::bytes_of(&ShadowCamera::new(clip)).to_vec();
    let table = compiled
        .map
        .as_ref()
        .and_then(|(_, encoding)| encoding.table());
    let size = camera.light_depth.width();
    for light in lights {
        let area = match table {
            None => AreaLight::NONE,
            Some(table) => {
                let [width, height] = table.largest_kernel();
                let largest = 0.5 * f64::from(width.min(height));
                light.area_light([size; 2], 1f64.min(largest)..=largest)?
            }
        };
        let layer = camera.slot * maps.layers + light.layer;
        let bias = camera.session.receiver_bias(SHADOW_MAP, light)?;
        let leaks = camera.session.leak_reduction;
        let view = ShadowView::new(light, eye, layer, bias, leaks, area)?;
        row.extend_from_slice(bytemuck::bytes_of(&view));
    }
    Ok(row)
}
