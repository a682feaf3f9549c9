//! What an exported file says of itself.

use core::fmt::Write;

use super::{Target, root};
use crate::{MapEncoding, modules};

const VERSION: &str = env!("CARGO_PKG_VERSION");

pub(super) fn header(
    encoding: &MapEncoding,
    target: Target,
    functions: &[&'static str],
    wgsl: &str,
) -> String {
    let mut lines = vec![
        format!(
            "moment-shadows {VERSION}: {}, stored as {}.",
            encoding.technique(),
            encoding.storage()
        ),
        format!(
            "Made by `moment-shadows export --target {target}`; not to be edited. Licence: MIT OR Apache-2.0, as you like."
        ),
        "https://github.com/moment-shadows/moment-shadows".to_owned(),
        String::new(),
    ];
    let settings = encoding.technique().row();
    let settings: Vec<_> = settings
        .constants()
        .map(|(name, value)| format!("{name} = {value}"))
        .collect();
    if !settings.is_empty() {
        lines.push(format!("Baked in: {}.", settings.join(", ")));
        lines.push(String::new());
    }
    lines.extend(CONVENTIONS.lines().map(str::to_owned));
    lines.extend(map(encoding));
    lines.push(String::new());
    lines.extend(use_of(encoding).lines().map(str::to_owned));
    let further: Vec<_> = functions
        .iter()
        .skip(root::COMMON.len())
        .map(|name| format!("`{name}`"))
        .collect();
    if !further.is_empty() {
        lines.push(format!("For moments at hand: {}.", further.join(", ")));
    }
    lines.push(
        "All have their comments below, and the names that they have in the library's WGSL."
            .to_owned(),
    );
    lines.push(String::new());
    lines.extend(notes(target).lines().map(str::to_owned));
    lines.extend(theory(wgsl));
    let mut text = String::new();
    for line in lines {
        let line = format!("// {line}");
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}", line.trim_end());
    }
    text
}

const CONVENTIONS: &str = "\
Moment depth is in [-1, 1]: -1 at the light's near end, 1 at its far end, linear in distance along the light's axis.
`depth_to_moment_depth` makes it of what a depth map stores; for parallel rays and depth from 0 to 1 it is 2 * stored - 1.
Shadow intensity is in [0, 1]: 0 is full light, 1 is full shadow.";

/// What the map holds.
fn map(encoding: &MapEncoding) -> Vec<String> {
    let row = encoding.technique().row();
    let planes = match row.planes {
        1 => String::new(),
        planes => format!("; a map is {planes} such textures, its planes"),
    };
    let used = match row.channels {
        1 => "of which the first channel is used",
        2 => "of which the first two channels are used",
        _ => "all channels of which are used",
    };
    let texture = encoding.format().name();
    let mut lines = vec![format!("The map's texture is {texture}, {used}{planes}.")];
    let mut packed = "";
    if let [pack, unpack] = encoding.storage().packing() {
        lines = vec![format!(
            "The map's texture is {texture}: it holds `{pack}(texel)`, which `{unpack}` makes a texel again."
        )];
        packed = ", packed";
    }
    let far = row.far_texels(encoding.storage()).unwrap_or_default();
    for (plane, texel) in far.iter().enumerate() {
        let texel: Vec<_> = texel.iter().map(|it| format!("{:?}", *it as f32)).collect();
        let of = match row.planes {
            1 => String::new(),
            _ => format!(" of plane {plane}"),
        };
        lines.push(format!(
            "A texel{of} that casts no shadow holds ({}){packed}; clear to it, not to zeros.",
            texel.join(", ")
        ));
    }
    lines
}

fn use_of(encoding: &MapEncoding) -> String {
    let row = encoding.technique().row();
    let (plane, each) = if row.encodes_planes() {
        (", plane", " for each plane")
    } else {
        ("", "")
    };
    let texel_plane = if row.encoding.is_some_and(|it| it.texel.contains("PLANE")) {
        plane
    } else {
        ""
    };
    let channel_plane = if row.encoding.is_some_and(|it| it.channels.contains("PLANE")) {
        plane
    } else {
        ""
    };
    let values = if row.planes == 1 { "value" } else { "values" };
    let lookup = if encoding.averaged_by_samplers() {
        "a bilinear sample of the map, with mip levels if you like, is such an average already"
    } else {
        "samplers cannot average these texels; load four and average their values yourself"
    };
    let storage = if encoding.storage().is_drawn() {
        "\n   Draw it; the functions see to it that drivers round to the nearest number."
    } else {
        ""
    };
    let filter = if encoding.storage().is_written_once() {
        "Average values, the texels of the step before as they are or in more bits, and write `filtering_texel(value)` at the end alone: these texels are \
         rounded too coarsely to be filtered again."
    } else {
        "Filter it, a separable blur say: average `filtering_value(texel)`, write `filtering_texel(value)`."
    };
    format!(
        "\
How to use it, with moment depths z:
1. Make the map{each}: average `encoding_channels(z{channel_plane})` over the samples of a texel, write `encoding_texel(mean{texel_plane})`.{storage}
2. {filter}
3. Shade: subtract a receiver bias from the fragment's moment depth, look the map up and ask for
   `technique_shadow_intensity({values}, fragment_depth)`; {lookup}.
4. `leak_reduction_apply(intensity, reduction)` darkens what leaks, if you like."
    )
}

fn notes(target: Target) -> &'static str {
    match target {
        Target::Hlsl => {
            "\
HLSL for shader model 5 and later. DXC needs `-HV 2018`: `?:` chooses for each component. Comparisons of bits find NaN and infinity.
"
        }
        Target::Glsl => "GLSL 4.50: put it below `#version 450` and below your precisions.\n",
        Target::Msl => "Metal shading language 2.1. An array is passed as the struct that has it as `inner`.\n",
        Target::Wgsl => "WGSL without bindings, overrides and imports.\n",
    }
}

/// What the modules of which something is in the file say of themselves: the ideas, and the papers.
fn theory(wgsl: &str) -> Vec<String> {
    let mut lines = Vec::new();
    for module in modules() {
        let path = format!("moment_shadows/{}/{}.wgsl", module.folder, module.name);
        if !wgsl.contains(&format!("// {path}\n")) {
            continue;
        }
        lines.push(String::new());
        lines.push(format!("--- {path}"));
        let text = module.source.lines();
        let comment = text.skip_while(|line| !line.starts_with("//"));
        let comment = comment.take_while(|line| line.starts_with("//"));
        let bare = |line: &str| line.strip_prefix("// ").unwrap_or_default().to_owned();
        lines.extend(comment.map(bare));
    }
    lines
}
