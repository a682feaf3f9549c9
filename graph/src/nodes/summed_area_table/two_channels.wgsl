// Sums of two channels.

alias Sums = vec2u;

fn sums_of(channels: vec4u) -> Sums {
    return channels.xy;
}

fn sums_texel(sums: Sums) -> vec4u {
    return vec4u(sums, 0u, 0u);
}
