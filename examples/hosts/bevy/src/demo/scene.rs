//! What is drawn: a pergola, a fence and a few bodies on a floor, before a wall.

use bevy::camera::visibility::NoFrustumCulling;
use bevy::ecs::system::EntityCommands;
use bevy::prelude::*;

/// Puts a material on an entity: Bevy's own, or one that is extended.
pub(super) type Paint<'a> = &'a mut dyn FnMut(&mut EntityCommands, StandardMaterial);

/// Spawns the scene.
pub(super) fn spawn(commands: &mut Commands, meshes: &mut Assets<Mesh>, paint: Paint) {
    let cube = meshes.add(Cuboid::new(1.0, 1.0, 1.0));
    let ball = meshes.add(Sphere::new(0.5).mesh().uv(48, 24));
    let mut body = |mesh: &Handle<Mesh>, centre: [f32; 3], size: [f32; 3], colour: [f32; 3]| {
        let transform = Transform::from_translation(centre.into()).with_scale(size.into());
        let mut entity = commands.spawn((Mesh3d(mesh.clone()), transform, NoFrustumCulling));
        let [red, green, blue] = colour;
        paint(
            &mut entity,
            StandardMaterial {
                base_color: Color::linear_rgb(red, green, blue),
                perceptual_roughness: 0.9,
                reflectance: 0.2,
                ..default()
            },
        );
    };
    let (stone, wood, red) = ([0.55, 0.52, 0.48], [0.35, 0.22, 0.12], [0.6, 0.12, 0.1]);
    body(&cube, [0.0, -0.25, 0.0], [112.0, 0.5, 112.0], [0.5; 3]);
    body(&cube, [0.0, 8.0, -8.0], [112.0, 24.0, 0.5], stone);
    // Bodies: one stands, one lies, one floats.
    body(&cube, [2.6, 0.75, 2.6], [1.5, 1.5, 1.5], red);
    body(&ball, [4.6, 0.8, 0.4], [1.6, 1.6, 1.6], [0.15, 0.3, 0.55]);
    body(&cube, [-4.6, 2.6, 0.6], [1.2, 0.3, 1.2], red);
    // The pergola: posts, and slats across.
    for x in [-3.0, 3.0] {
        for z in [-5.0, -1.0] {
            body(&cube, [x, 2.0, z], [0.35, 4.0, 0.35], stone);
        }
    }
    for number in 0..9 {
        let z = -5.4 + 0.6 * number as f32;
        body(&cube, [0.0, 4.1, z], [7.2, 0.2, 0.28], wood);
    }
    // The fence: thin bars between two rails.
    for height in [0.35, 1.25] {
        body(&cube, [-3.4, height, 3.2], [5.2, 0.08, 0.08], wood);
    }
    for number in 0..18 {
        let x = -5.8 + 0.28 * number as f32;
        body(&cube, [x, 0.75, 3.2], [0.07, 1.5, 0.07], wood);
    }
}
