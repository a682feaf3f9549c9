struct View { clip: mat4x4f }
@group(0) @binding(0) var<uniform> view: View;
@group(1) @binding(0) var shadow: texture_2d<f32>;
struct V { @builtin(position) p: vec4f, @location(0) n: vec3f }
@vertex fn vs(@builtin(vertex_index) i: u32, @location(0) c: vec3f, @location(1) h: vec3f) -> V {
  let axis = i / 12u; let s = f32((i / 6u) % 2u) * 2.0 - 1.0;
  let q = array(vec2f(-1,-1), vec2f(1,-1), vec2f(1,1), vec2f(-1,-1), vec2f(1,1), vec2f(-1,1));
  var p = vec3f(s, q[i % 6u]); var n = vec3f(s, 0, 0);
  if axis == 1u { p = p.zxy; n = n.zxy; } else if axis == 2u { p = p.yzx; n = n.yzx; }
  return V(view.clip * vec4f(c + h * p, 1.0), n);
}
@fragment fn fs(v: V) -> @location(0) vec4f {
  let light = max(dot(v.n, normalize(vec3f(0.5, 0.8, 0.4))), 0.0);
  let lit = 1.0 - textureLoad(shadow, vec2i(v.p.xy), 0).x;
  return vec4f(vec3f(0.12 + 0.8 * light * lit), 1.0);
}
