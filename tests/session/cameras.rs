//! Several cameras and sizes with one set of maps.

use pollster::block_on;

use crate::{HARD, frame, gpu, imports, places, recorded, session};

#[test]
fn every_camera_has_the_picture_that_it_has_alone() {
    let gpu = gpu();
    let first = frame(&gpu, 0, [160, 90]);
    let light = places(&first).1;
    let others = [frame(&gpu, 1, [96, 54]), frame(&gpu, 2, [320, 180])];
    let alone = |frame: &_| {
        let mut given = imports(&first);
        given[1] = imports(frame)[1].clone();
        let mut session = session(&gpu, HARD, &given);
        session
            .view(&gpu.queue, 0, &places(frame).0, &[light])
            .unwrap();
        recorded(&gpu, &session, 0, "shadow_intensity")
    };

    let mut session = session(&gpu, HARD, &imports(&first));
    session
        .view(&gpu.queue, 0, &places(&first).0, &[light])
        .unwrap();
    for (number, other) in (1..).zip(&others) {
        let added = block_on(session.add_view(&imports(other)[1..])).unwrap();
        assert_eq!(added, number);
        session
            .view(&gpu.queue, number, &places(other).0, &[light])
            .unwrap();
    }
    assert_eq!(
        recorded(&gpu, &session, 0, "shadow_intensity"),
        alone(&first)
    );
    for (number, other) in (1..).zip(&others) {
        assert_eq!(
            recorded(&gpu, &session, number, "shadow_intensity"),
            alone(other)
        );
    }
}

#[test]
fn a_resize_and_another_light_map_are_taken() {
    let gpu = gpu();
    let (small, large) = (frame(&gpu, 0, [96, 54]), frame(&gpu, 1, [320, 180]));
    let picture = |session: &mut moment_shadows_graph::Session, frame| {
        let (camera, light) = places(frame);
        session.view(&gpu.queue, 0, &camera, &[light]).unwrap();
        recorded(&gpu, session, 0, "shadow_intensity")
    };
    let expected =
        [&small, &large].map(|frame| picture(&mut session(&gpu, HARD, &imports(frame)), frame));
    let mut session = session(&gpu, HARD, &imports(&small));
    assert_eq!(picture(&mut session, &small), expected[0]);
    block_on(session.replace(0, &imports(&large))).unwrap();
    assert_eq!(picture(&mut session, &large), expected[1]);
    block_on(session.replace(0, &imports(&small))).unwrap();
    assert_eq!(picture(&mut session, &small), expected[0]);
}
