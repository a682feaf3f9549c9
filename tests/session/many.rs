//! Many lights through many views: a pixel tries those of its tile, and is what it is of those alone.

use glam::DVec3;
use moment_shadows::{
    Border, DepthRange, LightDepth, LightView, MapRegion, PointLight, TextureFormat, Tile,
};
use moment_shadows_graph::{Session, Stage};
use moment_shadows_lab::cost::clock::{Clock, ClockKind};
use moment_shadows_lab::frame::Frame;
use moment_shadows_lab::gpu::Gpu;

use crate::normals::texture;
use crate::views::{frame, seen, within};
use crate::{HARD, gpu, imports, places, recorded, session};

/// The map: tiles of 24 texels, 16 by 16 of them.
const TILE: u32 = 24;
pub(crate) const SIDE: u32 = 16 * TILE;

const LIGHTS: u32 = 16;

/// A number in [0, 1) for each index.
fn noise(index: u32) -> f64 {
    let mut state = index.wrapping_mul(0x9e37_79b9) ^ 0x85eb_ca6b;
    for _ in 0..3 {
        state ^= state >> 16;
        state = state.wrapping_mul(0x7feb_352d);
        state ^= state >> 15;
    }
    f64::from(state) / 4_294_967_296.0
}

/// A spot somewhere above the floor, in a tile of the map.
pub(crate) fn spot(number: u32, light: u32, aside: f64) -> LightView {
    let random = |index: u32| 2.0 * noise(8 * number + index) - 1.0;
    let eye = DVec3::new(
        4.0 + aside + 5.0 * random(0),
        2.5 + random(1),
        4.0 + 5.0 * random(2),
    );
    let along = DVec3::new(0.5 * random(3), -1.0, 0.5 * random(4));
    let range = DepthRange {
        near: 0.5,
        far: 8.0,
    };
    let at = PointLight {
        position: eye.to_array(),
        depth: LightDepth::Linear { range },
        tile: Tile {
            texels: TILE,
            filter_radius: 1.0,
        },
        nearest_caster: None,
    };
    LightView {
        region: MapRegion::new([number % 16 * TILE, number / 16 * TILE], [TILE; 2]),
        channel: light,
        ..at.spot(along.to_array(), 0.8).unwrap()
    }
}

/// What outputs hold, and whether views have borders.
#[derive(Clone, Copy)]
struct Settings {
    one: &'static str,
    four: &'static str,
    channel_bytes: usize,
    borders: bool,
    /// Of so many lights one is looked at.
    every: usize,
}

const FLOAT32: Settings = Settings {
    one: "r32float",
    four: "rgba32float",
    channel_bytes: 4,
    borders: false,
    every: 1,
};

/// A map of noise, and a session for it.
fn shading(gpu: &Gpu, frame: &Frame, settings: Settings, lights: u32, views: u32) -> Session {
    let borders = settings.borders;
    let import = r#""texture": { "format": "r32float", "size": [64, 64], "regions": 256 }"#;
    let depth = r#""texture": { "format": "depth32float", "size": [1024, 1024], "samples": 4 }"#;
    let format = if lights == 1 {
        settings.one
    } else {
        settings.four
    };
    let shade = format!(
        r#""type": "shade_hard", "properties": {{ "format": "{format}", "lights": {lights}, "views": {views}, "borders": {borders} }}"#
    );
    let outputs = (0..lights).step_by(4).map(|first| {
        let suffix = if first == 0 {
            String::new()
        } else {
            format!("_{first}")
        };
        format!(r#"{{ "name": "lights{first}", "from": "shade.shadow_intensity{suffix}" }}"#)
    });
    let outputs: Vec<String> = outputs.collect();
    let text = HARD
        .replace(depth, import)
        .replace(
            r#""storage": ["unorm16", "float16"]"#,
            r#""storage": "float32""#,
        )
        .replace(r#""radius": 4, "sigma": 2.4"#, r#""radius": 1"#)
        .replace(r#""type": "shade_hard""#, &shade)
        .replace(
            r#"{ "name": "shadow_intensity", "from": "shade.shadow_intensity" }"#,
            &outputs.join(","),
        );
    let texels: Vec<f32> = (0..SIDE * SIDE)
        .map(|index| 0.5 + 7.0 * noise(index) as f32)
        .collect();
    let bytes = bytemuck::cast_slice(&texels);
    let map = texture(gpu, TextureFormat::R32Float, [SIDE; 2], bytes);
    let mut imports = imports(frame);
    imports[0].1 = (&map).into();
    session(gpu, &text, &imports)
}

/// The pictures of all outputs, one after the other.
fn pictures(gpu: &Gpu, session: &Session, lights: u32) -> Vec<Vec<u8>> {
    let firsts = (0..lights).step_by(4);
    let each = firsts.map(|first| recorded(gpu, session, 0, &format!("lights{first}")));
    each.collect()
}

#[test]
fn sixteen_lights_through_256_views_are_each_what_it_is_alone() {
    let gpu = gpu();
    let frame = frame(&gpu, DVec3::new(1.0, 3.0, 0.0), DVec3::new(4.0, 0.0, 4.0));
    let (camera, _) = places(&frame);
    // Of further ones a light of each output, in each channel.
    let float16 = Settings {
        one: "r16float",
        four: "rgba16float",
        channel_bytes: 2,
        every: 5,
        ..FLOAT32
    };
    let unorm8 = Settings {
        one: "r8unorm",
        four: "rgba8unorm",
        channel_bytes: 1,
        borders: true,
        every: 5,
    };
    for settings in [FLOAT32, float16, unorm8] {
        let view = |number: u32, light, aside| LightView {
            border: match number % 3 {
                _ if !settings.borders => Border::Sharp,
                0 => Border::Sharp,
                1 => Border::Blend(4.0),
                _ => Border::Cone(3.0),
            },
            ..spot(number, light, aside)
        };
        // Seven views of each light, which do not follow each other, among views of what nobody sees.
        let views = (0..256).map(|number| view(number, number % 16, 1e3));
        let mut views: Vec<LightView> = views.collect();
        let mut seen = vec![Vec::new(); LIGHTS as usize];
        for index in 0..7 * LIGHTS {
            let (number, light) = ((index * 37 + 11) % 256, index % LIGHTS);
            views[number as usize] = view(number, light, 0.0);
            seen[light as usize].push(number as usize);
        }
        let mut all = shading(&gpu, &frame, settings, LIGHTS, 256);
        all.view(&gpu.queue, 0, &camera, &views).unwrap();
        let found = pictures(&gpu, &all, LIGHTS);
        // Few views are tried one after the other.
        let mut alone = shading(&gpu, &frame, settings, 1, 7);
        let bytes = settings.channel_bytes;
        let mut shaded = 0;
        for light in (0..LIGHTS).step_by(settings.every) {
            let own = &mut seen[light as usize];
            own.sort_unstable();
            let own = own.iter().map(|&number| LightView {
                channel: 0,
                ..views[number]
            });
            let own: Vec<LightView> = own.collect();
            alone.view(&gpu.queue, 0, &camera, &own).unwrap();
            let expected = &pictures(&gpu, &alone, 1)[0];
            let texels = found[light as usize / 4].chunks_exact(4 * bytes);
            for (pixel, (texel, expected)) in texels.zip(expected.chunks_exact(bytes)).enumerate() {
                let found = &texel[light as usize % 4 * bytes..][..bytes];
                let format = settings.four;
                assert_eq!(found, expected, "light {light}, pixel {pixel}, {format}");
                shaded += usize::from(expected.iter().any(|&byte| byte != 0));
            }
        }
        println!("{shaded} intensities above 0, {}", settings.four);
        assert!(shaded > 20_000 / settings.every);
    }
}

#[test]
fn a_channel_beyond_the_lights_is_refused() {
    let gpu = gpu();
    let frame = frame(&gpu, DVec3::new(1.0, 3.0, 0.0), DVec3::new(4.0, 0.0, 4.0));
    let (camera, _) = places(&frame);
    let mut session = shading(&gpu, &frame, FLOAT32, 5, 8);
    let view = |channel| session.view(&gpu.queue, 0, &camera, &[spot(0, channel, 0.0)]);
    let [seventh, ninth, last] = [7, 8, 16].map(view);
    assert!(seventh.is_ok());
    for (found, words) in [(ninth, "8, counted from 0"), (last, "8, counted from 0")] {
        let found = found.unwrap_err().to_string();
        assert!(found.contains("view 0") && found.contains(words), "{found}");
    }
}

#[test]
#[ignore = "a benchmark: cargo test --release --test session -- --ignored many --nocapture"]
fn time_of_many_lights_beside_one() {
    let gpu = gpu();
    let frame = frame(&gpu, DVec3::new(1.0, 3.0, 0.0), DVec3::new(4.0, 0.0, 4.0));
    let (camera, _) = places(&frame);
    let sizes = [(1, 1), (4, 4), (16, 16), (4, 24), (16, 96), (16, 256)];
    let mut sessions = sizes.map(|(lights, views)| {
        let mut session = shading(&gpu, &frame, FLOAT32, lights, views);
        let all: Vec<LightView> = (0..views)
            .map(|number| spot(number, number % lights, 0.0))
            .collect();
        session.view(&gpu.queue, 0, &camera, &all).unwrap();
        let points = (0..240 * 136).filter_map(|pixel| seen(&camera, [240, 136], pixel));
        let points: Vec<DVec3> = points.collect();
        let contained =
            |view: &LightView| points.iter().filter(|&&it| within(view, it) > 0.0).count();
        let contained: usize = all.iter().map(contained).sum();
        (session, contained as f64 / points.len() as f64)
    });
    let clock = Clock::new(&gpu, ClockKind::for_device(&gpu));
    let mut times = sizes.map(|_| Vec::new());
    for _ in 0..21 {
        for ((session, _), times) in sessions.iter_mut().zip(&mut times) {
            let time = clock.time("many lights", |encoder| {
                for _ in 0..8 {
                    session.record(Stage::AfterMainPass, encoder).unwrap();
                }
                Ok(())
            });
            times.push(time.unwrap().seconds);
        }
    }
    let medians = times.map(|mut times| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    });
    for (((lights, views), time), (_, contained)) in sizes.into_iter().zip(medians).zip(sessions) {
        println!(
            "{lights} lights, {views} views, of which {contained:.2} contain a pixel: {:.2} of one ({:.2} ms)",
            time / medians[0],
            time / 8e-3
        );
    }
}
