//! Ranges that go no farther than a camera sees: its maps are then its own.

use glam::DVec3;
use pollster::block_on;

use crate::views::{cascades, in_one_map_by};
use crate::{FITTED, frame, gpu, imports, places, recorded, session, views};

/// The graph with ranges that fit themselves to what the camera sees, too.
fn seen() -> String {
    let fitted = r#"{ "from": "light_depth", "to": "fit.depth" },"#;
    let both = format!(r#"{fitted} {{ "from": "camera_depth", "to": "fit.camera_depth" }},"#);
    assert!(FITTED.contains(fitted));
    FITTED.replace(fitted, &both)
}

#[test]
fn every_camera_has_a_range_of_its_own() {
    let gpu = gpu();
    let first = frame(&gpu, 0, [160, 90]);
    let light = places(&first).1;
    let other = frame(&gpu, 1, [96, 54]);
    let alone = |text: &str, of: &_| {
        let mut given = imports(&first);
        given[1] = imports(of)[1].clone();
        let mut session = session(&gpu, text, &given);
        session
            .view(&gpu.queue, 0, &places(of).0, &[light])
            .unwrap();
        recorded(&gpu, &session, 0, "shadow_intensity")
    };
    let text = seen();
    let mut session = session(&gpu, &text, &imports(&first));
    session
        .view(&gpu.queue, 0, &places(&first).0, &[light])
        .unwrap();
    block_on(session.add_view(&imports(&other)[1..])).unwrap();
    session
        .view(&gpu.queue, 1, &places(&other).0, &[light])
        .unwrap();
    for (number, of) in [&first, &other].into_iter().enumerate() {
        let found = recorded(&gpu, &session, number, "shadow_intensity");
        // Frames after the first keep their range.
        assert_eq!(found, alone(&text, of));
        let casters = alone(FITTED, of);
        let sum = |picture: &[u8]| picture.iter().map(|&it| u64::from(it)).sum::<u64>();
        println!(
            "camera {number}: shadow {} beside {} fitted to casters alone",
            sum(&found),
            sum(&casters)
        );
        assert!(sum(&found) >= sum(&casters));
    }
}

#[test]
fn each_cascade_ends_with_what_is_seen_of_it() {
    let gpu = gpu();
    let frame = views::frame(&gpu, DVec3::new(1.0, 3.0, 0.0), DVec3::new(4.0, 0.0, 4.0));
    let (camera, _) = places(&frame);
    let [casters, seen] = [FITTED.to_owned(), seen()].map(|graph| {
        let views = cascades(&camera, 5, 0.0);
        in_one_map_by(&graph, &gpu, &frame, &camera, views)
    });
    let apart = casters.iter().zip(&seen).map(|(a, b)| (a - b).abs());
    let mean = apart.sum::<f32>() / seen.len() as f32;
    let shadow = seen.iter().sum::<f32>() / seen.len() as f32;
    println!("{mean:.5} apart on average, of {shadow:.3} in shadow");
    // The floor is seen, and nothing lies below it.
    assert!(mean <= 5e-3 && shadow > 0.1, "{mean} {shadow}");
}
