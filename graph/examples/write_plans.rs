//! Writes the plans that `check/plans.mjs` records: of the example graph files, and of a graph for every technique and storage.
//!
//! `cargo run --release -p moment-shadows-graph --no-default-features --example write_plans -- FOLDER`, in the repository's root. Below
//! FOLDER is a folder per profile, with the plans that the profile allows, and beside them in `resized` those of the same graphs for
//! larger imports.

use std::error::Error;
use std::fs;
use std::path::Path;

use moment_shadows::{LayerSplits, MapEncoding, Profile, Storage, Technique};
use moment_shadows_graph::{Capabilities, Graph, GraphErrorKind, NodeRegistry};
use serde_json::{Value, json};

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1);
    let folder = folder.ok_or("usage: write_plans FOLDER")?;
    let mut graphs = examples()?;
    graphs.extend(techniques());
    graphs.extend(others());
    for profile in Profile::ALL {
        let folder = Path::new(&folder).join(profile.name());
        let resized = folder.join("resized");
        fs::create_dir_all(&resized)?;
        let mut written = 0;
        for (name, text) in &graphs {
            if write(name, text, profile, &folder)? {
                write(name, &grown(text)?, profile, &resized)?;
                written += 1;
            }
        }
        println!("{profile}: {written} plans of {} graphs", graphs.len());
    }
    Ok(())
}

/// The graph with imports half as large again, less one texel: as many mip levels, and sides that nothing divides.
fn grown(text: &str) -> Result<String, Box<dyn Error>> {
    let mut graph: Value = serde_json::from_str(text)?;
    let imports = graph["imports"].as_array_mut().into_iter().flatten();
    let sizes = imports.filter_map(|import| import["texture"]["size"].as_array_mut());
    for side in sizes.flatten() {
        *side = json!(side.as_u64().ok_or("a size is no number")? * 3 / 2 - 1);
    }
    Ok(graph.to_string())
}

/// Writes a graph's plan, and says whether the profile has one.
fn write(name: &str, text: &str, profile: Profile, folder: &Path) -> Result<bool, Box<dyn Error>> {
    let graph =
        Graph::parse(text, &NodeRegistry::new()).map_err(|error| format!("{name}: {error}"))?;
    let plan = match graph.compile(&Capabilities::of_profile(profile), &[]) {
        Err(error) if error.kind == GraphErrorKind::Capability => return Ok(false),
        plan => plan.map_err(|error| format!("{name}: {error}"))?,
    };
    fs::write(
        folder.join(format!("{name}.json")),
        serde_json::to_string(&plan)?,
    )?;
    Ok(true)
}

/// The graph files that lie beside the examples.
fn examples() -> Result<Vec<(String, String)>, Box<dyn Error>> {
    let mut all = Vec::new();
    for entry in fs::read_dir("examples")? {
        let path = entry?.path();
        if path
            .extension()
            .is_some_and(|extension| extension == "json")
        {
            let name = path.file_stem().unwrap_or_default().to_string_lossy();
            all.push((format!("example {name}"), fs::read_to_string(&path)?));
        }
    }
    all.sort();
    Ok(all)
}

/// A node with its properties.
fn node(name: &str, ty: &str, properties: Value) -> Value {
    json!({ "name": name, "type": ty, "properties": properties })
}

/// A graph of nodes and edges, with a light's map and a camera's.
fn graph(light: Value, nodes: &[Value], edges: &[(&str, &str)], output: &str) -> String {
    let edges = edges
        .iter()
        .map(|(from, to)| json!({ "from": from, "to": to }));
    let edges: Vec<Value> = edges.collect();
    json!({
        "version": 2,
        "imports": [
            { "name": "light_depth", "texture": light },
            { "name": "camera_depth", "texture": { "format": "depth32float", "size": [320, 180] } },
        ],
        "nodes": nodes,
        "edges": edges,
        "outputs": [{ "name": "output", "from": output }],
    })
    .to_string()
}

fn light(samples: u32) -> Value {
    json!({ "format": "depth32float", "size": [256, 256], "samples": samples })
}

/// From the light's depth through a filter to what shades.
fn filtered(light: Value, resolve: Value, blur: Value) -> String {
    graph(
        light,
        &[
            node("resolve", "resolve", resolve),
            node("blur", "blur", blur),
            node("shade", "shade_hard", json!({})),
        ],
        &[
            ("light_depth", "resolve.depth"),
            ("resolve.map", "blur.map"),
            ("blur.blurred", "shade.map"),
            ("camera_depth", "shade.camera_depth"),
        ],
        "shade.shadow_intensity",
    )
}

/// The same where the filter resolves.
fn resolved(light: Value, blur: Value) -> String {
    graph(
        light,
        &[
            node("blur", "blur", blur),
            node("shade", "shade_hard", json!({})),
        ],
        &[
            ("light_depth", "blur.depth"),
            ("blur.blurred", "shade.map"),
            ("camera_depth", "shade.camera_depth"),
        ],
        "shade.shadow_intensity",
    )
}

/// Every technique with every storage that can hold it.
fn techniques() -> Vec<(String, String)> {
    let mut all = Vec::new();
    for (index, technique) in Technique::examples().into_iter().enumerate() {
        if technique.reads_depth() {
            let shade = node("shade", "shade_hard", json!({ "technique": technique }));
            let edges = [
                ("light_depth", "shade.depth"),
                ("camera_depth", "shade.camera_depth"),
            ];
            let text = graph(light(1), &[shade], &edges, "shade.shadow_intensity");
            all.push((format!("{technique} {index}"), text));
            continue;
        }
        for storage in Storage::ALL {
            if MapEncoding::new(technique.clone(), storage).is_err() {
                continue;
            }
            let encoded = json!({ "technique": technique, "storage": storage });
            let mut blur = json!({ "kernel": { "radius": 2 } });
            let text = if storage.is_written_once() {
                blur["resolve"] = encoded.clone();
                resolved(light(4), blur)
            } else {
                filtered(light(4), encoded.clone(), blur)
            };
            all.push((format!("{technique} {index} {storage}"), text));
            // Packed texels are read by the nodes that filter and shade alone.
            if technique.row().soft_technique().is_some() && !storage.is_packed() {
                all.push((format!("soft {technique} {storage}"), soft(&encoded)));
            }
            let summed = storage != Storage::Unorm10 && !storage.is_packed();
            if technique.row().both_bounds && summed {
                all.push((format!("air {technique} {storage}"), air(&encoded)));
            }
        }
    }
    all
}

fn soft(encoded: &Value) -> String {
    graph(
        light(4),
        &[
            node("resolve", "resolve", encoded.clone()),
            node("sum", "summed_area_table", json!({ "largest_kernel": 33 })),
            node("shade", "shade_soft", json!({})),
        ],
        &[
            ("light_depth", "resolve.depth"),
            ("resolve.map", "sum.map"),
            ("sum.table", "shade.table"),
            ("camera_depth", "shade.camera_depth"),
        ],
        "shade.shadow_intensity",
    )
}

fn air(encoded: &Value) -> String {
    let mut rectified = encoded.clone();
    rectified["extent"] = json!([128, 64]);
    graph(
        light(1),
        &[
            node("resolve", "resolve", json!({ "storage": "float16" })),
            node("rectify", "rectify_moments", rectified),
            node("integrate", "integrate_scattering", json!({})),
            node("composite", "composite_scattering", json!({})),
        ],
        &[
            ("light_depth", "resolve.depth"),
            ("resolve.map", "rectify.map"),
            ("camera_depth", "rectify.camera_depth"),
            ("rectify.rectified", "integrate.rectified"),
            ("rectify.view_rays", "integrate.view_rays"),
            ("integrate.integrated", "composite.integrated"),
            ("camera_depth", "composite.camera_depth"),
        ],
        "composite.scattering",
    )
}

/// What techniques and storages alone do not reach: layers, regions, mip levels, parameters of the kernel, placed layers, fitted ranges,
/// what is shown of a map, a stencil beside the depth, and shadows at contacts.
fn others() -> Vec<(String, String)> {
    let float16 = json!({ "storage": "float16" });
    let layered = json!({ "technique": { "lvsm": { "layers": 4 } }, "storage": "float16" });
    let narrow = json!({ "kernel": { "radius": 2 } });
    let cascades = |samples: u32| json!({ "format": "depth32float", "size": [256, 128], "layers": 3, "regions": 4, "samples": samples });
    let all = [
        (
            "wide kernel",
            filtered(
                light(1),
                float16.clone(),
                json!({ "kernel": { "radius": 20 } }),
            ),
        ),
        (
            "per frame",
            filtered(
                light(1),
                float16.clone(),
                json!({ "kernel": { "radius": 2 }, "per_frame": true }),
            ),
        ),
        (
            "cascades",
            filtered(cascades(1), float16.clone(), narrow.clone()),
        ),
        (
            "multisampled cascades",
            filtered(cascades(4), float16.clone(), narrow.clone()),
        ),
        (
            "drawn cascades",
            filtered(
                cascades(4),
                json!({ "technique": "hamburger6", "storage": "unorm10" }),
                narrow.clone(),
            ),
        ),
        (
            "stencil",
            filtered(
                json!({ "format": "depth24plus-stencil8", "size": [256, 256] }),
                float16.clone(),
                narrow,
            ),
        ),
        ("mip levels", mip_levels(&float16)),
        ("soft atlas", soft_atlas()),
        ("placed layers", placed_layers(cascades(1))),
        ("fitted ranges", fitted_ranges(cascades(4), &[])),
        (
            "fitted ranges of what is seen",
            fitted_ranges(cascades(4), &[("camera_depth", "fit.camera_depth")]),
        ),
        ("debug", debug(&float16)),
        ("debug view", debug_shading(false, &float16, "view")),
        ("debug texels", debug_shading(false, &float16, "texels")),
        ("debug filter", debug_shading(false, &float16, "filter")),
        ("debug range", debug_shading(false, &float16, "range")),
        ("debug blockers", debug_shading(true, &float16, "blockers")),
        ("debug penumbra", debug_shading(true, &float16, "penumbra")),
        ("debug layer", debug_shading(false, &layered, "layer")),
        ("contact shadows", contact_shadows(&float16)),
    ];
    all.map(|(name, text)| (name.to_owned(), text)).to_vec()
}

fn contact_shadows(encoded: &Value) -> String {
    let lights = json!({ "lights": 2, "views": 2 });
    graph(
        light(1),
        &[
            node("resolve", "resolve", encoded.clone()),
            node("shade", "shade_hard", lights),
            node("contact", "contact_shadows", json!({ "lights": 2 })),
        ],
        &[
            ("light_depth", "resolve.depth"),
            ("resolve.map", "shade.map"),
            ("camera_depth", "shade.camera_depth"),
            ("camera_depth", "contact.camera_depth"),
            ("shade.shadow_intensity", "contact.intensity"),
        ],
        "contact.shadow_intensity",
    )
}

fn mip_levels(encoded: &Value) -> String {
    graph(
        light(4),
        &[
            node("resolve", "resolve", encoded.clone()),
            node(
                "blur",
                "blur",
                json!({ "kernel": { "radius": 2 }, "mip_levels": "all" }),
            ),
            node("downsample", "downsample", json!({})),
            node("shade", "shade_hard", json!({})),
        ],
        &[
            ("light_depth", "resolve.depth"),
            ("resolve.map", "blur.map"),
            ("blur.blurred", "downsample.map"),
            ("downsample.map", "shade.map"),
            ("camera_depth", "shade.camera_depth"),
        ],
        "shade.shadow_intensity",
    )
}

fn soft_atlas() -> String {
    graph(
        json!({ "format": "depth16unorm", "size": [512, 256], "regions": 16 }),
        &[
            node("resolve", "resolve", json!({ "storage": "float32" })),
            node("sum", "summed_area_table", json!({ "largest_kernel": 33 })),
            node("shade", "shade_soft", json!({ "lights": 8, "views": 16 })),
        ],
        &[
            ("light_depth", "resolve.depth"),
            ("resolve.map", "sum.map"),
            ("sum.table", "shade.table"),
            ("camera_depth", "shade.camera_depth"),
        ],
        "shade.shadow_intensity",
    )
}

/// What a node that shades shows of it: of a map, or of a table.
fn debug_shading(soft: bool, encoded: &Value, show: &str) -> String {
    let (kind, slot) = if soft {
        ("summed_area_table", "table")
    } else {
        ("blur", "blurred")
    };
    let properties = if soft {
        json!({})
    } else {
        json!({ "kernel": { "radius": 2 } })
    };
    let (shade, input) = if soft {
        ("shade_soft", "shade.table")
    } else {
        ("shade_hard", "shade.map")
    };
    graph(
        light(1),
        &[
            node("resolve", "resolve", encoded.clone()),
            node("filter", kind, properties),
            node("shade", shade, json!({ "debug": show })),
        ],
        &[
            ("light_depth", "resolve.depth"),
            ("resolve.map", "filter.map"),
            (&format!("filter.{slot}"), input),
            ("camera_depth", "shade.camera_depth"),
        ],
        "shade.debug",
    )
}

fn placed_layers(light: Value) -> String {
    let technique = Technique::Lvsm {
        layers: 4,
        overlap: moment_shadows::Finite::ZERO,
        splits: LayerSplits::Lloyd,
    };
    graph(
        light,
        &[
            node("place", "place_layers", json!({ "layers": 4 })),
            node(
                "resolve",
                "resolve",
                json!({ "technique": technique, "storage": "float16" }),
            ),
            node("shade", "shade_hard", json!({})),
        ],
        &[
            ("light_depth", "place.depth"),
            ("light_depth", "resolve.depth"),
            ("place.splits", "resolve.splits"),
            ("place.splits", "shade.splits"),
            ("resolve.map", "shade.map"),
            ("camera_depth", "shade.camera_depth"),
        ],
        "shade.shadow_intensity",
    )
}

fn fitted_ranges(light: Value, seen: &[(&str, &str)]) -> String {
    graph(
        light,
        &[
            node("fit", "fit_range", json!({})),
            node("resolve", "resolve", json!({ "storage": "float16" })),
            node("shade", "shade_hard", json!({ "views": 4 })),
        ],
        &[
            seen,
            &[
                ("light_depth", "fit.depth"),
                ("light_depth", "resolve.depth"),
                ("fit.ranges", "resolve.ranges"),
                ("fit.ranges", "shade.ranges"),
                ("resolve.map", "shade.map"),
                ("camera_depth", "shade.camera_depth"),
            ],
        ]
        .concat(),
        "shade.shadow_intensity",
    )
}

fn debug(encoded: &Value) -> String {
    graph(
        light(1),
        &[
            node("resolve", "resolve", encoded.clone()),
            node("show", "debug_moments", json!({ "show": "mean" })),
        ],
        &[
            ("light_depth", "resolve.depth"),
            ("resolve.map", "show.map"),
        ],
        "show.picture",
    )
}
