//! What no table is made of, and what it says.

use moment_shadows::{MapEncoding, Profile, Storage, SummedAreaTable, Technique, TextureFormat};
use moment_shadows_graph::{Capabilities, GraphError, GraphErrorKind, Plan, TextureDesc};
use moment_shadows_lab::summed_area::SummedMap;

use crate::setup::{encoding, map};

fn plan(desc: &TextureDesc, kernel: [u32; 2]) -> Result<Plan, GraphError> {
    SummedMap::plan(&Capabilities::of_profile(Profile::Native), desc, kernel)
}

fn unorm16(size: [u32; 2]) -> TextureDesc {
    map(&encoding(Technique::Hamburger4, Storage::Unorm16), size, 1)
}

#[test]
fn a_kernel_beyond_the_range_names_the_largest() {
    let error = plan(&unorm16([512, 512]), [257; 2]).unwrap_err();
    assert_eq!(error.kind, GraphErrorKind::Property);
    let message = error.to_string();
    for part in [
        "257x257",
        "65537",
        "height is at most 255",
        "at most 256 texels along each side",
    ] {
        assert!(message.contains(part), "{message}");
    }
    let legal = [[256; 2], [257, 255], [65537, 1]];
    for kernel in legal {
        assert!(plan(&unorm16([512, 512]), kernel).is_ok(), "{kernel:?}");
    }
    // Products beyond 32 bits, and widths that leave no height.
    for sides in [[65536, 65536], [u32::MAX, u32::MAX], [65538, 1]] {
        let error = SummedAreaTable::new(Storage::Float32, sides).unwrap_err();
        let [width, height] = sides;
        let start = format!("a largest kernel of {width}x{height} texels covers more than");
        assert!(error.message.starts_with(&start), "{error}");
        assert!(
            error.to_string().contains("next to a width of 65"),
            "{error}"
        );
    }
}

#[test]
fn a_kernel_without_texels_is_refused() {
    for kernel in [[0; 2], [7, 0]] {
        let error = plan(&unorm16([64, 64]), kernel).unwrap_err();
        assert_eq!(error.kind, GraphErrorKind::Property);
        assert!(error.message.contains("covers nothing"), "{error}");
    }
}

#[test]
fn a_map_beyond_the_limits_names_the_largest() {
    let error = plan(&unorm16([8193, 16]), [65; 2]).unwrap_err();
    assert_eq!(error.kind, GraphErrorKind::Size);
    assert!(error.message.contains("the device allows 8192"), "{error}");
    let error = plan(&unorm16([0, 16]), [65; 2]).unwrap_err();
    assert_eq!(error.kind, GraphErrorKind::Size);
    assert!(plan(&unorm16([8192, 8192]), [65; 2]).is_ok());
}

#[test]
fn maps_that_hold_something_else_are_refused() {
    let evsm = Technique::Evsm2 {
        exponent: Some(5.0_f32.try_into().unwrap()),
    };
    let error = plan(
        &map(&encoding(evsm, Storage::Float32), [64, 64], 1),
        [65; 2],
    );
    let error = error.unwrap_err();
    assert_eq!(error.kind, GraphErrorKind::Property);
    for technique in ["vsm", "hamburger4", "hausdorff4"] {
        assert!(error.message.contains(technique), "{error}");
    }
    let plain = TextureDesc::new(TextureFormat::R8Unorm, [64, 64]);
    let error = plan(&plain, [65; 2]).unwrap_err();
    assert_eq!(error.kind, GraphErrorKind::Format);
    // A table of a table.
    let table = SummedAreaTable::new(Storage::Unorm16, [9, 9]).unwrap();
    let table = MapEncoding::of_table(Technique::Hamburger4, table).unwrap();
    let error = plan(&map(&table, [64, 64], 1), [65; 2]).unwrap_err();
    assert_eq!(error.kind, GraphErrorKind::Format);
    assert!(error.message.contains("summed-area table"), "{error}");
    let error = SummedAreaTable::new(Storage::Unorm8, [9, 9]).unwrap_err();
    assert_eq!(error.name, "source");
    assert!(error.message.contains("stored as unorm8"), "{error}");
}

/// Only this node makes them: a resolve to integers is refused with what it can store.
#[test]
fn no_other_map_is_stored_like_a_table() {
    let error = MapEncoding::new(Technique::Hamburger4, Storage::Fixed32).unwrap_err();
    assert_eq!(error.name, "storage", "{error}");
    assert!(
        error.to_string().contains("unorm16 or float16 or float32"),
        "{error}"
    );
}

#[test]
fn an_encoding_survives_its_file() {
    let table = SummedAreaTable::new(Storage::Float16, [31, 17]).unwrap();
    let encoding = MapEncoding::of_table(Technique::Vsm, table).unwrap();
    assert_eq!(encoding.format(), TextureFormat::Rg32Uint);
    let text = serde_json::to_string(&encoding).unwrap();
    let read: MapEncoding = serde_json::from_str(&text).unwrap();
    assert_eq!(read, encoding);
    for wrong in [
        r#"{ "storage": "fixed32" }"#,
        r#"{ "storage": "unorm16", "table": { "source": "unorm16", "largest_kernel": [9, 9] } }"#,
        r#"{ "storage": "fixed32", "table": { "source": "unorm16", "largest_kernel": [900, 900] } }"#,
        r#"{ "storage": "fixed32", "table": { "source": "unorm16", "largest_kernel": [9, 0] } }"#,
    ] {
        assert!(
            serde_json::from_str::<MapEncoding>(wrong).is_err(),
            "{wrong}"
        );
    }
}
