//! One pixel: the depths under its filter, and what each technique makes of them, step by step from the truth to what is shown.

use core::fmt;
use core::fmt::Write;

use glam::{DVec2, DVec3};
use moment_shadows::{LeakReduction, ReceiverBias};
use serde::Serialize;

use super::chart::{colour, escaped};
use crate::candidate::Candidate;
use crate::command::drawn::Drawn;
use crate::command::render::RenderOptions;
use crate::cost::table::Columns;
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::shade_parameters;
use crate::host::{read_depth_samples, read_gbuffer};
use crate::judgement::Unfiltered;
use crate::oracle::ideal::Ideal;
use crate::scene::Scene;
use crate::surface_error::{Evaluation, MapEvaluator, MapPoint, MapRun};
use crate::techniques::described;
use crate::truth::fragment::fragments;
use crate::truth::kernel::even_positions;
use crate::truth::lookup::under;
use crate::truth::pcf::{Receiver, pcf_at};

/// A pixel under the microscope.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Inspection {
    /// Column and row in the picture.
    pub pixel: [u32; 2],
    /// Where it looks the map up.
    pub uv: [f64; 2],
    /// The fragment's moment depth after the receiver bias.
    pub fragment_depth: f64,
    /// How far the receiver bias has moved it towards the light.
    pub receiver_bias: f64,
    /// Shadow intensity by 64 samples per texel in front of the receiver's plane.
    pub truth: f64,
    /// The same by the map's own samples.
    pub sampled: f64,
    /// Moment depths under the filter with their shares, ascending; those that are closer than a thousandth of the range are one.
    pub depths: Vec<[f64; 2]>,
    /// What each technique makes of them.
    pub techniques: Vec<Steps>,
}

/// Shadow intensity, step by step.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Steps {
    /// The technique with its settings.
    pub name: String,
    /// The storage.
    pub storage: String,
    /// What the technique gives for these depths, without any bias but the receiver's.
    pub bound: f64,
    /// And with the bias of the storage.
    pub biased: f64,
    /// And stored and filtered with the rounding of the storage, by the shader.
    pub stored: f64,
    /// And after leak reduction: what is shown.
    pub shown: f64,
}

/// Depths that are closer than this are told as one.
const TOGETHER: f64 = 2e-3;

/// Samples per texel that the truth is made of.
const TRUTH_SAMPLES: u32 = 64;

/// Looks at a pixel of a scene with every candidate in place of the graph's technique. Candidates that read the plain depth map have
/// no steps and are left out.
pub fn inspect(
    gpu: &Gpu,
    scene: &Scene,
    (options, drawn): (&RenderOptions, &Drawn),
    file: &GraphFile,
    candidates: &[Candidate],
    pixel: [u32; 2],
) -> Result<Inspection, LabError> {
    let frame = options.frame(gpu, scene, drawn, file.radius()?)?;
    let [width, height] = drawn.picture;
    let outside = |why: &str| LabError::refused(format!("pixel {},{} {why}", pixel[0], pixel[1]));
    if pixel[0] >= width || pixel[1] >= height {
        return Err(outside(&format!(
            "is outside of the picture of {width}x{height}"
        )));
    }
    let index = (pixel[1] * width + pixel[0]) as usize;
    let parameters = shade_parameters(&frame.desc, file)?;
    let camera_depth = read_depth_samples(gpu, &frame.surface.depth)?;
    let lookup = fragments(&parameters, &camera_depth, drawn.map)[index];
    let lookup = lookup.ok_or_else(|| outside("shows nothing that the light's map holds"))?;
    let pixels = read_gbuffer(gpu, &frame.surface)?;
    let vector = |value: [f32; 3]| DVec3::from_array(value.map(f64::from));
    let receiver = Receiver {
        position: vector(pixels.position[index]),
        normal: vector(pixels.normal[index]),
    };
    let light = &frame.desc.light;
    let Unfiltered { depths, taps } = Unfiltered::of(gpu, &frame, file)?;
    let fine = frame.light_samples(gpu, &even_positions(TRUTH_SAMPLES))?;
    let in_front = |depths| f64::from(pcf_at(light, depths, &taps, &[receiver])[0]);
    let [samples, weights] = under(&depths, &taps, lookup.uv);
    let mut all: Vec<(f64, f64)> = samples
        .iter()
        .copied()
        .zip(weights.iter().copied())
        .collect();
    all.sort_by(|one, other| one.0.total_cmp(&other.0));
    let mut told = Vec::new();
    for group in all.chunk_by(|one, other| other.0 - one.0 < TOGETHER) {
        let share: f64 = group.iter().map(|(_, weight)| weight).sum();
        let mean = group
            .iter()
            .map(|(depth, weight)| depth * weight)
            .sum::<f64>()
            / share;
        if share > 0.0 {
            told.push([mean, share]);
        }
    }
    let mut techniques = Vec::new();
    for candidate in candidates
        .iter()
        .filter(|candidate| !candidate.reads_depth())
    {
        let graph = candidate.graph(file)?;
        let run = MapRun::new(gpu, &frame, &graph)?;
        let map = run.map(&frame)?;
        let (technique, storage) = (map.evaluated(), map.storage());
        let evaluator = MapEvaluator::new(gpu, &map, None)?;
        // The fragment is known: nothing moves it further.
        let point = MapPoint::new(
            DVec2::from_array(lookup.uv),
            lookup.fragment_depth,
            DVec2::ZERO,
        );
        let shown = |leak_reduction| {
            let evaluation = Evaluation {
                receiver_bias: ReceiverBias::NONE,
                leak_reduction,
                ..run.shading
            };
            Ok::<_, LabError>(f64::from(evaluator.run(evaluation, &[point])?[0]))
        };
        let ideal = |storage| {
            let ideal = Ideal::of(&technique, storage)?;
            Some(ideal.shadow_intensity(&samples, &weights, lookup.fragment_depth))
        };
        let (Some(bound), Some(biased)) = (ideal(None), ideal(storage)) else {
            continue;
        };
        techniques.push(Steps {
            name: described(&map.technique()),
            storage: storage.map_or("", |storage| storage.name()).to_owned(),
            bound,
            biased,
            stored: shown(LeakReduction::NONE)?,
            shown: shown(run.shading.leak_reduction)?,
        });
    }
    Ok(Inspection {
        pixel,
        uv: lookup.uv,
        fragment_depth: lookup.fragment_depth,
        receiver_bias: light.moment_depth(receiver.position) - lookup.fragment_depth,
        truth: in_front(&fine),
        sampled: in_front(&depths),
        depths: told,
        techniques,
    })
}

impl fmt::Display for Inspection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y] = self.pixel;
        let [u, v] = self.uv;
        writeln!(
            f,
            "pixel {x},{y} looks the map up at {u:.5}, {v:.5}; its fragment is at moment depth {:.5}, {:.5} nearer to the light than its \
             surface",
            self.fragment_depth, self.receiver_bias
        )?;
        writeln!(
            f,
            "truth {:.4} (64 samples per texel); {:.4} by the samples of the map\n\nunder the filter",
            self.truth, self.sampled
        )?;
        for [depth, share] in &self.depths {
            let side = if *depth < self.fragment_depth {
                "in front"
            } else {
                "behind"
            };
            writeln!(f, "  {:6.2} %  at {depth:8.5}  {side}", 100.0 * share)?;
        }
        writeln!(f)?;
        let signed = |step: f64| match step.abs() < 5e-5 {
            true => "0".to_owned(),
            false => format!("{step:+.4}"),
        };
        let cells = |steps: &Steps| {
            vec![
                ("technique", steps.name.clone()),
                ("storage", steps.storage.clone()),
                ("truth", format!("{:.4}", self.truth)),
                ("samples", signed(self.sampled - self.truth)),
                ("bound", signed(steps.bound - self.sampled)),
                ("bias", signed(steps.biased - steps.bound)),
                ("storage, filter", signed(steps.stored - steps.biased)),
                ("leak reduction", signed(steps.shown - steps.stored)),
                ("shown", format!("{:.4}", steps.shown)),
                ("error", signed(steps.shown - self.truth)),
            ]
        };
        write!(
            f,
            "{}",
            Columns(&Vec::from_iter(self.techniques.iter().map(cells)))
        )
    }
}

/// Width and height of the picture, and of its margins.
const SIZE: [f64; 2] = [760.0, 420.0];
const MARGIN: [f64; 2] = [52.0, 40.0];

impl Inspection {
    /// The share of depths in front of each depth, the fragment, and what techniques show there, as SVG.
    #[must_use]
    pub fn svg(&self) -> String {
        let [width, height] = SIZE;
        let [left, below] = MARGIN;
        let ends = self
            .depths
            .iter()
            .map(|[depth, _]| *depth)
            .chain([self.fragment_depth]);
        let [low, high] = ends.fold([1.0_f64, -1.0_f64], |[low, high], depth| {
            [low.min(depth), high.max(depth)]
        });
        let room = (0.08 * (high - low)).max(0.01);
        let [low, high] = [low - room, high + room];
        let right = width - 190.0;
        let x = |depth: f64| left + (depth - low) / (high - low) * (right - left);
        let y = |share: f64| height - below - share * (height - below - 20.0);
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"system-ui, sans-serif\" \
             font-size=\"12\">\n<rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n"
        );
        // Writing into a string does not fail.
        let mut put = |line: String| {
            let _ = writeln!(svg, "{line}");
        };
        for tick in [0.0, 0.25, 0.5, 0.75, 1.0] {
            let at = y(tick);
            put(format!(
                "<path d=\"M{left} {at:.1}H{right}\" stroke=\"#e4e4e4\"/>"
            ));
            let (end, base) = (left - 7.0, at + 4.0);
            put(format!(
                "<text x=\"{end}\" y=\"{base:.1}\" text-anchor=\"end\">{tick}</text>"
            ));
        }
        for step in 0..=4 {
            let depth = low + (high - low) * f64::from(step) / 4.0;
            let (at, base) = (x(depth), height - below + 17.0);
            put(format!(
                "<text x=\"{at:.1}\" y=\"{base}\" text-anchor=\"middle\">{depth:.3}</text>"
            ));
        }
        let (middle, base) = (0.5 * (left + right), height - 6.0);
        put(format!(
            "<text x=\"{middle}\" y=\"{base}\" text-anchor=\"middle\">moment depth</text>"
        ));
        let mut line = format!("M{left} {:.1}", y(0.0));
        let mut sum = 0.0;
        for [depth, share] in &self.depths {
            sum += share;
            line += &format!("H{:.1}V{:.1}", x(*depth), y(sum));
        }
        put(format!(
            "<path d=\"{line}H{right}\" fill=\"none\" stroke=\"#222\" stroke-width=\"2\"/>"
        ));
        let fragment = x(self.fragment_depth);
        put(format!(
            "<path d=\"M{fragment:.1} 20V{}\" stroke=\"#d55e00\" stroke-dasharray=\"5 4\"/>",
            height - below
        ));
        let mut shown: Vec<(usize, &Steps)> = self.techniques.iter().enumerate().collect();
        shown.sort_by(|one, other| other.1.shown.total_cmp(&one.1.shown));
        let mut last = 0.0_f64;
        for (number, steps) in shown {
            let at = y(steps.shown);
            let colour = colour(number);
            put(format!(
                "<circle cx=\"{fragment:.1}\" cy=\"{at:.1}\" r=\"4\" fill=\"{colour}\"/>"
            ));
            // Names stand below each other where intensities are close.
            last = at.max(last + 13.0);
            let (name, beside) = (
                escaped(&format!("{} {}", steps.name, steps.storage)),
                right + 22.0,
            );
            put(format!(
                "<path d=\"M{fragment:.1} {at:.1}L{right} {last:.1}H{}\" fill=\"none\" stroke=\"{colour}\" stroke-opacity=\"0.5\"/>",
                right + 18.0
            ));
            put(format!(
                "<text x=\"{beside}\" y=\"{:.1}\" font-size=\"11\">{name}</text>",
                last + 4.0
            ));
        }
        svg += "</svg>\n";
        svg
    }
}
