//! Mistakes that hosts make, and what they look like: each made on purpose, beside the same picture without it.

mod shown;

use glam::{DMat4, DVec3};
use moment_shadows::{
    CameraView, LeakReduction, LightView, MapRegion, PcfTaps, ReceiverBias, Technique,
};

use crate::command::drawn::Drawn;
use crate::command::render::RenderOptions;
use crate::error::LabError;
use crate::frame::{Frame, FrameDesc};
use crate::gpu::Gpu;
use crate::graph_frame::{camera_view, light_view};
use crate::scene::{Scene, contacts, place_on_ground, stacked_boards};
pub use shown::Shown;
use shown::{by_objects, by_session, difference};

/// A symptom: the picture with a mistake, and the one without it.
pub struct Symptom {
    /// The name of its picture.
    pub name: &'static str,
    /// With the mistake.
    pub wrong: Shown,
    /// Without it.
    pub right: Shown,
}

/// Names of all symptoms, in the order of the page.
pub const NAMES: [&str; 8] = [
    "acne",
    "peter-panning",
    "leaking",
    "seams",
    "flicker",
    "black",
    "lit",
    "misplaced",
];

/// Makes both pictures of a symptom, which are `picture` pixels large.
pub fn symptom(gpu: &Gpu, name: &'static str, picture: [u32; 2]) -> Result<Symptom, LabError> {
    let [wrong, right] = match name {
        "acne" => acne(gpu, picture)?,
        "peter-panning" => peter_panning(gpu, picture)?,
        "leaking" => leaking(gpu, picture)?,
        "seams" => seams(gpu, picture)?,
        "flicker" => flicker(gpu, picture)?,
        "black" => told_reversed(gpu, picture)?,
        "lit" => light_elsewhere(gpu, picture)?,
        "misplaced" => flipped(gpu, picture)?,
        other => {
            return Err(LabError::unsuitable(
                other,
                "there is no symptom of this name",
            ));
        }
    };
    Ok(Symptom { name, wrong, right })
}

/// A scene as a sun draws it.
fn drawn(gpu: &Gpu, scene: &Scene, picture: [u32; 2], map: u32) -> Result<Frame, LabError> {
    drawn_as(gpu, scene, picture, map, &RenderOptions::default())
}

fn drawn_as(
    gpu: &Gpu,
    scene: &Scene,
    picture: [u32; 2],
    map: u32,
    options: &RenderOptions,
) -> Result<Frame, LabError> {
    let drawn = Drawn {
        picture,
        map: [map; 2],
        ..Drawn::default()
    };
    options.frame(gpu, scene, &drawn, MARGIN)
}

/// Things that stand on a floor.
fn floor() -> Scene {
    place_on_ground(contacts())
}

/// The kernel's radius, around the casters.
const MARGIN: u32 = 4;

/// Camera and light as they are.
fn told(frame: &Frame) -> Result<(CameraView, LightView), LabError> {
    Ok((camera_view(&frame.desc)?, light_view(&frame.desc)))
}

/// No receiver bias, in a test on the plain depth map, whose stripes are finer than the grey of filtered maps.
fn acne(gpu: &Gpu, picture: [u32; 2]) -> Result<[Shown; 2], LabError> {
    let low = RenderOptions {
        light_direction: Some(DVec3::new(1.0, -0.7, 0.5)),
        ..RenderOptions::default()
    };
    let drawn = Drawn {
        picture,
        map: [160; 2],
        samples: 1,
        ..Drawn::default()
    };
    let frame = low.frame(gpu, &floor(), &drawn, MARGIN)?;
    let test = Technique::Pcf(PcfTaps::Box { radius: 1 });
    Ok([
        by_objects(gpu, &frame, &test, |_| ReceiverBias::NONE)?,
        by_objects(gpu, &frame, &test, |usual| usual)?,
    ])
}

/// A receiver bias that was turned up until a scene with other units looked right.
fn peter_panning(gpu: &Gpu, picture: [u32; 2]) -> Result<[Shown; 2], LabError> {
    let frame = drawn(gpu, &floor(), picture, 1024)?;
    let turned_up = |usual| ReceiverBias {
        constant: 0.2,
        maximum: 0.4,
        ..usual
    };
    Ok([
        by_objects(gpu, &frame, &Technique::Hamburger4, turned_up)?,
        by_objects(gpu, &frame, &Technique::Hamburger4, |usual| usual)?,
    ])
}

/// Depth planes far beyond the casters, and no leak reduction.
fn leaking(gpu: &Gpu, picture: [u32; 2]) -> Result<[Shown; 2], LabError> {
    let scene = place_on_ground(stacked_boards());
    let frame = drawn(gpu, &scene, picture, 512)?;
    let [_, last] = frame.desc.light.range;
    let long = FrameDesc {
        light: frame.desc.light.reaching(20.0 * last),
        ..frame.desc
    };
    let long = Frame::draw(gpu, &scene, long)?;
    let of = |frame: &Frame, leak_reduction| {
        let (camera, light) = told(frame)?;
        by_session(gpu, frame, 1, &camera, &[light], leak_reduction)
    };
    Ok([
        of(&long, LeakReduction::NONE)?,
        of(&frame, LeakReduction::DEFAULT)?,
    ])
}

/// A map in two regions that touch, without a band around what each is looked up in: the filter of each ends at the seam.
fn seams(gpu: &Gpu, picture: [u32; 2]) -> Result<[Shown; 2], LabError> {
    let frame = drawn(gpu, &floor(), picture, 80)?;
    let (camera, light) = told(&frame)?;
    let [width, height] = frame.desc.map;
    let half = |side: u32| {
        // Clip x of this half of the map from -1 to 1.
        let [scale, offset] = [2.0, [1.0, -1.0][side as usize]];
        let mut clip = light.clip_from_world;
        for column in &mut clip {
            column[0] = scale * column[0] + offset * column[3];
        }
        LightView {
            clip_from_world: clip,
            region: MapRegion {
                origin: [side * width / 2, 0],
                extent: [width / 2, height],
            },
            ..light
        }
    };
    let usual = LeakReduction::DEFAULT;
    Ok([
        by_session(gpu, &frame, 2, &camera, &[half(0), half(1)], usual)?,
        by_session(gpu, &frame, 1, &camera, &[light], usual)?,
    ])
}

/// A light that follows the camera by a part of a texel; beside it, by a whole one. What differs between two frames.
fn flicker(gpu: &Gpu, picture: [u32; 2]) -> Result<[Shown; 2], LabError> {
    let scene = floor();
    let first = drawn(gpu, &scene, picture, 64)?;
    let usual = LeakReduction::DEFAULT;
    let shown = |frame: &Frame| {
        let (camera, light) = told(frame)?;
        by_session(gpu, frame, 1, &camera, &[light], usual)
    };
    let before = shown(&first)?;
    let moved = |texels: f64| {
        let mut desc = first.desc;
        let [width, _] = desc.light.texel_size(desc.map);
        let by = DVec3::X * texels * width;
        desc.light.view_from_world = DMat4::from_translation(by) * desc.light.view_from_world;
        let after = shown(&Frame::draw(gpu, &scene, desc)?)?;
        Ok::<_, LabError>(difference(&before, &after))
    };
    Ok([moved(0.45)?, moved(1.0)?])
}

/// A map that stores 0 where nothing is, and a host that says 1, in its matrix too.
fn told_reversed(gpu: &Gpu, picture: [u32; 2]) -> Result<[Shown; 2], LabError> {
    let scene = floor();
    let forward = drawn(gpu, &scene, picture, 512)?;
    let options = RenderOptions {
        reversed: true,
        ..RenderOptions::default()
    };
    let frame = drawn_as(gpu, &scene, picture, 512, &options)?;
    let [wrong, right] = [told(&forward)?, told(&frame)?];
    let shown = |(camera, light): (CameraView, LightView)| {
        by_session(gpu, &frame, 1, &camera, &[light], LeakReduction::DEFAULT)
    };
    Ok([shown(wrong)?, shown(right)?])
}

/// A light's matrix of another origin than the camera's: what is seen lies beside its map.
fn light_elsewhere(gpu: &Gpu, picture: [u32; 2]) -> Result<[Shown; 2], LabError> {
    other_matrix(gpu, picture, |clip| clip[3][0] += 40.0)
}

/// A light's matrix whose y points down, as OpenGL's textures do.
fn flipped(gpu: &Gpu, picture: [u32; 2]) -> Result<[Shown; 2], LabError> {
    other_matrix(gpu, picture, |clip| {
        clip.iter_mut().for_each(|column| column[1] *= -1.0)
    })
}

/// A frame with a changed matrix of the light, and with the one that its map was drawn with.
fn other_matrix(
    gpu: &Gpu,
    picture: [u32; 2],
    change: impl FnOnce(&mut [[f64; 4]; 4]),
) -> Result<[Shown; 2], LabError> {
    // High above the floor: shadows are short, and seen whole wherever they are.
    let high = RenderOptions {
        light_direction: Some(DVec3::new(0.5, -1.0, 0.35)),
        ..RenderOptions::default()
    };
    let frame = drawn_as(gpu, &floor(), picture, 512, &high)?;
    let (camera, light) = told(&frame)?;
    let mut changed = light;
    change(&mut changed.clip_from_world);
    let usual = LeakReduction::DEFAULT;
    Ok([
        by_session(gpu, &frame, 1, &camera, &[changed], usual)?,
        by_session(gpu, &frame, 1, &camera, &[light], usual)?,
    ])
}
