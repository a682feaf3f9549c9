//! What translucent casters are not blended into, and what a host is told then.

use moment_shadows::{
    BlendFactor, MapEncoding, Opacity, Profile, Storage, Technique, TextureFormat,
};
use moment_shadows_graph::{
    Capabilities, Graph, GraphError, GraphErrorKind, Plan, ResourceDesc, TextureDesc,
};

/// The example's graph for a profile, with changes.
fn compiled(profile: Profile, changes: &[(&str, &str)]) -> Result<Plan, GraphError> {
    let mut text = include_str!("../../../examples/translucent.json").to_owned();
    for (from, to) in changes {
        assert!(text.contains(from), "{from}");
        text = text.replacen(from, to, 1);
    }
    let graph: Graph = text.parse()?;
    let depth = TextureDesc::new(TextureFormat::Depth32Float, [64, 64]);
    let depth = ResourceDesc::Texture(depth);
    let imports = [("light_depth", depth.clone()), ("camera_depth", depth)];
    graph.compile(&Capabilities::of_profile(profile), &imports)
}

#[test]
fn the_storage_is_one_that_the_device_blends() {
    let format = |profile| {
        let plan = compiled(profile, &[]).unwrap();
        plan.output_texture("shadow_map").unwrap().format
    };
    // A device with 16-bit formats may not draw to them; a browser with them does.
    assert_eq!(format(Profile::WebgpuCore), TextureFormat::Rgba16Float);
    assert_eq!(format(Profile::Native), TextureFormat::Rgba16Float);
    assert_eq!(format(Profile::WebgpuTier1), TextureFormat::Rgba16Unorm);
}

#[test]
fn nodes_say_what_they_cannot_blend() {
    let storage = r#"["unorm16", "float16"]"#;
    let technique = r#""technique": "hamburger6", "storage": ["unorm16", "float16"]"#;
    let cases = [
        (
            vec![(storage, r#""float32""#)],
            GraphErrorKind::Capability,
            "request the device with FLOAT32_BLENDABLE of wgpu",
        ),
        (
            vec![(storage, r#""unorm16""#)],
            GraphErrorKind::Capability,
            "TEXTURE_FORMAT_16BIT_NORM and TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES of wgpu ('texture-formats-tier1' in browsers)",
        ),
        (
            vec![(r#", "blends": 16"#, "")],
            GraphErrorKind::Format,
            "give the node that makes it the property 'blends'",
        ),
        (
            vec![
                (
                    r#"{ "name": "resolve","#,
                    r#"{ "name": "fit", "type": "fit_range" }, { "name": "resolve","#,
                ),
                (
                    r#"{ "from": "light_depth", "to": "resolve.depth" }"#,
                    r#"{ "from": "light_depth", "to": "resolve.depth" }, { "from": "light_depth", "to": "fit.depth" },
                       { "from": "fit.ranges", "to": "resolve.ranges" }"#,
                ),
            ],
            GraphErrorKind::Format,
            "takes casters whose depths are in the host's range",
        ),
        (
            vec![(technique, r#""technique": "evsm4", "storage": "float16""#)],
            GraphErrorKind::Property,
            "translucent casters are not blended into a map for 'evsm4'; they are into maps for vsm or hamburger4",
        ),
        (
            vec![(r#""blends": 16"#, r#""blends": 65"#)],
            GraphErrorKind::Property,
            "the moment bias is known for up to 64",
        ),
        (
            vec![(r#""blends": 16"#, r#""blends": 16, "mip_levels": 2"#)],
            GraphErrorKind::Format,
            "give the node 'blur' behind this one the property 'mip_levels' instead",
        ),
        (
            vec![
                (
                    technique,
                    r#""technique": "hamburger4", "storage": "float16""#,
                ),
                (
                    r#""type": "blur", "properties": { "kernel": { "radius": 4, "sigma": 2.4 } }"#,
                    r#""type": "summed_area_table", "properties": { "largest_kernel": 9 }"#,
                ),
                ("blur.blurred\", \"to\"", "blur.table\", \"to\""),
                ("\"from\": \"blur.blurred\" }", "\"from\": \"blur.table\" }"),
            ],
            GraphErrorKind::Format,
            "16 translucent casters over each other, whose bias this node does not know",
        ),
    ];
    for (changes, kind, says) in cases {
        let error = compiled(Profile::Native, &changes).unwrap_err();
        assert_eq!(error.kind, kind, "{error}");
        assert!(error.to_string().contains(says), "{error}");
    }
}

#[test]
fn blend_states_have_the_names_of_webgpu() {
    let map = |technique, storage| MapEncoding::new(technique, storage).unwrap();
    let four = map(Technique::Hamburger4, Storage::Float16);
    let six = map(Technique::Hamburger6, Storage::Float16);
    let refused = four.blend_states(Opacity::Alpha).unwrap_err();
    assert!(
        refused.message.contains("Opacity::SecondSource"),
        "{refused}"
    );
    let refused = six.blend_states(Opacity::SecondSource).unwrap_err();
    assert!(refused.message.contains("use Opacity::Alpha"), "{refused}");
    let esm = map(
        Technique::Esm {
            exponent: None,
            filtering: Default::default(),
        },
        Storage::Float32,
    );
    assert!(esm.blend_states(Opacity::Constant).is_err());
    let states = four.blend_states(Opacity::SecondSource).unwrap();
    assert_eq!(
        serde_json::to_value(&states).unwrap(),
        serde_json::json!([{
            "color": { "srcFactor": "src1", "dstFactor": "one-minus-src1" },
            "alpha": { "srcFactor": "src1", "dstFactor": "one-minus-src1" },
        }])
    );
    assert_eq!(four.blend_states(Opacity::TwoDraws).unwrap().len(), 2);
    let [state] = six.blend_states(Opacity::Alpha).unwrap()[..] else {
        panic!("one draw");
    };
    // The fourth channel of the map stays.
    assert_eq!(state.alpha.src_factor, BlendFactor::Zero);
    assert_eq!(state.alpha.dst_factor, BlendFactor::One);
}

#[test]
fn the_number_of_casters_is_kept_in_files() {
    let map = MapEncoding::new(Technique::Vsm, Storage::Float16).unwrap();
    let plain = serde_json::to_string(&map).unwrap();
    assert!(!plain.contains("blends"), "{plain}");
    let blended = map.with_blends(7).unwrap();
    let text = serde_json::to_string(&blended).unwrap();
    let read: MapEncoding = serde_json::from_str(&text).unwrap();
    assert_eq!((read.blends(), &read), (7, &blended));
    let wrong = text.replace("7", "99");
    let error = serde_json::from_str::<MapEncoding>(&wrong).unwrap_err();
    assert!(error.to_string().contains("up to 64"), "{error}");
}
