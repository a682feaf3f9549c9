//! What does not suit a session is an error that says so, and the session stays as it was.

use moment_shadows::{Border, Kernel, LightDepth, LightSize, LightView};
use moment_shadows_graph::nodes::Blur;
use moment_shadows_graph::{
    Connected, GraphError, GraphErrorKind, Node, NodeDesc, ParameterBlock, Session, Stage,
};
use pollster::block_on;

use crate::{HARD, frame, gpu, imports, parsed, places, recorded, session};

#[test]
fn a_camera_that_was_never_placed_is_not_recorded() {
    let gpu = gpu();
    let frame = frame(&gpu, 0, [96, 54]);
    let (camera, light) = places(&frame);
    let mut session = session(&gpu, HARD, &imports(&frame));
    let record = |session: &Session| {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        session.record(Stage::AfterShadowMaps, &mut encoder)
    };
    let found = record(&session).unwrap_err().to_string();
    assert!(
        found.contains("camera 0") && found.contains("'view'"),
        "{found}"
    );
    session.view(&gpu.queue, 0, &camera, &[light]).unwrap();
    record(&session).unwrap();
    block_on(session.replace(0, &imports(&frame)[1..])).unwrap();
    record(&session).unwrap_err();
    let found = session.view(&gpu.queue, 1, &camera, &[light]).unwrap_err();
    assert!(found.to_string().contains("camera 1"), "{found}");
}

#[test]
fn views_of_lights_that_the_graph_has_no_place_for_are_named() {
    let gpu = gpu();
    let frame = frame(&gpu, 0, [96, 54]);
    let (camera, light) = places(&frame);
    let mut session = session(&gpu, HARD, &imports(&frame));
    session.view(&gpu.queue, 0, &camera, &[light]).unwrap();
    let before = recorded(&gpu, &session, 0, "shadow_intensity");
    let singular = [[0.0; 4]; 4];
    let wrong: [(&[LightView], &str); 8] = [
        (&[LightView { layer: 1, ..light }], "layer is 1"),
        (
            &[LightView {
                channel: 1,
                ..light
            }],
            "channel is 1",
        ),
        (
            &[LightView {
                guard: 128,
                ..light
            }],
            "guard bands of 128",
        ),
        (
            &[LightView {
                border: Border::Blend(2.0),
                ..light
            }],
            "the property 'borders'",
        ),
        (&[light, light], "at most 1"),
        (&[LightView::orthographic(singular)], "light"),
        (
            &[LightView {
                size: LightSize::Disk(1.0),
                ..light
            }],
            "angular diameter",
        ),
        (
            &[LightView {
                depth: LightDepth::Perspective {
                    near: 0.0,
                    far: 1.0,
                    reversed: false,
                    range: light.range(),
                },
                ..light
            }],
            "near plane",
        ),
    ];
    for (lights, word) in wrong {
        let found = session.view(&gpu.queue, 0, &camera, lights).unwrap_err();
        assert!(found.to_string().contains(word), "{word}: {found}");
        assert_eq!(
            recorded(&gpu, &session, 0, "shadow_intensity"),
            before,
            "{word}"
        );
    }
}

#[test]
fn textures_that_the_graph_cannot_take_are_named() {
    let gpu = gpu();
    let frame = frame(&gpu, 0, [96, 54]);
    let given = imports(&frame);
    let new = |imports: &[_]| {
        let session = Session::new(
            &gpu.adapter,
            &gpu.device,
            parsed(HARD),
            imports,
            Default::default(),
        );
        block_on(session).unwrap_err()
    };
    let colour = moment_shadows_graph::record::ImportedResource::from(&frame.surface.base_colour);
    for (imports, words) in [
        (
            vec![given[0].clone(), ("camera_depth", colour.clone())],
            ["camera_depth", "format"],
        ),
        (
            vec![
                given[0].clone(),
                given[1].clone(),
                ("camera", colour.clone()),
            ],
            ["camera", "format"],
        ),
        (
            vec![
                given[0].clone(),
                given[1].clone(),
                ("depth", given[0].1.clone()),
            ],
            ["depth", "import"],
        ),
        (
            vec![given[0].clone(), ("light_depth", colour.clone())],
            ["light_depth", "format"],
        ),
    ] {
        let found = new(&imports).to_string();
        for word in words {
            assert!(found.contains(word), "{word}: {found}");
        }
    }
    let mut session = session(&gpu, HARD, &given);
    let found = block_on(session.add_view(&given)).unwrap_err();
    assert!(
        found.kind == GraphErrorKind::Parameters && found.to_string().contains("'replace'"),
        "{found}"
    );
}

/// A node with parameters of its own.
#[derive(Debug)]
struct WithParameters(Blur);

impl Node for WithParameters {
    fn describe(&self, inputs: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let own = ParameterBlock::of::<[f32; 4]>("Own");
        Ok(self.0.describe(inputs)?.parameters(own))
    }
}

#[test]
fn parameters_that_only_the_host_knows_are_refused() {
    let gpu = gpu();
    let frame = frame(&gpu, 0, [96, 54]);
    let (camera, light) = places(&frame);
    let mut graph = parsed(HARD);
    let blur = graph.nodes.iter_mut().find(|node| node.name == "blur");
    blur.unwrap().value = Box::new(WithParameters(Blur {
        kernel: Kernel::gaussian(4, 2.4).map(Into::into),
        per_frame: false,
        resolve: None,
        rounded_inwards: false,
        mip_levels: Some(1),
    }));
    let (adapter, device) = (&gpu.adapter, &gpu.device);
    let given = imports(&frame);
    let session = Session::new(adapter, device, graph, &given, Default::default());
    let mut session = block_on(session).unwrap();
    let found = session.view(&gpu.queue, 0, &camera, &[light]).unwrap_err();
    let found = found.to_string();
    assert!(found.contains("'blur'") && found.contains("Own"), "{found}");
}

#[test]
fn a_single_light_is_in_all_channels_whichever_it_asks_for() {
    let gpu = gpu();
    let frame = frame(&gpu, 0, [96, 54]);
    let (camera, light) = places(&frame);
    let shade = r#""type": "shade_hard""#;
    let four = HARD.replace(
        shade,
        r#""type": "shade_hard", "properties": { "format": "rgba8unorm" }"#,
    );
    let mut session = session(&gpu, &four, &imports(&frame));
    let mut shaded = |channel| {
        let light = LightView { channel, ..light };
        session.view(&gpu.queue, 0, &camera, &[light]).unwrap();
        recorded(&gpu, &session, 0, "shadow_intensity")
    };
    let first = shaded(0);
    assert!(first.iter().any(|&byte| byte > 128));
    assert_eq!(shaded(2), first);
}
