//! Bevy's views of lights as this library knows them.

use bevy::math::DMat4;
use bevy::pbr::{ExtractedPointLight, LightEntity, ShadowView, ViewLightEntities};
use bevy::prelude::*;
use bevy::render::view::ExtractedView;
use moment_shadows::{Border, LightDepth, MapRegion};
use moment_shadows_graph::{DepthRange, LightView};

use crate::MomentShadows;
use crate::compiled::unsuitable;

/// Bevy's views of lights. Those of directional lights are a camera's own, those of spot lights all cameras'.
type LightViews<'w, 's> = Query<
    'w,
    's,
    (
        &'static LightEntity,
        &'static ExtractedView,
        &'static ShadowView,
    ),
>;

/// Where Bevy's lights are.
#[derive(bevy::ecs::system::SystemParam)]
pub(crate) struct Lights<'w, 's> {
    views: LightViews<'w, 's>,
    points: Query<'w, 's, &'static ExtractedPointLight>,
}

/// What a camera sees of lights.
#[derive(Default)]
pub(crate) struct Seen {
    /// The view of each light in Bevy's shadow map: the directional light's cascades, then spot lights.
    pub(crate) views: Vec<LightView>,
    /// How many of them are cascades.
    pub(crate) cascades: usize,
    /// The entity of the directional light.
    pub(crate) sun: Option<Entity>,
}

impl Lights<'_, '_> {
    /// The views of the lights in a shadow map with this many layers.
    pub(crate) fn of(
        &self,
        camera: &ViewLightEntities,
        layers: u32,
        settings: &MomentShadows,
    ) -> Result<Seen, BevyError> {
        let mut seen = Seen::default();
        for (layer, entity) in camera.lights.iter().enumerate() {
            let (LightEntity::Directional { light_entity, .. }, view, _) =
                self.views.get(*entity)?
            else {
                continue;
            };
            if seen.sun.is_some_and(|sun| sun != *light_entity) {
                return Err(unsuitable(
                    "two directional lights have shadow maps, but Bevy has one factor for the shadows of all; leave one of them \
                     'shadow_maps_enabled'",
                )
                .into());
            }
            seen.sun = Some(*light_entity);
            seen.views.push(LightView {
                depth: LightDepth::Orthographic { reversed: true },
                layer: layer as u32,
                size: settings.sun,
                ..LightView::orthographic(clip_from_world(view).to_cols_array_2d())
            });
        }
        seen.cascades = seen.views.len();
        // Bevy puts spot lights behind the cascades of the camera that has most of them.
        let spots = || {
            let views = self.views.iter();
            views.filter_map(|(light, view, shadow)| match light {
                LightEntity::Spot { light_entity } => Some((*light_entity, view, shadow)),
                LightEntity::Directional { .. } | LightEntity::Point { .. } => None,
            })
        };
        let first = layers.saturating_sub(spots().count() as u32);
        for (light, view, shadow) in spots() {
            let number = shadow.pass_name.strip_prefix("shadow_spot_light_");
            let number: u32 = number.unwrap_or_default().parse()?;
            let light = self.points.get(light)?;
            let near = f64::from(light.shadow_map_near_z);
            seen.views.push(LightView {
                clip_from_world: clip_from_world(view).to_cols_array_2d(),
                depth: LightDepth::Perspective {
                    near,
                    far: f64::INFINITY,
                    reversed: true,
                    range: DepthRange {
                        near,
                        far: f64::from(light.range),
                    },
                },
                layer: first + number,
                region: MapRegion::WHOLE,
                guard: 0,
                border: Border::Sharp,
                channel: 0,
                size: settings.spots,
            });
        }
        Ok(seen)
    }
}

/// The matrix that a view was drawn with.
pub(crate) fn clip_from_world(view: &ExtractedView) -> DMat4 {
    view.clip_from_world.map_or_else(
        || {
            let world_from_view = view.world_from_view.to_matrix().as_dmat4();
            view.clip_from_view.as_dmat4() * world_from_view.inverse()
        },
        |matrix| matrix.as_dmat4(),
    )
}
