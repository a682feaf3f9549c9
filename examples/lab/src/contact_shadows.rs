//! Shadows at contacts: what a march through the camera's depth adds to what maps say, against the truth of pictures.
//!
//! - **Leak**: the mean of what is too light on the ground within [`BAND`] of the legs of the scene of chairs, over pixels in full shadow.
//! - **False shadow**: the share of lit pixels that the march makes darker by more than [`VISIBLE`].
//! - **Error**: the mean absolute error over all pixels that face the light.
//!
//! Lit and in full shadow are what the truth says, under the kernel of the graph and with 64 samples per texel. Where a surface lies almost along
//! the light's rays, no depth under the kernel can be told from its plane, and that truth finds no caster; so a pixel is lit only where
//! nothing stands on the ray from its middle to the light, either.

use core::fmt;

use glam::{DVec2, DVec3};
use moment_shadows::ContactShadows;
use serde::Serialize;

use crate::contacts::{BAND, FULL};
use crate::error::LabError;
use crate::frame::{Frame, FrameDesc};
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::GraphFrame;
use crate::host::SurfacePixels;
use crate::light::LightShape;
use crate::metric::{PENUMBRA, compare};
use crate::scene::{CHAIRS, Foot, Scene, feet};
use crate::scores::VISIBLE;
use crate::trade::axes::Cell;
use crate::trade::results::{Setting, mean};
use crate::trade::{Drawn, Stage, TRUTH_SAMPLES, Trade, tell_of_views};
use crate::truth::area_light::AreaLight;
use crate::truth::kernel::even_positions;
use crate::truth::pcf::pcf;

/// What is judged.
#[derive(Clone, Debug)]
pub struct ContactTrial {
    /// Scenes, views and combinations.
    pub trade: Trade,
    /// The reach of the march.
    pub contact: ContactShadows,
    /// Its steps.
    pub steps: u32,
}

/// With maps alone, and with the march.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Both<T> {
    /// With maps alone.
    pub maps: T,
    /// With the march.
    pub march: T,
}

/// What a view gives.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ViewContacts {
    /// The number of the view.
    pub view: u32,
    /// Pixels on the ground around legs that are in full shadow; 0 in scenes without known feet.
    pub in_full_shadow: usize,
    /// The mean of what is too light there.
    pub leak: Option<Both<f64>>,
    /// Pixels that face the light, which nothing keeps from them.
    pub lit: usize,
    /// The share of them that the march makes visibly darker.
    pub false_shadow: Option<f64>,
    /// The mean absolute error over what faces the light.
    pub error: Both<f64>,
}

/// A combination on a scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ContactRow {
    /// The scene as it was named.
    pub scene: String,
    /// The combination.
    #[serde(flatten)]
    pub cell: Cell,
    /// The technique and its storage.
    pub name: String,
    /// Views, one by one.
    pub views: Vec<ViewContacts>,
}

/// All that was found.
#[derive(Clone, Debug, Serialize)]
pub struct ContactReport {
    /// What is the same for all scenes, as in `results.json` of a trade.
    pub setting: Setting,
    /// The length of the march, and the thickness of surfaces.
    pub reach: [f64; 2],
    /// The most steps.
    pub steps: u32,
    /// Combinations on scenes.
    pub rows: Vec<ContactRow>,
}

/// A view with all that is true of it, for each softness.
struct Seen {
    number: u32,
    desc: FrameDesc,
    facing: Vec<bool>,
    /// Pixels on the ground around legs.
    near_legs: Vec<bool>,
    /// Pixels whose middle the light reaches.
    reached: Vec<bool>,
    truths: Vec<Vec<f32>>,
}

impl ContactTrial {
    /// Judges everything. `done` is called after each combination on a scene.
    pub fn run(&self, mut done: impl FnMut()) -> Result<ContactReport, LabError> {
        let file = Trade::graph()?;
        let axes = &self.trade.axes;
        let gpu = Gpu::open(self.trade.profile)?;
        let setting = self.trade.setting(&gpu)?;
        let mut rows = Vec::new();
        for name in &self.trade.scenes {
            tell_of_views(name)?;
            let (scene, setups) = self.trade.load(name)?;
            let stage = Stage::of(&gpu, (&file, axes), &setting, &scene);
            let mut seen = Vec::new();
            for (number, setup) in (setting.views[1]..).zip(&setups) {
                let drawn = stage.drawn(number, setup)?;
                seen.push(Seen::of(&gpu, &scene, number, &drawn)?);
            }
            for cell in axes.cells() {
                let file = axes.graph(&file, cell)?.in_single_precision()?;
                let views = seen
                    .iter()
                    .map(|seen| self.view(&gpu, &scene, seen, cell, &file));
                rows.push(ContactRow {
                    scene: name.clone(),
                    cell,
                    name: format!("{}", axes.candidates[cell.candidate]),
                    views: views.collect::<Result<_, _>>()?,
                });
                done();
            }
        }
        Ok(ContactReport {
            setting,
            reach: [self.contact.length, self.contact.thickness],
            steps: self.steps,
            rows,
        })
    }

    /// A combination on a view.
    fn view(
        &self,
        gpu: &Gpu,
        scene: &Scene,
        seen: &Seen,
        cell: Cell,
        file: &GraphFile,
    ) -> Result<ViewContacts, LabError> {
        let desc = FrameDesc {
            map: [cell.map; 2],
            samples: cell.samples,
            ..seen.desc
        };
        let frame = Frame::draw(gpu, scene, desc)?;
        let (file, of_maps) = file.with_contact_shadows(self.steps)?;
        let graph = GraphFrame::new(gpu, &frame, &file)?;
        graph.fill_contacts(gpu, &desc, &file, self.contact)?;
        graph.run(gpu)?;
        let maps = graph.read_output(gpu, &file, &of_maps)?;
        let march = graph.read_shadow(gpu, &file)?;
        let truth = &seen.truths[self.trade.axes.softness(cell)];
        seen.judge(truth, [&maps, &march])
    }
}

impl Seen {
    fn of(gpu: &Gpu, scene: &Scene, number: u32, drawn: &Drawn) -> Result<Self, LabError> {
        let desc = drawn.frame.desc;
        let depths = (drawn.frame).light_samples(gpu, &even_positions(TRUTH_SAMPLES))?;
        let truth = |taps| pcf(&desc.light, &depths, taps, &drawn.pixels);
        let truths: Result<_, LabError> = drawn.kernels.iter().map(truth).collect();
        let feet = if scene.name == CHAIRS {
            feet(scene)
        } else {
            Vec::new()
        };
        let light = desc.light;
        let shape = LightShape::point(light.kind());
        let hidden = AreaLight::new(scene, &light, shape, 1)?.picture(&drawn.pixels)?;
        Ok(Self {
            number,
            desc,
            reached: hidden.iter().map(|&hidden| hidden == 0.0).collect(),
            facing: drawn.facing.clone(),
            near_legs: near_legs(&feet, &drawn.pixels),
            truths: truths?,
        })
    }

    fn judge(&self, truth: &[f32], [maps, march]: [&[f32]; 2]) -> Result<ViewContacts, LabError> {
        let pixels = || (0..truth.len()).filter(|&pixel| self.facing[pixel]);
        let at_feet: Vec<usize> = pixels()
            .filter(|&pixel| self.near_legs[pixel] && truth[pixel] > FULL)
            .collect();
        let leak = |shown: &[f32]| {
            let too_light = |&pixel: &usize| f64::from((truth[pixel] - shown[pixel]).max(0.0));
            mean(at_feet.iter().map(too_light))
        };
        let lit: Vec<usize> = pixels()
            .filter(|&pixel| truth[pixel] < PENUMBRA[0] && self.reached[pixel])
            .collect();
        let darker = |&pixel: &usize| f64::from(u8::from(march[pixel] - maps[pixel] > VISIBLE));
        let error = |shown: &[f32]| {
            compare(shown, truth, &self.facing).map(|found| found.facing.mean_absolute)
        };
        Ok(ViewContacts {
            view: self.number,
            in_full_shadow: at_feet.len(),
            leak: leak(maps)
                .zip(leak(march))
                .map(|(maps, march)| Both { maps, march }),
            lit: lit.len(),
            false_shadow: mean(lit.iter().map(darker)),
            error: Both {
                maps: error(maps)?,
                march: error(march)?,
            },
        })
    }
}

/// Which pixels show the ground within [`BAND`] of a leg.
fn near_legs(feet: &[Foot], pixels: &SurfacePixels) -> Vec<bool> {
    let near = |position: &[f32; 3], normal: &[f32; 3]| {
        let position = DVec3::from(position.map(f64::from));
        let across =
            |foot: &Foot| DVec2::new(position.x - foot.centre.x, position.z - foot.centre.z);
        normal[1] > 0.99
            && feet.iter().any(|foot| {
                let distance = across(foot).length();
                (position.y - foot.centre.y).abs() < 1e-3
                    && distance > foot.radius
                    && distance <= foot.radius + BAND
            })
    };
    let pixels = pixels.position.iter().zip(&pixels.normal);
    pixels
        .map(|(position, normal)| near(position, normal))
        .collect()
}

impl ContactRow {
    /// The mean leak over pixels of all views, and what the march leaves of it.
    #[must_use]
    pub fn leak(&self) -> Option<Both<f64>> {
        let views = self.views.iter();
        let pixels: usize = views.clone().map(|view| view.in_full_shadow).sum();
        let sum = |of: fn(&Both<f64>) -> f64| {
            let sums = views
                .clone()
                .filter_map(|view| Some(of(view.leak.as_ref()?) * view.in_full_shadow as f64));
            sums.sum::<f64>() / pixels as f64
        };
        (pixels > 0).then(|| Both {
            maps: sum(|it| it.maps),
            march: sum(|it| it.march),
        })
    }

    /// The share of lit pixels of all views that the march makes visibly darker.
    #[must_use]
    pub fn false_shadow(&self) -> Option<f64> {
        let lit: usize = self.views.iter().map(|view| view.lit).sum();
        let dark = self
            .views
            .iter()
            .filter_map(|view| Some(view.false_shadow? * view.lit as f64));
        (lit > 0).then(|| dark.sum::<f64>() / lit as f64)
    }

    /// The mean of the views' errors.
    #[must_use]
    pub fn error(&self) -> Option<Both<f64>> {
        let maps = mean(self.views.iter().map(|view| view.error.maps));
        let march = mean(self.views.iter().map(|view| view.error.march));
        maps.zip(march).map(|(maps, march)| Both { maps, march })
    }
}

impl fmt::Display for ContactReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let percent =
            |figure: Option<f64>| figure.map_or("-".to_owned(), |it| format!("{:.3}", 100.0 * it));
        writeln!(
            f,
            "{:<18} {:<22} {:>5} {:>7} {:>6} {:>8} {:>9} {:>9} {:>9} {:>9}",
            "scene",
            "technique",
            "map",
            "samples",
            "view",
            "leak",
            "marched",
            "false",
            "error",
            "marched"
        )?;
        for row in &self.rows {
            let mut line = |view: &str, leak: Option<Both<f64>>, dark, error: Option<Both<f64>>| {
                writeln!(
                    f,
                    "{:<18} {:<22} {:>5} {:>7} {view:>6} {:>8} {:>9} {:>9} {:>9} {:>9}",
                    row.scene,
                    row.name,
                    row.cell.map,
                    row.cell.samples,
                    percent(leak.map(|it| it.maps)),
                    percent(leak.map(|it| it.march)),
                    percent(dark),
                    percent(error.map(|it| it.maps)),
                    percent(error.map(|it| it.march)),
                )
            };
            for view in &row.views {
                line(
                    &view.view.to_string(),
                    view.leak,
                    view.false_shadow,
                    Some(view.error),
                )?;
            }
            line("all", row.leak(), row.false_shadow(), row.error())?;
        }
        let [length, thickness] = self.reach;
        writeln!(
            f,
            "\nPercent. leak: what is too light on the ground within 3 cm of legs, of full shadow, by maps alone and with a march of {length} over \
             surfaces\nof {thickness} in at most {} steps; false: lit pixels that the march makes darker by more than a tenth; error: mean absolute error \
             over what\nfaces the light.",
            self.steps
        )
    }
}
