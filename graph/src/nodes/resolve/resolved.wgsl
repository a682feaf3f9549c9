import moment_shadows::map::depth::{DepthConversion, depth_to_moment_depth};
import moment_shadows::map::range_fit::{range_fit_map_depth};
import node::map_encoding::{encoding_channels};
import node::range_of_region::{range_of_region};
import node::specialization::{DepthTexture, FITTED, GROUP, REGIONS, SAMPLES};

// What one layer of a depth map gives for a plane of a filterable map.
//
// The moments (or other channels) of the samples are averaged. Averaging depths instead would invent an occluder between
// foreground and background (Peters & Klein, i3D 2015, section 4).

@group(GROUP) @binding(0) var<uniform> conversions: array<DepthConversion, REGIONS>;
@group(GROUP) @binding(1) var depth_map: DepthTexture;

fn resolved_size() -> vec2u {
    return textureDimensions(depth_map);
}

// The mean of the channels of a texel's samples, in the region of that number.
fn resolved_channels(texel: vec2u, number: u32) -> vec4f {
    let conversion = conversions[number];
    var sum = vec4f(0.0);
    // For a single sample the last argument of the load is its mip level, 0.
    for (var sample = 0; sample < SAMPLES; sample++) {
        // The first of four channels, where the map is no depth texture.
        let stored = vec4f(textureLoad(depth_map, vec2i(texel), sample)).x;
        var z = depth_to_moment_depth(stored, conversion);
        if FITTED {
            z = range_fit_map_depth(range_of_region(number), z);
        }
        sum += encoding_channels(z);
    }
    return sum / f32(SAMPLES);
}
