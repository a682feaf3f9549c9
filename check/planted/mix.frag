#version 300 es
// An error: `mix` by truth values is for floats in GLSL ES 3.00.
precision highp float;
precision highp int;
flat in ivec2 place;
layout(location = 0) out ivec2 colour;

void main() {
    colour = mix(place, ivec2(0), lessThan(place, ivec2(0)));
}
