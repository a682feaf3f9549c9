//! Shadows at contacts through a session: it tells the node where lights are.

use moment_shadows::{ContactShadows, LightView, MapRegion};

use moment_shadows_graph::{GraphErrorKind, Session};
use pollster::block_on;

use crate::{HARD, frame, gpu, imports, parsed, places, recorded, session};

/// The example with shadows at contacts after its maps, for so many lights, and what maps say of them as a further output.
fn contacts(lights: u32) -> String {
    let contact = format!(
        r#""nodes": [ {{ "name": "contact", "type": "contact_shadows", "properties": {{ "lights": {lights} }} }},"#
    );
    let edges = r#""edges": [ { "from": "camera_depth", "to": "contact.camera_depth" },
        { "from": "shade.shadow_intensity", "to": "contact.intensity" },"#;
    let shade = format!(
        r#""type": "shade_hard", "properties": {{ "lights": {lights}, "views": {lights} }}"#
    );
    HARD.replace(r#""nodes": ["#, &contact)
        .replace(r#""edges": ["#, edges)
        .replace(r#""type": "shade_hard""#, &shade)
        .replace(
            r#"{ "name": "shadow_intensity", "from": "shade.shadow_intensity" }"#,
            r#"{ "name": "shadow_intensity", "from": "contact.shadow_intensity" },
               { "name": "maps", "from": "shade.shadow_intensity" }"#,
        )
}

#[test]
fn the_darker_one_of_maps_and_march_is_shown_channel_by_channel() {
    let gpu = gpu();
    let frame = frame(&gpu, 0, [160, 90]);
    let (camera, light) = places(&frame);
    let mut one = session(&gpu, &contacts(1), &imports(&frame));
    one.view(&gpu.queue, 0, &camera, &[light]).unwrap();
    let single = recorded(&gpu, &one, 0, "shadow_intensity");
    let maps = recorded(&gpu, &one, 0, "maps");
    let darker = single.iter().zip(&maps).filter(|(both, maps)| both > maps);
    assert!(single.iter().zip(&maps).all(|(both, maps)| both >= maps));
    assert!(darker.count() > 20);
    // Of four lights the second is there.
    let mut four = session(&gpu, &contacts(4), &imports(&frame));
    let second = LightView {
        channel: 1,
        ..light
    };
    four.view(&gpu.queue, 0, &camera, &[second]).unwrap();
    let all = recorded(&gpu, &four, 0, "shadow_intensity");
    for (texel, single) in all.chunks_exact(4).zip(&single) {
        assert_eq!(texel, [0, *single, 0, 0]);
    }
}

#[test]
fn contacts_are_those_of_the_output_that_they_darken() {
    let gpu = gpu();
    let frame = frame(&gpu, 0, [160, 90]);
    let (camera, light) = places(&frame);
    let mut one = session(&gpu, &contacts(1), &imports(&frame));
    one.view(&gpu.queue, 0, &camera, &[light]).unwrap();
    let single = recorded(&gpu, &one, 0, "shadow_intensity");
    // The second output has lights 4 to 7; of eight views a pass finds those of each tile.
    let text = contacts(4)
        .replace(r#""lights": 4, "views": 4"#, r#""lights": 8, "views": 8"#)
        .replace("shade.shadow_intensity", "shade.shadow_intensity_4");
    let mut second = session(&gpu, &text, &imports(&frame));
    let view = |channel| LightView { channel, ..light };
    second.view(&gpu.queue, 0, &camera, &[view(6)]).unwrap();
    let all = recorded(&gpu, &second, 0, "shadow_intensity");
    for (texel, single) in all.chunks_exact(4).zip(&single) {
        assert_eq!(texel, [0, 0, *single, 0]);
    }
    // A node of fewer lights than there are views of is told so.
    let text = contacts(4)
        .replace(r#"{ "lights": 4 }"#, r#"{ "lights": 2 }"#)
        .replace(r#""samples": 4"#, r#""samples": 4, "regions": 2"#);
    let mut fewer = session(&gpu, &text, &imports(&frame));
    let half = |channel| LightView {
        region: MapRegion::new([64 * channel, 0], [128, 256]),
        ..view(channel)
    };
    let found = fewer.view(&gpu.queue, 0, &camera, &[half(0), half(2)]);
    let found = found.unwrap_err().to_string();
    assert!(found.contains("2 of the lights"), "{found}");
}

#[test]
fn a_single_light_does_not_darken_the_channels_of_others() {
    let gpu = gpu();
    let frame = frame(&gpu, 0, [160, 90]);
    let one_of_four = contacts(4).replace(r#"{ "lights": 4 }"#, r#"{ "lights": 1 }"#);
    let refused = |text: &str| {
        let graph = parsed(text);
        let imports = imports(&frame);
        let options = Default::default();
        let session = Session::new(&gpu.adapter, &gpu.device, graph, &imports, options);
        block_on(session).err()
    };
    let found = refused(&one_of_four).unwrap();
    assert_eq!(found.kind, GraphErrorKind::Format);
    let found = found.to_string();
    assert!(
        found.contains("'contact'") && found.contains("give as many as the node that shades has"),
        "{found}"
    );
    // One light in all four channels is asked for.
    let in_all = contacts(1)
        .replace(
            r#"{ "lights": 1 }"#,
            r#"{ "lights": 1, "format": "rgba8unorm" }"#,
        )
        .replace(r#""views": 1"#, r#""views": 1, "format": "rgba8unorm""#);
    let mut all = session(&gpu, &in_all, &imports(&frame));
    let (camera, light) = places(&frame);
    all.view(&gpu.queue, 0, &camera, &[light]).unwrap();
    let mut one = session(&gpu, &contacts(1), &imports(&frame));
    one.view(&gpu.queue, 0, &camera, &[light]).unwrap();
    let single = recorded(&gpu, &one, 0, "shadow_intensity");
    let all = recorded(&gpu, &all, 0, "shadow_intensity");
    for (texel, single) in all.chunks_exact(4).zip(&single) {
        assert_eq!(texel, [*single; 4]);
    }
}

#[test]
fn lengths_that_are_none_and_too_many_lights_are_named() {
    let gpu = gpu();
    let frame = frame(&gpu, 0, [96, 54]);
    let (camera, light) = places(&frame);
    let mut session = session(&gpu, &contacts(1), &imports(&frame));
    session.view(&gpu.queue, 0, &camera, &[light]).unwrap();
    let before = recorded(&gpu, &session, 0, "shadow_intensity");
    let usual = session.contact;
    for (wrong, word) in [
        (
            ContactShadows {
                length: 0.0,
                ..usual
            },
            "length is 0",
        ),
        (
            ContactShadows {
                thickness: f64::NAN,
                ..usual
            },
            "thickness is NaN",
        ),
    ] {
        session.contact = wrong;
        let found = session
            .view(&gpu.queue, 0, &camera, &[light])
            .unwrap_err()
            .to_string();
        assert!(
            found.contains(word) && found.contains("'contact'"),
            "{found}"
        );
    }
    session.contact = usual;
    let second = LightView {
        channel: 1,
        ..light
    };
    let found = session
        .view(&gpu.queue, 0, &camera, &[second])
        .unwrap_err()
        .to_string();
    assert!(found.contains("channel is 1"), "{found}");
    assert_eq!(recorded(&gpu, &session, 0, "shadow_intensity"), before);
}
