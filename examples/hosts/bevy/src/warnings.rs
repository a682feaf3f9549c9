//! What would go wrong without a word.

use std::collections::HashSet;

use bevy::core_pipeline::prepass::DeferredPrepass;
use bevy::light::VolumetricFog;
use bevy::prelude::*;

const BIAS: &str = "a directional light with shadow maps has a small 'shadow_depth_bias', so that Bevy's own shadow darkens what the filtered one \
     does: give it 1e6";
const FOG: &str = "a camera has VolumetricFog, which gets no light from a directional light whose 'shadow_depth_bias' leads out of its shadow map: let \
     the graph have an output 'scattering' instead";
const DEFERRED: &str = "a camera has a DeferredPrepass: materials that are lit deferred show no filtered shadows; let them be forward";
const POINT: &str = "a point light has shadow maps: its shadows stay those of Bevy";

/// Biases above this lead out of any shadow map.
const LARGE: f32 = 1e5;

/// What there is to warn of.
pub(crate) fn found(
    suns: Query<&DirectionalLight>,
    points: Query<&PointLight>,
    fogs: Query<(), With<VolumetricFog>>,
    deferred: Query<(), With<DeferredPrepass>>,
) -> Vec<&'static str> {
    let mut suns = suns.iter().filter(|sun| sun.shadow_maps_enabled);
    let large = |sun: &DirectionalLight| sun.shadow_depth_bias > LARGE;
    let all = [
        (suns.clone().any(|sun| !large(sun)), BIAS),
        (suns.any(large) && !fogs.is_empty(), FOG),
        (!deferred.is_empty(), DEFERRED),
        (points.iter().any(|point| point.shadow_maps_enabled), POINT),
    ];
    let found = all.into_iter().filter(|(is, _)| *is);
    found.map(|(_, message)| message).collect()
}

/// Says each of them once.
pub(crate) fn say(In(found): In<Vec<&'static str>>, mut said: Local<HashSet<&'static str>>) {
    for message in found {
        if said.insert(message) {
            warn!("{message}");
        }
    }
}

#[cfg(test)]
mod tests {
    use bevy::ecs::system::RunSystemOnce;

    use super::*;

    fn found_with(spawn: impl FnOnce(&mut World)) -> Vec<&'static str> {
        let mut world = World::new();
        spawn(&mut world);
        world.run_system_once(found).expect("a system that runs")
    }

    fn sun(shadow_depth_bias: f32) -> DirectionalLight {
        DirectionalLight {
            shadow_maps_enabled: true,
            shadow_depth_bias,
            ..default()
        }
    }

    #[test]
    fn each_is_found() {
        let none = |world: &mut World| drop(world.spawn((sun(1e6), SpotLight::default())));
        assert!(found_with(none).is_empty());
        let small = |world: &mut World| drop(world.spawn(sun(0.02)));
        assert_eq!(found_with(small), [BIAS]);
        let foggy = |world: &mut World| drop(world.spawn((sun(1e6), VolumetricFog::default())));
        assert_eq!(found_with(foggy), [FOG]);
        let deferred = |world: &mut World| drop(world.spawn(DeferredPrepass));
        assert_eq!(found_with(deferred), [DEFERRED]);
        let point = PointLight {
            shadow_maps_enabled: true,
            ..default()
        };
        assert_eq!(found_with(|world| drop(world.spawn(point))), [POINT]);
    }
}
