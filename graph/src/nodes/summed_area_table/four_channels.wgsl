// Sums of four channels.

alias Sums = vec4u;

fn sums_of(channels: vec4u) -> Sums {
    return channels;
}

fn sums_texel(sums: Sums) -> vec4u {
    return sums;
}
