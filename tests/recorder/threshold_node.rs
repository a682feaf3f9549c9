use moment_shadows::TextureFormat::{Rgba8Unorm, Rgba16Float, Rgba32Float};
use moment_shadows_graph::{
    Connected, GraphError, Node, NodeDesc, Pass, Rule, Stage, TextureRule, bind,
};
use serde::Deserialize;

/// White where the first channel of a map is above a level, black elsewhere.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Threshold {
    level: f32,
}

const SHADER: &str = "
override level: f32;
@group(0) @binding(0) var map: texture_2d<f32>;
@group(0) @binding(1) var picture: texture_storage_2d<rgba8unorm, write>;

@compute @workgroup_size(8, 8)
fn threshold(@builtin(global_invocation_id) id: vec3u) {
    if all(id.xy < textureDimensions(picture)) {
        let white = f32(textureLoad(map, id.xy, 0).x > level);
        textureStore(picture, id.xy, vec4f(vec3f(white), 1.0));
    }
}
";

impl Node for Threshold {
    fn describe(&self, _: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let map = TextureRule::new(vec![Rgba16Float, Rgba32Float]).layers(Rule::Any);
        let picture = TextureRule::new(Rgba8Unorm).like("map");
        Ok(NodeDesc::new("threshold", Stage::AfterShadowMaps)
            .input("map", "The map to look at.", map)
            .output("picture", "White above the level.", picture)
            .pass(
                Pass::compute("threshold", "picture", [8, 8])
                    .each_layer()
                    .shader(SHADER, "threshold")
                    .bind("map", bind::layer("map"))
                    .bind("picture", bind::store("picture"))
                    .constant("level", self.level),
            ))
    }
}
