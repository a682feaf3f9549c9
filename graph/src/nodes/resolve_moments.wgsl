import moment_shadows::depth::{DepthConversion, depth_to_moment_depth};
import moment_shadows::map_encoding::{encoding_channels, encoding_texel};
import moment_shadows::region_tile::{region_tile};
import moment_shadows::specialization::{DepthTexture, GROUP, MomentsStorage, REGIONS, SAMPLES};

// Resolves the regions of one layer of a depth map to one plane of a filterable map: one texel per invocation.
//
// The moments (or other channels) of the samples are averaged. Averaging depths instead would put an occluder between foreground and
// background, where there is none (Peters & Klein, i3D 2015, section 4).

@group(GROUP) @binding(0) var<uniform> conversions: array<DepthConversion, REGIONS>;
@group(GROUP) @binding(1) var depth_map: DepthTexture;
@group(GROUP) @binding(2) var moments_map: MomentsStorage;

@compute @workgroup_size(8, 8)
fn resolve(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u) {
    let tile = region_tile(workgroup, workgroups, textureDimensions(moments_map), 0u, vec2u(8u));
    let place = tile.first + local.xy;
    if any(place >= tile.region.extent) {
        return;
    }
    let texel = vec2i(tile.region.origin + place);
    let conversion = conversions[tile.number];
    var sum = vec4f(0.0);
    // For a single sample the last argument of the load is its mip level, 0.
    for (var sample = 0; sample < SAMPLES; sample++) {
        let stored = textureLoad(depth_map, texel, sample);
        sum += encoding_channels(depth_to_moment_depth(stored, conversion));
    }
    textureStore(moments_map, texel, encoding_texel(sum / f32(SAMPLES)));
}
