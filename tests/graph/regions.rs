//! Regions and mip levels: what the compiler and a view's block refuse, and with which words.

use moment_shadows::{MapRegion, Profile};
use moment_shadows_graph::{Capabilities, GraphError, GraphErrorKind, Plan};

use crate::example::{TEXT, compiled, edited, native, refused};

/// The example with an atlas of so many regions.
fn atlas(regions: u32) -> Plan {
    let text = TEXT.replace("\"samples\": 4", &format!("\"regions\": {regions}"));
    compiled(&text, &native()).unwrap()
}

#[test]
fn regions_that_a_map_cannot_have_are_refused() {
    let plan = atlas(3);
    let mut block = plan.parameters.initial();
    let mut write = |regions: &[MapRegion]| {
        plan.parameters
            .write_regions(&mut block, "light_depth", 0, regions)
    };
    let region = |x, y, width, height| MapRegion::new([x, y], [width, height]);
    write(&[region(0, 0, 512, 1024), region(512, 0, 512, 1024)]).unwrap();
    write(&[MapRegion::WHOLE]).unwrap();
    write(&[]).unwrap();
    // Radius 4: nine texels.
    write(&[region(1015, 1015, 9, 9)]).unwrap();
    let mut fails = |regions: &[MapRegion], says: &str| {
        let error = write(regions).unwrap_err();
        assert_eq!(error.kind, GraphErrorKind::Parameters);
        assert!(error.message.starts_with(says), "{error}");
    };
    let small = "region 0 of map 'light_depth' has 9 x 8 texels; 9 along each side are the fewest";
    fails(&[region(0, 0, 9, 8)], small);
    let none = [region(0, 0, 64, 64), MapRegion::NONE];
    fails(
        &none,
        "region 1 of map 'light_depth' has 0 x 0 texels; 9 along each side",
    );
    for outside in [
        region(1000, 0, 25, 20),
        region(0, 1024, 9, 9),
        region(9, 9, u32::MAX, 9),
    ] {
        fails(&[outside], "region 0 of map 'light_depth' runs from ");
    }
    let third = [
        region(0, 0, 20, 20),
        region(30, 30, 20, 20),
        region(19, 19, 20, 20),
    ];
    fails(&third, "regions 0 and 2 of map 'light_depth' overlap");
    let second = [MapRegion::WHOLE, region(5, 5, 20, 20)];
    fails(&second, "regions 0 and 1 of map 'light_depth' overlap");
    let four = [region(0, 0, 20, 20); 4];
    fails(
        &four,
        "a layer of map 'light_depth' has at most 3 regions, 4 were given",
    );
    let layout = &plan.parameters;
    let beyond = layout.write_regions(&mut block, "light_depth", 1, &[]);
    let unknown = layout.write_regions(&mut block, "light", 0, &[]);
    let short = layout.write_regions(&mut block[..64], "light_depth", 0, &[]);
    for (result, kind, says) in [
        (
            beyond,
            GraphErrorKind::Parameters,
            "map 'light_depth' has 1 layers; layer 1 is none of them",
        ),
        (
            unknown,
            GraphErrorKind::UnknownName,
            "there is no map with regions 'light'; the nearest are `light_depth` (in this plan)",
        ),
        (
            short,
            GraphErrorKind::Parameters,
            "a view's block has 768 bytes, 64 were given",
        ),
    ] {
        assert_eq!(result, Err(GraphError::new(kind, says)));
    }
}

#[test]
fn all_nodes_of_a_map_share_one_table() {
    let plan = atlas(5);
    let [table] = &plan.parameters.regions[..] else {
        panic!("{} tables", plan.parameters.regions.len());
    };
    assert_eq!(
        (table.map.as_str(), table.capacity, table.extent),
        ("light_depth", 5, [1024, 1024])
    );
    assert_eq!(table.smallest, 9);
    // A conversion per region.
    let resolve = &plan.parameters.blocks[0];
    assert_eq!((resolve.node.as_str(), resolve.elements), ("resolve", 5));
}

#[test]
fn more_regions_than_a_uniform_binding_holds_are_refused() {
    // 65536 bytes: 2048 conversions of 32 bytes.
    let text = |regions: u32| TEXT.replace("\"samples\": 4", &format!("\"regions\": {regions}"));
    compiled(&text(2048), &native()).unwrap();
    let error = refused(&text(2049));
    assert_eq!(error.kind, GraphErrorKind::Size);
    assert!(error.to_string().contains("at most 2048"), "{error}");
    let small = Capabilities {
        max_uniform_size: 16384,
        ..Capabilities::of_profile(Profile::Native)
    };
    let error = compiled(&text(513), &small).unwrap_err();
    assert!(error.to_string().contains("at most 512"), "{error}");
    let error = refused(&text(0));
    assert!(
        error
            .to_string()
            .contains("at least one layer, plane, mip level and region"),
        "{error}"
    );
}

#[test]
fn mip_levels_are_counted_and_downsampling_needs_some() {
    let blur = |property: &str| {
        edited(
            "\"sigma\": 2.4 }",
            &format!("\"sigma\": 2.4 }}, \"mip_levels\": {property}"),
        )
    };
    let mips = |property: &str| {
        compiled(&blur(property), &native()).map(|plan| {
            plan.memory
                .iter()
                .map(|memory| memory.desc.texture().map_or(0, |texture| texture.mips))
                .max()
        })
    };
    assert_eq!(mips("\"all\"").unwrap(), Some(11));
    assert_eq!(mips("4").unwrap(), Some(4));
    for wrong in ["0", "12"] {
        let error = mips(wrong).unwrap_err();
        assert_eq!(error.kind, GraphErrorKind::Size);
        assert!(
            error.to_string().contains("from 1 to 11, or \"all\""),
            "{error}"
        );
    }
    let text = TEXT
        .replace(
            "{ \"name\": \"shade\",",
            "{ \"name\": \"downsample\", \"type\": \"downsample\" },\n    { \"name\": \"shade\",",
        )
        .replace(
            "{ \"from\": \"blur.blurred\", \"to\": \"shade.map\" }",
            "{ \"from\": \"blur.blurred\", \"to\": \"downsample.map\" },\n    { \"from\": \"downsample.map\", \"to\": \"shade.map\" }",
        );
    let error = refused(&text);
    assert_eq!(
        (error.kind, error.node.as_deref()),
        (GraphErrorKind::Size, Some("downsample"))
    );
    assert!(error.to_string().contains("set 'mip_levels'"), "{error}");
}

#[test]
fn lights_views_and_anisotropy_are_within_their_ranges() {
    let shade = |properties: &str| {
        edited(
            "\"type\": \"shade_hard\"",
            &format!("\"type\": \"shade_hard\", \"properties\": {properties}"),
        )
    };
    for (properties, expected) in [
        ("{ \"lights\": 17, \"views\": 17 }", "1 to 16 lights"),
        ("{ \"lights\": 0 }", "1 to 16 lights"),
        (
            "{ \"lights\": 3, \"views\": 2 }",
            "each has at least one view",
        ),
        ("{ \"anisotropy\": 17 }", "from 1 (trilinear lookups) to 16"),
        (
            "{ \"lights\": 2, \"views\": 2, \"format\": \"r8unorm\" }",
            "need a channel each",
        ),
    ] {
        let error = refused(&shade(properties));
        assert_eq!(error.kind, GraphErrorKind::Property);
        assert!(error.to_string().contains(expected), "{error}");
    }
    let error = refused(&shade("{ \"views\": 257 }"));
    assert!(error.to_string().contains("at most 256"), "{error}");
    compiled(&shade("{ \"lights\": 16, \"views\": 256 }"), &native()).unwrap();
}
