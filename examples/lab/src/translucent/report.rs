//! What is measured: stacks of casters in every storage, and a plume of smoke.

use core::fmt;
use std::path::Path;

use moment_shadows::{MapEncoding, Opacity, Storage, Technique};
use serde::Serialize;

use super::casters::{Caster, Texture, plume, stack};
use super::stage::{Surfaces, TranslucentStage};
use crate::error::LabError;
use crate::picture::{grey, save_panels, signed_difference};

/// Casters over each other in one map.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StackRow {
    /// Technique and storage.
    pub map: String,
    /// How many casters.
    pub casters: u32,
    /// Whether the opacity differs from texel to texel.
    pub textured: bool,
    /// Whether all lie in a hundredth of the light's range; otherwise apart.
    pub cloud: bool,
    /// The moment bias for so many.
    pub bias: f64,
    /// How far the bound is above 1 - transmittance, at most.
    pub above: f64,
    /// How far it is below, on average.
    pub below: f64,
}

/// A plume of smoke in one map.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PlumeRow {
    /// Technique and storage.
    pub map: String,
    /// The mean error within the plume's section: its shadow on itself, and on what lies between.
    pub itself: f64,
    /// The mean error on the floor behind it.
    pub floor: f64,
    /// The greatest excess over the truth, of both.
    pub above: f64,
}

/// All that is measured.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TransmittanceReport {
    /// Stacks of casters.
    pub stacks: Vec<StackRow>,
    /// The plume.
    pub plumes: Vec<PlumeRow>,
}

/// Every map that so many casters are blended into, with its moment bias; none where a smallest variance stands for it.
pub(super) fn maps(
    stage: &TranslucentStage,
    casters: u32,
    textured: bool,
) -> Result<Vec<(MapEncoding, Option<f64>)>, LabError> {
    let mut all = Vec::new();
    for technique in Technique::examples() {
        let row = technique.row();
        for &storage in row
            .storages
            .iter()
            .filter(|it| row.blended.is_some() && !it.is_packed())
        {
            let plain = MapEncoding::new(technique.clone(), storage)?;
            let encoding = blended(stage, &plain, casters, textured)?;
            let blends = encoding.blends();
            let bias = match technique {
                Technique::Hamburger4 => Some(storage.moment_bias().with_blends(blends).alpha),
                Technique::Hausdorff4 => {
                    Some(storage.hausdorff_moment_bias().with_blends(blends).alpha)
                }
                Technique::Hamburger6 => storage
                    .six_moments_bias()
                    .map(|bias| bias.with_blends(blends).alpha),
                _ => None,
            };
            all.push((encoding, bias.map(f64::from)));
        }
    }
    Ok(all)
}

/// A map that so many casters are blended into, each of which counts as often as it is drawn.
fn blended(
    stage: &TranslucentStage,
    map: &MapEncoding,
    casters: u32,
    textured: bool,
) -> Result<MapEncoding, LabError> {
    let draws = match opacity_of(stage, map, textured) {
        Opacity::TwoDraws => 2,
        _ => 1,
    };
    Ok(map.clone().with_blends(draws * casters)?)
}

/// How a host blends into a map: by the fourth channel where that is free, and in two draws on a device without a second source.
pub(super) fn opacity_of(stage: &TranslucentStage, map: &MapEncoding, textured: bool) -> Opacity {
    let free = map.blend_states(Opacity::Alpha).is_ok();
    match (free, textured) {
        (true, _) => Opacity::Alpha,
        (false, true) if stage.has_second_source() => Opacity::SecondSource,
        (false, true) => Opacity::TwoDraws,
        (false, false) => Opacity::Constant,
    }
}

/// Casters over each other, in every map: how far the bound is from the truth in front of each, between them and behind them, beside
/// opaque casters and before them.
pub fn stacks(stage: &TranslucentStage, counts: &[u32]) -> Result<Vec<StackRow>, LabError> {
    let surfaces = Surfaces {
        // Opaque casters in the lower half.
        opaque: &|[_, y]| if y % 64 < 32 { 1.0 } else { 0.875 },
        // None at the depth of a caster.
        receiver: &|[x, _]| ((x % 64) as f32 + 0.7) / 64.0,
        blurred: false,
    };
    let mut rows = Vec::new();
    for &casters in counts {
        for (cloud, textured) in [(false, false), (false, true), (true, false), (true, true)] {
            let texture = if textured {
                Texture::Hashed
            } else {
                Texture::Even
            };
            let drawn = stack(casters, cloud, texture);
            let truth = stage.truth(&drawn, &surfaces)?;
            for (map, bias) in maps(stage, casters, textured)? {
                let opacity = opacity_of(stage, &map, textured);
                let found = stage.found(&map, opacity, &drawn, &surfaces)?;
                let (above, below) = errors(&found, &truth);
                rows.push(StackRow {
                    map: map.to_string(),
                    casters,
                    textured,
                    cloud,
                    bias: bias.unwrap_or(f64::NAN),
                    above,
                    below,
                });
            }
        }
    }
    Ok(rows)
}

/// The greatest excess, and the mean of what is missing.
pub(super) fn errors(found: &[f32], truth: &[f64]) -> (f64, f64) {
    let differences = || {
        let pairs = found.iter().zip(truth);
        pairs.map(|(found, truth)| f64::from(*found) - truth)
    };
    let above = differences().fold(f64::NEG_INFINITY, f64::max);
    let below: f64 = differences().map(|error| (-error).max(0.0)).sum();
    (above, below / truth.len() as f64)
}

/// A section through the plume, or the floor behind it: casters and the depth of receivers in a row, with the truth.
struct View {
    casters: Vec<Caster>,
    receiver: fn(f32) -> f32,
    truth: Vec<f64>,
}

impl View {
    fn both(stage: &TranslucentStage) -> Result<[Self; 2], LabError> {
        let of = |flat, receiver| {
            let casters = plume(stage.side(), flat);
            let truth = Vec::new();
            let mut view = Self {
                casters,
                receiver,
                truth,
            };
            view.truth = view.on(stage, |surfaces| stage.truth(&view.casters, surfaces))?;
            Ok::<_, LabError>(view)
        };
        Ok([of(true, |row| row)?, of(false, |_| 0.96)?])
    }

    /// What `shade` makes of its surfaces.
    fn on<T>(&self, stage: &TranslucentStage, shade: impl FnOnce(&Surfaces<'_>) -> T) -> T {
        let (side, receiver) = (stage.side() as f32, self.receiver);
        shade(&Surfaces {
            opaque: &|_| 1.0,
            receiver: &|[_, y]| receiver((y as f32 + 0.5) / side),
            blurred: true,
        })
    }

    fn found(&self, stage: &TranslucentStage, map: &MapEncoding) -> Result<Vec<f32>, LabError> {
        let opacity = opacity_of(stage, map, true);
        self.on(stage, |surfaces| {
            stage.found(map, opacity, &self.casters, surfaces)
        })
    }
}

/// The plume in every map.
pub fn plumes(stage: &TranslucentStage) -> Result<Vec<PlumeRow>, LabError> {
    let views = View::both(stage)?;
    let mut rows = Vec::new();
    for (map, _) in maps(stage, views[0].casters.len() as u32, true)? {
        let mut of_views = [(0.0, 0.0); 2];
        for (view, errors_of) in views.iter().zip(&mut of_views) {
            let found = view.found(stage, &map)?;
            let pairs = found.iter().zip(&view.truth);
            let sum: f64 = pairs
                .map(|(found, truth)| (f64::from(*found) - truth).abs())
                .sum();
            *errors_of = (sum / found.len() as f64, errors(&found, &view.truth).0);
        }
        let [itself, floor] = of_views;
        rows.push(PlumeRow {
            map: map.to_string(),
            itself: itself.0,
            floor: floor.0,
            above: itself.1.max(floor.1),
        });
    }
    Ok(rows)
}

/// Saves the plume in two maps: a row for its section, in which the light comes from above, and one for the floor. The truth is first, then
/// each map with its differences, a tenth of full shadow in full colour.
pub fn picture(stage: &TranslucentStage, path: &Path) -> Result<(), LabError> {
    let mut panels = Vec::new();
    for view in View::both(stage)? {
        let truth: Vec<f32> = view.truth.iter().map(|&truth| truth as f32).collect();
        panels.push(lit(&truth));
        for technique in [Technique::Hamburger4, Technique::Hamburger6] {
            let wanted = MapEncoding::new(technique, Storage::Unorm16)?;
            let casters = view.casters.len() as u32;
            let map = blended(stage, &wanted, casters, true)?;
            let found = view.found(stage, &map)?;
            panels.push(lit(&found));
            panels.push(signed_difference(&found, &truth, 0.1));
        }
    }
    save_panels(path, &panels, [stage.side(); 2], 5)
}

/// Light as a picture: white where there is no shadow.
fn lit(intensities: &[f32]) -> Vec<u8> {
    let light: Vec<f32> = intensities
        .iter()
        .map(|intensity| 1.0 - intensity)
        .collect();
    grey(&light)
        .into_iter()
        .flat_map(|grey| [grey, grey, grey, 255])
        .collect()
}

impl fmt::Display for TransmittanceReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "| map | opacity | casters | bias | above, at most | below, on average |"
        )?;
        writeln!(f, "|---|---|---|---|---|---|")?;
        for row in &self.stacks {
            let opacity = if row.textured { "textured" } else { "uniform" };
            let layout = if row.cloud { "cloud" } else { "apart" };
            let (map, casters, above, below) = (&row.map, row.casters, row.above, row.below);
            let bias = match row.bias {
                bias if bias.is_nan() => "-".to_owned(),
                bias => format!("{bias:.1e}"),
            };
            writeln!(
                f,
                "| {map} | {opacity}, {layout} | {casters} | {bias} | {above:.1e} | {below:.4} |"
            )?;
        }
        writeln!(
            f,
            "\nA plume of smoke; mean errors in percent of full shadow\n"
        )?;
        writeln!(f, "| map | on itself | on the floor | above, at most |")?;
        writeln!(f, "|---|---|---|---|")?;
        for row in &self.plumes {
            let [itself, floor, above] = [row.itself, row.floor, row.above].map(|it| 100.0 * it);
            writeln!(f, "| {} | {itself:.2} | {floor:.2} | {above:.2} |", row.map)?;
        }
        Ok(())
    }
}
