//! The WGSL modules of [moment-shadows](https://docs.rs/moment-shadows) as a package for the crate [`wesl`](https://docs.rs/wesl):
//! shaders that `wesl` links import them.
//!
//! ```
//! let mut compiler = wesl::Compiler::default();
//! compiler.options.dependencies.push(&moment_shadows_wesl::PACKAGE);
//! # let folder = std::env::temp_dir().join("moment_shadows_wesl_example");
//! # std::fs::create_dir_all(&folder)?;
//! # let path = folder.join("shade.wesl");
//! # std::fs::write(&path, "
//! # import moment_shadows::bounds::hamburger4::hamburger4_shadow_intensity_of_texel;
//! # import moment_shadows::map::storage::STORAGE_FLOAT16;
//! # @group(0) @binding(0) var<storage, read_write> shadow: f32;
//! # @compute @workgroup_size(1) fn shade() {
//! #     shadow = hamburger4_shadow_intensity_of_texel(vec4f(0.5), 0.5, STORAGE_FLOAT16);
//! # }")?;
//! let linked = compiler.compile(path)?;
//! let wgsl = linked.to_string();
//! # assert!(wgsl.contains("hamburger4_shadow_intensity_of_texel"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A shader that this links has lines such as
//!
//! ```wgsl
//! import moment_shadows::bounds::hamburger4::hamburger4_shadow_intensity_of_texel;
//! import moment_shadows::map::storage::STORAGE_FLOAT16;
//! ```

wesl_core::wesl_pkg!(
    #[allow(missing_docs, reason = "written by the packager")]
    moment_shadows
);

pub use self::moment_shadows::PACKAGE;
