//! The window: `cargo run --release` in this folder.

use moment_shadows_egui_host::App;

fn main() -> eframe::Result {
    let create = |context: &eframe::CreationContext<'_>| {
        let egui = context.wgpu_render_state.as_ref();
        let app = pollster::block_on(App::new(egui.ok_or("egui draws without wgpu")?))?;
        Ok(Box::new(app) as Box<dyn eframe::App>)
    };
    eframe::run_native("moment-shadows", Default::default(), Box::new(create))
}
