//! Planes do not shadow themselves, whatever the filter; what stands in front of them does.

use glam::{DVec2, DVec3};
use moment_shadows::{AreaLight, DepthConversion, DepthRange, LightSize, MapRegion};
use moment_shadows_lab::light::LightView;

use crate::device::{self, Query, Shader};

pub(crate) const IMPORTS: &str = "
import moment_shadows::techniques::percentage_closer::{percentage_closer_binary, percentage_closer_box, percentage_closer_gaussian, percentage_closer_poisson};
import moment_shadows::techniques::percentage_closer_hardware::{percentage_closer_hardware_box};
import moment_shadows::shade::area_light::{AreaLight};
import moment_shadows::techniques::percentage_closer_soft::{percentage_closer_soft_intensity};
";

/// The test's number is in `taps`.
pub(crate) const BODY: &str = "
alias Extra = AreaLight;
fn answer(query: Query, plane: ReceiverPlane) -> f32 {
    let region = query.region;
    switch query.taps {
        case 0u: { return percentage_closer_binary(map, query.layer, region, plane, conversion); }
        case 1u: { return percentage_closer_box(map, query.layer, region, plane, conversion, i32(query.radius)); }
        case 2u: { return percentage_closer_gaussian(map, query.layer, region, plane, conversion, i32(query.radius), 0.5 * query.radius); }
        case 3u: { return percentage_closer_poisson(map, query.layer, region, plane, conversion, query.radius, query.angle); }
        case 4u: { return percentage_closer_hardware_box(map, comparison, query.layer, region, plane, conversion, i32(query.radius)); }
        default: { return percentage_closer_soft_intensity(map, query.layer, region, plane, conversion, extra, 16u, 25u, query.angle); }
    }
}
";

/// How many tests [`BODY`] has.
pub(crate) const TESTS: u32 = 6;

/// The plane fills this region; the rest of the map holds casters at the near end.
const REGION: MapRegion = MapRegion::new([5, 7], [31, 29]);
const SIZE: [u32; 2] = [48, 43];

/// A light over the region, how its map stores depth, and the moment depth of its place.
struct Setting {
    light: LightView,
    conversion: DepthConversion,
    light_depth: f32,
}

fn settings() -> [Setting; 3] {
    let range = DepthRange {
        near: 1.0,
        far: 9.0,
    };
    let spot = |reversed| {
        LightView::spot(
            DVec3::ZERO,
            DVec3::NEG_Z,
            1.0,
            0.5,
            None,
            [range.near, range.far],
            reversed,
        )
        .unwrap()
    };
    let corners = [DVec3::new(-4.0, -4.0, -9.0), DVec3::new(4.0, 4.0, -1.0)];
    let fit = moment_shadows_lab::light::DirectionalFit {
        map: REGION.extent,
        margin: 1.0,
        reversed: false,
    };
    [
        Setting {
            light: LightView::directional_fitted(DVec3::NEG_Z, &corners, fit).unwrap(),
            conversion: DepthConversion::orthographic(),
            light_depth: -1e30,
        },
        Setting {
            light: spot(false),
            conversion: DepthConversion::perspective(0.5, f64::INFINITY, range).unwrap(),
            light_depth: -1.25,
        },
        Setting {
            light: spot(true),
            conversion: DepthConversion::perspective(0.5, f64::INFINITY, range)
                .unwrap()
                .reversed(),
            light_depth: -1.25,
        },
    ]
}

/// What the map holds for something at a distance along the axis.
fn stored_depth(light: &LightView, distance: f64) -> f32 {
    let clip = light.clip_from_view * DVec3::new(0.0, 0.0, -distance).extend(1.0);
    // A depth buffer ends at its planes.
    (clip.z / clip.w).clamp(0.0, 1.0) as f32
}

/// Moment depth, not clamped, of a plane at a texel of the region.
fn plane_depth(light: &LightView, texel: DVec2, point: DVec3, normal: DVec3) -> f64 {
    let extent = DVec2::from_array(REGION.extent.map(f64::from));
    let (origin, direction) = light.ray(texel / extent);
    let distance = normal.dot(point - origin) / normal.dot(direction);
    if distance > 0.0 {
        light.moment_depth_of_distance(distance)
    } else {
        1e3
    }
}

#[test]
fn a_plane_is_lit_by_itself_and_shadowed_by_what_is_in_front_of_it() {
    let gpu = device::open();
    let shader = Shader::new(&gpu, IMPORTS, BODY);
    let soft = AreaLight::new(
        LightSize::AngularDiameter(0.2),
        [0.3, 0.3],
        DepthRange {
            near: 1.0,
            far: 9.0,
        },
        2.0..=12.0,
    )
    .unwrap();
    let mut asked = 0;
    for Setting {
        light,
        conversion,
        light_depth,
    } in settings()
    {
        let compare = if light.depth.reversed() {
            wgpu::CompareFunction::Less
        } else {
            wgpu::CompareFunction::Greater
        };
        for degrees in [0.0_f64, 20.0, 45.0, 65.0] {
            for around in 0..3 {
                let (sine, cosine) = degrees.to_radians().sin_cos();
                let (y, x) = (2.0 * f64::from(around) + 0.3).sin_cos();
                let normal = DVec3::new(sine * x, sine * y, cosine);
                let point = light.ray(DVec2::splat(0.5)).0 + DVec3::new(0.0, 0.0, -5.0);
                let depth = |place: DVec2| plane_depth(&light, place, point, normal);
                let mut stored =
                    vec![stored_depth(&light, light.range[0]); (SIZE[0] * SIZE[1]) as usize];
                for y in 0..REGION.extent[1] {
                    for x in 0..REGION.extent[0] {
                        let z = depth(DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5)).max(-1.0);
                        let distance =
                            light.range[0] + 0.5 * (z + 1.0) * (light.range[1] - light.range[0]);
                        let texel = (y + REGION.origin[1]) * SIZE[0] + x + REGION.origin[0];
                        stored[texel as usize] = stored_depth(&light, distance);
                    }
                }
                let map = device::map(&gpu, wgpu::TextureFormat::Depth32Float, SIZE, &[stored]);
                let extent = DVec2::from_array(REGION.extent.map(f64::from));
                let mut queries = Vec::new();
                for place in 0..200_u32 {
                    // Places on a lattice that meets texels everywhere, the region's corners among them.
                    let uv =
                        DVec2::new(f64::from(place) * 0.618_034 % 1.0, f64::from(place) / 199.0);
                    let at = uv * extent;
                    // The plane's own gradient, by differences that are exact enough in f64.
                    let slope = |step: DVec2| (depth(at + step) - depth(at - step)) * 5e5;
                    let gradient =
                        DVec2::new(slope(DVec2::new(1e-6, 0.0)), slope(DVec2::new(0.0, 1e-6)));
                    let z = depth(at);
                    if z.abs() > 0.99 {
                        continue;
                    }
                    for test in 0..TESTS {
                        // Stored depths are off by some steps of 6e-8, each worth up to 16 times as much in moment depth where depth
                        // is hyperbolic, and gradients by 1e-7 of themselves, times 12 texels.
                        for bias in [1e-5, -0.5] {
                            queries.push(Query {
                                uv: uv.as_vec2().to_array(),
                                gradient: gradient.as_vec2().to_array(),
                                region: REGION,
                                light_depth,
                                radius: 4.0,
                                angle: place as f32,
                                taps: test,
                                bias,
                                ..Query::new([0.0; 2], z as f32, SIZE)
                            });
                        }
                    }
                }
                let answers = shader.run(
                    &map,
                    compare,
                    conversion,
                    bytemuck::bytes_of(&soft),
                    &queries,
                );
                for pair in queries.chunks_exact(2).zip(answers.chunks_exact(2)) {
                    let ([query, behind], [lit, dark]) = pair else {
                        panic!("pairs")
                    };
                    assert_eq!(
                        *lit,
                        0.0,
                        "{:?} at {degrees} degrees shadows itself: {query:?}",
                        light.kind()
                    );
                    // A receiver behind the plane is dark where its kernel does not leave the range, and comparison samplers
                    // find what stands clear of the plane by its rise over a texel.
                    let rise = behind.gradient[0].abs() + behind.gradient[1].abs();
                    if behind.depth + 24.0 * rise < 0.99 && rise < 0.1 {
                        // 81 hardware taps are summed with weights of 8 bits.
                        assert!(
                            *dark > 1.0 - 1e-5,
                            "{:?} at {degrees} degrees: {dark} for {behind:?}",
                            light.kind()
                        );
                        asked += 1;
                    }
                }
            }
        }
    }
    assert!(asked > 3000, "only {asked} receivers were behind the plane");
}
