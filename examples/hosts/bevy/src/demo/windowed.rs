//! The scene in a window.

use bevy::camera::RenderTarget;
use bevy::prelude::*;

use super::{Look, add_to};
use crate::MomentShadows;

/// Opens a window whose camera goes around the scene, until it is closed. The space bar switches what the graph does off and on.
pub fn show(look: &Look) -> AppExit {
    let mut app = App::new();
    let window = Window {
        title: "moment-shadows".to_owned(),
        ..default()
    };
    app.add_plugins(DefaultPlugins.set(WindowPlugin {
        primary_window: Some(window),
        ..default()
    }));
    add_to(&mut app, look, vec![RenderTarget::default()]);
    app.add_systems(Update, (go_around, switch));
    app.run()
}

fn go_around(time: Res<Time>, mut cameras: Query<&mut Transform, With<Camera3d>>) {
    let angle = 0.15 * time.elapsed_secs();
    // Back and forth before the wall.
    let eye = Vec3::new(9.0 * angle.sin(), 3.0, 4.0 + 5.0 * angle.cos().abs());
    for mut camera in &mut cameras {
        *camera = Transform::from_translation(eye).looking_at(Look::EYE[1], Vec3::Y);
    }
}

fn switch(keys: Res<ButtonInput<KeyCode>>, settings: Option<ResMut<MomentShadows>>) {
    if keys.just_pressed(KeyCode::Space)
        && let Some(mut settings) = settings
    {
        settings.enabled = !settings.enabled;
    }
}
