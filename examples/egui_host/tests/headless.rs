//! The window without a window: what egui draws with the callback is the picture without it, times 1 - shadow intensity.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::cell::Cell;
use std::path::Path;

use eframe::egui_wgpu::RendererOptions;
use eframe::{egui, wgpu};
use egui_kittest::Harness;
use egui_kittest::wgpu::{WgpuTestRenderer, create_render_state, default_wgpu_setup};
use image::RgbaImage;
use moment_shadows::Profile;
use moment_shadows_egui_host::App;
use moment_shadows_lab::command::{drawn::Drawn, render::RenderOptions};
use moment_shadows_lab::graph_file::GraphFile;
use moment_shadows_lab::graph_frame::GraphFrame;
use moment_shadows_lab::{gpu::Gpu, picture, scene};

/// As large as the picture and a margin.
const WINDOW: [f32; 2] = [980.0, 600.0];
const PICTURE: [u32; 2] = [960, 540];

/// The shadow intensity of the same frame and graph on a device of the lab's own, recorded into the plan's texture.
fn shadow_intensity() -> Vec<f32> {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let options = RenderOptions {
        size: Some(PICTURE),
        ..Default::default()
    };
    let scene = scene::load(&options.scene).unwrap();
    let frame = options
        .frame(&gpu, &scene, &options.sized(Drawn::default()), 4)
        .unwrap();
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/shadows.json");
    let file = GraphFile::read(Path::new(path), None).unwrap();
    let graph_frame = GraphFrame::new(&gpu, &frame, &file).unwrap();
    graph_frame.run(&gpu).unwrap();
    graph_frame.read_shadow(&gpu, &file).unwrap()
}

/// What egui draws, and where the picture lies in it.
fn drawn(show: impl Fn(&App, &mut egui::Ui) -> egui::Response) -> (RgbaImage, [u32; 2]) {
    let render_state = create_render_state(default_wgpu_setup(), RendererOptions::PREDICTABLE);
    // Not sRGB: what is blended are the bytes themselves.
    assert_eq!(render_state.target_format, wgpu::TextureFormat::Rgba8Unorm);
    let app = pollster::block_on(App::new(&render_state)).unwrap();
    let at = Cell::new([0; 2]);
    let mut harness = Harness::builder()
        .with_size(WINDOW)
        .renderer(WgpuTestRenderer::from_render_state(render_state))
        .build_ui(|ui| {
            ui.set_max_size(PICTURE.map(|side| side as f32).into());
            let rect = show(&app, ui).rect;
            assert_eq!(
                [rect.width(), rect.height()],
                PICTURE.map(|side| side as f32)
            );
            at.set([rect.left() as u32, rect.top() as u32]);
        });
    let image = harness.render().unwrap();
    drop(harness);
    (image, at.get())
}

#[test]
fn the_callback_darkens_the_picture_by_the_shadow_intensity() {
    let (shadowed, at) = drawn(|app, ui| app.show(ui));
    let (plain, plain_at) = drawn(|app, ui| {
        let size = egui::Vec2::from(PICTURE.map(|side| side as f32));
        ui.add(egui::Image::new((app.0, size)))
    });
    assert_eq!(at, plain_at);
    // The pane does not begin at the window's corner: a pass that took its pixels from there would miss.
    assert!(at[0] > 0 && at[1] > 0, "{at:?}");

    let shadow = shadow_intensity();
    let mut dark = 0;
    for (index, intensity) in (0..).zip(&shadow) {
        let [x, y] = [at[0] + index % PICTURE[0], at[1] + index / PICTURE[0]];
        let [found, plain] = [&shadowed, &plain].map(|image| image.get_pixel(x, y).0);
        for (found, plain) in found.iter().zip(plain).take(3) {
            let expected = f32::from(plain) * (1.0 - intensity);
            // The byte that is blended to is rounded, and so is the intensity that is read back: half a byte each; and
            // the place in the picture is interpolated, not exact.
            let difference = (f32::from(*found) - expected).abs();
            assert!(
                difference < 2.0,
                "({x}, {y}): {found} in place of {expected}"
            );
        }
        dark += u32::from(*intensity > 0.5);
    }
    // The fence and its foliage shade a good part of the picture.
    let part = f64::from(dark) / shadow.len() as f64;
    assert!((0.05..0.6).contains(&part), "{part}");

    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("egui_host.png");
    let [width, height] = WINDOW.map(|side| side as u32);
    picture::save_rgba(&path, width, height, &shadowed).unwrap();
    println!("{}", path.display());
}
