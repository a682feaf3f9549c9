//! What shades with maps, tables and plain depth.

use moment_shadows::TextureFormat::{R8Unorm, Rg16Float, Rgb10a2Unorm, Rgba8Unorm};
use moment_shadows::{MapEncoding, PcfTaps, Storage, SummedAreaTable, Technique};
use moment_shadows_graph::nodes::{ContactShadows, ShadeHard, ShadeSoft};

use super::Variant;
use crate::error::LabError;
use crate::techniques;

/// Shading with a lookup by the sampler and in the shader, with and without mip levels, for one light and for several.
pub(super) fn of_four_moments(four: &MapEncoding) -> Result<Vec<Variant>, LabError> {
    let storage = four.storage();
    let unorm16 = storage == Storage::Unorm16;
    let mut all = Vec::new();
    // Other storages can be filtered everywhere.
    let kinds: &[_] = if storage == Storage::Float32 {
        &[("", "loaded"), ("_filterable", "sampled")]
    } else {
        &[("", "sampled")]
    };
    for &(kind, lookup) in kinds {
        let shading = |node| {
            Variant::new(node, four)
                .on(|capabilities| capabilities.float32_filterable = !kind.is_empty())
        };
        let shade = |lights, views| {
            shading(ShadeHard {
                lights,
                views,
                ..ShadeHard::default()
            })
        };
        let bordered = |views| {
            shading(ShadeHard {
                views,
                borders: true,
                ..ShadeHard::default()
            })
        };
        let name = format!("shade_hard_{storage}{kind}");
        let row = format!("{storage}, {lookup}");
        // Each of at most so many probes looks for the coarsest level with texels: the last one, in a large region.
        let probes = [u32::from(ShadeHard::default().anisotropy), 1];
        all.extend([
            shade(1, 1).file(&name, true).row(true, &row, &[]),
            shade(2, 6).file(format!("{name}_views"), false),
            shade(1, 1)
                .mips(4)
                .file(format!("{name}_mips"), unorm16)
                .row(kind.is_empty(), format!("{row}, mip levels"), &probes),
            shade(2, 6)
                .mips(4)
                .file(format!("{name}_mips_views"), false),
            shade(1, 4).row(unorm16, format!("{row}, 4 views"), &[4]),
            bordered(4).file(format!("{name}_borders"), unorm16).row(
                unorm16,
                format!("{row}, 4 views with borders"),
                &[4],
            ),
            shade(1, 1)
                .normals(Rgb10a2Unorm)
                .row(unorm16, format!("{row}, normals"), &[]),
            shade(1, 1)
                .samples(4)
                .normals(Rgb10a2Unorm)
                .file(format!("{name}_normals"), unorm16)
                .row(unorm16, format!("{row}, normals, 4 samples"), &[]),
            shade(1, 1)
                .fitted()
                .file(format!("{name}_fitted"), unorm16)
                .row(unorm16, format!("{row}, fitted"), &[1]),
            shade(1, 1)
                .normals(Rg16Float)
                .file(format!("{name}_octahedral_normals"), false),
        ]);
        if unorm16 {
            // A pixel in two views of a tile's list, of 16 lights with a view each, and of 256 views.
            let settings = format!("{row}, 16 lights, 2 views of a pixel");
            let many = shade(16, 16)
                .file(format!("{name}_lights"), 2_usize)
                .row(true, settings, &[1, 2, 1])
                .pass("find views", &[1, 8]);
            let most = shade(16, 256).file(format!("{name}_most_views"), false);
            all.extend([many, most]);
        }
    }
    // A map with translucent casters.
    let blended = four.clone().with_blends(16)?;
    let name = format!("shade_hard_{storage}_blended");
    all.push(Variant::new(ShadeHard::default(), &blended).file(name, unorm16));
    // A map whose texels are rounded inwards.
    if let Ok(inwards) = four.clone().rounded_inwards() {
        let name = format!("shade_hard_{storage}_rounded_inwards");
        all.push(Variant::new(ShadeHard::default(), &inwards).file(name, unorm16));
    }
    all.extend(soft(four)?);
    Ok(all)
}

/// Soft shadows from the table of a map: all ways to look it up, two moments, several lights.
fn soft(four: &MapEncoding) -> Result<Vec<Variant>, LabError> {
    let storage = four.storage();
    let table = SummedAreaTable::new(storage, [65, 65])
        .map_err(|error| LabError::unsuitable("the catalogue's table", error))?;
    let mut all = Vec::new();
    let (four_moments, two) = (Technique::Hamburger4, Technique::Vsm);
    for (kind, technique, interpolation, words) in [
        ("", &four_moments, [false, true], "filter"),
        ("_both", &four_moments, [true, true], "search and filter"),
        ("_neither", &four_moments, [false, false], "nothing"),
        ("_vsm", &two, [false, true], "filter"),
    ] {
        let node = ShadeSoft {
            interpolation,
            ..ShadeSoft::default()
        };
        let listed = storage == Storage::Float32;
        let name = format!("shade_soft{kind}_{storage}");
        // The loop over the only view, which a compiler unrolls unless it is long.
        all.push(
            Variant::new(node, four)
                .connected(&MapEncoding::of_table(technique.clone(), table)?)
                .file(name, listed && interpolation == [false, true])
                .row(listed, format!("{technique}, {words} interpolated"), &[1]),
        );
    }
    all.push(
        Variant::new(ShadeSoft::default(), four)
            .connected(&MapEncoding::of_table(four_moments.clone(), table)?)
            .fitted()
            .file(format!("shade_soft_fitted_{storage}"), false),
    );
    let lights = ShadeSoft {
        lights: 2,
        views: 6,
        ..ShadeSoft::default()
    };
    all.push(
        Variant::new(lights, four)
            .connected(&MapEncoding::of_table(four_moments, table)?)
            .file(format!("shade_soft_views_{storage}"), false),
    );
    Ok(all)
}

/// Shadows at contacts, which read no map: after maps and alone, for one light and for several.
pub(super) fn contacts(any: &MapEncoding) -> Vec<Variant> {
    let march = |lights| {
        let node = ContactShadows {
            lights,
            ..ContactShadows::default()
        };
        let steps = node.steps;
        (Variant::new(node, any), steps)
    };
    let ((one, steps), (four, _), (alone, _)) = (march(1), march(4), march(1));
    vec![
        one.intensity(R8Unorm).file("contact_shadows", true).row(
            true,
            format!("{steps} steps"),
            &[steps],
        ),
        four.intensity(Rgba8Unorm)
            .samples(4)
            .normals(Rgb10a2Unorm)
            .file("contact_shadows_lights", false)
            .row(
                true,
                format!("{steps} steps, 4 lights, normals"),
                &[4, steps],
            ),
        alone.file("contact_shadows_alone", false),
    ]
}

/// Techniques without a filterable map.
pub(super) fn of_depth(any: &MapEncoding) -> Vec<Variant> {
    let variant = |technique: Technique| {
        let label = techniques::label(&technique);
        let trips = match &technique {
            Technique::Pcf(taps) => match taps {
                // Rows, one more where results are blended; the few columns of small kernels are unrolled.
                PcfTaps::Box { radius } => vec![2 * radius + 2],
                PcfTaps::Gaussian { radius, .. } => vec![2 * radius + 2; 2],
                PcfTaps::Weights(weights) => vec![weights.len() as u32 + 1],
                PcfTaps::Hardware { radius, .. } => vec![2 * radius + 1],
                PcfTaps::Poisson { .. } => vec![16],
            },
            Technique::Pcss {
                search_taps,
                filter_taps,
            } => vec![*search_taps, *filter_taps],
            _ => Vec::new(),
        };
        let kept = !matches!(technique, Technique::Pcf(_));
        let node = ShadeHard {
            technique: Some(technique),
            ..ShadeHard::default()
        };
        Variant::new(node, any)
            .file(format!("shade_hard_{label}"), kept)
            .row(true, label, &trips)
    };
    techniques::reading_depth()
        .into_iter()
        .map(variant)
        .collect()
}

/// Shading with another technique's map. Each with one lookup; four moments have all.
pub(super) fn of_technique(map: &MapEncoding) -> Vec<Variant> {
    let (technique, storage) = (map.technique(), map.storage());
    let label = techniques::label(technique);
    let shade = || Variant::new(ShadeHard::default(), map);
    let file = shade().file(format!("shade_hard_{label}_{storage}"), super::is_kept(map));
    // Its layers are looked up like others.
    if label.contains("lloyd") {
        return vec![file];
    }
    let trips = match technique {
        // The last split in front of the fragment is searched for, at most through all of them; then planes are read up to there.
        Technique::Lvsm { layers, .. } => &[layers - 1, layers.div_ceil(2)][..],
        _ => &[],
    };
    let settings = format!("{label}, {storage}");
    if storage == Storage::Float32 {
        let filterable = shade().on(|capabilities| capabilities.float32_filterable = true);
        let loaded = file.row(true, format!("{settings}, loaded"), trips);
        vec![loaded, filterable.row(true, settings, trips)]
    } else {
        vec![file.row(true, settings, trips)]
    }
}

/// Shading in the mip levels of a map that is drawn.
pub(super) fn in_mip_levels(map: &MapEncoding, suffix: &str) -> Variant {
    Variant::new(ShadeHard::default(), map)
        .mips(4)
        .file(format!("shade_hard_mips_{suffix}"), false)
}

/// Shading with the series itself, where a technique evaluates a bound of it.
pub(super) fn of_series(map: &MapEncoding) -> Option<Variant> {
    let Technique::Convolution { terms, .. } = map.technique() else {
        return None;
    };
    let series = Technique::Convolution {
        terms: *terms,
        lower_bound: false,
    };
    let label = techniques::label(&series);
    let name = format!("shade_hard_{label}_{}", map.storage());
    let node = ShadeHard {
        technique: Some(series),
        ..ShadeHard::default()
    };
    Some(Variant::new(node, map).file(name, super::is_kept(map)))
}
