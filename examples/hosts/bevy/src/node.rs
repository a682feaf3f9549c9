//! What is recorded for each camera of Bevy's: the whole of what Bevy's schedule sees.

use bevy::prelude::*;
use bevy::render::renderer::{RenderContext, ViewQuery};
use bevy::render::view::ViewTarget;
use moment_shadows_graph::{GraphError, Stage};

use crate::cameras::{Camera, Cameras};
use crate::compiled::{Compiled, SHADOW_MAP};
use crate::maps::Maps;

/// After Bevy's shadow passes: makes the filtered map of the current camera, and puts it where materials look.
pub(crate) fn filter(
    view: ViewQuery<Entity, With<Camera3d>>,
    cameras: Res<Cameras>,
    maps: Res<Maps>,
    mut ctx: RenderContext,
) -> Result<(), BevyError> {
    let camera = cameras.0.get(&view.entity()).filter(|camera| camera.lit);
    let Some((camera, bound)) = camera.zip(maps.bound.as_ref()) else {
        return Ok(());
    };
    let encoder = ctx.command_encoder();
    camera.session.record(Stage::AfterShadowMaps, encoder)?;
    let Some(filtered) = camera.session.output(0, SHADOW_MAP) else {
        return Ok(());
    };
    for mip_level in 0..filtered.mip_level_count() {
        let mip = |texture, layer| wgpu::TexelCopyTextureInfo {
            texture,
            mip_level,
            origin: wgpu::Origin3d {
                x: 0,
                y: 0,
                z: layer,
            },
            aspect: wgpu::TextureAspect::All,
        };
        let extent = wgpu::Extent3d {
            width: (filtered.width() >> mip_level).max(1),
            height: (filtered.height() >> mip_level).max(1),
            depth_or_array_layers: filtered.depth_or_array_layers(),
        };
        let place = mip(&*bound.texture, camera.slot * maps.planes());
        encoder.copy_texture_to_texture(mip(filtered, 0), place, extent);
    }
    Ok(())
}

/// After Bevy's main pass: draws what the air in front of surfaces takes and adds over the picture of the current camera.
pub(crate) fn scatter(
    view: ViewQuery<(Entity, &ViewTarget)>,
    cameras: Res<Cameras>,
    compiled: Res<Compiled>,
    mut ctx: RenderContext,
) -> Result<(), BevyError> {
    let (entity, target) = view.into_inner();
    let camera = cameras.0.get(&entity).filter(|camera| camera.lit);
    let Some((camera, pass)) = camera.zip(compiled.scattering.as_ref()) else {
        return Ok(());
    };
    let attachment = wgpu::RenderPassColorAttachment {
        view: target.main_texture_view(),
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations {
            load: wgpu::LoadOp::Load,
            store: wgpu::StoreOp::Store,
        },
    };
    let mut drawn = ctx
        .command_encoder()
        .begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("moment-shadows/scattering"),
            color_attachments: &[Some(attachment)],
            ..Default::default()
        });
    Ok(draw(camera, pass, &mut drawn)?)
}

fn draw(camera: &Camera, pass: &str, drawn: &mut wgpu::RenderPass<'_>) -> Result<(), GraphError> {
    match camera.session.bindings(0) {
        Some(bindings) => bindings.draw(pass, drawn, 0),
        None => Ok(()),
    }
}
