//! What cannot be done is an error that says so.

mod common;

use bevy::light::{CascadeShadowConfigBuilder, DirectionalLight};
use common::{SIZE, filtered};
use moment_shadows_bevy::demo::{Fog, Look, Stage};

/// A graph file of this folder with something else in it.
fn changed(graph: &str, from: &str, to: &str) -> Look {
    let look = filtered(graph);
    let text = look.graph.as_deref().unwrap_or_default();
    assert!(text.contains(from), "{text}");
    Look {
        graph: Some(text.replace(from, to)),
        ..look
    }
}

#[test]
#[should_panic(expected = "Bevy has nothing for the import 'depth'")]
fn an_import_that_bevy_does_not_have() {
    Stage::new(&changed("hamburger4", "light_depth", "depth"), SIZE);
}

#[test]
#[should_panic(expected = "nothing in Bevy takes the output 'moments'")]
fn an_output_that_bevy_does_not_take() {
    Stage::new(&changed("hamburger4", "shadow_map", "moments"), SIZE);
}

#[test]
#[should_panic(expected = "it has no output")]
fn a_graph_without_an_output() {
    let output = "{ \"name\": \"shadow_map\", \"from\": \"blur.blurred\" }";
    Stage::new(&changed("hamburger4", output, ""), SIZE);
}

#[test]
#[should_panic(expected = "two directional lights have shadow maps")]
fn two_suns() {
    let mut stage = Stage::new(&filtered("hamburger4"), SIZE);
    let sun = DirectionalLight {
        shadow_maps_enabled: true,
        ..Default::default()
    };
    let cascades = CascadeShadowConfigBuilder {
        num_cascades: 1,
        ..Default::default()
    };
    stage.app().world_mut().spawn((sun, cascades.build()));
    let _ = stage.pictures();
}

#[test]
#[should_panic(expected = "the air is lit by one directional light with one cascade")]
fn air_with_cascades() {
    let look = Look {
        fog: Fog::Filtered,
        cascades: 2,
        ..filtered("air")
    };
    Stage::new(&look, SIZE);
}

#[test]
#[should_panic(expected = "Bevy's shadow map has 5 layers")]
fn more_layers_than_there_is_room_for() {
    let look = Look {
        cascades: 4,
        spot: true,
        ..filtered("hamburger4")
    };
    Stage::new(&look, SIZE);
}

#[test]
#[should_panic(expected = "there are more cameras in 3D than")]
fn more_cameras_than_there_is_room_for() {
    let look = Look {
        eyes: vec![Look::EYE; 3],
        ..filtered("hamburger4")
    };
    Stage::new(&look, SIZE);
}
