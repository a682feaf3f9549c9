//! Single scattering, with four and six moments; sums in parallel and, on a software adapter, row by row. Marched, with both and with the
//! plain map.

use moment_shadows::{MapEncoding, Storage, Technique, ValueError};
use moment_shadows_graph::nodes::{
    CompositeScattering, IntegrateScattering, MarchScattering, RectifyMoments, UpsampleScattering,
};

use super::{SIZE, Variant};
use crate::techniques;

/// What a storage of four moments allows.
pub(super) fn of_storage(four: &MapEncoding) -> Result<Vec<Variant>, ValueError> {
    let storage = four.storage();
    // Storages are constants.
    let portable = storage == Storage::Float16;
    let mut all = Vec::new();
    for technique in [Technique::Hamburger4, Technique::Hamburger6] {
        let map = MapEncoding::new(technique.clone(), storage)?;
        let label = techniques::label(&technique);
        // Sums know nothing of moments: their text is the same for both.
        let repeats = technique == Technique::Hamburger6;
        let rectify = RectifyMoments {
            technique,
            storage,
            extent: SIZE,
        };
        let sum = || Variant::new(IntegrateScattering {}, &map);
        // Shared memory that is cleared, 1024 bytes at a time; 512 columns at a time, with six steps of the scan.
        let parallel = [2, SIZE[0] / 512, 6];
        // Four columns at a time.
        let row_by_row = [SIZE[0] / 4];
        let composite = Variant::new(CompositeScattering::default(), &map);
        let variant = |variant: Variant, node: &str, kind: &str, trips: &[u32]| {
            variant
                .file(format!("{node}_{label}_{storage}"), portable)
                .row(portable, format!("{label}, {storage}{kind}"), trips)
        };
        let sums = [
            variant(sum(), "integrate_scattering", "", &parallel),
            variant(
                sum().on(|capabilities| capabilities.software_adapter = true),
                "integrate_scattering_software",
                ", row by row",
                &row_by_row,
            ),
        ];
        if repeats && portable {
            // What is known of view rays depends on neither moments nor storage.
            let settings = format!("{label}, {storage}, of what the camera sees");
            let seen = Variant::new(rectify.clone(), four)
                .file("rectify_moments_seen", 4_usize)
                .row(true, settings.as_str(), &[])
                .pass("bound rays", &[1, SIZE[0] / 64, 6, SIZE[0] / 64]);
            all.push(seen);
            let seen = sum()
                .view_rays()
                .file("integrate_scattering_seen", 1_usize)
                .row(true, settings, &[3, SIZE[0] / 512, 6, 8]);
            all.push(seen);
        }
        let rectify = Variant::new(rectify, four).without_camera();
        all.push(variant(rectify, "rectify_moments", "", &[]));
        if !repeats {
            all.extend(sums);
        } else if portable {
            all.extend(sums.map(|sum| Variant { file: None, ..sum }));
        }
        all.push(variant(composite, "composite_scattering", "", &[]));
    }
    Ok(all)
}

/// Six moments as only maps in rectified coordinates hold them: their texts are those of other storages but for the bias.
pub(super) fn of_eight_bits(four: &MapEncoding) -> Result<Vec<Variant>, ValueError> {
    let (technique, storage) = (Technique::Hamburger6, Storage::Unorm8);
    let map = MapEncoding::rectified(technique.clone(), storage)?;
    let label = format!("{}_{storage}", techniques::label(&technique));
    let rectify = RectifyMoments {
        technique,
        storage,
        extent: SIZE,
    };
    let variant = |variant: Variant, node: &str| variant.file(format!("{node}_{label}"), false);
    Ok(vec![
        variant(
            Variant::new(rectify, four).without_camera(),
            "rectify_moments",
        ),
        variant(
            Variant::new(CompositeScattering::default(), &map),
            "composite_scattering",
        ),
    ])
}

/// Marching with a map of four moments, of six and with the plain map; views of a point light, a density of a host's own; upsampling.
pub(super) fn marched(four: &MapEncoding) -> Result<Vec<Variant>, ValueError> {
    let six = MapEncoding::new(Technique::Hamburger6, four.storage())?;
    let march = MarchScattering::default;
    let own = "fn density(position: vec3f, own: vec4f) -> f32 {\n    return exp(-own.x * position.y);\n}\n";
    let plain = MarchScattering {
        technique: Some(Technique::Binary),
        ..march()
    };
    let faces = MarchScattering {
        views: 6,
        ..march()
    };
    let own = MarchScattering {
        density: Some(own.to_owned()),
        ..march()
    };
    let steps = [16];
    let of_faces = [16, faces.views];
    let label = |map: &MapEncoding| techniques::label(map.technique());
    let storage = four.storage();
    let variant = |node, map: &MapEncoding, file: &str, row: String, kept: bool, trips: &[u32]| {
        let variant = Variant::new(node, map);
        variant
            .file(format!("march_scattering_{file}"), kept)
            .row(true, row, trips)
    };
    let of_map = |map| format!("{}, {storage}, 16 steps", label(map));
    Ok(vec![
        variant(march(), four, "hamburger4", of_map(four), true, &steps),
        variant(march(), &six, "hamburger6", of_map(&six), false, &steps),
        variant(
            plain,
            four,
            "plain",
            "plain map, 16 steps".to_owned(),
            true,
            &steps,
        ),
        variant(
            faces,
            four,
            "faces",
            format!("{}, 6 views", of_map(four)),
            false,
            &of_faces,
        ),
        variant(
            own,
            four,
            "density",
            format!("{}, own density", of_map(four)),
            true,
            &steps,
        ),
        Variant::new(UpsampleScattering {}, four)
            .file("upsample_scattering".to_owned(), true)
            .row(true, "half".to_owned(), &[]),
    ])
}
