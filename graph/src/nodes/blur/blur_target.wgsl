import moment_shadows::filter::separable::{SeparableEight, separable_outputs};
import node::blur_source::{blur_stored};
import node::map_texture::{texel_to_texture};
import node::specialization::{AXIS, GROUP, MomentsStorage};

// Where a direction of the blur writes, one layer.

@group(GROUP) @binding(3) var written_map: MomentsStorage;

// Stores a filtered texel unless it lies beyond `last`, the last texel of the region.
fn blur_store_one(texel: vec2i, last: vec2i, value: vec4f) {
    if all(texel <= last) {
        textureStore(written_map, texel, texel_to_texture(blur_stored(value)));
    }
}

// Stores eight outputs, from the texel `first` on, as far as they lie in the region.
fn blur_store(first: vec2i, last: vec2i, eight: SeparableEight) {
    let outputs = separable_outputs(eight);
    blur_store_one(first, last, outputs.s0);
    blur_store_one(first + AXIS, last, outputs.s1);
    blur_store_one(first + 2 * AXIS, last, outputs.s2);
    blur_store_one(first + 3 * AXIS, last, outputs.s3);
    blur_store_one(first + 4 * AXIS, last, outputs.s4);
    blur_store_one(first + 5 * AXIS, last, outputs.s5);
    blur_store_one(first + 6 * AXIS, last, outputs.s6);
    blur_store_one(first + 7 * AXIS, last, outputs.s7);
}
