//! Tables of all techniques: what ranks above what, and at what memory.

use std::path::Path;

use moment_shadows::{EsmFiltering, Storage, Technique};
use moment_shadows_lab::candidate::{Candidate, TechniqueChoice};
use moment_shadows_lab::command::error_table::{ErrorRow, ErrorTable};

use crate::setup::{options, table_options};

fn path() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/hard_shadows.json")
}

fn table(radii: &[u32], candidates: Vec<Candidate>, stride: u32, map: u32) -> ErrorTable {
    let scenes = vec!["hall".to_owned()];
    let options = table_options(&path(), options(map, 4), scenes, radii, stride);
    options.measure(&candidates).unwrap()
}

fn error(row: &ErrorRow) -> f64 {
    row.errors.surfaces.shading.mean_absolute
}

fn find(table: &ErrorTable, of: fn(&Technique) -> bool, storage: Storage) -> &ErrorRow {
    let wanted = |row: &&ErrorRow| of(&row.errors.technique) && row.errors.storage == Some(storage);
    table.rows.iter().find(wanted).unwrap()
}

#[test]
fn techniques_rank_as_published() {
    use Storage::{Float16, Float32, Unorm16};
    let table = table(&[4], Candidate::all(), 1, 256);
    println!("{table}");
    assert_eq!(table.rows.len(), Candidate::all().len());
    assert!(table.rows.iter().all(|row| row.errors.surfaces.nan == 0));
    let of = |technique, storage| error(find(&table, technique, storage));
    let vsm: fn(&Technique) -> bool = |it| *it == Technique::Vsm;
    let hamburger: fn(&Technique) -> bool = |it| *it == Technique::Hamburger4;
    let hausdorff: fn(&Technique) -> bool = |it| *it == Technique::Hausdorff4;
    let evsm2: fn(&Technique) -> bool = |it| matches!(it, Technique::Evsm2 { .. });
    let evsm4: fn(&Technique) -> bool = |it| matches!(it, Technique::Evsm4 { .. });
    // At 64 bits: four moments, then exponential variance, then variance (Peters and Klein, "Moment Shadow Mapping", i3D
    // 2015, figures 1 and 6).
    let evsm = of(evsm2, Float32).min(of(evsm4, Float16));
    assert!(of(hamburger, Unorm16) < evsm && evsm < of(vsm, Float32));
    // The sharp bound of two moments and two more is never farther from the truth than that of the two alone. What a moment
    // bias costs grows with the rounding error that it covers.
    for storage in [Unorm16, Float16, Float32] {
        assert!(of(hamburger, storage) < of(vsm, storage), "{storage}");
    }
    for technique in [hamburger, hausdorff] {
        assert!(of(technique, Float32) < of(technique, Unorm16));
        assert!(of(technique, Unorm16) < of(technique, Float16));
    }
    // That depths have a range is news beside four moments, but needs a bias a third to twice as large: about as good.
    for storage in [Unorm16, Float16, Float32] {
        assert!(
            of(hausdorff, storage) < 1.02 * of(hamburger, storage),
            "{storage}"
        );
    }
    // A second warp is a second bound, the darker of which counts.
    for storage in [Float16, Float32] {
        assert!(of(evsm4, storage) <= of(evsm2, storage), "{storage}");
    }
    // The references: the truth's kernel on a sample per texel instead of four, and no kernel at all.
    let reference = |of: fn(&Technique) -> bool| {
        let found = table.rows.iter().find(|row| of(&row.errors.technique));
        error(found.unwrap())
    };
    let pcf = reference(|it| matches!(it, Technique::Pcf(_)));
    let best = table.rows.iter().filter(|row| row.errors.storage.is_some());
    let best = best.map(error).fold(1.0, f64::min);
    assert!(pcf < best, "{pcf} of {best}");
    assert!(reference(|it| *it == Technique::Binary) > pcf);
    // A convolution shadow map of 8 bits costs as much as four moments in single precision.
    let convolution = |it: &Technique| matches!(it, Technique::Convolution { .. });
    let convolution = find(&table, convolution, Storage::Unorm8);
    assert_eq!(convolution.errors.bits_per_texel, 128);
    assert!(error(convolution) > of(hamburger, Float32));
    // A logarithm in single precision holds what the exponential does.
    let esm = |filtering| {
        let rows = table.rows.iter().filter(|row| {
            let technique = &row.errors.technique;
            let of = matches!(technique, Technique::Esm { filtering: it, .. } if *it == filtering);
            of && row.errors.storage == Some(Float32)
        });
        rows.map(error).fold(0.0, f64::max)
    };
    let [linear, logarithmic] = [EsmFiltering::Linear, EsmFiltering::Logarithmic].map(esm);
    assert!(
        (linear / logarithmic - 1.0).abs() < 1e-3,
        "{linear} {logarithmic}"
    );
}

#[test]
fn a_ray_in_four_gives_about_the_same_figures() {
    let choices = ["vsm", "hamburger4"].map(|name| name.parse::<TechniqueChoice>().unwrap());
    let candidates: Vec<Candidate> = choices
        .iter()
        .map(|choice| choice.in_storage(Some(Storage::Float32)).unwrap())
        .collect();
    let [every, one_in_four] = [1, 2].map(|stride| table(&[4], candidates.clone(), stride, 256));
    for (every, one) in every.rows.iter().zip(&one_in_four.rows) {
        let surfaces = [every, one].map(|row| row.errors.surfaces.shading.samples as f64);
        assert!(
            (surfaces[0] / surfaces[1] - 4.0).abs() < 0.1,
            "{surfaces:?}"
        );
        println!("{} and {}", error(every), error(one));
        // Neighbouring texels are in the same shadow: the mean over tens of thousands of surfaces moves by a hundredth.
        assert!((error(one) / error(every) - 1.0).abs() < 0.03);
    }
}

#[test]
fn kernels_of_one_table_share_their_light() {
    // The margin around the casters is that of the widest kernel, so that all of them see the same surfaces.
    let candidates = vec![Candidate::Storage(Storage::Float32)];
    let table = table(&[1, 6], candidates, 2, 128);
    let samples: Vec<usize> = table
        .rows
        .iter()
        .map(|row| row.errors.surfaces.shading.samples)
        .collect();
    assert_eq!(samples[0], samples[1]);
    assert!(error(&table.rows[1]) > error(&table.rows[0]));
}

#[test]
fn tables_are_plotted() {
    let folder = tempfile::tempdir().unwrap();
    let candidates = ["vsm", "hamburger4"].iter().flat_map(|name| {
        name.parse::<TechniqueChoice>()
            .unwrap()
            .candidates()
            .to_vec()
    });
    let mut table = table(&[1, 2], candidates.collect(), 4, 64);
    let out = folder.path().join("new");
    table.plot(&out).unwrap();
    assert_eq!(
        table.plots,
        ["error-table.svg", "error-table.png"].map(|name| out.join(name))
    );
    let svg = std::fs::read_to_string(&table.plots[0]).unwrap();
    for text in [
        "radius 1",
        "radius 2",
        "vsm",
        "hamburger4",
        "bits per texel",
    ] {
        assert!(svg.contains(text), "{text}");
    }
    let png = image::open(&table.plots[1]).unwrap();
    assert_eq!([png.width(), png.height()], [2 * 480 + 220, 600]);
}
