//! The window: `cargo run --release` in this folder.

use moment_shadows_egui_host::App;

fn main() -> eframe::Result {
    let mut options = eframe::NativeOptions::default();
    options.viewport.inner_size = Some([980.0, 600.0].into());
    let create = |context: &eframe::CreationContext<'_>| {
        let host = context.wgpu_render_state.as_ref();
        Ok(Box::new(App::new(host.ok_or("egui draws without wgpu")?)?) as Box<dyn eframe::App>)
    };
    eframe::run_native("moment-shadows", options, Box::new(create))
}
