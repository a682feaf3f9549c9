use moment_shadows_frame_graph::device::Pipelines;
use moment_shadows_frame_graph::error::HostError;
use moment_shadows_frame_graph::frame::{Frame, Options};
use moment_shadows_frame_graph::graphs::{self, Sizes};
use moment_shadows_frame_graph::variants::resized;
use moment_shadows_frame_graph::world::World;
use moment_shadows_graph::Plan;

use crate::{SIZES, frame, gpu, plan, text};

/// Map and picture change, to sides that no workgroup divides.
const OTHER: Sizes = Sizes {
    map: [201, 150],
    picture: [77, 61],
};

/// The plan without what is only told, and no host needs.
fn needed(mut plan: Plan) -> Plan {
    for pass in &mut plan.passes {
        (pass.bytes_read, pass.bytes_written) = (0, 0);
    }
    plan.device.limits.clear();
    plan
}

#[test]
fn a_resized_plan_is_what_the_compiler_gives() {
    for (name, text) in graphs::ALL {
        let other = resized(&plan(name), |import| OTHER.of(import)).unwrap();
        let compiled = graphs::compile(text, OTHER).unwrap();
        assert!(other != plan(name), "{name}");
        let lines = |plan: Plan| serde_json::to_string_pretty(&needed(plan)).unwrap();
        let (other, compiled) = (lines(other), lines(compiled));
        let mut pairs = other.lines().zip(compiled.lines());
        let apart = pairs.find(|(one, other)| one != other);
        assert_eq!(apart, None, "{name}");
        assert_eq!(other.len(), compiled.len(), "{name}");
    }
}

#[test]
fn pipelines_stay_when_map_and_picture_are_resized() {
    let (gpu, _one) = gpu();
    let world = World::default();
    for (name, text) in graphs::ALL {
        let first = plan(name);
        let pipelines = Pipelines::of_plan(&gpu.device, &first).unwrap();
        let before = Frame::new(&gpu, &first, &pipelines, SIZES, &Options::default()).unwrap();
        drop(before);
        let other = resized(&first, |import| OTHER.of(import)).unwrap();
        let mut after = Frame::new(&gpu, &other, &pipelines, OTHER, &Options::default()).unwrap();
        let after = after.draw_world(&gpu, &world).unwrap();
        let compiled = graphs::compile(text, OTHER).unwrap();
        let compiled = frame(&gpu, &compiled, OTHER).draw_world(&gpu, &world);
        assert!(after.pictures == compiled.unwrap().pictures, "{name}");
    }
}

#[test]
fn sizes_that_do_not_fit_are_refused() {
    let sizes = |map: [u32; 2]| {
        move |import: &str| match import {
            "camera_depth" => SIZES.picture,
            _ => map,
        }
    };
    // A kernel with four texels to either side.
    let refused = resized(&plan("hard_shadows"), sizes([64, 8])).unwrap_err();
    assert!(
        matches!(refused, HostError::TooSmall { smallest: 9, .. }),
        "{refused}"
    );
    // Four mip levels.
    assert!(resized(&plan("six_moments"), sizes([16, 16])).is_ok());
    let mut levels = plan("six_moments");
    levels.parameters.regions.clear();
    let refused = resized(&levels, sizes([16, 7])).unwrap_err();
    assert!(
        matches!(refused, HostError::TooSmall { smallest: 8, .. }),
        "{refused}"
    );
    let mut file: serde_json::Value = serde_json::from_str(text("hard_shadows")).unwrap();
    file["imports"][0]["texture"]["regions"] = 2.into();
    let regions = graphs::compile(&file.to_string(), SIZES).unwrap();
    let refused = resized(&regions, sizes([64, 64])).unwrap_err();
    assert!(
        matches!(&refused, HostError::Regions(map) if map == "light_depth"),
        "{refused}"
    );
}
