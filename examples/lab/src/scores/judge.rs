//! One technique on one view: shaded with three receiver biases, around feet, and while its map slides.

use glam::{DVec2, DVec3};
use moment_shadows::{ReceiverBias, Storage, Technique};
use serde::Serialize;

use super::{Biases, FEET, FEWEST, Part, VISIBLE};
use crate::contacts::{ContactErrors, Ground, POINTS, ground_around_legs};
use crate::error::LabError;
use crate::frame::{Frame, FrameDesc};
use crate::gpu::Gpu;
use crate::graph_frame::{light_view, receiver_bias};
use crate::light::{LightKind, LightView};
use crate::metric::PENUMBRA;
use crate::scene::{CHAIRS, Scene};
use crate::surface_error::{MapEvaluator, MapPoint, MapRun};
use crate::trade::axes::Cell;
use crate::trade::results::mean;
use crate::trade::{Crop, Drawn, TRUTH_SAMPLES};
use crate::truth::kernel::even_positions;
use crate::truth::pcf::{pcf, pcf_at};
use crate::truth::surface::MomentDepths;

/// By how many texels a light's map slides from frame to frame.
pub const STEP: [f64; 2] = [0.125, 0.1875];

/// Frames that follow the first.
const FRAMES: u32 = 8;

/// Classes of slopes, of 10 degrees each; the middle of the last is at 80.
const SLOPES: usize = 9;

/// Differences of shadow intensity that have the full colour in pictures.
const FULL: f32 = 0.5;
const FULL_OF_SMALL: f32 = 0.1;

/// A combination on a scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Scored {
    /// The scene as it was named.
    pub scene: String,
    /// The combination.
    #[serde(flatten)]
    pub cell: Cell,
    /// The technique as tables name it.
    pub name: String,
    /// The technique as graph files have it.
    pub technique: Technique,
    /// The storage of the map; none where the plain depth map is read.
    pub storage: Option<Storage>,
    /// Scores, view by view.
    pub views: Vec<ViewScores>,
}

/// Scores of a view, from 0 to 1; none where there is nothing to judge.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ViewScores {
    /// The number of the view.
    pub view: u32,
    /// False shadow where there is none.
    pub acne: Biases<Option<Acne>>,
    /// Shadow that the bias takes away at feet.
    pub peter_panning: Biases<Option<f64>>,
    /// What is too light around the legs of chairs.
    pub contact: Option<f64>,
    /// How much changes while true shadows stand still; none under a light whose rays are not parallel.
    pub flicker: Option<Flicker>,
}

/// False shadow on lit surfaces: means over classes of slopes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Acne {
    /// The mean shadow intensity.
    pub mean: f64,
    /// The share of pixels that are darker than [`VISIBLE`].
    pub visible: f64,
    /// The mean for slopes around 0, 10, .. 80 degrees; none where the view shows too little of one.
    pub slopes: [Option<f64>; SLOPES],
}

/// Changes from frame to frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Flicker {
    /// The mean absolute change per frame.
    pub mean: f64,
    /// That of the frame with the largest.
    pub worst: f64,
}

/// A view with all that is true of it.
pub(super) struct Seen {
    number: u32,
    pub(super) desc: FrameDesc,
    facing: Vec<bool>,
    /// For each softness.
    truths: Vec<Truth>,
}

/// What is true with one softness.
struct Truth {
    shadow: Vec<f32>,
    /// The class of the slope of pixels without shadow.
    lit: Vec<Option<usize>>,
    /// Pixels in full shadow whose caster is near.
    feet: Vec<bool>,
    /// Around legs of chairs.
    contact: Option<(Ground, Vec<f32>)>,
}

impl Seen {
    pub(super) fn of(
        gpu: &Gpu,
        scene: &Scene,
        number: u32,
        drawn: &Drawn,
    ) -> Result<Self, LabError> {
        let desc = drawn.frame.desc;
        let light = &desc.light;
        let depths = (drawn.frame).light_samples(gpu, &even_positions(TRUTH_SAMPLES))?;
        let vector = |value: [f32; 3]| DVec3::from(value.map(f64::from));
        let slope = |pixel: usize| {
            let position = vector(drawn.pixels.position[pixel]);
            let cosine = vector(drawn.pixels.normal[pixel]).dot(light.towards_light(position));
            (cosine.clamp(-1.0, 1.0).acos().to_degrees() / 10.0).round() as usize
        };
        let truth = |taps| {
            let shadow = pcf(light, &depths, taps, &drawn.pixels)?;
            let facing = |(pixel, shadow): (usize, &f32)| {
                (drawn.facing[pixel] && drawn.pixels.covered[pixel]).then_some((pixel, *shadow))
            };
            let pixels = || shadow.iter().enumerate().map(facing);
            let lit = pixels().map(|pixel| {
                let (pixel, _) = pixel.filter(|(_, shadow)| *shadow < PENUMBRA[0])?;
                Some(slope(pixel)).filter(|class| *class < SLOPES)
            });
            let feet = pixels().map(|pixel| {
                pixel.is_some_and(|(pixel, shadow)| {
                    shadow > PENUMBRA[1]
                        && is_near(light, &depths, vector(drawn.pixels.position[pixel]))
                })
            });
            let contact = (scene.name == CHAIRS).then(|| {
                let ground = ground_around_legs(scene);
                let truth = pcf_at(light, &depths, taps, &ground.receivers);
                (ground, truth)
            });
            Ok(Truth {
                lit: lit.collect(),
                feet: feet.collect(),
                contact,
                shadow,
            })
        };
        let truths: Result<_, LabError> = drawn.kernels.iter().map(truth).collect();
        Ok(Self {
            number,
            desc,
            facing: drawn.facing.clone(),
            truths: truths?,
        })
    }
}

/// Whether the caster on a receiver's own ray is at its feet.
fn is_near(light: &LightView, depths: &MomentDepths, receiver: DVec3) -> bool {
    let Some(uv) = light.uv(receiver) else {
        return false;
    };
    let size = depths.size();
    let [x, y] = [uv.x * f64::from(size[0]), uv.y * f64::from(size[1])];
    let Some(&caster) = depths.row(y as usize, 0, x as usize, 1).first() else {
        return false;
    };
    let [near, far] = light.range;
    let distance = 0.5 * (light.moment_depth(receiver) - caster) * (far - near);
    let [width, height] = light.texel_size(size);
    let spread = match light.kind() {
        LightKind::Directional => 1.0,
        LightKind::Spot => light.distance(receiver),
    };
    distance > 0.0 && distance <= FEET * width.max(height) * spread
}

/// Two frames that follow each other.
type Frames = [Vec<f32>; 2];

/// A technique on a view.
pub(super) struct Judge<'a> {
    pub(super) gpu: &'a Gpu,
    pub(super) scene: &'a Scene,
    pub(super) seen: &'a Seen,
    pub(super) softness: usize,
    /// The constant bias in widths of a texel; none for ours on a slope of 45 degrees.
    pub(super) constant: Option<f64>,
    pub(super) step: [f64; 2],
}

impl Judge<'_> {
    /// Judges a graph that has just run on a frame of the view, which is as it was afterwards.
    pub(super) fn judge(
        &self,
        frame: &mut Frame,
        run: &MapRun,
    ) -> Result<(ViewScores, Vec<Part>), LabError> {
        let truth = &self.seen.truths[self.softness];
        let width = frame.desc.picture[0];
        let crop = |[shown, beside]: [&[f32]; 2], judged: &[bool], full| {
            // What is not judged is not shown to differ.
            let pixels = shown.iter().zip(beside).zip(judged);
            let shown: Vec<f32> = pixels
                .map(|((shown, beside), judged)| if *judged { *shown } else { *beside })
                .collect();
            Crop::of((self.seen.number, width), [&shown, beside], judged, full)
        };
        let mut crops = Vec::new();
        let ours = run.graph.read_shadow(self.gpu, &run.file)?;
        let contact = self.contact(frame, run)?;
        let constant = self.biased(frame, run, self.constant_bias(frame, run)?)?;
        let none = self.biased(frame, run, ReceiverBias::NONE)?;
        let lit: Vec<bool> = truth.lit.iter().map(Option::is_some).collect();
        for (bias, shadow) in [("constant bias", &constant), ("our bias", &ours)] {
            crops.push((0, bias, crop([shadow, &truth.shadow], &lit, FULL)?));
            crops.push((1, bias, crop([shadow, &none], &truth.feet, FULL_OF_SMALL)?));
        }
        if let Some((_, crop)) = &contact {
            crops.push((2, "our bias", crop.clone()));
        }
        let flicker = self.flicker(frame, run)?;
        if let Some((_, [before, after])) = &flicker {
            let crop = crop([after, before], &self.seen.facing, FULL_OF_SMALL)?;
            crops.push((3, "our bias", crop));
        }
        let scores = ViewScores {
            view: self.seen.number,
            acne: Biases {
                constant: acne(&truth.lit, &constant),
                ours: acne(&truth.lit, &ours),
            },
            peter_panning: Biases {
                constant: lost(&truth.feet, [&none, &constant]),
                ours: lost(&truth.feet, [&none, &ours]),
            },
            contact: contact.map(|(leaking, _)| leaking),
            flicker: flicker.map(|(flicker, _)| flicker),
        };
        Ok((scores, crops))
    }

    /// The constant bias for a graph.
    fn constant_bias(&self, frame: &Frame, run: &MapRun) -> Result<ReceiverBias, LabError> {
        let ours = receiver_bias(&frame.desc, &run.file)?;
        let texel = light_view(&frame.desc).depth_per_texel(frame.desc.map) as f32;
        let constant = match self.constant {
            Some(texels) => texels as f32 * texel,
            None => ours.constant + ours.slope_scale * texel,
        };
        Ok(ReceiverBias {
            constant,
            maximum: constant,
            ..ReceiverBias::NONE
        })
    }

    /// The picture with another receiver bias.
    fn biased(
        &self,
        frame: &Frame,
        run: &MapRun,
        bias: ReceiverBias,
    ) -> Result<Vec<f32>, LabError> {
        let graph = &run.graph;
        graph.fill_biased(self.gpu, &frame.desc, &run.file, bias)?;
        graph.run(self.gpu)?;
        graph.read_shadow(self.gpu, &run.file)
    }

    /// What is too light around legs, and the leg with most of it.
    fn contact(&self, frame: &Frame, run: &MapRun) -> Result<Option<(f64, Crop)>, LabError> {
        let Some((ground, truth)) = &self.seen.truths[self.softness].contact else {
            return Ok(None);
        };
        let FrameDesc { light, map, .. } = &frame.desc;
        let points = ground.receivers.iter();
        let points: Vec<MapPoint> =
            (points.map(|receiver| MapPoint::of_plane(light, *map, receiver))).collect();
        let map = run.map(frame)?;
        let shaded = MapEvaluator::new(self.gpu, &map, None)?.run(run.shading, &points)?;
        let errors = ContactErrors::of(map.technique(), &shaded, truth);
        // The legs' squares, one below the other.
        let square = (POINTS * POINTS) as usize;
        let mut pictures = [Vec::new(), Vec::new()];
        let squares = ground.places.last().map_or(0, |last| last / square + 1);
        for (picture, values) in pictures.iter_mut().zip([&shaded, truth]) {
            *picture = vec![0.0; squares * square];
            for (&place, &value) in ground.places.iter().zip(values) {
                picture[place] = value;
            }
        }
        let [shaded, truth] = pictures.each_ref().map(|it| it.chunks_exact(square));
        let mut worst: Option<Crop> = None;
        for pictures in shaded.zip(truth) {
            let all = vec![true; square];
            let pictures = [pictures.0, pictures.1];
            let crop = Crop::of((self.seen.number, POINTS), pictures, &all, FULL)?;
            if worst.as_ref().is_none_or(|worst| crop.error > worst.error) {
                worst = Some(crop);
            }
        }
        Ok(worst.map(|crop| (errors.leaking, crop)))
    }

    /// What changes while the light's map slides, with the two frames that differ most.
    fn flicker(
        &self,
        frame: &mut Frame,
        run: &MapRun,
    ) -> Result<Option<(Flicker, Frames)>, LabError> {
        let still = frame.desc;
        if still.light.kind() != LightKind::Directional {
            return Ok(None);
        }
        let (mut changes, mut worst) = (Vec::new(), [Vec::new(), Vec::new()]);
        let mut before: Option<Vec<f32>> = None;
        for number in 0..=FRAMES {
            let by = f64::from(number) * DVec2::from_array(self.step);
            let light = still.light.slid(by, still.map);
            frame.redraw(self.gpu, self.scene, FrameDesc { light, ..still })?;
            run.graph.fill(self.gpu, &frame.desc, &run.file, None)?;
            run.graph.run(self.gpu)?;
            let now = run.graph.read_shadow(self.gpu, &run.file)?;
            if let Some(before) = before.replace(now.clone()) {
                let change = mean(self.facing().map(|pixel| change(before[pixel], now[pixel])));
                let Some(change) = change else {
                    return Ok(None);
                };
                if changes.iter().all(|other| change > *other) {
                    worst = [before, now];
                }
                changes.push(change);
            }
        }
        frame.redraw(self.gpu, self.scene, still)?;
        let flicker = Flicker {
            mean: changes.iter().sum::<f64>() / f64::from(FRAMES),
            worst: changes.iter().copied().fold(0.0, f64::max),
        };
        Ok(Some((flicker, worst)))
    }

    fn facing(&self) -> impl Iterator<Item = usize> {
        let facing = self.seen.facing.iter().enumerate();
        facing
            .filter(|(_, facing)| **facing)
            .map(|(pixel, _)| pixel)
    }
}

/// A change of shadow intensity; a NaN counts as one of 1.
fn change(before: f32, now: f32) -> f64 {
    let change = f64::from((now - before).abs());
    if change.is_nan() { 1.0 } else { change }
}

fn acne(lit: &[Option<usize>], shadow: &[f32]) -> Option<Acne> {
    let (mut sums, mut visible, mut counts) = ([0.0; SLOPES], [0.0; SLOPES], [0; SLOPES]);
    for (class, &shadow) in lit.iter().zip(shadow) {
        if let Some(class) = *class {
            // A NaN is black.
            let shadow = if shadow.is_nan() { 1.0 } else { shadow };
            sums[class] += f64::from(shadow);
            visible[class] += f64::from(u8::from(shadow > VISIBLE));
            counts[class] += 1;
        }
    }
    let classes = |sums: [f64; SLOPES]| -> [Option<f64>; SLOPES] {
        core::array::from_fn(|class| {
            (counts[class] >= FEWEST).then(|| sums[class] / counts[class] as f64)
        })
    };
    let slopes = classes(sums);
    Some(Acne {
        mean: mean(slopes.into_iter().flatten())?,
        visible: mean(classes(visible).into_iter().flatten())?,
        slopes,
    })
}

/// What is lost of shadow, from the first picture to the second.
fn lost(feet: &[bool], [whole, left]: [&[f32]; 2]) -> Option<f64> {
    if feet.iter().filter(|feet| **feet).count() < FEWEST {
        return None;
    }
    let pairs = feet.iter().zip(whole.iter().zip(left));
    let lost = pairs.filter(|(feet, _)| **feet);
    mean(lost.map(|(_, (whole, left))| f64::from((whole - left).max(0.0))))
}
