import moment_shadows::map::depth::{DepthConversion};
import moment_shadows::map::map_region::{MapRegion};
import moment_shadows::shade::area_light::{AreaLight};

// What a technique is told about a surface that a view of a light contains.

struct TechniqueReceiver {
    // The map's layer, and the region with texels.
    layer: u32,
    region: MapRegion,
    // The place from 0 to 1 across the region, and how it changes, in texels, to the pixels beside and below.
    uv: vec2f,
    difference_x: vec2f,
    difference_y: vec2f,
    // The gradient of moment depth per texel on the surface.
    gradient: vec2f,
    // Moment depth: less the receiver bias, and less what depths are rounded by alone.
    fragment_depth: f32,
    depth: f32,
    // The steepest slope per texel that does not count as an edge.
    steepest: f32,
    // How the light's map stores depth, and the light's size: for tests on the plain depth map.
    conversion: DepthConversion,
    light: AreaLight,
    // The pixel's coordinates.
    pixel: vec2f,
}
